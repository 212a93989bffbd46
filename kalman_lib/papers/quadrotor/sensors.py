"""A recording, checked; the measured angles and their noise; when the craft is dynamic."""

import numpy as np

from ...checks import shape_message
from .model import heading, printed_tilt, tilt
from .statistics import direction, spread

R_LEAST = 1e-12  # rad2
LEAST_AT_REST = 10  # samples


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
    back = np.diff(t) <= 0
    if back.any():
        k = int(back.argmax()) + 1
        raise ValueError(
            f"t does not increase at t[{k}] = {t[k]:g} s. / t tidak bertambah di t[{k}] = {t[k]:g} "
            "s."
        )
    rest = t - t[0] <= rest_s if N else np.zeros(0, dtype=bool)
    if rest.sum() < LEAST_AT_REST:
        raise ValueError(
            f"rest_s = {rest_s} s holds {rest.sum()} samples; at least 10 samples of rest at the "
            "start "
            f"are needed. / rest_s = {rest_s} s memuat {rest.sum()} sampel; diperlukan sedikitnya "
            "10 "
            "sampel diam di awal."
        )
    return t, gyr, acc, mag, rest


def _vectors(values, N):
    """An array of floats; NaN for a sensor that is not there."""
    return np.full((N, 3), np.nan) if values is None else np.asarray(values, dtype=float)


def _check_finite(name, values):
    bad = ~np.isfinite(values.reshape(len(values), -1)).all(axis=1)
    if bad.any():
        place = f"{name}[{bad.argmax()}]"
        raise ValueError(f"{place} is not a finite number. / {place} bukan bilangan berhingga.")


def measured(acc, mag, rest, how):
    """The measured angles (N, 3) and the mean angles at rest, where the filter starts.

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
    seen = z if "rest variance" in how.without else z[rest]
    R = [max(spread(angles), low, R_LEAST) for angles, low in zip(seen.T, how.R_min)]
    dynamic = is_dynamic(t, mag, rest, how.window, how.threshold)
    m = np.atleast_1d(how.m)
    factor = np.where(dynamic[:, np.newaxis], m, 1.0)  # (N, cells)
    R = factor[:, np.newaxis, :] * np.array(R)[:, np.newaxis]
    return R if np.ndim(how.m) else R[..., 0]


def is_dynamic(t, mag, rest, window, threshold):
    """Where (N,) the variance of the magnetometer over the last window (s), all axes together,
    exceeds the threshold times its variance at rest: the paper's test."""
    known = np.isfinite(mag).all(axis=1)
    if not known[rest].any():
        return np.zeros(len(t), dtype=bool)
    middle = np.nanmean(mag[rest], axis=0)  # differences from it lose no digits
    values = np.where(known[:, np.newaxis], mag - middle, 0)
    length = min(len(t), max(2, round(window / np.median(np.diff(t)))))  # steps
    count = np.maximum(_sliding_sum(known[:, np.newaxis], length), 1)
    mean_square = _sliding_sum(values**2, length) / count
    mean = _sliding_sum(values, length) / count
    variance = (mean_square - mean**2).sum(axis=1)
    return variance > threshold * np.nanvar(mag[rest], axis=0).sum()


def _sliding_sum(values, length):
    """At each step the sum of the last `length` rows of values (N, columns)."""
    sums = np.cumsum(values, axis=0)
    sums[length:] = sums[length:] - sums[:-length]
    return sums
