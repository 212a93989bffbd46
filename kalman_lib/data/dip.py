"""Is the angle between gravity and the magnetic field the same in every pose? It should be; if it
is not, the axes of the magnetometer are not those of the accelerometer, or iron is nearby."""

from itertools import permutations, product

import numpy as np

from .words import say

WINDOW = 0.5  # s
SLOW = 0.5  # rad/s; faster than that a window says little
QUIET = 1.0  # m/s2 by which the mean acceleration may differ from gravity
GRAVITY = 9.81
LEAST = 8  # windows
MOST = 20  # degrees by which the angle may change from pose to pose
FRAMES = [  # the 24 right-handed ones
    frame
    for order in permutations(range(3))
    for signs in product((1, -1), repeat=3)
    if round(np.linalg.det(frame := np.diag(signs) @ np.eye(3)[list(order)])) == 1
]


def tell_dip(acc, mag, gyr, rate, notes):
    """A note where the angle changes, and whether other axes of the magnetometer would mend it."""
    up, field = _poses(acc, mag, gyr, rate)
    if len(up) < LEAST:
        return
    low, high = np.degrees(_range(up, field))
    if high - low < MOST:
        return
    change = f"{low:.0f} - {high:.0f}"
    better_en, better_id = _better(up, field)
    say(
        notes,
        "The angle between gravity and the magnetic field is not the same in every pose "
        f"({change} degrees): the magnetometer has other axes, or iron is near, and the yaw is "
        f"wrong.{better_en}",
        "Sudut antara gravitasi dan medan magnet tidak sama pada setiap sikap alat "
        f"({change} derajat): sumbu magnetometernya lain atau ada besi di dekatnya, dan yaw "
        f"keliru.{better_id}",
    )


def _poses(acc, mag, gyr, rate):
    """The directions of gravity and field (n, 3) in quiet windows."""
    size = max(2, round(WINDOW * rate))
    count = len(acc) // size

    def means(values):
        return values[: count * size].reshape(count, size, 3).mean(axis=1)

    up, field, turned = means(acc), means(mag), means(np.abs(gyr))
    g, size_of_field = np.linalg.norm(up, axis=1), np.linalg.norm(field, axis=1)
    good = (np.abs(g - GRAVITY) < QUIET) & (turned.max(axis=1) < SLOW) & (size_of_field > 0)
    return up[good] / g[good, np.newaxis], field[good] / size_of_field[good, np.newaxis]


def _range(up, field):
    """The angles between them, without the outermost twentieths."""
    angles = np.arccos(np.clip((up * field).sum(axis=1), -1, 1))
    return np.quantile(angles, [0.05, 0.95])


def _better(up, field):
    """A sentence on the axes with which the angle hardly changes, if only one choice does that."""
    changes = np.degrees([np.ptp(_range(up, field @ frame.T)) for frame in FRAMES])
    best, second = np.argsort(changes)[:2]
    if changes[best] > MOST / 2 or changes[second] < 2 * changes[best] + MOST / 4:
        return "", ""
    letters = " ".join(_letter(row) for row in FRAMES[best])
    return (
        f" With x, y, z of the magnetometer read as {letters} it would be.",
        f" Dengan x, y, z magnetometer dibaca sebagai {letters} sudut itu sama.",
    )


def _letter(row):
    sign = "-" if row.sum() < 0 else ""
    return sign + "xyz"[int(np.argmax(np.abs(row)))]
