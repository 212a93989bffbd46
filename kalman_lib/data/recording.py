"""Recordings of a gyroscope, an accelerometer and a magnetometer: files of phone apps in, one tidy
Recording out.

The body frame is forward-right-down (FRD). A phone's own axes are x to the right edge, y to the top
edge and z out of the screen; so forward = y, right = x, down = -z. The accelerometer measures
specific force: at rest it points up. Whatever was converted, resampled or left out is told in
Recording.notes."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .angles import tilt_against
from .archives import open_files
from .axes import AXES as AXES
from .axes import body_axes, tell_axes, tell_usual_axes
from .csvs import NoSensor, no_sensor, sheets_of
from .dip import tell_dip
from .resample import rate_of, resample
from .sensors import check_magnitudes, device_of, is_apple, total_acceleration
from .signals import clean, keep, signals_in
from .words import say

MOST_TILT = 10  # degrees; gravity differs more from the app's orientation: it means something else


@dataclass(frozen=True, eq=False)
class Recording:
    """What three sensors measured at N times, in the body frame forward-right-down (FRD).

    t      (N,) s, from 0
    gyr    (N, 3) rad/s
    acc    (N, 3) m/s2, specific force: (0, 0, -9.81) at rest and level
    mag    (N, 3) in any scale, or None
    rate   samples per second
    notes  what was converted, resampled or left out, a list of {"en", "id"}
    reference   the device's own roll, pitch, yaw (N, 3) rad, north-east-down, or None
    """

    t: np.ndarray
    gyr: np.ndarray
    acc: np.ndarray
    mag: np.ndarray | None
    rate: float
    notes: list
    reference: np.ndarray | None = None


def read_recording(files, axes=None):
    """Files of one recording -> Recording.

    files   {name: bytes}, or a path (file, .zip or folder), or a list of paths. Understood are
            phyphox        CSV, .zip of CSVs or .xlsx; headers such as "Gyroscope x (rad/s)", in
                           any language
            Sensor Logger  .zip or its CSVs: Gyroscope, TotalAcceleration (or Accelerometer and
                           Gravity), Magnetometer, Orientation, Metadata
            a plain CSV    "t (s), gx (deg/s), gy .., ax (g), .., mx (uT), .."; the unit decides
    axes    the sensors' own axes: "phone", "flu" (forward-left-up) or "frd", or those that point
            forward, right and down, such as "y x -z" (the phone's); None: "phone" for the apps; for
            a plain CSV "flu" if its z points up at the start, else "frd". Sensors with axes of
            their own: {"gyr": .., "acc": .., "mag": ..}

    Everything is interpolated linearly to the times of the gyroscope, over the time that all
    sensors cover.

    InputError: a sensor is missing, a unit is unknown or cannot be right, a cell is no number,
    times do not increase, sensors do not overlap in time, or a file is empty, too large or of
    another kind.
    """
    notes = []
    chosen = body_axes(axes)
    signals, device = _signals_and_device(open_files(files), notes)
    total_acceleration(signals, device, notes)
    check_magnitudes(signals["gyr"], signals["acc"], signals.get("mag"))
    usual = tell_usual_axes(signals, notes) if axes is None else None
    turns = chosen or body_axes(usual)
    tell_axes(axes or usual, notes)
    t, columns = resample(signals, notes)
    gyr, acc, mag = (_turned(columns.get(kind), turns[kind]) for kind in ("gyr", "acc", "mag"))
    if mag is None:
        _tell_silent_compass(notes)
    else:
        tell_dip(acc, mag, gyr, rate_of(t), notes)
    is_sure = "phone" in (axes, usual) and not is_apple(device)
    reference = _phone_reference(columns.get("orientation"), acc, is_sure, notes)
    recording = Recording(t - t[0], gyr, acc, mag, rate_of(t), notes, reference)
    _tell_rest(recording)
    return recording


def _turned(values, turn):
    """Values (N, 3) in the sensor's axes -> in the body frame; None stays None."""
    return None if values is None else values @ turn.T


def _tell_silent_compass(notes):
    say(
        notes,
        "There is no magnetometer; the heading can only be followed, not measured.",
        "Tidak ada magnetometer; arah hadap hanya dapat diikuti, tidak terukur.",
    )


def _signals_and_device(tables, notes):
    """{name: bytes} -> {kind: Signal} and what Metadata.csv of Sensor Logger tells of the
    device."""
    signals, device, useless = {}, {}, []
    for name, content in tables.items():
        if Path(name).stem.lower() == "metadata":
            device = device_of(content)
            continue
        try:
            sheets = sheets_of(name, content)
        except NoSensor as error:
            useless.append(error)
            continue
        found = [signal for sheet in sheets for signal in signals_in(sheet, notes)]
        if not found:
            useless.append(no_sensor(sheets[0].place, sheets[0].names))
        for signal in found:
            keep(signals, signal)
    _tell_useless(useless, signals, notes)
    return {kind: clean(signal, notes) for kind, signal in signals.items()}, device


def _tell_useless(useless, signals, notes):
    """Files without a sensor are passed over; if a sensor is missing they may be the reason."""
    is_complete = "gyr" in signals and ("acc" in signals or "linear" in signals)
    if useless and not is_complete:
        raise useless[0]
    for error in useless:
        say(notes, f"Passed over: {error.en}", f"Dilewati: {error.id}")


def _phone_reference(angles, acc, is_sure, notes):
    """Sensor Logger's roll, pitch, yaw (N, 3) rad -> ours, or None if their meaning is not certain.

    On Android they are those of SensorManager.getOrientation (COORDINATES.md): yaw and roll as
    ours, pitch turned."""
    if angles is None:
        return None
    angles = angles * [1, -1, 1]
    tilt = tilt_against(angles, acc)
    if is_sure and tilt <= MOST_TILT:
        say(
            notes,
            "Reference: the app's own orientation; its tilt differs from gravity by "
            f"{tilt:.1f} degrees (median).",
            "Acuan: orientasi dari aplikasi; kemiringannya berbeda "
            f"{tilt:.1f} derajat dari gravitasi (median).",
        )
        return angles
    why_en, why_id = "", ""
    if is_sure:
        why_en = f" (it differs from gravity by {tilt:.0f} degrees)"
        why_id = f" (berbeda {tilt:.0f} derajat dari gravitasi)"
    say(
        notes,
        f"The app's own orientation was left out: its convention is not certain here{why_en}.",
        f"Orientasi dari aplikasi tidak dipakai: konvensinya tidak pasti di sini{why_id}.",
    )
    return None


# --- rest at the start --------------------------------------------------------------------------


def rest_seconds(recording, window=0.25):
    """Seconds of rest at the start of a Recording, a multiple of the window; 0.0 if it does not
    begin at rest.

    At rest every gyroscope axis spreads by less than 0.06 rad/s and turns by less than 0.2 rad/s on
    average, every accelerometer axis spreads by less than 0.5 m/s2 and stays within 0.5 m/s2 of its
    first mean."""
    size = max(int(round(window * recording.rate)), 2)
    count = len(recording.t) // size
    if count == 0:
        return 0.0
    gyr = recording.gyr[: count * size].reshape(count, size, 3)
    acc = recording.acc[: count * size].reshape(count, size, 3)
    steady = (gyr.std(axis=1) < 0.06) & (acc.std(axis=1) < 0.5)
    unturned = np.abs(gyr.mean(axis=1)) < 0.2
    unmoved = np.abs(acc.mean(axis=1) - acc[0].mean(axis=0)) < 0.5
    still = (steady & unturned & unmoved).all(axis=1)
    windows = count if still.all() else np.argmin(still)
    if windows == 0:
        return 0.0
    return float(recording.t[windows * size - 1]) + 1 / recording.rate


def _tell_rest(recording):
    rest = rest_seconds(recording)
    if rest:
        say(
            recording.notes,
            f"The recording lies still for its first {rest:.2f} s.",
            f"Rekaman diam selama {rest:.2f} s pertama.",
        )
    else:
        say(
            recording.notes,
            "The recording does not begin at rest: the bias of the gyroscope must be found in the "
            "motion.",
            "Rekaman tidak dimulai dalam keadaan diam: bias giroskop harus dicari selagi bergerak.",
        )
