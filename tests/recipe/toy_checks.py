"""The toy paper: a bottle that is filled, against the equations by hand."""

import numpy as np
import pytest

from kalman_lib import kalman_filter
from kalman_lib.papers import toy


def test_the_first_step_by_hand():
    p = toy.Params()
    result = kalman_filter(toy.model(p), [0.1], [p.flow])
    P_pred = 0.01 + 0.01**2
    K = P_pred / (P_pred + 0.05**2)
    assert result.x[0, 0] == pytest.approx(0.02 + K * (0.1 - 0.02), rel=1e-12)
    assert result.P[0, 0, 0] == pytest.approx((1 - K) * P_pred, rel=1e-12)


def test_the_bottle_is_filled():
    run = toy.simulate(toy.Params(), np.random.default_rng(0))
    assert run.x[-1, 0] == pytest.approx(60 * 0.02, abs=4 * 0.01 * np.sqrt(60))
