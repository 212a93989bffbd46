"""The recording that comes with the book, notebooks/data/ximu.csv.gz."""

import gzip

import numpy as np

from .angles import interpolate_angles
from .axes import AXES
from .columns import GRAVITY
from .recording import Recording
from .words import say

RATE = 256.0  # samples per second


def read_ximu(path):
    """The x-IMU recording of the book (notebooks/data/ximu.csv.gz) -> Recording with the device's
    own angles.

    12,626 samples at 256 Hz, real and unsmoothed. The device's frame is forward-left-up with angles
    in a world whose z points up; here both are turned to forward-right-down and north-east-down.
    Its angles come with every second sample (reference[::2]); those in between are interpolated.
    Its yaw starts anywhere: compare it without its offset."""
    with gzip.open(path, "rt", encoding="ascii") as file:
        table = np.genfromtxt(file, delimiter=",", skip_header=1)
    gyr, acc, mag, angles = np.split(table, [3, 6, 9], axis=1)  # deg/s, g, gauss, degrees
    t = np.arange(len(table)) / RATE
    turn = AXES["flu"]
    known = np.isfinite(angles[:, 0])
    reference = interpolate_angles(t, t[known], np.radians(angles[known]) @ turn)
    notes = []
    say(
        notes,
        "Real data of an x-IMU; units and axes were converted, nothing was smoothed.",
        "Data nyata dari sebuah x-IMU; satuan dan sumbunya diubah, tidak ada yang dihaluskan.",
    )
    say(
        notes,
        "The device gives its own angles at 128 Hz; between them they are interpolated.",
        "Alat itu memberi sudutnya sendiri pada 128 Hz; di antaranya sudut itu diinterpolasi.",
    )
    gyr, acc, mag = np.radians(gyr) @ turn, GRAVITY * acc @ turn, mag @ turn
    return Recording(t, gyr, acc, mag, RATE, notes, reference)
