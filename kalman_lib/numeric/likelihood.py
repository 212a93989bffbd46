"""The log-density of innovations y ~ N(0, S), with gaps, and where S has lost its digits."""

import numpy as np

from ..checks import correlations
from ..roots import steps_again


def log_density(y, S):
    """-(ln det(2 pi S) + y' S^-1 y) / 2, summed over the steps: y (T, runs, m) -> (runs,).

    S (T, runs, m, m), or (T, 1, m, m) where the runs share it. Only what was measured counts: NaN
    in y and an infinite variance in S leave the rest of the row.
    """
    variance = np.diagonal(S, axis1=2, axis2=3)
    seen = ~(np.isnan(y) | np.isinf(variance))
    e = np.where(seen, y, 0)
    if (seen == seen[:, :1]).all():  # the runs share their gaps, and so their S
        seen = seen[:, :1]
    with np.errstate(all="ignore"):
        sigma = np.where(seen, np.sqrt(variance), 1)
        both = seen[..., :, np.newaxis] & seen[..., np.newaxis, :]
        scaled = S / (sigma[..., :, np.newaxis] * sigma[..., np.newaxis, :])
        L = _cholesky(np.where(both, scaled, np.eye(y.shape[2])))
        white = (np.linalg.inv(L) @ (e / sigma)[..., np.newaxis])[..., 0]
        log_S = 2 * np.log(sigma * np.diagonal(L, axis1=2, axis2=3))
        total = -np.sum(seen * np.log(2 * np.pi) + log_S + white**2, axis=(0, 2)) / 2
    return np.where(np.isnan(total), -np.inf, total)


def _cholesky(C):
    """The lower Cholesky factors of C (T, runs, m, m), which is S with a unit diagonal."""
    C = np.where(np.isfinite(C).all(axis=(1, 2, 3), keepdims=True), C, 0)
    try:
        return np.linalg.cholesky(C)
    except np.linalg.LinAlgError:
        k = int(np.argmax(np.linalg.eigvalsh(C).min(axis=(1, 2)) < 1e-15))
        raise ValueError(
            f"S[{k}] is not a covariance (positive definite). / "
            f"S[{k}] bukan kovarians (definit positif)."
        ) from None


def almost_singular(S):
    """Do sensors say nearly the same, so that S (T, m, m) has lost the digits that part them?

    Of many runs S may also be (T, m, m, runs).
    """
    if S.shape[1] == 1:
        return False
    if S.ndim == 4:
        S = np.moveaxis(S, 3, 1).reshape(-1, *S.shape[1:3])
    variance = np.diagonal(S, axis1=1, axis2=2)
    sigma = np.sqrt(np.where(np.isfinite(variance), variance, 1))
    told = correlations(np.where(np.isfinite(S), S, 0), sigma)
    silent = ~np.isfinite(variance)
    told[silent] = told.swapaxes(1, 2)[silent] = 0
    told = told + silent[:, np.newaxis] * np.eye(S.shape[1])
    return bool(np.linalg.eigvalsh(told)[:, 0].min() < 1e-5)


def sensor_by_sensor(result):
    """The log-density of one run by the roots of P_pred: no S of several sensors is needed."""
    total = 0.0
    for step, R, y in zip(steps_again(result), result.R, result.y):
        heard = np.isfinite(y)
        total -= np.linalg.slogdet(2 * np.pi * R[np.ix_(heard, heard)])[1] / 2
        for S, y_i in step.innovations:
            total -= (np.log(S) + y_i**2 / S) / 2
    return float(total)
