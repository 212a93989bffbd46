"""Chapter 6: attitudes from every side, how SciPy turns a vector by them, and what is demanded."""

import numpy as np
from scipy.spatial.transform import Rotation

from kalman_lib.papers.quadrotor import DEG


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
