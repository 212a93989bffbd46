"""The fast forms of many runs against the readable loop, run by run."""

from dataclasses import replace

import numpy as np
import pytest
from fast_helpers import FIELDS, close, random_model

from kalman_lib import fast, filters
from kalman_lib.papers import beetle
from kalman_lib.simulate import simulate


@pytest.mark.parametrize("steps", [20, 400])
@pytest.mark.parametrize("seed", range(8))
def test_many_runs(seed, steps):
    rng = np.random.default_rng(seed)
    n, m, l = 1, 1, seed // 3 % 2
    if seed % 3:
        n, m, l = rng.integers(1, 4), rng.integers(1, 3), seed % 2
    model = random_model(rng, n, m, l)
    u = rng.normal(size=(steps, l)) if l else None
    z = np.stack([simulate(model, steps, rng, u).z for _ in range(3)], axis=-1)
    together = fast.kalman_filter(model, z, u)
    smooth = fast.smooth_runs(together)
    for run in range(3):
        alone = filters.kalman_filter(model, z[..., run], u)
        for name in ("x", "x_pred", "y"):
            close(getattr(together, name)[..., run], getattr(alone, name))
        for name in ("P_pred", "P", "S", "K", "F", "R"):
            close(getattr(together, name), getattr(alone, name))
        alone = filters.rts_smooth(alone)
        close(smooth.x[..., run], alone.x)
        close(smooth.P, alone.P)
    with pytest.raises(ValueError, match="smooth_runs takes the result .*smooth_runs menerima"):
        fast.smooth_runs(fast.kalman_filter(model, z[..., 0], u))


def test_extended_filter_of_many_runs():
    p = beetle.Params(Q_theta=1e-3, Q_v=1e-3, theta0=0.5)
    model = beetle.model(p)
    z = np.stack([beetle.simulate(p, np.random.default_rng(seed)).z for seed in range(5)], axis=-1)
    together = fast.kalman_filter(model, z)
    for run in range(5):
        alone = filters.kalman_filter(model, z[..., run])
        for name in FIELDS:
            ours = getattr(together, name)
            close(ours if name in ("Q", "R", "start") else ours[..., run], getattr(alone, name))


def test_extended_filter_of_many_runs_with_gaps():
    p = beetle.Params(Q_theta=1e-3, Q_v=1e-3, theta0=0.5)
    model = beetle.model(p)
    z = np.stack([beetle.simulate(p, np.random.default_rng(seed)).z for seed in range(4)], axis=-1)
    z[3, 0, 2] = z[5] = np.nan
    together = fast.kalman_filter(model, z)
    for run in range(4):
        alone = filters.kalman_filter(model, z[..., run])
        for name in FIELDS:
            ours = getattr(together, name)
            close(ours if name in ("Q", "R", "start") else ours[..., run], getattr(alone, name))


def test_many_runs_are_checked_for_their_shapes():
    model = beetle.model(beetle.Params())
    z = np.zeros((60, 1, 5))
    wrong = {
        "h": lambda x, u: np.array([x.sum()]),
        "f": lambda x, u: x[:2],
        "H": lambda x, u: [[1, 0]],
        "F": lambda x, u: [[1, 0, np.zeros(4)], [0, 1, 0], [0, 0, 1]],
    }
    for name, function in wrong.items():
        with pytest.raises(ValueError, match=rf"{name}\(x, u\).* has shape .* berukuran"):
            fast.kalman_filter(replace(model, **{name: function}), z)
