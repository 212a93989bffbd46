"""Chapter 5: the source prints four values of R and one Jacobian; the rest is held against
mathematics and filterpy."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter

from kalman_lib import (
    LinearModel,
    NonlinearModel,
    chi2_bounds,
    kalman_filter,
    nees,
    predict,
    update,
)
from kalman_lib.papers import beetle
from kalman_lib.simulate import simulate

P345 = beetle.Params(theta0=float(np.arctan2(3, 4)))  # sin = 3/5, cos = 4/5; dt = 1/2, v = 5/2


def frozen(p):
    """The EKF whose Jacobian stays at the initial guess: a linear time-invariant covariance
    recursion."""
    model = beetle.model(p)
    F0 = model.F(model.x0, None)
    return NonlinearModel(
        f=model.f,
        F=lambda x, u: F0,
        h=model.h,
        H=model.H,
        Q=model.Q,
        R=model.R,
        x0=model.x0,
        P0=model.P0,
    )


def test_the_four_R_as_printed():
    """Captions of Fig. 3, 4, 5 and 6."""
    assert beetle.PRINTED["R"].split() == ["0.05", "0.001", "0.1", "0.08"]
    assert beetle.PRINTED_R == (0.05, 0.001, 0.1, 0.08)
    assert beetle.Params().R == beetle.PRINTED_R[0]


@pytest.mark.parametrize("seed", range(5))
def test_the_printed_jacobian_entry_by_entry_and_by_central_differences(seed):
    d, theta, v, dt = np.random.default_rng(seed).uniform([5, -1.5, 0.1, 0.05], [50, 1.5, 5, 2])
    x = np.array([d, theta, v])
    A = [
        [1, dt * v * (-np.sin(theta)), dt * np.cos(theta)],
        [0, 1, 0],
        [0, 0, 1],
    ]  # A_t of the source
    assert beetle.F(x, dt) == pytest.approx(np.array(A), abs=1e-15)
    assert beetle.central_difference(lambda x: beetle.f(x, dt), x) == pytest.approx(
        beetle.F(x, dt), abs=1e-8
    )


def test_one_step_in_exact_fractions():
    half, a, b = Fraction(1, 2), Fraction(-3, 4), Fraction(2, 5)  # row of F: 1, -dt v sin, dt cos
    var_d, var_theta, var_v, R = Fraction(1), Fraction(1, 25), Fraction(9, 100), Fraction(1, 20)
    S = var_d + a * a * var_theta + b * b * var_v + R
    K = [(S - R) / S, a * var_theta / S, b * var_v / S]
    x_pred = [10 + half * Fraction(5, 2) * Fraction(4, 5), P345.theta0, Fraction(5, 2)]
    model = beetle.model(P345)
    x, P, F = predict(model, model.x0, model.P0)
    step = update(model, x, P, np.array([11.5]))
    assert F[0] == pytest.approx([1, -0.75, 0.4], abs=1e-15)
    assert x == pytest.approx([float(value) for value in x_pred], abs=1e-14)
    assert step.S[0, 0] == pytest.approx(float(S), rel=1e-14)
    assert step.K[:, 0] == pytest.approx([float(gain) for gain in K], rel=1e-13)
    assert step.x == pytest.approx(
        [float(m) + float(gain) / 2 for m, gain in zip(x_pred, K)], rel=1e-14
    )


def test_the_same_filter_as_filterpy():
    p = beetle.Params(theta0=0.3, v0=2, Q_theta=1e-3, Q_v=1e-3)
    model, z = beetle.model(p), beetle.simulate(p, np.random.default_rng(0)).z
    result = kalman_filter(model, z)

    class Peer(ExtendedKalmanFilter):
        def predict_x(self, u=0):
            self.F = beetle.F(self.x, p.dt)
            self.x = beetle.f(self.x, p.dt)

    peer = Peer(dim_x=3, dim_z=1)
    peer.x, peer.P, peer.Q, peer.R = model.x0, model.P0, model.Q, model.R
    for k, z_k in enumerate(z):
        peer.predict()
        peer.update(z_k, lambda x: np.array([[1.0, 0, 0]]), lambda x: x[:1])
        assert (
            np.abs(peer.x - result.x[k]).max() < 1e-10
            and np.abs(peer.P - result.P[k]).max() < 1e-10
        )


# --- observability ------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(5))
def test_from_the_distance_alone_two_of_three(seed):
    theta, v = np.random.default_rng(seed).uniform([-1.5, 0.1], [1.5, 5])
    model, x = beetle.model(beetle.Params()), np.array([10, theta, v])
    O, n = beetle.observability(model, x), beetle.blind_direction(x)
    assert O == pytest.approx(
        np.array([[1, k * -0.5 * v * np.sin(theta), k * 0.5 * np.cos(theta)] for k in range(3)])
    )
    assert np.linalg.matrix_rank(O) == 2
    assert np.abs(O @ n).max() < 1e-12 and np.abs(model.F(x, None) @ n - n).max() < 1e-12


def test_with_a_frozen_jacobian_the_blind_direction_keeps_its_information():
    """n' P^-1 n stays what it was: F n = n and H n = 0. Hence its variance never falls below its
    own start."""
    p = beetle.Params()
    model = frozen(p)
    n = beetle.blind_direction(model.x0)
    z = beetle.simulate(p, np.random.default_rng(1)).z
    result = kalman_filter(model, z)
    start = n @ np.linalg.solve(model.P0, n)
    assert [n @ np.linalg.solve(P, n) for P in result.P] == pytest.approx(
        [start] * len(z), rel=1e-8
    )
    assert (n @ result.P @ n >= (n @ n) ** 2 / start * (1 - 1e-9)).all()
    assert beetle.least_known(result.P, model.P0) == pytest.approx(np.ones(len(z)), rel=1e-9)


def test_what_a_perfectly_known_s_leaves_of_theta_and_v():
    """Conditioning the prior on a' (dtheta, dv) = 0 with a = (-v sin, cos): the limit of many exact
    measurements."""
    p = replace(P345, R=1e-4, sigma_d=0.01)
    P = kalman_filter(frozen(p), np.full(2000, 20.0)).P[-1, 1:, 1:]
    prior, a = np.diag([p.sigma_theta, p.sigma_v]) ** 2, np.array([-2.5 * 0.6, 0.8])
    limit = prior - np.outer(prior @ a, a @ prior) / (a @ prior @ a)
    assert P == pytest.approx(limit, abs=1e-5)
    assert limit[0, 0] == pytest.approx(
        0.0576 / 0.1476 * p.sigma_theta**2
    )  # 39 % of the variance remains


def test_the_ordinary_EKF_claims_knowledge_that_it_cannot_have():
    p = beetle.Params(theta0=0.3, sigma_theta=0.5)
    z = beetle.simulate(p, np.random.default_rng(5)).z
    assert beetle.least_known(kalman_filter(beetle.model(p), z).P[-1], beetle.model(p).P0) < 0.8


def test_a_guess_of_exactly_zero_never_moves():
    """sin 0 = 0: then the EKF is the linear filter of [d, v], and theta keeps its guess and its
    variance."""
    p = beetle.Params(theta0=0)
    z = beetle.simulate(p, np.random.default_rng(2)).z
    ekf = kalman_filter(beetle.model(p), z)
    line = kalman_filter(
        LinearModel(
            F=[[1, p.dt], [0, 1]],
            H=[[1, 0]],
            Q=np.zeros((2, 2)),
            R=p.R,
            x0=[p.d0, p.v0],
            P0=np.diag([p.sigma_d, p.sigma_v]) ** 2,
        ),
        z,
    )
    assert (ekf.K[:, 1] == 0).all() and (ekf.x[:, 1] == 0).all()
    assert ekf.P[:, 1, 1] == pytest.approx(np.full(len(z), p.sigma_theta**2))
    assert ekf.x[:, [0, 2]] == pytest.approx(line.x, rel=1e-12)


def test_left_and_right_look_the_same():
    z = beetle.simulate(beetle.Params(), np.random.default_rng(3)).z
    right, left = (
        kalman_filter(beetle.model(beetle.Params(theta0=angle)), z) for angle in (0.5, -0.5)
    )
    assert left.x == pytest.approx(right.x * [1, -1, 1], rel=1e-12)


def by_bayes(p, z):
    """Mean and covariance of theta and v from prior times likelihood, at every point of a grid."""
    theta = np.linspace(p.theta0 - 3, p.theta0 + 3, 1500)[:, np.newaxis]
    v = np.linspace(p.v0 - 2, p.v0 + 2, 1500)
    t = p.dt * np.arange(1, len(z) + 1)
    precision = np.linalg.inv(p.R * np.eye(len(z)) + p.sigma_d**2)  # of z - d0 - s t
    s = v * np.cos(theta)
    misfit = s**2 * (t @ precision @ t) - 2 * s * (t @ precision @ (z[:, 0] - p.d0))
    prior = ((theta - p.theta0) / p.sigma_theta) ** 2 + ((v - p.v0) / p.sigma_v) ** 2
    weight = np.exp(-(misfit - misfit.min() + prior) / 2).ravel()
    points = np.array([np.broadcast_to(part, s.shape).ravel() for part in (theta, v)])
    return np.average(points, axis=1, weights=weight), np.cov(points, aweights=weight, bias=True)


@pytest.mark.parametrize("theta0", [0.3, 0.64, 1.4])
def test_the_exact_posterior_is_prior_times_likelihood(theta0):
    p = beetle.Params(theta0=theta0, sigma_theta=0.5, R=2, R_true=2)
    z = beetle.simulate(p, np.random.default_rng(5)).z
    for ours, theirs in zip(beetle.exact_posterior(p, z), by_bayes(p, z)):
        assert ours == pytest.approx(theirs, rel=1e-4, abs=1e-4)


def test_a_bent_banana_may_leave_less_than_1_and_the_EKF_still_claims_too_much():
    p = beetle.Params(theta0=1.4, sigma_theta=0.5)
    z = beetle.simulate(p, np.random.default_rng(5)).z
    model, exact = beetle.model(p), np.zeros((3, 3))
    exact[1:, 1:] = beetle.exact_posterior(p, z)[1]
    claimed = beetle.least_known(kalman_filter(model, z).P[-1], model.P0)
    assert claimed + 0.1 < beetle.least_known(exact, model.P0) == pytest.approx(0.90, abs=0.005)


# --- the linear filter, the second order, the bearing -------------------------------------------


@pytest.mark.parametrize("theta0, sigma_theta", [(0.64, 0.2), (0, 0.5), (-1.2, 0.8)])
def test_mean_and_variance_of_s_by_quadrature(theta0, sigma_theta):
    p = beetle.Params(theta0=theta0, sigma_theta=sigma_theta, sigma_v=0.6)
    node, weight = np.polynomial.hermite_e.hermegauss(60)
    W = np.outer(weight, weight) / (2 * np.pi)
    s = np.cos(theta0 + sigma_theta * node)[:, np.newaxis] * (p.v0 + p.sigma_v * node)
    mean, line = (W * s).sum(), beetle.linear_model(p)
    assert line.x0 == pytest.approx([p.d0, mean], rel=1e-12)
    assert line.P0[1, 1] == pytest.approx((W * (s - mean) ** 2).sum(), rel=1e-12)


def test_s_and_its_sigma():
    x = np.array([[10, np.arctan2(3, 4), 2.5], [20, 0, 1.5]])
    assert beetle.away(x) == pytest.approx([2, 1.5])
    P = np.broadcast_to(np.diag([1, 0.04, 0.09]), (2, 3, 3))
    assert beetle.away_sigma(x, P) ** 2 == pytest.approx([1.5**2 * 0.04 + 0.64 * 0.09, 0.09])


def test_linear_filter_is_consistent_and_refuses_what_is_not_linear():
    p = beetle.Params()
    line, model, values = beetle.linear_model(p), beetle.model(p), []
    for seed in range(100):
        walk = simulate(model, 20, np.random.default_rng(seed))
        result = kalman_filter(line, walk.z)
        values.append(
            nees(np.column_stack([walk.x[:, 0], beetle.away(walk.x)]), result.x, result.P)[-1]
        )
    low, high = chi2_bounds(2, runs=100, probability=0.99)
    assert low < np.mean(values) < high
    with pytest.raises(ValueError, match="needs Q_theta = Q_v = 0"):
        beetle.linear_model(beetle.Params(Q_v=0.01))


def test_second_order_is_the_leading_term_of_the_exact_shift():
    """E v cos(theta) = v cos(theta0) exp(-sigma^2 / 2): the shift is -v cos(theta0) sigma^2 / 2 +
    O(sigma^4)."""
    for sigma in (0.01, 0.02, 0.1):
        p = beetle.Params(sigma_theta=sigma)
        exact = 20 * p.v0 * np.cos(p.theta0) * np.expm1(-(sigma**2) / 2)
        assert beetle.second_order(p, 20) == pytest.approx(exact, rel=sigma**2 / 3)
    h = 1e-4  # and -dt v cos(theta) is the second derivative of f by theta
    d = [beetle.f([10, 0.64 + e, 2.5], 20)[0] for e in (-h, 0, h)]
    assert beetle.second_order(beetle.Params(sigma_theta=1), 20) == pytest.approx(
        (d[0] - 2 * d[1] + d[2]) / h**2 / 2, rel=1e-5
    )


@pytest.mark.parametrize("x", [[10, 0.64, 2.5, 0.0], [30, -0.4, 1, 12], [5, 1.3, 3, -7]])
def test_bearing_model_jacobians_and_full_rank(x):
    p, x = beetle.Params(), np.array(x, dtype=float)
    model = beetle.bearing_model(p)
    assert beetle.central_difference(lambda x: model.f(x, None), x) == pytest.approx(
        model.F(x, None), abs=1e-8
    )
    assert beetle.central_difference(model.h, x) == pytest.approx(model.H(x), abs=1e-8)
    O = beetle.observability(model, x)
    d, theta, v, l = x
    cosine = d / (d**2 + l**2)
    assert abs(np.linalg.det(O[:4])) == pytest.approx(
        cosine**2 * p.dt**2 * v, rel=1e-9
    )  # by hand: not 0 if v is not
    assert np.linalg.matrix_rank(O) == 4
    assert np.linalg.matrix_rank(beetle.observability(model, np.array([d, theta, 0, l]))) == 3


def test_the_bearing_finds_direction_and_speed():
    p = beetle.Params(theta=0.5, v=2.2, theta0=0.9, v0=2.5)
    walk = beetle.simulate(p, np.random.default_rng(4), bearing=True)
    result = kalman_filter(beetle.bearing_model(p), walk.z)
    assert result.x[-1, 1:3] == pytest.approx([0.5, 2.2], abs=0.1)
    assert beetle.least_known(result.P[-1], beetle.bearing_model(p).P0) < 0.01


def test_the_simulated_beetle_walks_straight_and_its_sensor_has_the_noise_it_claims():
    p = beetle.Params(R_true=0.08, theta=0.5, v=2)
    walk = beetle.simulate(p, np.random.default_rng(6), steps=5000)
    assert walk.x[:, 0] == pytest.approx(10 + 0.5 * 2 * np.cos(0.5) * np.arange(1, 5001))
    assert (walk.z - walk.x[:, :1]).var() == pytest.approx(0.08, rel=0.06)


def test_parameters_out_of_range_are_named():
    with pytest.raises(ValueError, match="theta0 = 2.*-1.5 to 1.5 rad"):
        beetle.model(beetle.Params(theta0=2))
