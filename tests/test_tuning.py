"""Whiteness and the steady filter, against statsmodels and closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import kstest
from statsmodels.stats.diagnostic import acorr_ljungbox
from statsmodels.tsa.stattools import acf
from tuning_helpers import bilingual, two_sensors

from kalman_lib import (
    LinearModel,
    discretise,
    kalman_filter,
    steady,
    whiteness,
)
from kalman_lib.papers import beetle
from kalman_lib.simulate import simulate

# --- whiteness ------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed, lags", [(0, None), (1, 5), (2, 20)])
def test_whiteness_is_that_of_statsmodels(seed, lags):
    y = np.random.default_rng(seed).normal(size=120)
    y[1:] += 0.2 * y[:-1]
    w = whiteness(y, lags)
    box = acorr_ljungbox(y, lags=lags)
    assert np.array_equal(w.lags, box.index)
    assert w.correlation == pytest.approx(acf(y, nlags=len(w.lags))[1:], rel=1e-10)
    assert w.p == pytest.approx(box["lb_pvalue"].iloc[-1], rel=1e-10)
    assert w.band == pytest.approx(1.959963984540054 / np.sqrt(120))


def test_each_sensor_has_its_own_test():
    y = np.random.default_rng(3).normal(size=(200, 2))
    y[1:, 1] += 0.9 * y[:-1, 1]
    w = whiteness(y)
    alone = [whiteness(column) for column in y.T]
    assert w.correlation.shape == (10, 2) and w.band.shape == w.p.shape == (2,)
    assert w.p == pytest.approx([a.p for a in alone], rel=1e-12) and w.p[0] > 1e-3 and w.p[1] < 1e-6


def test_gaps_leave_the_test_honest():
    """p of white noise with gaps is uniform (Kolmogorov-Smirnov); the band holds 95 % or more."""
    p, inside = [], []
    for seed in range(400):
        rng = np.random.default_rng(seed)
        y = rng.normal(size=400)
        y[rng.random(400) < 0.3] = np.nan
        y[100:150] = np.nan
        w = whiteness(y)
        p.append(w.p)
        inside.append(np.abs(w.correlation) < w.band)
    assert kstest(p, "uniform").pvalue > 0.01
    assert 0.94 < np.mean(inside) < 0.999
    every_other = np.random.default_rng(0).normal(size=200)
    every_other[1::2] = np.nan
    w = whiteness(every_other, 4)
    assert np.isnan(w.correlation[[0, 2]]).all() and np.isfinite(w.correlation[[1, 3]]).all()
    assert 0 < w.p < 1
    half = every_other[::2]  # lags 2 and 4 are lags 1 and 2 of what was seen
    assert w.p == pytest.approx(acorr_ljungbox(half, lags=[2])["lb_pvalue"].iloc[0], rel=1e-10)


@pytest.mark.parametrize(
    "y", [[], 3.0, [1.0], np.full(50, np.nan), np.ones(50), np.ones((4, 2, 2)), "abc"]
)
def test_whiteness_of_nothing_says_so(y):
    with pytest.raises(ValueError, match="y") as error:
        whiteness(y)
    assert bilingual(error)


def test_a_filter_with_the_right_model_leaves_white_innovations():
    true = LinearModel(F=1, H=1, Q=0.5, R=2, x0=0, P0=1)
    z = simulate(true, 1000, np.random.default_rng(8)).z
    assert whiteness(kalman_filter(true, z).y).p > 0.01
    assert whiteness(kalman_filter(replace(true, Q=0.005), z).y).p < 1e-6


# --- the steady filter ----------------------------------------------------------------------------


def test_the_steady_gain_of_the_random_walk_is_golden():
    s = steady(LinearModel(F=1, H=1, Q=1, R=1, x0=0, P0=1))
    golden = (1 + np.sqrt(5)) / 2
    expected = [golden, golden - 1, golden + 1, golden - 1]
    assert [s.P_pred[0, 0], s.P[0, 0], s.S[0, 0], s.K[0, 0]] == pytest.approx(expected)


@pytest.mark.parametrize("lam", [1e-3, 0.1, 1, 30])
def test_the_alpha_beta_filter_of_kalata(lam):
    """Tracking index lambda = sigma_w T^2 / sigma_v; alpha, beta in closed form (Kalata, 1984)."""
    r = (4 + lam - np.sqrt(8 * lam + lam**2)) / 4
    alpha, beta = 1 - r**2, 2 * (2 - (1 - r**2)) - 4 * np.sqrt(r**2)
    model = LinearModel(
        F=[[1, 1], [0, 1]],
        H=[[1, 0]],
        Q=lam**2 * np.array([[0.25, 0.5], [0.5, 1]]),
        R=1,
        x0=[0, 0],
        P0=np.eye(2),
    )
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
    Q = discretise([[0, 1], [0, 0]], np.diag([0, 1e-6]), 0.01)[1]
    model = LinearModel(F=[[1, 0.01], [0, 1]], H=[[1, 0]], Q=Q, R=1e-2, x0=[0, 0], P0=np.eye(2))
    s, unit = steady(model), np.diag([1e6, 1e-3])
    other = steady(
        LinearModel(
            F=unit @ model.F @ np.linalg.inv(unit),
            H=[[1e-6, 0]],
            Q=unit @ Q @ unit,
            R=1e-2,
            x0=[0, 0],
            P0=np.eye(2),
        )
    )
    assert other.P_pred == pytest.approx(unit @ s.P_pred @ unit, rel=1e-6)


@pytest.mark.parametrize(
    "changes, said",
    [
        (dict(F=1, H=0, Q=1), "Not detectable"),
        (dict(F=[[1, 0], [0, 0.5]], H=[[0, 1]], Q=np.eye(2)), "Not detectable"),
        (dict(F=1, H=1, Q=0), "no process noise"),
        (dict(F=[[1, 0.1], [0, 1]], H=[[1, 0]], Q=np.zeros((2, 2))), "no process noise"),
        (dict(F=[[0, 1], [-1, 0]], H=[[1, 0]], Q=np.zeros((2, 2))), "no process noise"),
        (dict(F=1, H=1, Q=1, R=np.ones((5, 1, 1))), "changes in time"),
    ],
)
def test_without_a_steady_state_the_reason_is_told(changes, said):
    n = len(np.atleast_2d(changes["F"]))
    model = LinearModel(**(dict(R=1, x0=np.zeros(n), P0=np.eye(n)) | changes))
    with pytest.raises(ValueError, match=said) as error:
        steady(model)
    assert bilingual(error)


def test_states_that_forget_or_explode_need_no_noise():
    assert steady(LinearModel(F=0.5, H=1, Q=0, R=1, x0=0, P0=1)).K == pytest.approx(0)
    explodes = steady(LinearModel(F=2, H=1, Q=0, R=1, x0=0, P0=1))
    assert explodes.P_pred == pytest.approx(3)  # 4 P R / (P + R) = P


def test_a_nonlinear_model_has_no_steady_state():
    with pytest.raises(ValueError, match="LinearModel") as error:
        steady(beetle.model(beetle.Params()))
    assert bilingual(error)
