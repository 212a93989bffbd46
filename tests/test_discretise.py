"""From continuous time to a step, against closed forms and SciPy's quadrature."""

import math

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.linalg import expm
from tuning_helpers import bilingual

from kalman_lib import (
    discretise,
)

# --- from continuous to discrete ------------------------------------------------------------------


@pytest.mark.parametrize("dt", [1e-4, 0.1, 1, 250])
def test_constant_velocity_and_acceleration(dt):
    F, Q = discretise([[0, 1], [0, 0]], [[0, 0], [0, 3]], dt)
    assert F == pytest.approx(np.array([[1, dt], [0, 1]]), rel=1e-13, abs=0)
    assert Q == pytest.approx(
        3 * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]]), rel=1e-12, abs=0
    )
    F, Q = discretise(np.eye(3, k=1), np.diag([0, 0, 2]), dt)
    powers = np.array([[5, 4, 3], [4, 3, 2], [3, 2, 1]])
    factors = np.array([[20, 8, 6], [8, 3, 2], [6, 2, 1]])
    assert F == pytest.approx(
        np.array([[1, dt, dt**2 / 2], [0, 1, dt], [0, 0, 1]]), rel=1e-13, abs=0
    )
    assert Q == pytest.approx(2 * dt**powers / factors, rel=1e-11, abs=0)
    assert np.array_equal(Q, Q.T)


@pytest.mark.parametrize("a", [1e-9, 0.3, 50, 1e5])
def test_ornstein_uhlenbeck(a):
    F, Q, B = discretise(-a, 2, 0.5, Bc=4)
    assert F[0, 0] == pytest.approx(np.exp(-a / 2), rel=1e-9 if a < 100 else 1, abs=1e-300)
    assert Q[0, 0] == pytest.approx(-np.expm1(-a) / a, rel=1e-12)  # 2 (1 - exp(-2 a dt)) / (2 a)
    assert B[0, 0] == pytest.approx(-4 * np.expm1(-a / 2) / a, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_against_the_integrals(seed):
    rng = np.random.default_rng(seed)
    A, G, Bc, dt = rng.normal(size=(3, 3)), rng.normal(size=(3, 2)), rng.normal(size=(3, 2)), 0.8
    F, Q, B = discretise(A, G @ G.T, dt, Bc)
    assert F == pytest.approx(expm(A * dt), rel=1e-12)
    expected = quad_vec(lambda s: expm(A * s) @ G @ G.T @ expm(A * s).T, 0, dt)[0]
    assert Q == pytest.approx(expected, rel=1e-9, abs=1e-12)
    assert B == pytest.approx(quad_vec(lambda s: expm(A * s) @ Bc, 0, dt)[0], rel=1e-9, abs=1e-12)
    assert np.linalg.eigvalsh(Q)[0] > -1e-15 and np.array_equal(Q, Q.T)


def test_one_step_after_another_is_one_long_step():
    A, Qc, Bc = np.array([[0, 1], [-4, -0.3]]), np.diag([0, 0.2]), [[0], [1]]
    F, Q, B = discretise(A, Qc, [0.1, 0.25, 0.1], Bc)
    assert F.shape == Q.shape == (3, 2, 2) and B.shape == (3, 2, 1)
    one = discretise(A, Qc, 0.25, Bc)
    for several, single in zip((F, Q, B), one):
        assert several[1] == pytest.approx(single, rel=1e-13)
        assert np.array_equal(several[0], several[2])
    whole = discretise(A, Qc, 0.35, Bc)
    assert F[1] @ F[0] == pytest.approx(whole[0])
    assert F[1] @ Q[0] @ F[1].T + Q[1] == pytest.approx(whole[1])
    assert F[1] @ B[0] + B[1] == pytest.approx(whole[2])
    assert len(discretise(A, Qc, np.array([0.1]))) == 2


@pytest.mark.parametrize(
    "arguments, said",
    [
        ((np.eye(2), np.eye(3), 1), "Qc"),
        ((np.ones((2, 3)), np.eye(2), 1), "A"),
        ((np.eye(2), -np.eye(2), 1), "Qc"),
        ((np.eye(2), np.eye(2), 0), "dt"),
        ((np.eye(2), np.eye(2), -1), "dt"),
        ((np.eye(2), np.eye(2), np.nan), "dt"),
        ((np.eye(2), np.eye(2), [0.1, 0]), "dt"),
        ((np.eye(2), np.eye(2), np.ones((2, 2))), "dt"),
        ((np.eye(2), np.eye(2), 1, np.ones((3, 1))), "Bc"),
        (([[np.nan]], 1, 1), "A"),
        (("x", 1, 1), "A"),
        ((1, 1, "s"), "dt"),
        ((1, 1, []), "dt"),
    ],
)
def test_discretise_names_what_is_wrong(arguments, said):
    with pytest.raises(ValueError, match=said) as error:
        discretise(*arguments)
    assert bilingual(error)


@pytest.mark.parametrize("n", [2, 4, 6, 8])
@pytest.mark.parametrize("dt", [1e-6, 1e-3, 0.1, 2.0])
def test_a_chain_of_integrators_keeps_the_digits_of_every_entry(n, dt):
    """Q[i, j] = dt^(a + b + 1) / ((a + b + 1) a! b!) with a = n - 1 - i, b = n - 1 - j."""
    Qc = np.zeros((n, n))
    Qc[-1, -1] = 1
    F, Q = discretise(np.eye(n, k=1), Qc, dt)
    for i in range(n):
        for j in range(n):
            a, b = n - 1 - i, n - 1 - j
            expected = dt ** (a + b + 1) / ((a + b + 1) * math.factorial(a) * math.factorial(b))
            assert Q[i, j] == pytest.approx(expected, rel=1e-12, abs=0)
            power = dt ** (j - i) / math.factorial(j - i) if j >= i else 0
            assert F[i, j] == pytest.approx(power, rel=1e-12, abs=1e-300)
