"""The attitude filter: for each axis a small Kalman filter.

Its state is [angle, s], s the error of the gyroscope's rate u; x is the angle, and P00, P01, P11
are the elements of its P.
"""

import math
import warnings
from dataclasses import dataclass

import numpy as np

from .blocks import Block
from .method import METHODS, process_noise
from .model import AXES, euler_rates, heading_of, wrap
from .sensors import check_recording, measured, measurement_noise

STEEP = 75  # degrees: beyond, Euler angles fail


@dataclass(frozen=True, eq=False)
class Attitude:
    """What `attitude` found, all (N, 3), of roll, pitch and yaw; with cells (N, 3, cells).

    angles  rad
    z       measured angles, rad
    u       rates that moved the angles, rad/s
    s       error of the gyroscope's rate, rad/s
    y       innovations, rad; where the bias is kept, the mean of a block at its end, NaN within it
    P, R    variances of the angles and of their measurements, rad^2
    """

    angles: np.ndarray
    z: np.ndarray
    u: np.ndarray
    s: np.ndarray
    y: np.ndarray
    P: np.ndarray
    R: np.ndarray


def estimate(t, gyr, acc, mag, rest_s, method="adaptive"):
    """Roll, pitch and yaw (N, 3) in rad of a recording, all in forward-right-down axes.

    t        (N,) s, increasing
    gyr      (N, 3) rad/s
    acc      (N, 3) m/s2, specific force (-g on z at rest and level)
    mag      (N, 3) in any unit, or None: then yaw starts at 0 and only the gyroscope turns it
    rest_s   the craft is at rest for so many seconds at the start
    method   "literal", "paper" or "adaptive", see METHODS

    NaN in acc or mag: that sensor is silent at that moment. ValueError: unknown method, wrong
    shapes, NaN in t or gyr, t does not increase, no rest of at least 10 samples. UserWarning: the
    pitch comes beyond 75 degrees, where Euler angles fail."""
    if method not in METHODS:
        known = ", ".join(METHODS)
        raise ValueError(
            f"method is {method!r}; accepted are {known}. / "
            f"method berisi {method!r}; yang diterima {known}."
        )
    return attitude(t, gyr, acc, mag, rest_s, METHODS[method]).angles


def attitude(t, gyr, acc, mag, rest_s, how):
    """Like `estimate`, with a Method `how`, and returns an Attitude: everything on the way.

    Each axis is a small Kalman filter with state [angle, s], s the error of the gyroscope's rate u:
    F = [[1, -dt], [0, 1 or 0]], B = [dt, 0], H = [1, 0]. With 0 (not kept) it is the paper's
    filter: its second state, the rate, is u - s. kalman_filter gives the same numbers (a test
    compares); written out it is ten times as quick."""
    t, gyr, acc, mag, rest = check_recording(t, gyr, acc, mag, rest_s)
    z, start = measured(acc, mag, rest, how)
    R = measurement_noise(t, z, mag, rest, how)
    cells = np.broadcast_shapes(np.shape(how.q), np.shape(how.m))
    estimates_tilt = "estimated tilt" not in how.without
    dt = np.diff(t).tolist()
    turn = _turn(gyr, rest, how).tolist()
    z, mag = z.tolist(), mag.tolist()
    if not cells:
        R = R.tolist()  # plain numbers are quicker than arrays of one
    f = _Filters(how, start, R[0], _bias_variance(gyr, rest, rest_s, how), dt, bool(cells))
    none = [0.0] * 3
    series = [list(row) for row in (start, z[0], none, none, none, R[0], R[0])]
    for k in range(1, len(t)):
        u = f.rates(turn[k - 1], dt[k - 1])
        f.predict(u, dt[k - 1])
        z_k = list(z[k])
        if estimates_tilt and not math.isnan(z_k[2]):
            z_k[2] = heading_of(*mag[k], f.x[0], f.x[1], f.lib)
        is_known = [not math.isnan(z_i) for z_i in z[k]]
        y, R_k = f.update(z_k, is_known, R[k])
        P_k = [P00 for P00, _, _ in f.P]
        for column, row in zip(series, (f.x, z_k, u, f.s, y, P_k, R_k)):
            column.extend(row)
    result = _as_attitude(series, cells)
    _warn_if_steep(result.angles)
    return result


# --- before the first step ----------------------------------------------------------------------


def _turn(gyr, rest, how):
    """The gyroscope's rates (N-1, 3) in the middle of each step, without its mean at rest."""
    at_rest = 0 if "rest mean" in how.without else gyr[rest].mean(axis=0)
    return (gyr[1:] + gyr[:-1]) / 2 - at_rest


def _bias_variance(gyr, rest, rest_s, how):
    """The variance of the mean at rest, which has one independent value a second."""
    return gyr[rest].var(axis=0).mean() / rest_s if how.kept else 0.0


# --- one step -----------------------------------------------------------------------------------


class _Filters:
    """The three filters as they stand after a step; every list holds roll, pitch and yaw.

    x angles, s errors of their rates, P (P00, P01, P11); R (3,) of the start, dt the lengths of all
    steps."""

    def __init__(self, how, x, R, P_s, dt, has_cells):
        self.how = how
        self.lib = np if has_cells else math  # one array of all cells, or plain numbers
        self.x = list(x)
        self.s = [0.0] * 3
        self.P = [(R_i, 0.0, P_s) for R_i in R]
        self.Q = {h: process_noise(how, h) for h in set(dt)}
        self.blocks = [Block(how, np.median(dt)) for _ in AXES]
        self.wraps = "wrapping" not in how.without
        self.turns_rates = "Euler rates" not in how.without
        self.looks_ahead = "midpoint" not in how.without

    def rates(self, turn, h):
        """The rates of the three angles during a step of h seconds, taken at the angles in its
        middle."""
        if not self.turns_rates:
            return turn
        x, s = self.x, self.s
        u = euler_rates(turn, x[0], x[1], self.lib)
        if not self.looks_ahead:
            return u
        roll = x[0] + h / 2 * (u[0] - s[0])
        pitch = x[1] + h / 2 * (u[1] - s[1])
        return euler_rates(turn, roll, pitch, self.lib)

    def predict(self, u, h):
        """Angle += h (u - s), and P = F P F' + Q."""
        x, s = self.x, self.s
        self.x = [x[i] + h * (u[i] - s[i]) for i in range(3)]
        self.s = list(s) if self.how.kept else [0.0] * 3
        Q, keep = self.Q[h], float(self.how.kept)
        self.P = [_predicted(P, Q, h, keep) for P in self.P]

    def update(self, z, is_known, R):
        """Blend each angle with its measurement, unless that sensor is silent or its block is not
        full -> innovations y and R (3)."""
        y, R = [math.nan] * 3, list(R)
        for i in range(3):
            if not is_known[i]:
                continue
            difference = z[i] - self.x[i]
            y_i = wrap(difference) if self.wraps else difference
            if not self.how.kept:
                y[i] = y_i
                self._blend(i, y_i, R[i])
            elif self.blocks[i].is_full_with(y_i):
                y[i], R[i] = self.blocks[i].witness(self.P[i][0], R[i])
                self.blocks[i].start_again(moved=self._blend(i, y[i], R[i]))
        if self.wraps:
            self.x[0] = wrap(self.x[0])
            self.x[2] = wrap(self.x[2])
        return y, R

    def _blend(self, i, y, R):
        """The update of one axis -> by how much its angle moved."""
        P00, P01, P11 = self.P[i]
        S = P00 + R
        K0, K1 = P00 / S, P01 / S
        self.x[i] += K0 * y
        self.s[i] += K1 * y
        self.P[i] = K0 * R, K1 * R, P11 - K1 * P01
        return K0 * y


def _predicted(P, Q, h, keep):
    """F P F' + Q of one axis, F = [[1, -h], [0, keep]]; P and Q as their elements 00, 01 and 11."""
    P00, P01, P11 = P
    Q00, Q01, Q11 = Q
    return (
        P00 - 2 * h * P01 + h * h * P11 + Q00,
        keep * (P01 - h * P11) + Q01,
        keep * P11 + Q11,
    )


# --- after the last step ------------------------------------------------------------------------


def _as_attitude(series, cells):
    """The Attitude of seven lists, which hold one number after another, or one array of cells."""
    arrays = []
    for column in series:
        if cells:
            column = [np.broadcast_to(value, cells) for value in column]
        arrays.append(np.array(column).reshape(-1, 3, *cells))
    return Attitude(*arrays)


def _warn_if_steep(angles):
    steepest = np.degrees(np.abs(angles[:, 1]).max())
    if steepest > STEEP:
        warnings.warn(
            f"The pitch reaches {steepest:.0f} degrees: beyond 75 degrees Euler angles fail, use "
            f"quaternions. / Pitch mencapai {steepest:.0f} derajat: di atas 75 derajat sudut Euler "
            "gagal, pakailah kuaternion.",
            stacklevel=3,
        )
