"""Sensors that are silent, and matrices that change from step to step, against statsmodels."""

from dataclasses import replace

import numpy as np
import pytest
from high_precision import filter_and_smooth
from precision_helpers import I2, in_sigmas, relative, with_statsmodels

from kalman_lib import (
    LinearModel,
    fast,
    filters,
    kalman_filter,
    nis,
    rts_smooth,
)
from kalman_lib.tuning import log_likelihood

# --- silent sensors, matrices of each step --------------------------------------------------------


def two_rates(T=400):
    """A position at 10 Hz and a speed at 100 Hz."""
    dt = 0.01
    model = LinearModel(
        [[1, dt], [0, 1]], I2, np.diag([0, 0.01]), np.diag([4, 0.09]), [0, 0], np.diag([100, 4])
    )
    z = np.random.default_rng(3).normal(size=(T, 2))
    z[np.arange(T) % 10 > 0, 0] = np.nan
    return model, z


def test_two_sensors_at_two_rates_are_those_of_statsmodels():
    model, z = two_rates()
    theirs = with_statsmodels(model, z)
    for package in (filters, fast):
        result = package.kalman_filter(model, z)
        smooth = package.rts_smooth(result)
        assert relative(result.x, theirs.filtered_state.T) < 1e-9
        assert in_sigmas(result.P, theirs.filtered_state_cov.transpose(2, 0, 1)) < 1e-9
        assert relative(smooth.x, theirs.smoothed_state.T) < 1e-9
        assert log_likelihood(result) == pytest.approx(theirs.llf_obs.sum(), rel=1e-9)
    many = kalman_filter(model, np.stack([z, 2 * z], axis=-1))
    assert relative(many.x[..., 0], result.x) < 1e-12
    assert relative(many.x[..., 1], 2 * result.x) < 1e-12


def test_two_sensors_that_take_turns():
    z = np.full((100, 2), np.nan)
    z[::2, 0] = z[1::2, 1] = 1.0
    model = LinearModel(F=1, H=[[1], [1]], Q=1e-4, R=I2, x0=0, P0=100)
    alone = LinearModel(F=1, H=1, Q=1e-4, R=1, x0=0, P0=100)
    result = kalman_filter(model, z)
    assert result.x[-1, 0] == pytest.approx(kalman_filter(alone, np.ones(100)).x[-1, 0], rel=1e-12)
    assert np.array_equal(np.isnan(result.y), np.isnan(z)) and (result.K[::2, 0, 1] == 0).all()
    assert np.isfinite(nis(result.y, result.S)).all()


def test_correlated_sensors_of_which_one_is_silent():
    """The rest of the row counts with its own part of R."""
    R = np.array([[1, 0.9, 0.2], [0.9, 1, 0.1], [0.2, 0.1, 2]])
    model = LinearModel(I2, [[1, 0], [1, 1], [0, 1]], 0.1 * I2, R, [0, 0], I2)
    z = np.random.default_rng(5).normal(size=(80, 3))
    z[np.random.default_rng(6).random(z.shape) < 0.4] = np.nan
    theirs = with_statsmodels(model, z)
    result = kalman_filter(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9


def test_an_infinite_R_is_a_silent_sensor():
    model, z = two_rates(60)
    R = np.repeat(model.R[np.newaxis], 60, axis=0)
    R[np.isnan(z[:, 0]), 0, 0] = np.inf
    noisy = replace(model, R=R)
    ours, theirs = kalman_filter(noisy, np.nan_to_num(z)), kalman_filter(model, z)
    assert np.array_equal(ours.x, theirs.x) and np.array_equal(ours.P, theirs.P)
    assert np.array_equal(rts_smooth(ours).x, rts_smooth(theirs).x)
    assert log_likelihood(ours) == pytest.approx(log_likelihood(theirs), rel=1e-14)
    blind = replace(model, R=np.diag([4, np.inf]))
    assert np.isnan(kalman_filter(blind, np.zeros((5, 2))).y[:, 1]).all()


def test_matrices_that_change_from_step_to_step_are_those_of_statsmodels():
    rng, T = np.random.default_rng(11), 120
    dt = rng.uniform(0.1, 2, T)
    F = np.array([[[1, h], [0, 1]] for h in dt])
    Q = np.array([0.1 * np.array([[h**3 / 3, h**2 / 2], [h**2 / 2, h]]) for h in dt])
    H = rng.normal(size=(T, 1, 2))
    R = rng.uniform(0.5, 2, T)
    model = LinearModel(F, H, Q, R, [0, 1], I2)
    z = rng.normal(size=(T, 1))
    theirs = with_statsmodels_shifted(model, z)
    result = kalman_filter(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9
    exact = filter_and_smooth(model, z)
    assert relative(rts_smooth(result).x, exact["x_s"]) < 1e-12


def with_statsmodels_shifted(model, z):
    """statsmodels predicts after the update: its transition of step k leads to step k + 1."""
    shifted = replace(
        model,
        F=np.concatenate([model.F[1:], model.F[:1]]),
        Q=np.concatenate([model.Q[1:], model.Q[:1]]),
    )
    return with_statsmodels(shifted, z, first=model)


def test_an_input_matrix_of_each_step():
    B = np.arange(1.0, 4)[:, np.newaxis, np.newaxis]
    result = kalman_filter(LinearModel(1, 1, 0, 1, 0, 0, B=B), np.zeros(3), u=[1, 1, 1])
    assert np.array_equal(result.x[:, 0], [1, 3, 6])


@pytest.mark.parametrize(
    "name, M",
    [
        ("F", np.ones((4, 1, 1))),
        ("H", np.ones((4, 1, 1))),
        ("Q", np.ones(4)),
        ("R", np.ones(4)),
        ("B", np.ones((4, 1, 1))),
    ],
)
def test_a_wrong_number_of_matrices_is_named(name, M):
    model = replace(LinearModel(1, 1, 1, 1, 0, 1, B=1), **{name: M})
    for z in (np.zeros(5), np.zeros(60), np.zeros((60, 1, 2))):
        with pytest.raises(
            ValueError, match=rf"{name} has shape \(4, 1, 1\), expected \({len(z)}, 1, 1\)"
        ):
            kalman_filter(model, z, np.ones(len(z)))
    with pytest.raises(
        ValueError,
        match=r"has shape \(4, 1, 1\), expected \(3, 1, 1\)|has shape \(3, 1, 1\), expected",
    ):
        replace(model, **{("Q" if name != "Q" else "R"): np.ones(3)})
