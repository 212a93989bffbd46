"""Signals with times of their own in, all of them at the times of the gyroscope out."""

import numpy as np

from .angles import interpolate_angles
from .errors import InputError
from .words import NAMES, say

GAP = 0.1  # s; a longer pause is told
KINDS = ("gyr", "acc", "mag", "orientation")
LEAST_IN_COMMON = 10  # times


def resample(signals, notes):
    """{kind: Signal} -> t (N,) s and {kind: values at t}, over the time that all sensors cover."""
    parts = {kind: signals[kind] for kind in KINDS if kind in signals}
    gyr = parts["gyr"]
    t = gyr.t
    for signal in parts.values():
        t = t[(t >= signal.t[0]) & (t <= signal.t[-1])]
        if len(t) < LEAST_IN_COMMON:
            raise no_overlap(gyr, signal)
    _tell_rates(parts, notes)
    if len(t) < len(gyr.t):
        kept, all_of_it = t[-1] - t[0], gyr.t[-1] - gyr.t[0]
        say(
            notes,
            f"Only the {kept:.2f} s that all sensors cover are kept, of {all_of_it:.2f} s.",
            f"Hanya {kept:.2f} s yang dicakup semua sensor dipakai, dari {all_of_it:.2f} s.",
        )
    for signal in parts.values():
        _tell_gaps(signal, t, notes)
    return t, {kind: _values_at(t, signal) for kind, signal in parts.items()}


def _values_at(t, signal):
    if signal.kind == "orientation":
        return interpolate_angles(t, signal.t, signal.values)
    return interpolate(t, signal)


def interpolate(t, signal):
    """The values of a Signal at t (N,), straight between its own times -> (N, 3)."""
    return np.column_stack([np.interp(t, signal.t, column) for column in signal.values.T])


def rate_of(t):
    """Samples per second."""
    return 1 / np.median(np.diff(t))


def _tell_rates(parts, notes):
    rates = {kind: rate_of(signal.t) for kind, signal in parts.items()}
    en = ", ".join(f"{NAMES[kind][0]} {rate:.4g} Hz" for kind, rate in rates.items())
    id = ", ".join(f"{NAMES[kind][1]} {rate:.4g} Hz" for kind, rate in rates.items())
    if all(np.array_equal(signal.t, parts["gyr"].t) for signal in parts.values()):
        say(notes, f"Rates: {en}.", f"Laju: {id}.")
    else:
        say(
            notes,
            f"Rates: {en}; all were interpolated linearly to the gyroscope's times.",
            f"Laju: {id}; semua diinterpolasi linear ke waktu giroskop.",
        )


def _tell_gaps(signal, t, notes):
    """A note on the pauses of a Signal between the first and the last of the times t."""
    pauses = np.diff(signal.t)
    is_long = pauses > max(GAP, 3 / rate_of(signal.t))
    is_long &= (signal.t[1:] > t[0]) & (signal.t[:-1] < t[-1])
    if not is_long.any():
        return
    en, id = NAMES[signal.kind]
    worst = np.argmax(pauses * is_long)
    pause, start = f"{pauses[worst]:.2f} s", f"{signal.t[worst] - t[0]:.2f} s"
    say(
        notes,
        f"Gaps of the {en}: {is_long.sum()}; the longest, {pause}, begins at {start}.",
        f"Celah {id}: {is_long.sum()}; yang terpanjang, {pause}, mulai pada {start}.",
    )


def no_overlap(one, other):
    """The InputError for two Signals that were not recorded at the same time."""

    def span(signal, to):
        return f"{signal.place} ({signal.t[0]:.2f} {to} {signal.t[-1]:.2f} s)"

    return InputError(
        f"{span(one, 'to')} and {span(other, 'to')} have fewer than 10 times of the gyroscope in "
        "common.",
        f"{span(one, 'sampai')} dan {span(other, 'sampai')} memiliki kurang dari 10 waktu giroskop "
        "yang sama.",
    )
