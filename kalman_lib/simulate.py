"""A model and a random generator give a made-up truth and its noisy measurements."""

from dataclasses import dataclass

import numpy as np

from .checks import check_finite, check_shape, numbers, series, steps_of


@dataclass(frozen=True, eq=False)
class Trajectory:
    """T steps of a simulated (synthetic) system.

    x (T, n) true states, z (T, m) measurements, u (T, l) or None.
    """

    x: np.ndarray
    z: np.ndarray
    u: np.ndarray | None = None


def simulate(model, steps, rng, u=None, x0=None):
    """Run the model for a number of steps T with random noise -> Trajectory.

    model LinearModel or NonlinearModel, whose matrices may change from step to step; rng numpy
    Generator; u (T, l) inputs, or (T,) if l = 1, row k drives the step to k; x0 (n,) the true state
    before the first step (None: drawn from N(model.x0, model.P0)). Where a variance in R is
    infinite, the sensor is silent: z is NaN.
    """
    _check(steps, rng)
    steps_of(model, steps)
    u = None if u is None else series("u", u, steps=steps)
    if x0 is None:
        x = rng.multivariate_normal(model.x0, model.P0, method="eigh")
    else:
        x = check_finite("x0", numbers("x0", x0, 1))
        check_shape("x0", x, model.x0.shape)
    w = _noise(model.Q, steps, rng)
    v = _noise(model.R, steps, rng)
    states = []
    measurements = []
    for k in range(steps):
        u_k = None if u is None else u[k]
        x = model.transition(x, u_k, k)[0] + w[k]
        z = model.measure(x, u_k, k)[0] + v[k]
        states.append(x)
        measurements.append(z)
    return Trajectory(np.array(states), np.array(measurements), u)


def _check(steps, rng):
    """ValueError unless steps is a number of steps and rng a Generator."""
    if isinstance(steps, bool) or not isinstance(steps, (int, np.integer)) or steps < 1:
        raise ValueError(
            f"steps = {steps!r}: expected a whole number of at least 1. / "
            f"steps = {steps!r}: seharusnya bilangan bulat, sedikitnya 1."
        )
    if not isinstance(rng, np.random.Generator):
        kind = type(rng).__name__
        raise ValueError(
            f"rng must be a NumPy Generator (np.random.default_rng(1)), not {kind}. / "
            f"rng harus Generator NumPy (np.random.default_rng(1)), bukan {kind}."
        )


def _noise(covariance, steps, rng):
    """Random vectors (T, size) with mean 0 and the covariance (size, size), or (T, size, size)."""
    zero = np.zeros(covariance.shape[-1])
    if covariance.ndim == 2 and np.isfinite(covariance).all():
        return rng.multivariate_normal(zero, covariance, size=steps, method="eigh")
    each = np.broadcast_to(covariance, (steps, *covariance.shape[-2:]))
    return np.array([_one_noise(C, zero, rng) for C in each])


def _one_noise(C, zero, rng):
    """One random vector; NaN where the variance is infinite."""
    infinite = np.isinf(np.diag(C))
    finite = np.where(infinite | infinite[:, np.newaxis], 0, C)
    drawn = rng.multivariate_normal(zero, finite, method="eigh")
    return np.where(infinite, np.nan, drawn)
