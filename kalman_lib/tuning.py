"""From the data to the model: how likely is it, which numbers fit it best, and is the filter right?

Sources: the likelihood through the innovations, Schweppe (1965); whiteness, Ljung and Box (1978);
the step of a continuous model, Van Loan (1978).
"""

import inspect
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from .checks import check_covariance, finite_array
from .fast import for_likelihood
from .filters import update
from .many import run_of
from .models import LinearModel, subtract
from .numeric import (
    almost_singular,
    check_derivatives,
    check_settles,
    check_start,
    log_density,
    maximise,
    sensor_by_sensor,
    settle,
    time_step,
)

# --- how likely are the measurements? -----------------------------------------------------------


def log_likelihood(result):
    """ln of the density of all measurements under the filter that made the FilterResult.

    The innovations are independent, y ~ N(0, S), so their log-densities add up:
    -(ln det(2 pi S) + y' S^-1 y) / 2 at each step. Only what was measured counts: NaN in y (a
    silent sensor) and an infinite variance in S (R = inf) leave the rest of the row. An innovation
    that a gate left out does not count either (its y is NaN).

    y (T, m), S (T, m, m) -> a number; y (T, m, runs), S (T, m, m) or (T, m, m, runs) -> (runs,).
    ValueError: an S that is no covariance.
    """
    y, S = np.asarray(result.y), np.asarray(result.S)
    many = y.ndim == 3
    if getattr(result, "start", None) is not None and almost_singular(S):
        runs = [run_of(result, run) for run in range(y.shape[2])] if many else [result]
        total = np.array([sensor_by_sensor(run) for run in runs])
    else:
        y = np.moveaxis(y, 2, 1) if many else y[:, np.newaxis]  # (T, runs, m)
        S = np.moveaxis(S, 3, 1) if S.ndim == 4 else S[:, np.newaxis]
        total = log_density(y, S)
    return total if many else float(total[0])


# --- which model makes them most likely? --------------------------------------------------------


def fit(build, start, z, u=None, free=()):
    """Maximum likelihood: the named parameters under which the measurements are most likely.

    build(**parameters) -> model; start {name: positive value}, in the units of the model; z, u as
    for kalman_filter (many runs: their log-likelihoods add up). A parameter named in `free` may be
    zero or negative. All are sought from 1e-12 to 1e12 times their start: see `numeric.maximise`.

    Returns a Fit. ValueError: a start that is not positive, names that build does not take; what is
    wrong with the model or the data at the start.
    """
    check_start(start, free)
    try:
        inspect.signature(build).bind(**start)
    except TypeError:
        raise ValueError(
            f"build does not take exactly the names of start: {list(start)}. / "
            f"build tidak menerima tepat nama-nama di start: {list(start)}."
        ) from None

    def likelihood(**values):
        result = for_likelihood(build(**values), z, u)
        if not np.isfinite(result.x).all():
            return -np.inf  # a model that overflows explains nothing
        return np.sum(log_likelihood(result))

    found = maximise(likelihood, start, free)
    return replace(found, model=build(**found.values))


# --- are the innovations white? -----------------------------------------------------------------


class Whiteness(NamedTuple):
    """lags (L,), the correlation (L,) there, its 95 % band, and p of the test of all lags together.

    Of several sensors: correlation (L, m), band (m,), p (m,), each sensor for itself.
    """

    lags: np.ndarray
    correlation: np.ndarray
    band: Any
    p: Any


def whiteness(y, lags=None):
    """Autocorrelation of the innovations y (T,) or (T, m), and the test of Ljung and Box.

    The innovations of a right filter are white: 95 % of the correlations lie within +-band, and p
    falls below 0.05 in one case of 20 only. While a filter settles, the variance of y changes:
    divide y by the root of S, or leave its first steps out. A pair with a gap (NaN) adds nothing; a
    lag without any pair is NaN and not tested.

    lags: how many; by default 10, or a fifth of T. ValueError: too few values, or all equal.
    """
    y = finite_array("y", y, gaps=True)
    columns = y.reshape(len(y), -1).T if y.ndim in (1, 2) and y.size else []
    lags = min(10, max(y.shape[0] // 5, 1)) if lags is None and y.ndim else lags
    if not isinstance(lags, (int, np.integer)):
        lags = 0  # refused below
    varies = [len(set(c[np.isfinite(c)])) > 1 for c in columns]
    if not varies or not 0 < lags < len(y) or not all(varies):
        raise ValueError(
            "y must be (T,) or (T, m), T above lags, and vary in each column. / "
            "y harus berukuran (T,) atau (T, m), T di atas lags, dan berubah di "
            "setiap kolom."
        )
    found = zip(*(_ljung_box(column, lags) for column in columns))
    found = [values[0] if y.ndim == 1 else np.array(values).T for values in found]
    return Whiteness(np.arange(1, lags + 1), *found)


def _ljung_box(y, lags):
    """correlation (lags,), band and p of one column y (T,)."""
    from scipy.special import gammaincc

    seen = np.isfinite(y)
    e = np.where(seen, y - y[seen].mean(), 0)
    N = seen.sum()
    pairs = np.array([(seen[k:] & seen[:-k]).sum() for k in range(1, lags + 1)])
    products = np.array([e[k:] @ e[:-k] for k in range(1, lags + 1)])
    tested = pairs > 0
    correlation = np.where(tested, products / (e @ e), np.nan)
    chi2 = N * (N + 2) * np.sum(correlation[tested] ** 2 / pairs[tested])
    return correlation, 1.959963984540054 / np.sqrt(N), gammaincc(tested.sum() / 2, chi2 / 2)


# --- the filter that has settled ----------------------------------------------------------------


class Steady(NamedTuple):
    """P_pred (n, n), P (n, n), S (m, m) and K (n, m) where they no longer change."""

    P_pred: np.ndarray
    P: np.ndarray
    S: np.ndarray
    K: np.ndarray


def steady(model):
    """Where the filter of a LinearModel settles: the solution of the Riccati equation -> Steady.

    ValueError: a NonlinearModel, or one that changes in time; a state that no sensor ever sees; a
    constant without process noise, which is known ever better.
    """
    from scipy.linalg import solve_discrete_are

    if not isinstance(model, LinearModel):
        raise ValueError(
            "steady needs a LinearModel, whose F and H do not change with x. / "
            "steady memerlukan LinearModel, yang F dan H-nya tidak berubah bersama x."
        )
    F, H, Q, R = model.F, model.H, model.Q, model.R
    if max(M.ndim for M in (F, H, Q, R)) > 2 or not np.isfinite(R).all():
        raise ValueError(
            "F, H, Q or R changes in time or is infinite: no filter settles. / "
            "F, H, Q, atau R berubah-ubah atau takhingga: filternya tidak menetap."
        )
    check_settles(F, H, Q)
    try:
        P_pred = settle(F, H, Q, R, solve_discrete_are(F.T, H.T, Q, R))
    except np.linalg.LinAlgError:
        raise ValueError(
            "No steady state: some state is hardly seen or hardly moved. / Tidak ada "
            "keadaan tunak: ada yang hampir tak terlihat atau tak bergerak."
        ) from None
    settled = update(model, model.x0, P_pred, H @ model.x0)
    return Steady(P_pred, settled.P, settled.S, settled.K)


# --- from continuous time to a step -------------------------------------------------------------


def discretise(A, Qc, dt, Bc=None):
    """F and Q of a step dt of dx/dt = A x + Bc u + noise; with Bc also B, for u held over the step.

    A (n, n) per second; Qc (n, n) spectral density of the noise, unit of x squared per second;
    dt s, a number, or (T,) for uneven steps; Bc (n, l) per second.
    F = exp(A dt), Q = integral of exp(A s) Qc exp(A s)' over the step (Van Loan, 1978).

    -> F, Q or F, Q, B; for dt (T,) each (T, ., .). ValueError: shapes, Qc no covariance, dt <= 0.
    """
    n = len(np.atleast_1d(A))
    A = finite_array("A", A, (n, n))
    Qc = finite_array("Qc", Qc, (n, n))
    check_covariance("Qc", Qc)
    l = 0 if Bc is None else np.atleast_2d(Bc).shape[-1]
    drive = finite_array("Bc", np.zeros((n, 0)) if Bc is None else Bc, (n, l))
    seconds = finite_array("dt", dt)
    if seconds.ndim > 1 or seconds.size == 0 or not (seconds > 0).all():
        raise ValueError(
            "dt must be a number of seconds above 0, or (T,) of them. / "
            "dt harus bilangan detik di atas 0, atau (T,) bilangan semacam itu."
        )
    different, which = np.unique(seconds, return_inverse=True)
    steps = [time_step(A, Qc, drive, h) for h in different]
    F, Q, B = (np.array(column)[which.reshape(seconds.shape)] for column in zip(*steps))
    if not np.isfinite(F).all():
        raise ValueError(
            "dt is too long: F = exp(A dt) overflows. / "
            "dt terlalu panjang: F = exp(A dt) melampaui batas bilangan."
        )
    return (F, Q) if Bc is None else (F, Q, B)


# --- are the Jacobians right? -------------------------------------------------------------------


class Jacobians(NamedTuple):
    """F (n, n) and H (m, n) by central differences, and how far the model's own are from them."""

    F: np.ndarray
    H: np.ndarray
    F_error: np.ndarray
    H_error: np.ndarray


def check_jacobians(model, x, u=None):
    """Compare F and H of a model at x (n,) with central differences of f and h -> Jacobians.

    h is compared through the model's residual, so an angle may wrap. ValueError: names the entry
    that is off by more than 1e-5 of its value and what rounding allows, and what it should be.
    """
    x = finite_array("x", x, model.x0.shape)
    F, F_error = check_derivatives("F", "f(x, u)", lambda x: model.transition(x, u), x, subtract)
    H, H_error = check_derivatives("H", "h(x, u)", lambda x: model.measure(x, u), x, model.residual)
    return Jacobians(F, H, F_error, H_error)
