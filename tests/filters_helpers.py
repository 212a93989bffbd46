"""Random models, and arrays that are equal but for rounding."""

import numpy as np

from kalman_lib import (
    LinearModel,
)


def covariance(rng, size):
    A = rng.normal(size=(size, size))
    return A @ A.T + 0.1 * np.eye(size)


def random_model(rng, n=None, m=None, l=0):
    n, m = n or rng.integers(1, 5), m or rng.integers(1, 4)
    F = rng.normal(size=(n, n))
    F /= max(1, np.abs(np.linalg.eigvals(F)).max() / 0.98)
    return LinearModel(
        F=F,
        H=rng.normal(size=(m, n)),
        Q=covariance(rng, n),
        R=covariance(rng, m),
        x0=rng.normal(size=n),
        P0=covariance(rng, n),
        B=rng.normal(size=(n, l)) if l else None,
    )


def close(a, b, tolerance=1e-9):
    """Equal relative to the largest entry."""
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape
    assert np.abs(a - b).max() <= tolerance * max(1e-300, np.abs(b).max())
