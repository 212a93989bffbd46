"""Chapter 2 against the 16 printed values, closed forms, statsmodels and the textbook Nile
result."""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from statsmodels.tsa.statespace.structural import UnobservedComponents

from kalman_lib import LinearModel, kalman_filter, log_likelihood, rts_smooth
from kalman_lib.papers import smoother

# Figure 3 of the paper, typed from the page; each output rounded to the digits printed
Z = [
    -0.39,
    -0.49,
    -0.48,
    -0.3,
    -0.25,
    -0.31,
    -0.33,
    -0.48,
    -0.41,
    -0.44,
    -0.38,
    -0.36,
    -0.42,
    -0.44,
    -0.51,
    -0.28,
]
PRINTED = [
    "-0.389996",
    "-0.456665",
    "-0.471249",
    "-0.365238",
    "-0.294",
    "-0.303889",
    "-0.320027",
    "-0.418896",
    "-0.413398",
    "-0.429839",
    "-0.399037",
    "-0.374911",
    "-0.402777",
    "-0.425782",
    "-0.477832",
    "-0.355565",
]


def filtered(z, **changes):
    return kalman_filter(smoother.model(smoother.Params(**changes)), z)


def test_the_paper_s_table_to_every_printed_digit():
    x = filtered(Z).x[:, 0]
    assert [f"{value:.6f}".rstrip("0") for value in x] == PRINTED
    assert np.array_equal(smoother.MEASURED, Z) and [
        value.rstrip("0") for value in smoother.PRINTED.split()
    ] == [value.rstrip("0") for value in PRINTED]


def test_the_R_of_the_text_cannot_have_made_the_table():
    x = filtered(Z, R=1e-3).x[:, 0]
    assert np.abs(x - smoother.FILTERED).max() > 0.05


def test_recovering_the_hidden_parameters():
    """q = Q / R from the later gains, P0 / R from the first output, to what six printed digits
    allow."""
    K, P_pred, q = smoother.recover(smoother.MEASURED, smoother.FILTERED)
    assert np.abs(q - 1).max() < 2e-4
    assert K[-1] == pytest.approx((np.sqrt(5) - 1) / 2, abs=1e-4)  # golden ratio
    fibonacci = [2 / 3, 5 / 8, 13 / 21, 34 / 55]
    assert K[1:5] == pytest.approx(fibonacci, abs=5e-5)
    low, high = 1 / (0.39 - 0.3899955) * 0.39 - 1, 1 / (0.39 - 0.3899965) * 0.39 - 1
    assert low < P_pred[0] < high and low < 1 / 1e-5 < high  # P0 / R = 100,000 lies inside


def test_filterpy_gives_the_same_table():
    peer = KalmanFilter(dim_x=1, dim_z=1)
    peer.F = peer.H = np.eye(1)
    peer.Q, peer.R, peer.x, peer.P = np.eye(1) * 1e-5, np.eye(1) * 1e-5, np.zeros(1), np.eye(1)
    x, _, _, _ = peer.batch_filter(Z)
    assert np.abs(filtered(Z).x - x).max() < 1e-14


@pytest.mark.parametrize("q", [1e-12, 1e-4, 0.01, 1, 100, 1e12])
def test_steady_gain_is_where_the_filter_settles(q):
    K = smoother.steady_gain(q)
    assert K * K / (1 - K) == pytest.approx(q, rel=1e-9) if q < 1e6 else K == pytest.approx(1)
    if q >= 1e-4:
        result = filtered(np.zeros(2000), Q=min(q, 1.0), R=min(q, 1.0) / q)
        assert result.K[-1, 0, 0] == pytest.approx(K, rel=1e-9)


def test_facts_about_the_paper_s_settings():
    assert smoother.steady_gain(0.01) == pytest.approx(0.0951, abs=5e-5)
    assert smoother.equal_window(smoother.steady_gain(0.01)) == pytest.approx(20, abs=0.05)
    assert smoother.steady_gain(1) == pytest.approx(0.618034, abs=5e-7)


def test_equal_window_means_equal_noise():
    rng = np.random.default_rng(0)
    noise = rng.normal(size=400_000)
    K = smoother.steady_gain(0.01)
    n = round(smoother.equal_window(K))
    a, b = smoother.exponential(noise, K)[1000:], smoother.moving_average(noise, n)[1000:]
    assert a.std() == pytest.approx(b.std(), rel=0.03)
    assert b.std() == pytest.approx(1 / np.sqrt(n), rel=0.03)


def test_the_settled_filter_is_exponential_smoothing():
    rng = np.random.default_rng(1)
    z = rng.normal(size=300)
    x = filtered(z, Q=0.01, R=1, x0=z[0], P0=10).x[:, 0]
    K = smoother.steady_gain(0.01)
    twin = smoother.exponential(np.concatenate(([x[99]], z[100:])), K)[1:]
    assert np.abs(twin - x[100:]).max() < 1e-8


def test_moving_average_by_its_definition_and_with_gaps():
    z = np.random.default_rng(2).normal(size=50)
    assert smoother.moving_average(z, 5) == pytest.approx([
        z[max(0, k - 4) : k + 1].mean() for k in range(50)
    ])
    assert smoother.moving_average(np.array([1.0, 2, 6]), 9) == pytest.approx([1, 1.5, 3])
    assert smoother.moving_average(np.array([np.nan, 2, np.nan, 6]), 2) == pytest.approx(
        [np.nan, 2, 2, 6], nan_ok=True
    )


def test_lag_finds_a_known_shift_and_the_ramp_lag_of_both_filters():
    t = np.arange(400)
    wave = np.sin(t / 15)
    assert smoother.lag(np.roll(wave, 7), wave) == pytest.approx(7, abs=0.05)
    ramp, K = t.astype(float), 0.2
    # on a ramp, exponential smoothing runs (1 - K) / K samples late, a window of n runs (n - 1) / 2
    # late
    assert ramp[-1] - smoother.exponential(ramp, K)[-1] == pytest.approx((1 - K) / K, rel=1e-9)
    assert ramp[-1] - smoother.moving_average(ramp, 9)[-1] == pytest.approx(4)


def test_likelihood_is_statsmodels_likelihood():
    z = (
        np.cumsum(np.random.default_rng(3).normal(size=80))
        + np.random.default_rng(4).normal(size=80) * 2
    )
    z[[10, 11, 40]] = np.nan
    theirs = UnobservedComponents(z[1:], "llevel")
    theirs.ssm.initialize_known(
        np.array([z[0]]), np.array([[2.0 + 0.7]])
    )  # before z_1: x = z_0, P = R + Q
    theirs.loglikelihood_burn = 0
    assert smoother.log_likelihood(z, 0.7, 2.0) == pytest.approx(
        theirs.loglike([2.0, 0.7]), rel=1e-9
    )


def test_the_map_of_the_likelihood_is_the_likelihood_of_each_filter():
    z = np.cumsum(np.random.default_rng(7).normal(size=50))
    z[[0, 20, 21]] = np.nan
    Q, R = np.array([0.1, 3.0]), np.array([2.0, 1e-3])
    each = [
        log_likelihood(kalman_filter(LinearModel(F=1, H=1, Q=q, R=r, x0=z[1], P0=r), z[2:]))
        for q, r in zip(Q, R)
    ]
    assert smoother.log_likelihood(z, Q, R) == pytest.approx(each, rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_the_quick_filter_equals_the_reference(seed):
    rng = np.random.default_rng(seed)
    z = rng.normal(size=300).cumsum()
    z[rng.random(300) < 0.2] = np.nan
    p = smoother.Params(*10 ** rng.uniform(-6, 2, 2), x0=rng.normal(), P0=rng.choice([0, 1.0, 1e6]))
    result = kalman_filter(smoother.model(p), z)
    expected = result.x[:, 0], result.P[:, 0, 0], result.K[:, 0, 0], rts_smooth(result).x[:, 0]
    for mine, reference in zip(smoother.scalar_filter(z, p), expected):
        assert mine == pytest.approx(reference, rel=1e-12, abs=1e-12)


def test_the_quick_filter_takes_a_list():
    p = smoother.Params(Q=1, R=1, x0=0, P0=1)
    assert smoother.scalar_filter([1.0, 2.0], p)[0] == pytest.approx(
        [2 / 3, 2 / 3 + 5 / 8 * 4 / 3], rel=1e-14
    )


def test_maximum_likelihood_on_the_nile():
    """Durbin and Koopman, Time Series Analysis by State Space Methods, 2.10.3, print 15,099 and
    1,469.1.

    The likelihood is so flat that their search stopped 0.08 short in Q; ours must be at least as
    likely."""
    from statsmodels.datasets import nile

    z = nile.load_pandas().data["volume"].to_numpy()
    Q, R = smoother.maximum_likelihood(z)
    assert f"{R:.0f}" == "15099" and abs(Q - 1469.1) < 0.1
    assert smoother.log_likelihood(z, Q, R) >= smoother.log_likelihood(z, 1469.1, 15099)


@pytest.mark.parametrize("z", [np.ones(20), np.arange(10.0), [1.0, 2.0], [np.nan, np.nan]])
def test_maximum_likelihood_needs_steps_that_differ(z):
    with pytest.raises(ValueError, match="at least three values"):
        smoother.maximum_likelihood(z)


@pytest.mark.parametrize("seed", range(6))
def test_maximum_likelihood_of_steady_data_finds_the_noise(seed):
    z = np.random.default_rng(seed).normal(5, 0.01, 100)
    Q, R = smoother.maximum_likelihood(z)
    assert Q >= 0 and R == pytest.approx(1e-4, rel=0.5)


def test_rivals_at_the_edges():
    assert smoother.exponential([np.nan, 2, 4], 0.5) == pytest.approx([np.nan, 2, 3], nan_ok=True)
    assert smoother.steady_gain(0) == 0
    large = 1e9 + np.arange(10.0)
    assert np.array_equal(smoother.moving_average(large, 2)[1:], large[1:] - 0.5)
    assert np.isnan(smoother.lag(np.ones(20), np.ones(20))) and np.isnan(
        smoother.lag([1.0, 2], [1.0, 2])
    )


def test_the_start_cannot_be_recovered():
    """x0 = 1 with P0 = 3.475 prints the same table, and so does any common factor of Q, R and
    P0."""
    for changes in (dict(x0=1, P0=3.475), dict(Q=1e-3, R=1e-3, P0=100)):
        assert [f"{value:.6f}".rstrip("0") for value in filtered(Z, **changes).x[:, 0]] == PRINTED


def test_R_from_a_steady_stretch():
    z = 3 + np.random.default_rng(5).normal(0, 0.2, 5000)
    assert smoother.R_from_steady(z) == pytest.approx(0.04, rel=0.06)


@pytest.mark.parametrize(
    "make, sigma",
    [(smoother.silkworm_room, 0.3), (smoother.cutting_force, 1.5), (smoother.tank_level, 0.4)],
)
def test_look_alikes_have_the_noise_they_claim(make, sigma):
    t = make(np.random.default_rng(6), steps=4000)
    assert (t.z - t.x).std() == pytest.approx(sigma, rel=0.05)
