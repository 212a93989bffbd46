"""Results are values: nobody changes them, neither the reader nor his data."""

import copy
import pickle
from dataclasses import FrozenInstanceError, fields, replace

import numpy as np
import pytest
from checks_helpers import ONE

from kalman_lib import (
    kalman_filter,
    rts_smooth,
    smooth_runs,
)


@pytest.mark.parametrize("T", [10, 49, 50, 60, 3000])
@pytest.mark.parametrize("runs", [None, 3])
def test_a_result_never_changes_when_its_input_does(T, runs):
    z = np.ones((T, 1) if runs is None else (T, 1, runs))
    u = np.ones((T, 1))
    result, same = kalman_filter(ONE, z, u), kalman_filter(ONE, z.copy(), u.copy())
    z[:], u[:] = 0, 7
    for field in fields(result):
        assert np.array_equal(getattr(result, field.name), getattr(same, field.name)), field.name


@pytest.mark.parametrize(
    "z", [np.ones(20), np.ones(60), np.ones((60, 1, 3)), np.ones(3000)], ids=len
)
def test_the_arrays_of_a_result_are_read_only(z):
    result = kalman_filter(ONE, z)
    smooth = (rts_smooth if z.ndim == 1 else smooth_runs)(result)
    for values in (result, smooth):
        for field in fields(values):
            with pytest.raises(ValueError, match="read-only"):
                array = getattr(values, field.name)
                array *= 57.3
            with pytest.raises((FrozenInstanceError, AttributeError)):
                setattr(values, field.name, 0)


def test_the_data_of_many_runs_stay_the_readers():
    z = np.ma.masked_array(np.ones((60, 1, 3)), np.zeros((60, 1, 3)))
    z[4, 0, 1] = np.ma.masked
    before = z.data.copy()
    kalman_filter(ONE, z)
    assert np.array_equal(z.data, before)


def test_the_data_of_the_reader_stay_his():
    z = np.ones(60)
    kalman_filter(ONE, z)
    z[0] = 5
    assert z.flags.writeable and z[0] == 5


@pytest.mark.parametrize("T", [1, 2, 60])
def test_results_of_many_runs_can_be_pickled_replaced_and_smoothed(T):
    z = np.random.default_rng(0).normal(size=(T, 1, 4))
    result = kalman_filter(ONE, z)
    expected = smooth_runs(result)
    assert expected.P.shape == (T, 1, 1) and expected.x.shape == (T, 1, 4)
    for other in (pickle.loads(pickle.dumps(result)), replace(result, gated=None)):
        smooth = smooth_runs(other)
        np.testing.assert_allclose(smooth.x, expected.x, rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(smooth.P, expected.P, rtol=1e-12)


def test_copies_are_read_only_too():
    for result in (kalman_filter(ONE, np.ones(10)), kalman_filter(ONE, np.arange(90.0) % 7)):
        for twin in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), copy.copy(result)):
            for field in fields(twin):
                assert not getattr(twin, field.name).flags.writeable, field.name
