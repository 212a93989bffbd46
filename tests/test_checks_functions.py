"""What the functions of a model may return, and how a filter that goes astray says so."""

from dataclasses import replace

import numpy as np
import pytest
from checks_helpers import NAN, ONE, one_sentence_in_each_language

from kalman_lib import (
    LinearModel,
    NonlinearModel,
    kalman_filter,
    simulate,
)


def battery(**changes):
    """State of charge and a polarisation voltage; the terminal voltage sees the current u."""

    def ocv(soc):
        return 3.2 + 0.8 * soc + 0.1 * soc**2

    parts = dict(
        f=lambda x, u: np.array([x[0] - u[0] / 3600, 0.9 * x[1] + 0.01 * u[0]]),
        F=lambda x, u: np.array([[1, 0], [0, 0.9]]),
        h=lambda x, u: ocv(x[0]) - x[1] - 0.05 * u[0],
        H=lambda x, u: [0.8 + 0.2 * x[0], -1],
        Q=np.diag([1e-9, 1e-8]),
        R=1e-4,
        x0=[0.5, 0],
        P0=np.diag([0.1, 1e-4]),
    )
    return NonlinearModel(**{**parts, **changes})


def test_h_sees_the_input():
    """The EKF against the same steps written out."""
    model, rng = battery(), np.random.default_rng(1)
    u = rng.uniform(0, 5, size=(200, 1))
    run = simulate(model, 200, rng, u, x0=[0.9, 0])
    result = kalman_filter(model, run.z, u)
    x, P = model.x0, np.array(model.P0)
    for k in range(200):
        F, H = model.F(x, u[k]), np.atleast_2d(model.H(model.f(x, u[k]), u[k]))
        x, P = model.f(x, u[k]), F @ P @ F.T + model.Q
        K = P @ H.T / (H @ P @ H.T + model.R)
        x, P = x + K @ (run.z[k] - model.h(x, u[k])), P - K @ H @ P
        np.testing.assert_allclose(result.x[k], x, rtol=1e-9)
    assert abs(result.x[-1, 0] - run.x[-1, 0]) < 0.05


@pytest.mark.parametrize(
    "name, function, words",
    [
        ("h", lambda x, u: NAN if u[0] > 4 else x[0], r"h\(x, u\)\[0\] is nan at step 3"),
        ("f", lambda x, u: x * (np.inf if u[0] > 4 else 1), r"f\(x, u\)\[0\] is inf at step 3"),
        (
            "F",
            lambda x, u: np.eye(2) * (NAN if u[0] > 4 else 1),
            r"F\(x, u\)\[0, 0\] is nan at step 3",
        ),
        ("H", lambda x, u: [1, NAN if u[0] > 4 else 0], r"H\(x, u\)\[0, 1\] is nan at step 3"),
        ("h", lambda x, u: "3", "holds text"),
        ("F", lambda x, u: np.eye(3), r"has shape \(3, 3\), expected \(2, 2\)"),
    ],
)
def test_the_first_number_that_is_not_finite_stops_the_filter(name, function, words):
    u = np.array([1.0, 2, 3, 5, 6])
    with pytest.raises(ValueError, match=words) as error:
        kalman_filter(battery(**{name: function}), np.full(5, 3.5), u)
    one_sentence_in_each_language(error)


def test_a_filter_that_diverges_says_at_which_step():
    """A wrong sign in F: the covariance grows without end."""
    model = battery(
        f=lambda x, u: 1e30 * x,
        F=lambda x, u: -1e30 * np.eye(2),
        h=lambda x, u: x[0] * 0,
        H=lambda x, u: [0, 0],
    )
    with (
        np.errstate(all="ignore"),
        pytest.raises(ValueError, match=r"at step \d+ .*langkah \d+") as error,
    ):
        kalman_filter(model, np.zeros(30), np.ones(30))
    one_sentence_in_each_language(error)


@pytest.mark.parametrize(
    "residual, words",
    [
        (lambda z, z_pred: (z - z_pred) * NAN, r"residual\(z, z_pred\)\[0\] is nan at step 0"),
        (lambda z, z_pred: np.zeros(3), r"has shape \(3,\)"),
        (None, "residual must be a function"),
    ],
)
def test_a_residual_that_is_no_number_is_refused(residual, words):
    with pytest.raises(ValueError, match=words) as error:
        kalman_filter(replace(ONE, residual=residual), [1, 2])
    one_sentence_in_each_language(error)


@pytest.mark.parametrize(
    "change, words",
    [
        (dict(h=lambda x, u: np.where(x > 0.6, NAN, x)), r"h\(x, u\)\[0\] is nan at step"),
        (dict(), r"z\[1\] is .*inf"),
    ],
)
def test_many_extended_runs_hide_nothing(change, words):
    parts = dict(
        f=lambda x, u: x,
        F=lambda x, u: [[1]],
        h=lambda x, u: x,
        H=lambda x, u: [1],
        Q=1,
        R=1,
        x0=0,
        P0=1,
    )
    z = np.ones((20, 1, 2))
    if not change:
        z[1, 0, 0] = np.inf
    with pytest.raises(ValueError, match=words):
        kalman_filter(NonlinearModel(**{**parts, **change}, many_runs=True), z)


def test_functions_that_work_in_place_change_no_result():
    def f(x, u):
        x[0] = x[0] + 1
        return x

    model = NonlinearModel(
        f, lambda x, u: [[1]], lambda x, u: x, lambda x, u: [1], 0.1, 1, 0, 1, many_runs=True
    )
    z = np.ones((6, 1, 2))
    single = kalman_filter(model, z[:, :, 0])
    assert np.allclose(kalman_filter(model, z).x[..., 0], single.x, rtol=1e-12)
    expected = kalman_filter(replace(model, f=lambda x, u: x + 1), z[:, :, 0])
    assert np.array_equal(single.x, expected.x)


@pytest.mark.parametrize("z", [np.zeros(1200), np.zeros((1200, 1, 2))], ids=["one", "many"])
def test_a_linear_model_that_overflows_says_at_which_step(z):
    with (
        np.errstate(all="ignore"),
        pytest.raises(ValueError, match=r"no longer finite at step \d+") as error,
    ):
        kalman_filter(LinearModel(4, 0, 1, 1, 1, 1), z)
    one_sentence_in_each_language(error)
