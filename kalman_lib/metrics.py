"""How good is an estimate, and does the filter know how good it is?

NEES and NIS: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 5.4.
Many runs at once are a last axis of x_true, x and y: (T, n, runs), (T, m, runs).
"""
import re

import numpy as np

from .checks import numbers, shape_message

SINGULAR = 1e-13        # an eigenvalue of correlations that is nothing but rounding


def rmse(x_true, x):
    """Root mean square error over time, unit of x: (T, n) -> (n,); (T,) -> a number; (T, n, N) -> (n, N)."""
    x_true, x = _pair("x_true", x_true, "x", x)
    return np.sqrt(np.mean((x_true - x) ** 2, axis=0))


def nees(x_true, x, P):
    """Normalised estimation error squared, (x_true - x)' P^-1 (x_true - x): (T, n), (T, n), (T, n, n) -> (T,).

    Of many runs x is (T, n, N), P (T, n, n) or (T, n, n, N), and the answer (T, N). If P is honest, the mean is n.
    ValueError: shapes that do not fit, a P that cannot be inverted (a state known exactly).
    """
    x_true, x = _pair("x_true", x_true, "x", np.broadcast_to(x, np.shape(x_true)))
    return _quadratic("P", x_true - x, P)


def nis(y, S):
    """Normalised innovation squared, y' S^-1 y: (T, m), (T, m, m) -> (T,); of many runs (T, N). It needs no truth.

    Sensors that are silent at a step (NaN in y) do not count, so that the degrees of freedom vary from step to step:
    `degrees_of_freedom(y)` gives them, and if S is honest they are the mean of the NIS. NaN where all are silent.
    """
    return _quadratic("S", numbers("y", y, 1), S)


def degrees_of_freedom(y):
    """How many sensors were heard at each step, which is what an honest NIS is on average: (T, m) -> (T,)."""
    return np.isfinite(np.atleast_2d(numbers("y", y).T).T).sum(axis=1)


def _pair(name_a, a, name_b, b):
    """Both as float arrays; ValueError unless they have the same shape."""
    a, b = numbers(name_a, a), numbers(name_b, b)
    if a.shape != b.shape:
        raise ValueError(f"{name_b} has shape {b.shape}, expected {a.shape} like {name_a}. / "
                         f"{name_b} berukuran {b.shape}, seharusnya {a.shape} seperti {name_a}.")
    return a, b


def _quadratic(name, e, P):
    """e' P^-1 e for every step (and run), with what is finite in e alone."""
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
    for run in range(P.shape[3]):               # once, if all runs share P
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
        here = (known == pattern[:, np.newaxis]).all(axis=1)              # (T, N)
        rows = here.any(axis=1)
        if not pattern.any() or not rows.any():
            continue
        found = _solved(name, e[rows][:, pattern], P[rows][:, pattern][:, :, pattern])
        squares[here] = found[here[rows]]
    return squares


def _solved(name, e, P):
    """e' P^-1 e for complete rows e (T, n, N); each component in units of its standard deviation."""
    variance = np.einsum("kii->ki", P)[:, :, np.newaxis]
    sigma = np.sqrt(np.where(variance > 0, variance, 1))
    scaled = e / sigma
    try:
        correlation = P / sigma / sigma.swapaxes(1, 2)
        solved = np.linalg.solve(correlation, scaled)
        if correlation.shape[1] > 1 and np.linalg.eigvalsh(correlation)[:, 0].min() < SINGULAR:
            raise np.linalg.LinAlgError         # rounding alone would decide
        if not (variance > 0).all():
            raise np.linalg.LinAlgError
    except np.linalg.LinAlgError:
        raise ValueError(f"{name} cannot be inverted: a component is known exactly, or two are copies. / "
                         f"{name} tidak dapat dibalik: satu komponen diketahui persis, atau dua sama persis.") from None
    return np.einsum("kir,kir->kr", scaled, solved)


def chi2_bounds(dof, runs=1, probability=0.95):
    """(low, high) between which the mean of `runs` independent NEES (dof = n) or NIS (dof = m) lies with a probability.

    The sum of the values is chi-square with dof * runs degrees of freedom.
    """
    tail = (1 - probability) / 2
    return tuple(chi2_quantile(p, dof * runs) / runs for p in (tail, 1 - tail))


def chi2_quantile(p, dof):
    """The value below which a chi-square variable with dof degrees of freedom lies with probability p.

    ValueError: p is not between 0 and 1, or dof not above 0.
    """
    if not 0 < p < 1 or not dof > 0:
        raise ValueError(f"p = {p} and dof = {dof}: expected 0 < p < 1 and dof > 0. / "
                         f"p = {p} dan dof = {dof}: seharusnya 0 < p < 1 dan dof > 0.")
    from scipy.special import gammaincinv      # here, for importing the package shall cost no more than NumPy
    return 2 * float(gammaincinv(dof / 2, p))


def agreement(printed, ours):
    """A table of a source's printed numbers beside ours; they agree (✓) within half of the last printed digit.

    printed is a dict name -> numbers as printed, in one string ("0.88 1.22"); ours a dict name -> array with as many
    entries, or an object with such attributes. ValueError: a printed number is no plain decimal, the counts differ.
    """
    lines = []
    for name, text in printed.items():
        values = np.ravel(ours[name] if isinstance(ours, dict) else getattr(ours, name))
        words = text.split()
        if len(words) != len(values):
            raise ValueError(f"{name}: {len(words)} numbers printed, {len(values)} ours. / "
                             f"{name}: {len(words)} bilangan tercetak, {len(values)} milik kita.")
        for i, (word, value) in enumerate(zip(words, values)):
            if not re.fullmatch(r"-?\d+(\.\d+)?", word):
                raise ValueError(f"{name}: {word!r} is no plain decimal number. / {name}: {word!r} bukan bilangan desimal.")
            half_a_digit = 0.5 * 10.0 ** -len(word.partition(".")[2])
            agrees = abs(float(word) - value) <= half_a_digit * (1 + 1e-9)
            lines.append(f"{f'{name}[{i}]':12}{word:>12}{value:14.6f}   {'✓' if agrees else '✗'}")
    return "\n".join(lines)
