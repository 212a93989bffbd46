"""Chapter 3: an angle from a gyroscope and an angle sensor.

Source: Wahyudi, Susanto, Pramono and Widada, Figures 4-7.
"""

from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import Trajectory
from ..simulate import simulate as simulate_model
from . import check, param

# The paper's four figures: (sigma_w rad/s, sigma_v rad), and the largest |measurement error| and
# |estimation error| (rad) that its text reads off them, as printed (decimal point for the comma)
CASES = {4: (10, 10), 5: (10, 1), 6: (1, 10), 7: (1, 1)}
PRINTED = {4: "28 6", 5: "3.2 2.3", 6: "23 2", 7: "3 0.8"}


@dataclass(frozen=True)
class Params:
    """The two noises are those of the paper's four figures, see CASES.

    The process noise w of a step is T times the noise of the rate: its deviation is sigma_w T.
    """

    # fmt: off
    duration: float = param(
        20, min=1, max=60, step=0.1, unit="s", log=True,
        id="durasi", en="duration",
    )
    T: float = param(
        0.1, min=0.01, max=1, step=0.1, unit="s", log=True,
        id="periode cuplik", en="sampling period",
    )
    sigma_w: float = param(
        10, min=1e-4, max=100, step=0.1, unit="rad/s", log=True,
        id="simpangan baku derau kecepatan sudut", en="standard deviation of the rate noise",
    )
    sigma_v: float = param(
        10, min=1e-4, max=100, step=0.1, unit="rad", log=True,
        id="simpangan baku derau pengukuran", en="standard deviation of the measurement noise",
    )
    u: float = param(
        1, min=-10, max=10, step=0.1, unit="rad/s",
        id="kecepatan sudut", en="angular rate",
    )
    # fmt: on


def model(p):
    """x = x + T u + w, z = x + v: angle x and measured angle z in rad, rate u in rad/s.

    Q = sigma_w^2 T^2 and R = sigma_v^2. The first angle is known: x0 = 0, P0 = 0. So the first
    P_pred is Q, where the paper's program starts.
    """
    check(p)
    return LinearModel(F=1, B=p.T, H=1, Q=(p.sigma_w * p.T) ** 2, R=p.sigma_v**2, x0=0, P0=0)


def times(p):
    """t (T,) s, the end of every step: T, 2 T, ... for as many steps as fit the duration best."""
    return p.T * np.arange(1, round(p.duration / p.T) + 1)


def simulate(p, rng, runs=None):
    """A synthetic turn at the constant rate u -> Trajectory; of many runs, (T, 1, runs)."""
    m, steps = model(p), len(times(p))
    u = np.full((steps, 1), p.u)
    if runs is None:
        return simulate_model(m, steps, rng, u)
    w, v = rng.normal(size=(2, steps, 1, runs))
    x = np.cumsum(p.T * p.u + np.sqrt(m.Q[0, 0]) * w, axis=0)
    return Trajectory(x, x + p.sigma_v * v, u)


def layout(p, flight, result):
    """The two panels of the paper's figures, angle and errors: the rows of plots.panels."""
    t, x, z, truth = times(p), result.x[:, 0], flight.z[:, 0], flight.x[:, 0]
    return [
        dict(t=t, z=z, x=x, truth=truth, ylabel="rad"),
        dict(
            t=t,
            z=truth - z,
            x=truth - x,
            ylabel="rad",
            names={"z": r"$x_{\mathrm{true}} - z$", "x": r"$e = x_{\mathrm{true}} - x$"},
        ),
    ]


# --- the largest error of a run -----------------------------------------------------------------


def maxima(flight, result):
    """Largest |x_true - z| and |x_true - x| of every run, rad: (2,), or (2, runs) of many."""
    errors = flight.x - flight.z, flight.x - result.x
    return np.array([np.abs(error).max(axis=0)[0] for error in errors])


def ranks(largest):
    """Share of the runs whose maxima stay below the printed ones: {figure: (2,)}.

    largest: {figure: (2, runs)}, the maxima of the runs.
    """
    shares = {}
    for figure, sample in largest.items():
        printed = np.array(PRINTED[figure].split(), dtype=float)
        shares[figure] = np.mean(sample < printed[:, np.newaxis], axis=1)
    return shares


def beside_printed(largest):
    """{"4 $z$": (largest errors of all runs, the printed one), ...}, for plots.intervals."""
    rows = {}
    for figure, runs in largest.items():
        for letter, sample, printed in zip("zx", runs, PRINTED[figure].split()):
            rows[f"{figure} ${letter}$"] = sample, float(printed)
    return rows


def table(own, largest):
    """For each printed maximum (a): ours (b), the 95 % interval of the runs, the rank (p), a mark.

    own: {figure: (2,)}, largest: {figure: (2, runs)}.
    """
    lines = [f"{'a':>11}{'b':>7}{'95%':>10}{'p':>9}"]
    for figure, rank in ranks(largest).items():
        rows = zip("zx", PRINTED[figure].split(), own[figure], largest[figure], rank)
        for letter, printed, ours, sample, r in rows:
            low, high = np.quantile(sample, (0.025, 0.975))
            numbers = f"{printed:>7}{ours:>7.1f}{low:>7.1f}{high:>5.1f}{r:>7.1%}"
            lines.append(f"{figure} {letter}{numbers} {_mark(r)}")
    return "\n".join(lines)


def _mark(rank):
    """✓ inside the 95 % interval, (✓) only inside the 99 % interval, ✗ outside both."""
    if 0.025 <= rank <= 0.975:
        return "✓"
    return "(✓)" if 0.005 <= rank <= 0.995 else "✗"


# --- once the filter has settled ----------------------------------------------------------------


def steady(p):
    """The gain K at which the filter settles, and the standard deviation sqrt(K R) of its error.

    K is the positive root of K^2 + q K - q = 0 with q = Q / R.
    """
    q = (p.sigma_w * p.T / p.sigma_v) ** 2
    K = 2 / (1 + np.sqrt(1 + 4 / q))
    return K, np.sqrt(K) * p.sigma_v


def error_with_gain(p, K):
    """Standard deviation (rad) of the settled error if the gain is K, whatever the filter believes.

    e' = (1 - K)(e + w) - K v, so its variance is ((1 - K)^2 Q + K^2 R) / (1 - (1 - K)^2).
    """
    m = model(p)
    return np.sqrt(((1 - K) ** 2 * m.Q[0, 0] + K**2 * m.R[0, 0]) / (1 - (1 - K) ** 2))


def expected(p, sigma_w, sigma_v):
    """RMSE (rad) and mean NEES of a filter that believes sigma_w and sigma_v while p is true.

    Both are what is to be expected over all steps. sigma_w rad/s and sigma_v rad are numbers or
    arrays (a map), and so is the answer. No data is needed: K and P depend on none, and the error
    e = (1 - K)(e + w) - K v has the variance V = (1 - K)^2 (V + Q) + K^2 R with the true Q and R.
    """
    m, T = model(p), len(times(p))
    Q, R = m.Q[0, 0], m.R[0, 0]
    Q_told = (np.asarray(sigma_w) * p.T) ** 2
    R_told = np.asarray(sigma_v) ** 2
    P = V = squares = nees = 0
    for _ in range(T):
        P_pred = P + Q_told
        S = P_pred + R_told
        K, keep = P_pred / S, R_told / S  # keep = 1 - K
        P = K * R_told
        V = keep**2 * (V + Q) + K**2 * R
        squares = squares + V
        nees = nees + V / P
    return np.sqrt(squares / T), nees / T


def drift(p, rng, runs):
    """The error of the gyroscope alone, the sum of its noise: (T, runs), rad.

    Its standard deviation is sigma_w sqrt(T t).
    """
    noise = rng.normal(size=(len(times(p)), runs))
    return np.cumsum(p.T * p.sigma_w * noise, axis=0)
