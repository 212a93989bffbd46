"""The sheets of a recording in, one Signal a sensor out, in SI units and the sensor's own axes."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from .columns import ACCEPTED, PLAIN_NAMES, UNITS, is_gravity, is_linear, read_header
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
SHORTEST = 1e-6  # s between two measurements
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
        column = read_header(title)
        if column.kind == "unknown" or _has_strange_unit(column):
            raise _unit_is_missing(sheet.place, title)
        if column.kind == "time":
            _, factor = UNITS.get(column.unit, ("time", 1.0))
            clock = (k, factor)
            if column.unit is None:
                say(
                    notes,
                    f"{sheet.place}: column {title!r} has no unit; seconds were taken.",
                    f"{sheet.place}: kolom {title!r} tanpa satuan; dipakai detik.",
                )
        elif column.kind and column.kind != "logger":
            _, factor = UNITS.get(column.unit, ("mag", 1.0))
            axes = groups.setdefault((column.name, column.kind, clock), {})
            if column.axis in axes:
                raise _comes_twice(sheet.place, title)
            axes[column.axis] = (k, factor)
    return groups


def _has_strange_unit(column):
    return column.kind == "time" and column.unit is not None and column.unit not in UNITS


def _comes_twice(place, header):
    shown = repr(header[:40])
    return InputError(
        f"{place}: column {shown} comes twice; leave one of them.",
        f"{place}: kolom {shown} ada dua kali; tinggalkan satu saja.",
    )


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
    if kind == "acc" and is_linear(name):
        kind = "linear"
    elif kind == "acc" and is_gravity(name):
        kind = "gravity"
    columns = [axes[axis] for axis in "xyz"]
    values = np.column_stack([sheet.values[:, k] * factor for k, factor in columns])
    converted = [sheet.names[k] for k, factor in columns if factor != 1]
    if converted:
        title = ", ".join(converted)
        si = "rad/s" if kind == "gyr" else "m/s2"
        say(
            notes,
            f"{sheet.place}: converted to {si}: {title}.",
            f"{sheet.place}: diubah ke {si}: {title}.",
        )
    is_plain = name in PLAIN_NAMES or "_" in sheet.names[columns[0][0]]
    source = "plain" if is_plain else "units"
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
    return _one_a_time(signal, notes)


def _one_a_time(signal, notes):
    """The mean of rows with the same time."""
    first = np.flatnonzero(np.append(True, np.diff(signal.t) > 0))
    counts = np.diff(np.append(first, len(signal.t)))
    if (counts == 1).all():
        return signal
    say(
        notes,
        f"{signal.place}: {counts[counts > 1].sum()} rows share their times with others; their "
        "means were taken.",
        f"{signal.place}: {counts[counts > 1].sum()} baris waktunya sama dengan baris lain; "
        "dipakai rata-ratanya.",
    )
    means = np.add.reduceat(signal.values, first) / counts[:, np.newaxis]
    return signal.rows(first)._replace(values=means)


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
    back = np.diff(signal.t) < 0
    if back.any():
        k = np.argmax(back) + 1
        line, now, before = signal.lines[k], repr(float(signal.t[k])), repr(float(signal.t[k - 1]))
        raise InputError(
            f"{place}, line {line}: the time of the {en} does not increase, {now} s after {before} "
            "s.",
            f"{place}, baris {line}: waktu {id} tidak bertambah, {now} s sesudah {before} s.",
        )
    steps = np.diff(signal.t)
    if not (steps > 0).any() or np.median(steps[steps > 0]) < SHORTEST:
        raise InputError(
            f"{place}: the times of the {en} hardly differ; is their unit right?",
            f"{place}: waktu {id} hampir tidak berbeda; apakah satuannya benar?",
        )
