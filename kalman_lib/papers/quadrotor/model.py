"""The paper's model, equations (10)-(24), and what each sensor says alone, equations (1)-(9)."""

import math

import numpy as np

from ...models import LinearModel
from .. import check

AXES = ("roll", "pitch", "yaw")
PI = math.pi
DEG = math.pi / 180  # rad
GRAVITY = 9.81  # m/s2
FIELD = np.array([38.13, 0, -23.79])  # uT, Yogyakarta, 2022 (IGRF-13); x is magnetic north
STEEPEST = 85 * DEG


def model(p):
    """The paper's model: state [roll, its rate, pitch, its rate, yaw, its rate], rad and rad/s.

    Measured: the three angles; input u: the three rates (the rate of the state is the latest
    input). Innovations are wrapped at +-pi. R: variances of the angles of the simulated sensors at
    rest, rad^2."""
    check(p)
    F, B, H, Q = axis(p.dt, p.q * DEG**2)
    one_a_piece = np.eye(3)  # the three axes do not touch each other
    sigma_tilt = p.sigma_acc / GRAVITY
    sigma_yaw = p.sigma_mag / np.hypot(*FIELD[:2])
    R = np.diag([sigma_tilt, sigma_tilt, sigma_yaw]) ** 2
    return LinearModel(
        F=np.kron(one_a_piece, F),
        B=np.kron(one_a_piece, B),
        H=np.kron(one_a_piece, H),
        Q=np.kron(one_a_piece, Q),
        R=R,
        x0=[0, 0, 0, 0, np.pi, 0],
        P0=np.kron(R, [[1, 0], [0, 0]]),
        residual=wrapped_difference,
    )


def axis(dt, q):
    """F, B, H and Q of one axis with state [angle, rate], equations (12), (15), (18) and (20).

    q scales Q, rad^2/s^3.
    """
    F = np.array([
        [1, dt],
        [0, 0],  # the rate is the input
    ])
    B = np.array([
        [0],
        [1],
    ])
    H = np.array([[1, 0]])
    Q = q * np.array([
        [dt**3 / 3, dt**2 / 2],
        [dt**2 / 2, dt],
    ])
    return F, B, H, Q


def wrap(angle):
    """The same angle between -pi and pi."""
    return (angle + PI) % (2 * PI) - PI


def wrapped_difference(z, z_pred):
    """The innovation of an angle: from +179 to -179 degrees it is 2 degrees, not 358."""
    return wrap(z - z_pred)


# --- what each sensor says alone ----------------------------------------------------------------


def tilt(acc):
    """Roll and pitch (N, 2) of the accelerometer alone, from acc (N, 3): right only without
    acceleration."""
    x, y, z = np.moveaxis(np.asarray(acc), 1, 0)
    roll = np.arctan2(-y, -z)
    pitch = np.arctan2(x, np.hypot(y, z))
    return np.stack([roll, pitch], axis=1)


def printed_tilt(acc):
    """Roll and pitch (N, 2) as equations (2) and (1) print them, both with the root of ax^2 +
    az^2."""
    x, y, z = np.moveaxis(np.asarray(acc), 1, 0)
    root = np.hypot(x, z)
    return np.stack([np.arctan(-y / root), np.arctan(x / root)], axis=1)


def heading(mag, roll, pitch):
    """Yaw (N,) of the magnetometer mag (N, 3), its vector turned back to the horizontal by roll and
    pitch (N,)."""
    x, y, z = np.moveaxis(np.asarray(mag), 1, 0)
    return heading_of(x, y, z, roll, pitch, np)


def heading_of(x, y, z, roll, pitch, lib):
    """The same of one measurement; lib: math for numbers, numpy for arrays."""
    sin_r, cos_r = lib.sin(roll), lib.cos(roll)
    sin_p, cos_p = lib.sin(pitch), lib.cos(pitch)
    to_the_north = x * cos_p + (y * sin_r + z * cos_r) * sin_p
    to_the_right = y * cos_r - z * sin_r
    return lib.atan2(-to_the_right, to_the_north)


def euler_rates(gyr, roll, pitch, lib=np):
    """Rates of roll, pitch and yaw from the body's rates gyr = (p, q, r).

    At pitch +-90 deg they have no bound; beyond 85 deg they are those at 85, wrong but finite.
    """
    p, q, r = gyr
    if lib is np or not -STEEPEST < pitch < STEEPEST:
        pitch = np.clip(pitch, -STEEPEST, STEEPEST)
    sin_r, cos_r = lib.sin(roll), lib.cos(roll)
    turn = q * sin_r + r * cos_r
    return p + turn * lib.tan(pitch), q * cos_r - r * sin_r, turn / lib.cos(pitch)
