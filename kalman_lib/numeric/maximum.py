"""The top of a function of named numbers, and how well it is known."""

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

SPAN = 1e12  # a positive parameter is sought from start / SPAN to start * SPAN
FLAT = 1e-6  # a difference of log-likelihood that no data can tell from none
DROP = 1e-3  # the fall of log-likelihood over one step of the second differences
WEAK = 3e-6  # below this lies the rounding of second differences


@dataclass(frozen=True, eq=False, repr=False)
class Fit:
    """The most likely parameters.

    values, errors  name -> value and its standard error: inf where the likelihood does not depend
                    on the parameter (alone), NaN at a bound
    log_likelihood  at the maximum
    at_bound        names of the parameters that stopped at a bound: their maximum lies beyond
    bounds          name -> (lowest, highest) that was sought
    peaks           the log-likelihoods that the searches from the several starts have reached
    model           build(**values); None from `maximise`
    """

    values: dict
    errors: dict
    log_likelihood: float
    at_bound: tuple
    bounds: dict
    peaks: tuple
    model: Any = None

    def __str__(self):
        lines = []
        for name, value in self.values.items():
            if name in self.at_bound:
                sign = "≤" if value == self.bounds[name][0] else "≥"
                lines.append(f"{name} {sign} {value:.6g}")
            else:
                lines.append(f"{name} = {value:.6g} ± {self.errors[name]:.2g}")
        return "\n".join([*lines, f"ln L = {self.log_likelihood:.4f}"])

    __repr__ = __str__


def maximise(likelihood, start, free=(), factors=(100, 0.01)):
    """The maximum of a log-likelihood of named numbers: likelihood(**values) -> number.

    Positive parameters are sought by their logarithm, from 1e-12 to 1e12 times their start; those
    named in `free` as they are, anywhere. SciPy's L-BFGS-B climbs from the start and from the three
    likeliest of the starts with one positive parameter multiplied by one of the factors (none: from
    the start alone). Standard errors: roots of the diagonal of the inverse matrix of curvature at
    the top, brought from the logarithm to the parameter by the delta method (value times error).

    Returns a Fit. ValueError: a bad start, or one without any likelihood.
    """
    check_start(start, free)
    surface = _Surface(likelihood, start, free)
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        starts = _starts(surface, factors)
        tops = [surface.climb(v) for v in starts]
        peaks = [surface.height(v) for v in tops]
        v = tops[int(np.argmax(peaks))]
        v, inside = _to_bounds(surface, v)
        v, sigma = _polish(surface, v, inside)
    values = surface.values(v)
    slope = np.where(surface.positive, list(values.values()), 1)
    errors = dict(zip(values, (sigma * slope).tolist()))
    at_bound = tuple(name for name, free_to_move in zip(values, inside) if not free_to_move)
    ends = zip(surface.values(surface.low).values(), surface.values(surface.high).values())
    return Fit(values, errors, surface.height(v), at_bound, dict(zip(values, ends)), tuple(peaks))


class _Surface:
    """The log-likelihood over v (k,): logarithms of positive parameters, free ones as they are."""

    def __init__(self, likelihood, start, free):
        self.likelihood = likelihood
        self.names = list(start)
        self.positive = np.array([name not in free for name in start])
        values = np.array(list(start.values()), dtype=float)
        self.start = np.where(self.positive, np.log(np.where(self.positive, values, 1)), values)
        reach = np.where(self.positive, np.log(SPAN), np.inf)
        self.low = self.start - reach
        self.high = self.start + reach

    def values(self, v):
        """{name: value} of v."""
        numbers = [np.exp(a) if positive else a for a, positive in zip(v, self.positive)]
        return dict(zip(self.names, map(float, numbers)))

    def height(self, v):
        """The log-likelihood at v; -inf where the model breaks down."""
        try:
            L = float(self.likelihood(**self.values(v)))
        except (ValueError, ArithmeticError):
            return -np.inf
        return L if np.isfinite(L) else -np.inf

    def climb(self, v):
        """The top that L-BFGS-B reaches from v."""
        from scipy.optimize import minimize

        found = minimize(
            lambda v: min(-self.height(v), 1e100),
            v,
            method="L-BFGS-B",
            jac="3-point",
            bounds=list(zip(self.low, self.high)),
            options={"ftol": 1e-12, "gtol": 1e-6, "maxiter": 500},
        )
        return found.x if self.height(found.x) >= self.height(v) else v

    def moved(self, v, *moves):
        """The height at v with h added to coordinate i, for every (i, h)."""
        v = v.copy()
        for i, h in moves:
            v[i] += h
        return self.height(v)


def _starts(surface, factors):
    """The start and the three likeliest of those around it."""
    others = []
    for i in np.flatnonzero(surface.positive):
        for factor in factors:
            v = surface.start.copy()
            v[i] += np.log(factor)
            others.append(v)
    others.sort(key=surface.height, reverse=True)
    starts = [v for v in [surface.start, *others[:3]] if surface.height(v) > -np.inf]
    if not starts:
        surface.likelihood(**surface.values(surface.start))  # which may say why
        raise ValueError(
            "start: the measurements have no likelihood there, nor near. / start: "
            "pengukuran tidak mempunyai kebolehjadian di sana maupun di dekatnya."
        )
    return starts


def _to_bounds(surface, v):
    """v with every parameter at its bound that is no less likely there; which are inside (k,)."""
    v = v.copy()
    inside = np.ones(len(v), dtype=bool)
    for i in np.flatnonzero(surface.positive):
        enough = surface.height(v) - FLAT
        ends = [
            end
            for end in (surface.low[i], surface.high[i])
            if surface.moved(v, (i, end - v[i])) >= enough
        ]
        if len(ends) == 1:  # both: the likelihood does not depend on it
            v[i] = ends[0]
            inside[i] = False
    return v, inside


def _polish(surface, v, inside):
    """Newton's steps to the very top, and the standard errors of v (k,) by the curvature there."""
    sigma = np.full(len(v), np.nan)
    i = np.flatnonzero(inside)
    for _ in range(4):
        slope, curvature = _derivatives(surface, v, i)
        covariance, sigma[i] = _inverse(curvature)
        step = np.zeros(len(v))
        step[i] = covariance @ slope
        top = surface.height(v)
        if not surface.height(v + step) >= top - 1e-12 * abs(top):
            break
        v = np.clip(v + step, surface.low, surface.high)
        if (np.abs(step[i]) <= 1e-5 * sigma[i]).all():
            break
    return v, sigma


def _derivatives(surface, v, inside):
    """Slope (k,) and minus the second derivatives (k, k) of the height, by central differences."""
    top = surface.height(v)
    h = [_step(surface, v, i, top) for i in inside]
    slope = np.zeros(len(h))
    curvature = np.zeros((len(h), len(h)))
    for a, i in enumerate(inside):
        near = h[a] / 10
        slope[a] = (surface.moved(v, (i, near)) - surface.moved(v, (i, -near))) / (2 * near)
        fall = 2 * top - surface.moved(v, (i, h[a])) - surface.moved(v, (i, -h[a]))
        curvature[a, a] = fall / h[a] ** 2 if fall > 1e-9 * (1 + abs(top)) else 0
        for b, j in enumerate(inside[:a]):
            corners = [
                s * t * surface.moved(v, (i, s * h[a]), (j, t * h[b]))
                for s in (1, -1)
                for t in (1, -1)
            ]
            curvature[a, b] = curvature[b, a] = -sum(corners) / (4 * h[a] * h[b])
    return slope, curvature


def _step(surface, v, i, top):
    """A step of coordinate i over which the height falls by about DROP."""
    h = 1e-3
    for _ in range(8):
        fall = top - (surface.moved(v, (i, h)) + surface.moved(v, (i, -h))) / 2
        factor = np.sqrt(DROP / fall) if fall > 0 else 100
        h = float(h * np.clip(factor, 1e-3, 100))
        if surface.positive[i]:
            h = min(h, 0.5)
        if 0.5 < factor < 2:
            break
    return h


def _inverse(curvature):
    """The covariance (k, k) in the directions that the data knows, and the standard errors (k,)."""
    d = np.sqrt(np.diagonal(curvature))
    known = d > 0
    d = np.where(known, d, 1)
    C = np.where(np.outer(known, known), curvature / np.outer(d, d), 0)
    eigenvalues, V = np.linalg.eigh(C)
    strong = eigenvalues > WEAK
    covariance = (V[:, strong] / eigenvalues[strong]) @ V[:, strong].T / np.outer(d, d)
    weak = (np.abs(V[:, ~strong]) > 1e-3).any(axis=1)
    return covariance, np.where(weak, np.inf, np.sqrt(np.diagonal(covariance)))


def check_start(start, free):
    """ValueError unless start is {name: number}, positive where the name is not in free."""
    if not isinstance(start, dict) or not start:
        raise ValueError(
            "start must be a dict of names and values. / "
            "start harus berupa dict berisi nama dan nilai."
        )
    for name in free:
        if name not in start:
            raise ValueError(
                f"free names {name!r}, which start does not hold. / "
                f"free menyebut {name!r}, yang tidak ada di start."
            )
    for name, value in start.items():
        number = isinstance(value, (int, float, np.number)) and np.isfinite(value)
        if not number or (name not in free and not value > 0):
            raise ValueError(
                f"{name} = {value!r}: the start must be a number above 0. / "
                f"{name} = {value!r}: nilai awal harus bilangan di atas 0."
            )
