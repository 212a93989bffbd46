"""The fast forms where rounding is in the way: there they are the loop, or are not chosen."""

from dataclasses import replace

import numpy as np
import pytest
from fast_helpers import random_model, same_filter, same_smoother

from kalman_lib import LinearModel, fast
from kalman_lib.fast.lazy import LazyFilterResult, LazySmootherResult

# --- adversaries ----------------------------------------------------------------------------------


FAMILIES = [
    "plain",
    "vague start",
    "offset data",
    "slow modes",
    "Q = 0",
    "tiny R",
    "singular P0",
    "constant velocity",
]


def adversary(family, rng):
    """A model that costs digits, and how far its data lie from zero."""
    n, m = int(rng.integers(1, 5)), int(rng.integers(1, 3))
    model = random_model(rng, n, min(n, m), radius=1)
    changes, offset = {}, 0.0
    if rng.random() < 0.7:
        changes["R"] = np.diag(np.diag(model.R))
    if family == "vague start":
        changes["P0"] = model.P0 * 10 ** rng.uniform(4, 18)
    elif family == "offset data":
        offset = 10 ** rng.uniform(2, 8)
    elif family == "slow modes":
        changes["F"] = np.eye(n) + 0.01 * np.triu(rng.normal(size=(n, n)), 1)
        changes["Q"] = model.Q * 10 ** rng.uniform(-14, -2)
    elif family == "Q = 0":
        changes["Q"] = np.zeros((n, n))
    elif family == "tiny R":
        changes["R"] = model.R * 10 ** rng.uniform(-18, -4)
    elif family == "singular P0":
        a = rng.normal(size=(n, 1))
        changes["P0"] = a @ a.T
    elif family == "constant velocity":
        dt, q = 10 ** rng.uniform(-2, 0.5), 10 ** rng.uniform(-8, 0)
        Q = q * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]])
        offset = 10 ** rng.uniform(0, 6)
        P0 = 10 ** rng.uniform(-2, 8) * np.eye(2)
        return LinearModel([[1, dt], [0, 1]], [1, 0], Q, 1, [0, 0], P0), offset
    return replace(model, **changes), offset


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", range(8))
def test_adversaries(family, seed):
    """Wherever a fast form is chosen it is the loop to 1e-12; elsewhere it is not chosen."""
    rng = np.random.default_rng(1000 * FAMILIES.index(family) + seed)
    model, offset = adversary(family, rng)
    steps = int(rng.choice([50, 200, 600, 2600], p=[0.3, 0.3, 0.3, 0.1]))
    z = offset + rng.normal(size=(steps, len(model.H))) * np.sqrt(np.diag(model.R))
    if seed % 2:
        z += 0.1 * np.cumsum(rng.normal(size=z.shape), axis=0)
    if seed % 4 > 1:
        z[rng.random(z.shape) < 0.1] = np.nan
        z[: rng.integers(5)] = np.nan
    same_smoother(*same_filter(model, z))


def test_fast_forms_are_chosen_where_they_are_right():
    """A test that compares the loop with itself would say nothing."""

    def is_fast(model, z):
        result = fast.kalman_filter(model, z)
        smooth = fast.rts_smooth(result)
        return isinstance(result, LazyFilterResult) and isinstance(smooth, LazySmootherResult)

    two = LinearModel([[1, 0.1], [0, 1]], [1, 0], np.diag([1e-3, 1e-2]), 1, [0, 0], np.eye(2))
    z = np.random.default_rng(0).normal(size=3000)
    assert is_fast(LinearModel(1, 1, 0.01, 1, 0, 1e9), z[:60]) and is_fast(two, z)
    assert is_fast(two, np.where(np.arange(3000) % 7 == 0, np.nan, z))
    vague = fast.kalman_filter(replace(two, P0=1e6 * np.eye(2)), z)
    assert isinstance(vague, LazyFilterResult)  # the loop has done the first steps
    assert not is_fast(two, 1e7 + z) and not is_fast(replace(two, Q=np.zeros((2, 2))), z)


@pytest.mark.parametrize("K", [3e-7, 1e-6, 3e-6])
def test_a_slow_filter_far_from_zero_keeps_all_digits(K):
    """1 - K has lost digits of so small a K, and many steps would add up what is missing."""
    rng, Q = np.random.default_rng(8), K**2 / (1 - K)
    model = LinearModel(F=1, H=1, Q=Q, R=1, x0=1e6, P0=K, B=1)
    z, u = 1e6 + rng.normal(size=(5000, 1, 2)), 1e-6 * rng.normal(size=5000)
    together = fast.kalman_filter(model, z, u)
    for run in range(2):
        x = 1e6
        for k in range(5000):  # K is the same in every step
            x += u[k]
            x += K * (z[k, 0, run] - x)
        assert together.K[-1, 0, 0] == pytest.approx(K, rel=1e-9)
        assert abs(together.x[-1, 0, run] - x) < 1e-12 * x
        assert abs(fast.kalman_filter(model, z[..., run], u).x[-1, 0] - x) < 1e-12 * x
