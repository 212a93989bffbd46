"""Attitudes as quaternions, which know no pitch at which they fail.

A quaternion is four numbers (w, x, y, z) of length 1; here it turns the body's axes into
north-east-down.
"""

import math

import numpy as np


def product(p, q):
    """First the turn q, then p."""
    pw, px, py, pz = p
    qw, qx, qy, qz = q
    return (
        pw * qw - px * qx - py * qy - pz * qz,
        pw * qx + px * qw + py * qz - pz * qy,
        pw * qy - px * qz + py * qw + pz * qx,
        pw * qz + px * qy - py * qx + pz * qw,
    )


def turn_by(x, y, z):
    """The turn about the axis (x, y, z), by its length in rad."""
    half = math.sqrt(x * x + y * y + z * z) / 2
    share = math.sin(half) / (2 * half) if half > 0 else 0.5
    return math.cos(half), share * x, share * y, share * z


def unit(q):
    """The same turn with length 1 again: rounding adds up."""
    length = math.sqrt(sum(part * part for part in q))
    return tuple(part / length for part in q)


def matrix_of(q):
    """The rotation matrix (3, 3): its columns are the body's axes, seen in north-east-down."""
    w, x, y, z = q
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


def angles_of(q):
    """Roll, pitch, yaw."""
    w, x, y, z = q
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


def quaternion_of(roll, pitch, yaw):
    """The inverse of angles_of: turned by yaw first, then pitch, then roll."""
    level = product(turn_by(0, 0, yaw), turn_by(0, pitch, 0))
    return product(level, turn_by(roll, 0, 0))
