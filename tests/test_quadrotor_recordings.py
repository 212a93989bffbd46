"""Chapter 6 on recordings as readers make them: begun in motion, with pauses, with a rest that is
none, with swapped axes, of a real device."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from quadrotor_cases import walk

from kalman_lib.data import read_ximu, rest_seconds
from kalman_lib.papers import quadrotor
from kalman_lib.papers.quadrotor import METHODS, Params, rmse_deg, tilt_error, wrap

XIMU = Path(__file__).parents[1] / "notebooks/data/ximu.csv.gz"
MOST_WALKING = [1.6, 2.5, 3.2]  # degrees of roll, pitch, yaw
MOST_FLYING = [2.6, 3.0, 6.0]


@pytest.fixture(scope="module")
def flight():
    return quadrotor.simulate(Params(bias=0.5), np.random.default_rng(6))


@pytest.fixture(scope="module")
def walks():
    return [walk(np.random.default_rng(seed)) for seed in range(4)]


def errors(truth, angles):
    """RMSE (3) in degrees, of the yaw without its constant offset."""
    e = wrap(angles - truth)
    e[:, 2] = wrap(e[:, 2] - np.angle(np.exp(1j * e[:, 2]).mean()))
    return np.degrees(np.sqrt((e**2).mean(axis=0)))


def part_of(flight, keep):
    return [part[keep] for part in (flight.t, flight.gyr, flight.acc, flight.mag)]


def nis(result):
    """The mean of y^2 / S over all updates."""
    P, R, y = result.P[1:], result.R[1:], result.y[1:]
    return np.nanmean(y**2 * (1 - P / R) / R)


# --- begun in motion ----------------------------------------------------------------------------


@pytest.mark.parametrize("begin", [20, 40, 63, 85])
def test_a_flight_started_in_the_middle(flight, begin):
    keep = flight.t >= begin
    result = quadrotor.attitude(*part_of(flight, keep), 0, METHODS["adaptive"])
    assert (errors(flight.truth[keep], result.angles) <= MOST_FLYING).all()
    assert 0.3 < nis(result) < 3


def test_walks_begun_in_motion(walks):
    results = [quadrotor.attitude(*sensors, 0, METHODS["adaptive"]) for sensors, _ in walks]
    found = [errors(truth, r.angles) for r, (_, truth) in zip(results, walks)]
    assert (np.mean(found, axis=0) <= MOST_WALKING).all(), found
    assert all(0.3 < nis(result) < 3 for result in results)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_takes_a_recording_without_rest(flight, method):
    keep = (flight.t >= 40) & (flight.t < 60)
    angles = quadrotor.estimate(*part_of(flight, keep), method=method)
    assert np.isfinite(angles).all()


@pytest.mark.parametrize("rest_s", [0.5, 1, 3])
def test_a_rest_that_is_none_is_found_out(walks, rest_s):
    sensors, _ = walks[0]
    with pytest.warns(UserWarning, match="are no rest.* bukan saat diam"):
        angles = quadrotor.estimate(*sensors, rest_s)
    assert np.array_equal(angles, quadrotor.estimate(*sensors, 0))


@pytest.mark.parametrize("noise", [0.1, 0.5, 10])
def test_a_true_rest_is_believed_whatever_the_noise(noise):
    p = Params(sigma_gyr=noise, sigma_acc=min(noise, 3), bias=5)
    flight = quadrotor.simulate(p, np.random.default_rng(1))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        quadrotor.estimate(*part_of(flight, flight.t < 10), 6)


@pytest.mark.parametrize("rest_s", [-1, np.nan, np.inf])
def test_a_rest_of_no_length_is_refused(flight, rest_s):
    with pytest.raises(ValueError, match="no length of time.* bukan lama waktu"):
        quadrotor.estimate(*part_of(flight, flight.t < 9), rest_s)


# --- pauses -------------------------------------------------------------------------------------


@pytest.mark.parametrize("rest_s", [0, 6])
def test_after_a_pause_it_starts_again_from_the_sensors(flight, rest_s):
    gone = ((flight.t > 30) & (flight.t < 60)) | ((flight.t > 90) & (flight.t < 91))
    keep = ~gone if rest_s else ~gone & (flight.t > 12)
    sensors = part_of(flight, keep)
    e = np.degrees(wrap(quadrotor.estimate(*sensors, rest_s) - flight.truth[keep]))
    after = (sensors[0] > 60) & (sensors[0] < 66)
    assert np.abs(e[after, :2]).max() < 4 and np.abs(e[after, 2]).max() < 8
    assert (rmse_deg(flight.truth[keep], quadrotor.estimate(*sensors, rest_s)) < 1.6).all()


def test_pauses_of_a_walk(walks):
    (t, *vectors), truth = walks[1]
    keep = ((t < 20) | (t > 50)) & ((t < 60) | (t > 60.8))
    sensors = [part[keep] for part in (t, *vectors)]
    assert (errors(truth[keep], quadrotor.estimate(*sensors)) <= [2, 2.5, 4]).all()


# --- axes and silence ---------------------------------------------------------------------------


def test_swapped_axes_of_the_magnetometer_show_in_the_yaw_and_not_in_the_tilt(flight):
    """A classic of MPU-9250 boards. Roll and pitch do not ask the magnetometer."""
    t, gyr, acc, mag = part_of(flight, flight.t > 20)
    truth = flight.truth[flight.t > 20]
    right = quadrotor.estimate(t, gyr, acc, mag)
    wrong = quadrotor.estimate(t, gyr, acc, mag[:, [1, 0, 2]] * [1, 1, -1])
    assert (rmse_deg(truth, right) < [1, 1, 2]).all()
    assert (rmse_deg(truth, wrong)[:2] < 1.2).all() and rmse_deg(truth, wrong)[2] > 20


def test_zeros_are_silence(flight):
    """A vector of length 0 has no direction."""
    keep = flight.t < 30
    t, gyr, acc, mag = part_of(flight, keep)
    zeros, nothing = (
        np.where((t > 12)[:, np.newaxis] & (t < 15)[:, np.newaxis], v, 1.0) for v in (0, np.nan)
    )
    for method in METHODS:
        by_zeros = quadrotor.estimate(t, gyr, acc * zeros, mag * zeros, 6, method)
        silent = quadrotor.estimate(t, gyr, acc * nothing, mag * nothing, 6, method)
        assert np.array_equal(by_zeros, silent) and np.isfinite(silent).all()


@pytest.mark.parametrize("name", ["gyr", "acc", "mag"])
def test_a_value_that_no_sensor_shows_is_refused(flight, name):
    given = dict(zip(("t", "gyr", "acc", "mag"), part_of(flight, flight.t < 9)))
    given[name] = given[name].copy()
    given[name][7, 1] = 1e308
    with pytest.raises(ValueError, match=rf"{name}\[7\].*no sensor shows.* / .*tidak ditunjukkan"):
        quadrotor.estimate(**given)


def test_a_slow_magnetometer_that_is_silent_between_its_samples(flight):
    keep = flight.t > 20
    t, gyr, acc, mag = part_of(flight, keep)
    mag = np.where(np.arange(len(t))[:, np.newaxis] % 10 == 0, mag, np.nan)
    assert (rmse_deg(flight.truth[keep], quadrotor.estimate(t, gyr, acc, mag)) < [1, 1, 2]).all()


# --- a real device ------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore:The pitch reaches")
@pytest.mark.parametrize("begin", [0, 3.3, 12])
def test_the_real_recording_with_and_without_its_rest(begin):
    """Against the device's own filter, which differs by two degrees even at rest."""
    device = read_ximu(XIMU)
    keep = device.t >= begin
    sensors = [part[keep] for part in (device.t, device.gyr, device.acc, device.mag)]
    angles = quadrotor.estimate(*sensors, rest_seconds(device) if begin == 0 else 0)
    off = np.degrees(tilt_error(device.reference[keep], angles))
    assert np.sqrt(np.mean(off**2)) < 6
