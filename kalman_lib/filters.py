"""The Kalman filter and the smoother, written as the equations.

One loop serves the linear and the extended filter: the model hands over F and H, constant or evaluated at the
estimate. Source: Kalman (1960).

Every covariance is kept as a product P = L L' of its root L (roots.py). So it stays a covariance, however small Q and R
or large P0 are.
"""
from dataclasses import dataclass, field, fields
from numbers import Real
from typing import NamedTuple

import numpy as np

from .checks import check_covariance, check_finite, numbers, series, shape_message
from .models import LinearModel, at, steps_of
from .roots import Covariance, add_up, gain, innovation_covariance, one_after_another, root_of, rotated


class Prediction(NamedTuple):
    """x_pred (n,), P_pred (n, n), and the F (n, n) that was used."""
    x_pred: np.ndarray
    P_pred: np.ndarray
    F: np.ndarray


class Update(NamedTuple):
    """x (n,), P (n, n), innovation y (m,), its covariance S (m, m), gain K (n, m)."""
    x: np.ndarray
    P: np.ndarray
    y: np.ndarray
    S: np.ndarray
    K: np.ndarray


def _nothing():
    """The default of a field that a result may lack."""
    return field(default_factory=lambda: None)


@dataclass(frozen=True, eq=False)
class FilterResult:
    """Everything the filter computed, stacked over T steps; all arrays are read-only.

    x_pred (T, n), P_pred (T, n, n) before the measurement; x (T, n), P (T, n, n) after it;
    y (T, m) innovation, NaN where a sensor was silent or its innovation left out by the gate;
    S (T, m, m) the covariance of y, of the silent sensors too; K (T, n, m) gain, a column of 0 for a silent sensor;
    F (T, n, n) the transition that led to the step, H (T, m, n), Q (T, n, n) and R (T, m, m) as they were used;
    start (n, n) the root L of the covariance before the first step, P0 = L L'; gated (T, m) True where the gate left
    out an innovation.

    Of many runs at once: x_pred and x are (T, n, N), y and gated (T, m, N); what is the same for every run stays as
    above, and what is not has the axis of the N runs as its last one.
    """
    x_pred: np.ndarray
    P_pred: np.ndarray
    x: np.ndarray
    P: np.ndarray
    y: np.ndarray
    S: np.ndarray
    K: np.ndarray
    F: np.ndarray
    R: np.ndarray
    H: np.ndarray | None = _nothing()
    Q: np.ndarray | None = _nothing()
    start: np.ndarray | None = _nothing()
    gated: np.ndarray | None = _nothing()

    def __post_init__(self):
        _read_only(self)

    def __setstate__(self, state):              # copied or unpickled
        self.__dict__.update(state)
        _read_only(self)


@dataclass(frozen=True, eq=False)
class SmootherResult:
    """x (T, n) and P (T, n, n) given all T measurements, read-only; of many runs x (T, n, N)."""
    x: np.ndarray
    P: np.ndarray

    def __post_init__(self):
        _read_only(self)

    def __setstate__(self, state):              # copied or unpickled
        self.__dict__.update(state)
        _read_only(self)


def _read_only(result):
    """Every array of a result as a read-only view."""
    for part in fields(result):
        array = getattr(result, part.name)
        if array is not None:
            array = array.view()
            array.setflags(write=False)
            object.__setattr__(result, part.name, array)


def predict(model, x, P, u=None, k=0):
    """One step ahead without a measurement: x (n,), P (n, n), u (l,) or None -> Prediction(x_pred, P_pred, F).

    k is the number of the step, where the model's matrices change from step to step.
    """
    x, P = _by_hand("x", x, "P", P, len(model.x0))
    x_pred, F = model.transition(x, u, k)
    P_pred = add_up(F @ root_of(P), root_of(at(model.Q, k)))        # F P F' + Q
    return Prediction(x_pred, P_pred, F)


def update(model, x_pred, P_pred, z, R=None, u=None, k=0):
    """Blend the prediction with the measurement z (m,) -> Update(x, P, y, S, K).

    R (m, m) replaces the model's R of step k; u (l,) or None is what h(x, u) of a nonlinear model may see.
    A sensor is silent where z is NaN or its variance in R infinite: it has no innovation (y is NaN), its column of K
    is 0, and the others are used. If all are silent, the prediction is kept.

    ValueError: z is not (m,) or infinite.
    """
    x_pred, P_pred = _by_hand("x_pred", x_pred, "P_pred", P_pred, len(model.x0))
    z_pred, H = model.measure(x_pred, u, k)
    R = at(model.R, k) if R is None else _noise_by_hand("R", "R", R, at(model.R, k).shape)
    z = numbers("z", z)
    if z.shape != z_pred.shape:
        raise ValueError(shape_message("z", z.shape, z_pred.shape))
    if np.isinf(z).any():
        raise ValueError(f"z is {z}; expected finite numbers, or NaN where a sensor is silent. / "
                         f"z berisi {z}; seharusnya bilangan berhingga, atau NaN bila sensornya diam.")
    y = _innovation(model, z, z_pred, k)
    S = innovation_covariance(H, P_pred, R)
    return _blend(x_pred, P_pred, y, H, S, R)


def _blend(x_pred, P_pred, y, H, S, R):
    """The update once the innovation y and its covariance S are known."""
    heard = np.isfinite(y) & np.isfinite(np.diag(R))
    if heard.all():
        K, P = gain(P_pred, H, R)               # P_pred H' S^-1 and (I - K H) P_pred
        return Update(x_pred + K @ y, P, y, S, K)
    K, P = np.zeros(H.T.shape), P_pred
    if heard.any():
        K[:, heard], P = gain(P_pred, H[heard], R[np.ix_(heard, heard)])
    x = x_pred + K[:, heard] @ y[heard]
    return Update(x, P, np.where(heard, y, np.nan), S, K)


def kalman_filter(model, z, u=None, adapt_R=None, gate=None):
    """Filter a whole series: every step predicts, then updates.

    model   LinearModel, or NonlinearModel (then this is the extended Kalman filter)
    z       (T, m) measurements; (T,) if m = 1. NaN: that sensor is silent at that step, the others are used.
            (T, m, N) filters N runs of one LinearModel at once (a Monte Carlo study); see FilterResult. Needs the
            usual residual, no adapt_R and no gate.
    u       (T, l) inputs, row k drives the step to k; (T,) if l = 1; common to all runs
    adapt_R function (k, y, HPH, R) -> R of step k, called before the update with the innovation y (m,), NaN where a
            sensor is silent, the part HPH (m, m) of its covariance that comes from the prediction, and the model's R
    gate    a probability such as 0.999: a sensor whose y^2 / S lies outside this quantile of chi-square (1 degree of
            freedom) is left out at that step, like a silent one, and marked in `gated`

    Returns a FilterResult. ValueError: z or u of the wrong shape or not finite; matrices for another number of steps
    than z has; a nonlinear model whose numbers are no longer finite (the message names the step).
    """
    z, u = _data(model, z, u, adapt_R)
    limit = _gate_limit(gate)
    if z.ndim == 3:
        from .many import filter_runs           # here, for it stands on this file
        return filter_runs(model, z, u, adapt_R, gate)
    x, P = model.x0, model.P0
    steps = []
    for k in range(len(z)):
        u_k = None if u is None else u[k]
        x_pred, P_pred, F = predict(model, x, P, u_k, k)
        z_pred, H = model.measure(x_pred, u_k, k)
        y = _innovation(model, z[k], z_pred, k)
        R = at(model.R, k)
        if adapt_R is not None and np.isfinite(z[k]).any():
            R = _adapted(adapt_R, k, y, H, P_pred, R)
        S = innovation_covariance(H, P_pred, R)
        gated = y * y > limit * np.diag(S)
        x, P, y, S, K = _blend(x_pred, P_pred, np.where(gated, np.nan, y), H, S, R)
        _check_step(model, k, x, P)
        steps.append((x_pred, P_pred, x, P, y, S, K, F, R, H, at(model.Q, k), gated))
    *columns, gated = (np.array(column) for column in zip(*steps))
    return FilterResult(*columns, root_of(model.P0), gated)


def rts_smooth(result):
    """Run back over a FilterResult of one run, so that every estimate knows the later measurements -> SmootherResult.

    The equations of Rauch, Tung and Striebel (1965) are x_s = x + G (x_s_next - x_pred_next) with the gain
    G = P F' P_pred^-1; but P_pred is singular, and G useless, as soon as a state decays without noise or is known.
    So here the same estimates come as x_s = x + L rho and P_s = L V V' L', with the root L of P: rho (n,) and V (n, n)
    collect what the later measurements say, and run back through the filter's own roots (Park and Kailath, 1995).
    """
    if result.x.ndim != 2:
        raise ValueError("rts_smooth takes one run, x of shape (T, n); many runs go to smooth_runs. / "
                         "rts_smooth menerima satu percobaan, x berukuran (T, n); banyak percobaan: smooth_runs.")
    T, n = result.x.shape
    turns, learnt, roots = _roots_again(result)
    x = np.empty((T, n))
    P = np.empty((T, n, n))
    rho = np.zeros(n)
    V = np.eye(n)
    for k in reversed(range(T)):
        x[k] = result.x[k] + roots[k] @ rho
        P[k] = Covariance.from_root(roots[k] @ V)
        g, A = learnt[k]
        rho = turns[k][:, :n] @ (g + A @ rho)
        V, _ = rotated(np.hstack([turns[k][:, :n] @ A @ V, turns[k][:, n:]]))
    return SmootherResult(x, P)


def _roots_again(result):
    """The filter's roots L of every P, how each prediction turned them, and what each measurement did to them."""
    if result.start is None:
        raise ValueError("This result holds no root of P0 (start), so it cannot be smoothed. / "
                         "Hasil ini tidak memuat akar P0 (start), jadi tidak dapat dihaluskan.")
    L = result.start
    turns, learnt, roots = [], [], []
    for F, Q, H, R, y in zip(result.F, result.Q, result.H, result.R, result.y):
        L_pred, rotation = rotated(np.hstack([F @ L, root_of(Q)]))
        g, A = np.zeros(len(L)), np.eye(len(L))
        for a, S, A_i, y_i in one_after_another(L_pred, y, H, R):
            g = g + A @ a * (y_i / S)           # x = x_pred + L_pred g
            A = A @ A_i                         # P = L_pred A A' L_pred'
        L = L_pred @ A
        turns.append(rotation[:len(L)])
        learnt.append((g, A))
        roots.append(L)
    return turns, learnt, roots


# --- checks ----------------------------------------------------------------------------------------------------------

def _innovation(model, z, z_pred, k):
    """residual(z, z_pred) (m,), NaN where z is; ValueError where it is not finite, or has another shape."""
    y = numbers("residual(z, z_pred)", model.residual(z, z_pred))
    if y.shape != z_pred.shape:
        raise ValueError(shape_message("residual(z, z_pred)", y.shape, z_pred.shape))
    silent = np.isnan(z)
    if not np.isfinite(y[~silent]).all() and np.isfinite(z_pred).all():
        i = int(np.argmax(~silent & ~np.isfinite(y)))
        raise ValueError(f"residual(z, z_pred)[{i}] is {y[i]} at step {k} (counted from 0); expected a finite number. "
                         f"/ residual(z, z_pred)[{i}] bernilai {y[i]} pada langkah {k} (dihitung dari 0); seharusnya "
                         f"bilangan berhingga.")
    y[silent] = np.nan
    return y


def _by_hand(name_x, x, name_P, P, n):
    """x (n,) and P (n, n) as the filter left them, or as somebody wrote them down: then they are checked."""
    if isinstance(P, Covariance):
        return x, P
    x = check_finite(name_x, numbers(name_x, x))
    P = check_finite(name_P, numbers(name_P, P))
    if x.shape != (n,):
        raise ValueError(shape_message(name_x, x.shape, (n,)))
    if P.shape != (n, n):
        raise ValueError(shape_message(name_P, P.shape, (n, n)))
    check_covariance(name_P, P)
    return x, P


def _noise_by_hand(name, id, R, shape):
    """R (m, m) as somebody wrote it down, or adapt_R returned it, checked; id: its name in Indonesian."""
    R = numbers(name, R)
    if R.shape != shape:
        raise ValueError(f"{name} has shape {R.shape}, expected {shape}. / {id} berukuran {R.shape}, seharusnya {shape}.")
    check_covariance(name, R, definite=True, id=id)
    return R


def _data(model, z, u, adapt_R):
    """z and u as new arrays that fit the model."""
    if not hasattr(model, "transition"):
        raise ValueError(f"model must be a LinearModel or a NonlinearModel, not {type(model).__name__}. / "
                         f"model harus LinearModel atau NonlinearModel, bukan {type(model).__name__}.")
    if adapt_R is not None and not callable(adapt_R):
        raise ValueError("adapt_R must be a function (k, y, HPH, R). / adapt_R harus berupa fungsi (k, y, HPH, R).")
    z = series("z", z, width=model.R.shape[-1], runs=True)
    steps_of(model, len(z))
    if u is not None:
        u = series("u", u, steps=len(z))
    return z, u


def _gate_limit(gate):
    """The quantile of chi-square with one degree of freedom; infinite without a gate."""
    if gate is None:
        return np.inf
    if not isinstance(gate, Real) or not 0 < gate < 1:
        raise ValueError(f"gate = {gate!r}: expected a probability between 0 and 1, such as 0.999. / "
                         f"gate = {gate!r}: seharusnya peluang antara 0 dan 1, misalnya 0.999.")
    from scipy.special import erfinv            # here, so that importing the package loads NumPy alone
    return 2 * erfinv(gate) ** 2


def _adapted(adapt_R, k, y, H, P_pred, R):
    """The R that adapt_R wants at step k, checked."""
    HPH = innovation_covariance(H, P_pred, np.zeros(R.shape))
    wanted = adapt_R(k, y.copy(), HPH, R)
    return _noise_by_hand(f"R from adapt_R at step {k}", f"R dari adapt_R pada langkah {k}", wanted, R.shape)


def _check_step(model, k, x, P):
    """ValueError as soon as a filter has gone astray: the first step whose numbers are not finite."""
    if np.isfinite(x).all() and np.isfinite(P).all():
        return
    linear = isinstance(model, LinearModel)
    look = "F" if linear else "the Jacobians F and H (check_jacobians)"
    lihat = "F" if linear else "Jacobian F dan H (check_jacobians)"
    raise ValueError(f"x or P is no longer finite at step {k} (counted from 0): the filter diverges; look at {look}. "
                     f"/ x atau P tidak lagi berhingga pada langkah {k} (dihitung dari 0): filternya divergen; "
                     f"periksalah {lihat}.")
