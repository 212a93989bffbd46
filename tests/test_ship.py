"""Chapter 4 against the source's listing, closed forms, NumPy's own fit, filterpy, statsmodels and
SciPy."""

from dataclasses import replace

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from statsmodels.tools.numdiff import approx_hess
from statsmodels.tsa.statespace.sarimax import SARIMAX

from kalman_lib import chi2_bounds, fit, kalman_filter, nees, nis, rmse, rts_smooth
from kalman_lib.papers import ship, smoother

TRUE = ship.Params(
    c=0.03, a1=1.7, a2=-0.72, Q=0.0025, Q_copy=0, R=0.01, x0=1.5
)  # poles 0.9 and 0.8, mean 1.5 m/s


def towing_run(seed=2018, **changes):
    t, run = ship.towing_run(np.random.default_rng(seed), **changes)
    return t, run.z[:, 0], run.x[:, 0]


def filtered(z, p):
    return kalman_filter(ship.model(p), z, u=np.ones(len(z)))


def listing(y):
    """The arithmetic of the source's listing, step by step with its own letters: invented rows,
    inv, predict, update."""
    x1, x2 = np.zeros(len(y)), np.zeros(len(y))
    x1[1] = y[0]
    for k in range(2, len(y)):
        x1[k], x2[k] = y[k - 1], y[k - 2]
    X = np.column_stack([np.ones(len(y)), x1, x2])
    pi = np.linalg.inv(X.T @ X) @ X.T @ y
    Q, R = np.eye(2) * 0.0001, np.eye(1) * 0.01
    A, F, H = np.array([[pi[1], pi[2]], [1, 0]]), np.array([[pi[0]], [0]]), np.array([[1, 0]])
    xmin, Pmin, zest = np.zeros((2, 1)), 0.01 * np.eye(2), []
    for value in y:
        x = A @ xmin + F
        P = A @ Pmin @ A.T + Q
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        x = x + K @ (value - H @ x)
        P = (np.eye(2) - K @ H) @ P
        zest.append((H @ x).item())
        xmin, Pmin = x, P
    return pi, np.array(zest)


# --- the source ---------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_the_source_s_listing_gives_the_same_fit_and_the_same_filtered_speed(seed):
    _, z, _ = towing_run(seed)
    pi, zest = listing(z)
    theta = ship.fit(z, invented_rows=True)
    assert theta == pytest.approx(pi, rel=1e-8)
    p = replace(ship.Params(), c=theta[0], a1=theta[1], a2=theta[2])
    assert np.abs(filtered(z, p).x[:, 0] - zest).max() < 1e-10


def test_the_settings_of_the_source_are_the_defaults():
    m = ship.model(ship.Params())
    assert (
        np.array_equal(m.Q, 0.0001 * np.eye(2))
        and np.array_equal(m.R, [[0.01]])
        and np.array_equal(m.H, [[1, 0]])
    )
    assert np.array_equal(m.x0, [0, 0]) and np.array_equal(m.P0, 0.01 * np.eye(2))
    assert [float(word) for word in ship.PRINTED["Q"].split()] == list(m.Q.ravel())
    _, z, _ = towing_run()
    assert ship.fit(z) == pytest.approx([m.B[0, 0], *m.F[0]], abs=5e-5)  # rounded to four digits


def test_filterpy_gives_the_same_filter():
    _, z, _ = towing_run()
    m = ship.model(ship.Params())
    peer = KalmanFilter(dim_x=2, dim_z=1, dim_u=1)
    peer.x, peer.P, peer.F, peer.B, peer.H, peer.Q, peer.R = (
        m.x0[:, np.newaxis],
        m.P0,
        m.F,
        m.B,
        m.H,
        m.Q,
        m.R,
    )
    x, P, _, _ = peer.batch_filter(z, us=np.ones(len(z)))
    result = filtered(z, ship.Params())
    assert np.abs(result.x - x[..., 0]).max() < 1e-10 and np.abs(result.P - P).max() < 1e-10


def test_the_recipe_is_what_the_run_does():
    t, z, x = towing_run(sigma=0)
    assert np.array_equal(z, x) and len(x) == 360 and t[-1] == pytest.approx(35.9)
    assert (
        x[t < 5] == pytest.approx(0)
        and x[(t > 11.01) & (t < 25)] == pytest.approx(1.5)
        and x[t > 31.01] == pytest.approx(0)
    )
    assert x[np.searchsorted(t, 8 - 1e-9)] == pytest.approx(0.75)  # half way up the half cosine
    noisy = np.concatenate([towing_run(seed)[1] - x for seed in range(30)])
    assert noisy.std() == pytest.approx(0.1, rel=0.03) and abs(noisy.mean()) < 0.004


# --- least squares and its bias -----------------------------------------------------------------


def test_least_squares_finds_an_exact_recursion():
    z = [0.3, 1.1]
    for _ in range(30):
        z.append(0.2 + 0.5 * z[-1] + 0.3 * z[-2])
    assert ship.fit(z) == pytest.approx([0.2, 0.5, 0.3], abs=1e-8)
    z[10] = np.nan
    assert ship.fit(z) == pytest.approx([0.2, 0.5, 0.3], abs=1e-8)


def test_poles_are_the_eigenvalues_of_F():
    for a1, a2 in ((1.7, -0.72), (1.6, -0.8), (0.55, 0.44), (0, 0), (2, -1)):
        eigenvalues = np.linalg.eigvals([[a1, a2], [1, 0]])
        assert np.sort_complex(ship.poles(a1, a2)) == pytest.approx(
            np.sort_complex(eigenvalues), abs=1e-7
        )
    assert ship.poles(1.7, -0.72) == pytest.approx([0.9, 0.8])


@pytest.mark.parametrize("sigma", [0.01, 0.05, 0.1, 0.2])
def test_the_bias_is_that_of_errors_in_variables(sigma):
    x = towing_run()[2]
    fits = np.array([ship.fit(towing_run(seed, sigma=sigma)[1]) for seed in range(300)])
    spread = fits.std(axis=0) / np.sqrt(len(fits))
    assert (
        np.abs(fits.mean(axis=0) - ship.expected_fit(x, sigma))[1:] < 4 * spread[1:] + 0.006
    ).all()


def test_the_bias_has_the_textbook_form_for_a_stationary_speed():
    """a = (Gamma + sigma^2 I)^-1 gamma, with the autocovariances of an AR(2) from the Yule-Walker
    equations."""
    a1, a2, q, R = TRUE.a1, TRUE.a2, TRUE.Q, TRUE.R
    g0 = q * (1 - a2) / ((1 + a2) * ((1 - a2) ** 2 - a1**2))
    g1 = a1 * g0 / (1 - a2)
    g2 = a1 * g1 + a2 * g0
    theory = np.linalg.solve([[g0 + R, g1], [g1, g0 + R]], [g1, g2])
    z = ship.simulate(TRUE, np.random.default_rng(0), 40_000).z[:, 0]
    assert ship.fit(z)[1:] == pytest.approx(theory, abs=0.02)
    assert theory[0] < 0.8  # the true one is 1.7


def test_invented_rows_hurt_a_recording_that_starts_in_motion():
    """Cut the rest and the acceleration off: the invented zeros are 1.5 m/s wrong and move every
    coefficient."""
    runs = [towing_run(seed)[1] for seed in range(40)]
    shift = np.array([ship.fit(z[150:], invented_rows=True) - ship.fit(z[150:]) for z in runs])
    assert (np.abs(shift.mean(axis=0)) > 4 * shift.std(axis=0) / np.sqrt(len(runs))).all()
    assert shift.mean(axis=0)[1] > 0.1 and shift.mean(axis=0)[2] < -0.1
    whole = np.array([ship.fit(z, invented_rows=True) - ship.fit(z) for z in runs])
    assert np.abs(whole).max() < 0.01  # at rest the zeros are nearly right


@pytest.mark.parametrize("z", [np.ones(50), [1.0, 2.0, 3.0], [], [np.nan] * 9])
def test_a_fit_of_nothing_says_so(z):
    with pytest.raises(ValueError, match="do not lie on a line"):
        ship.fit(z)


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
    z = ship.simulate(TRUE, np.random.default_rng(4), 200).z[:, 0]
    p = ship.fitted(z, replace(TRUE, Q=0.01, R=0.01))
    quick = ship.most_likely(z, p)
    start = {name: getattr(p, name) for name in NAMES}
    found = fit(
        lambda **values: ship.model(replace(p, **values)), start, z, u=np.ones(200), free=NAMES[:3]
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


# --- readers' recordings ------------------------------------------------------------------------


def test_units_by_their_definitions():
    assert ship.SPEED_UNITS["kn"] * 3600 == pytest.approx(1852) and ship.SPEED_UNITS[
        "km/h"
    ] * 3.6 == pytest.approx(1)
    assert ship.SPEED_UNITS["cm/s"] == 0.01 and ship.TIME_UNITS == {"s": 1, "ms": 0.001, "min": 60}


def test_even_and_uneven_sampling_are_told():
    even = ship.sampling(np.round(np.arange(100) * 0.1, 2))
    assert (
        not even.uneven
        and even.dt == pytest.approx(0.1)
        and "0.1 s" in even.en
        and "0,1 s" in even.id
    )
    t = np.arange(100) * 0.1
    t[50:] += 0.35
    uneven = ship.sampling(t)
    assert uneven.uneven and uneven.dt == pytest.approx(0.1)
    assert (
        "1 of 99" in uneven.en
        and "0.45" in uneven.en
        and "1 dari 99" in uneven.id
        and "0,45" in uneven.id
    )
    assert uneven.en.count(". ") == uneven.id.count(". ") == 0  # one sentence


@pytest.mark.parametrize(
    "t, said",
    [
        ([0, 1, 2, 2, 3], "row 4"),
        ([0, 1, 3, 2, 5], "row 4"),
        ([0, 1, np.nan, 3, 4], "gap"),
        ([0, 1], "five"),
    ],
)
def test_a_time_column_that_cannot_be_one(t, said):
    with pytest.raises(ValueError, match=said) as error:
        ship.sampling(t)
    assert " / " in str(error.value)


def test_a_model_that_overflows_has_no_likelihood():
    z = np.r_[1.0, 2.0, np.full(400, np.nan), 1.0]
    assert ship.log_likelihood(z, ship.Params(a1=50.0)) == -np.inf
