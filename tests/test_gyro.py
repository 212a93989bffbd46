"""Chapter 3 against what the paper prints, its program typed from the page, closed forms and
filterpy."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from gyro_cases import PAPER, RUNS, case, fly

from kalman_lib import chi2_bounds, kalman_filter, nees, nis
from kalman_lib.papers import gyro


def the_paper_s_program(z, x_hat, u=1.0, dt=0.1, process=10.0, measurement=10.0):
    """The listing of the paper in its order, correct then predict, with K computed before it is
    used."""
    Rk, Qk = measurement**2, process**2 * dt**2
    P, estimates = Qk, []
    for y in z:
        Inn = y - x_hat
        s = P + Rk
        K = P / s
        x_hat, P = x_hat + K * Inn, P - K * P
        estimates.append((x_hat, P, K))
        x_hat, P = x_hat + dt * u, P + Qk
    return np.array(estimates).T


def test_the_paper_s_cases_and_defaults():
    assert {
        figure: (*gyro.CASES[figure], *map(float, gyro.PRINTED[figure].split()))
        for figure in gyro.CASES
    } == PAPER
    p = gyro.Params()
    m = gyro.model(p)
    assert (p.duration, p.T, p.u) == (20, 0.1, 1) and len(gyro.times(p)) == 200
    assert (m.F, m.B, m.H, m.x0) == (1, 0.1, 1, 0)
    assert m.Q == pytest.approx(10**2 * 0.1**2) and m.R == 10**2
    assert gyro.times(p)[[0, -1]] == pytest.approx([0.1, 20])


@pytest.mark.parametrize("figure", PAPER)
def test_correct_first_and_predict_first_are_one_filter(figure):
    """The program starts at the predicted angle T u, or, as it is printed, one T u too low; P
    starts at Q."""
    p = case(figure)
    flight, result = fly(p, seed=1)
    printed = dict(u=1.0, dt=0.1, process=p.sigma_w, measurement=p.sigma_v)
    x, P, K = the_paper_s_program(flight.z[:, 0], 0.1, **printed)
    for theirs, ours in ((x, result.x[:, 0]), (P, result.P[:, 0, 0]), (K, result.K[:, 0, 0])):
        assert theirs == pytest.approx(ours, rel=1e-11)
    x, _, _ = the_paper_s_program(flight.z[:, 0], 0.0, **printed)
    late = replace_x0(gyro.model(p), -0.1)
    assert x == pytest.approx(kalman_filter(late, flight.z, flight.u).x[:, 0], rel=1e-11)
    K = result.K[:, 0, 0]  # what is left of the slip of 0.1 rad after every correction
    assert result.x[:, 0] - x == pytest.approx(0.1 * np.cumprod(1 - K), abs=1e-11)


def replace_x0(m, x0):
    return replace(m, x0=np.array([x0]))


def test_the_first_gains_by_hand():
    """Figure 5: Q = R = 1 and P0 = 0 give 1/2, 3/5, 8/13, 21/34: Fibonacci again."""
    _, result = fly(case(5))
    assert result.K[:4, 0, 0] == pytest.approx([1 / 2, 3 / 5, 8 / 13, 21 / 34], rel=1e-12)
    assert result.P[:2, 0, 0] == pytest.approx([1 / 2, 3 / 5], rel=1e-12)


@pytest.mark.parametrize("figure", PAPER)
def test_steady_state(figure):
    p = replace(case(figure), duration=60)
    _, result = fly(p)
    K, sigma = gyro.steady(p)
    assert result.K[-1, 0, 0] == pytest.approx(K, rel=1e-4) and np.sqrt(
        result.P[-1, 0, 0]
    ) == pytest.approx(sigma, rel=1e-4)
    q = (p.sigma_w * p.T / p.sigma_v) ** 2
    assert K * K + q * K - q == pytest.approx(0, abs=1e-12)
    if q <= 0.01:
        assert sigma == pytest.approx(np.sqrt(p.sigma_w * p.sigma_v * p.T), rel=0.03)


def test_process_noise_matters_as_much_as_measurement_noise():
    """Against conclusion 2: for small q the error goes with sqrt(sigma_w sigma_v T), the same for
    both noises.

    The paper's own figures say so, too: 6 -> 2 and 2.3 -> 0.8 rad when only sigma_w falls from 10
    to 1."""
    sigma = {figure: gyro.steady(case(figure))[1] for figure in PAPER}
    assert sigma[4] / sigma[6] == pytest.approx(np.sqrt(10), rel=0.03)
    assert sigma[6] / sigma[7] == pytest.approx(np.sqrt(10), rel=0.03)
    assert PAPER[4][3] / PAPER[6][3] == pytest.approx(3) and PAPER[5][3] / PAPER[7][
        3
    ] == pytest.approx(2.875)


@pytest.mark.parametrize("assumed", [(10, 10), (1, 10), (100, 10), (10, 1), (1, 1)])
def test_the_error_of_a_misled_filter_is_the_closed_form(assumed):
    p = case(4)
    flight = gyro.simulate(p, np.random.default_rng(5), runs=3000)
    wrong = replace(p, sigma_w=assumed[0], sigma_v=assumed[1])
    result = kalman_filter(gyro.model(wrong), flight.z, flight.u)
    error = (flight.x - result.x)[-60:, 0]
    K = gyro.steady(wrong)[0]
    if K > 0.05:  # the others have not settled yet
        assert error.std() == pytest.approx(gyro.error_with_gain(p, K), rel=0.03)
        assert np.mean(error**2 / result.P[-60:, 0]) == pytest.approx(
            gyro.error_with_gain(p, K) ** 2 / gyro.steady(wrong)[1] ** 2, rel=0.06
        )
    assert gyro.error_with_gain(p, gyro.steady(p)[0]) == pytest.approx(
        gyro.steady(p)[1]
    )  # told the truth: sqrt(K R)
    assert gyro.error_with_gain(p, K) >= gyro.steady(p)[1] * (1 - 1e-12)  # nothing is better


def test_only_the_ratio_moves_the_estimate_and_only_NEES_sees_the_scale():
    p = case(4)
    flight, true = fly(p, seed=6)
    small = kalman_filter(gyro.model(replace(p, sigma_w=1, sigma_v=1)), flight.z, flight.u)
    assert small.x == pytest.approx(true.x, rel=1e-12)
    assert nees(flight.x, small.x, small.P) == pytest.approx(100 * nees(flight.x, true.x, true.P))


@pytest.mark.parametrize("w, v", [(1, 1), (0.1, 1), (10, 1), (1, 0.1), (1, 10), (3, 0.2)])
@pytest.mark.parametrize("figure", PAPER)
def test_what_a_wrong_sigma_costs_is_known_without_data(figure, w, v):
    """Against RMSE and NEES of 20,000 runs that the wrong filter really filters; a run's 200
    squares stick together."""
    p = case(figure)
    told = replace(p, sigma_w=w * p.sigma_w, sigma_v=v * p.sigma_v)
    flight = fly(p, seed=8, runs=RUNS)[0]
    result = kalman_filter(gyro.model(told), flight.z, flight.u)
    e2, ours = (flight.x - result.x)[:, 0] ** 2, gyro.expected(p, told.sigma_w, told.sigma_v)
    for expected, of_runs in (
        (ours[0] ** 2, e2.mean(axis=0)),
        (ours[1], (e2 / result.P[:, 0]).mean(axis=0)),
    ):
        assert abs(expected - of_runs.mean()) < 4.5 * of_runs.std() / np.sqrt(RUNS)
    if w == v == 1:
        assert ours[1] == pytest.approx(1, rel=1e-12)  # an honest P


def test_a_whole_map_at_once_and_its_two_laws():
    """c times both sigmas: the same RMSE, NEES / c^2; after a long time the RMSE is that of the
    settled gain."""
    p = case(4)
    rmse_, nees_ = gyro.expected(p, 10 * np.ones((3, 1)), np.array([[1, 10, 100.0]]))
    assert rmse_.shape == nees_.shape == (3, 3) and rmse_[0, 1] == pytest.approx(
        gyro.expected(p, 10, 10)[0]
    )
    for c in (0.1, 3, 1e3):
        one, other = gyro.expected(p, 2, 30), gyro.expected(p, 2 * c, 30 * c)
        assert other == (pytest.approx(one[0], rel=1e-12), pytest.approx(one[1] / c**2, rel=1e-12))
    long, told = replace(p, duration=60, T=0.01), replace(p, T=0.01, sigma_w=100, sigma_v=2)
    assert gyro.expected(long, 100, 2)[0] == pytest.approx(
        gyro.error_with_gain(long, gyro.steady(told)[0]), rel=1e-3
    )


@pytest.mark.parametrize("figure", PAPER)
def test_nees_and_nis_lie_in_their_bounds(figure):
    """Averaged over 20,000 independent runs, at the first, tenth and last step."""
    flight, result = fly(case(figure), seed=7, runs=RUNS)
    low, high = chi2_bounds(1, runs=RUNS, probability=0.9999)
    for k in (0, 9, 199):
        assert low < nees(flight.x, result.x, result.P)[k].mean() < high
        assert low < nis(result.y, result.S)[k].mean() < high


@pytest.mark.parametrize("figure", PAPER)
def test_filterpy_agrees(figure):
    p = case(figure)
    flight, result = fly(p, seed=9)
    m = gyro.model(p)
    peer = KalmanFilter(dim_x=1, dim_z=1, dim_u=1)
    peer.x, peer.P, peer.F, peer.B, peer.H, peer.Q, peer.R = (
        m.x0.copy(),
        m.P0,
        m.F,
        m.B,
        m.H,
        m.Q,
        m.R,
    )
    for k, z in enumerate(flight.z):
        peer.predict(flight.u[k])
        peer.update(z)
        assert (
            abs(peer.x[0] - result.x[k, 0]) < 1e-10
            and abs(peer.P[0, 0] - result.P[k, 0, 0]) < 1e-10
        )


def test_noise_on_the_gyroscope_is_the_same_problem():
    """The paper shakes the angle and knows u; a real gyro reads u with noise. The errors are the
    same numbers."""
    p = case(7)
    rng = np.random.default_rng(10)
    n, v = p.sigma_w * rng.normal(size=200), p.sigma_v * rng.normal(size=200)
    shaken = np.cumsum(p.T * (p.u + n))
    smooth = p.u * gyro.times(p)
    a = shaken - kalman_filter(gyro.model(p), shaken + v, np.full(200, p.u)).x[:, 0]
    b = smooth - kalman_filter(gyro.model(p), smooth + v, p.u - n).x[:, 0]
    assert a == pytest.approx(b, abs=1e-12)


def test_the_gyroscope_alone_drifts_as_the_square_root_of_time():
    p = replace(gyro.Params(), sigma_w=np.radians(0.1), duration=30, T=0.01)
    error = gyro.drift(p, np.random.default_rng(11), runs=4000)
    assert error.shape == (3000, 4000)
    assert error.std(axis=1) == pytest.approx(p.sigma_w * np.sqrt(p.T * gyro.times(p)), rel=0.06)


@pytest.mark.parametrize("T", [0.01, 0.1, 0.5])
def test_many_runs_follow_the_same_model_as_one(T):
    p = replace(case(4), T=T, duration=5)
    one, many = (
        gyro.simulate(p, np.random.default_rng(12)),
        gyro.simulate(p, np.random.default_rng(12), runs=4000),
    )
    steps = len(gyro.times(p))
    assert one.x.shape == one.z.shape == one.u.shape == (
        steps,
        1,
    ) and many.x.shape == many.z.shape == (steps, 1, 4000)
    w = np.diff(many.x, axis=0) - p.T * p.u
    assert w.std() == pytest.approx(p.sigma_w * p.T, rel=0.02) and (
        many.z - many.x
    ).std() == pytest.approx(p.sigma_v, rel=0.02)
    assert many.x.mean(axis=2)[:, 0] == pytest.approx(
        p.u * gyro.times(p), abs=6 * p.sigma_w * sqrt(p.T * 5 / 4000)
    )


def test_the_panels_are_the_paper_s():
    p = case(6)
    flight, result = fly(p, seed=13)
    angle, errors = gyro.layout(p, flight, result)
    assert np.array_equal(angle["t"], gyro.times(p)) and np.array_equal(
        angle["truth"], flight.x[:, 0]
    )
    assert [np.abs(errors[name]).max() for name in "zx"] == pytest.approx(
        gyro.maxima(flight, result)
    )


@pytest.mark.parametrize(
    "changes", [dict(T=0), dict(sigma_v=0), dict(duration=0.5), dict(sigma_w=1e3), dict(u=np.nan)]
)
def test_settings_out_of_range_are_refused_in_both_languages(changes):
    with pytest.raises(ValueError, match="accepted are .* / .*yang diterima"):
        gyro.model(replace(gyro.Params(), **changes))
