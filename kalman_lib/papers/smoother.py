"""Chapter 2: the scalar filter of a spreadsheet. Source: Rudiyanto, Setiawan and Saptomo (2006), Figures 2 and 3."""
from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import Trajectory
from ..simulate import simulate as simulate_model
from ..tuning import fit
from . import check, param

# The form of the paper's Figure 3: 16 measurements and the 16 filtered values beside them (the form drops trailing
# zeros: it shows -0.294)
MEASURED = np.array([-0.39, -0.49, -0.48, -0.3, -0.25, -0.31, -0.33, -0.48,
                     -0.41, -0.44, -0.38, -0.36, -0.42, -0.44, -0.51, -0.28])
PRINTED = ("-0.389996 -0.456665 -0.471249 -0.365238 -0.294000 -0.303889 -0.320027 -0.418896 "
           "-0.413398 -0.429839 -0.399037 -0.374911 -0.402777 -0.425782 -0.477832 -0.355565")
FILTERED = np.array(PRINTED.split(), dtype=float)


@dataclass(frozen=True)
class Params:
    Q: float = param(1e-5, min=1e-12, max=1e6, step=0.1, unit="unit²", log=True,
                     id="varians derau proses", en="process-noise variance")
    R: float = param(1e-5, min=1e-12, max=1e6, step=0.1, unit="unit²", log=True,
                     id="varians derau pengukuran", en="measurement-noise variance")
    x0: float = param(0, min=-1e9, max=1e9, step=0.01, unit="unit", id="tebakan awal", en="initial guess")
    P0: float = param(1, min=0, max=1e9, step=0.1, unit="unit²", log=True,
                      id="varians tebakan awal", en="variance of the initial guess")
    window: int = param(3, min=1, max=500, step=1, unit="", id="jendela rataan bergerak",
                        en="window of the moving average")


def model(p):
    """A random walk that is measured directly: x = x + w, z = x + v; x and z in the unit of the data."""
    check(p)
    return LinearModel(F=1, H=1, Q=p.Q, R=p.R, x0=p.x0, P0=p.P0)


def simulate(p, rng, steps=200):
    """A synthetic random walk and its measurements -> Trajectory."""
    return simulate_model(model(p), steps, rng)


def scalar_filter(z, p):
    """The random-walk filter in plain numbers, 30 times as fast as kalman_filter and equal to it (a test holds it).

    z (T,), p a Params -> x, P, K (T,) and the smoothed x (T,) of the RTS smoother.
    """
    check(p)
    x, P, rows = p.x0, p.P0, []
    for z_k in np.asarray(z, dtype=float).tolist():
        P_pred = P + p.Q
        K = 0.0 if z_k != z_k else P_pred / (P_pred + p.R)      # z_k != z_k: NaN, a gap
        x, P = (x + K * (z_k - x), K * p.R) if K else (x, P_pred)
        rows.append((x, P, K))
    smooth = [x]
    for x_k, P_k, _ in reversed(rows[:-1]):
        smooth.append(x_k + P_k / (P_k + p.Q) * (smooth[-1] - x_k))
    return (*np.array(rows).T, np.array(smooth[::-1]))


# --- synthetic look-alikes of the paper's three recordings, whose data was never published --------------------

def silkworm_room(rng, steps=288):
    """SYNTHETIC room temperature, degC, every 5 minutes for a day: daily wave, heater cycling, noise 0.3 degC."""
    hours = np.arange(steps) / 12
    x = 26 + 1.5 * np.sin(2 * np.pi * (hours - 9) / 24) + 0.35 * np.sign(np.sin(2 * np.pi * hours / 4))
    return _look_alike(x, 0.3, rng)


def cutting_force(rng, steps=200):
    """SYNTHETIC force on a knife in oil-palm frond, N: slow rise, cut through, fall; noise 1.5 N."""
    s = np.linspace(0, 1, steps)
    x = 40 * np.clip(s / 0.55, 0, 1) ** 1.5 * (1 - np.clip((s - 0.6) / 0.3, 0, 1) ** 2)
    return _look_alike(x, 1.5, rng)


def tank_level(rng, steps=240):
    """SYNTHETIC water level of a recirculating tank, cm, every minute: an hour at rest, then drained and refilled;
    noise 0.4 cm."""
    minutes = np.arange(steps)
    x = 50 - 4 * (1 - np.abs(1 - np.maximum(minutes - 60, 0) / 60 % 2))
    return _look_alike(x, 0.4, rng)


def _look_alike(x, sigma, rng):
    return Trajectory(x[:, np.newaxis], (x + rng.normal(0, sigma, len(x)))[:, np.newaxis])


# --- the gain, and what it is worth in samples of a moving average ------------------------------------------------

def steady_gain(q):
    """The gain K that the filter settles at, for q = Q / R: the positive root of K^2 + q K - q = 0."""
    q = np.asarray(q, dtype=float)
    root = np.sqrt(q)
    return 2 * root / (root + np.sqrt(q + 4))       # = (-q + sqrt(q^2 + 4 q)) / 2 without its cancellation


def equal_window(K):
    """The moving average that suppresses white noise as much as the steady gain K: K / (2 - K) = 1 / n."""
    return 2 / K - 1


# --- the filter's rivals -------------------------------------------------------------------------------------------

def moving_average(z, window):
    """Mean of the last `window` values of z (T,), as a spreadsheet does it; fewer at the start; gaps left out."""
    known = np.isfinite(z)
    total = np.convolve(np.where(known, z, 0.0), np.ones(window))[:len(z)]
    count = np.convolve(known, np.ones(window))[:len(z)]
    return np.where(count > 0.5, total / np.maximum(count, 1), np.nan)


def exponential(z, K):
    """Exponential smoothing x = x + K (z - x), starting at the first known value of z (T,); a gap keeps x."""
    x = np.array(z, dtype=float)
    for k in range(1, len(x)):
        if not np.isnan(x[k - 1]):
            x[k] = x[k - 1] if np.isnan(z[k]) else x[k - 1] + K * (z[k] - x[k - 1])
    return x


# --- smoothness and lag: the two sides of every filter --------------------------------------------------------------

def roughness(x):
    """Standard deviation of the step from value to value: the smaller, the smoother. Unit of x."""
    return np.nanstd(np.diff(x))


def lag(x, reference, longest=50):
    """How many samples x (T,) runs behind the reference (T,): the shift that leaves the smallest squared difference.

    A parabola through the best whole shift and its neighbours gives the fraction. NaN for fewer than 8 samples or a
    reference that never changes: then no shift is better than another.
    """
    if len(x) < 8 or not np.nanstd(reference) > 0:
        return float("nan")
    longest = min(longest, len(x) // 2)
    shifts = np.arange(-1, longest + 1)
    cost = [np.nanmean((x[longest:-1] - reference[longest - d:len(x) - 1 - d]) ** 2) for d in shifts]
    best = int(np.argmin(cost))
    if best in (0, len(cost) - 1):
        return float(shifts[best])
    left, middle, right = cost[best - 1:best + 2]
    return float(shifts[best] + (left - right) / (2 * (left - 2 * middle + right)))


def scores(estimates, truth):
    """A table of RMSE, roughness and lag: estimates is a dict name -> (T,), truth (T,). The first fifth, in which
    every filter still settles, is left out."""
    start = len(truth) // 5
    lines = [f"{'':10}{'RMSE':>9}{'σ(Δx)':>9}{'d':>7}"]
    for name, x in estimates.items():
        x, x_true = x[start:], truth[start:]
        error = np.sqrt(np.mean((x - x_true) ** 2))
        lines.append(f"{name:10}{error:9.4f}{roughness(x):9.4f}{lag(x, x_true):7.1f}")
    return "\n".join(lines)


# --- where Q and R come from ----------------------------------------------------------------------------------------

def recover(z, x, x0=0):
    """The gains K and the ratios P_pred / R that must have turned z (T,) into the filtered x (T,), started at x0.

    The start is an assumption: the first gain, and only it, depends on x0.

    K_k = (x_k - x_{k-1}) / (z_k - x_{k-1}); since P_k = K_k R, the prediction gives
    K / (1 - K) = P_pred / R = K_previous + Q / R. Returns K (T,), P_pred / R (T,) and Q / R (T - 1,).
    """
    before = np.concatenate(([x0], x[:-1]))
    K = (x - before) / (z - before)
    P_pred = K / (1 - K)
    return K, P_pred, P_pred[1:] - K[:-1]


def R_from_steady(z):
    """R by least squares where the quantity stands still: the variance of z (T,) about its mean (gaps left out)."""
    return np.nanvar(z, ddof=1)


def log_likelihood(z, Q, R):
    """Log-likelihood of z (T,) for every pair of the arrays Q and R (same shape, unit of z squared).

    The innovations of the filter are independent, y ~ N(0, S), so their log-densities add up. The
    first value only starts the filter (x = z, P = R), as if nothing had been known before. Gaps are
    steps without a measurement. This is tuning.log_likelihood of many filters at once, for a map.
    """
    Q, R = np.broadcast_arrays(np.asarray(Q, dtype=float), np.asarray(R, dtype=float))
    z = np.asarray(z, dtype=float)
    z = z[np.argmax(np.isfinite(z)):]
    x, P, total = np.full(Q.shape, z[0]), R.copy(), np.zeros(Q.shape)
    for z_k in z[1:]:
        P = P + Q
        if np.isnan(z_k):
            continue
        y, S = z_k - x, P + R
        total -= (np.log(2 * np.pi * S) + y * y / S) / 2
        K = P / S
        x, P = x + K * y, K * R
    return total


def maximum_likelihood(z):
    """The pair (Q, R) that makes z (T,) most likely, by tuning.fit; z[0] starts the filter."""
    z = np.asarray(z, dtype=float)
    steps = np.diff(z[np.isfinite(z)])
    scale = np.var(steps) if len(steps) > 1 else 0
    if not scale > 1e-24 * np.max(np.abs(steps), initial=0) ** 2 or scale == 0:
        raise ValueError("Q and R need at least three values that do not all change by the same amount. / "
                         "Q dan R memerlukan sedikitnya tiga nilai yang perubahannya tidak selalu sama.")
    first = int(np.argmax(np.isfinite(z)))

    def level(Q, R):
        return LinearModel(F=1, H=1, Q=Q, R=R, x0=z[first], P0=R)
    found = fit(level, {"Q": scale, "R": scale}, z[first + 1:])
    return found.values["Q"], found.values["R"]
