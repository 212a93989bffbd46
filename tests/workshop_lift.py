"""The made-up ride in a lift of chapter 7: notebooks/data/lift.csv.

python tests/workshop_lift.py writes the file again; tests/test_workshop.py compares it.
"""

from pathlib import Path

import numpy as np

LIFT = Path(__file__).resolve().parent.parent / "notebooks" / "data" / "lift.csv"
HEAD = (
    "# Sintetis / Synthetic: barometer di dalam lift / barometer in a lift\n"
    "waktu;z (m);x_true (m)\n"
)
SECONDS, MISSING = 140, -999
START, SPEED, SIGMA = 12, 1.6, 0.3  # m, m/s, m
UP, DOWN = [40, 42, 58, 60], [90, 92, 100, 102]  # s: it starts, is fast, slows down, stands


def velocity(t):
    """Up, a rest, down; between standing and its speed it needs 2 s."""
    shape = [0, SPEED, SPEED, 0]
    return np.interp(t, UP, shape) - np.interp(t, DOWN, shape)


def height(t):
    fine = np.arange(0, SECONDS + 1, 0.01)
    return np.interp(t, fine, START + np.cumsum(velocity(fine)) * 0.01)


def ride(rng):
    """t (T,) s, uneven; z (T,) m with five outliers and four gaps; the true height (T,) m."""
    t = np.cumsum(rng.uniform(0.4, 1.6, 400)).round(2)
    t = (t - t[0])[t < SECONDS].round(2)
    truth = height(t)
    z = truth + rng.normal(0, SIGMA, t.size)
    odd = rng.choice(np.arange(45, t.size), 9, replace=False)
    outliers, gaps = odd[:5], odd[5:]
    z[outliers] += rng.choice([-1, 1], 5) * rng.uniform(4, 9, 5)
    z[gaps] = MISSING
    return t, z.round(2), truth.round(3), outliers


def clock(seconds):
    """A quarter past nine, and so many seconds."""
    minutes, seconds = divmod(seconds, 60)
    return f"09:{15 + int(minutes)}:{seconds:05.2f}"


def text():
    """The file as it is stored."""
    t, z, truth, _ = ride(np.random.default_rng(2))
    rows = [f"{clock(a)};{b:.2f};{c:.3f}\n" for a, b, c in zip(t, z, truth)]
    return HEAD + "".join(rows).replace(".", ",")


if __name__ == "__main__":
    LIFT.write_text(text(), encoding="utf-8")
