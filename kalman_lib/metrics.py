"""How good is an estimate, and does the filter know how good it is?

NEES and NIS: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and
Navigation, 5.4. Many runs at once are a last axis of x_true, x and y: (T, n, runs), (T, m, runs).
"""

import re

import numpy as np

from .checks import numbers
from .numeric import normalised_squares


def rmse(x_true, x):
    """Root mean square error over time, unit of x.

    (T, n) -> (n,); (T,) -> a number; (T, n, N) -> (n, N).
    """
    x_true, x = _pair("x_true", x_true, "x", x)
    return np.sqrt(np.mean((x_true - x) ** 2, axis=0))


def nees(x_true, x, P):
    """Normalised estimation error squared, (x_true - x)' P^-1 (x_true - x).

    (T, n), (T, n), (T, n, n) -> (T,). Of many runs x is (T, n, N), P (T, n, n) or (T, n, n, N), and
    the answer (T, N). If P is honest, the mean is n.
    ValueError: shapes that do not fit, a P that cannot be inverted (a state known exactly).
    """
    x_true, x = _pair("x_true", x_true, "x", np.broadcast_to(x, np.shape(x_true)))
    return normalised_squares("P", x_true - x, P)


def nis(y, S):
    """Normalised innovation squared, y' S^-1 y, which needs no truth.

    (T, m), (T, m, m) -> (T,); of many runs (T, N). Sensors that are silent at a step (NaN in y) do
    not count, so that the degrees of freedom vary from step to step: `degrees_of_freedom(y)` gives
    them, and if S is honest they are the mean of the NIS. NaN where all are silent.
    """
    return normalised_squares("S", numbers("y", y, 1), S)


def degrees_of_freedom(y):
    """How many sensors were heard at each step: (T, m) -> (T,), the mean of an honest NIS."""
    y = numbers("y", y)
    if y.ndim < 2:
        y = y.reshape(-1, 1)
    return np.isfinite(y).sum(axis=1)


def _pair(name_a, a, name_b, b):
    """Both as float arrays; ValueError unless they have the same shape."""
    a, b = numbers(name_a, a), numbers(name_b, b)
    if a.shape != b.shape:
        raise ValueError(
            f"{name_b} has shape {b.shape}, expected {a.shape} like {name_a}. / "
            f"{name_b} berukuran {b.shape}, seharusnya {a.shape} seperti {name_a}."
        )
    return a, b


def chi2_bounds(dof, runs=1, probability=0.95):
    """(low, high) between which the mean of `runs` independent NEES or NIS lies.

    dof is n of a NEES, m of a NIS; probability: how sure that is. The sum of the values is
    chi-square with dof * runs degrees of freedom.
    """
    tail = (1 - probability) / 2
    low = chi2_quantile(tail, dof * runs) / runs
    high = chi2_quantile(1 - tail, dof * runs) / runs
    return low, high


def chi2_quantile(p, dof):
    """The value below which a chi-square variable with dof degrees of freedom has probability p.

    ValueError: p is not between 0 and 1, or dof not above 0.
    """
    if not 0 < p < 1 or not dof > 0:
        raise ValueError(
            f"p = {p} and dof = {dof}: expected 0 < p < 1 and dof > 0. / "
            f"p = {p} dan dof = {dof}: seharusnya 0 < p < 1 dan dof > 0."
        )
    from scipy.special import gammaincinv  # here, so that importing the package loads NumPy alone

    return 2 * float(gammaincinv(dof / 2, p))


def agreement(printed, ours):
    """A table of printed numbers beside ours; they agree (✓) within half of the last digit printed.

    printed is a dict name -> numbers as printed, in one string ("0.88 1.22"); ours a dict name ->
    array with as many entries, or an object with such attributes. ValueError: a printed number is
    no plain decimal, the counts differ.
    """
    lines = []
    for name, text in printed.items():
        values = np.ravel(ours[name] if isinstance(ours, dict) else getattr(ours, name))
        words = text.split()
        if len(words) != len(values):
            raise ValueError(
                f"{name}: {len(words)} numbers printed, {len(values)} ours. / "
                f"{name}: {len(words)} bilangan tercetak, {len(values)} milik kita."
            )
        for i, (word, value) in enumerate(zip(words, values)):
            sign = "✓" if _agrees(name, word, value) else "✗"
            lines.append(f"{f'{name}[{i}]':12}{word:>12}{value:14.6f}   {sign}")
    return "\n".join(lines)


def _agrees(name, word, value):
    """Is the value within half of the last digit of the printed word?"""
    if not re.fullmatch(r"-?\d+(\.\d+)?", word):
        raise ValueError(
            f"{name}: {word!r} is no plain decimal number. / "
            f"{name}: {word!r} bukan bilangan desimal."
        )
    decimals = word.partition(".")[2]
    half_a_digit = 0.5 * 10.0 ** -len(decimals)
    return abs(float(word) - value) <= half_a_digit * (1 + 1e-9)
