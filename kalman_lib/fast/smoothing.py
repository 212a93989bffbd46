"""The smoothers of the fast results, by the equations of Rauch, Tung and Striebel.

That is where P_pred is far from singular. Serves the rows "RTS" of the bench.
"""

import numpy as np

from . import runs
from .lazy import LazySmootherResult, predictions, repeat_last
from .rounding import FAR, LOST, steps_alive, well_conditioned
from .scan import LONG, STEADY, radius, scan


def smooth(result):
    """The SmootherResult of a fast FilterResult, or None where there is no fast form for it."""
    gains = result.__dict__.get("gains")
    if gains is None or len(result.x) == 1 or not well_conditioned(gains.P_pred):
        return None
    T = len(result.x)
    G = _gains(gains)
    if steps_alive(G[-1], T) > LOST:
        return None
    form = _smooth_runs if result.x.ndim == 3 else _smooth_one
    x = form(gains.s, result.x, G)
    if not (np.abs(G).max(axis=0) @ _largest(result.x) <= FAR * _largest(x)).all():
        return None  # large numbers whose differences are small
    return LazySmootherResult.of({"P": lambda: _smooth_P(gains, G, T)}, x=x)


def _largest(x):
    """Of every state, over (some of) the steps and all runs."""
    part = x if x.ndim == 2 else x[:: runs.MANY]
    return np.abs(part).max(axis=tuple(i for i in range(x.ndim) if i != 1))


def _gains(gains):
    """G = P F' P_pred^-1 of the first steps; at later ones it is the last one."""
    P_next = gains.P_pred[1:]
    steps = len(P_next)
    P = repeat_last(gains.P, max(steps, len(gains.P)))[:steps]
    FP = gains.s.F @ P
    return np.linalg.solve(P_next, FP).swapaxes(1, 2)


def _smooth_one(s, x, G):
    """x (T, n) of one run: where G has settled by a scan from the last step, then one by one."""
    k = len(x) - 1
    smooth = x.copy()
    x_pred = predictions(s, x)
    if len(x) - len(G) >= LONG and radius(G[-1]) <= STEADY:
        k = len(G) - 1
        smooth[k:-1] -= x_pred[k + 1 :] @ G[-1].T
        scan(G[-1], smooth[k:-1][::-1], x[-1])
    for i in reversed(range(k)):
        smooth[i] += G[min(i, len(G) - 1)] @ (smooth[i + 1] - x_pred[i + 1])
    return smooth


def _smooth_runs(s, x, G):
    """x (T, n, N) of all runs: x + G (x_next - F x - B u), sorted by what changes."""
    smooth = np.empty_like(x)
    smooth[-1] = x[-1]
    drive = None
    if s.drive is not None:
        drive = -np.einsum("kij,kj->ki", repeat_last(G, len(x) - 1), s.drive[1:])
    runs.steps(G, np.eye(len(s.x0)) - G @ s.F, x[:-1], drive, x[-1], smooth[:-1], backwards=True)
    return smooth


def _smooth_P(gains, G, T):
    """P (T, n, n) of the smoother.

    It settles backwards, too, and changes again where the filter had not settled.
    P + G (P_s_next - P_pred_next) G' = A P A' + G (P_s_next + Q) G' with A = I - G F: nothing is
    subtracted.
    """
    F, Q, k = gains.s.F, gains.s.Q, len(G) - 1
    P = repeat_last(gains.P, max(len(gains.P), len(G)))[: len(G)]
    A = np.eye(len(F)) - G @ F
    own = A @ P @ A.swapaxes(1, 2) + G @ Q @ G.swapaxes(1, 2)
    smooth = np.empty((T, *F.shape))
    smooth[-1] = gains.P[-1]
    limit = 1e-13 * max(1 - radius(G[-1]) ** 2, 0)
    i = T - 2
    while i >= 0:
        j = min(i, k)
        P_i = own[j] + G[j] @ smooth[i + 1] @ G[j].T
        smooth[i] = (P_i + P_i.T) / 2
        if i > k:
            sigma = np.sqrt(np.diag(smooth[i]))
            if (np.abs(smooth[i] - smooth[i + 1]) <= limit * np.outer(sigma, sigma)).all():
                smooth[k:i] = smooth[i]
                i = k
        i -= 1
    return smooth
