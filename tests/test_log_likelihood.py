"""The log-likelihood against statsmodels, mpmath and dense Gaussians."""

import warnings
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from scipy.stats import multivariate_normal
from statsmodels.tsa.statespace.mlemodel import MLEModel
from tuning_helpers import bilingual, two_sensors

from kalman_lib import (
    LinearModel,
    kalman_filter,
    log_likelihood,
)
from kalman_lib.papers import beetle
from kalman_lib.simulate import simulate


def theirs(model, z):
    """statsmodels' log-likelihood of a LinearModel; its state begins at the first prediction."""
    peer = MLEModel(z, k_states=len(model.x0), k_posdef=len(model.x0))
    peer["transition"], peer["design"] = model.F, model.H
    peer["state_cov"], peer["obs_cov"], peer["selection"] = model.Q, model.R, np.eye(len(model.x0))
    peer.ssm.initialize_known(model.F @ model.x0, model.F @ model.P0 @ model.F.T + model.Q)
    peer.ssm.tolerance = 0
    return peer.ssm.loglike()


# --- the log-likelihood ---------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(5))
def test_log_likelihood_is_that_of_statsmodels(seed):
    rng = np.random.default_rng(seed)
    n, m = rng.integers(1, 4, 2)
    A, B, C = rng.normal(size=(n, n)), rng.normal(size=(m, m)), rng.normal(size=(n, n))
    model = LinearModel(
        F=0.9 * A / np.abs(np.linalg.eigvals(A)).max(),
        H=rng.normal(size=(m, n)),
        Q=C @ C.T,
        R=B @ B.T + 0.1 * np.eye(m),
        x0=rng.normal(size=n),
        P0=C.T @ C,
    )
    z = simulate(model, 300, rng).z
    z[rng.random(300) < 0.1] = np.nan
    assert log_likelihood(kalman_filter(model, z)) == pytest.approx(theirs(model, z), rel=1e-9)


def test_log_likelihood_is_the_density_of_all_measurements_at_once():
    model, T = two_sensors(), 6
    z = simulate(model, T, np.random.default_rng(0)).z
    states = [np.linalg.matrix_power(model.F, k) for k in range(1, T + 1)]
    M = np.vstack([model.H @ F_k for F_k in states])  # z = M x0 + what w and v add
    noise = np.kron(np.eye(T), model.R)
    for j in range(T):
        G = np.vstack([
            model.H @ np.linalg.matrix_power(model.F, k - j) if k >= j else np.zeros((2, 2))
            for k in range(T)
        ])
        noise = noise + G @ model.Q @ G.T
    dense = multivariate_normal(M @ model.x0, M @ model.P0 @ M.T + noise)
    expected = dense.logpdf(z.ravel())
    assert log_likelihood(kalman_filter(model, z)) == pytest.approx(expected, rel=1e-12)


def innovations(seed=1, T=7, m=3):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(T, m, m))
    return rng.normal(size=(T, m)), A @ A.swapaxes(1, 2) + 0.1 * np.eye(m)


def test_only_the_sensors_that_spoke_count():
    y, S = innovations()
    y[1, 0] = y[3, 1:] = y[5] = np.nan
    S[2, 1, 1] = np.inf  # R = inf: no information
    expected = 0
    for y_k, S_k in zip(y, S):
        f = np.isfinite(y_k) & np.isfinite(np.diag(S_k))
        expected += multivariate_normal(cov=S_k[np.ix_(f, f)]).logpdf(y_k[f]) if f.any() else 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert log_likelihood(SimpleNamespace(y=y, S=S)) == pytest.approx(expected, rel=1e-12)
    assert log_likelihood(SimpleNamespace(y=y * np.nan, S=S)) == 0


def test_many_runs_have_one_number_each():
    model = two_sensors()
    z = np.stack([simulate(model, 60, np.random.default_rng(seed)).z for seed in range(4)], axis=2)
    L = log_likelihood(kalman_filter(model, z))
    assert L.shape == (4,)
    assert L == pytest.approx([theirs(model, z[:, :, i]) for i in range(4)], rel=1e-9)
    y = np.random.default_rng(0).normal(size=(5, 2, 3))
    S = np.eye(2)[:, :, None] * np.arange(1, 4) + np.zeros((5, 1, 1, 1))
    y[2, 1, 0] = np.nan  # S of every run, gaps of one
    each = [log_likelihood(SimpleNamespace(y=y[..., i], S=S[..., i])) for i in range(3)]
    assert log_likelihood(SimpleNamespace(y=y, S=S)) == pytest.approx(each, rel=1e-13)
    second = log_likelihood(SimpleNamespace(y=y[..., 1], S=S[..., 0]))
    together = log_likelihood(SimpleNamespace(y=y, S=S[..., 0]))
    assert together[1] == pytest.approx(second, rel=1e-13)


def test_the_extended_filter_has_a_likelihood_too():
    p = beetle.Params(theta0=0)  # sin 0 = 0: the extended filter is the linear one of [d, v]
    z = beetle.simulate(p, np.random.default_rng(2)).z
    line = LinearModel(
        F=[[1, p.dt], [0, 1]],
        H=[[1, 0]],
        Q=np.zeros((2, 2)),
        R=p.R,
        x0=[p.d0, p.v0],
        P0=np.diag([p.sigma_d, p.sigma_v]) ** 2,
    )
    L = log_likelihood(kalman_filter(beetle.model(p), z))
    assert isinstance(L, float) and L == pytest.approx(theirs(line, z), rel=1e-9)


def test_badly_scaled_S():
    """Against mpmath, 50 digits: units of 1e9 beside 1e-9, and two sensors that are almost one."""
    s = np.array([1e-9, 1e9])
    S = np.outer(s, s) * [[1, 1 - 1e-6], [1 - 1e-6, 1]]
    y = np.array([[2e-9, -1e9]])
    with mpmath.workdps(50):
        M, v = mpmath.matrix(S.tolist()), mpmath.matrix(y[0].tolist())
        square = (v.T * mpmath.inverse(M) * v)[0]
        expected = float(-(2 * mpmath.log(2 * mpmath.pi) + mpmath.log(mpmath.det(M)) + square) / 2)
    assert log_likelihood(SimpleNamespace(y=y, S=S[None])) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    "S", [[[1, 2], [2, 1]], [[1, 0], [0, -1]], [[0, 0], [0, 1]], [[np.nan, 0], [0, 1]]]
)
def test_an_S_that_is_no_covariance_is_named(S):
    result = SimpleNamespace(y=np.ones((3, 2)), S=np.array([np.eye(2), np.eye(2), S]))
    with pytest.raises(ValueError, match=r"S\[2\].*not a covariance") as error:
        log_likelihood(result)
    assert bilingual(error)
