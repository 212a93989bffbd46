"""Two columns of a Table -> times in seconds and what was measured then."""

from typing import NamedTuple

import numpy as np

from .errors import InputError
from .units import TIME_UNITS


class Series(NamedTuple):
    """t (T,) in seconds from 0, None without a column of times; z (T,); notes as in Table."""

    t: np.ndarray | None
    z: np.ndarray
    notes: list


def series_of(table, time=None, value=None):
    """See Table.series."""
    time = time or table.time
    z = table.columns[value or table.value]
    if time is None:
        return Series(None, z, [])
    notes = []
    unit = table.units.get(time)
    if unit not in TIME_UNITS:
        notes.append({"en": f"{time} was taken as seconds", "id": f"{time} dianggap dalam detik"})
    factor = TIME_UNITS[unit][0] if unit in TIME_UNITS else 1.0
    known = np.isfinite(table.columns[time])
    stamps, z, lines = table.columns[time][known], z[known], table.lines[known]
    if not known.all():
        count = int((~known).sum())
        notes.append({"en": f"rows without a time: {count}", "id": f"baris tanpa waktu: {count}"})
    _check_order(stamps, lines)
    t = (stamps - stamps[:1]) * factor
    return _averaged(t, z, notes)


def _check_order(stamps, lines):
    back = np.flatnonzero(np.diff(stamps) < 0)
    if len(back):
        at = int(back[0]) + 1
        now, before = f"{stamps[at]:.15g}", f"{stamps[at - 1]:.15g}"
        raise InputError(
            f"Line {lines[at]}: the time goes back, {now} after {before}.",
            f"Baris {lines[at]}: waktunya mundur, {now} setelah {before}.",
        )


def _averaged(t, z, notes):
    """Of equal times one, with the mean of what was measured."""
    first = np.flatnonzero(np.diff(t, prepend=-np.inf) > 0)
    if len(first) == len(t):
        return Series(t, z, notes)
    known = np.isfinite(z)
    sums = np.add.reduceat(np.where(known, z, 0.0), first)
    counts = np.add.reduceat(known.astype(float), first)
    means = np.divide(sums, counts, out=np.full(len(first), np.nan), where=counts > 0)
    count = len(t) - len(first)
    notes = [
        *notes,
        {
            "en": f"equal times were averaged: {count} rows fewer",
            "id": f"waktu yang sama dirata-ratakan: berkurang {count} baris",
        },
    ]
    return Series(t[first], means, notes)
