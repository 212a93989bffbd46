"""Chapter 1: a car on a line whose position is measured.

Source: the lecture notes, part d ("Contoh Soal").
"""

from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import simulate as simulate_model
from . import check, param

# What the source prints, to the digits it prints
PRINTED = {
    "x_pred": "2.5 4",
    "P_pred": "0.36 0.5 0.5 1.1",
    "K": "0.88 1.22",
    "x": "2.24 3.63",
    "P": "0.04 0.06 0.06 0.49",
}


@dataclass(frozen=True)
class Params:
    """The source's numbers, and how far the reader may move them."""

    # fmt: off
    dt: float = param(
        0.5, min=0.1, max=2, step=0.1, unit="s",
        id="langkah waktu", en="time step",
    )
    Q: float = param(
        0.1, min=1e-4, max=10, step=0.1, unit="m², m²/s²", log=True,
        id="varians derau proses (posisi dan kecepatan)",
        en="process-noise variance (position and velocity)",
    )
    R: float = param(
        0.05, min=1e-4, max=10, step=0.1, unit="m²", log=True,
        id="varians derau pengukuran", en="measurement-noise variance",
    )
    u: float = param(
        -2, min=-5, max=5, step=0.1, unit="m/s²",
        id="percepatan (rem)", en="acceleration (brake)",
    )
    z: float = param(
        2.2, min=-5, max=10, step=0.1, unit="m",
        id="posisi terukur", en="measured position",
    )
    position: float = param(
        0, min=-5, max=5, step=0.1, unit="m",
        id="posisi awal", en="initial position",
    )
    velocity: float = param(
        5, min=-10, max=10, step=0.1, unit="m/s",
        id="kecepatan awal", en="initial velocity",
    )
    P_position: float = param(
        0.01, min=1e-4, max=10, step=0.1, unit="m²", log=True,
        id="varians posisi awal", en="variance of the initial position",
    )
    P_velocity: float = param(
        1, min=1e-4, max=10, step=0.1, unit="m²/s²", log=True,
        id="varians kecepatan awal", en="variance of the initial velocity",
    )
    # fmt: on


def model(p):
    """State [position m, velocity m/s], input the acceleration m/s2, measured: the position m."""
    check(p)
    return LinearModel(
        F=[[1, p.dt], [0, 1]],
        B=[[0], [p.dt]],
        H=[[1, 0]],
        Q=p.Q * np.eye(2),
        R=p.R,
        x0=[p.position, p.velocity],
        P0=np.diag([p.P_position, p.P_velocity]),
    )


def simulate(p, rng, steps=10):
    """A synthetic drive with the constant input p.u -> Trajectory."""
    return simulate_model(model(p), steps, rng, u=np.full((steps, 1), p.u))


def fuse(a, var_a, b, var_b):
    """The scalar update: two measurements of one length -> (estimate, variance, gain).

    estimate = a + K (b - a), K = var_a / (var_a + var_b), which weights each measurement by
    1 / variance. ValueError: a variance is not positive.
    """
    if not (var_a > 0 and var_b > 0):
        raise ValueError(
            f"variances {var_a} and {var_b}: expected positive numbers. / "
            f"varians {var_a} dan {var_b}: seharusnya bilangan positif."
        )
    K = var_a / (var_a + var_b)
    return a + K * (b - a), K * var_b, K
