"""The filter and the smoother against mathematics and against two other libraries."""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from filters_helpers import close, random_model
from scipy.linalg import solve_discrete_are
from statsmodels.tsa.statespace.mlemodel import MLEModel

from kalman_lib import (
    LinearModel,
    NonlinearModel,
    kalman_filter,
    predict,
    rts_smooth,
    update,
)
from kalman_lib.simulate import simulate


def dense_posterior(model, z, u):
    """Mean and covariance of all states given all of z, from one big joint Gaussian: no recursion.

    The states are one linear map of (x0, w_1 .. w_T); conditioning that Gaussian on z is the
    textbook formula.
    """
    T, n = len(z), len(model.x0)
    powers = [np.linalg.matrix_power(model.F, k) for k in range(T + 1)]
    A = np.zeros((T * n, (T + 1) * n))
    mean = np.zeros((T, n))
    for k in range(T):
        mean[k] = powers[k + 1] @ model.x0
        A[k * n : (k + 1) * n, :n] = powers[k + 1]
        for j in range(k + 1):
            A[k * n : (k + 1) * n, (j + 1) * n : (j + 2) * n] = powers[k - j]
            mean[k] += powers[k - j] @ model.B @ u[j]
    noise = np.kron(np.eye(T + 1), model.Q)
    noise[:n, :n] = model.P0
    prior = A @ noise @ A.T
    known = np.isfinite(z).all(axis=1)
    H = np.kron(np.eye(T)[known], model.H)
    S = H @ prior @ H.T + np.kron(np.eye(known.sum()), model.R)
    gain = prior @ H.T @ np.linalg.inv(S)
    x = mean.ravel() + gain @ (z[known] - (mean @ model.H.T)[known]).ravel()
    P = prior - gain @ H @ prior
    steps = [slice(k * n, (k + 1) * n) for k in range(T)]
    return x.reshape(T, n), np.array([P[step, step] for step in steps])


@pytest.mark.parametrize("seed", range(20))
def test_smoother_and_filter_equal_conditioning_of_the_dense_joint_gaussian(seed):
    rng = np.random.default_rng(seed)
    model, T = random_model(rng, l=2), 8
    u = rng.normal(size=(T, 2))
    z = simulate(model, T, rng, u).z
    z[[2, 5]] = np.nan
    result = kalman_filter(model, z, u)
    smooth = rts_smooth(result)
    x, P = dense_posterior(model, z, u)
    close(smooth.x, x)
    close(smooth.P, P)
    for k in range(T):  # the filter at k knows z up to k
        x, P = dense_posterior(model, z[: k + 1], u)
        close(result.x[k], x[-1])
        close(result.P[k], P[-1])


@pytest.mark.parametrize("seed", range(10))
def test_extended_filter_on_a_linear_model_is_the_linear_filter(seed):
    rng = np.random.default_rng(seed)
    model = random_model(rng, l=1)
    twin = NonlinearModel(
        f=lambda x, u: model.F @ x + model.B @ u,
        F=lambda x, u: model.F,
        h=lambda x, u: model.H @ x,
        H=lambda x, u: model.H,
        Q=model.Q,
        R=model.R,
        x0=model.x0,
        P0=model.P0,
    )
    u = rng.normal(size=(30, 1))
    z = simulate(model, 30, rng, u).z
    a, b = kalman_filter(model, z, u), kalman_filter(twin, z, u)
    for name in ("x_pred", "P_pred", "x", "P", "y", "S", "K", "F", "R"):
        assert np.array_equal(getattr(a, name), getattr(b, name))
    assert np.array_equal(rts_smooth(a).x, rts_smooth(b).x)


@pytest.mark.parametrize("scale", [1e-12, 1, 1e12])
@pytest.mark.parametrize("seed", range(5))
def test_covariances_stay_covariances(seed, scale):
    rng = np.random.default_rng(seed)
    model = random_model(rng, n=4, m=2)
    model = LinearModel(
        F=model.F, H=model.H, Q=scale * model.Q, R=model.R, x0=model.x0, P0=model.P0
    )
    result = kalman_filter(model, simulate(model, 200, rng).z)
    smooth = rts_smooth(result)
    for P in (result.P_pred, result.P, smooth.P):
        assert np.array_equal(P, P.swapaxes(1, 2))
        assert (np.linalg.eigvalsh(P) >= -1e-12 * np.abs(P).max()).all()
    for larger, smaller in ((result.P_pred, result.P), (result.P, smooth.P)):
        assert (np.linalg.eigvalsh(larger - smaller) >= -1e-9 * np.abs(larger).max()).all()


@pytest.mark.parametrize("seed", range(5))
def test_steady_state_is_the_fixed_point_of_the_riccati_equation(seed):
    rng = np.random.default_rng(seed)
    model = random_model(rng, n=3, m=2)
    result = kalman_filter(model, np.zeros((500, 2)))
    close(result.P_pred[-1], solve_discrete_are(model.F.T, model.H.T, model.Q, model.R))


def test_missing_rows_keep_the_prediction():
    rng = np.random.default_rng(1)
    model = random_model(rng, n=2, m=2)
    z = simulate(model, 10, rng).z
    z[4] = z[7] = np.nan
    result = kalman_filter(model, z)
    for k in (4, 7):
        assert np.array_equal(result.x[k], result.x_pred[k])
        assert np.array_equal(result.P[k], result.P_pred[k])
        assert np.isnan(result.y[k]).all() and (result.K[k] == 0).all()
    assert np.isfinite(result.x).all()
    close(result.x[4], model.F @ result.x[3])


def test_one_step_by_hand_equals_the_loop():
    rng = np.random.default_rng(2)
    model = random_model(rng, n=3, m=2, l=1)
    u, z = rng.normal(size=(2, 1)), rng.normal(size=(2, 2))
    result = kalman_filter(model, z, u)
    x, P = model.x0, model.P0
    for k in range(2):
        x_pred, P_pred, F = predict(model, x, P, u[k])
        x, P, y, S, K = update(model, x_pred, P_pred, z[k])
        for name, value in dict(x_pred=x_pred, P_pred=P_pred, F=F, x=x, P=P, y=y, S=S, K=K).items():
            assert np.array_equal(getattr(result, name)[k], value)


def test_R_that_changes_in_time_given_as_array_and_as_function():
    rng = np.random.default_rng(3)
    model = random_model(rng, n=2, m=1)
    R = rng.uniform(0.1, 5, size=(20, 1, 1))
    z = simulate(model, 20, rng).z
    in_time = LinearModel(F=model.F, H=model.H, Q=model.Q, R=R, x0=model.x0, P0=model.P0)
    seen = []

    def adapt_R(k, y, HPH, R_model):
        seen.append((y, HPH))
        return R[k]

    a, b = kalman_filter(in_time, z), kalman_filter(model, z, adapt_R=adapt_R)
    assert np.array_equal(a.x, b.x) and np.array_equal(a.R, R) and np.array_equal(b.R, R)
    close([y for y, _ in seen], a.y)
    close([HPH for _, HPH in seen], a.S - R)
    assert not np.allclose(kalman_filter(model, z).x, a.x)
    with pytest.raises(ValueError, match="adapt_R at step 0.*not positive definite"):
        kalman_filter(model, z, adapt_R=lambda k, y, HPH, R: -R)
    with pytest.raises(ValueError, match=r"adapt_R at step 0 has shape \(\), expected \(1, 1\)"):
        kalman_filter(model, z, adapt_R=lambda k, y, HPH, R: 1.0)


def test_an_angle_is_wrapped_by_the_model_s_residual():
    """z = -179 deg against a prediction of +179 deg is 2 deg away, not 358."""
    model = LinearModel(
        F=1,
        H=1,
        Q=1,
        R=1,
        x0=np.radians(179),
        P0=0,
        residual=lambda z, z_pred: (z - z_pred + np.pi) % (2 * np.pi) - np.pi,
    )
    result = kalman_filter(model, [np.radians(-179)])
    assert np.degrees(result.y[0, 0]) == pytest.approx(2)
    assert np.degrees(result.x[0, 0]) == pytest.approx(180)  # K = 1/2


def test_smoother_with_a_state_that_is_known_exactly():
    model = LinearModel(
        F=[[1, 1], [0, 1]], H=[[1, 0]], Q=np.zeros((2, 2)), R=1, x0=[0, 1], P0=np.zeros((2, 2))
    )
    smooth = rts_smooth(kalman_filter(model, [5, 5, 5]))
    assert np.array_equal(smooth.x, [[1, 1], [2, 1], [3, 1]])


@pytest.mark.parametrize("block", range(10))
def test_a_thousand_random_models_against_filterpy_and_statsmodels(block):
    rng = np.random.default_rng(1000 + block)
    for _ in range(100):
        model = random_model(rng)
        z = simulate(model, 12, rng).z
        z[rng.random(12) < 0.15] = np.nan
        result = kalman_filter(model, z)
        smooth = rts_smooth(result)
        n, m = len(model.x0), z.shape[1]

        peer = KalmanFilter(dim_x=n, dim_z=m)
        peer.F, peer.H, peer.Q, peer.R = model.F, model.H, model.Q, model.R
        peer.x, peer.P = model.x0.copy(), model.P0.copy()
        rows = [None if np.isnan(row).any() else row for row in z]
        x, P, x_pred, P_pred = peer.batch_filter(rows)
        for ours, theirs in (
            (result.x, x),
            (result.P, P),
            (result.x_pred, x_pred),
            (result.P_pred, P_pred),
        ):
            close(ours, theirs)
        x, P, _, _ = peer.rts_smoother(x, P)
        close(smooth.x, x)
        close(smooth.P, P)

        peer = MLEModel(z, k_states=n, k_posdef=n, tolerance=0)
        peer["transition"], peer["design"], peer["selection"] = model.F, model.H, np.eye(n)
        peer["state_cov"], peer["obs_cov"] = model.Q, model.R
        peer.initialize_known(model.F @ model.x0, model.F @ model.P0 @ model.F.T + model.Q)
        peer.ssm.tolerance = 0  # never switch to the steady gain
        theirs = peer.smooth([], return_ssm=True)
        close(result.x, theirs.filtered_state.T)
        close(result.P, theirs.filtered_state_cov.transpose(2, 0, 1))
        close(result.x_pred, theirs.predicted_state.T[:-1])
        close(smooth.x, theirs.smoothed_state.T)
        close(smooth.P, theirs.smoothed_state_cov.transpose(2, 0, 1))
