"""Where the flight leads, smoothly, and noise that changes slowly."""

import numpy as np

from .model import AXES, DEG

# The paper's route: seconds of straight flight, after a turn by so many degrees (to the left is
# negative)
ROUTE = ((30, 0), (20, -65), (15, -115), (20, -80), (15, -100))
REST = 6.0  # s before take-off
TURN_RATE = 25  # deg/s
CRUISE = 2.0  # m/s
IN_A_TURN = 0.5  # m/s
CLIMB = 2  # s from the ground to the height of the flight
LANDED = 4  # s at the end
YAW_SECONDS = 0.3  # in which a turn begins
SPEED_SECONDS = 0.8  # in which the craft speeds up


def route_of(dt):
    """Times t (N,) s, yaw (N,) rad, speed (N,) m/s, and how much the craft is aloft (N,), 0 to
    1."""
    time, yaw, speed = np.array(_corners()).T
    time = time + 1e-9 * np.arange(len(time))  # two corners at one moment: in this order
    t = np.arange(0, time[-1], dt)
    aloft = gentle((t - REST) / CLIMB)
    yaw = DEG * _smooth(np.interp(t, time, yaw), dt, YAW_SECONDS)
    speed = aloft * _smooth(np.interp(t, time, speed), dt, SPEED_SECONDS)
    return t, yaw, speed, aloft


def _corners():
    """(time s, yaw degrees, speed m/s) between which the craft goes evenly; it faces south at
    first."""
    time, yaw = REST + CLIMB, 180
    corners = [(0, yaw, 0), (time, yaw, 0)]
    for seconds, turn in ROUTE:
        if turn:
            corners.append((time, yaw, IN_A_TURN))
            time += abs(turn) / TURN_RATE
            yaw += turn
            corners.append((time, yaw, IN_A_TURN))
        corners.append((time, yaw, CRUISE))
        time += seconds
        corners.append((time, yaw, CRUISE))
    return [*corners, (time, yaw, 0), (time + LANDED, yaw, 0)]


def gentle(part):
    """From 0 to 1 while `part` (N,) does so, without a jerk at either end."""
    part = np.clip(part, 0, 1)
    return part**2 * (3 - 2 * part)


def _bell(dt, tau):
    """A bell curve of width tau (s)."""
    n = int(4 * tau / dt)
    return np.exp(-0.5 * (np.arange(-n, n + 1) * dt / tau) ** 2)


def _smooth(values, dt, tau):
    """values (N,) smoothed by a bell of width tau (s)."""
    bell = _bell(dt, tau)
    longer = np.pad(values, len(bell) // 2, mode="edge")
    return np.convolve(longer, bell / bell.sum(), "valid")


def coloured(rng, t, tau):
    """Three (N, 3) random signals of standard deviation 1 that change within tau (s)."""
    bell = _bell(t[1] - t[0], tau)
    bell /= np.sqrt((bell**2).sum())
    drawn = len(t) + len(bell) - 1
    columns = [np.convolve(rng.normal(size=drawn), bell, "valid") for _ in AXES]
    return np.column_stack(columns)
