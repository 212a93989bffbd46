"""Means and variances of angles, and measures of error; NaN is left out."""

import numpy as np

from .flight import to_body
from .model import wrap


def direction(angles):
    """The mean direction, which +179 and -179 degrees have at 180; 0 where the sensor is silent."""
    return float(np.angle(np.nansum(np.exp(1j * angles))))


def spread(angles):
    """Variance of angles around their mean direction; 0 without any."""
    if np.isnan(angles).all():  # also without any
        return 0.0
    return float(np.nanmean(wrap(angles - direction(angles)) ** 2))


# --- measures of error --------------------------------------------------------------------------


def galat(reference, estimate):
    """Equation (25): |mean of reference - mean of estimate| / |mean of reference|, in percent."""
    reference = np.mean(reference, axis=0)
    return 100 * np.abs(reference - np.mean(estimate, axis=0)) / np.abs(reference)


def rmse_deg(truth, angles):
    """Root mean square over time of the wrapped errors of the angles (N, ...), in degrees; NaN is
    left out."""
    error = wrap(angles - truth)
    known = np.isfinite(error)
    total = np.sum(np.where(known, error, 0) ** 2, axis=0)
    count = np.where(known.any(axis=0), known.sum(axis=0), np.nan)
    return np.degrees(np.sqrt(total / count))


def tilt_error(truth, angles):
    """The angle (N,) rad between the two vertical directions that truth and angles (N, 3) claim.

    Yaw does not matter, and it keeps its meaning where the pitch is near 90 degrees.
    """
    down = [0, 0, 1]
    cosine = (to_body(down, truth) * to_body(down, angles)).sum(axis=1)
    return np.arccos(np.clip(cosine, -1, 1))
