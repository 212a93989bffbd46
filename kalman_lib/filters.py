"""The Kalman filter and the Rauch-Tung-Striebel smoother, written as the equations.

One loop serves the linear and the extended filter: the model hands over F and H, constant or evaluated at the
estimate. Source: Kalman (1960); the smoother: Rauch, Tung and Striebel (1965).
"""
import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from .models import LinearModel, _shape_message, check_covariance, subtract


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


@dataclass(frozen=True, eq=False)
class FilterResult:
    """Everything the filter computed, stacked over T steps.

    x_pred (T, n), P_pred (T, n, n) before the measurement; x (T, n), P (T, n, n) after it; y (T, m) innovation (NaN
    where the measurement is missing), S (T, m, m) its covariance, K (T, n, m) gain (0 where missing), F (T, n, n) the
    transition that led to the step, R (T, m, m) the measurement noise that was used.

    Of many runs at once: x_pred and x are (T, n, runs), y is (T, m, runs); the rest is the same for every run and
    stays as above, without the axis of the runs.
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


@dataclass(frozen=True, eq=False)
class SmootherResult:
    """x (T, n) and P (T, n, n) given all T measurements; G (T - 1, n, n) the smoother's gain."""
    x: np.ndarray
    P: np.ndarray
    G: np.ndarray


def predict(model, x, P, u=None):
    """One step ahead without a measurement: x (n,), P (n, n), u (l,) or None -> Prediction(x_pred, P_pred, F)."""
    x_pred, F = model.transition(x, u)
    P_pred = F @ P @ F.T + model.Q
    return Prediction(x_pred, _symmetric(P_pred), F)


def update(model, x_pred, P_pred, z, R=None):
    """Blend the prediction with the measurement z (m,) -> Update(x, P, y, S, K).

    R (m, m) replaces model.R where it changes in time. P is in Joseph's form, which stays a covariance
    whatever the rounding. A missing measurement has no update: keep the prediction.

    ValueError: z is not (m,) or not finite; R is needed because the model's R changes in time.
    """
    z_pred, H = model.measure(x_pred)
    R = model.R if R is None else R
    if np.shape(z) != z_pred.shape:
        raise ValueError(_shape_message("z", np.shape(z), z_pred.shape))
    if not np.isfinite(z).all():
        raise ValueError(f"z is {z}; expected finite numbers (without a measurement keep the prediction). / "
                         f"z berisi {z}; seharusnya bilangan berhingga (tanpa pengukuran, pakai prediksinya).")
    if np.ndim(R) != 2:
        raise ValueError("R changes in time: pass the R of this step. / R berubah menurut waktu: berikan R langkah ini.")
    y = model.residual(z, z_pred)
    S = H @ P_pred @ H.T + R
    K = np.linalg.solve(S, H @ P_pred).T            # K = P_pred H' S^-1
    x = x_pred + K @ y
    I_KH = np.eye(len(x)) - K @ H
    P = I_KH @ P_pred @ I_KH.T + K @ R @ K.T
    return Update(x, _symmetric(P), y, S, K)


def kalman_filter(model, z, u=None, adapt_R=None):
    """Filter a whole series: every step predicts, then updates.

    model   LinearModel, or NonlinearModel (then this is the extended Kalman filter)
    z       (T, m) measurements; (T,) if m = 1. A row with NaN is a missed measurement: that step predicts only.
            (T, m, runs) filters many runs of one LinearModel at once (a Monte Carlo study); see FilterResult. Needs
            a constant R, the usual residual, no adapt_R and no NaN: then all runs share the same P, S and K.
    u       (T, l) inputs, row k drives the step to k; (T,) if l = 1; common to all runs
    adapt_R function (k, y, HPH, R) -> R of step k, called before the update with the innovation y (m,), the part
            HPH (m, m) of its covariance that comes from the prediction, and the model's R (m, m)

    Returns a FilterResult. ValueError: z or u of the wrong shape, infinite, or u with NaN; many runs where they
    cannot share their gains.
    """
    z = _series("z", z, width=model.R.shape[-1], runs=True)
    _is_complete("z", z)
    if u is not None:
        u = _series("u", u, steps=len(z))
        _is_complete("u", u)
    if z.ndim == 3:
        return _filter_runs(model, z, u, adapt_R)
    if model.R.ndim == 3 and len(model.R) != len(z):
        raise ValueError(_shape_message("R", model.R.shape, (len(z), *model.R.shape[1:])))
    x, P = model.x0, model.P0
    steps = []
    for k in range(len(z)):
        R = model.R if model.R.ndim == 2 else model.R[k]
        x_pred, P_pred, F = predict(model, x, P, None if u is None else u[k])
        if np.isnan(z[k]).any():
            x, P, y, S, K = _missed(model, x_pred, P_pred, R)
        else:
            if adapt_R is not None:
                R = _adapted(adapt_R, k, model, x_pred, P_pred, z[k], R)
            x, P, y, S, K = update(model, x_pred, P_pred, z[k], R)
        steps.append((x_pred, P_pred, x, P, y, S, K, F, R))
    return FilterResult(*(np.array(column) for column in zip(*steps)))


def rts_smooth(result):
    """Run back over a FilterResult of one run, so that every estimate knows the later measurements -> SmootherResult."""
    if result.x.ndim != 2:
        raise ValueError("rts_smooth takes one run, x of shape (T, n); smooth run by run. / "
                         "rts_smooth menerima satu percobaan, x berukuran (T, n); haluskan satu per satu.")
    x, P = result.x.copy(), result.P.copy()
    T, n = x.shape
    G = np.empty((T - 1, n, n))
    for k in reversed(range(T - 1)):
        G[k] = _solve(result.P_pred[k + 1], result.F[k + 1] @ result.P[k]).T    # G = P F' P_pred^-1
        x[k] = result.x[k] + G[k] @ (x[k + 1] - result.x_pred[k + 1])
        P[k] = _symmetric(result.P[k] + G[k] @ (P[k + 1] - result.P_pred[k + 1]) @ G[k].T)
    return SmootherResult(x, P, G)


def _filter_runs(model, z, u, adapt_R):
    """z (T, m, runs): P, S and K do not depend on what is measured, so they are computed once, by the loop above."""
    if not isinstance(model, LinearModel) or model.R.ndim != 2 or model.residual is not subtract or adapt_R is not None:
        raise ValueError("z of shape (T, m, runs) needs a LinearModel with constant R and the usual residual, and no "
                         "adapt_R; filter run by run. / z berukuran (T, m, runs) memerlukan LinearModel dengan R "
                         "tetap dan residu biasa, tanpa adapt_R; filterlah satu per satu.")
    if np.isnan(z).any():
        raise ValueError("z of shape (T, m, runs) holds NaN: a missed measurement has another gain; filter run by run. / "
                         "z berukuran (T, m, runs) memuat NaN: pengukuran yang hilang mengubah penguatan; "
                         "filterlah satu per satu.")
    T, m, runs = z.shape
    shared = kalman_filter(model, np.zeros((T, m)))
    x_pred, x, y = np.empty((T, len(model.x0), runs)), np.empty((T, len(model.x0), runs)), np.empty(z.shape)
    before = np.repeat(model.x0[:, np.newaxis], runs, axis=1)
    for k in range(T):
        drive = model.transition(np.zeros_like(model.x0), None if u is None else u[k])[0]      # B u
        x_pred[k] = model.F @ before + drive[:, np.newaxis]
        y[k] = z[k] - model.H @ x_pred[k]
        x[k] = before = x_pred[k] + shared.K[k] @ y[k]
    return replace(shared, x_pred=x_pred, x=x, y=y)


def _missed(model, x_pred, P_pred, R):
    """A step without a measurement keeps its prediction."""
    z_pred, H = model.measure(x_pred)
    return Update(x_pred, P_pred, np.full(len(z_pred), np.nan), H @ P_pred @ H.T + R, np.zeros(H.T.shape))


def _adapted(adapt_R, k, model, x_pred, P_pred, z, R):
    """The R that adapt_R wants at step k, checked."""
    z_pred, H = model.measure(x_pred)
    R_k = np.asarray(adapt_R(k, model.residual(z, z_pred), H @ P_pred @ H.T, R), dtype=float)
    if R_k.shape != R.shape:
        raise ValueError(_shape_message(f"R from adapt_R at step {k}", R_k.shape, R.shape))
    check_covariance(f"R from adapt_R at step {k}", R_k, definite=True)
    return R_k


def _symmetric(P):
    return (P + P.swapaxes(-1, -2)) / 2


def _solve(A, b):
    """A^-1 b; for a singular A (a state known exactly) the least-squares answer."""
    try:
        return np.linalg.solve(A, b)
    except np.linalg.LinAlgError:
        return np.linalg.pinv(A) @ b


def _series(name, values, width=None, steps=None, runs=False):
    """z or u as a float array of shape (T, width), with runs=True also (T, width, runs); what it holds: _is_complete."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must hold numbers only. / {name} hanya boleh berisi bilangan.") from None
    if array.ndim == 1 and width in (1, None):
        array = array[:, np.newaxis]
    expected = ("T" if steps is None else steps, "l" if width is None else width)
    if array.ndim not in ((2, 3) if runs else (2,)) or array.size == 0 or array.shape[1] != (width or array.shape[1]) \
            or len(array) != (steps or len(array)):
        wanted = f"({expected[0]}, {expected[1]})" + (f" or ({expected[0]}, {expected[1]}, runs)" if runs else "")
        raise ValueError(_shape_message(name, array.shape, wanted))
    return array


def _is_complete(name, array):
    """Is every number of z or u finite? ValueError if one is infinite, or if u holds NaN."""
    with np.errstate(over="ignore", invalid="ignore"):
        if math.isfinite(np.add.reduce(array, axis=None)):          # one look at each; very large ones need another
            return True
    wrong = np.isinf(array) if name == "z" else ~np.isfinite(array)
    if wrong.any():
        k = int(np.argwhere(wrong)[0, 0])
        raise ValueError(f"{name}[{k}] is {array[k]}; expected finite numbers. / "
                         f"{name}[{k}] berisi {array[k]}; seharusnya bilangan berhingga.")
    return not np.isnan(array).any()
