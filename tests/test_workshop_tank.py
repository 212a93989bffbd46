"""Is chapter 7 enough for a problem that it does not solve? A tank: its level from the flow and a
float with outliers, built with nothing but what the chapter says. The data is made here."""

import numpy as np
import pytest
from statsmodels.stats.diagnostic import acorr_ljungbox

from kalman_lib import LinearModel, fit, kalman_filter

AREA, STEP = 2.0, 10.0  # m2, s
SIGMA_FLOW, SIGMA_FLOAT = 2e-4, 0.02  # m3/s, m
QUIET, STEPS = 60, 600  # the tap is closed at first
EXCESS = 5e-4  # m3/s, of the flow meter


def tank(seed, excess=0.0):
    """The flow as measured (T,), the float z (T,) with 5 % outliers, the true level (T,)."""
    rng = np.random.default_rng(seed)
    flow = np.where(np.arange(STEPS) // 100 % 2 == 0, 2e-3, -1.5e-3)
    flow[:QUIET] = 0
    truth = 1 + np.cumsum(flow) * STEP / AREA
    z = truth + SIGMA_FLOAT * rng.normal(size=STEPS)
    z += (rng.random(STEPS) < 0.05) * rng.uniform(-0.5, 0.5, STEPS)
    noise = SIGMA_FLOW * rng.normal(size=STEPS)
    noise[:QUIET] = 0  # a closed tap lets nothing through
    return flow + excess + noise, z, truth


def quiet_variance(z):
    """Step 3, with outliers: 1.48 times the median of |z - median|, squared."""
    quiet = z[:QUIET]
    return (1.48 * np.median(np.abs(quiet - np.median(quiet)))) ** 2


def random_walk_with_a_known_input(z):
    """Steps 1 and 2: the level is what is wanted, the flow pushes it and is known, B = dt / area;
    the error of the flow comes in by the same door."""
    B = STEP / AREA
    R = quiet_variance(z)
    return lambda sigma: LinearModel(1, 1, Q=(sigma * B) ** 2, R=R, x0=z[0], P0=R, B=B)


def with_a_bias(z):
    """Case 4: the right flow is u - s, so s gets the column -dt / area."""
    B = STEP / AREA
    R = quiet_variance(z)
    return LinearModel(
        F=[[1, -B], [0, 1]],
        H=[[1, 0]],
        Q=np.diag([(SIGMA_FLOW * B) ** 2, 1e-16]),
        R=R,
        x0=[z[0], 0],
        P0=np.diag([R, 1e-3**2]),
        B=[[B], [0]],
    )


def share_inside(truth, result):
    e = truth[1:] - result.x[:, 0]
    return np.mean(e**2 < 4 * result.P[:, 0, 0])


@pytest.mark.parametrize("seed", range(5))
def test_the_level_is_found_and_the_filter_is_honest(seed):
    u, z, truth = tank(seed)
    build = random_walk_with_a_known_input(z)
    first = kalman_filter(build(1e-3), z[1:], u[1:], gate=0.999)
    clean = np.where(first.gated[:, 0], np.nan, z[1:])
    found = fit(build, {"sigma": 1e-3}, clean, u[1:])
    result = kalman_filter(found.model, z[1:], u[1:], gate=0.999)
    error = np.sqrt(np.mean((truth[1:] - result.x[:, 0]) ** 2))
    assert error < SIGMA_FLOAT / 2
    assert share_inside(truth, result) > 0.85  # of one run, whose errors hang together
    share = (result.y[:, 0] / np.sqrt(result.S[:, 0, 0]))[~result.gated[:, 0]]
    assert 0.55 < np.mean(share**2) < 1.65  # R comes from 60 values: known to a third
    assert acorr_ljungbox(share, lags=[10]).lb_pvalue.iloc[0] > 1e-3


@pytest.mark.parametrize("seed", range(5))
def test_the_bias_of_the_flow_meter_is_found(seed):
    u, z, truth = tank(seed, EXCESS)
    result = kalman_filter(with_a_bias(z), z[1:], u[1:], gate=0.999)
    s, sigma = result.x[-1, 1], np.sqrt(result.P[-1, 1, 1])
    assert abs(s - EXCESS) < 4 * sigma < EXCESS / 3
    blind = kalman_filter(random_walk_with_a_known_input(z)(SIGMA_FLOW), z[1:], u[1:], gate=0.999)
    errors = [np.abs(truth[1:] - r.x[:, 0])[100:].mean() for r in (result, blind)]
    assert errors[0] < errors[1] / 2
