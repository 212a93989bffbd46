"""One series, entry by entry until the gain has settled, and from there on in one go.

Serves the rows "2-state" of the bench.
"""

from itertools import repeat

import numpy as np

from .. import filters
from ..models import LinearModel
from . import blocks, entries, rounding
from .lazy import Gains, repeat_last, result_of
from .numbers import filter_number
from .scan import LONG, STEADY, radius, scan

HEAD = 64  # steps that the loop may take over where a vague start costs digits


def filter_series(s, strict):
    """The FilterResult of one run, or None where the loop is needed.

    strict: that is also where the data lie far from zero.
    """
    if s.silent is not None and s.silent.all(axis=0).any():
        return None  # a sensor that never speaks
    parts = s.parts()
    found = [filter_part(part) for _, part in parts]
    if any(answer is None for answer in found):
        return None
    x = np.empty((len(s.z), len(s.x0)))
    for (states, part), (x_part, P) in zip(parts, found):
        x[:, states] = settled(part, x_part, P)
    gains = Gains(s, together(s, parts, [P for _, P in found]))
    if not np.isfinite(x[-1]).all():
        return None  # too large for numbers: the loop says at which step
    result = result_of(gains, x)
    if not strict:
        return result
    size = np.abs(x)
    y = np.abs(result.y)
    usual_y = rounding.usual(y) if s.silent is None else np.nanmedian(y, axis=0)
    near = rounding.near(s, size.max(axis=0), rounding.usual(size), usual_y, gains.P[-1])
    return result if near else None


def together(s, parts, covariances):
    """P (k, n, n) from those of the parts."""
    if len(parts) == 1:
        return covariances[0]
    P = np.zeros((max(map(len, covariances)), *s.F.shape))
    for (states, _), P_part in zip(parts, covariances):
        P[(slice(None), *np.ix_(states, states))] = repeat_last(P_part, len(P))
    return P


def filter_part(s):
    """x (k, n) and P (k, n, n) until P stays as it is; None where the loop is needed."""
    if s.F.shape == s.H.shape == (1, 1):
        return filter_number(s)
    if not is_diagonal(s.R):
        return None
    found = None
    if s.varies and len(s.z) >= blocks.LONG:
        found = with_head(s, blocks.filter_blocks)
    found = found or with_head(s, filter_states)
    if found and len(s.H) > 1 and not rounding.well_conditioned(Gains(s, found[1]).S):
        return None
    return found


def is_diagonal(R):
    """Do the sensors not disturb each other? R (m, m) or (T, m, m)."""
    return not (R * (1 - np.eye(R.shape[-1]))).any()


def with_head(s, form):
    """form(s) -> x, P; where a vague start costs it digits, the loop does the first steps."""
    found = form(s)
    if found is None:
        return None
    costly = np.flatnonzero(rounding.too_much(s, found[1]))
    if len(costly) == 0:
        return found
    head = int(costly[-1]) + 1
    if head > HEAD or head + HEAD > len(s.z):
        return None
    first = by_the_loop(s, head)
    rest = s.after(head, first.x[-1], first.P[-1])
    found = form(rest)
    if found is None or rounding.too_much(rest, found[1]).any():
        return None
    return np.concatenate([first.x, found[0]]), np.concatenate([first.P, found[1]])


def by_the_loop(s, steps):
    """The FilterResult of the first steps."""
    R = s.R if s.R.ndim == 2 else s.R[:steps]
    drive = None if s.drive is None else s.drive[:steps]
    model = LinearModel(s.F, s.H, s.Q, R, s.x0, s.P0, B=np.eye(len(s.x0)))
    return filters.kalman_filter(model, s.z[:steps], drive)


def filter_states(s):
    """A few states, their sensors one after the other -> x (k, n), P (k, n, n)."""
    F, H = entries.sparse(s.F.tolist()), entries.sparse(s.H.tolist())
    Q = [[q or None for q in row] for row in s.Q.tolist()]
    x, P = s.x0.tolist(), s.P0.tolist()
    R = np.einsum("...ii->...i", s.R)
    rows_R = repeat(R.tolist()) if R.ndim == 1 else entries.floats(R)
    rows_drive = repeat(None) if s.drive is None else entries.floats(s.drive)
    states, covariances = [], []
    may_end = not s.varies and len(s.z) >= LONG
    for z_k, R_k, drive_k in zip(entries.floats(s.z), rows_R, rows_drive):
        before = P
        x = [entries.dot(row, x) for row in F]
        if drive_k is not None:
            x = [x_i + drive_i for x_i, drive_i in zip(x, drive_k)]
        x, P = one_step(x, entries.predict(P, F, Q), z_k, H, R_k)
        states.append(x)
        covariances.append(P)
        if may_end and len(states) % 8 == 0 and has_settled(s, P, before):
            break
    return np.array(states), np.array(covariances)


def one_step(x, P, z, H, R):
    """The update with all sensors that are not silent -> x, P."""
    # first all of y, as the loop does it: it keeps digits
    y = [z_i - entries.dot(h, x) for z_i, h in zip(z, H)]
    change = [0.0] * len(x)
    for y_i, h, R_i in zip(y, H, R):
        if y_i == y_i:  # not NaN
            P, k, _ = entries.update(P, h, R_i)
            y_i = y_i - entries.dot(h, change)
            change = [c + k_j * y_i for c, k_j in zip(change, k)]
    return [x_j + c for x_j, c in zip(x, change)], P


def has_settled(s, P, before):
    """Are all changes of P that are still to come, together, below 1e-13 of P?

    The changes shrink by rho^2 from step to step, rho being what a step leaves of an error: their
    sum is the next one times 1 / (1 - rho^2).
    """
    if abs(P[0][0] - before[0][0]) > 1e-13 * P[0][0]:
        return False
    P, before = np.array(P), np.array(before)
    sigma = np.sqrt(np.abs(np.diag(P)))
    change, limit = np.abs(P - before), 1e-13 * np.outer(sigma, sigma)
    if (change > limit).any():
        return False
    rho = radius(s.F - rounding.gain_after(s, P) @ s.H @ s.F)
    return rho <= STEADY and bool((change <= limit * (1 - rho**2)).all())


def settled(s, head, P):
    """x (T, n), of which the first steps are known, head (k, n): from there on the gain is K."""
    k, T = len(head), len(s.z)
    if k == T:
        return head
    K = rounding.gain_after(s, P[-1])
    I_KH = np.eye(len(s.x0)) - K @ s.H
    x = np.empty((T, len(s.x0)))
    x[:k] = head
    x[k:] = s.z[k:] @ K.T
    if s.drive is not None:
        x[k:] += s.drive[k:] @ I_KH.T
    scan(I_KH @ s.F, x[k:], head[-1])
    return x
