"""A toy paper: a bottle on a scale, filled at a known rate. Source: none, it is made up here.

tests/test_recipe.py adds it to a copy of the book, as CONTRIBUTING.md says.
"""

from dataclasses import dataclass

import numpy as np

from ..models import LinearModel
from ..simulate import simulate as simulate_model
from . import check, param

STEPS = 60


@dataclass(frozen=True)
class Params:
    """A made-up bottle."""

    # fmt: off
    flow: float = param(
        0.02, min=0, max=0.1, step=0.01, unit="kg/s",
        id="debit keran", en="flow of the tap",
    )
    sigma_flow: float = param(
        0.01, min=0.001, max=0.1, step=0.1, unit="kg/s", log=True,
        id="simpangan baku debit", en="standard deviation of the flow",
    )
    sigma_scale: float = param(
        0.05, min=0.001, max=1, step=0.1, unit="kg", log=True,
        id="simpangan baku timbangan", en="standard deviation of the scale",
    )
    # fmt: on


def model(p):
    """State: the mass (kg), a step a second; input: the flow (kg/s); measured: the mass."""
    check(p)
    return LinearModel(F=1, B=1, H=1, Q=p.sigma_flow**2, R=p.sigma_scale**2, x0=0, P0=0.01)


def simulate(p, rng, steps=STEPS):
    """A synthetic minute at the tap -> Trajectory."""
    return simulate_model(model(p), steps, rng, u=np.full((steps, 1), p.flow))
