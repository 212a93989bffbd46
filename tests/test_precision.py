"""Models on which ordinary filters lose their digits, against one with 150 digits.

Families: states that decay without noise, constants, known states, exact copies, a bias, undriven
oscillators, a vague start, tiny R, redundant sensors, gaps at either end. Readable and fast forms,
filter and smoother. Long series are compared with statsmodels.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from high_precision import filter_and_smooth
from precision_helpers import I2, ZERO2, data, in_sigmas, is_covariance, relative, with_statsmodels

from kalman_lib import (
    LinearModel,
    NonlinearModel,
    fast,
    filters,
    kalman_filter,
    rts_smooth,
    smooth_runs,
)
from kalman_lib.tuning import log_likelihood


def oscillator(angle, damping=1.0):
    c, s = np.cos(angle), np.sin(angle)
    return damping * np.array([[c, s], [-s, c]])


def block(*parts):
    """The block-diagonal matrix of the parts."""
    n = sum(len(part) for part in parts)
    M, i = np.zeros((n, n)), 0
    for part in parts:
        M[i : i + len(part), i : i + len(part)] = part
        i += len(part)
    return M


COPY = np.outer([1, 1, 0], [1, 1, 0])


SMOOTH = {  # name -> model; T steps
    "decays slowly": (
        LinearModel(np.diag([0.9, 1]), [1, 1], np.diag([0, 0.01]), 1, [0, 0], I2),
        600,
    ),
    "decays fast": (LinearModel(np.diag([0.2, 1]), [1, 1], np.diag([0, 0.01]), 1, [0, 0], I2), 500),
    "decays, coupled": (
        LinearModel([[0.5, 0.3], [0, 1]], [1, 0], np.diag([0, 0.1]), 1, [1, 0], I2),
        400,
    ),
    "a constant": (LinearModel(1, 1, 0, 1, 0, 1e6), 800),
    "two constants": (LinearModel(I2, [[1, 0], [1, 1]], ZERO2, I2, [0, 0], 100 * I2), 300),
    "a known state": (LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1, [0, 1], ZERO2), 100),
    "one known, one not": (
        LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1, [0, 1], np.diag([4, 0])),
        100,
    ),
    "exact copies": (
        LinearModel(
            np.eye(3), [[1, 0, 0], [0, 0, 1]], 0.01 * COPY, I2, [0, 0, 0], COPY + np.diag([0, 0, 9])
        ),
        150,
    ),
    "a bias": (
        LinearModel([[1, -0.1], [0, 1]], [1, 0], np.diag([1e-3, 0]), 1, [0, 0], np.diag([1, 0.1])),
        500,
    ),
    "an undriven oscillator": (
        LinearModel(oscillator(0.3), [1, 0], ZERO2, 1, [0, 0], 10 * I2),
        600,
    ),
    "two oscillators and a walk": (
        LinearModel(
            block(oscillator(0.1), oscillator(0.8, 0.95), [[1.0]]),
            [1, 0, 1, 0, 1],
            np.diag([0, 0, 0, 0, 0.1]),
            1,
            np.zeros(5),
            np.eye(5),
        ),
        200,
    ),
    "eight states": (
        LinearModel(
            block(*(oscillator(a, 0.97) for a in (0.1, 0.4, 0.9, 1.7))),
            np.ones((2, 8)) + np.eye(2, 8),
            np.diag([0, 0, 0, 0, 0, 0, 1.0, 1]),
            I2,
            np.zeros(8),
            np.eye(8),
        ),
        80,
    ),
}


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize("name", SMOOTH)
def test_filter_and_smoother_have_all_their_digits(name, gaps):
    model, T = SMOOTH[name]
    z = data(model, T, gaps)
    exact = filter_and_smooth(model, z)
    for package in (filters, fast):
        result = package.kalman_filter(model, z)
        smooth = package.rts_smooth(result)
        for ours, key in ((result.x, "x"), (result.x_pred, "x_pred"), (smooth.x, "x_s")):
            assert relative(ours, exact[key]) < 1e-9, (package, key)
        for ours, key in ((result.P, "P"), (result.P_pred, "P_pred"), (smooth.P, "P_s")):
            assert in_sigmas(ours, exact[key]) < 1e-9, (package, key)
    assert log_likelihood(result) == pytest.approx(exact["likelihood"], rel=1e-9)
    many = kalman_filter(model, np.stack([z, -z], axis=-1))
    assert relative(smooth_runs(many).x[..., 0], exact["x_s"]) < 1e-9


@pytest.mark.parametrize(
    "a, T, largest", [(0.9, 1000, 0.414), (0.9, 3000, 0.535), (0.2, 500, 0.378), (0.9, 8000, 0.535)]
)
def test_a_state_that_decays_without_noise_is_smoothed(a, T, largest):
    """Largest values by statsmodels with tolerance 0."""
    z = np.random.default_rng(0).normal(size=8000)[:T]
    model = LinearModel(
        F=np.diag([a, 1]), H=[[1, 1]], Q=np.diag([0, 0.01]), R=1, x0=[0, 0], P0=np.eye(2)
    )
    smooth = rts_smooth(kalman_filter(model, z))
    assert abs(smooth.x).max() == pytest.approx(largest, abs=5e-4)
    assert relative(smooth.x, with_statsmodels(model, z[:, np.newaxis]).smoothed_state.T) < 1e-9


@pytest.mark.parametrize(
    "name", ["a constant", "a bias", "an undriven oscillator", "decays slowly"]
)
def test_ten_thousand_steps_against_statsmodels(name):
    model = SMOOTH[name][0]
    model = replace(model, P0=np.eye(len(model.x0)))  # a vaguer start costs statsmodels digits
    z = data(model, 10_000, False)
    result = kalman_filter(model, z)
    theirs = with_statsmodels(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9


def test_a_constant_that_is_measured_ten_thousand_times_is_the_mean():
    z = data(SMOOTH["a constant"][0], 10_000, False)[:, 0]
    smooth = rts_smooth(kalman_filter(LinearModel(1, 1, 0, 1, 0, 1e6), z))
    assert smooth.x[:, 0] == pytest.approx(math.fsum(z) / (len(z) + 1e-6), rel=1e-12)
    assert smooth.P[:, 0, 0] == pytest.approx(1 / (len(z) + 1e-6), rel=1e-12)


# --- many runs of a nonlinear model, likelihoods --------------------------------------------------


@pytest.mark.parametrize(
    "F, H, Q, R, P0",
    [
        ([[1, 1], [0, 1]], [1, 0], 0, 1e-6, 1e10 * I2),
        ([[1, 1], [0, 1]], [1, 0], 1e-3, 1, 1e14 * I2),
        ([[1, 0], [0, 1]], [1, 1], 0, 1e-16, np.ones((2, 2))),
        ([[1, 0], [0, 1]], [1, 0], 0, 1e-18, np.outer([0.3, 0.7], [0.3, 0.7])),
        ([[1, 0.1], [0, 0.9]], [1, 0], 0.01, 1, I2),
    ],
)
def test_many_extended_runs_are_the_loop(F, H, Q, R, P0):
    F = np.array(F)

    def h(x, u):
        return np.dot(H, x)[np.newaxis]

    model = NonlinearModel(
        lambda x, u: F @ x, lambda x, u: F, h, lambda x, u: H, Q * I2, R, [0, 0], P0, many_runs=True
    )
    z = np.random.default_rng(2).normal(size=(60, 1, 3))
    z[7, 0, 1] = np.nan
    together = kalman_filter(model, z)
    for run in range(3):
        exact = filter_and_smooth(LinearModel(F, H, Q * I2, R, [0, 0], P0), z[:, :, run])
        assert relative(together.x[..., run], exact["x"]) < 1e-9
        is_covariance(together.P[..., run])


def test_the_likelihood_of_redundant_sensors():
    """Many runs, a third sensor that tells nothing, a vague state beside a well known one."""
    z = np.array([[5.0, 7], [4, 5], [6, 7]])
    for p in (1e10, 1e12, 1e16):
        model = LinearModel(1, [[1], [1]], 1, I2, 0, p)
        exact = filter_and_smooth(model, z)["likelihood"]
        many = kalman_filter(model, np.stack([z, z], axis=-1))
        assert log_likelihood(many) == pytest.approx([exact, exact], rel=1e-10)
        three = LinearModel(1, [[1], [1], [1]], 1, np.diag([1, 1, np.inf]), 0, p)
        found = log_likelihood(kalman_filter(three, np.c_[z, z[:, 0]]))
        assert found == pytest.approx(exact, rel=1e-10)
        mixed = LinearModel(
            [[1, 0], [1, 1]], [[1, -1], [1, 0], [1, 0]], ZERO2, np.eye(3), [0, 0], np.diag([p, 1])
        )
        exact = filter_and_smooth(mixed, [[0.0, 3, 4]])["likelihood"]
        found = log_likelihood(kalman_filter(mixed, [[0.0, 3, 4]]))
        assert found == pytest.approx(exact, rel=1e-10)


def test_an_input_that_the_data_contradict_keeps_its_digits():
    model = LinearModel(1, 1, 1, 1e-12, 0, 1, B=1)
    rng = np.random.default_rng(0)
    u, z = 1e9 * rng.choice([-1, 1], size=600), rng.normal(size=600)
    assert relative(kalman_filter(model, z, u).x, filters.kalman_filter(model, z, u).x) < 1e-12
