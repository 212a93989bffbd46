"""A bad model gets one clear error that names the matrix, its shape and the shape expected."""

import numpy as np
import pytest

from kalman_lib import LinearModel, NonlinearModel, kalman_filter, update
from kalman_lib.simulate import simulate

GOOD = dict(F=[[1, 1], [0, 1]], H=[[1, 0]], Q=np.eye(2), R=[[1]], x0=[0, 0], P0=np.eye(2))


@pytest.mark.parametrize(
    "change, words",
    [
        (dict(F=np.eye(3)), ["F", "(3, 3)", "(2, 2)"]),
        (dict(F=[[1, 1, 1], [0, 1, 1]]), ["F", "(2, 3)", "(2, 2)"]),
        (dict(H=[[1, 0, 0]]), ["H", "(1, 3)", "(m, 2)"]),
        (dict(H=[[1], [0]]), ["H", "(2, 1)", "(m, 2)"]),
        (dict(x0=[[0], [0]]), ["x0", "(2, 1)", "(2,)"]),
        (dict(Q=[[1]]), ["Q", "(1, 1)", "(2, 2)"]),
        (dict(R=np.eye(2)), ["R", "(2, 2)", "(1, 1)"]),
        (dict(P0=np.eye(3)), ["P0", "(3, 3)", "(2, 2)"]),
        (dict(B=[0, 1]), ["B", "(1, 2)", "(2, l)"]),
        (dict(Q=[[1, 0.5], [0, 1]]), ["Q", "(2, 2)", "symmetric", "simetris"]),
        (dict(P0=[[1, 0.5], [0, 1]]), ["P0", "(2, 2)", "symmetric"]),
        (
            dict(Q=[[1, 2], [2, 1]]),
            ["Q", "(2, 2)", "positive semi-definite", "semidefinit positif"],
        ),
        (dict(Q=[[-1, 0], [0, 1]]), ["Q", "positive semi-definite"]),
        (dict(Q=[[0, 1], [1, 0]]), ["Q", "positive semi-definite"]),
        (dict(R=[[0]]), ["R", "(1, 1)", "positive definite", "definit positif"]),
        (dict(R=[[-1]]), ["R", "positive definite"]),
        (dict(R=np.array([[[1.0]], [[0.0]]])), ["R", "positive definite"]),
        (dict(F=[[np.nan, 1], [0, 1]]), ["F", "(2, 2)", "NaN"]),
        (dict(P0=[[np.inf, 0], [0, 1]]), ["P0", "(2, 2)", "NaN or infinity"]),
        (dict(Q=[["a", 0], [0, 1]]), ["Q", "numbers", "bilangan"]),
        (dict(F=[[1, 1], [0]]), ["F", "numbers"]),
    ],
)
def test_bad_model(change, words):
    with pytest.raises(ValueError) as error:
        LinearModel(**{**GOOD, **change})
    for word in words:
        assert word in str(error.value)


def test_mixed_units_and_zero_noise_are_no_error():
    LinearModel(**{**GOOD, "Q": np.zeros((2, 2)), "P0": np.diag([1e-30, 1e12])})
    P = np.diag([1e-12, 1e12]) + np.array([[0, 0.9], [0.9, 0]])  # correlation 0.9
    LinearModel(**{**GOOD, "Q": P, "P0": P})
    with pytest.raises(ValueError):
        LinearModel(**{**GOOD, "Q": np.diag([1e-12, 1e12]) + np.array([[0, 1.1], [1.1, 0]])})


@pytest.mark.parametrize(
    "z, words",
    [
        (np.zeros((5, 2)), ["z", "(5, 2)", "(T, 1)"]),
        (np.zeros((0, 1)), ["z", "(0, 1)"]),
        ([[1], [np.inf]], ["z[1]", "finite"]),
        (["a", "b"], ["z", "numbers"]),
    ],
)
def test_bad_measurements(z, words):
    with pytest.raises(ValueError) as error:
        kalman_filter(LinearModel(**GOOD), z)
    for word in words:
        assert word in str(error.value)


@pytest.mark.parametrize(
    "u, words",
    [
        (np.zeros((2, 2)), ["u", "(2,)", "(1,)"]),
        (np.zeros((3, 1)), ["u", "(3, 1)", "(2, l)"]),
        ([0, np.nan], ["u[1]", "finite"]),
    ],
)
def test_bad_inputs(u, words):
    with pytest.raises(ValueError) as error:
        kalman_filter(LinearModel(**GOOD, B=[[0], [1]]), [1, 2], u)
    for word in words:
        assert word in str(error.value)


def test_update_by_hand_refuses_what_it_cannot_use():
    model = LinearModel(**GOOD)
    with pytest.raises(ValueError, match=r"z has shape \(2,\), expected \(1,\)"):
        update(model, model.x0, model.P0, np.zeros(2))
    with pytest.raises(ValueError, match="z is .*inf.* finite"):
        update(model, model.x0, model.P0, np.array([np.inf]))
    with pytest.raises(ValueError, match="step 3: .* 3 steps only, 0 to 2"):
        update(
            LinearModel(**{**GOOD, "R": np.ones((3, 1, 1))}), model.x0, model.P0, np.zeros(1), k=3
        )


def test_simulation_refuses_inputs_and_noise_of_another_length():
    with pytest.raises(ValueError, match=r"u has shape \(3, 1\), expected \(2, l\)"):
        simulate(LinearModel(**GOOD, B=[[0], [1]]), 2, np.random.default_rng(0), u=[1, 2, 3])
    with pytest.raises(ValueError, match=r"R has shape \(3, 1, 1\), expected \(2, 1, 1\)"):
        simulate(LinearModel(**{**GOOD, "R": np.ones((3, 1, 1))}), 2, np.random.default_rng(0))


def test_input_without_B():
    with pytest.raises(ValueError, match="no B"):
        kalman_filter(LinearModel(**GOOD), [1, 2], u=[1, 2])


def test_R_in_time_must_be_as_long_as_z():
    with pytest.raises(ValueError, match=r"R has shape \(3, 1, 1\), expected \(2, 1, 1\)"):
        kalman_filter(LinearModel(**{**GOOD, "R": np.ones((3, 1, 1))}), [1, 2])


def test_nonlinear_functions_are_checked():
    good = dict(
        f=lambda x, u: x,
        F=lambda x, u: np.eye(2),
        h=lambda x, u: x[:1],
        H=lambda x, u: np.array([[1, 0]]),
        Q=np.eye(2),
        R=[[1]],
        x0=[0, 0],
        P0=np.eye(2),
    )
    with pytest.raises(ValueError, match=r"H\(x, u\) has shape \(3,\), expected \(1, 2\)"):
        NonlinearModel(**{**good, "H": lambda x, u: np.array([1, 0, 0])})
    with pytest.raises(ValueError, match=r"h\(x, u\) has shape \(2,\), expected \(1,\)"):
        NonlinearModel(**{**good, "h": lambda x, u: x})
    with pytest.raises(ValueError, match=r"h must take two arguments, h\(x, u\).* / .*dua argumen"):
        NonlinearModel(**{**good, "h": lambda: 0})
    flat = kalman_filter(NonlinearModel(**{**good, "H": lambda x, u: np.array([1, 0])}), [1.0])
    assert np.array_equal(flat.x, kalman_filter(NonlinearModel(**good), [1.0]).x)
    alone = kalman_filter(
        NonlinearModel(**{**good, "h": lambda x: x[:1], "H": lambda x: [1, 0]}), [1.0]
    )
    assert np.array_equal(alone.x, flat.x)
    with pytest.raises(ValueError, match=r"F\(x, u\) has shape \(1, 2\), expected \(2, 2\)"):
        kalman_filter(NonlinearModel(**{**good, "F": lambda x, u: np.array([[1, 0]])}), [1.0])


def test_a_model_cannot_be_changed_by_accident():
    Q = np.eye(2)
    model = LinearModel(**{**GOOD, "Q": Q})
    Q[0, 0] = 5
    assert model.Q[0, 0] == 1
    with pytest.raises(ValueError):
        model.Q[0, 0] = 5
