"""Chapter 6: the attitude filter against the general one, and its three methods on a flight."""

from dataclasses import replace

import numpy as np
import pytest
from quadrotor_cases import ATTITUDES, LIMITS, body_to_ned, degrees
from scipy.spatial.transform import Rotation

from kalman_lib import kalman_filter
from kalman_lib.models import LinearModel
from kalman_lib.papers import quadrotor
from kalman_lib.papers.quadrotor import DEG, GRAVITY, METHODS, Params


@pytest.fixture(scope="module")
def flight():
    return quadrotor.simulate(Params(), np.random.default_rng(6))


# --- the filter ---------------------------------------------------------------------------------


def general(flight, result, how, i):
    """Axis i by the general filter: state [angle, s], fed with the same u, z and R."""
    dt = flight.t[1] - flight.t[0]
    model = LinearModel(
        F=[[1, -dt], [0, 0]],
        B=[[dt], [0]],
        H=[[1, 0]],
        Q=how.q * np.array([[dt**3 / 3, -(dt**2) / 2], [-(dt**2) / 2, dt]]),
        R=result.R[1:, i, np.newaxis, np.newaxis],
        x0=[result.angles[0, i], 0],
        P0=np.diag([result.R[0, i], 0]),
        residual=quadrotor.wrapped_difference,
    )
    return kalman_filter(model, result.z[1:, i], result.u[1:, i])


def rest(flight):
    return flight.t - flight.t[0] <= flight.rest_s


def test_the_written_out_filter_is_the_general_one(flight):
    how = METHODS["paper"]
    first = slice(0, 2500)
    short = (
        flight.t[first],
        flight.gyr[first],
        flight.acc[first],
        flight.mag[first],
        flight.rest_s,
    )
    result = quadrotor.attitude(*short, how)
    for i in range(3):
        same = general(flight, result, how, i)
        assert np.abs(quadrotor.wrap(same.x[:, 0] - result.angles[1:, i])).max() < 1e-10
        assert np.abs(same.x[:, 1] - result.s[1:, i]).max() < 1e-10
        assert np.abs(same.P[:, 0, 0] / result.P[1:, i] - 1).max() < 1e-9


def test_the_error_state_is_the_papers_rate_state(flight):
    """state [angle, rate] with the paper's F, B, H, Q, one axis: the same angles as state [angle,
    error of the rate]."""
    how = METHODS["paper"]
    short = (
        flight.t[:2000],
        flight.gyr[:2000],
        flight.acc[:2000],
        flight.mag[:2000],
        flight.rest_s,
    )
    result = quadrotor.attitude(*short, how)
    F, B, H, Q = quadrotor.axis(flight.t[1] - flight.t[0], how.q)
    for i in range(3):
        R = result.R[1:, i, np.newaxis, np.newaxis]
        model = LinearModel(
            F,
            H,
            Q,
            R,
            x0=[result.angles[0, i], result.u[1, i]],
            P0=np.diag([result.R[0, i], 0]),
            B=B,
            residual=quadrotor.wrapped_difference,
        )
        same = kalman_filter(
            model, result.z[1:, i], np.append(result.u[2:, i], 0)
        )  # the rate of the step to come
        assert np.abs(quadrotor.wrap(same.x[:, 0] - result.angles[1:, i])).max() < 1e-10


def test_many_cells_at_once_are_the_single_ones(flight):
    how = replace(
        METHODS["paper"], q=np.array([1.0, 100]) * DEG**2, m=np.array([0.16, 10]), R_min=(0, 0, 0)
    )
    short = (
        flight.t[:1500],
        flight.gyr[:1500],
        flight.acc[:1500],
        flight.mag[:1500],
        flight.rest_s,
    )
    many = quadrotor.attitude(*short, how).angles
    for cell in range(2):
        one = quadrotor.attitude(*short, replace(how, q=how.q[cell], m=how.m[cell])).angles
        assert np.abs(many[..., cell] - one).max() < 1e-12


def test_the_settled_gain_is_that_of_a_complementary_filter():
    """In a long rest the angle forgets with the time constant sqrt(R / (7/3 q dt)), as R >> q
    dt^3."""
    q, dt, R = 30 * DEG**2, 0.02, (3 * DEG) ** 2
    t = dt * np.arange(5000)
    level = np.tile([0, 0, -GRAVITY], (len(t), 1))
    still = quadrotor.attitude(t, 0 * level, level, None, 1, METHODS["paper"])
    K = still.P[-1, 0] / still.R[-1, 0]
    assert np.isclose(dt / K, np.sqrt(R / (7 / 3 * q * dt)), rtol=0.01)


def test_euler_rates_keep_a_fast_slanted_turn_where_body_rates_lose_it():
    """Rolled by 40 degrees and turning at 90 deg/s about the vertical, without noise: against the
    exact motion."""
    t = np.arange(0, 12, 0.01)
    yaw = np.where(t < 2, 0, np.pi / 2 * (t - 2))
    truth = np.column_stack([np.full_like(t, 40 * DEG), np.full_like(t, 10 * DEG), yaw])
    rates = np.column_stack([0 * t, 0 * t, np.where(t < 2, 0, np.pi / 2)])
    gyr, acc = quadrotor.body_rates(rates, truth), quadrotor.to_body([0, 0, -GRAVITY], truth)
    mag = quadrotor.to_body([38, 0, -24], truth)
    weak = replace(METHODS["paper"], q=1e-3 * DEG**2)  # listen to the gyroscope almost alone
    error = quadrotor.rmse_deg(truth, quadrotor.attitude(t, gyr, acc, mag, 1.9, weak).angles)
    with pytest.warns(UserWarning, match="The pitch reaches"):
        lost = quadrotor.attitude(
            t, gyr, acc, mag, 1.9, replace(weak, without=METHODS["literal"].without)
        ).angles
    body = quadrotor.rmse_deg(truth[:, :2], lost[:, :2])
    assert (error < 0.5).all() and body.max() > 10


@pytest.mark.parametrize("left_out", quadrotor.CORRECTIONS)
def test_every_correction_can_be_left_out_alone(flight, left_out):
    short = (flight.t[:600], flight.gyr[:600], flight.acc[:600], flight.mag[:600], flight.rest_s)
    whole, part = (
        quadrotor.attitude(
            *short, replace(METHODS["paper"], R_min=(0, 0, 0), without=without)
        ).angles
        for without in ((), (left_out,))
    )
    assert np.abs(whole - part).max() > 1e-12


def test_the_error_of_the_tilt_is_the_angle_between_the_verticals():
    one, other = ATTITUDES[[3, 5]], ATTITUDES[[4, 2]]
    down = np.array([0, 0, 1])
    expected = [
        np.arccos(np.dot(body_to_ned(a).inv().apply(down), body_to_ned(b).inv().apply(down)))
        for a, b in zip(one, other)
    ]
    assert np.allclose(quadrotor.tilt_error(one, other), expected)
    assert np.allclose(
        quadrotor.tilt_error(degrees([[0, 20, 0]]), degrees([[0, 50, 99]])), degrees([30])
    )


def test_the_fast_motion_is_fast_and_its_sensors_fit():
    swing = quadrotor.swing(
        Params(sigma_gyr=0.01, sigma_acc=0.01, sigma_mag=0.01, bias=0), np.random.default_rng(0)
    )
    turn = body_to_ned(swing.truth[0])
    for w, dt in zip((swing.gyr[1:] + swing.gyr[:-1]) / 2, np.diff(swing.t)):
        turn = turn * Rotation.from_rotvec(w * dt)
    assert np.degrees((turn.inv() * body_to_ned(swing.truth[-1])).magnitude()) < 1
    assert (
        np.abs(swing.gyr).max() > 100 * DEG
        and 30 * DEG < np.abs(swing.truth[:, :2]).max() < 75 * DEG
    )


@pytest.mark.parametrize("method", LIMITS)
def test_the_error_of_the_flight_stays_below_what_the_book_demands(flight, method):
    error = quadrotor.rmse_deg(flight.truth, quadrotor.estimate(*flight.sensors, method))
    assert (error <= np.array(LIMITS[method]["flight"].split(), dtype=float)).all(), error


def test_the_adaptive_method_knows_how_large_its_errors_are():
    """NIS and NEES of roll and pitch, mean of six flights, between a half and two."""
    found = [consistency(seed) for seed in range(6)]
    assert ((0.5 < np.mean(found, axis=0)) & (np.mean(found, axis=0) < 2)).all(), found


def consistency(seed):
    """Mean NIS and NEES (2, 2) of roll and pitch."""
    flight = quadrotor.simulate(Params(), np.random.default_rng(seed))
    result = quadrotor.attitude(*flight.sensors, METHODS["adaptive"])
    e, P, y, R = (
        part[1:, :2] for part in (flight.truth - result.angles, result.P, result.y, result.R)
    )
    K = P / R  # where there is an update
    return [np.nanmean(y**2 / (R / (1 - K)), axis=0), (e**2 / P).mean(axis=0)]


def test_the_flight_flies_the_papers_route(flight):
    yaw = np.degrees(np.unwrap(flight.truth[:, 2]))
    straight, longest = np.abs(flight.gyr[:, 2]) < 10 * DEG, []
    for end in np.cumsum([0, *[turn for _, turn in quadrotor.ROUTE]]):
        longest.append((straight & (np.abs(yaw - yaw[0] - end) < 1)).sum() * 0.02)
    assert (
        np.array(longest[1:]) > np.array([30, 20, 15, 20, 15]) - 0.6
    ).all()  # less the ends of the turns
    assert np.isclose(abs(yaw[0]), 180) and np.isclose(
        yaw[-1] - yaw[0], -360
    )  # south, and south again
    assert np.abs(flight.truth[rest(flight)][:, :2]).max() < 1e-4


def test_the_sensors_of_the_flight_fit_its_truth(flight):
    """Gyroscope: integrated from the truth it stays with it. Accelerometer: at rest it is gravity
    alone."""
    quiet = quadrotor.simulate(
        Params(sigma_gyr=0.01, sigma_acc=0.01, sigma_mag=0.01, bias=0, sway=0),
        np.random.default_rng(0),
    )
    turn = body_to_ned(quiet.truth[0])
    for w, dt in zip((quiet.gyr[1:] + quiet.gyr[:-1]) / 2, np.diff(quiet.t)):
        turn = turn * Rotation.from_rotvec(w * dt)
    off = (turn.inv() * body_to_ned(quiet.truth[-1])).magnitude()
    assert np.degrees(off) < 0.2
    assert np.allclose(quiet.acc[rest(quiet)].mean(axis=0), [0, 0, -GRAVITY], atol=0.01)
