"""Chapter 7: the workshop, in which a filter is built from a pattern of motion and its sensors.

Source: the patterns and their process noise, Bar-Shalom, Li and Kirubarajan (2001), 6.2.
"""

from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import simulate as simulate_model
from ..tuning import discretise
from . import check, param

CONSTANT, RANDOM_WALK, VELOCITY, ACCELERATION, OWN = range(1, 6)  # p.pattern
NONE, ITSELF, RATE, SECOND_RATE, DRIVES = range(1, 6)  # p.second: what the second column is
ORDER = {CONSTANT: 1, RANDOM_WALK: 1, VELOCITY: 2, ACCELERATION: 3}  # states without the bias

# Something that swings and dies away, seen by one sensor: until the reader types other matrices
OWN_F = np.array([
    [0.99, 0.1],
    [-0.1, 0.99],
])
OWN_H = np.array([[1.0, 0.0]])

STEPS = 100
PERIOD = 50  # steps of the wave that a known input makes in made-up data
PRINTED = {}


@dataclass(frozen=True)
class Params:
    """A pattern, what measures it, and how much noise there is; the unit is that of the data."""

    # fmt: off
    pattern: int = param(
        VELOCITY, min=1, max=5, step=1, unit="",
        id="pola gerak", en="pattern of motion",
    )
    second: int = param(
        NONE, min=1, max=5, step=1, unit="",
        id="kolom kedua", en="second column",
    )
    bias: int = param(
        0, min=0, max=1, step=1, unit="",
        id="kolom kedua berbias", en="bias of the second column",
    )
    third: int = param(
        0, min=0, max=1, step=1, unit="",
        id="kolom ketiga: masukan yang diketahui", en="third column: a known input",
    )
    dt: float = param(
        1, min=1e-3, max=1e4, step=0.1, unit="s", log=True,
        id="langkah waktu", en="time step",
    )
    q: float = param(
        0.01, min=1e-9, max=1e9, step=0.1, unit="", log=True,
        id="derau proses: seberapa gelisah benda itu", en="process noise: how restless it is",
    )
    R: float = param(
        9, min=1e-9, max=1e9, step=0.1, unit="", log=True,
        id="varians derau sensor", en="noise variance of the sensor",
    )
    R2: float = param(
        1, min=1e-9, max=1e9, step=0.1, unit="", log=True,
        id="varians derau sensor kedua", en="noise variance of the second sensor",
    )
    x0: float = param(
        0, min=-1e3, max=1e3, step=0.1, unit="",
        id="tebakan awal", en="initial guess",
    )
    P0: float = param(
        1e4, min=1e-9, max=1e9, step=0.1, unit="", log=True,
        id="varians tebakan awal", en="variance of the initial guess",
    )
    # fmt: on


def model(p, dt=None, F=OWN_F, H=OWN_H, x0=None, P0=None):
    """The filter that was built.

    State: the quantity and its rates, as many as the pattern has, then the bias if there is one.
    dt (T,) s: the steps before each measurement, where they are uneven; F and H are those of the
    pattern OWN, whose F belongs to a step, whatever it takes. x0 (n,) and P0, variances (n,) or a
    matrix (n, n): where the filter starts, if p does not say it.
    """
    check(p)
    if p.pattern == OWN:
        F, H = np.atleast_2d(F), np.atleast_2d(H)
        Q, B, P0_found = p.q * np.eye(len(F)), None, np.full(len(F), p.P0)
    else:
        A, Bc, Qc = continuous(p)
        dt = p.dt if dt is None else np.asarray(dt, dtype=float)
        F, Q, B = discretise(A, Qc, dt, Bc)
        H = sensors(p)
        P0_found = p.P0 / np.median(dt) ** (2 * rates(p))
    P0 = np.asarray(P0_found if P0 is None else P0, dtype=float)
    return LinearModel(
        F=F,
        B=B if has_input(p) else None,
        H=H,
        Q=Q,
        R=np.diag([p.R, p.R2][: len(H)]),
        x0=_first(p, H.shape[1]) if x0 is None else x0,
        P0=np.diag(P0) if P0.ndim == 1 else P0,
    )


def continuous(p):
    """A (n, n), Bc (n, 1), Qc (n, n) per second of a pattern: each state is the rate of the one
    before, the noise and a known input are the rate of the last."""
    n = ORDER[p.pattern]
    A = np.eye(n, k=1)
    Bc = np.eye(n)[:, -1:]
    Qc = np.zeros((n, n))
    Qc[-1, -1] = 0 if p.pattern == CONSTANT else p.q
    if not has_bias(p):
        return A, Bc, Qc
    drift = -Bc if p.second == DRIVES else np.zeros((n, 1))  # the input is too high by the bias
    A = np.block([[A, drift], [np.zeros((1, n + 1))]])
    Bc = np.vstack([Bc, [[0.0]]])
    return A, Bc, np.pad(Qc, (0, 1))


def has_input(p):
    """Is the second column, or the third beside a second sensor, a known input?"""
    return p.second == DRIVES or (bool(p.third) and p.second != NONE)


def has_bias(p):
    """Is the bias of the second column a state?"""
    return bool(p.bias) and p.second != NONE


def seen_rate(p):
    """Which state the second column is about: 0 the quantity, 1 its rate, ...

    One that the pattern does not have stands for the highest that it has; an input is the rate of
    that one.
    """
    n = ORDER[p.pattern]
    return n if p.second == DRIVES else min(p.second - ITSELF, n - 1)


def sensors(p):
    """H (m, n): the first column is the quantity itself."""
    n = ORDER[p.pattern]
    H = np.eye(n)[:1]
    if p.second not in (NONE, DRIVES):
        H = np.vstack([H, np.eye(n)[seen_rate(p)]])
    if has_bias(p):
        H = np.hstack([H, np.zeros((len(H), 1))])
        H[1:, -1] = 1
    return H


def rates(p):
    """How often each state is divided by seconds: 0 for the quantity, 1 for its rate, ... (n,)"""
    orders = list(range(ORDER[p.pattern]))
    return np.array(orders + [seen_rate(p)] if has_bias(p) else orders)


def _first(p, n):
    x0 = np.zeros(n)
    x0[0] = p.x0
    return x0


def simulate(p, rng, steps=STEPS):
    """Made-up data of the pattern -> Trajectory. It starts at x0, which the filter hardly knows."""
    made = model(p)
    x0 = np.array(made.x0)
    if p.pattern == OWN:
        x0[:] = 3 * np.sqrt(p.R)
    elif has_bias(p):
        x0[-1] = true_bias(p)
    u = None
    if made.B is not None:
        wave = np.sin(2 * np.pi * np.arange(steps) / PERIOD)
        offset = true_bias(p) * bool(p.bias) if p.second == DRIVES else 0
        u = offset + height_of_wave(p) * wave[:, np.newaxis]
    return simulate_model(made, steps, rng, u, x0)


def height_of_wave(p):
    """Of a known input, so that the quantity swings by ten standard deviations of its sensor."""
    return 10 * np.sqrt(p.R) / (PERIOD * p.dt / (2 * np.pi)) ** ORDER[p.pattern]


def true_bias(p):
    """Of the second column in made-up data: a third of the wave, or what three sigma are."""
    return height_of_wave(p) / 3 if p.second == DRIVES else 3 * np.sqrt(p.R2)
