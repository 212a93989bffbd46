"""The fast forms keep the contract of the loop: its errors, its fields, and little memory."""

import pickle
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from fast_helpers import FIELDS

from kalman_lib import LinearModel, NonlinearModel, fast, filters
from kalman_lib.papers import gyro

# --- the same contract ----------------------------------------------------------------------------


def test_the_same_errors_as_the_loop():
    model = LinearModel(
        F=np.eye(2), H=[[1, 0]], Q=np.eye(2), R=1, x0=[0, 0], P0=np.eye(2), B=[[1], [0]]
    )
    no_input = replace(model, B=None)
    in_time = replace(model, R=np.ones((60, 1, 1)))
    z, u = np.zeros(80), np.ones((80, 1))
    wrong = [
        (model, np.zeros((80, 2)), None),
        (model, np.full(80, np.inf), None),
        (model, ["a"] * 80, None),
        (model, z, u[1:]),
        (model, z, np.full(80, np.nan)),
        (model, z, np.ones((80, 2))),
        (no_input, z, u),
        (in_time, z, None),
        (no_input, np.zeros((80, 1, 2)), u),
        (model, np.zeros((80, 1, 2)), np.ones((80, 2))),
    ]
    for case in wrong:
        with pytest.raises(ValueError) as ours:
            fast.kalman_filter(*case)
        with pytest.raises(ValueError) as loop:
            filters.kalman_filter(*case)
        assert str(ours.value) == str(loop.value)


def test_what_has_no_fast_form_is_the_loop():
    rng = np.random.default_rng(7)
    z = 0.1 * rng.normal(size=100)
    model = LinearModel(F=1, H=1, Q=1, R=1, x0=0, P0=1)
    wrapped = replace(model, residual=lambda z, z_pred: (z - z_pred + np.pi) % (2 * np.pi) - np.pi)
    twin = NonlinearModel(
        f=lambda x, u: x,
        F=lambda x, u: np.eye(1),
        h=lambda x, u: x,
        H=lambda x, u: np.eye(1),
        Q=model.Q,
        R=model.R,
        x0=model.x0,
        P0=model.P0,
    )
    for case in (
        (wrapped, z),
        (twin, z),
        (model, z, None, lambda k, y, HPH, R: R * (1 + k)),
        (model, z[:49]),
    ):
        ours, loop = fast.kalman_filter(*case), filters.kalman_filter(*case)
        assert all(np.array_equal(getattr(ours, name), getattr(loop, name)) for name in FIELDS)


def test_a_result_can_be_copied_replaced_and_shown():
    flight = gyro.simulate(gyro.Params(), np.random.default_rng(0))
    result = fast.kalman_filter(gyro.model(gyro.Params()), flight.z, flight.u)
    assert isinstance(result, filters.FilterResult)
    copy, other = pickle.loads(pickle.dumps(result)), replace(result, x=result.x + 1)
    assert all(np.array_equal(getattr(copy, name), getattr(result, name)) for name in FIELDS)
    assert np.array_equal(other.x, result.x + 1) and np.array_equal(other.K, result.K)
    assert np.array_equal(filters.rts_smooth(other).P, filters.rts_smooth(result).P)
    with pytest.raises(AttributeError):
        result.x = 0
    smooth = fast.rts_smooth(result)
    assert np.array_equal(pickle.loads(pickle.dumps(smooth)).P, smooth.P)


def test_a_million_steps_add_at_most_60_MB():
    code = """
import tracemalloc, numpy as np
from kalman_lib import LinearModel, kalman_filter, rts_smooth
model = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1)
z = np.random.default_rng(0).normal(size=1_000_000)
rts_smooth(kalman_filter(model, z[:5000])).x
tracemalloc.start()
result = kalman_filter(model, z)
smooth = rts_smooth(result)
x, P = smooth.x, smooth.P
print(tracemalloc.get_traced_memory()[1] / 1e6)
"""
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    assert float(run.stdout) <= 60
