"""Covariances stay covariances, whatever the rounding: Q = 0, tiny R, a vague start."""

import numpy as np
import pytest
from high_precision import filter_and_smooth
from precision_helpers import I2, ZERO2, data, in_sigmas, is_covariance, relative

from kalman_lib import (
    LinearModel,
    fast,
    filters,
    kalman_filter,
    rts_smooth,
)
from kalman_lib.tuning import log_likelihood


def adversaries(count=150):
    """Models with Q = 0 or singular, R down to 1e-18, a singular or vague P0, redundant sensors."""
    rng = np.random.default_rng(18)
    for i in range(count):
        n, m = int(rng.integers(1, 6)), int(rng.integers(1, 4))
        F = rng.normal(size=(n, n))
        F = F / np.abs(np.linalg.eigvals(F)).max() if i % 3 else np.eye(n)
        a = rng.normal(size=(n, 1))
        P0 = (a @ a.T, np.eye(n), np.diag(10.0 ** rng.uniform(-9, 9, n)), np.ones((n, n)))[i % 4]
        R = np.diag(10.0 ** rng.uniform(-18, 0, m))
        H = rng.normal(size=(1 if i % 5 == 0 else m, n))
        if len(H) < m:
            H = np.repeat(H, m, axis=0)
        Q = np.zeros((n, n)) if i % 2 else 0.1 * a @ a.T
        yield LinearModel(F, H, Q, R, np.zeros(n), P0 * (1e18 * R.min() if i % 7 == 0 else 1))


def test_covariances_of_adversaries():
    for model in adversaries():
        z = np.random.default_rng(1).normal(size=(60, len(model.H)))
        z[5] = np.nan
        for package in (filters, fast):
            result = package.kalman_filter(model, z)
            smooth = package.rts_smooth(result)
            for P in (result.P, result.P_pred, result.S, smooth.P):
                is_covariance(P)


def test_one_update_with_a_tiny_R():
    """P0 = v v' and R -> 0: only rounding could make P[1, 1] negative."""
    v = np.array([0.3, 0.7])
    P = kalman_filter(LinearModel(I2, [1, 0], ZERO2, 1e-18, [0, 0], np.outer(v, v)), [1.0]).P[0]
    is_covariance(P)
    assert P[1, 1] == pytest.approx((0.7 / 0.3) ** 2 * 1e-18, rel=1e-6)
    z = np.ones(60)
    z[5] = np.nan
    copies = LinearModel(I2, [1, 0], ZERO2, 1e-16, [0, 0], np.ones((2, 2)))
    is_covariance(kalman_filter(copies, z).P)


@pytest.mark.parametrize("p", [1e12, 1e15, 1e16, 1e18])
def test_redundant_sensors_with_a_vague_start_give_their_mean(p):
    model = LinearModel(F=1, H=[[1], [1]], Q=1, R=I2, x0=0, P0=p)
    result = kalman_filter(model, [[5.0, 7.0]])
    assert result.x[0, 0] == pytest.approx(6, rel=1e-11)
    assert result.P[0, 0, 0] == pytest.approx(0.5, rel=1e-11)
    exact = filter_and_smooth(model, [[5.0, 7.0]])["likelihood"]
    assert log_likelihood(result) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("P0", [1e6, 1e9, 1e10, 1e12, 1e16])
@pytest.mark.parametrize("gaps", [False, True])
def test_a_vague_start_costs_no_digits(P0, gaps):
    model = LinearModel([[1, 1], [0, 1]], [1, 0], np.diag([1e-3, 1e-3]), 1, [0, 0], P0 * I2)
    for T in (49, 50, 300):
        z = data(model, T, gaps)
        exact = filter_and_smooth(model, z)
        result = kalman_filter(model, z)
        assert relative(result.x, exact["x"]) < 1e-11 and in_sigmas(result.P, exact["P"]) < 1e-11
        smooth = rts_smooth(result)
        assert relative(smooth.x, exact["x_s"]) < 1e-10
        assert in_sigmas(smooth.P, exact["P_s"]) < 1e-10


def test_vague_starts_that_once_broke_the_fast_forms():
    model = LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1e-6, [0, 0], 1e10 * I2)
    for z in (np.zeros(50), np.zeros((50, 1, 3))):
        assert np.array_equal(kalman_filter(model, z).x, np.zeros((50, 2, *z.shape[2:])))
    z = np.zeros(2500)
    z[::50] = np.nan
    flat = LinearModel(I2, [1, 1], ZERO2, 1, [0, 0], 1e15 * I2)
    is_covariance(kalman_filter(flat, z).P)
