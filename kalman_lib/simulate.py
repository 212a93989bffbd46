"""A model and a random generator give a made-up truth and its noisy measurements."""
from dataclasses import dataclass

import numpy as np

from .models import _shape_message


@dataclass(frozen=True, eq=False)
class Trajectory:
    """T steps of a simulated (synthetic) system: x (T, n) true states, z (T, m) measurements, u (T, l) or None."""
    x: np.ndarray
    z: np.ndarray
    u: np.ndarray | None = None


def simulate(model, steps, rng, u=None, x0=None):
    """Run the model for a number of steps with random noise.

    model LinearModel or NonlinearModel; steps T; rng numpy Generator; u (T, l) inputs, or (T,) if l = 1, row k drives the step to k;
    x0 (n,) the true state before the first step (None: drawn from N(model.x0, model.P0)). Returns a Trajectory.
    """
    n, m = len(model.x0), model.R.shape[-1]
    u = None if u is None else np.asarray(u, dtype=float).reshape(len(u), -1)
    if u is not None and len(u) != steps:
        raise ValueError(_shape_message("u", u.shape, f"({steps}, l)"))
    if model.R.ndim == 3 and len(model.R) != steps:
        raise ValueError(_shape_message("R", model.R.shape, (steps, *model.R.shape[1:])))
    x = rng.multivariate_normal(model.x0, model.P0, method="eigh") if x0 is None else np.asarray(x0, dtype=float)
    w = rng.multivariate_normal(np.zeros(n), model.Q, size=steps, method="eigh")
    if model.R.ndim == 2:
        v = rng.multivariate_normal(np.zeros(m), model.R, size=steps, method="eigh")
    else:
        v = [rng.multivariate_normal(np.zeros(m), R, method="eigh") for R in model.R]
    states, measurements = [], []
    for k in range(steps):
        x = model.transition(x, None if u is None else u[k])[0] + w[k]
        states.append(x)
        measurements.append(model.measure(x)[0] + v[k])
    return Trajectory(np.array(states), np.array(measurements), u)
