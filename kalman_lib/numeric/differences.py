"""The derivatives of a function by central differences, with the step that suits each entry."""

import numpy as np


def check_derivatives(name, function, values, x, residual):
    """The numerical Jacobian (m, n) of values(x)[0], and its distance from values(x)[1].

    ValueError: an entry of values(x)[1], the matrix of that name, is too far from it.
    """
    value, given = values(x)
    numeric, doubt = _differences(lambda x: values(x)[0], x, value, residual)
    if not np.isfinite(numeric).all():
        raise ValueError(
            f"{function} is not finite at x or beside it. / "
            f"{function} tidak berhingga di x atau di sebelahnya."
        )
    error = np.abs(given - numeric)
    excess = error / (1e-5 * np.abs(numeric) + 10 * doubt + 1e-300)
    excess = np.where(np.isnan(excess), np.inf, excess)
    i, j = map(int, np.unravel_index(np.argmax(excess), excess.shape))
    if excess[i, j] > 1:
        entry, is_, be = f"{name}[{i}, {j}]", f"{given[i, j]:.6g}", f"{numeric[i, j]:.6g}"
        raise ValueError(
            f"{entry} is {is_}, but central differences of {function} give {be}. / "
            f"{entry} bernilai {is_}, tetapi selisih pusat {function} memberi {be}."
        )
    return numeric, error


@np.errstate(all="ignore")
def _differences(function, x, value, residual):
    """Central differences (m, n) of function at x, and how far each can be trusted (m, n).

    Every step from large to tiny is tried, each a quarter of the one before; for each entry that
    one counts which differs least from the next, plus what rounding does to it.
    """
    numeric = np.empty((len(value), len(x)))
    doubt = np.empty_like(numeric)
    for j, x_j in enumerate(np.abs(x)):
        largest = 0.1 * max(x_j, 1)
        smallest = 1e-8 * np.clip(x_j or 1, 1e-12, 1)
        h = largest / 4.0 ** np.arange(np.log(largest / smallest) / np.log(4) + 1)
        slopes = [_slope(function, x, j, h_k, residual) for h_k in h]
        D = np.array([np.broadcast_to(slope, len(value)) for slope in slopes])
        rounding = 1e-15 * (np.abs(value) + np.abs(D[1:]) * x_j) / h[1:, np.newaxis]
        trust = np.abs(D[:-1] - D[1:]) + rounding
        best = np.argmin(np.where(np.isnan(trust), np.inf, trust), axis=0)
        entries = np.arange(len(value))
        numeric[:, j] = D[best + 1, entries]
        doubt[:, j] = trust[best, entries]
    return numeric, doubt


def _slope(function, x, j, h, residual):
    """(function(x + h) - function(x - h)) / (2 h) by coordinate j; NaN outside of its domain."""
    up, down = x.copy(), x.copy()
    up[j] += h
    down[j] -= h
    try:
        return residual(function(up), function(down)) / (up[j] - down[j])
    except (ValueError, ArithmeticError):
        return np.nan
