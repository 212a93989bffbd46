"""Which column is the time, and which one the measurement, unless the reader chooses others."""

import numpy as np

from .units import VALUE_WORDS, names_measurement, names_row, names_side, names_time

EPOCHS = {1e9: "s", 1e12: "ms", 1e15: "us", 1e18: "ns"}  # since 1970, today


def roles(columns, units, heads, moments):
    """(time or None, value or None): names of columns.

    heads {name: text of the header, "" without one}; moments: names of columns of dates and clock
    times.
    """
    counters = [name for name in columns if _counts_rows(columns, heads, name)]
    times = [name for name in columns if _is_time(columns, units, heads, moments, name)]
    times = [name for name in times if name not in counters] or _first_that_grows(
        columns, heads, counters
    )
    rest = [name for name in columns if name not in times and name not in counters]
    if not rest:
        return _of_few(columns, times, moments)
    growing = [name for name in times if grows(columns[name])]
    time = next(iter(growing or times), None)
    return time, measurement_in(rest, heads)


def measurement_in(names, heads, words=VALUE_WORDS):
    """The first column whose name says that it is measured; else the first one."""
    named = [name for name in names if names_measurement(heads[name], words)]
    others = [name for name in names if not names_side(heads[name])]
    return next(iter(named or others or names), None)


def _of_few(columns, times, moments):
    """Only times or numbers of rows: the last one is what was measured, if it is no clock."""
    numbers = [name for name in columns if name not in moments]
    value = numbers[-1] if numbers else None
    return next((name for name in times if name != value), None), value


def grows(values):
    """Does it never go back, and gets somewhere?"""
    known = values[np.isfinite(values)]
    steps = np.diff(known)
    return bool(len(known) > 1 and (steps >= 0).all() and known[-1] > known[0])


def _is_time(columns, units, heads, moments, name):
    if name in moments:
        return True
    head = heads[name]
    if not head or not names_time(head, units.get(name, "")):
        return False
    is_letter = head.strip() == "T"  # a temperature, unless it grows
    return grows(columns[name]) or not is_letter


def _counts_rows(columns, heads, name):
    """1, 2, 3 under "No", or under nothing while other columns have names."""
    steps = np.diff(columns[name])
    if not (steps == 1).all() or columns[name][0] not in (0, 1):
        return False
    return names_row(heads[name]) or (not heads[name] and any(heads.values()))


def _first_that_grows(columns, heads, counters):
    """Without names: the first column if it grows; where it only counts, the second that does."""
    if any(heads.values()) or len(columns) < 2:
        return []
    names = list(columns)
    first, second = columns[names[0]], columns[names[1]]
    if len(first) < 2 or not (np.diff(first) > 0).all():
        return []
    counts = len(columns) > 2 and len(first) > 2 and (np.diff(first) == 1).all()
    if counts and first[0] in (0, 1) and (np.diff(second) > 0).all():
        counters.append(names[0])
        return [names[1]]
    return [names[0]]


def epoch_unit(values):
    """ "ms" for 1700000000000: the unit of times since 1970; "" if they cannot be that."""
    known = values[np.isfinite(values)]
    if not len(known):
        return ""
    for size, unit in EPOCHS.items():
        if (known >= 0.5 * size).all() and (known < 5 * size).all():
            return unit
    return ""
