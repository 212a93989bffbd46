"""The attitude filter: the paper's, for each axis a small Kalman filter, and the adaptive one.

The state of a small filter is [angle, s], s the error of the gyroscope's rate u; x is the angle,
and P00, P01, P11 are the elements of its P. The adaptive filter is in vectors.py.
"""

import math
import warnings
from dataclasses import dataclass

import numpy as np

from .method import METHODS, process_noise
from .model import euler_rates, heading, heading_of, tilt, wrap
from .rest import at_start
from .sensors import check_recording, measured, measurement_noise
from .vectors import filter_vectors

STEEP = 75  # degrees: beyond, Euler angles fail


@dataclass(frozen=True, eq=False)
class Attitude:
    """What `attitude` found, all (N, 3), of roll, pitch and yaw; with cells (N, 3, cells).

    angles  rad
    z       measured angles, rad
    u       rates that moved the angles, rad/s
    s       error of the gyroscope's rate, rad/s; of the adaptive method about the body's axes
    y       innovations, rad; of the adaptive method at the end of a block, NaN within it
    P, R    variances of the angles and of their measurements, rad^2
    """

    angles: np.ndarray
    z: np.ndarray
    u: np.ndarray
    s: np.ndarray
    y: np.ndarray
    P: np.ndarray
    R: np.ndarray


def estimate(t, gyr, acc, mag, rest_s=0, method="adaptive"):
    """Roll, pitch and yaw (N, 3) in rad of a recording, all in forward-right-down axes.

    t        (N,) s, increasing; after a pause "adaptive" begins again from the sensors
    gyr      (N, 3) rad/s
    acc      (N, 3) m/s2, specific force (-g on z at rest and level)
    mag      (N, 3) in any unit, or None: then yaw starts at 0 and only the gyroscope turns it
    rest_s   the craft is at rest for so many seconds at the start; 0: it begins in motion
    method   "literal", "paper" or "adaptive", see METHODS

    NaN or only zeros in acc or mag: that sensor is silent at that moment. ValueError: unknown
    method, wrong shapes, NaN in t or gyr, t does not increase, values that no sensor shows, a rest
    of less than 10 samples. UserWarning: the rest is none and is not used; or the pitch comes
    beyond 75 degrees, where Euler angles fail."""
    if method not in METHODS:
        known = ", ".join(METHODS)
        raise ValueError(
            f"method is {method!r}; accepted are {known}. / "
            f"method berisi {method!r}; yang diterima {known}."
        )
    return attitude(t, gyr, acc, mag, rest_s, METHODS[method]).angles


def attitude(t, gyr, acc, mag, rest_s, how):
    """Like `estimate`, with a Method `how`, and returns an Attitude: everything on the way."""
    t, gyr, acc, mag, rest = check_recording(t, gyr, acc, mag, rest_s)
    result = (_by_vectors if how.kept else _by_angles)(t, gyr, acc, mag, rest, how)
    _warn_if_steep(result.angles)
    return result


def _by_vectors(t, gyr, acc, mag, rest, how):
    """The adaptive method; what it does not use itself is added: z and u, as the others have
    them."""
    angles, s, y, P, R = filter_vectors(t, gyr, acc, mag, rest, how)
    z = np.column_stack([tilt(acc), heading(mag, *angles.T[:2])])
    at_rest = gyr[rest].mean(axis=0) if rest.any() and "rest mean" not in how.without else 0
    turn = (gyr[1:] + gyr[:-1]) / 2 - at_rest - s[:-1]
    u = np.column_stack(euler_rates(turn.T, *angles[:-1, :2].T))
    return Attitude(angles, z, np.vstack([np.zeros(3), u]), s, y, P, R)


def _by_angles(t, gyr, acc, mag, rest, how):
    """The paper's method. For each axis F = [[1, -dt], [0, 0]], B = [dt, 0], H = [1, 0]; the
    paper's second state, the rate, is u - s. kalman_filter gives the same numbers (a test
    compares); written out it is ten times as quick."""
    z, start = measured(acc, mag, at_start(t, rest), how)
    R = measurement_noise(t, z, mag, rest, how)
    cells = np.broadcast_shapes(np.shape(how.q), np.shape(how.m))
    estimates_tilt = "estimated tilt" not in how.without
    dt = np.diff(t).tolist()
    turn = _turn(gyr, rest, how).tolist()
    z, mag = z.tolist(), mag.tolist()
    if not cells:
        R = R.tolist()  # plain numbers are quicker than arrays of one
    f = _Filters(how, start, R[0], dt, bool(cells))
    none = [0.0] * 3
    series = [list(row) for row in (start, z[0], none, none, none, R[0], R[0])]
    for k in range(1, len(t)):
        u = f.rates(turn[k - 1], dt[k - 1])
        f.predict(u, dt[k - 1])
        z_k = list(z[k])
        if estimates_tilt and not math.isnan(z_k[2]):
            z_k[2] = heading_of(*mag[k], f.x[0], f.x[1], f.lib)
        is_known = [not math.isnan(z_i) for z_i in z[k]]
        y = f.update(z_k, is_known, R[k])
        P_k = [P00 for P00, _, _ in f.P]
        for column, row in zip(series, (f.x, z_k, u, f.s, y, P_k, R[k])):
            column.extend(row)
    return _as_attitude(series, cells)


def _turn(gyr, rest, how):
    """The gyroscope's rates (N-1, 3) in the middle of each step, without its mean at rest."""
    is_kept = "rest mean" in how.without or not rest.any()
    at_rest = 0 if is_kept else gyr[rest].mean(axis=0)
    return (gyr[1:] + gyr[:-1]) / 2 - at_rest


# --- one step -----------------------------------------------------------------------------------


class _Filters:
    """The three filters as they stand after a step; every list holds roll, pitch and yaw.

    x angles, s errors of their rates, P (P00, P01, P11); R (3,) of the start, dt the lengths of all
    steps."""

    def __init__(self, how, x, R, dt, has_cells):
        self.lib = np if has_cells else math  # one array of all cells, or plain numbers
        self.x = list(x)
        self.s = [0.0] * 3
        self.P = [(R_i, 0.0, 0.0) for R_i in R]
        self.Q = {h: process_noise(how, h) for h in set(dt)}
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
        """Angle += h (u - s), and P = F P F' + Q; the error of a rate is new in every step."""
        x, s = self.x, self.s
        self.x = [x[i] + h * (u[i] - s[i]) for i in range(3)]
        self.s = [0.0] * 3
        Q00, Q01, Q11 = self.Q[h]
        self.P = [(P00 - 2 * h * P01 + h * h * P11 + Q00, Q01, Q11) for P00, P01, P11 in self.P]

    def update(self, z, is_known, R):
        """Blend each angle with its measurement, unless that sensor is silent -> innovations y
        (3)."""
        y = [math.nan] * 3
        for i in range(3):
            if is_known[i]:
                difference = z[i] - self.x[i]
                y[i] = wrap(difference) if self.wraps else difference
                self._blend(i, y[i], R[i])
        if self.wraps:
            self.x[0] = wrap(self.x[0])
            self.x[2] = wrap(self.x[2])
        return y

    def _blend(self, i, y, R):
        """The update of one axis."""
        P00, P01, P11 = self.P[i]
        S = P00 + R
        K0, K1 = P00 / S, P01 / S
        self.x[i] += K0 * y
        self.s[i] += K1 * y
        self.P[i] = K0 * R, K1 * R, P11 - K1 * P01


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
