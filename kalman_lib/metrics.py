"""How good is an estimate, and does the filter know how good it is?

Source of NEES and NIS: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, 5.4.
"""
import math
import re

import numpy as np


def rmse(x_true, x):
    """Root mean square error over time: (T, n) against (T, n) -> (n,); (T,) against (T,) -> a number;
    (T, n, runs) against (T, n, runs) -> (n, runs). Unit of x."""
    x_true, x = np.asarray(x_true, dtype=float), np.asarray(x, dtype=float)
    if x_true.shape != x.shape:
        raise ValueError(f"x has shape {x.shape}, expected {x_true.shape} like x_true. / "
                         f"x berukuran {x.shape}, seharusnya {x_true.shape} seperti x_true.")
    return np.sqrt(np.mean((x_true - x) ** 2, axis=0))


def nees(x_true, x, P):
    """Normalised estimation error squared, (x_true - x)' P^-1 (x_true - x): (T, n), (T, n), (T, n, n) -> (T,).

    Of many runs at once: (T, n, runs), (T, n, runs), (T, n, n) -> (T, runs). If the filter's P is honest, its mean is
    n. P must be invertible (no state known exactly).
    """
    return _quadratic(np.asarray(x_true, dtype=float) - x, P)


def nis(y, S):
    """Normalised innovation squared, y' S^-1 y: (T, m), (T, m, m) -> (T,), NaN where the measurement is missing.

    Of many runs at once: (T, m, runs), (T, m, m) -> (T, runs). Needs no truth. If the filter is consistent, its mean
    is m.
    """
    return _quadratic(y, S)


def chi2_bounds(dof, runs=1, probability=0.95):
    """(low, high) between which the mean of `runs` independent NEES or NIS values lies with that probability.

    dof = n for NEES, m for NIS. The sum of the values is chi-square with dof * runs degrees of freedom.
    """
    tail = (1 - probability) / 2
    return tuple(chi2_quantile(p, dof * runs) / runs for p in (tail, 1 - tail))


def chi2_quantile(p, dof):
    """The value below which a chi-square variable with dof degrees of freedom lies with probability p."""
    if not 0 < p < 1 or not dof > 0:
        raise ValueError(f"p = {p} and dof = {dof}: expected 0 < p < 1 and dof > 0. / "
                         f"p = {p} dan dof = {dof}: seharusnya 0 < p < 1 dan dof > 0.")
    low, high = 0.0, dof + 10 * math.sqrt(2 * dof)
    while chi2_cdf(high, dof) < p:
        high *= 2
    while high - low > 1e-13 * high:            # halve the interval until it has no width left
        middle = (low + high) / 2
        low, high = (middle, high) if chi2_cdf(middle, dof) < p else (low, middle)
    return (low + high) / 2


def chi2_cdf(value, dof):
    """Probability that a chi-square variable stays below value: the regularised incomplete gamma function P(a, x).

    Series below the mean, Lentz's continued fraction above it (Abramowitz and Stegun 6.5.29 and 6.5.31).
    """
    a, x = dof / 2, value / 2
    if x <= 0:
        return 0.0
    front = math.exp(a * math.log(x) - x - math.lgamma(a))
    if x < a + 1:
        term = total = 1 / a
        k = a
        while term > 1e-17 * total:
            k += 1
            term *= x / k
            total += term
        return front * total
    b = x + 1 - a
    c, d = 1e300, 1 / b
    fraction = d
    for i in range(1, 100_000):
        b += 2
        d = 1 / (b + i * (a - i) * d)
        c = b + i * (a - i) / c
        fraction *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return 1 - front * fraction


def agreement(printed, ours):
    """A table that holds a source's printed numbers beside ours: name, printed, ours, and whether they agree.

    printed is a dict name -> numbers as printed, in one string ("0.88 1.22"); ours a dict name -> array with as many
    entries, or an object with such attributes. They agree (✓) if ours lies within half of the last printed digit;
    ValueError if a printed number is not plain decimal (0.88, -3) or the counts differ.
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


def _quadratic(e, P):
    """e' P^-1 e for every row: (T, n), (T, n, n) -> (T,); with runs as last axis (T, n, runs), (T, n, n) -> (T, runs)."""
    e = np.asarray(e, dtype=float)
    columns = e if e.ndim == 3 else e[..., np.newaxis]
    squares = np.einsum("kir,kir->kr", columns, np.linalg.solve(P, columns))
    return squares if e.ndim == 3 else squares[:, 0]
