"""A recording, checked; the measured angles and their noise; when the craft is dynamic."""

import numpy as np

from ...checks import shape_message
from .model import heading, printed_tilt, tilt
from .rest import at_rest
from .statistics import direction, spread

R_LEAST = 1e-12  # rad2
LARGEST = 1e6  # in any unit; no sensor shows more


def check_recording(t, gyr, acc, mag, rest_s):
    """The recording as arrays of float, checked, and which samples (N,) are at rest."""
    t = np.asarray(t, dtype=float)
    N = len(t)
    gyr, acc, mag = _vectors(gyr, N), _vectors(acc, N), _vectors(mag, N)
    for name, values, expected in (
        ("t", t, (N,)),
        ("gyr", gyr, (N, 3)),
        ("acc", acc, (N, 3)),
        ("mag", mag, (N, 3)),
    ):
        if values.shape != expected:
            raise ValueError(shape_message(name, values.shape, expected))
    _check_finite("t", t)
    _check_finite("gyr", gyr)
    for name, values in (("gyr", gyr), ("acc", acc), ("mag", mag)):
        _check_size(name, values)
    back = np.diff(t) <= 0
    if back.any():
        k = int(back.argmax()) + 1
        raise ValueError(
            f"t does not increase at t[{k}] = {t[k]:g} s. / t tidak bertambah di t[{k}] = {t[k]:g} "
            "s."
        )
    if N == 0:
        raise ValueError("The recording is empty. / Rekamannya kosong.")
    acc, mag = _silent_zeros(acc), _silent_zeros(mag)
    return t, gyr, acc, mag, at_rest(t, gyr, acc, rest_s)


def _vectors(values, N):
    """An array of floats; NaN for a sensor that is not there."""
    return np.full((N, 3), np.nan) if values is None else np.asarray(values, dtype=float)


def _check_finite(name, values):
    bad = ~np.isfinite(values.reshape(len(values), -1)).all(axis=1)
    if bad.any():
        place = f"{name}[{bad.argmax()}]"
        raise ValueError(f"{place} is not a finite number. / {place} bukan bilangan berhingga.")


def _check_size(name, values):
    bad = (np.abs(values) > LARGEST).any(axis=1)
    if bad.any():
        place = f"{name}[{bad.argmax()}]"
        raise ValueError(
            f"{place} holds a value beyond {LARGEST:g}, which no sensor shows. / "
            f"{place} memuat nilai di atas {LARGEST:g}, yang tidak ditunjukkan sensor mana pun."
        )


def _silent_zeros(vectors):
    """A vector (0, 0, 0) has no direction: its sensor was silent."""
    return np.where((vectors == 0).all(axis=1)[:, np.newaxis], np.nan, vectors)


def measured(acc, mag, rest, how):
    """The measured angles (N, 3) and their mean at rest, where the filter starts; without a rest
    the first seconds serve.

    The yaw is the one for the tilt at rest, as the filter computes it again from its own tilt; or,
    without the estimated tilt, the one for the accelerometer's."""
    z = printed_tilt(acc) if "formulas" in how.without else tilt(acc)
    roll_at_rest = direction(z[rest, 0])
    pitch_at_rest = direction(z[rest, 1])
    if "estimated tilt" in how.without:
        yaw = heading(mag, z[:, 0], z[:, 1])
    else:
        yaw = heading(mag, roll_at_rest, pitch_at_rest)
    return np.column_stack([z, yaw]), [roll_at_rest, pitch_at_rest, direction(yaw[rest])]


def measurement_noise(t, z, mag, rest, how):
    """R (N, 3), or (N, 3, cells) where m holds many: the variance of the angles, times m where
    dynamic."""
    seen = z if "rest variance" in how.without else z[rest]  # without a rest only R_min counts
    R = [max(spread(angles), low, R_LEAST) for angles, low in zip(seen.T, how.R_min)]
    dynamic = is_dynamic(t, mag, rest, how.window, how.threshold)
    m = np.atleast_1d(how.m)
    factor = np.where(dynamic[:, np.newaxis], m, 1.0)  # (N, cells)
    R = factor[:, np.newaxis, :] * np.array(R)[:, np.newaxis]
    return R if np.ndim(how.m) else R[..., 0]


def is_dynamic(t, mag, rest, window, threshold):
    """Where (N,) the variance of the magnetometer over the last window (s), all axes together,
    exceeds the threshold times its variance at rest: the paper's test. Without a rest the quietest
    window serves."""
    known = np.isfinite(mag).all(axis=1)
    if not known[rest].any() and (rest.any() or not known.any()):
        return np.zeros(len(t), dtype=bool)
    still = rest if rest.any() else known
    middle = np.nanmean(mag[still], axis=0)  # differences from it lose no digits
    values = np.where(known[:, np.newaxis], mag - middle, 0)
    length = min(len(t), max(2, round(window / np.median(np.diff(t)))))  # steps
    count = np.maximum(_sliding_sum(known[:, np.newaxis], length), 1)
    mean_square = _sliding_sum(values**2, length) / count
    mean = _sliding_sum(values, length) / count
    variance = (mean_square - mean**2).sum(axis=1)
    if not rest.any():
        return variance > threshold * variance[length - 1 :].min()
    return variance > threshold * np.nanvar(mag[rest], axis=0).sum()


def _sliding_sum(values, length):
    """At each step the sum of the last `length` rows of values (N, columns)."""
    sums = np.cumsum(values, axis=0)
    sums[length:] = sums[length:] - sums[:-length]
    return sums
