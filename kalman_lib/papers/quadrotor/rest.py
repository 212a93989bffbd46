"""Does a recording begin at rest? If not, its first seconds must do without."""

import math
import warnings

import numpy as np

LEAST_AT_REST = 10  # samples
START = 4.0  # s, from which the attitude is taken where there is no rest
WINDOW = 0.25  # s, in which noise averages out and a motion does not
UNTURNED = 0.06  # rad/s (3.4 deg/s) by which the mean rates of windows may differ
UNMOVED = 0.5  # m/s2, likewise; a hovering craft is still enough


def at_rest(t, gyr, acc, rest_s):
    """Which samples (N,) are at rest: those of the first rest_s seconds, or none.

    None with rest_s = 0, and where the sensors deny it; then a UserWarning is given."""
    if not (math.isfinite(rest_s) and rest_s >= 0):
        raise ValueError(
            f"rest_s = {rest_s} is no length of time; 0 means that there is no rest. / "
            f"rest_s = {rest_s} bukan lama waktu; 0 berarti tidak ada saat diam."
        )
    rest = (t - t[0] <= rest_s) & (rest_s > 0)
    if rest_s > 0 and rest.sum() < LEAST_AT_REST:
        raise ValueError(
            f"rest_s = {rest_s} s holds {rest.sum()} samples; at least {LEAST_AT_REST} samples of "
            f"rest at the start are needed, or rest_s = 0. / rest_s = {rest_s} s memuat "
            f"{rest.sum()} sampel; diperlukan sedikitnya {LEAST_AT_REST} sampel diam di awal, atau "
            "rest_s = 0."
        )
    if rest.any() and _moves(t[rest], gyr[rest], acc[rest]):
        warnings.warn(
            f"The first {rest_s:g} s (rest_s) are no rest: the sensors show a motion; the "
            f"recording is taken as one without rest. / {rest_s:g} s pertama (rest_s) bukan saat "
            "diam: sensor menunjukkan gerak; rekaman dianggap tanpa saat diam.",
            stacklevel=4,
        )
        return np.zeros(len(t), dtype=bool)
    return rest


def at_start(t, rest):
    """The samples (N,) that tell where the filter starts."""
    return rest if rest.any() else t - t[0] <= START


def _moves(t, gyr, acc):
    """Do the means of short windows differ by more than the noise explains?"""
    seconds = t[-1] - t[0]
    return _spreads(gyr, seconds, UNTURNED) or _spreads(acc, seconds, UNMOVED)


def _spreads(values, seconds, most):
    values = values[np.isfinite(values).all(axis=1)]
    windows = max(2, min(int(seconds / WINDOW), len(values) // 5))
    if len(values) < LEAST_AT_REST:
        return False  # silent
    means = np.array([part.mean(axis=0) for part in np.array_split(values, windows)])
    tremble = np.sqrt((np.diff(values, axis=0) ** 2).mean(axis=0) / 2)  # noise of one sample
    noise = tremble / np.sqrt(len(values) / windows)
    return bool((means.std(axis=0) > most + 3 * noise).any())
