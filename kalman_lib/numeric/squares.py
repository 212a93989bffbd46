"""e' P^-1 e of many errors e, whatever their units, with what is known of them alone."""

import numpy as np

from ..checks import correlations, numbers, shape_message

SINGULAR = 1e-13  # an eigenvalue of correlations that is nothing but rounding


def normalised_squares(name, e, P):
    """e' P^-1 e for every step (and run), with what is finite in e alone.

    e (T,) or (T, n), P (T, n, n) -> (T,); of many runs e (T, n, N), P (T, n, n) or (T, n, n, N) ->
    (T, N). ValueError: shapes that do not fit, a P (which is called by that name) without inverse.
    """
    P = numbers(name, P)
    if e.ndim == 1:
        e = e[:, np.newaxis]
    size = (len(e), e.shape[1], e.shape[1])
    if e.ndim not in (2, 3) or P.shape not in (size, (*size, *e.shape[2:])):
        raise ValueError(shape_message(name, P.shape, size))
    runs = e if e.ndim == 3 else e[..., np.newaxis]
    if P.ndim == 3:
        P = P[..., np.newaxis]
    squares = np.empty((len(e), runs.shape[2]))
    for run in range(P.shape[3]):  # once, if all runs share P
        part = slice(None) if P.shape[3] == 1 else slice(run, run + 1)
        squares[:, part] = _squares(name, runs[:, :, part], P[..., run])
    return squares if e.ndim == 3 else squares[:, 0]


def _squares(name, e, P):
    """e' P^-1 e for e (T, n, N) and P (T, n, n) -> (T, N), pattern by pattern of what is known."""
    known = np.isfinite(e) & np.isfinite(np.einsum("kii->ki", P))[:, :, np.newaxis]
    if known.all():
        return _solved(name, e, P)
    squares = np.full((len(e), e.shape[2]), np.nan)
    for pattern in np.unique(known.swapaxes(1, 2).reshape(-1, e.shape[1]), axis=0):
        here = (known == pattern[:, np.newaxis]).all(axis=1)  # (T, N)
        rows = here.any(axis=1)
        if not pattern.any() or not rows.any():
            continue
        found = _solved(name, e[rows][:, pattern], P[rows][:, pattern][:, :, pattern])
        squares[here] = found[here[rows]]
    return squares


def _solved(name, e, P):
    """e' P^-1 e for complete rows e (T, n, N); each component in units of its deviation."""
    variance = np.einsum("kii->ki", P)
    sigma = np.sqrt(np.where(variance > 0, variance, 1))
    scaled = e / sigma[:, :, np.newaxis]
    try:
        C = correlations(P, sigma)
        solved = np.linalg.solve(C, scaled)
        several = C.shape[1] > 1
        if several and np.linalg.eigvalsh(C)[:, 0].min() < SINGULAR:
            raise np.linalg.LinAlgError  # rounding alone would decide
        if not (variance > 0).all():
            raise np.linalg.LinAlgError
    except np.linalg.LinAlgError:
        raise ValueError(
            f"{name} cannot be inverted: a component is known exactly, or two are copies. / "
            f"{name} tidak dapat dibalik: satu komponen diketahui persis, atau dua sama persis."
        ) from None
    return np.einsum("kir,kir->kr", scaled, solved)
