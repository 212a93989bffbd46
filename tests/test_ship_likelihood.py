"""Chapter 4: the likelihood, the remedy and the filter that knows the truth."""

from dataclasses import replace

import numpy as np
import pytest
from ship_cases import TRUE, filtered, towing_run
from statsmodels.tools.numdiff import approx_hess
from statsmodels.tsa.statespace.sarimax import SARIMAX

from kalman_lib import chi2_bounds, fit, nees, nis, rmse, rts_smooth
from kalman_lib.papers import ship, smoother

# --- the likelihood and the remedy --------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_the_quick_filter_equals_the_reference(seed):
    rng = np.random.default_rng(seed)
    p = replace(
        TRUE, R=10 ** rng.uniform(-4, 0), Q_copy=rng.choice([0, 1e-4]), P0=rng.choice([0, 0.01, 10])
    )
    z = ship.simulate(p, rng, 400).z[:, 0]
    z[rng.random(400) < 0.05] = np.nan
    z[200:230] = np.nan
    result = filtered(z, p)
    for mine, reference in zip(
        ship.quick_filter(z, p),
        (result.x[:, 0], result.P[:, 0, 0], result.y[:, 0], result.S[:, 0, 0]),
    ):
        assert mine == pytest.approx(reference, rel=1e-11, abs=1e-12, nan_ok=True)


def test_likelihood_is_statsmodels_likelihood():
    p = replace(TRUE, P0=0.3)
    z = ship.simulate(p, np.random.default_rng(1), 200).z[:, 0]
    z[[50, 51, 120]] = np.nan
    theirs = SARIMAX(
        z - 1.5, order=(2, 0, 0), measurement_error=True
    )  # 1.5 = c / (1 - a1 - a2), without constant
    F = np.array([[p.a1, 1], [p.a2, 0]])  # their state: [s_k, a2 s_{k-1}]
    T = np.array([[1, 0], [0, p.a2]])  # theirs = T ours
    m = ship.model(p)
    theirs.ssm.initialize_known(
        np.zeros(2), T @ (m.F @ m.P0 @ m.F.T + m.Q) @ T.T
    )  # before the first update
    theirs.loglikelihood_burn = 0
    assert np.allclose(T @ m.F @ np.linalg.inv(T), F)
    assert ship.log_likelihood(z, p) == pytest.approx(
        theirs.loglike([p.a1, p.a2, p.R, p.Q]), rel=1e-8
    )


SMOOTH = dict(c=0, a1=1.8, a2=-0.81, Q=1e-4, R=0.01)  # a start with both poles at 0.9


NAMES = ("c", "a1", "a2", "Q", "R")


def most_likely(z, p, *more):
    """The best of the searches that start at the biased fit and at each of the other starts."""
    starts = [ship.fitted(z, replace(p, Q=0.01, R=0.01)), *(replace(p, **start) for start in more)]
    return max(
        (ship.most_likely(z, start) for start in starts), key=lambda found: found.log_likelihood
    )


def test_maximum_likelihood_recovers_the_true_coefficients_on_100_seeds():
    """Inside +-2 standard errors lie 95.4 % of the time; 87 of 100 or fewer happen once in 1,000
    tests."""
    scaled, biased = [], []
    for seed in range(100):
        z = ship.simulate(TRUE, np.random.default_rng(seed), 500).z[:, 0]
        found = most_likely(z, TRUE)
        scaled.append(
            [(found.values[name] - getattr(TRUE, name)) / found.errors[name] for name in NAMES[:3]]
            + [
                np.log(found.values[name] / getattr(TRUE, name))
                / (found.errors[name] / found.values[name])
                for name in NAMES[3:]
            ]
        )
        biased.append(ship.fit(z))
    inside = (np.abs(scaled) < 2).sum(axis=0)
    assert (inside >= 88).all() and (np.abs(np.mean(scaled, axis=0)) < 0.4).all()
    assert (0.8 < np.std(scaled, axis=0)).all() and (np.std(scaled, axis=0) < 1.25).all()
    assert (
        np.max(biased, axis=0)[1] < 1.1 and np.min(biased, axis=0)[2] > -0.3
    )  # never near 1.7 and -0.72


def test_standard_errors_come_from_the_curvature():
    """Against the Hessian of statsmodels, which differentiates in its own way."""
    z = ship.simulate(TRUE, np.random.default_rng(3), 500).z[:, 0]
    found = most_likely(z, TRUE)
    v = np.array([found.values[name] for name in NAMES])

    def cost(v):
        return -ship.log_likelihood(z, replace(TRUE, **dict(zip(NAMES, v))))

    theirs = np.sqrt(np.diag(np.linalg.inv(approx_hess(v, cost))))
    assert [found.errors[name] for name in NAMES] == pytest.approx(theirs, rel=0.01)


def test_the_general_fit_finds_the_same_maximum():
    z = ship.simulate(TRUE, np.random.default_rng(4), 80).z[:, 0]
    p = ship.fitted(z, replace(TRUE, Q=0.01, R=0.01))
    quick = ship.most_likely(z, p)
    start = {name: getattr(p, name) for name in NAMES}
    found = fit(
        lambda **values: ship.model(replace(p, **values)), start, z, u=np.ones(80), free=NAMES[:3]
    )
    assert found.log_likelihood == pytest.approx(quick.log_likelihood, abs=1e-6)
    assert found.values == pytest.approx(quick.values, rel=1e-3) and found.errors == pytest.approx(
        quick.errors, rel=1e-2
    )


def test_the_quick_filter_settles_when_nothing_is_left_to_come():
    """a2 = 0 is an AR(1): five thousand steps of the scalar filter, one after the other, in long
    double."""
    p = ship.Params(c=0, a1=0.999, a2=0, Q=1e-9, Q_copy=0, R=1e4, P0=0)
    x = P = np.longdouble(0)
    for _ in range(5000):
        P_pred = np.longdouble(0.999) ** 2 * P + np.longdouble(1e-9)
        K = P_pred / (P_pred + 10_000)
        x, P = np.longdouble(0.999) * x + K * (1000 - np.longdouble(0.999) * x), (1 - K) * P_pred
    quick = ship.quick_filter(np.full(5000, 1000.0), p)
    assert quick[0][-1] == pytest.approx(float(x), rel=1e-11) and float(x) == pytest.approx(
        4.94e-5, rel=1e-3
    )
    assert quick[1][-1] == pytest.approx(float(P), rel=1e-11)


# --- the filter told the truth; larger R; the smoother ------------------------------------------


def test_a_filter_with_the_true_model_is_consistent():
    runs = [ship.simulate(TRUE, np.random.default_rng(seed), 200) for seed in range(40)]
    results = [filtered(run.z, TRUE) for run in runs]
    e = np.mean([nees(run.x, r.x, r.P)[50:].mean() for run, r in zip(runs, results)])
    i = np.mean([nis(r.y, r.S).mean() for r in results])
    assert e == pytest.approx(
        2, abs=0.15
    )  # neighbouring NEES values are not independent, so no chi-square here
    low, high = chi2_bounds(1, runs=40 * 200, probability=0.999)
    assert low < i < high


def test_larger_R_is_smoother_and_later():
    _, z, x = towing_run()
    estimates = [filtered(z, ship.Params(R=R)).x[:, 0] for R in (0.001, 0.01, 0.1)]
    steps, lags = [np.std(np.diff(e)) for e in estimates], [smoother.lag(e, x) for e in estimates]
    assert steps[0] > 1.5 * steps[1] > 2 * steps[2] and lags[0] + 4 < lags[1] < lags[2] - 8


def test_with_the_source_s_settings_our_run_becomes_worse_and_the_remedies_help():
    _, z, x = towing_run()
    p = ship.Params()
    p_likely = replace(p, Q_copy=0, **most_likely(z, p, SMOOTH).values)
    source, likely = filtered(z, p), filtered(z, p_likely)
    raw, worse, better, best = (
        rmse(x, e) for e in (z, source.x[:, 0], likely.x[:, 0], rts_smooth(likely).x[:, 0])
    )
    assert worse > 1.5 * raw and better < 0.6 * raw and best < 0.75 * better
    assert abs(smoother.lag(rts_smooth(likely).x[:, 0], x)) < 1 < smoother.lag(source.x[:, 0], x)
    assert p_likely.R == pytest.approx(0.01, rel=0.2)  # the noise that was put in
