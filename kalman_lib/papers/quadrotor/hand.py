"""One axis in the hand: a SYNTHETIC quadrotor is tilted and put back, then pushed sideways."""

import numpy as np

from ...models import LinearModel
from ...simulate import Trajectory
from .model import DEG, GRAVITY
from .route import gentle

SECONDS = 20
TILTS = (3, 9)  # s: begins to tilt, begins to come back
MOVING = 2  # s for each of the two
PUSHED = (13, 14)  # s


def hold(rng, held=20, push=3, bias=0.5, sigma_gyr=1, sigma_acc=1, dt=0.1):
    """A Trajectory of N steps of dt seconds; unlike elsewhere in this package in DEGREES.

    x (N, 1)  true roll: level, tilted by `held`, level again
    z (N, 1)  roll of the accelerometer: noise of sigma_acc on its axes, and an acceleration `push`
              to the left for one second (all m/s2), while nothing tilts
    u (N, 1)  gyroscope: the true rate during the step, a constant bias, noise of sigma_gyr (deg/s)
    """
    t = hand_times(dt)
    roll = held * (gentle((t - TILTS[0]) / MOVING) - gentle((t - TILTS[1]) / MOVING))
    rate = np.diff(roll, prepend=0) / dt
    sideways = np.where((t >= PUSHED[0]) & (t < PUSHED[1]), push, 0)
    noise = rng.normal(size=(3, len(t)))
    sine, cosine = np.sin(DEG * roll), np.cos(DEG * roll)
    acc_y = -GRAVITY * sine - sideways * cosine + sigma_acc * noise[1]
    acc_z = -GRAVITY * cosine + sideways * sine + sigma_acc * noise[2]
    z = np.degrees(np.arctan2(-acc_y, -acc_z))
    u = rate + bias + sigma_gyr * noise[0]
    return Trajectory(roll[:, np.newaxis], z[:, np.newaxis], u[:, np.newaxis])


def hand_times(dt=0.1):
    """The times (N,) s of `hold`."""
    return dt * np.arange(1, round(SECONDS / dt) + 1)


def one_angle(R, sigma_gyr=1, dt=0.1):
    """The smallest filter of the chapter, in degrees: the state is the angle, which u moves."""
    return LinearModel(
        F=[[1]], B=[[dt]], H=[[1]], Q=[[(sigma_gyr * dt) ** 2]], R=[[R]], x0=[0], P0=[[1]]
    )
