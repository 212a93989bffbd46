"""The adaptive method's witnesses: a block of measurements counts once.

Neighbouring samples of an accelerometer share the same swaying: fifty of them in a second are not
fifty witnesses. So vectors are gathered for some seconds, and their mean is the measurement: over
seconds the accelerations of whoever walks or flies cancel, and what is left is gravity.
"""

import math
from collections import deque
from typing import NamedTuple

import numpy as np

LOOKS_BACK = 5  # blocks, from which R is estimated
NEWEST = 0.5  # so much of the newest change counts at least
SCARCE = 3  # fewer blocks say little of R


class Kind(NamedTuple):
    """A sensor's blocks: their seconds, and what R (rad2) of a mean may be.

    least    R is at least this
    usual    and this while the blocks are scarce
    lasting  what lasts through many blocks counts as noise up to this: more is an error of the
             filter, as no acceleration lasts
    """

    seconds: float
    least: float
    usual: float
    lasting: float


class Block:
    """The vectors of one sensor since its last update, and what its latest innovations tell of
    R."""

    def __init__(self, kind, axes):
        self.kind = kind
        self.latest = [deque(maxlen=LOOKS_BACK) for _ in range(axes)]
        self.start_again()

    def start_again(self):
        self.sum = np.zeros(3)
        self.count = 0
        self.lasts = 0.0  # s

    def is_full_with(self, vector, dt):
        """Take one more vector, NaN where the sensor is silent; True where it completes the
        block."""
        self.lasts += dt
        if not math.isnan(vector[0]):
            self.sum += vector
            self.count += 1
        if self.lasts < self.kind.seconds - dt / 2:
            return False
        if self.count == 0:
            self.start_again()
        return self.count > 0

    def turn(self, by):
        """The attitude is turned by a small angle (3,), and what was gathered with it."""
        self.sum = self.sum + np.cross(by, self.sum)

    def mean(self):
        return self.sum / self.count

    def noise(self, i, y, P):
        """R of the newest innovation y along the axis i; P its variance by the prediction."""
        latest = self.latest[i]
        latest.append(y)
        mean = sum(latest) / len(latest)
        changes = sum((value - mean) ** 2 for value in latest) / len(latest)
        changes = max(changes, NEWEST * (y - mean) ** 2)
        R = max(changes + min(mean**2, self.kind.lasting) - P, self.kind.least)
        return R if len(latest) >= SCARCE else max(R, self.kind.usual)

    def moved(self, i, by):
        """The angle has moved: the latest innovations are smaller by as much."""
        self.latest[i] = deque((y - by for y in self.latest[i]), maxlen=LOOKS_BACK)
