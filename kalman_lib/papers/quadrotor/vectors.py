"""The adaptive method: one filter for all three angles, which compares vectors.

Its attitude is a quaternion. The state of the filter is what may be wrong: e, the angles (rad) by
which it must still be turned about north, east and down, and s, the error of the gyroscope's rates
about the body's axes. From sample to sample F = [[I, -C dt], [0, I]], with C (3, 3) the body's axes
seen in north-east-down.
"""

import math

import numpy as np

from .blocks import Block, Kind
from .model import DEG, STEEPEST, heading_of, tilt
from .quaternion import angles_of, matrix_of, product, quaternion_of, turn_by, unit
from .rest import START

# R of the mean of a block, rad2. Accelerations of whoever walks or flies: 0.5 m/s2 (3 degrees) last
# for seconds. Iron in a building bends the field by 5 degrees. No sensor is mounted better than
# within a degree or two.
TILT = Kind(1.0, least=(0.7 * DEG) ** 2, usual=(3 * DEG) ** 2, lasting=(3 * DEG) ** 2)  # two steps
YAW = Kind(5.0, least=(1.5 * DEG) ** 2, usual=(5 * DEG) ** 2, lasting=(5 * DEG) ** 2)  # some metres
UNSURE_TILT = (10 * DEG) ** 2  # rad2, of an attitude taken from few seconds of motion
UNSURE_YAW = (20 * DEG) ** 2
USUAL_BIAS = (1 * DEG) ** 2  # rad2/s2, variance of the bias of a phone's gyroscope
SCALE = 0.01  # share by which a gyroscope's rates are too large or too small
LEARNS = 60.0  # s, from which the bias is learned where there is no rest
PAUSE = 0.3  # s; a longer step says nothing of the turn between
E_, S_ = slice(0, 3), slice(3, 6)


def filter_vectors(t, gyr, acc, mag, rest, how):
    """angles, s, y, P, R (N, 3) of an Attitude; rest (N,): which samples are at rest."""
    f = VectorFilter(how, t, gyr, rest)
    if rest.any():
        f.start(t, gyr, acc, mag, t[rest][-1] - t[0])
    else:
        f.start_backwards(t, gyr, acc, mag)
    rows = [f.row(np.zeros(3))]
    rows += [f.row(y) for y in f.run(t, gyr, acc, mag, f.start_backwards)]
    return np.moveaxis(np.array(rows), 1, 0)


class VectorFilter:
    """The filter as it stands after a step.

    q  quaternion of the attitude, and C its matrix
    s  (3,) error of the gyroscope's rates, beyond those at rest
    P  (6, 6) covariance of [e, s]
    R  (3,) of the latest roll, pitch and yaw
    """

    def __init__(self, how, t, gyr, rest):
        self.how = how
        self.at_rest, self.s = np.zeros(3), np.zeros(3)
        P_s = USUAL_BIAS
        if rest.any() and "rest mean" not in how.without:
            self.at_rest = gyr[rest].mean(axis=0)
            P_s = gyr[rest].var(axis=0).mean() / (t[rest][-1] - t[0])  # one value a second
        self.P = P_s * np.eye(6)
        self.longest = max(PAUSE, 5 * np.median(np.diff(t)))

    def start(self, t, gyr, acc, mag, seconds=START):
        """Take the attitude from the sensors: from the means of their vectors in the first seconds,
        turned by the gyroscope to the first of them."""
        count = np.searchsorted(t, t[0] + seconds, "right")
        pauses = np.flatnonzero(np.diff(t[:count]) > self.longest)
        count = pauses[0] + 1 if len(pauses) else count
        self.set_attitude((1.0, 0.0, 0.0, 0.0))
        vectors = [(acc[0], mag[0])]
        for k in range(1, count):
            self.turn((gyr[k] + gyr[k - 1]) / 2, t[k] - t[k - 1])
            vectors.append((self.C @ acc[k], self.C @ mag[k]))
        force, field = (_mean(column) for column in zip(*vectors))
        roll, pitch = np.nan_to_num(tilt(force[np.newaxis])[0])
        yaw = np.nan_to_num(heading_of(*field, roll, pitch, np))
        self.set_attitude(quaternion_of(roll, pitch, yaw))
        self.R = np.array([TILT.usual, TILT.usual, YAW.usual])
        self.P[E_], self.P[:, E_] = 0, 0
        self.P[E_, E_] = np.diag([UNSURE_TILT, UNSURE_TILT, UNSURE_YAW])
        self.tilt, self.yaw = Block(TILT, axes=2), Block(YAW, axes=1)
        self.turned = np.zeros(3)  # rad, since the last update

    def start_backwards(self, t, gyr, acc, mag):
        """Without a rest: filter the first minute from its end to its beginning, where everything
        turns the other way. What is known there is the start."""
        back = np.flatnonzero(t - t[0] <= LEARNS)[::-1]
        seen = t[back[0]] - t[back], -gyr[back], acc[back], mag[back]
        self.s, self.at_rest = -self.s, -self.at_rest
        self.start(*seen)
        for _ in self.run(*seen, self.start):
            pass
        self.s, self.at_rest = -self.s, -self.at_rest
        self.P[E_, S_] *= -1
        self.P[S_, E_] *= -1
        self.tilt.start_again()
        self.yaw.start_again()
        self.turned = np.zeros(3)

    def run(self, t, gyr, acc, mag, after_a_pause):
        """Step by step through a recording, from the second sample on -> the innovations (3) of
        each. after_a_pause takes what comes then, and starts again."""
        for k in range(1, len(t)):
            h, y = t[k] - t[k - 1], np.full(3, math.nan)
            if h > self.longest:
                after_a_pause(t[k:], gyr[k:], acc[k:], mag[k:])
            else:
                self.predict((gyr[k] + gyr[k - 1]) / 2, h)
                y[:2] = self.update_tilt(acc[k], h)
                y[2] = self.update_yaw(mag[k], h)
            yield y

    # --- one step -------------------------------------------------------------------------------

    def predict(self, rates, h):
        """rates (3,) of the gyroscope, h s."""
        self.turned += h * self.C @ (rates - self.at_rest - self.s)
        self.turn(rates, h)
        F = np.eye(6)
        F[E_, S_] = -h * self.C
        Q = np.diag(h * np.repeat([self.how.q, self.how.q_bias], 3))
        self.P = F @ self.P @ F.T + Q

    def update_tilt(self, acc, h):
        """At the end of a block: roll and pitch by the mean acceleration -> y (2), else NaN."""
        if not self.tilt.is_full_with(self.C @ acc, h):
            return math.nan
        self.P[E_, E_] += np.diag((SCALE * self.turned) ** 2)
        self.turned = np.zeros(3)
        north, east, down = self.tilt.mean()
        to_roll, to_pitch, _ = self.level_axes()
        right, ahead = to_pitch @ [north, east, 0], to_roll @ [north, east, 0]
        y = [-math.atan2(right, -down), math.atan2(ahead, -down)]
        self.blend(self.tilt, y, [to_roll, to_pitch], self.R[:2])
        return y

    def update_yaw(self, mag, h):
        """At the end of a block: yaw by the mean field -> y, else NaN."""
        if not self.yaw.is_full_with(self.C @ mag, h):
            return math.nan
        north, east, _ = self.yaw.mean()
        y = -math.atan2(east, north)
        self.blend(self.yaw, [y], [np.array([0, 0, 1])], self.R[2:])
        return y

    def blend(self, block, y, axes, R):
        """The update by the innovations y of turns about some axes, one after the other."""
        moved = np.zeros(6)
        for i, (y_i, axis) in enumerate(zip(y, axes)):
            H = np.append(axis, np.zeros(3))
            P_H = self.P @ H
            R[i] = block.noise(i, y_i, H @ P_H)
            K = P_H / (H @ P_H + R[i])
            moved += K * (y_i - H @ moved)
            self.P = self.P - np.outer(K, P_H)
        for i, axis in enumerate(axes):
            block.moved(i, by=axis @ moved[E_])
        for each in (self.tilt, self.yaw):
            each.turn(moved[E_])
        self.set_attitude(product(turn_by(*moved[E_]), self.q))
        self.s = self.s + moved[S_]
        block.start_again()

    # --- the attitude ---------------------------------------------------------------------------

    def turn(self, rates, h):
        """Turn by the gyroscope's rates, less their error."""
        self.set_attitude(product(self.q, turn_by(*(h * (rates - self.at_rest - self.s)))))

    def set_attitude(self, q):
        self.q = unit(q)
        self.C = matrix_of(self.q)

    def level_axes(self):
        """The axes of roll, pitch and yaw of a level craft that looks the same way, in
        north-east-down."""
        _, _, yaw = angles_of(self.q)
        sin_y, cos_y = math.sin(yaw), math.cos(yaw)
        return np.array([[cos_y, sin_y, 0], [-sin_y, cos_y, 0], [0, 0, 1]])

    def row(self, y):
        """angles, s, y, P and R of roll, pitch and yaw."""
        angles = angles_of(self.q)
        pitch = min(max(angles[1], -STEEPEST), STEEPEST)
        steep = np.array([1 / math.cos(pitch), 1, 1])  # by turns about level axes: more roll
        to_angles = self.level_axes()
        to_angles[2] += math.tan(pitch) * to_angles[0]
        P = ((to_angles @ self.P[E_, E_]) * to_angles).sum(axis=1)
        return angles, self.s, steep * y, steep**2 * P, steep**2 * self.R


def _mean(vectors):
    """The mean of vectors (3,), of those that are known; NaN if none is."""
    known = [vector for vector in vectors if not math.isnan(vector[0])]
    return np.mean(known, axis=0) if known else np.full(3, math.nan)
