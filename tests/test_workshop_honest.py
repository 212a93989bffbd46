"""Chapter 7: in many runs, the bands of its filters hold what they promise."""

import functools

import numpy as np
import pytest
from scipy.stats import chi2
from workshop_peers import run_case

from kalman_lib import kalman_filter

case = functools.cache(run_case)


def last_nees(e, P):
    """Of (n, runs) errors: their mean, and what chi-square allows it once in a thousand."""
    n, runs = e.shape
    mean = np.einsum("ir,ij,jr->r", e, np.linalg.inv(P), e).mean()
    return chi2.ppf(0.0005, n * runs) / runs < mean < chi2.ppf(0.9995, n * runs) / runs


def made_up(model, runs, rng, x0, u=None):
    """Truth (T, n, runs) and measurements (T, m, runs) of a model with F, Q (T, ., .) or (., .),
    written down once more."""
    T = len(model.F) if model.F.ndim == 3 else len(u)
    x, truth, z = x0, [], []
    for k in range(T):
        F, Q = (M[k] if M.ndim == 3 else M for M in (model.F, model.Q))
        values, vectors = np.linalg.eigh(Q)
        root = vectors * np.sqrt(np.maximum(values, 0))
        B_u = 0 if u is None else model.B * u[k]
        x = F @ x + B_u + root @ rng.normal(size=x.shape)
        noise = np.sqrt(np.diag(model.R))[:, np.newaxis] * rng.normal(size=(len(model.R), runs))
        truth.append(x)
        z.append(model.H @ x + noise)
    return np.array(truth), np.array(z)


def first_states(model, runs, rng):
    sigma = np.sqrt(np.diag(model.P0))[:, np.newaxis]
    return model.x0[:, np.newaxis] + sigma * rng.normal(size=(len(sigma), runs))


def test_the_bus_is_honest_in_many_runs():
    c, rng, runs = case("bus"), np.random.default_rng(71), 300
    model = c.bus(0.2)
    truth, z = made_up(model, runs, rng, first_states(model, runs, rng))
    z[c.silent, 1] = np.nan
    result = kalman_filter(model, z)
    for k in (0, 50, 199):
        assert last_nees(truth[k] - result.x[k], result.P[k])


def test_gps_and_accelerometer_are_honest_in_many_runs():
    c, rng, runs = case("gps"), np.random.default_rng(74), 100
    truth, z = made_up(c.car, runs, rng, first_states(c.car, runs, rng), c.u)
    z[c.k % 100 != 99] = np.nan
    result = kalman_filter(c.car, z, c.u)
    for k in (99, 2999, 5999):
        assert last_nees(truth[k] - result.x[k], result.P[k])


def test_the_battery_is_honest_in_many_runs():
    c, rng, runs = case("battery"), np.random.default_rng(73), 60
    model = c.battery(0.8, 0.1**2)
    errors = []
    for _ in range(runs):
        x = 0.8 + 0.1 * rng.normal()
        drawn = 10 * (c.u[:200] + 0.05 * rng.normal(size=200)) / 7200
        truth = x - np.cumsum(drawn)
        z = 3.2 + 1.5 * truth - 1.3 * truth**2 + 0.8 * truth**3 - 0.1 * c.u[:200]
        result = kalman_filter(model, z + 0.02 * rng.normal(size=200), c.u[:200])
        errors.append(truth[-1] - result.x[-1])
    assert last_nees(np.array(errors).T, result.P[-1])


def test_the_gate_keeps_the_thermometer_honest_in_many_runs():
    c, rng = case("room"), np.random.default_rng(72)
    inside, without = [], []
    for _ in range(30):
        truth = 25 + np.cumsum(0.05 * rng.normal(size=600))
        z = truth + 0.3 * rng.normal(size=600)
        z += (rng.random(600) < 0.05) * 10 * rng.normal(size=600)
        for share, gate in ((inside, 0.999), (without, None)):
            result = kalman_filter(c.room, z, gate=gate)
            e = truth - result.x[:, 0]
            share.append(np.mean(e**2 < 4 * result.P[:, 0, 0]))
    assert np.mean(inside) == pytest.approx(0.95, abs=0.02)
    assert np.mean(without) < 0.7
