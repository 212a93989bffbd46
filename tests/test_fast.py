"""The fast forms against the readable loop of filters.py: equal to 1e-12.

Whatever the model, the data and the ratio Q / R.
"""

from fractions import Fraction

import numpy as np
import pytest
from fast_helpers import random_model, same_filter, same_smoother

from kalman_lib import LinearModel, fast
from kalman_lib.simulate import simulate

CASES = [
    (seed, steps)
    for steps, seeds in ((49, 3), (50, 12), (300, 12), (2600, 4))
    for seed in range(seeds)
]


@pytest.mark.parametrize("seed, steps", CASES)
def test_random_models(seed, steps):
    rng = np.random.default_rng(seed)
    n, m, l = 1, 1, seed % 3
    if seed % 4:
        n, m, l = rng.integers(1, 5), rng.integers(1, 4), rng.integers(0, 3)
    model = random_model(rng, n, m, l)
    u = rng.normal(size=(steps, l)) if l else None
    same_smoother(*same_filter(model, simulate(model, steps, rng, u).z, u))


@pytest.mark.parametrize(
    "seed, steps",
    [(seed, steps) for steps, seeds in ((60, 12), (2600, 5)) for seed in range(seeds)],
)
def test_missing_measurements_and_R_that_changes_in_time(seed, steps):
    rng = np.random.default_rng(100 + seed)
    n, m, l = 1, 1, 0
    if seed % 4:
        n, m, l = rng.integers(1, 4), rng.integers(1, 3), rng.integers(0, 3)
    model = random_model(rng, n, m, l, R_in_time=steps if seed % 3 else None)
    u = rng.normal(size=(steps, l)) if l else None
    z = simulate(model, steps, rng, u).z
    if seed % 3 != 1:
        z[rng.random(z.shape) < 0.1] = np.nan
        z[20:30] = z[-3:] = np.nan
    same_smoother(*same_filter(model, z, u))


@pytest.mark.parametrize("exponent", [-30, -20, -10, -3, 3, 10, 20, 30])
@pytest.mark.parametrize("seed", range(6))
def test_extreme_ratios_of_Q_and_R(seed, exponent):
    rng = np.random.default_rng(seed)
    n, steps = 1 + seed // 2, 600 if seed % 2 else 200
    model = random_model(
        rng,
        n,
        int(rng.integers(1, n + 1)),
        Q=10.0 ** (exponent / 2),
        R=10.0 ** (-exponent / 2),
        P0=rng.choice([0, 1, 10.0 ** (exponent / 2)]),
    )
    z = 10 * rng.normal(size=(steps, len(model.H)))
    ours, loop = same_filter(model, z)
    # beyond, the loop's own P has less than 12 digits (see the fractions)
    if n == 1 and exponent < 10:
        same_smoother(ours, loop)
    z[::7] = np.nan
    same_filter(model, z)


@pytest.mark.parametrize(
    "Q, R", [(1e-30, 1), (1, 1e-30), (1e-18, 1), (1, 1e-18), (1e30, 1), (0, 1), (1e-3, 1)]
)
@pytest.mark.parametrize("F, H", [(1, 1), (0.9, 3.7), (1.1, 0.3)])
def test_the_variance_of_one_number_against_exact_fractions(F, H, Q, R):
    """Where R is tiny even Joseph's form has few digits; P_pred R / S has them all."""
    model, steps = LinearModel(F=F, H=H, Q=Q, R=R, x0=0, P0=1), 60
    result = fast.kalman_filter(model, np.ones(steps))
    F, H, Q, R, P = (Fraction(float(value)) for value in (F, H, Q, R, 1))
    for k in range(steps):
        P_pred = F * P * F + Q
        K = P_pred * H / (H * P_pred * H + R)
        P = (1 - K * H) * P_pred
        assert result.P[k, 0, 0] == pytest.approx(float(P), rel=1e-12)
        assert result.K[k, 0, 0] == pytest.approx(float(K), rel=1e-12)
        P = Fraction(round(P * 2**400), 2**400)  # 100 digits are enough


@pytest.mark.parametrize("Q", [0, 1e-12, 1e-6])
@pytest.mark.parametrize("gaps", [False, True])
def test_a_memory_longer_than_any_block(Q, gaps):
    rng = np.random.default_rng(3)
    z = np.cumsum(rng.normal(size=4500)) * 1e-3 + rng.normal(size=4500)
    if gaps:
        z[rng.random(4500) < 0.2] = np.nan
    same_filter(LinearModel(F=1, H=1, Q=Q, R=1, x0=0, P0=1e6), z)
    F = [[1, 0.1], [0, 1]]
    same_filter(LinearModel(F=F, H=[[1, 0]], Q=Q * np.eye(2), R=1, x0=[0, 0], P0=np.eye(2)), z)


@pytest.mark.parametrize(
    "F", [1.5, -1, [[0.999, 0.04], [-0.04, 0.999]], [[1, 1], [0, 1.01]], [[0, 1], [0, 0]]]
)
@pytest.mark.parametrize("P0", [0, 1])
def test_unstable_marginal_and_dead_beat_models(F, P0):
    n = np.size(F[0]) if np.ndim(F) else 1
    rng = np.random.default_rng(4)
    for Q in (0, 1e-2):
        model = LinearModel(
            F=F, H=np.eye(1, n), Q=Q * np.eye(n), R=1, x0=np.ones(n), P0=P0 * np.eye(n)
        )
        same_filter(model, rng.normal(size=300))
        if n > 1 or F == -1:
            same_filter(model, rng.normal(size=2500))
    blind = LinearModel(F=F, H=np.zeros((1, n)), Q=np.eye(n), R=1, x0=np.ones(n), P0=P0 * np.eye(n))
    same_filter(blind, rng.normal(size=200))


def attitude(rng, steps, R_in_time=True, same=True):
    """Three axes of angle and gyroscope bias, which nothing links."""
    dt, scale = 0.01, np.ones(3) if same else np.array([1, 3, 0.2])
    R = 1e-2 * np.eye(3)
    if R_in_time:
        R = 1e-2 * rng.uniform(0.5, 5, size=(steps, 1, 1)) * np.eye(3)
    return LinearModel(
        F=np.kron(np.eye(3), [[1, -dt], [0, 1]]),
        B=np.kron(np.eye(3), [[dt], [0]]),
        H=np.kron(np.eye(3), [[1, 0]]),
        Q=np.kron(np.diag(scale), np.diag([1e-5, 1e-8])),
        R=R,
        x0=np.zeros(6),
        P0=0.01 * np.eye(6),
    )


@pytest.mark.parametrize("R_in_time", [True, False])
@pytest.mark.parametrize("same", [True, False])
@pytest.mark.parametrize("gaps", [True, False])
def test_independent_axes(R_in_time, same, gaps):
    rng = np.random.default_rng(5)
    model = attitude(rng, 3000, R_in_time, same)
    z, u = 0.1 * rng.normal(size=(2, 3000, 3))
    if gaps:
        z[rng.random(3000) < 0.1, 1] = np.nan  # one NaN and no axis has a measurement
    ours, loop = same_filter(model, z, u)
    assert (ours.P[:, :2, 2:] == 0).all()


def test_axes_of_different_size_and_a_state_without_a_sensor():
    rng = np.random.default_rng(6)
    A, B = random_model(rng, 2, 1), random_model(rng, 1, 1)
    F, Q, P0 = (np.zeros((4, 4)) for _ in range(3))
    for name, M in (("F", F), ("Q", Q), ("P0", P0)):
        M[np.ix_([0, 2], [0, 2])], M[1, 1], M[3, 3] = getattr(A, name), getattr(B, name)[0, 0], 0.5
    H = np.zeros((2, 4))
    H[0, [0, 2]], H[1, 1] = A.H[0], B.H[0, 0]
    model = LinearModel(F=F, H=H, Q=Q, R=np.diag([A.R[0, 0], B.R[0, 0]]), x0=np.ones(4), P0=P0)
    for steps in (100, 2500):
        z = rng.normal(size=(steps, 2))
        same_smoother(*same_filter(model, z))
        z[5:9, 0] = np.nan
        same_filter(model, z)
