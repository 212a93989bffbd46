"""The extended Kalman filter of many runs, entry by entry: every run has its own P, S, K and F.

Serves the row "beetle EKF" of the bench, and the studies of chapter 5. All arrays have the axis of the runs as their
last one: P (T, n, n, N) and so on.
"""
from itertools import repeat

import numpy as np

from ..checks import shape_message
from ..roots import root_of
from . import entries
from .lazy import LazyFilterResult
from .rounding import LOST


def filter_runs(model, z, u):
    """z (T, 1, N), u (T, l) or None -> FilterResult; None where the loop is needed: rounding, or a number not finite."""
    T, _, runs = z.shape
    n = len(model.x0)
    Q = [[q or None for q in row] for row in np.asarray(model.Q).tolist()]
    u = list(repeat(None, T)) if u is None else u
    x = np.empty((T, n, runs))
    steps = []
    x_k, P = np.repeat(model.x0[:, np.newaxis], runs, axis=1), np.asarray(model.P0).tolist()
    for k in range(T):
        x_pred, F = _transition(model, x_k, u[k])
        P_pred = entries.predict(P, entries.sparse(F), Q)
        h, H = _measure(model, x_pred, u[k])
        silent = np.isnan(z[k])
        y = np.where(silent, np.nan, model.residual(z[k], h))
        h_sparse = entries.sparse(H)[0]
        P_before, heard = P, ~silent[0] if silent.any() else None
        P, K, S = entries.update(P_pred, h_sparse, float(model.R[0, 0]), heard)
        if len(h_sparse) != 1 or not np.isfinite(h).all() or _loses_digits(F, P_before, P_pred, P):
            return None
        known = y[0] if heard is None else np.nan_to_num(y[0])
        x_k = x[k]
        for i, K_i in enumerate(K):
            np.add(x_pred[i], K_i * known, out=x_k[i])
        steps.append(([[row] for row in x_pred], P_pred, P, [y], [[S]], [[K_i] for K_i in K], F, H))
    if not np.isfinite(x).all():
        return None
    return _result(model, z, x, steps)


def _result(model, z, x, steps):
    """The FilterResult; what is read is stacked then."""
    T, n, runs = x.shape

    def stacked(i, flat=False):
        """Entry i of every step as an array (T, rows, columns, N)."""
        whole = np.array([[[np.broadcast_to(entry, runs) for entry in row] for row in step[i]] for step in steps])
        return whole[:, :, 0] if flat else whole

    names = ("x_pred", "P_pred", "P", "y", "S", "K", "F", "H")
    later = {name: lambda i=i, name=name: stacked(i, name in ("x_pred", "y")) for i, name in enumerate(names)}
    return LazyFilterResult.of(
        later, x=x, start=root_of(model.P0), gated=np.broadcast_to(False, z.shape),
        Q=np.broadcast_to(model.Q, (T, n, n)), R=np.broadcast_to(model.R, (T, 1, 1)))


@np.errstate(all="ignore")
def _loses_digits(F, before, P_pred, P):
    """Does the step take so much from a variance that its digits are lost (rounding.py), in any of the runs?"""
    sigma = [np.sqrt(before[j][j]) for j in range(len(F))]
    for i, row in enumerate(entries.sparse(F)):
        terms = sum(np.abs(sigma[j] if entry is None else entry * sigma[j]) for j, entry in row)
        lost = np.maximum(terms * terms / P_pred[i][i], P_pred[i][i] / P[i][i])
        if not (lost <= LOST).all():
            return True
    return False


def _transition(model, x, u):
    """f (n, N) and the entries of F, checked."""
    f = np.asarray(model.f(x.copy(), u), dtype=float)           # a copy: f may work in place
    if f.shape != x.shape:
        raise ValueError(shape_message("f(x, u)", f.shape, x.shape))
    return f, _rows("F(x, u)", model.F(x, u), (len(x), len(x)), x.shape[1])


def _measure(model, x, u):
    """h (1, N) and the entries of H, checked."""
    h = np.asarray(model.h(x, u), dtype=float)
    if h.shape != (1, x.shape[1]):
        raise ValueError(shape_message("h(x, u)", h.shape, (1, x.shape[1])))
    return h, _rows("H(x, u)", model.H(x, u), (1, len(x)), x.shape[1])


def _rows(name, M, shape, runs):
    """M as rows of entries, each a number or (N,)."""
    if not any(isinstance(row, (list, tuple, np.ndarray)) for row in M):
        M = [M]                                 # of one sensor, a row alone
    found = (len(M), *{len(row) for row in M})
    if found != shape:
        raise ValueError(shape_message(name, found, shape))
    for row in M:
        for entry in row:
            if np.shape(entry) not in ((), (runs,)):
                raise ValueError(shape_message(f"{name}[...]", np.shape(entry), (runs,)))
    return M
