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
from .csvs import NoSensor, sheets_of
from .resample import rate_of, resample
from .sensors import check_magnitudes, device_of, is_apple, total_acceleration
from .signals import clean, keep, signals_in
from .words import AXES_NAMES, say

PHONE = np.array([
    [0, 1, 0],
    [1, 0, 0],
    [0, 0, -1],
])
AXES = {  # body axis = row times sensor axis
    "phone": PHONE,
    "flu": np.diag([1, -1, -1]),
    "frd": np.eye(3, dtype=int),
}
MOST_TILT = (
    10  # degrees: if gravity differs more from the app's orientation, that means something else
)


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
    axes    the sensors' own axes: "phone", "flu" (forward-left-up) or "frd"; None: "phone" for the
            apps, "frd" for a plain CSV

    Everything is interpolated linearly to the times of the gyroscope, over the time that all
    sensors cover.

    InputError: a sensor is missing, a unit is unknown or cannot be right, a cell is no number,
    times do not increase, sensors do not overlap in time, or a file is empty, too large or of
    another kind.
    """
    notes = []
    _check_axes(axes)
    signals, device = _signals_and_device(open_files(files), notes)
    total_acceleration(signals, device, notes)
    check_magnitudes(signals["gyr"], signals["acc"], signals.get("mag"))
    axes = axes or _usual_axes(signals, notes)
    _tell_axes(axes, notes)
    t, columns = resample(signals, notes)
    gyr, acc, mag = (_turned(columns.get(kind), axes) for kind in ("gyr", "acc", "mag"))
    if mag is None:
        _tell_silent_compass(notes)
    is_sure = axes == "phone" and not is_apple(device)
    reference = _phone_reference(columns.get("orientation"), acc, is_sure, notes)
    recording = Recording(t - t[0], gyr, acc, mag, rate_of(t), notes, reference)
    _tell_rest(recording)
    return recording


def _check_axes(axes):
    if axes not in (None, *AXES):
        known = list(AXES)
        raise ValueError(
            f"axes must be None or one of {known}. / axes harus None atau salah satu dari itu."
        )


def _turned(values, axes):
    """Values (N, 3) in the sensor's axes -> in the body frame; None stays None."""
    return None if values is None else values @ AXES[axes].T


def _tell_axes(axes, notes):
    en, id = AXES_NAMES[axes]
    say(notes, f"Axes taken: {en}.", f"Sumbu yang dipakai: {id}.")


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
            found = [one for sheet in sheets_of(name, content) for one in signals_in(sheet, notes)]
        except NoSensor as error:
            useless.append(error)
            continue
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


def _usual_axes(signals, notes):
    """The axes where the reader has named none."""
    if signals["gyr"].source != "plain":
        return "phone"
    if signals["acc"].values[:10, 2].mean() > 5:
        say(
            notes,
            "az is positive at the start, so the device begins upside down; if its z points up, "
            "choose the axes flu or phone.",
            "az positif pada awalnya, jadi alat mulai dalam keadaan terbalik; jika sumbu z-nya ke "
            "atas, pilihlah sumbu flu atau phone.",
        )
    return "frd"


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
            "The recording does not begin at rest; let the device lie still for some seconds "
            "first.",
            "Rekaman tidak dimulai dalam keadaan diam; biarkan alat diam beberapa detik lebih "
            "dahulu.",
        )
