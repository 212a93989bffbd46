"""The header of a column -> which sensor it is, along which axis, in which unit.

A sensor is recognised by its unit, so the language of the header does not matter.
"""

import re
import unicodedata
from typing import NamedTuple

import numpy as np

GRAVITY = 9.80665  # m/s2, the standard g

UNITS = {  # unit as `read_header` writes it -> (what it measures, factor to SI)
    "rad/s": ("gyr", 1.0),
    **dict.fromkeys(("deg/s", "°/s", "dps", "degrees/s", "degree/s"), ("gyr", np.pi / 180)),
    "m/s2": ("acc", 1.0),
    "m/s/s": ("acc", 1.0),
    "g": ("acc", GRAVITY),
    **dict.fromkeys(("μt", "ut", "nt", "mt", "t", "G", "mG", "gauss"), ("mag", 1.0)),  # any scale
    **dict.fromkeys(("s", "sec", "seconds"), ("time", 1.0)),
    "ms": ("time", 1e-3),
    "μs": ("time", 1e-6),
    "us": ("time", 1e-6),
    "ns": ("time", 1e-9),
}
ACCEPTED = "rad/s, deg/s, °/s; m/s2, m/s^2, g; s, ms, us, ns"
CASE_MATTERS = ("G", "mG")  # gauss, not gravity
TIMES = ("t", "time", "seconds_elapsed")
UNIT_IN_BRACKETS = re.compile(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]")
AXIS_AT_THE_END = re.compile(r"(.*?)[\s_.-]*([xyz])")
SENSOR_WORD = re.compile("^[ga]$|gyr|giro|acc|accel|acel|beschl|percep")
WITHOUT_GRAVITY = "(without|ohne|tanpa|sin|sans|senza|sem) g"
LINEAR_WORD = re.compile(f"linear|linier|lineal|linéaire|user|{WITHOUT_GRAVITY}")
GRAVITY_WORD = re.compile("gravit|schwerkraft")
PLAIN_NAMES = ("g", "gyr", "a", "acc", "m", "mag")  # of a plain CSV: gx, ax, mx


class Column(NamedTuple):
    """What the header of a column says.

    kind: "time"; "gyr", "acc" or "mag"; "unknown": a sensor whose unit we do not know; "logger": a
    bare x, y or z; None: no sensor."""

    name: str
    axis: str | None
    unit: str | None
    kind: str | None


def read_header(header):
    """ "Gyroscope x (rad/s)" -> Column("gyroscope", "x", "rad/s", "gyr")."""
    name, axis, unit = header.strip(), None, None
    if match := UNIT_IN_BRACKETS.fullmatch(name):
        name, unit = match[1], _plain_unit(match[2])
    name = name.lower()
    if match := AXIS_AT_THE_END.fullmatch(name):
        name, axis = match.groups()
    measured, _ = UNITS.get(unit, (None, 0))
    if axis is None:
        kind = "time" if measured == "time" or name in TIMES else None
    elif measured in ("gyr", "acc", "mag"):
        kind = measured
    else:
        kind = _kind_by_name(name)
    return Column(name, axis, unit, kind)


def _plain_unit(unit):
    """m/s², m/s^2 and m / s2 are all m/s2."""
    unit = unicodedata.normalize("NFKC", unit).replace("^", "").replace(" ", "")
    return unit if unit in CASE_MATTERS else unit.lower()


def _kind_by_name(name):
    """The kind of a column with an axis but without a unit that we know."""
    if name == "":
        return "logger"
    if name == "m" or "mag" in name:
        return "mag"
    return "unknown" if SENSOR_WORD.search(name) else None


def is_wanted(header):
    """Does the column below this header belong to a sensor, to its times or to a device's
    angles?"""
    return bool(read_header(header).kind) or header in ("roll", "pitch", "yaw")
