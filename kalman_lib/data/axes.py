"""The sensors' own axes -> the body's: forward, right, down."""

import numpy as np

from .words import AXES_NAMES, say

AXES = {  # body axis = row times sensor axis
    "phone": np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]),
    "flu": np.diag([1, -1, -1]),
    "frd": np.eye(3, dtype=int),
}
KINDS = ("gyr", "acc", "mag")
UP = 5  # m/s2 along z at the start: it points up


def body_axes(axes):
    """What `read_recording` accepts as axes -> {kind: (3, 3)}; None stays None."""
    if axes is None:
        return None
    if not isinstance(axes, dict):
        return dict.fromkeys(KINDS, _matrix(axes))
    if set(axes) != set(KINDS):
        raise _wrong_axes(axes)
    return {kind: _matrix(axes[kind]) for kind in KINDS}


def _matrix(axes):
    """ "flu" or "x -y -z" -> (3, 3)."""
    if isinstance(axes, str) and axes in AXES:
        return AXES[axes]
    matrix = np.zeros((3, 3), dtype=int)
    parts = axes.split() if isinstance(axes, str) else []
    for row, part in enumerate(parts[:3]):
        sign, letter = (-1 if part[0] == "-" else 1), part.lstrip("+-")
        if len(letter) == 1 and letter in "xyz":
            matrix[row, "xyz".index(letter)] = sign
    if len(parts) != 3 or round(np.linalg.det(matrix)) != 1:
        raise _wrong_axes(axes)
    return matrix


def _wrong_axes(axes):
    known = ", ".join(AXES)
    return ValueError(
        f"axes is {axes!r}; accepted are {known}, or the axes that point forward, right and down "
        "in a right-handed frame, such as 'y x -z', or such for each of gyr, acc and mag. / "
        f"axes berisi {axes!r}; yang diterima {known}, atau sumbu yang mengarah ke depan, kanan, "
        "dan bawah dalam kerangka tangan kanan, misalnya 'y x -z', atau itu untuk gyr, acc, mag."
    )


def tell_usual_axes(signals, notes):
    """The axes where the reader has named none."""
    if signals["gyr"].source != "plain":
        return "phone"
    if signals["acc"].values[:10, 2].mean() <= UP:
        return "frd"
    say(
        notes,
        "az is positive at the start, so z is taken to point up; if the device began upside down, "
        "choose the axes frd.",
        "az positif pada awalnya, jadi sumbu z dianggap mengarah ke atas; jika alat mulai dalam "
        "keadaan terbalik, pilihlah sumbu frd.",
    )
    return "flu"


def tell_axes(axes, notes):
    shown = (
        ", ".join(f"{kind} {value}" for kind, value in axes.items())
        if isinstance(axes, dict)
        else axes
    )
    forward = f"forward, right, down = {shown}", f"depan, kanan, bawah = {shown}"
    en, id = AXES_NAMES.get(axes, forward) if isinstance(axes, str) else forward
    say(notes, f"Axes taken: {en}.", f"Sumbu yang dipakai: {id}.")
