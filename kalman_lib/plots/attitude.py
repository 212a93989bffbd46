"""A craft with four rotors, as chapter 6 estimates its attitude."""

import numpy as np

from ..papers import quadrotor
from .figure import new_figure
from .styles import ESTIMATE, TRUTH

APART = 3.2  # between two craft
CIRCLE = np.linspace(0, 2 * np.pi, 33)
RING = 0.38 * np.column_stack([np.cos(CIRCLE), np.sin(CIRCLE), np.zeros(33)])
NOSE = np.array([
    [-0.2, 0, 0],
    [1.25, 0, 0],
    [1.0, 0.14, 0],
    [1.25, 0, 0],
    [1.0, -0.14, 0],
])
TIPS = 0.75 * np.array([
    [1, 1, 0],
    [1, -1, 0],
    [-1, -1, 0],
    [-1, 1, 0],
])
# Lines in the axes of the body: forward, right, down
SHAPE = [NOSE, TIPS[[0, 2]], TIPS[[1, 3]], *(tip + RING for tip in TIPS)]


def craft(moments, height=1.9):
    """A craft with four rotors, seen from the south and from above: a dict of (estimate, truth or
    None).

    Each is roll, pitch and yaw (3,) in rad. Thick: the estimate, thin: the truth; the arrow is the
    nose."""
    with new_figure(height) as (figure, ax):
        for place, (label, (estimate, truth)) in enumerate(moments.items()):
            _draw_craft(ax, APART * place, estimate, {**ESTIMATE, "linewidth": 2.2})
            if truth is not None:
                _draw_craft(ax, APART * place, truth, TRUTH)
            ax.text(APART * place, -1.75, label, ha="center", va="bottom", fontsize="small")
        right_end = APART * len(moments) - 1.6
        ax.set(xlim=(-1.6, right_end), ylim=(-1.8, 1.45), aspect="equal")
        ax.set_axis_off()
    return figure


def _draw_craft(ax, middle, angles, look):
    to_earth = quadrotor.to_body(np.eye(3), np.tile(angles, (3, 1)))
    for line in SHAPE:
        north, east, down = to_earth @ line.T
        ax.plot(middle + east, 0.6 * north - 0.8 * down, solid_capstyle="round", **look)
