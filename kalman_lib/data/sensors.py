"""Do the signals of a recording make sense? An accelerometer with gravity in it is needed, and a
gyroscope."""

import csv
import io

import numpy as np

from .errors import InputError
from .grid import decode
from .resample import interpolate, no_overlap
from .words import NAMES, say

MAX_RATE = 60.0  # rad/s
MOST_METADATA = 100_000  # bytes
MOST_FIELD = 1e6  # in any unit
LEAST_GRAVITY, MOST_GRAVITY = 6, 14  # m/s2: the median of the acceleration lies between
HEADERS = {"gyr": "Gyroscope x (rad/s)", "acc": "Acceleration x (m/s^2)"}


def total_acceleration(signals, device, notes):
    """See to it that signals has "gyr" and "acc", with gravity and in the sign of Android."""
    if "acc" not in signals and "linear" in signals and "gravity" in signals:
        signals["acc"] = _with_gravity(signals["linear"], signals["gravity"])
        say(
            notes,
            "Acceleration without gravity and gravity were added.",
            "Percepatan tanpa gravitasi dan gravitasi dijumlahkan.",
        )
    _check_presence(signals)
    acc = signals["acc"]
    # Sensor Logger on iOS turns the sign, unless "Standardise Units & Frames" is on (its
    # COORDINATES.md and CROSSPLATFORM.md); phyphox on iOS multiplies by -9.81 (its
    # ExperimentSensorInput.swift)
    if acc.source == "logger" and is_apple(device):
        signals["acc"] = acc._replace(values=-acc.values)
        say(
            notes,
            "iPhone: the sign of the acceleration was turned.",
            "iPhone: tanda percepatan dibalik.",
        )
    elif acc.source == "logger" and not device.get("platform"):
        say(
            notes,
            "Metadata.csv is missing: the signs of Android were taken (an iPhone's acceleration is "
            "opposite).",
            "Metadata.csv tidak ada: dipakai tanda Android (percepatan iPhone berlawanan).",
        )


def device_of(content):
    """The first row of Metadata.csv; {} if it cannot be read."""
    text = (decode(content[:MOST_METADATA]) or "").replace("\r\n", "\n").replace("\r", "\n")
    try:
        row = next(csv.DictReader(io.StringIO(text), restval=""), {})
    except csv.Error:
        return {}
    return {name: value for name, value in row.items() if isinstance(value, str)}


def is_apple(device):
    """Does this Metadata.csv of Sensor Logger tell of an iPhone with its own signs?"""
    is_ios = device.get("platform", "").lower() == "ios"
    return is_ios and device.get("standardisation", "").lower() != "true"


def _check_size(signal):
    largest = np.abs(signal.values).max(axis=1)
    if largest.max() > MOST_FIELD:
        (en, id), line = NAMES[signal.kind], signal.lines[np.argmax(largest)]
        raise InputError(
            f"{signal.place}, line {line}: no {en} shows {largest.max():g}.",
            f"{signal.place}, baris {line}: tidak ada {id} yang menunjukkan {largest.max():g}.",
        )


def _with_gravity(linear, gravity):
    inside = (linear.t >= gravity.t[0]) & (linear.t <= gravity.t[-1])
    if inside.sum() < 2:
        raise no_overlap(linear, gravity)
    total = linear.rows(inside)
    return total._replace(kind="acc", values=total.values + interpolate(total.t, gravity))


def _check_presence(signals):
    """InputError if the gyroscope or an accelerometer with gravity is missing."""
    if "acc" not in signals and "linear" in signals:
        place = signals["linear"].place
        raise InputError(
            f"{place}: this accelerometer has no gravity in it; record the one with g (phyphox) or "
            "also TotalAcceleration or Gravity (Sensor Logger).",
            f"{place}: akselerometer ini tanpa gravitasi; rekamlah yang memakai g (phyphox) atau "
            "juga TotalAcceleration atau Gravity (Sensor Logger).",
        )
    for kind, header in HEADERS.items():
        if kind not in signals:
            en, id = NAMES[kind]
            raise InputError(
                f"There is no {en} in the files; record one, with headers such as {header!r}.",
                f"Tidak ada {id} dalam berkas; rekamlah, dengan judul seperti {header!r}.",
            )


def check_magnitudes(gyr, acc, mag):
    """InputError for rates and accelerations that only a wrong unit explains; mag may be None."""
    for signal in filter(None, (acc, mag)):
        _check_size(signal)
    rates = np.abs(gyr.values).max(axis=1)
    if rates.max() > MAX_RATE:
        line, fastest = gyr.lines[np.argmax(rates)], rates.max()
        raise InputError(
            f"{gyr.place}, line {line}: {fastest:.0f} rad/s is faster than any such sensor "
            "measures "
            f"({MAX_RATE:.0f}); is the unit deg/s?",
            f"{gyr.place}, baris {line}: {fastest:.0f} rad/s melebihi kemampuan sensor seperti itu "
            f"({MAX_RATE:.0f}); apakah satuannya deg/s?",
        )
    g = np.median(np.linalg.norm(acc.values, axis=1))
    if not LEAST_GRAVITY < g < MOST_GRAVITY:
        raise InputError(
            f"{acc.place}: half of the accelerations are below {g:.2f} m/s2, but with gravity they "
            "lie around 9.8; either gravity was taken out or the unit in the header is wrong.",
            f"{acc.place}: separuh percepatan di bawah {g:.2f} m/s2, padahal dengan gravitasi "
            "nilainya sekitar 9,8; gravitasinya dihilangkan atau satuan di judul salah.",
        )
