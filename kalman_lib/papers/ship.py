"""Chapter 4: the speed of a model ship, AR(2). Source: "Kalman Filter untuk Pengukuran Kecepatan Kapal", a blog of 2018."""
import re
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..models import LinearModel
from ..numeric import maximise
from ..simulate import Trajectory
from ..simulate import simulate as simulate_model
from . import check, param

# All the numbers that the source prints: the settings of its filter. It prints no measurement and no result.
PRINTED = {"Q": "0.0001 0 0 0.0001", "R": "0.01", "H": "1 0", "x0": "0 0", "P0": "0.01 0 0 0.01"}

# The SYNTHETIC towing run, which stands in for data that was never published: (seconds, speed at the end in m/s).
# Between two speeds the carriage follows half a cosine wave.
RECIPE = ((5, 0.0), (6, 1.5), (14, 1.5), (6, 0.0), (5, 0.0))
DT = 0.1                                        # s

SPEED_UNITS = {"m/s": 1.0, "cm/s": 0.01, "km/h": 1 / 3.6, "kn": 1852 / 3600}       # in m/s
TIME_UNITS = {"s": 1.0, "ms": 0.001, "min": 60.0}                                  # in s


@dataclass(frozen=True)
class Params:
    """c, a1 and a2 come from a fit; the source prints none, so these are those of our synthetic run, seed 2018."""
    c: float = param(0.0100, min=-1e6, max=1e6, step=0.001, unit="m/s", id="konstanta", en="constant")
    a1: float = param(0.5517, min=-100, max=100, step=0.01, unit="", id="koefisien sampel terakhir",
                      en="coefficient of the last sample")
    a2: float = param(0.4365, min=-100, max=100, step=0.01, unit="", id="koefisien sampel sebelumnya",
                      en="coefficient of the sample before")
    Q: float = param(1e-4, min=1e-10, max=1e2, step=0.1, unit="m²/s²", log=True,
                     id="varians derau proses", en="process-noise variance")
    Q_copy: float = param(1e-4, min=0, max=1e2, step=0.1, unit="m²/s²", log=True,
                          id="varians derau pada salinan (AR(2) sejati: 0)",
                          en="noise variance of the copy (a true AR(2): 0)")
    R: float = param(0.01, min=1e-8, max=1e4, step=0.1, unit="m²/s²", log=True,
                     id="varians derau pengukuran", en="measurement-noise variance")
    x0: float = param(0, min=-1e6, max=1e6, step=0.1, unit="m/s", id="kecepatan awal", en="initial speed")
    P0: float = param(0.01, min=0, max=1e6, step=0.1, unit="m²/s²", log=True,
                      id="varians kecepatan awal", en="variance of the initial speed")
    sigma: float = param(0.1, min=0, max=0.5, step=0.01, unit="m/s", id="derau pada uji tarik sintetis",
                         en="noise of the synthetic towing run")


def model(p):
    """State [speed now, speed one sample before] in m/s; the constant c enters through the input u = 1."""
    check(p)
    return LinearModel(F=[[p.a1, p.a2], [1, 0]], B=[[p.c], [0]], H=[[1, 0]], Q=np.diag([p.Q, p.Q_copy]), R=p.R,
                       x0=[p.x0, p.x0], P0=p.P0 * np.eye(2))


def simulate(p, rng, steps=600):
    """A synthetic AR(2) speed with known coefficients, and its measurements -> Trajectory."""
    return simulate_model(model(p), steps, rng, u=np.ones((steps, 1)))


def towing_run(rng, sigma=0.1, dt=DT):
    """The SYNTHETIC towing run of RECIPE with white noise of sigma (m/s) -> time (T,) in s, Trajectory."""
    pieces, speed = [], 0.0
    for seconds, end in RECIPE:
        s = np.arange(round(seconds / dt)) * dt / seconds
        pieces.append(speed + (end - speed) * (1 - np.cos(np.pi * s)) / 2)
        speed = end
    x = np.concatenate(pieces)
    z = x + rng.normal(0, sigma, len(x))
    return dt * np.arange(len(x)), Trajectory(x[:, np.newaxis], z[:, np.newaxis])


# --- the fit of the source, and what noise does to it ----------------------------------------------------------------

def fit(z, invented_rows=False):
    """c, a1, a2 of z_k = c + a1 z_{k-1} + a2 z_{k-2}, by least squares over z (T,); rows with a gap are left out.

    invented_rows=True adds the source's first two rows, which put 0 where there was no measurement before.
    ValueError: too few rows, or a speed so regular (constant, a straight line, one exponential) that the three are not
    unique.
    """
    z = np.asarray(z, dtype=float)
    before = np.concatenate(([0.0, 0.0], z)) if invented_rows else z
    X = np.column_stack([np.ones(len(before) - 2), before[1:-1], before[:-2]]) if len(before) > 2 else np.empty((0, 3))
    rows = np.column_stack([X, before[2:]])
    rows = rows[np.isfinite(rows).all(axis=1)]
    theta, _, rank, _ = np.linalg.lstsq(rows[:, :3], rows[:, 3])
    if rank < 3:
        raise ValueError("c, a1 and a2 need at least five speeds in a row that do not lie on a line or one "
                         "exponential. / "
                         "c, a1, dan a2 memerlukan sedikitnya lima kecepatan berurutan yang tidak "
                         "terletak pada satu garis lurus atau satu eksponensial.")
    return theta


def fitted(z, p, **options):
    """The Params p with the c, a1 and a2 that `fit` finds in z (T,)."""
    c, a1, a2 = map(float, fit(z, **options))
    return replace(p, c=c, a1=a1, a2=a2)


def expected_fit(x, sigma):
    """What `fit` finds on average if white noise of sigma (m/s) is added to the speed x (T,): errors in variables.

    The noise adds sigma^2 to the mean squares of both regressors, and nothing to any product of different samples.
    """
    X = np.column_stack([np.ones(len(x) - 2), x[1:-1], x[:-2]])
    noise = len(X) * np.diag([0, sigma**2, sigma**2])
    return np.linalg.solve(X.T @ X + noise, X.T @ x[2:])


def poles(a1, a2):
    """The two roots of p^2 - a1 p - a2 = 0, which are the eigenvalues of F; stable inside the unit circle."""
    root = np.sqrt(complex(a1**2 / 4 + a2))
    return np.array([a1 / 2 + root, a1 / 2 - root])


# --- the remedy: how likely are the measurements? --------------------------------------------------------------------

def quick_filter(z, p):
    """The filter in plain numbers, 50 times as fast as kalman_filter and equal to it (a test holds it).

    z (T,), p a Params -> estimate x, its variance P, innovation y and its variance S, each (T,) and of the speed now.
    """
    c, a1, a2, Q, Q_copy, R = p.c, p.a1, p.a2, p.Q, p.Q_copy, p.R
    x, before, P, P_cross, P_before = p.x0, p.x0, p.P0, 0.0, p.P0
    rows, settled = [], False
    for z_k in np.asarray(z, dtype=float).tolist():
        x, before = c + a1 * x + a2 * before, x
        if not settled:
            last = P, P_cross, P_before
            first, second = a1 * P + a2 * P_cross, a1 * P_cross + a2 * P_before
            P_pred, cross_pred, before_pred = a1 * first + a2 * second + Q, first, P + Q_copy
            S = P_pred + R
            K, K_before = P_pred / S, cross_pred / S
            P, P_cross, P_before = K * R, K_before * R, before_pred - K_before * cross_pred
            settled = last == (P, P_cross, P_before)        # to the last bit: so it stays for ever
        if z_k != z_k:                          # NaN, a gap: the prediction stays
            P, P_cross, P_before, settled = P_pred, cross_pred, before_pred, False
            rows.append((x, P, z_k, S))
            continue
        y = z_k - x
        x, before = x + K * y, before + K_before * y
        rows.append((x, P, y, S))
    return np.array(rows).T


def log_likelihood(z, p):
    """Log-likelihood of the measurements z (T,): the innovations are independent, y ~ N(0, S)."""
    _, _, y, S = quick_filter(z, p)
    known = np.isfinite(z)
    if not (np.isfinite(y[known]).all() and np.isfinite(S[known]).all()):
        return -np.inf              # an unstable model that overflowed explains nothing
    return -np.sum(np.log(2 * np.pi * S[known]) + y[known] ** 2 / S[known]) / 2


def most_likely(z, p, factors=()):
    """The c, a1, a2, Q and R that make z (T,) most likely, sought from those in p -> Fit.

    p gives x0 and P0, too; the copy has no noise, as in a true AR(2). c, a1 and a2 may be negative.
    factors as in numeric.maximise: without any, the search climbs the peak near p, which need not be
    the highest. tuning.fit of `model` finds the same (a test holds it), only much more slowly.
    """
    def likelihood(**values):
        return log_likelihood(z, replace(p, Q_copy=0, **values))

    start = {name: getattr(p, name) for name in ("c", "a1", "a2", "Q", "R")}
    return maximise(likelihood, start, free=("c", "a1", "a2"), factors=factors)


# --- readers' own recordings -----------------------------------------------------------------------------------------

class Sampling(NamedTuple):
    """The median time step dt in s, whether the steps are uneven, and the sentence that tells it, en and id."""
    dt: float
    uneven: bool
    en: str
    id: str


def sampling(t, tolerance=0.05):
    """Are the times t (T,) in s evenly spaced? Steps that differ from the median by more than this fraction of it are not.

    ValueError: a time is missing, or it does not increase.
    """
    t = np.asarray(t, dtype=float)
    if len(t) < 5 or not np.isfinite(t).all():
        raise ValueError("The time column must hold at least five times and no gap. / "
                         "Kolom waktu harus berisi sedikitnya lima waktu tanpa sel kosong.")
    steps = np.diff(t)
    if not (steps > 0).all():
        row = int(np.argmax(steps <= 0)) + 2
        raise ValueError(f"The time does not increase at row {row} of the data ({t[row - 1]:g} s after {t[row - 2]:g} s)."
                         f" / Waktu tidak bertambah di baris data ke-{row} ({t[row - 1]:g} s setelah {t[row - 2]:g} s).")
    dt = float(np.median(steps))
    odd = int((np.abs(steps - dt) > tolerance * dt).sum())
    low, high, middle = (f"{value:.3g}" for value in (steps.min(), steps.max(), dt))
    if not odd:
        en = f"The samples are evenly spaced, {middle} s apart."
        id = f"Jarak antarsampel seragam, {middle} s."
    else:
        en = (f"The samples are unevenly spaced ({low} to {high} s; {odd} of {len(steps)} steps are not about the "
              f"median {middle} s), but AR(2) takes them as even: resample them first.")
        id = (f"Jarak antarsampel tidak seragam ({low} sampai {high} s; {odd} dari {len(steps)} langkah tidak sekitar "
              f"median {middle} s), padahal AR(2) menganggapnya seragam: seragamkan dahulu.")
    return Sampling(dt, odd > 0, en, re.sub(r"(?<=\d)\.(?=\d)", ",", id))
