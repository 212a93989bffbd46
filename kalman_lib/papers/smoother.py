"""Chapter 2: the scalar filter of a spreadsheet.

Source: Rudiyanto, Setiawan and Saptomo (2006), Figures 2 and 3.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import Trajectory
from ..simulate import simulate as simulate_model
from ..tuning import fit
from . import check, param

# The form of the paper's Figure 3: 16 measurements and the 16 filtered values beside them (the form
# drops trailing zeros: it shows -0.294)
MEASURED = np.array([
    -0.39, -0.49, -0.48, -0.3, -0.25, -0.31, -0.33, -0.48,
    -0.41, -0.44, -0.38, -0.36, -0.42, -0.44, -0.51, -0.28,
])  # fmt: skip
PRINTED = (
    "-0.389996 -0.456665 -0.471249 -0.365238 -0.294000 -0.303889 -0.320027 -0.418896 "
    "-0.413398 -0.429839 -0.399037 -0.374911 -0.402777 -0.425782 -0.477832 -0.355565"
)
FILTERED = np.array(PRINTED.split(), dtype=float)


@dataclass(frozen=True)
class Params:
    """Q, R and what starts the filter are those of the paper's form; the window is its rival's."""

    # fmt: off
    Q: float = param(
        1e-5, min=1e-12, max=1e6, step=0.1, unit="unit²", log=True,
        id="varians derau proses", en="process-noise variance",
    )
    R: float = param(
        1e-5, min=1e-12, max=1e6, step=0.1, unit="unit²", log=True,
        id="varians derau pengukuran", en="measurement-noise variance",
    )
    x0: float = param(
        0, min=-1e9, max=1e9, step=0.01, unit="unit",
        id="tebakan awal", en="initial guess",
    )
    P0: float = param(
        1, min=0, max=1e9, step=0.1, unit="unit²", log=True,
        id="varians tebakan awal", en="variance of the initial guess",
    )
    window: int = param(
        3, min=1, max=500, step=1, unit="",
        id="banyaknya nilai rataan bergerak", en="number of values in the moving average",
    )
    # fmt: on


def model(p):
    """A random walk that is measured directly: x = x + w, z = x + v, in the unit of the data."""
    check(p)
    return LinearModel(F=1, H=1, Q=p.Q, R=p.R, x0=p.x0, P0=p.P0)


def simulate(p, rng, steps=200):
    """A synthetic random walk and its measurements -> Trajectory."""
    return simulate_model(model(p), steps, rng)


def scalar_filter(z, p):
    """The random-walk filter in plain numbers, 30 times as fast as kalman_filter.

    z (T,), p a Params -> x, P, K (T,) and the smoothed x (T,) of the RTS smoother; a test holds
    them equal to those of the general filter.
    """
    check(p)
    x, P = p.x0, p.P0
    rows = []
    for z_k in np.asarray(z, dtype=float).tolist():
        P_pred = P + p.Q
        K = 0.0 if math.isnan(z_k) else P_pred / (P_pred + p.R)
        if K == 0:  # a gap, or nothing to learn: the prediction stays
            P = P_pred
        else:
            x = x + K * (z_k - x)
            P = K * p.R
        rows.append((x, P, K))
    smooth = [x]
    for x_k, P_k, _ in reversed(rows[:-1]):
        smooth.append(x_k + P_k / (P_k + p.Q) * (smooth[-1] - x_k))
    smooth.reverse()
    return (*np.array(rows).T, np.array(smooth))


# --- synthetic look-alikes of the paper's three recordings, which were never published ----------


def silkworm_room(rng, steps=288):
    """SYNTHETIC room temperature, degC, every 5 minutes for a day; noise 0.3 degC."""
    hours = np.arange(steps) / 12
    day = 1.5 * np.sin(2 * np.pi * (hours - 9) / 24)
    heater = 0.35 * np.sign(np.sin(2 * np.pi * hours / 4))  # on and off every two hours
    return _look_alike(26 + day + heater, 0.3, rng)


def cutting_force(rng, steps=200):
    """SYNTHETIC force on a knife in oil-palm frond, N: slow rise, cut through, fall.

    Noise 1.5 N.
    """
    s = np.linspace(0, 1, steps)
    rise = np.clip(s / 0.55, 0, 1) ** 1.5
    fall = np.clip((s - 0.6) / 0.3, 0, 1) ** 2
    return _look_alike(40 * rise * (1 - fall), 1.5, rng)


def tank_level(rng, steps=240):
    """SYNTHETIC water level of a recirculating tank, cm, every minute; noise 0.4 cm.

    An hour at rest, then drained for an hour, refilled for an hour, and so on.
    """
    minutes = np.arange(steps)
    hours_moving = np.maximum(minutes - 60, 0) / 60
    drained = 1 - np.abs(1 - hours_moving % 2)  # 0 to 1 and back
    return _look_alike(50 - 4 * drained, 0.4, rng)


def _look_alike(x, sigma, rng):
    z = x + rng.normal(0, sigma, len(x))
    return Trajectory(x[:, np.newaxis], z[:, np.newaxis])


def ready_path():
    """A path for the race, ready-made: rest, a ramp, rest, a jump, at the steps 1 to 120: (T,)."""
    corners = [(1, 2), (25, 2), (55, 7.5), (80, 7.5), (81, 4), (120, 4)]
    return np.interp(np.arange(1, 121), *np.transpose(corners))


# --- the gain, and what it is worth in samples of a moving average ------------------------------


def steady_gain(q):
    """The gain K that the filter settles at, for q = Q / R: K^2 + q K - q = 0, K > 0.

    It is (-q + sqrt(q^2 + 4 q)) / 2, here without the cancellation of digits for a small q.
    """
    q = np.asarray(q, dtype=float)
    root = np.sqrt(q)
    return 2 * root / (root + np.sqrt(q + 4))


def equal_window(K):
    """The moving average of n values that suppresses white noise as K does: K / (2 - K) = 1 / n."""
    return 2 / K - 1


# --- the filter's rivals ------------------------------------------------------------------------


def moving_average(z, window):
    """Mean of the last `window` values of z (T,), as a spreadsheet does it.

    At the start there are fewer; gaps are left out.
    """
    known = np.isfinite(z)
    ones = np.ones(window)
    total = np.convolve(np.where(known, z, 0.0), ones)[: len(z)]
    count = np.convolve(known, ones)[: len(z)]
    return np.where(count > 0.5, total / np.maximum(count, 1), np.nan)


def exponential(z, K):
    """Exponential smoothing x = x + K (z - x); a gap in z (T,) keeps x.

    It starts at the first known value.
    """
    x = np.array(z, dtype=float)
    for k in range(1, len(x)):
        last = x[k - 1]
        if np.isnan(last):
            continue
        x[k] = last if np.isnan(z[k]) else last + K * (z[k] - last)
    return x


# --- smoothness and lag: the two sides of every filter ------------------------------------------


def roughness(x):
    """Standard deviation of the step from value to value: the smaller, the smoother. Unit of x."""
    return np.nanstd(np.diff(x))


def lag(x, reference, longest=50):
    """How many samples x (T,) runs behind the reference (T,).

    The shift that leaves the smallest squared difference; a parabola through the best whole shift
    and its neighbours gives the fraction. NaN for fewer than 8 samples or a reference that never
    changes: then no shift is better than another.
    """
    if len(x) < 8 or not np.nanstd(reference) > 0:
        return float("nan")
    longest = min(longest, len(x) // 2)
    shifts = np.arange(-1, longest + 1)
    compared = x[longest:-1]  # the same samples for every shift

    def squared_difference(shift):
        shifted = reference[longest - shift : len(x) - 1 - shift]
        return np.nanmean((compared - shifted) ** 2)

    cost = [squared_difference(shift) for shift in shifts]
    best = int(np.argmin(cost))
    if best in (0, len(cost) - 1):
        return float(shifts[best])
    left, middle, right = cost[best - 1 : best + 2]
    return float(shifts[best] + (left - right) / (2 * (left - 2 * middle + right)))


def scores(estimates, truth):
    """A table of RMSE, roughness and lag of estimates {name: (T,)} against the truth (T,).

    The first fifth, in which every filter still settles, is left out.
    """
    start = len(truth) // 5
    lines = [f"{'':10}{'RMSE':>9}{'σ(Δx)':>9}{'d':>7}"]
    for name, x in estimates.items():
        x, x_true = x[start:], truth[start:]
        error = np.sqrt(np.mean((x - x_true) ** 2))
        lines.append(f"{name:10}{error:9.4f}{roughness(x):9.4f}{lag(x, x_true):7.1f}")
    return "\n".join(lines)


# --- where Q and R come from --------------------------------------------------------------------


def recover(z, x, x0=0):
    """The gains K (T,), P_pred / R (T,) and Q / R (T - 1,) that must have turned z into x (T,).

    x are the filtered values of z, started at x0. The start is an assumption: the first gain, and
    only it, depends on x0.

    K_k = (x_k - x_{k-1}) / (z_k - x_{k-1}); since P_k = K_k R, the prediction gives
    K / (1 - K) = P_pred / R = K_previous + Q / R.
    """
    before = np.concatenate(([x0], x[:-1]))
    K = (x - before) / (z - before)
    P_pred = K / (1 - K)
    return K, P_pred, P_pred[1:] - K[:-1]


def R_from_steady(z):
    """R by least squares where the quantity stands still: the variance of z (T,), gaps left out."""
    return np.nanvar(z, ddof=1)


def log_likelihood(z, Q, R):
    """Log-likelihood of z (T,) for every pair of the arrays Q and R (same shape, unit of z
    squared).

    The innovations of the filter are independent, y ~ N(0, S), so their log-densities add up. The
    first value only starts the filter (x = z, P = R), as if nothing had been known before. Gaps are
    steps without a measurement. This is tuning.log_likelihood of many filters at once, for a map.
    """
    Q, R = np.broadcast_arrays(np.asarray(Q, dtype=float), np.asarray(R, dtype=float))
    z = np.asarray(z, dtype=float)
    z = z[np.argmax(np.isfinite(z)) :]
    x, P = np.full(Q.shape, z[0]), R.copy()
    total = np.zeros(Q.shape)
    for z_k in z[1:]:
        P = P + Q
        if np.isnan(z_k):
            continue
        y, S = z_k - x, P + R
        total -= (np.log(2 * np.pi * S) + y * y / S) / 2
        K = P / S
        x = x + K * y
        P = K * R
    return total


def maximum_likelihood(z):
    """The pair (Q, R) that makes z (T,) most likely, by tuning.fit; z[0] starts the filter."""
    z = np.asarray(z, dtype=float)
    steps = np.diff(z[np.isfinite(z)])
    scale = np.var(steps) if len(steps) > 1 else 0
    if not scale > 1e-24 * np.max(np.abs(steps), initial=0) ** 2 or scale == 0:
        raise ValueError(
            "Q and R need at least three values that do not all change by the same amount. / "
            "Q dan R memerlukan sedikitnya tiga nilai yang perubahannya tidak selalu sama."
        )
    first = int(np.argmax(np.isfinite(z)))

    def level(Q, R):
        return LinearModel(F=1, H=1, Q=Q, R=R, x0=z[first], P0=R)

    found = fit(level, {"Q": scale, "R": scale}, z[first + 1 :])
    return found.values["Q"], found.values["R"]
