"""The extended Kalman filter of many runs, entry by entry: every run has its own P, S, K and F.

Serves the row "beetle EKF" of the bench, and the studies of chapter 5. All arrays have the axis of
the runs as their last one: P (T, n, n, N) and so on.
"""

import functools
from itertools import repeat

import numpy as np

from ..checks import shape_message
from ..roots import root_of
from . import entries
from .lazy import LazyFilterResult
from .rounding import LOST


def filter_runs(model, z, u):
    """z (T, 1, N), u (T, l) or None -> FilterResult.

    None where the loop is needed: rounding, or a number not finite.
    """
    T, _, runs = z.shape
    n = len(model.x0)
    found = _run(model, z, u, keep=False)
    if found is None:
        return None
    x, P = found

    @functools.cache
    def again():  # what is rarely read is computed again
        return _run(model, z, u, keep=True)[1]

    def stacked(steps, i, flat=False):
        """Entry i of every step as an array (T, rows, columns, N)."""
        matrices = [step[i] for step in steps]
        whole = np.array([[[np.broadcast_to(a, runs) for a in row] for row in M] for M in matrices])
        return whole[:, :, 0] if flat else whole

    names = ("P", "x_pred", "P_pred", "y", "S", "K", "F", "H")
    later = {
        name: lambda i=i, name=name: stacked(again(), i, name in ("x_pred", "y"))
        for i, name in enumerate(names)
    }
    later["P"] = lambda: stacked(P, 0)
    return LazyFilterResult.of(
        later,
        x=x,
        start=root_of(model.P0),
        gated=np.broadcast_to(False, z.shape),
        Q=np.broadcast_to(model.Q, (T, n, n)),
        R=np.broadcast_to(model.R, (T, 1, 1)),
    )


def _run(model, z, u, keep):
    """x (T, n, N), and for each step (P,), with keep all that it computed; None as filter_runs."""
    T, _, runs = z.shape
    Q = [[q or None for q in row] for row in np.asarray(model.Q).tolist()]
    u = repeat(None) if u is None else u
    x = np.empty((T, len(model.x0), runs))
    steps = []
    x_k = np.repeat(model.x0[:, np.newaxis], runs, axis=1)
    P = np.asarray(model.P0).tolist()
    for k, u_k in zip(range(T), u):
        x_pred, F = _transition(model, x_k, u_k)
        F_sparse = entries.sparse(F)
        P_pred = entries.predict(P, F_sparse, Q)
        h, H = _measure(model, x_pred, u_k)
        silent = np.isnan(z[k])
        y = np.where(silent, np.nan, model.residual(z[k], h))
        h_sparse = entries.sparse(H)[0]
        heard = ~silent[0] if silent.any() else None
        P_before = P
        P, K, S = entries.update(P_pred, h_sparse, float(model.R[0, 0]), heard)
        sees_one_state = len(h_sparse) == 1
        if not sees_one_state or not np.isfinite(h).all():
            return None
        if _loses_digits(F_sparse, P_before, P_pred, P):
            return None
        known = y[0] if heard is None else np.nan_to_num(y[0])
        x_k = x[k]
        for i, K_i in enumerate(K):
            np.add(x_pred[i], K_i * known, out=x_k[i])
        rest = ([[row] for row in x_pred], P_pred, [y], [[S]], [[K_i] for K_i in K], F, H)
        steps.append((P, *rest) if keep else (P,))
    return (x, steps) if np.isfinite(x).all() else None


@np.errstate(all="ignore")
def _loses_digits(F, before, P_pred, P):
    """Does a step take so much from a variance of a run that its digits are lost (rounding.py)?"""
    for i, row in enumerate(F):
        if not np.max(P_pred[i][i] / P[i][i]) <= LOST:
            return True
        if len(row) > 1:  # a sum, which may be smaller than its terms
            sigma = [np.sqrt(before[j][j]) for j, _ in row]
            terms = sum(np.abs(s if F_ij is None else F_ij * s) for (_, F_ij), s in zip(row, sigma))
            if not np.max(terms * terms / P_pred[i][i]) <= LOST:
                return True
    return False


def _transition(model, x, u):
    """f (n, N) and the entries of F, checked."""
    f = np.asarray(model.f(x.copy(), u), dtype=float)  # a copy: f may work in place
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
        M = [M]  # of one sensor, a row alone
    found = (len(M), *{len(row) for row in M})
    if found != shape:
        raise ValueError(shape_message(name, found, shape))
    for row in M:
        for entry in row:
            if np.shape(entry) not in ((), (runs,)):
                raise ValueError(shape_message(f"{name}[...]", np.shape(entry), (runs,)))
    return M
