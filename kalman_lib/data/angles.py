"""Roll, pitch and yaw as a device reports them. Between two moments they go through quaternions, as
angles jump at +-180 degrees."""

import numpy as np


def interpolate_angles(t, times, angles):
    """Roll, pitch, yaw (n, 3) rad at times (n,) -> at t (N,)."""
    q = _quaternions(angles)
    products = (q[1:] * q[:-1]).sum(axis=1)
    flips = np.cumprod(np.append(1, np.where(products < 0, -1, 1)))  # q and -q are one attitude
    q = q * flips[:, np.newaxis]
    q = np.column_stack([np.interp(t, times, part) for part in q.T])
    return _angles(q / np.linalg.norm(q, axis=1, keepdims=True))


def _quaternions(angles):
    """Roll, pitch, yaw (N, 3) rad -> unit quaternions (N, 4), w first, body to north-east-down."""
    cr, cp, cy = np.cos(angles.T / 2)
    sr, sp, sy = np.sin(angles.T / 2)
    return np.column_stack([
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ])


def _angles(q):
    """The inverse of _quaternions."""
    w, x, y, z = q.T
    return np.column_stack([
        np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        np.arcsin(np.clip(2 * (w * y - z * x), -1, 1)),
        np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    ])


def tilt_against(angles, acc):
    """The median angle, degrees, between the vertical that angles (N, 3) claim and that of acc (N,
    3)."""
    roll, pitch, _ = angles.T
    up = np.column_stack([
        np.sin(pitch),
        -np.sin(roll) * np.cos(pitch),
        -np.cos(roll) * np.cos(pitch),
    ])
    cosines = (up * acc).sum(axis=1) / np.linalg.norm(acc, axis=1)
    return np.degrees(np.median(np.arccos(np.clip(cosines, -1, 1))))
