"""The header of a column -> which sensor it is, along which axis, in which unit.

A sensor is recognised by its unit, so the language of the header does not matter.
"""

import unicodedata
from typing import NamedTuple

import numpy as np

GRAVITY = 9.80665  # m/s2, the standard g
DEG = np.pi / 180

UNITS = {  # unit as `read_header` writes it -> (what it measures, factor to SI)
    **dict.fromkeys(("rad/s", "rad/sec", "radians/s", "rps"), ("gyr", 1.0)),
    **dict.fromkeys(
        ("deg/s", "deg/sec", "°/s", "°/sec", "dps", "degrees/s", "degree/s"), ("gyr", DEG)
    ),
    **dict.fromkeys(("mdps", "mdeg/s"), ("gyr", DEG / 1000)),
    **dict.fromkeys(("m/s2", "m/s/s", "m/sec2", "ms-2", "m·s-2"), ("acc", 1.0)),
    **dict.fromkeys(("g", "gn"), ("acc", GRAVITY)),
    "mg": ("acc", GRAVITY / 1000),
    **dict.fromkeys(
        ("μt", "ut", "nt", "mt", "t", "G", "mG", "gauss", "mgauss"), ("mag", 1.0)
    ),  # any
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds", "detik", "dtk"), ("time", 1.0)),
    **dict.fromkeys(("ms", "msec", "millis", "milliseconds", "milidetik"), ("time", 1e-3)),
    **dict.fromkeys(("μs", "us", "usec", "micros", "microseconds"), ("time", 1e-6)),
    **dict.fromkeys(("ns", "nsec", "nanos", "nanoseconds"), ("time", 1e-9)),
}
ACCEPTED = "rad/s, deg/s, °/s; m/s2, m/s^2, g, mg; s, ms, us, ns"
CASE_MATTERS = ("G", "mG")  # gauss, not gravity
TIMES = ("t", "time", "timestamp", "waktu", "detik", "zeit", "seconds", "seconds_elapsed")
SENSOR_WORDS = ("gyr", "giro", "acc", "accel", "acel", "beschl", "percep")
LINEAR_WORDS = ("linear", "linier", "lineal", "linéaire", "user")
WITHOUT = ("without", "ohne", "tanpa", "sin", "sans", "senza", "sem")
GRAVITY_WORDS = ("gravit", "schwerkraft")
PLAIN_NAMES = ("g", "gyr", "gyro", "a", "acc", "accel", "m", "mag")  # of loggers: gx, acc_x, MagX
LONGEST = 120  # characters of a header that are looked at


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
    name, unit = _name_and_unit(" ".join(header[:LONGEST].split()))
    name, axis = _name_and_axis(name.lower())
    measured, _ = UNITS.get(unit, (None, 0))
    if axis is None:
        kind = "time" if measured == "time" or name in TIMES else None
        return Column(name, axis, unit, kind)
    by_name = _kind_by_name(name)
    if unit in CASE_MATTERS and by_name == "unknown" and is_acceleration(name):
        unit, measured = unit.lower(), "acc"  # an accelerometer in "G" or "mG"
    kind = measured if measured in ("gyr", "acc", "mag") else by_name
    return Column(name, axis, unit, kind)


def _name_and_unit(header):
    """ "a x (m/s^2)" -> ("a x", "m/s2"); "Time since start in ms" -> ("time", "ms")."""
    for left, right in ("()", "[]"):
        name, bracket, rest = header.rpartition(left)
        if bracket and rest.endswith(right) and rest.count(right) == 1:
            return name.strip(), _plain_unit(rest[:-1])
    words = header.lower().split()
    if len(words) > 2 and words[0] == "time" and words[-2] == "in":
        return "time", _plain_unit(words[-1])
    return header, None


def _name_and_axis(name):
    """ "gyro_x" -> ("gyro", "x"); the axis stands at the end."""
    if name[-1:] not in ("x", "y", "z"):
        return name, None
    return name[:-1].rstrip(" _.-"), name[-1]


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
    is_sensor = name in ("g", "a") or any(word in name for word in SENSOR_WORDS)
    return "unknown" if is_sensor else None


def is_acceleration(name):
    return name == "a" or any(word in name for word in SENSOR_WORDS[2:])


def is_linear(name):
    """Without gravity?"""
    words = name.replace("(", " ").replace(")", " ").split()
    without_g = any(pair in zip(words, words[1:]) for pair in ((word, "g") for word in WITHOUT))
    return without_g or any(word in name for word in LINEAR_WORDS)


def is_gravity(name):
    return any(word in name for word in GRAVITY_WORDS)


def is_wanted(header):
    """Does the column below this header belong to a sensor, to its times or to a device's
    angles?"""
    return bool(read_header(header).kind) or header in ("roll", "pitch", "yaw")
