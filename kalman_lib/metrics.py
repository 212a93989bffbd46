"""How good is an estimate, and does the filter know how good it is?

NEES and NIS: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 5.4.
Many runs at once are a last axis of x_true, x and y: (T, n, runs), (T, m, runs).
"""
import re

import numpy as np


def rmse(x_true, x):
    """Root mean square error over time, unit of x: (T, n) -> (n,); (T,) -> a number; (T, n, runs) -> (n, runs)."""
    x_true, x = np.asarray(x_true, dtype=float), np.asarray(x, dtype=float)
    if x_true.shape != x.shape:
        raise ValueError(f"x has shape {x.shape}, expected {x_true.shape} like x_true. / "
                         f"x berukuran {x.shape}, seharusnya {x_true.shape} seperti x_true.")
    return np.sqrt(np.mean((x_true - x) ** 2, axis=0))


def nees(x_true, x, P):
    """Normalised estimation error squared, (x_true - x)' P^-1 (x_true - x): (T, n), (T, n), (T, n, n) -> (T,), of many
    runs (T, runs). If P is honest, its mean is n. P must be invertible: no state known exactly."""
    return _quadratic(np.asarray(x_true, dtype=float) - x, P)


def nis(y, S):
    """Normalised innovation squared, y' S^-1 y: (T, m), (T, m, m) -> (T,), of many runs (T, runs); NaN where z is
    missing. If S is honest, its mean is m. It needs no truth."""
    return _quadratic(np.asarray(y, dtype=float), S)


def _quadratic(e, P):
    columns = e if e.ndim == 3 else e[..., np.newaxis]
    squares = np.einsum("kir,kir->kr", columns, np.linalg.solve(P, columns))
    return squares if e.ndim == 3 else squares[:, 0]


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
