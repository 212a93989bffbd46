"""SYNTHETIC flights, and what the three sensors say on them."""

from dataclasses import dataclass

import numpy as np

from ...simulate import Trajectory
from .. import check
from .model import DEG, FIELD, GRAVITY, heading, tilt, wrap
from .route import REST, coloured, gentle, route_of

DRAG = 0.35  # 1/s: how much of its speed the air takes from the craft
SWAY = [1, 1, 0.5]  # north, east, down
SWAY_SECONDS = 0.5  # in which the swaying changes
MOTORS = 1.0  # uT: their disturbance of the magnetometer
MOTOR_SECONDS = 2.0  # in which it changes
WEIGHT = [0, 0, GRAVITY]  # m/s2, NED
SWINGING = 60  # s


@dataclass(frozen=True, eq=False)
class Flight(Trajectory):
    """A Trajectory with its sensors.

    x       (N, 6) true state of `model`
    z       (N, 3) what the sensors alone say of the angles
    u       (N, 3) = gyr rad/s
    t       (N,) s
    acc     (N, 3) m/s2
    mag     (N, 3) uT
    rest_s  still for so many seconds at the start
    """

    t: np.ndarray = None
    acc: np.ndarray = None
    mag: np.ndarray = None
    rest_s: float = REST

    @property
    def gyr(self):
        return self.u

    @property
    def truth(self):
        """Roll, pitch and yaw (N, 3) rad."""
        return self.x[:, ::2]

    @property
    def sensors(self):
        """The arguments of `estimate`."""
        return self.t, self.gyr, self.acc, self.mag, self.rest_s


def simulate(p, rng):
    """A SYNTHETIC flight along the paper's route -> Flight.

    The attitude follows from the motion: rotors push only along the body's downward axis and the
    air drags against the motion, so thrust = acceleration - gravity + drag; its direction gives
    roll and pitch. In the air the craft sways with random accelerations of p.sway (correlated over
    0.5 s) and the motors disturb the magnetometer (1 uT, correlated over 2 s). Sensors: white
    noise, and a gyroscope bias drawn once with standard deviation p.bias."""
    check(p)
    t, yaw, speed, aloft = route_of(p.dt)
    aloft = aloft[:, np.newaxis]
    ahead = np.column_stack([np.cos(yaw), np.sin(yaw), np.zeros(len(t))])  # NED
    velocity = speed[:, np.newaxis] * ahead
    sway = p.sway * aloft * coloured(rng, t, SWAY_SECONDS) * SWAY
    force = np.gradient(velocity, p.dt, axis=0) + sway - WEIGHT  # specific force, m/s2
    truth = _angles_of(force, velocity, yaw)
    disturbance = MOTORS * aloft * coloured(rng, t, MOTOR_SECONDS)
    return _flight(p, rng, t, truth, force, disturbance)


def _angles_of(force, velocity, yaw):
    """Roll, pitch, yaw (N, 3): the thrust must push where the craft accelerates, and against the
    drag."""
    push = -(force + DRAG * velocity)  # thrust turned round: the body's down
    north, east, down = push.T
    x = north * np.cos(yaw) + east * np.sin(yaw)
    y = east * np.cos(yaw) - north * np.sin(yaw)
    roll = -np.arctan2(y, np.hypot(x, down))
    pitch = np.arctan2(x, down)
    return np.column_stack([roll, pitch, yaw])


def swing(p, rng):
    """A SYNTHETIC fast motion by hand, 60 s -> Flight: roll and pitch swing by 45 and 35 degrees
    while it turns.

    Accelerations of 1 m/s2 (correlated over 0.5 s); noise and bias of the sensors as in `simulate`,
    no disturbance."""
    check(p)
    t = np.arange(0, REST + SWINGING, p.dt)
    moves = gentle((t - REST) / 3)
    moving = np.clip(t - REST, 0, None)  # s
    roll = 45 * DEG * moves * np.sin(3.1 * moving)
    pitch = 35 * DEG * moves * np.sin(2.3 * moving)
    yaw = np.pi + 120 * DEG * moves * np.sin(0.7 * moving)
    truth = np.column_stack([roll, pitch, yaw])
    force = moves[:, np.newaxis] * coloured(rng, t, SWAY_SECONDS) - WEIGHT
    return _flight(p, rng, t, truth, force, np.zeros(3))


def _flight(p, rng, t, truth, force, disturbance):
    """A Flight along the true angles (N, 3), with the specific force (N, 3) m/s2 NED and a magnetic
    disturbance, uT."""
    rates = np.gradient(truth, p.dt, axis=0)
    bias = p.bias * DEG * rng.normal(size=3)
    shape = truth.shape
    gyr = body_rates(rates, truth) + bias + p.sigma_gyr * DEG * rng.normal(size=shape)
    acc = to_body(force, truth) + p.sigma_acc * rng.normal(size=shape)
    mag = to_body(FIELD, truth) + disturbance + p.sigma_mag * rng.normal(size=shape)
    state = np.stack([wrap(truth), rates], axis=2).reshape(-1, 6)
    roll_pitch = tilt(acc)
    yaw = heading(mag, roll_pitch[:, 0], roll_pitch[:, 1])
    return Flight(state, np.column_stack([roll_pitch, yaw]), gyr, t, acc, mag)


def body_rates(rates, angles):
    """The gyroscope's rates (N, 3) for rates (N, 3) of roll, pitch, yaw at these angles (N, 3):
    euler_rates undone."""
    roll_rate, pitch_rate, yaw_rate = rates.T
    roll, pitch, _ = angles.T
    sin_r, cos_r = np.sin(roll), np.cos(roll)
    sin_p, cos_p = np.sin(pitch), np.cos(pitch)
    return np.column_stack([
        roll_rate - yaw_rate * sin_p,
        pitch_rate * cos_r + yaw_rate * sin_r * cos_p,
        yaw_rate * cos_r * cos_p - pitch_rate * sin_r,
    ])


def to_body(v, angles):
    """A vector v (N, 3) or (3,), NED, seen in the body's axes at the angles (N, 3): turned by yaw,
    pitch, roll."""
    north, east, down = np.broadcast_to(v, angles.shape).T
    roll, pitch, yaw = angles.T
    ahead = north * np.cos(yaw) + east * np.sin(yaw)
    right = east * np.cos(yaw) - north * np.sin(yaw)
    below = ahead * np.sin(pitch) + down * np.cos(pitch)
    return np.column_stack([
        ahead * np.cos(pitch) - down * np.sin(pitch),
        right * np.cos(roll) + below * np.sin(roll),
        below * np.cos(roll) - right * np.sin(roll),
    ])
