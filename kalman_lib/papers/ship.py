"""Chapter 4: the speed of a model ship, AR(2).

Source: "Kalman Filter untuk Pengukuran Kecepatan Kapal", a blog of 2018.
"""

import math
import re
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..models import LinearModel
from ..numeric import maximise
from ..simulate import Trajectory
from ..simulate import simulate as simulate_model
from . import check, param

# All the numbers that the source prints: the settings of its filter. It prints no measurement and
# no result.
PRINTED = {"Q": "0.0001 0 0 0.0001", "R": "0.01", "H": "1 0", "x0": "0 0", "P0": "0.01 0 0 0.01"}

# The SYNTHETIC towing run, which stands in for data that was never published: (seconds, speed at
# the end in m/s). Between two speeds the carriage follows half a cosine wave.
RECIPE = ((5, 0.0), (6, 1.5), (14, 1.5), (6, 0.0), (5, 0.0))
DT = 0.1  # s

SPEED_UNITS = {"m/s": 1.0, "cm/s": 0.01, "km/h": 1 / 3.6, "kn": 1852 / 3600}  # in m/s
TIME_UNITS = {"s": 1.0, "ms": 0.001, "min": 60.0}  # in s


@dataclass(frozen=True)
class Params:
    """c, a1 and a2 come from a fit; the source prints none: these are of our run with seed 2018."""

    # fmt: off
    c: float = param(
        0.0100, min=-1e6, max=1e6, step=0.001, unit="m/s",
        id="konstanta", en="constant",
    )
    a1: float = param(
        0.5517, min=-100, max=100, step=0.01, unit="",
        id="koefisien sampel terakhir", en="coefficient of the last sample",
    )
    a2: float = param(
        0.4365, min=-100, max=100, step=0.01, unit="",
        id="koefisien sampel sebelumnya", en="coefficient of the sample before",
    )
    Q: float = param(
        1e-4, min=1e-10, max=1e2, step=0.1, unit="m²/s²", log=True,
        id="varians derau proses", en="process-noise variance",
    )
    Q_copy: float = param(
        1e-4, min=0, max=1e2, step=0.1, unit="m²/s²", log=True,
        id="varians derau pada salinan (AR(2) sejati: 0)",
        en="noise variance of the copy (a true AR(2): 0)",
    )
    R: float = param(
        0.01, min=1e-8, max=1e4, step=0.1, unit="m²/s²", log=True,
        id="varians derau pengukuran", en="measurement-noise variance",
    )
    x0: float = param(
        0, min=-1e6, max=1e6, step=0.1, unit="m/s",
        id="kecepatan awal", en="initial speed",
    )
    P0: float = param(
        0.01, min=0, max=1e6, step=0.1, unit="m²/s²", log=True,
        id="varians kecepatan awal", en="variance of the initial speed",
    )
    sigma: float = param(
        0.1, min=0, max=0.5, step=0.01, unit="m/s",
        id="derau pada uji penarikan sintetis", en="noise of the synthetic towing run",
    )
    # fmt: on


def model(p):
    """State [speed now, speed one sample before] in m/s; c enters through the input u = 1."""
    check(p)
    return LinearModel(
        F=[[p.a1, p.a2], [1, 0]],
        B=[[p.c], [0]],
        H=[[1, 0]],
        Q=np.diag([p.Q, p.Q_copy]),
        R=p.R,
        x0=[p.x0, p.x0],
        P0=p.P0 * np.eye(2),
    )


def simulate(p, rng, steps=600):
    """A synthetic AR(2) speed with known coefficients, and its measurements -> Trajectory."""
    return simulate_model(model(p), steps, rng, u=np.ones((steps, 1)))


def towing_run(rng, sigma=0.1, dt=DT):
    """The SYNTHETIC towing run of RECIPE, noise sigma (m/s) -> time (T,) in s, Trajectory."""
    pieces, speed = [], 0.0
    for seconds, end in RECIPE:
        s = np.arange(round(seconds / dt)) * dt / seconds  # from 0 to 1
        pieces.append(speed + (end - speed) * (1 - np.cos(np.pi * s)) / 2)
        speed = end
    x = np.concatenate(pieces)
    z = x + rng.normal(0, sigma, len(x))
    return dt * np.arange(len(x)), Trajectory(x[:, np.newaxis], z[:, np.newaxis])


# --- the fit of the source, and what noise does to it -------------------------------------------


def fit(z, invented_rows=False):
    """c, a1, a2 of z_k = c + a1 z_{k-1} + a2 z_{k-2}, by least squares over z (T,).

    Rows with a gap are left out. invented_rows=True adds the source's first two rows, which put 0
    where there was no measurement before. ValueError: too few rows, or a speed so regular
    (constant, a straight line, one exponential) that the three are not unique.
    """
    z = np.asarray(z, dtype=float)
    if invented_rows:
        z = np.concatenate(([0.0, 0.0], z))
    X, now = _regressors(z), z[2:]
    complete = np.isfinite(X).all(axis=1) & np.isfinite(now)
    theta, _, rank, _ = np.linalg.lstsq(X[complete], now[complete])
    if rank < 3:
        raise ValueError(
            "c, a1 and a2 need at least five speeds in a row that do not lie on a line or one "
            "exponential. / c, a1, dan a2 memerlukan sedikitnya lima kecepatan berurutan yang "
            "tidak terletak pada satu garis lurus atau satu eksponensial."
        )
    return theta


def _regressors(x):
    """The rows [1, x_{k-1}, x_{k-2}] of x (T,), one for each sample that has two before it."""
    if len(x) < 3:
        return np.empty((0, 3))
    return np.column_stack([np.ones(len(x) - 2), x[1:-1], x[:-2]])


def fitted(z, p, **options):
    """The Params p with the c, a1 and a2 that `fit` finds in z (T,)."""
    c, a1, a2 = map(float, fit(z, **options))
    return replace(p, c=c, a1=a1, a2=a2)


def expected_fit(x, sigma):
    """What `fit` finds on average if white noise of sigma (m/s) is added to the speed x (T,).

    Errors in variables: the noise adds sigma^2 to the mean squares of both regressors, and nothing
    to any product of different samples.
    """
    X = _regressors(x)
    noise = len(X) * np.diag([0, sigma**2, sigma**2])
    return np.linalg.solve(X.T @ X + noise, X.T @ x[2:])


def poles(a1, a2):
    """The roots l of l^2 - a1 l - a2 = 0, the eigenvalues of F; stable inside the unit circle."""
    root = np.sqrt(complex(a1**2 / 4 + a2))
    return np.array([a1 / 2 + root, a1 / 2 - root])


# --- the remedy: how likely are the measurements? -----------------------------------------------


def quick_filter(z, p):
    """The filter in plain numbers, 50 times as fast as kalman_filter; a test holds them equal.

    z (T,), p a Params -> estimate x, its variance P, innovation y and its variance S, each (T,) and
    of the speed now. `before` is the state's second half, the speed one sample before.
    """
    x, before = p.x0, p.x0
    P = (p.P0, 0.0, p.P0)
    rows, is_settled = [], False
    for z_k in np.asarray(z, dtype=float).tolist():
        x, before = p.c + p.a1 * x + p.a2 * before, x
        if not is_settled:
            last = P
            P_pred = _predicted(P, p)
            S, K, K_before, P = _updated(P_pred, p.R)
            is_settled = P == last  # to the last bit: so it stays for ever
        if math.isnan(z_k):  # a gap: the prediction stays
            P = P_pred
            is_settled = False
            y = z_k
        else:
            y = z_k - x
            x = x + K * y
            before = before + K_before * y
        rows.append((x, P[0], y, S))
    return np.array(rows).T


def _predicted(P, p):
    """F P F' + Q as (variance of the speed, covariance with the speed before, its variance)."""
    P_now, P_cross, P_before = P
    first = p.a1 * P_now + p.a2 * P_cross
    second = p.a1 * P_cross + p.a2 * P_before
    return p.a1 * first + p.a2 * second + p.Q, first, P_now + p.Q_copy


def _updated(P_pred, R):
    """S, the gains of the speed and of the one before, and P."""
    P_now, P_cross, P_before = P_pred
    S = P_now + R
    K, K_before = P_now / S, P_cross / S
    return S, K, K_before, (K * R, K_before * R, P_before - K_before * P_cross)


def log_likelihood(z, p):
    """Log-likelihood of the measurements z (T,): the innovations are independent, y ~ N(0, S)."""
    _, _, y, S = quick_filter(z, p)
    known = np.isfinite(z)
    if not (np.isfinite(y[known]).all() and np.isfinite(S[known]).all()):
        return -np.inf  # an unstable model that overflowed explains nothing
    return -np.sum(np.log(2 * np.pi * S[known]) + y[known] ** 2 / S[known]) / 2


def most_likely(z, p, factors=()):
    """The c, a1, a2, Q and R that make z (T,) most likely, sought from those in p -> Fit.

    p gives x0 and P0, too; the copy has no noise, as in a true AR(2). c, a1 and a2 may be negative.
    factors as in numeric.maximise: without any, the search climbs the peak near p, which need not
    be the highest. tuning.fit of `model` finds the same (a test holds it), only much more slowly.
    """

    def likelihood(**values):
        return log_likelihood(z, replace(p, Q_copy=0, **values))

    start = {name: getattr(p, name) for name in ("c", "a1", "a2", "Q", "R")}
    return maximise(likelihood, start, free=("c", "a1", "a2"), factors=factors)


# --- readers' own recordings --------------------------------------------------------------------


class Sampling(NamedTuple):
    """The median time step dt in s, whether steps are uneven, and a sentence that tells it."""

    dt: float
    uneven: bool
    en: str
    id: str


def sampling(t, tolerance=0.05):
    """Are the times t (T,) in s evenly spaced? tolerance: so far a step may be from the median.

    ValueError: a time is missing, or it does not increase.
    """
    steps = np.diff(_checked_times(t))
    dt = float(np.median(steps))
    odd = int((np.abs(steps - dt) > tolerance * dt).sum())
    low, high, middle = (f"{value:.3g}" for value in (steps.min(), steps.max(), dt))
    if not odd:
        en = f"The samples are evenly spaced, {middle} s apart."
        id = f"Jarak antarsampel seragam, {middle} s."
    else:
        en = (
            f"The samples are unevenly spaced ({low} to {high} s; {odd} of {len(steps)} steps are "
            f"not about the median {middle} s), but AR(2) takes them as even: resample them first."
        )
        id = (
            f"Jarak antarsampel tidak seragam ({low} sampai {high} s; {odd} dari {len(steps)} "
            f"langkah tidak sekitar median {middle} s), padahal AR(2) menganggapnya seragam: "
            "seragamkan dahulu."
        )
    return Sampling(dt, odd > 0, en, _decimal_comma(id))


def _decimal_comma(text):
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


def _checked_times(t):
    """t as an array; ValueError: a time is missing, or it does not increase."""
    t = np.asarray(t, dtype=float)
    if len(t) < 5 or not np.isfinite(t).all():
        raise ValueError(
            "The time column must hold at least five times and no gap. / "
            "Kolom waktu harus berisi sedikitnya lima waktu tanpa sel kosong."
        )
    back = np.diff(t) <= 0
    if back.any():
        row = int(np.argmax(back)) + 2
        now, before = f"{t[row - 1]:.15g}", f"{t[row - 2]:.15g}"
        stamps = f"{now} s setelah {before} s"
        raise ValueError(
            f"The time does not increase at row {row} of the data ({now} s after {before} s). / "
            f"Waktu tidak bertambah di baris data ke-{row} ({_decimal_comma(stamps)})."
        )
    return t
