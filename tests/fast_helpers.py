"""Random models, and the fast forms compared with the readable loop, field by field."""

from dataclasses import fields

import numpy as np

from kalman_lib import LinearModel, fast, filters

FIELDS = [field.name for field in fields(filters.FilterResult)]


def covariance(rng, size):
    A = rng.normal(size=(size, size))
    return A @ A.T + 0.1 * np.eye(size)


def random_model(rng, n, m, l=0, Q=1.0, R=1.0, P0=1.0, radius=0.98, R_in_time=None):
    F = rng.normal(size=(n, n))
    F *= rng.uniform(0.3, 1) * radius / np.abs(np.linalg.eigvals(F)).max()
    H = np.eye(m, n) if rng.random() < 0.5 else rng.normal(size=(m, n))
    R = R * covariance(rng, m)
    if R_in_time:
        R = R * rng.uniform(0.2, 5, size=(R_in_time, 1, 1))
    return LinearModel(
        F=F,
        H=H,
        Q=Q * covariance(rng, n),
        R=R,
        x0=rng.normal(size=n),
        P0=P0 * covariance(rng, n),
        B=rng.normal(size=(n, l)) if l else None,
    )


def close(ours, loop, tolerance=1e-12):
    """Equal relative to the largest value of each column over time; NaN at the same places.

    A column is a state, a sensor, an entry.
    """
    ours, loop = np.asarray(ours, dtype=float), np.asarray(loop, dtype=float)
    assert ours.shape == loop.shape and np.array_equal(np.isnan(ours), np.isnan(loop))
    error, scale = np.nanmax(np.abs(ours - loop), axis=0), np.nanmax(np.abs(loop), axis=0)
    assert (error <= tolerance * np.maximum(scale, 1e-6 * scale.max())).all()


def close_in_sigmas(ours, loop, scale):
    """Covariances whose entries are equal relative to the two standard deviations in scale."""
    sigma = np.sqrt(np.einsum("kii->ki", scale))
    limit = 1e-12 * sigma[:, :, np.newaxis] * sigma[:, np.newaxis] + 1e-300
    assert (np.abs(ours - loop) <= limit).all()


def same_filter(model, z, u=None):
    """Compare all fields of the fast and the readable filter -> both results."""
    ours, loop = fast.kalman_filter(model, z, u), filters.kalman_filter(model, z, u)
    for name in ("x_pred", "x", "y"):
        close(getattr(ours, name), getattr(loop, name))
    for name in ("F", "H", "Q", "R", "start", "gated"):
        assert np.array_equal(getattr(ours, name), getattr(loop, name))
    # a gain is at most sigma / sqrt(S)
    variance = np.einsum("kii->ki", loop.P_pred)[:, :, np.newaxis]
    largest = np.sqrt(variance / np.einsum("kii->ki", loop.S)[:, np.newaxis])
    assert (np.abs(ours.K - loop.K) <= 1e-12 * largest + 1e-300).all()
    # P is what is left of P_pred, also in rounding; of a huge ratio Q / R the loop itself keeps no
    # more digits
    for name, scale in (("P_pred", loop.P_pred), ("S", loop.S), ("P", loop.P_pred)):
        close_in_sigmas(getattr(ours, name), getattr(loop, name), scale)
    assert np.array_equal(ours.P, ours.P.swapaxes(1, 2))
    return ours, loop


def same_smoother(ours, loop):
    ours, loop = fast.rts_smooth(ours), filters.rts_smooth(loop)
    close(ours.x, loop.x)
    close_in_sigmas(ours.P, loop.P, loop.P)
