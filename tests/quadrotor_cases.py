"""Chapter 6: attitudes from every side, how SciPy turns a vector by them, and what is demanded."""

import numpy as np
from scipy.spatial.transform import Rotation

from kalman_lib.papers.quadrotor import DEG, FIELD, GRAVITY, body_rates, to_body
from kalman_lib.papers.quadrotor.route import coloured


def degrees(x):
    return np.array(x) * DEG


ATTITUDES = degrees([
    [0, 0, 0],
    [20, 0, 0],
    [0, 20, 0],
    [20, 20, 65],
    [-35, 10, 179],
    [5, -60, -90],
    [120, 30, -10],
])


def body_to_ned(angles):
    return Rotation.from_euler("ZYX", angles[::-1])  # yaw first, then pitch, then roll


# The errors, degrees, of roll, pitch and yaw that the book demands of each method
LIMITS = {
    "paper": {
        "flight": "0.9 1.6 2.5",
        "broad10": "1.2 1.2 2.2",
        "quad123": "0.9 1.8 2.8",
        "p4rtk_dot1": "1.2 3.6 2.9",
    },
    "adaptive": {
        "flight": "0.45 0.5 1.6",
        "broad10": "0.5 1.0 1.9",
        "quad123": "0.8 0.9 2.5",
        "p4rtk_dot1": "0.9 1.4 2.7",
    },
}


# --- a walk -------------------------------------------------------------------------------------

STRIDE = 1.8  # steps a second
SPEED = 1.3  # m/s


def walk(rng, seconds=80, dt=0.01):
    """A SYNTHETIC walk through a room, a phone in the hand from the first sample on -> (t, gyr,
    acc, mag), truth (N, 3).

    Straight for some seconds, then a turn of 60 to 130 degrees; every step shakes the phone, the
    arm swings, iron bends the field. Noise, biases, scales as of a phone."""
    t = np.arange(0, seconds, dt)
    heading = _walked_heading(rng, t)
    phase = 2 * np.pi * STRIDE * np.cumsum(1 + 0.05 * coloured(rng, t, 2)[:, 0]) * dt
    ahead = np.column_stack([np.cos(heading), np.sin(heading), 0 * t])
    right = np.column_stack([-np.sin(heading), np.cos(heading), 0 * t])
    speed = SPEED * (1 + 0.1 * coloured(rng, t, 1)[:, :1])
    shaken = 1.5 * np.sin(phase) + 0.6 * np.sin(2 * phase + 1)
    force = np.gradient(speed * ahead, dt, axis=0) + shaken[:, np.newaxis] * ahead
    force += np.sin(phase / 2)[:, np.newaxis] * right
    force[:, 2] += 2.5 * np.sin(phase + 0.7) + 1.2 * np.sin(2 * phase + 0.3) - GRAVITY
    hand = coloured(rng, t, 1.5) * 8 + coloured(rng, t, 0.3) * 2
    swing = np.column_stack([4 * np.sin(phase / 2), 30 + 8 * np.sin(phase / 2 + 0.5), 0 * t])
    truth = (hand + swing) * DEG + np.column_stack([0 * t, 0 * t, heading])
    rates = body_rates(np.gradient(truth, dt, axis=0), truth)
    gyr = rates * rng.normal(1, 0.01, 3) + rng.normal(0, 0.5, 3) * DEG
    gyr += rng.normal(0, 0.15, truth.shape) * DEG
    acc = to_body(force, truth) + rng.normal(0, 0.05, 3) + rng.normal(0, 0.05, truth.shape)
    mag = to_body(FIELD + 2 * coloured(rng, t, 3), truth)
    mag += rng.normal(0, 1, 3) + rng.normal(0, 0.5, truth.shape)
    return (t, gyr, acc, mag), truth


def _walked_heading(rng, t):
    dt, corner, angle = t[1] - t[0], 0, rng.uniform(-np.pi, np.pi)
    heading = np.zeros(len(t))
    while corner < len(t):
        end = corner + int(rng.uniform(3, 6) / dt)
        heading[corner:end] = angle
        angle += rng.choice([-1, 1]) * rng.uniform(60, 130) * DEG
        corner = end
    bell = np.exp(-0.5 * (np.arange(-1, 1 + dt / 2, dt) / 0.25) ** 2)
    longer = np.pad(heading, len(bell) // 2, mode="edge")
    return np.convolve(longer, bell / bell.sum(), "valid")[: len(t)]
