"""check_jacobians: right ones pass, wrong ones are found and named."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from tuning_helpers import bilingual

from kalman_lib import (
    NonlinearModel,
    check_jacobians,
)
from kalman_lib.papers import beetle

# --- Jacobians ------------------------------------------------------------------------------------


def bearing(wrong=0.0, sign=1):
    """A turning walker [x, y, angle] and the direction in which it is seen, which wraps."""

    def f(x, u):
        return np.array([x[0] + np.cos(x[2]), x[1] + np.sin(x[2]), x[2]]) + (0 if u is None else u)

    def F(x, u):
        return np.array([[1, 0, -sign * np.sin(x[2])], [wrong, 1, np.cos(x[2])], [0, 0, 1]])

    def h(x, *u):
        return np.arctan2(x[1:2], x[:1])

    def H(x, *u):
        r2 = x[0] ** 2 + x[1] ** 2
        return np.array([[-x[1] / r2, x[0] / r2, 0]])

    def residual(z, z_pred):
        return (z - z_pred + np.pi) % (2 * np.pi) - np.pi

    return NonlinearModel(
        f=f, F=F, h=h, H=H, Q=np.eye(3), R=1, x0=[-3, 1, 0.5], P0=np.eye(3), residual=residual
    )


@pytest.mark.parametrize("x", [[-3, 0, 0.5], [-3, 1e-9, 0], [2e6, -1e6, 3], [1e-3, 1e-3, -np.pi]])
def test_right_jacobians_pass(x):
    found = check_jacobians(bearing(), x)
    assert found.F == pytest.approx(bearing().F(x, None), abs=1e-6)
    assert found.F_error.shape == (3, 3) and found.H_error.shape == (1, 3)
    assert found.F_error.max() < 1e-6
    check_jacobians(bearing(), x, u=np.ones(3))


@pytest.mark.parametrize("d", [10, 1e6, 1e-6])
@pytest.mark.parametrize("theta", [0, 1e-3, 0.64, 1.5])
def test_the_beetle_far_away_passes(d, theta):
    p = beetle.Params()
    check_jacobians(beetle.model(p), [d, theta, 2.5])
    check_jacobians(beetle.bearing_model(p), [d, theta, 2.5, 3e-7])


@pytest.mark.parametrize("d", [10, 1e6])
@pytest.mark.parametrize("theta", [1e-3, 0.64, 1.5])
def test_a_wrong_sign_is_found_and_named(d, theta):
    p, x = beetle.Params(), np.array([d, theta, 2.5])
    right = beetle.model(p)
    wrong = replace(right, F=lambda x, u: right.F(x, u) * [[1, -1, 1], [1, 1, 1], [1, 1, 1]])
    given = p.dt * 2.5 * np.sin(theta)
    with pytest.raises(ValueError, match=r"F\[0, 1\]") as error:
        check_jacobians(wrong, x)
    assert bilingual(error) and f"F[0, 1] is {given:.6g}" in str(error.value)
    told = str(error.value).split("give ")[1].split(". /")[0]
    assert float(told) == pytest.approx(-given, rel=1e-2)


def test_a_forgotten_entry_is_found():
    with pytest.raises(ValueError, match=r"F\[1, 0\].*0\.001") as error:
        check_jacobians(bearing(wrong=1e-3), [-3, 1, 0.5])
    assert bilingual(error)
    m = bearing()
    with pytest.raises(ValueError, match=r"H\[0, 1\]"):
        check_jacobians(replace(m, H=lambda x, *u: m.H(x) * [1, -1, 1]), [-3, 1, 0.5])
    with pytest.raises(ValueError, match=r"F\(x, u\)\[2, 2\] is nan"):
        check_jacobians(
            replace(m, F=lambda x, u: m.F(x, u) * [[1, 1, 1], [1, 1, 1], [1, 1, np.nan]]),
            [-3, 1, 0.5],
        )


def test_functions_with_a_border_are_checked_inside_it():
    """log and sqrt at 1e-6: a step of the size 1e-5 would leave where they live."""
    m = NonlinearModel(
        f=lambda x, u: np.sqrt(x),
        F=lambda x, u: np.diag(0.5 / np.sqrt(x)),
        h=lambda x, *u: np.log(x),
        H=lambda x, *u: np.diag(1 / x),
        Q=np.eye(2),
        R=np.eye(2),
        x0=[1, 1],
        P0=np.eye(2),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_jacobians(m, [1e-6, 1e3])
    with pytest.raises(ValueError, match=r"H\[0, 0\]"):
        check_jacobians(replace(m, H=lambda x, *u: np.diag([-1, 1] / x)), [1e-6, 1e3])


def test_x_must_be_a_state_and_f_finite():
    with pytest.raises(ValueError, match="x has shape") as error:
        check_jacobians(bearing(), [1, 2])
    assert bilingual(error)
    with pytest.raises(ValueError, match="x") as error:
        check_jacobians(bearing(), [1, 2, np.nan])
    assert bilingual(error)
    m = bearing()
    with pytest.raises(ValueError, match=r"f\(x, u\)") as error:
        check_jacobians(replace(m, f=lambda x, u: np.array([np.nan, x[1], x[2]])), [1, 2, 3])
    assert bilingual(error)
