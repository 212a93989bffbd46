"""Chapter 4 against the source's listing, closed forms, NumPy's own fit, filterpy, statsmodels and
SciPy."""

from dataclasses import replace

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from ship_cases import TRUE, filtered, listing, towing_run

from kalman_lib.papers import ship

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
