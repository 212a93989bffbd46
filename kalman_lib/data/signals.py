"""The sheets of a recording in, one Signal a sensor out, in SI units and the sensor's own axes."""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .columns import (
    ACCEPTED,
    GRAVITY_WORD,
    LINEAR_WORD,
    PLAIN_NAMES,
    UNITS,
    read_header,
)
from .errors import InputError
from .words import NAMES, say

SENSOR_LOGGER = {  # its file -> what is in it
    "gyroscope": "gyr",
    "totalacceleration": "acc",
    "accelerometer": "linear",
    "gravity": "gravity",
    "magnetometer": "mag",
    "orientation": "orientation",
}
LEAST = {"gyr": 10}  # measurements; of other sensors two


class Signal(NamedTuple):
    """One sensor, a key of NAMES, as recorded: t (n,) s, values (n, 3) in SI units and its own
    axes."""

    kind: str
    t: np.ndarray
    values: np.ndarray
    place: str
    lines: np.ndarray
    source: str  # "units", "plain" (gx, ax, mx) or "logger" (Sensor Logger)

    def rows(self, keep):
        """The Signal with these rows only."""
        return self._replace(t=self.t[keep], values=self.values[keep], lines=self.lines[keep])


def signals_in(sheet, notes):
    """A Sheet -> a list of Signals."""
    if "seconds_elapsed" in sheet.names:
        return _of_sensor_logger(sheet)
    groups = _groups_in(sheet, notes)
    found = [_signal(sheet, *key, columns, notes) for key, columns in groups.items()]
    return [signal for signal in found if signal is not None]


def _groups_in(sheet, notes):
    """{(name, kind, clock): {axis: (column, factor to SI)}}; clock: the (column, factor) of time to
    the left."""
    groups, clock = {}, None
    for k, title in enumerate(sheet.names):
        header = re.sub(r" \(\d+\)$", "", title)  # a name that came twice has got a number
        column = read_header(header)
        if column.kind == "unknown" or _has_strange_unit(column):
            raise _unit_is_missing(sheet.place, header)
        if column.kind == "time":
            _, factor = UNITS.get(column.unit, ("time", 1.0))
            clock = (k, factor)
            if column.unit is None:
                say(
                    notes,
                    f"{sheet.place}: column {header!r} has no unit; seconds were taken.",
                    f"{sheet.place}: kolom {header!r} tanpa satuan; dipakai detik.",
                )
        elif column.kind and column.kind != "logger":
            _, factor = UNITS.get(column.unit, ("mag", 1.0))
            axes = groups.setdefault((column.name, column.kind, clock), {})
            axes[column.axis] = (k, factor)
    return groups


def _has_strange_unit(column):
    return column.kind == "time" and column.unit is not None and column.unit not in UNITS


def _unit_is_missing(place, header):
    shown = repr(header[:40])
    return InputError(
        f"{place}: column {shown} must have its unit in parentheses, one of {ACCEPTED}.",
        f"{place}: kolom {shown} harus memuat satuannya dalam kurung, salah satu dari {ACCEPTED}.",
    )


def _signal(sheet, name, kind, clock, axes, notes):
    """The Signal of one group of columns; None if it has not three axes, like a single "y (g)"."""
    if len(axes) < 3:
        return None
    if clock is None:
        raise InputError(
            f"{sheet.place}: there is no column of time, such as 't (s)', left of the sensor.",
            f"{sheet.place}: tidak ada kolom waktu, misalnya 't (s)', di kiri sensor.",
        )
    if kind == "acc" and LINEAR_WORD.search(name):
        kind = "linear"
    elif kind == "acc" and GRAVITY_WORD.search(name):
        kind = "gravity"
    columns = [axes[axis] for axis in "xyz"]
    values = np.column_stack([sheet.values[:, k] * factor for k, factor in columns])
    first, factor = columns[0]
    if factor != 1:
        title = sheet.names[first]
        si = "rad/s" if kind == "gyr" else "m/s2"
        say(
            notes,
            f"{sheet.place}: {title} and its like were converted to {si}.",
            f"{sheet.place}: {title} dan sejenisnya diubah ke {si}.",
        )
    source = "plain" if name in PLAIN_NAMES else "units"
    time, to_seconds = clock
    t = sheet.values[:, time] * to_seconds
    return Signal(kind, t, values, sheet.place, sheet.lines, source)


def _of_sensor_logger(sheet):
    """A CSV of Sensor Logger, which has SI units."""
    kind = SENSOR_LOGGER.get(Path(sheet.place).stem.lower())
    wanted = ("roll", "pitch", "yaw") if kind == "orientation" else ("x", "y", "z")
    column = dict(zip(sheet.names, sheet.values.T))
    if kind is None or not column.keys() >= set(wanted):
        return []
    values = np.column_stack([column[name] for name in wanted])
    return [Signal(kind, column["seconds_elapsed"], values, sheet.place, sheet.lines, "logger")]


def keep(signals, signal):
    """Add a Signal to the dict of them; InputError if that sensor is there already."""
    if other := signals.get(signal.kind):
        en, id = NAMES[signal.kind]
        raise InputError(
            f"The {en} comes twice, in {other.place} and in {signal.place}; give one recording.",
            f"Sensor {id} ada dua kali, di {other.place} dan di {signal.place}; berikan satu "
            "rekaman.",
        )
    signals[signal.kind] = signal


# --- rows that cannot be used -------------------------------------------------------------------


def clean(signal, notes):
    """The Signal without empty and repeated rows; InputError where a value is missing or time
    stands still."""
    (en, id), place = NAMES[signal.kind], signal.place
    empty = np.isnan(signal.values).all(axis=1)  # phyphox fills short columns
    _check_values(signal, empty)
    signal = signal.rows(~empty)
    n, least = len(signal.t), LEAST.get(signal.kind, 2)
    if n < least:
        raise InputError(
            f"{place}: the {en} has only {n} measurements; at least {least} are needed.",
            f"{place}: {id} hanya memiliki {n} pengukuran; diperlukan sedikitnya {least}.",
        )
    has_gaps = empty[:n].any()  # not only at the end
    if has_gaps:
        say(
            notes,
            f"{place}: {empty.sum()} rows without a value of the {en} were left out.",
            f"{place}: {empty.sum()} baris tanpa nilai {id} tidak dipakai.",
        )
    same_time = np.diff(signal.t) == 0
    same_values = (np.diff(signal.values, axis=0) == 0).all(axis=1)
    repeated = np.append(False, same_time & same_values)
    if repeated.any():
        say(
            notes,
            f"{place}: {repeated.sum()} rows that repeat the one before were left out.",
            f"{place}: {repeated.sum()} baris yang mengulang baris sebelumnya tidak dipakai.",
        )
    signal = signal.rows(~repeated)
    _check_times(signal)
    return signal


def _check_values(signal, empty):
    (en, id), place = NAMES[signal.kind], signal.place
    good = np.isfinite(signal.values).all(axis=1) & np.isfinite(signal.t)
    bad = ~empty & ~good
    if bad.any():
        line = signal.lines[np.argmax(bad)]
        raise InputError(
            f"{place}, line {line}: a value of the {en} or its time is missing or infinite.",
            f"{place}, baris {line}: nilai {id} atau waktunya kosong atau tak hingga.",
        )


def _check_times(signal):
    (en, id), place = NAMES[signal.kind], signal.place
    back = np.diff(signal.t) <= 0
    if back.any():
        line = signal.lines[np.argmax(back) + 1]
        raise InputError(
            f"{place}, line {line}: the time of the {en} does not increase.",
            f"{place}, baris {line}: waktu {id} tidak bertambah.",
        )
