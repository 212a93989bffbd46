"""The Kalman filter and the smoother, written as the equations.

    predict     x_pred = F x + B u         P_pred = F P F' + Q
    update      K = P_pred H' S^-1         with y = z - H x_pred and S = H P_pred H' + R
                x = x_pred + K y           P = (I - K H) P_pred

One loop, `kalman_filter`, serves the linear and the extended filter: the model hands over F and H,
constant or evaluated at the estimate. Source: Kalman (1960).

Every covariance is kept as a product P = L L' of its root L (roots.py). So it stays a covariance,
however small Q and R or large P0 are.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .checks import (
    check_filter,
    check_noise,
    check_probability,
    check_still_finite,
    checked_estimate,
    innovation,
    measurement,
    series,
    steps_of,
)
from .frozen import ReadOnly
from .models import at
from .roots import Covariance, add_up, gain, innovation_covariance, root_of, rotated, steps_again

# --- one step: predict, then update -------------------------------------------------------------


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


def predict(model, x, P, u=None, k=0):
    """One step ahead without a measurement -> Prediction(x_pred, P_pred, F).

    x (n,), P (n, n), u (l,) or None; k is the number of the step, where the model's matrices change
    from step to step.
    """
    x, P = checked_estimate("x", x, "P", P, len(model.x0))
    x_pred, F = model.transition(x, u, k)  # F x + B u
    P_pred = add_up(F @ root_of(P), root_of(at(model.Q, k)))  # F P F' + Q
    return Prediction(x_pred, P_pred, F)


def update(model, x_pred, P_pred, z, R=None, u=None, k=0):
    """Blend the prediction with the measurement z (m,) -> Update(x, P, y, S, K).

    R (m, m) replaces the model's R of step k; u (l,) or None is what h(x, u) of a nonlinear model
    may see. A sensor is silent where z is NaN or its variance in R infinite: it has no innovation
    (y is NaN), its column of K is 0, and the others are used. If all are silent, the prediction is
    kept.

    ValueError: z is not (m,) or infinite.
    """
    x_pred, P_pred = checked_estimate("x_pred", x_pred, "P_pred", P_pred, len(model.x0))
    z_pred, H = model.measure(x_pred, u, k)
    R_k = at(model.R, k)
    R = R_k if R is None else check_noise("R", R, R_k.shape)
    z = measurement(z, z_pred.shape)
    y = innovation(model.residual, z, z_pred, k)  # z - H x_pred
    S = innovation_covariance(H, P_pred, R)  # H P_pred H' + R
    return _blend(x_pred, P_pred, y, H, S, R)


def _blend(x_pred, P_pred, y, H, S, R):
    """The update once the innovation y and its covariance S are known."""
    heard = np.isfinite(y) & np.isfinite(np.diag(R))
    if heard.all():
        K, P = gain(P_pred, H, R)  # P_pred H' S^-1 and (I - K H) P_pred
        x = x_pred + K @ y
        return Update(x, P, y, S, K)
    K, P = np.zeros(H.T.shape), P_pred
    if heard.any():
        K[:, heard], P = gain(P_pred, H[heard], R[np.ix_(heard, heard)])
    x = x_pred + K[:, heard] @ y[heard]
    return Update(x, P, np.where(heard, y, np.nan), S, K)


# --- a whole series -----------------------------------------------------------------------------


def _nothing():
    """The default of a field that a result may lack; a plain None would hide what is made later."""
    return field(default_factory=lambda: None)


@dataclass(frozen=True, eq=False)
class FilterResult(ReadOnly):
    """Everything the filter computed, stacked over T steps; all arrays are read-only.

    x_pred (T, n), P_pred (T, n, n) before the measurement; x (T, n), P (T, n, n) after it;
    y (T, m) innovation, NaN where a sensor was silent or its innovation left out by the gate;
    S (T, m, m) the covariance of y, of the silent sensors too; K (T, n, m) gain, a column of 0 for
    a silent sensor; F (T, n, n) the transition that led to the step, H (T, m, n), Q (T, n, n) and
    R (T, m, m) as they were used; start (n, n) the root L of the covariance before the first step,
    P0 = L L'; gated (T, m) True where the gate left out an innovation.

    Of many runs at once: x_pred and x are (T, n, N), y and gated (T, m, N); what is the same for
    every run stays as above, and what is not has the axis of the N runs as its last one.
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


def kalman_filter(model, z, u=None, adapt_R=None, gate=None):
    """Filter a whole series: every step predicts, then updates.

    model   LinearModel, or NonlinearModel (then this is the extended Kalman filter)
    z       (T, m) measurements; (T,) if m = 1. NaN: that sensor is silent at that step, the others
            are used. (T, m, N) filters N runs of one LinearModel at once (a Monte Carlo study); see
            FilterResult. Needs the usual residual, no adapt_R and no gate.
    u       (T, l) inputs, row k drives the step to k; (T,) if l = 1; common to all runs
    adapt_R function (k, y, HPH, R) -> R of step k, called before the update with the innovation y
            (m,), NaN where a sensor is silent, the part HPH (m, m) of its covariance that comes
            from the prediction, and the model's R
    gate    a probability such as 0.999: a sensor whose y^2 / S lies outside this quantile of
            chi-square (1 degree of freedom) is left out at that step, and marked in `gated`

    Returns a FilterResult. ValueError: z or u of the wrong shape or not finite; matrices for
    another number of steps than z has; a filter whose numbers are no longer finite (at which step).
    """
    check_filter(model, adapt_R)
    z = series("z", z, width=model.R.shape[-1], runs=True)
    steps_of(model, len(z))
    u = None if u is None else series("u", u, steps=len(z))
    limit = _gate_limit(gate)
    if z.ndim == 2:
        return _filter_run(model, z, u, adapt_R, limit)
    from .many import filter_runs  # here, for it stands on this file

    return filter_runs(model, z, u, adapt_R, gate)


def _filter_run(model, z, u, adapt_R, limit):
    """The FilterResult of z (T, m); a sensor with y^2 / S above the limit is left out."""
    x, P = model.x0, model.P0
    steps = []
    for k, z_k in enumerate(z):
        u_k = None if u is None else u[k]
        x_pred, P_pred, F = predict(model, x, P, u_k, k)
        z_pred, H = model.measure(x_pred, u_k, k)
        y = innovation(model.residual, z_k, z_pred, k)
        R = at(model.R, k)
        if adapt_R is not None and np.isfinite(z_k).any():
            R = _adapted(adapt_R, k, y, H, P_pred, R)
        S = innovation_covariance(H, P_pred, R)
        gated = y * y > limit * np.diag(S)
        x, P, y, S, K = _blend(x_pred, P_pred, np.where(gated, np.nan, y), H, S, R)
        check_still_finite(model, k, x, P)
        steps.append((x_pred, P_pred, x, P, y, S, K, F, R, H, at(model.Q, k), gated))
    *columns, gated = (np.array(column) for column in zip(*steps))
    return FilterResult(*columns, root_of(model.P0), gated)


def _gate_limit(gate):
    """The quantile of chi-square with one degree of freedom; infinite without a gate."""
    if gate is None:
        return np.inf
    check_probability("gate", gate)
    from scipy.special import erfinv  # here, so that importing the package loads NumPy alone

    return 2 * erfinv(gate) ** 2


def _adapted(adapt_R, k, y, H, P_pred, R):
    """The R that adapt_R wants at step k, checked."""
    HPH = innovation_covariance(H, P_pred, np.zeros(R.shape))
    wanted = adapt_R(k, y.copy(), HPH, R)
    en, id = f"R from adapt_R at step {k}", f"R dari adapt_R pada langkah {k}"
    return check_noise(en, wanted, R.shape, id)


# --- back from the end --------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class SmootherResult(ReadOnly):
    """x (T, n) and P (T, n, n) given all T measurements, read-only; of many runs x (T, n, N)."""

    x: np.ndarray
    P: np.ndarray


def rts_smooth(result):
    """Run back over a FilterResult of one run -> SmootherResult: each estimate knows all of z.

    The equations of Rauch, Tung and Striebel (1965) are x_s = x + G (x_s_next - x_pred_next) with
    the gain G = P F' P_pred^-1; but P_pred is singular, and G useless, as soon as a state decays
    without noise or is known. So here the same estimates come as x_s = x + L rho and
    P_s = L V V' L', with the root L of P: rho (n,) and V (n, n) collect what the later measurements
    say, and run back through the filter's own roots (Park and Kailath, 1995).

    ValueError: a result of many runs, or one without `start`.
    """
    if result.x.ndim != 2:
        raise ValueError(
            "rts_smooth takes one run, x of shape (T, n); many runs go to smooth_runs. / "
            "rts_smooth menerima satu percobaan, x berukuran (T, n); banyak percobaan: smooth_runs."
        )
    if result.start is None:
        raise ValueError(
            "This result holds no root of P0 (start), so it cannot be smoothed. / "
            "Hasil ini tidak memuat akar P0 (start), jadi tidak dapat dihaluskan."
        )
    T, n = result.x.shape
    x = np.empty((T, n))
    P = np.empty((T, n, n))
    rho = np.zeros(n)
    V = np.eye(n)
    for k, step in reversed(list(enumerate(steps_again(result)))):
        x[k] = result.x[k] + step.L @ rho
        P[k] = Covariance.from_root(step.L @ V)
        turn, rest = step.rotation[:, :n], step.rotation[:, n:]
        rho = turn @ (step.g + step.A @ rho)
        V, _ = rotated(np.hstack([turn @ step.A @ V, rest]))
    return SmootherResult(x, P)
