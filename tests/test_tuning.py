"""Tuning against statsmodels, SciPy's quadrature, mpmath and closed forms."""
import math
import warnings
from dataclasses import replace
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.linalg import expm
from scipy.stats import chi2, kstest, multivariate_normal
from statsmodels.datasets import nile
from statsmodels.stats.diagnostic import acorr_ljungbox
from statsmodels.tools.numdiff import approx_hess
from statsmodels.tsa.statespace.mlemodel import MLEModel
from statsmodels.tsa.statespace.structural import UnobservedComponents
from statsmodels.tsa.stattools import acf

from kalman_lib import (LinearModel, NonlinearModel, check_jacobians, discretise, fit, kalman_filter, log_likelihood,
                        steady, whiteness)
from kalman_lib.numeric import maximise
from kalman_lib.papers import beetle
from kalman_lib.simulate import simulate

NILE = nile.load_pandas().data["volume"].to_numpy()


def bilingual(error):
    """One sentence in each language, separated by a slash."""
    english, indonesian = str(error.value).split(" / ")
    return english.endswith(".") and indonesian.endswith(".") and english != indonesian


def two_sensors(**changes):
    values = dict(F=[[1, .1], [0, .95]], H=[[1, 0], [1, 1]], Q=[[.02, .01], [.01, .05]], R=[[.5, .2], [.2, .8]],
                  x0=[1, 0], P0=[[2, .3], [.3, 1]])
    return LinearModel(**(values | changes))


def theirs(model, z):
    """statsmodels' log-likelihood of a LinearModel; its state begins at the first prediction."""
    peer = MLEModel(z, k_states=len(model.x0), k_posdef=len(model.x0))
    peer["transition"], peer["design"] = model.F, model.H
    peer["state_cov"], peer["obs_cov"], peer["selection"] = model.Q, model.R, np.eye(len(model.x0))
    peer.ssm.initialize_known(model.F @ model.x0, model.F @ model.P0 @ model.F.T + model.Q)
    peer.ssm.tolerance = 0
    return peer.ssm.loglike()


# --- the log-likelihood ------------------------------------------------------------------------------------------

@pytest.mark.parametrize("seed", range(5))
def test_log_likelihood_is_that_of_statsmodels(seed):
    rng = np.random.default_rng(seed)
    n, m = rng.integers(1, 4, 2)
    A, B, C = rng.normal(size=(n, n)), rng.normal(size=(m, m)), rng.normal(size=(n, n))
    model = LinearModel(F=.9 * A / np.abs(np.linalg.eigvals(A)).max(), H=rng.normal(size=(m, n)), Q=C @ C.T,
                        R=B @ B.T + .1 * np.eye(m), x0=rng.normal(size=n), P0=C.T @ C)
    z = simulate(model, 300, rng).z
    z[rng.random(300) < .1] = np.nan
    assert log_likelihood(kalman_filter(model, z)) == pytest.approx(theirs(model, z), rel=1e-9)


def test_log_likelihood_is_the_density_of_all_measurements_at_once():
    model, T = two_sensors(), 6
    z = simulate(model, T, np.random.default_rng(0)).z
    states = [np.linalg.matrix_power(model.F, k) for k in range(1, T + 1)]
    M = np.vstack([model.H @ F_k for F_k in states])                    # z = M x0 + what w and v add
    noise = np.kron(np.eye(T), model.R)
    for j in range(T):
        G = np.vstack([model.H @ np.linalg.matrix_power(model.F, k - j) if k >= j else np.zeros((2, 2))
                       for k in range(T)])
        noise = noise + G @ model.Q @ G.T
    dense = multivariate_normal(M @ model.x0, M @ model.P0 @ M.T + noise)
    assert log_likelihood(kalman_filter(model, z)) == pytest.approx(dense.logpdf(z.ravel()), rel=1e-12)


def innovations(seed=1, T=7, m=3):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(T, m, m))
    return rng.normal(size=(T, m)), A @ A.swapaxes(1, 2) + .1 * np.eye(m)


def test_only_the_sensors_that_spoke_count():
    y, S = innovations()
    y[1, 0] = y[3, 1:] = y[5] = np.nan
    S[2, 1, 1] = np.inf                                                 # R = inf: no information
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
    y, S = np.random.default_rng(0).normal(size=(5, 2, 3)), np.eye(2)[:, :, None] * np.arange(1, 4) + np.zeros((5, 1, 1, 1))
    y[2, 1, 0] = np.nan                                                 # S of every run, gaps of one
    each = [log_likelihood(SimpleNamespace(y=y[..., i], S=S[..., i])) for i in range(3)]
    assert log_likelihood(SimpleNamespace(y=y, S=S)) == pytest.approx(each, rel=1e-13)
    assert log_likelihood(SimpleNamespace(y=y, S=S[..., 0]))[1] == pytest.approx(
        log_likelihood(SimpleNamespace(y=y[..., 1], S=S[..., 0])), rel=1e-13)


def test_the_extended_filter_has_a_likelihood_too():
    p = beetle.Params(theta0=0)         # sin 0 = 0: the extended filter is the linear one of [d, v]
    z = beetle.simulate(p, np.random.default_rng(2)).z
    line = LinearModel(F=[[1, p.dt], [0, 1]], H=[[1, 0]], Q=np.zeros((2, 2)), R=p.R, x0=[p.d0, p.v0],
                       P0=np.diag([p.sigma_d, p.sigma_v]) ** 2)
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


@pytest.mark.parametrize("S", [[[1, 2], [2, 1]], [[1, 0], [0, -1]], [[0, 0], [0, 1]], [[np.nan, 0], [0, 1]]])
def test_an_S_that_is_no_covariance_is_named(S):
    result = SimpleNamespace(y=np.ones((3, 2)), S=np.array([np.eye(2), np.eye(2), S]))
    with pytest.raises(ValueError, match=r"S\[2\].*not a covariance") as error:
        log_likelihood(result)
    assert bilingual(error)


# --- maximum likelihood ------------------------------------------------------------------------------------------

def local_level(Q, R):
    return LinearModel(F=1, H=1, Q=Q, R=R, x0=NILE[0], P0=R)


def test_the_nile_as_durbin_and_koopman_print_it():
    """Time Series Analysis by State Space Methods, 2.10: 15,099 and 1,469.1, ln L = -632.5456 (diffuse start)."""
    found = fit(local_level, dict(Q=1000, R=1000), NILE[1:])
    assert f"{found.values['R']:.0f}" == "15099" and found.values["Q"] == pytest.approx(1469.1, abs=.1)
    assert found.log_likelihood == pytest.approx(-632.5456, abs=1e-3)
    assert found.at_bound == () and isinstance(found.model, LinearModel)
    assert found.model.Q[0, 0] == found.values["Q"]
    peer = UnobservedComponents(NILE, "llevel", use_exact_diffuse=True)

    def loglike(logs):
        return peer.loglike(np.exp(logs))
    logs = np.log([found.values["R"], found.values["Q"]])
    assert found.log_likelihood >= loglike(np.log([15098.52, 1469.18])) - 1e-9
    sd = np.sqrt(np.diag(np.linalg.inv(-approx_hess(logs, loglike)))) * np.exp(logs)
    assert [found.errors["R"], found.errors["Q"]] == pytest.approx(sd, rel=2e-3)


@pytest.mark.parametrize("Q, R", [(1e-3, 1e9), (1e9, 1e-3), (1e8, 1e8), (1, 1)])
def test_a_poor_start_finds_the_same_maximum(Q, R):
    found = fit(local_level, dict(Q=Q, R=R), NILE[1:])
    assert found.log_likelihood == pytest.approx(-632.5456, abs=1e-3)
    assert found.values == pytest.approx(dict(Q=1469.18, R=15098.5), rel=1e-4)


def constant(R, P0=1e12):
    return LinearModel(F=1, H=1, Q=0, R=R, x0=0, P0=P0)


def test_closed_form_of_a_known_mean():
    """A state known to be 0: R is the mean square of z, its standard error R sqrt(2 / T)."""
    z = np.random.default_rng(3).normal(0, 2, 400)
    found = fit(lambda R: constant(R, P0=0), dict(R=1), z)
    mean_square = np.mean(z ** 2)
    assert found.values["R"] == pytest.approx(mean_square, rel=1e-6)
    assert found.errors["R"] == pytest.approx(mean_square * np.sqrt(2 / 400), rel=1e-3)
    assert found.log_likelihood == pytest.approx(-200 * (np.log(2 * np.pi * mean_square) + 1), rel=1e-12)


def test_standard_errors_are_honest():
    """Of 60 series, the true log Q and log R lie within +-2 standard errors in about 57; fewer than 50: 1 in 1,000."""
    inside = np.zeros(2)
    true = LinearModel(F=1, H=1, Q=.5, R=2, x0=0, P0=0)
    for seed in range(60):
        z = simulate(true, 400, np.random.default_rng(seed)).z
        found = fit(lambda Q, R: replace(true, Q=Q, R=R), dict(Q=1, R=1), z)
        for i, (name, value) in enumerate(dict(Q=.5, R=2).items()):
            inside[i] += abs(np.log(found.values[name] / value)) < 2 * found.errors[name] / found.values[name]
    assert (inside >= 50).all()


def test_inputs_and_gaps_take_part():
    rng = np.random.default_rng(5)
    true = LinearModel(F=.8, H=1, Q=.1, R=.4, x0=0, P0=1, B=1)
    u = rng.normal(size=600)
    z = simulate(true, 600, rng, u=u).z
    z[100:130] = np.nan
    found = fit(lambda Q, R, gain: replace(true, Q=Q, R=R, B=gain), dict(Q=1, R=1, gain=.1), z, u)
    for name, value in dict(Q=.1, R=.4, gain=1).items():
        assert abs(found.values[name] - value) < 4 * found.errors[name] and found.errors[name] < .3 * value


def test_names_in_free_may_be_negative():
    rng = np.random.default_rng(6)
    z = simulate(LinearModel(F=-.7, H=1, Q=1, R=.5, x0=0, P0=2), 800, rng).z
    found = fit(lambda a, Q: LinearModel(F=a, H=1, Q=Q, R=.5, x0=0, P0=2), dict(a=0, Q=1), z, free=("a",))
    assert abs(found.values["a"] + .7) < 4 * found.errors["a"] and found.errors["a"] < .05


def test_several_starts_find_the_higher_of_two_peaks():
    """Two sharp peaks in ln a, at 1 and at 100; the search that starts at 1 alone stays there."""
    def two_peaks(a):
        return np.logaddexp(-np.log(a) ** 2 * 50, 3 - np.log(a / 100) ** 2 * 50)
    assert maximise(two_peaks, dict(a=1.1)).values["a"] == pytest.approx(100, rel=1e-4)
    alone = maximise(two_peaks, dict(a=1.1), factors=())
    assert alone.values["a"] == pytest.approx(1, rel=1e-4) and alone.errors["a"] == pytest.approx(.1, rel=2e-2)


def test_a_maximum_at_a_bound_says_so():
    """Measurements without noise: R = 0 is the best; and a constant: Q = 0."""
    walk = np.cumsum(np.random.default_rng(0).normal(size=200))
    found = fit(lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=0, P0=0), dict(Q=1, R=1), walk)
    assert found.at_bound == ("R",) and np.isnan(found.errors["R"])
    assert found.values["R"] == pytest.approx(1e-12) and found.values["Q"] == pytest.approx(np.mean(np.diff(walk, prepend=0) ** 2))
    assert found.errors["Q"] == pytest.approx(found.values["Q"] * np.sqrt(2 / 200), rel=1e-2)
    still = np.random.default_rng(2).normal(5, .01, 100)
    found = fit(lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=5, P0=1), dict(Q=1e-4, R=1e-4), still)
    assert found.at_bound == ("Q",) and np.isnan(found.errors["Q"]) and found.errors["R"] < 2e-5


def test_a_flat_likelihood_claims_no_accuracy():
    z = np.random.default_rng(4).normal(size=100)
    found = fit(lambda R, idle: constant(R), dict(R=1, idle=3), z)
    assert not np.isfinite(found.errors["idle"]) and found.values["idle"] == pytest.approx(3)
    assert found.errors["R"] < .3 and found.at_bound == ()
    found = fit(lambda a, b: constant(a * b), dict(a=1, b=1), z)        # only the product is known
    assert not np.isfinite(found.errors["a"]) and not np.isfinite(found.errors["b"])


def test_what_overflows_explains_nothing_and_warns_nobody():
    z = np.random.default_rng(7).normal(size=300)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = fit(lambda a, R: LinearModel(F=a, H=1, Q=1, R=R, x0=1e5, P0=0), dict(a=.5, R=1), z)
    assert np.isfinite(found.log_likelihood) and found.values["a"] < 1.5
    with pytest.raises(ValueError) as error:
        fit(lambda a: LinearModel(F=a, H=1e200, Q=1e200, R=1, x0=1e200, P0=0), dict(a=1e60), z)
    assert bilingual(error)


@pytest.mark.parametrize("start, said", [
    (dict(Q=0, R=1), "Q = 0"), (dict(Q=1, R=-1), "R = -1"), (dict(Q=np.nan, R=1), "Q = nan"), (dict(Q=1, R=[1, 2]), "R"),
    (dict(Q="a", R=1), "Q"), ({}, "start"), ([1, 2], "start"), (dict(Q=1, S=1), "S"), (dict(Q=np.inf, R=1), "Q = inf")])
def test_a_start_that_cannot_be_one_is_named(start, said):
    with pytest.raises(ValueError, match=said) as error:
        fit(local_level, start, NILE)
    assert bilingual(error)


def test_an_error_of_the_model_comes_through():
    with pytest.raises(ValueError, match="z has shape"):
        fit(local_level, dict(Q=1, R=1), np.ones((5, 2)))
    with pytest.raises(ValueError, match="free.*c") as error:
        fit(local_level, dict(Q=1, R=1), NILE, free=("c",))
    assert bilingual(error)


def test_a_fit_prints_no_words():
    found = fit(local_level, dict(Q=1000, R=1000), NILE[1:])
    assert str(found) == repr(found) and "Q = 1469" in str(found) and "±" in str(found) and "ln L = -632.5" in str(found)
    walk = np.cumsum(np.random.default_rng(0).normal(size=200))
    found = fit(lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=0, P0=0), dict(Q=1, R=1), walk)
    assert "R ≤ 1e-12" in str(found)


# --- whiteness ---------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("seed, lags", [(0, None), (1, 5), (2, 20)])
def test_whiteness_is_that_of_statsmodels(seed, lags):
    y = np.random.default_rng(seed).normal(size=120)
    y[1:] += .2 * y[:-1]
    w = whiteness(y, lags)
    box = acorr_ljungbox(y, lags=lags)
    assert np.array_equal(w.lags, box.index)
    assert w.correlation == pytest.approx(acf(y, nlags=len(w.lags))[1:], rel=1e-10)
    assert w.p == pytest.approx(box["lb_pvalue"].iloc[-1], rel=1e-10)
    assert w.band == pytest.approx(1.959963984540054 / np.sqrt(120))


def test_each_sensor_has_its_own_test():
    y = np.random.default_rng(3).normal(size=(200, 2))
    y[1:, 1] += .9 * y[:-1, 1]
    w = whiteness(y)
    alone = [whiteness(column) for column in y.T]
    assert w.correlation.shape == (10, 2) and w.band.shape == w.p.shape == (2,)
    assert w.p == pytest.approx([a.p for a in alone], rel=1e-12) and w.p[0] > 1e-3 and w.p[1] < 1e-6


def test_gaps_leave_the_test_honest():
    """p of white noise with gaps is uniform (Kolmogorov-Smirnov); the band holds 95 % or a little more."""
    p, inside = [], []
    for seed in range(400):
        rng = np.random.default_rng(seed)
        y = rng.normal(size=400)
        y[rng.random(400) < .3] = np.nan
        y[100:150] = np.nan
        w = whiteness(y)
        p.append(w.p)
        inside.append(np.abs(w.correlation) < w.band)
    assert kstest(p, "uniform").pvalue > .01
    assert .94 < np.mean(inside) < .999
    every_other = np.random.default_rng(0).normal(size=200)
    every_other[1::2] = np.nan
    w = whiteness(every_other, 4)
    assert np.isnan(w.correlation[[0, 2]]).all() and np.isfinite(w.correlation[[1, 3]]).all() and 0 < w.p < 1
    half = every_other[::2]                 # lags 2 and 4 are lags 1 and 2 of what was seen
    assert w.p == pytest.approx(acorr_ljungbox(half, lags=[2])["lb_pvalue"].iloc[0], rel=1e-10)


@pytest.mark.parametrize("y", [[], 3.0, [1.0], np.full(50, np.nan), np.ones(50), np.ones((4, 2, 2)), "abc"])
def test_whiteness_of_nothing_says_so(y):
    with pytest.raises(ValueError, match="y") as error:
        whiteness(y)
    assert bilingual(error)


def test_a_filter_with_the_right_model_leaves_white_innovations():
    true = LinearModel(F=1, H=1, Q=.5, R=2, x0=0, P0=1)
    z = simulate(true, 1000, np.random.default_rng(8)).z
    assert whiteness(kalman_filter(true, z).y).p > .01
    assert whiteness(kalman_filter(replace(true, Q=.005), z).y).p < 1e-6


# --- the steady filter ---------------------------------------------------------------------------------------------

def test_the_steady_gain_of_the_random_walk_is_golden():
    s = steady(LinearModel(F=1, H=1, Q=1, R=1, x0=0, P0=1))
    golden = (1 + np.sqrt(5)) / 2
    assert [s.P_pred[0, 0], s.P[0, 0], s.S[0, 0], s.K[0, 0]] == pytest.approx([golden, golden - 1, golden + 1, golden - 1])


@pytest.mark.parametrize("lam", [1e-3, .1, 1, 30])
def test_the_alpha_beta_filter_of_kalata(lam):
    """Tracking index lambda = sigma_w T^2 / sigma_v; alpha and beta in closed form (Kalata, 1984)."""
    r = (4 + lam - np.sqrt(8 * lam + lam ** 2)) / 4
    alpha, beta = 1 - r ** 2, 2 * (2 - (1 - r ** 2)) - 4 * np.sqrt(r ** 2)
    model = LinearModel(F=[[1, 1], [0, 1]], H=[[1, 0]], Q=lam ** 2 * np.array([[.25, .5], [.5, 1]]), R=1, x0=[0, 0],
                        P0=np.eye(2))
    assert steady(model).K[:, 0] == pytest.approx([alpha, beta], rel=1e-7)


@pytest.mark.parametrize("seed", range(5))
def test_the_filter_settles_there(seed):
    rng = np.random.default_rng(seed)
    model = two_sensors(F=rng.normal(size=(2, 2)))
    s, r = steady(model), kalman_filter(model, np.zeros((3000, 2)))
    for mine, last in zip(s, (r.P_pred[-1], r.P[-1], r.S[-1], r.K[-1])):
        assert mine == pytest.approx(last, rel=1e-9, abs=1e-12)
    assert np.array_equal(s.P, s.P.T) and np.array_equal(s.P_pred, s.P_pred.T)


def test_units_do_not_matter():
    Q = discretise([[0, 1], [0, 0]], np.diag([0, 1e-6]), .01)[1]
    model = LinearModel(F=[[1, .01], [0, 1]], H=[[1, 0]], Q=Q, R=1e-2, x0=[0, 0], P0=np.eye(2))
    s, unit = steady(model), np.diag([1e6, 1e-3])
    other = steady(LinearModel(F=unit @ model.F @ np.linalg.inv(unit), H=[[1e-6, 0]], Q=unit @ Q @ unit, R=1e-2, x0=[0, 0],
                               P0=np.eye(2)))
    assert other.P_pred == pytest.approx(unit @ s.P_pred @ unit, rel=1e-6)


@pytest.mark.parametrize("changes, said", [
    (dict(F=1, H=0, Q=1), "Not detectable"),
    (dict(F=[[1, 0], [0, .5]], H=[[0, 1]], Q=np.eye(2)), "Not detectable"),
    (dict(F=1, H=1, Q=0), "no process noise"),
    (dict(F=[[1, .1], [0, 1]], H=[[1, 0]], Q=np.zeros((2, 2))), "no process noise"),
    (dict(F=[[0, 1], [-1, 0]], H=[[1, 0]], Q=np.zeros((2, 2))), "no process noise"),
    (dict(F=1, H=1, Q=1, R=np.ones((5, 1, 1))), "changes in time")])
def test_without_a_steady_state_the_reason_is_told(changes, said):
    n = len(np.atleast_2d(changes["F"]))
    model = LinearModel(**(dict(R=1, x0=np.zeros(n), P0=np.eye(n)) | changes))
    with pytest.raises(ValueError, match=said) as error:
        steady(model)
    assert bilingual(error)


def test_states_that_forget_or_explode_need_no_noise():
    assert steady(LinearModel(F=.5, H=1, Q=0, R=1, x0=0, P0=1)).K == pytest.approx(0)
    assert steady(LinearModel(F=2, H=1, Q=0, R=1, x0=0, P0=1)).P_pred == pytest.approx(3)   # 4 P R / (P + R) = P


def test_a_nonlinear_model_has_no_steady_state():
    with pytest.raises(ValueError, match="LinearModel") as error:
        steady(beetle.model(beetle.Params()))
    assert bilingual(error)


# --- from continuous to discrete -----------------------------------------------------------------------------------

@pytest.mark.parametrize("dt", [1e-4, .1, 1, 250])
def test_constant_velocity_and_acceleration(dt):
    F, Q = discretise([[0, 1], [0, 0]], [[0, 0], [0, 3]], dt)
    assert F == pytest.approx(np.array([[1, dt], [0, 1]]), rel=1e-13, abs=0)
    assert Q == pytest.approx(3 * np.array([[dt ** 3 / 3, dt ** 2 / 2], [dt ** 2 / 2, dt]]), rel=1e-12, abs=0)
    F, Q = discretise(np.eye(3, k=1), np.diag([0, 0, 2]), dt)
    powers = np.array([[5, 4, 3], [4, 3, 2], [3, 2, 1]])
    factors = np.array([[20, 8, 6], [8, 3, 2], [6, 2, 1]])
    assert F == pytest.approx(np.array([[1, dt, dt ** 2 / 2], [0, 1, dt], [0, 0, 1]]), rel=1e-13, abs=0)
    assert Q == pytest.approx(2 * dt ** powers / factors, rel=1e-11, abs=0)
    assert np.array_equal(Q, Q.T)


@pytest.mark.parametrize("a", [1e-9, .3, 50, 1e5])
def test_ornstein_uhlenbeck(a):
    F, Q, B = discretise(-a, 2, .5, Bc=4)
    assert F[0, 0] == pytest.approx(np.exp(-a / 2), rel=1e-9 if a < 100 else 1, abs=1e-300)
    assert Q[0, 0] == pytest.approx(-np.expm1(-a) / a, rel=1e-12)       # 2 (1 - exp(-2 a dt)) / (2 a)
    assert B[0, 0] == pytest.approx(-4 * np.expm1(-a / 2) / a, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_against_the_integrals(seed):
    rng = np.random.default_rng(seed)
    A, G, Bc, dt = rng.normal(size=(3, 3)), rng.normal(size=(3, 2)), rng.normal(size=(3, 2)), .8
    F, Q, B = discretise(A, G @ G.T, dt, Bc)
    assert F == pytest.approx(expm(A * dt), rel=1e-12)
    assert Q == pytest.approx(quad_vec(lambda s: expm(A * s) @ G @ G.T @ expm(A * s).T, 0, dt)[0], rel=1e-9, abs=1e-12)
    assert B == pytest.approx(quad_vec(lambda s: expm(A * s) @ Bc, 0, dt)[0], rel=1e-9, abs=1e-12)
    assert np.linalg.eigvalsh(Q)[0] > -1e-15 and np.array_equal(Q, Q.T)


def test_one_step_after_another_is_one_long_step():
    A, Qc, Bc = np.array([[0, 1], [-4, -.3]]), np.diag([0, .2]), [[0], [1]]
    F, Q, B = discretise(A, Qc, [.1, .25, .1], Bc)
    assert F.shape == Q.shape == (3, 2, 2) and B.shape == (3, 2, 1)
    one = discretise(A, Qc, .25, Bc)
    for several, single in zip((F, Q, B), one):
        assert several[1] == pytest.approx(single, rel=1e-13) and np.array_equal(several[0], several[2])
    whole = discretise(A, Qc, .35, Bc)
    assert F[1] @ F[0] == pytest.approx(whole[0]) and F[1] @ Q[0] @ F[1].T + Q[1] == pytest.approx(whole[1])
    assert F[1] @ B[0] + B[1] == pytest.approx(whole[2])
    assert len(discretise(A, Qc, np.array([.1]))) == 2


@pytest.mark.parametrize("arguments, said", [
    ((np.eye(2), np.eye(3), 1), "Qc"), ((np.ones((2, 3)), np.eye(2), 1), "A"), ((np.eye(2), -np.eye(2), 1), "Qc"),
    ((np.eye(2), np.eye(2), 0), "dt"), ((np.eye(2), np.eye(2), -1), "dt"), ((np.eye(2), np.eye(2), np.nan), "dt"),
    ((np.eye(2), np.eye(2), [.1, 0]), "dt"), ((np.eye(2), np.eye(2), np.ones((2, 2))), "dt"),
    ((np.eye(2), np.eye(2), 1, np.ones((3, 1))), "Bc"), (([[np.nan]], 1, 1), "A"), (("x", 1, 1), "A"), ((1, 1, "s"), "dt")])
def test_discretise_names_what_is_wrong(arguments, said):
    with pytest.raises(ValueError, match=said) as error:
        discretise(*arguments)
    assert bilingual(error)


# --- Jacobians -----------------------------------------------------------------------------------------------------

def bearing(wrong=0.0, sign=1):
    """A turning walker [x, y, angle] and the direction in which it is seen, wrapped in the residual."""
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
    return NonlinearModel(f=f, F=F, h=h, H=H, Q=np.eye(3), R=1, x0=[-3, 1, .5], P0=np.eye(3), residual=residual)


@pytest.mark.parametrize("x", [[-3, 0, .5], [-3, 1e-9, 0], [2e6, -1e6, 3], [1e-3, 1e-3, -np.pi]])
def test_right_jacobians_pass(x):
    found = check_jacobians(bearing(), x)
    assert found.F == pytest.approx(bearing().F(x, None), abs=1e-6)
    assert found.F_error.shape == (3, 3) and found.H_error.shape == (1, 3) and found.F_error.max() < 1e-6
    check_jacobians(bearing(), x, u=np.ones(3))


@pytest.mark.parametrize("d", [10, 1e6, 1e-6])
@pytest.mark.parametrize("theta", [0, 1e-3, .64, 1.5])
def test_the_beetle_far_away_passes(d, theta):
    p = beetle.Params()
    check_jacobians(beetle.model(p), [d, theta, 2.5])
    check_jacobians(beetle.bearing_model(p), [d, theta, 2.5, 3e-7])


@pytest.mark.parametrize("d", [10, 1e6])
@pytest.mark.parametrize("theta", [1e-3, .64, 1.5])
def test_a_wrong_sign_is_found_and_named(d, theta):
    p, x = beetle.Params(), np.array([d, theta, 2.5])
    right = beetle.model(p)
    wrong = replace(right, F=lambda x, u: right.F(x, u) * [[1, -1, 1], [1, 1, 1], [1, 1, 1]])
    given = p.dt * 2.5 * np.sin(theta)
    with pytest.raises(ValueError, match=r"F\[0, 1\]") as error:
        check_jacobians(wrong, x)
    assert bilingual(error) and f"F[0, 1] is {given:.6g}" in str(error.value)
    assert float(str(error.value).split("give ")[1].split(". /")[0]) == pytest.approx(-given, rel=1e-2)


def test_a_forgotten_entry_is_found():
    with pytest.raises(ValueError, match=r"F\[1, 0\].*0\.001") as error:
        check_jacobians(bearing(wrong=1e-3), [-3, 1, .5])
    assert bilingual(error)
    m = bearing()
    with pytest.raises(ValueError, match=r"H\[0, 1\]"):
        check_jacobians(replace(m, H=lambda x, *u: m.H(x) * [1, -1, 1]), [-3, 1, .5])
    with pytest.raises(ValueError, match=r"F\(x, u\)\[2, 2\] is nan"):
        check_jacobians(replace(m, F=lambda x, u: m.F(x, u) * [[1, 1, 1], [1, 1, 1], [1, 1, np.nan]]), [-3, 1, .5])


def test_functions_with_a_border_are_checked_inside_it():
    """log and sqrt at 1e-6: a step of the size 1e-5 would leave where they live."""
    m = NonlinearModel(f=lambda x, u: np.sqrt(x), F=lambda x, u: np.diag(.5 / np.sqrt(x)), h=lambda x, *u: np.log(x),
                       H=lambda x, *u: np.diag(1 / x), Q=np.eye(2), R=np.eye(2), x0=[1, 1], P0=np.eye(2))
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
