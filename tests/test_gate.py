"""The gate, and NIS and NEES with silent sensors and many runs."""

import warnings

import numpy as np
import pytest
from checks_helpers import NAN, ONE

from kalman_lib import (
    LinearModel,
    degrees_of_freedom,
    fast,
    filters,
    kalman_filter,
    nees,
    nis,
    rts_smooth,
)
from kalman_lib.papers import beetle


def test_a_sensor_that_never_speaks_is_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for z in (np.full(60, NAN), np.full((60, 1, 2), NAN)):
            assert np.array_equal(kalman_filter(ONE, z).x, np.zeros((60, 1, *z.shape[2:])))


def test_the_gate_leaves_out_what_is_too_far():
    rng = np.random.default_rng(2)
    z = rng.normal(size=(200, 2)) * [1, 2]
    outliers = rng.random(z.shape) < 0.05
    z[outliers] += 60
    model = LinearModel(1, [[1], [1]], 1e-4, np.diag([1, 4]), 0, 1)
    result = kalman_filter(model, z, gate=0.9999)
    assert result.gated.shape == (200, 2) and np.array_equal(result.gated, outliers)
    without = kalman_filter(model, np.where(outliers, NAN, z))
    np.testing.assert_allclose(result.x, without.x, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(rts_smooth(result).x, rts_smooth(without).x, rtol=1e-12, atol=1e-14)
    assert np.array_equal(np.isnan(result.y), outliers) and not without.gated.any()


def test_the_gate_is_the_quantile_of_chi_square():
    """S = 2 in the first step: 3.29 standard deviations are the 0.999 quantile."""
    model = LinearModel(1, 1, 0, 1, 0, 1)
    for z, gated in ((3.29 * 2**0.5, False), (3.30 * 2**0.5, True)):
        assert kalman_filter(model, [z], gate=0.999).gated[0, 0] == gated


def test_NIS_counts_the_sensors_that_were_heard():
    rng = np.random.default_rng(3)
    y = rng.normal(size=(6, 3))
    y[1, 0] = y[2, :2] = y[3] = NAN
    A = rng.normal(size=(6, 3, 3))
    S = A @ A.swapaxes(1, 2) + np.eye(3)
    assert degrees_of_freedom(y).tolist() == [3, 2, 1, 0, 3, 3]
    values = nis(y, S)
    for k in (0, 1, 2, 4):
        heard = np.isfinite(y[k])
        part = S[k][np.ix_(heard, heard)]
        assert values[k] == pytest.approx(y[k, heard] @ np.linalg.inv(part) @ y[k, heard])
    assert np.isnan(values[3])


def test_nees_and_nis_of_many_extended_runs():
    p = beetle.Params()
    walks = [beetle.simulate(p, np.random.default_rng(seed)) for seed in range(3)]
    z = np.stack([walk.z for walk in walks], axis=-1)
    together = kalman_filter(beetle.model(p), z)
    truth = np.stack([walk.x for walk in walks], axis=-1)
    for run, walk in enumerate(walks):
        alone = kalman_filter(beetle.model(p), walk.z)
        ours, expected = nees(truth, together.x, together.P), nees(walk.x, alone.x, alone.P)
        np.testing.assert_allclose(ours[:, run], expected, rtol=1e-8)
        ours, expected = nis(together.y, together.S), nis(alone.y, alone.S)
        np.testing.assert_allclose(ours[:, run], expected, rtol=1e-9)


def test_the_readable_and_the_fast_filter_say_the_same_of_a_gap():
    z = np.ones(60)
    z[[0, 7, 59]] = NAN
    for package in (filters, fast):
        result = package.kalman_filter(ONE, z)
        assert np.isnan(result.y[[0, 7, 59]]).all() and (result.K[[0, 7, 59]] == 0).all()
        assert np.array_equal(result.x[7], result.x_pred[7])
