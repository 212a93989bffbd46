"""Chapter 6. Expected values come from the paper, from geometry (SciPy's rotations), or from the
general filter."""

import os
from pathlib import Path

import numpy as np
import pytest
from quadrotor_cases import ATTITUDES, LIMITS, body_to_ned, degrees
from scipy.spatial.transform import Rotation

from kalman_lib.papers import quadrotor
from kalman_lib.papers.quadrotor import DEG, FIELD, GRAVITY, Params


@pytest.fixture(scope="module")
def flight():
    return quadrotor.simulate(Params(), np.random.default_rng(6))


# --- frames and formulas: against SciPy's rotations ---------------------------------------------


@pytest.mark.parametrize("angles", ATTITUDES)
def test_the_vectors_at_rest_show_the_angles(angles):
    turn = body_to_ned(angles)
    acc = turn.inv().apply([0, 0, -GRAVITY])[np.newaxis]
    mag = turn.inv().apply(FIELD)[np.newaxis]
    assert np.allclose(quadrotor.to_body(FIELD, angles[np.newaxis]), mag, atol=1e-12)
    assert np.allclose(quadrotor.tilt(acc)[0], angles[:2], atol=1e-12)
    declination = np.arctan2(FIELD[1], FIELD[0])
    yaw = quadrotor.heading(mag, *quadrotor.tilt(acc).T)[0]
    assert np.isclose(quadrotor.wrap(yaw - (angles[2] - declination)), 0, atol=1e-12)


def test_nose_up_and_right_side_down_are_positive():
    half, root = GRAVITY / 2, GRAVITY * np.sqrt(3) / 2
    assert np.allclose(
        quadrotor.tilt([[half, 0, -root]]), degrees([[0, 30]])
    )  # nose up: the push is forward too
    assert np.allclose(
        quadrotor.tilt([[0, -half, -root]]), degrees([[30, 0]])
    )  # right side down: to the left too


def test_euler_rates_agree_with_scipys_small_rotation_and_with_their_inverse():
    gyr, dt = np.array([0.3, -0.2, 0.5]), 1e-5
    for angles in ATTITUDES:
        after = (body_to_ned(angles) * Rotation.from_rotvec(gyr * dt)).as_euler("ZYX")[::-1]
        rates = np.array(quadrotor.euler_rates(gyr, *angles[:2]))
        assert np.allclose(quadrotor.wrap(after - angles) / dt, rates, atol=1e-4)
        assert np.allclose(quadrotor.body_rates(rates[np.newaxis], angles[np.newaxis]), gyr)


def printed_at(roll, pitch):
    """Roll and pitch, degrees, by equations (2) and (1), of a sensor at rest."""
    acc = body_to_ned(degrees([roll, pitch, 0])).inv().apply([[0, 0, -GRAVITY]])
    return np.degrees(quadrotor.printed_tilt(acc)[0])


@pytest.mark.parametrize(("roll", "pitch"), [(20, 0), (0, 20), (20, 20), (-35, 40), (60, -50)])
def test_equation_2_is_the_angle_of_the_y_axis_to_the_ground(roll, pitch):
    """That is how the paper defines roll; at 20 and 20 degrees it is 18.747, not the Euler 20."""
    y_axis = body_to_ned(degrees([roll, pitch, 0])).apply([0, 1, 0])  # in NED: down is positive
    expected = np.degrees(np.arcsin(y_axis[2]))
    assert np.isclose(printed_at(roll, pitch)[0], expected)
    assert abs(printed_at(20, 20)[0] - 18.747) < 0.0005


def test_the_misprint_of_equation_1_costs_a_degree_at_20():
    """Its root must hold ay: the pitch is the angle of the X axis to the ground."""
    assert abs(printed_at(0, 20)[1] - 18.9) < 0.05
    x_axis = body_to_ned(degrees([20, 20, 0])).apply([1, 0, 0])
    assert np.isclose(np.degrees(np.arcsin(-x_axis[2])), 20)


def test_an_angle_across_180_degrees_is_a_small_innovation():
    assert np.allclose(quadrotor.wrapped_difference(degrees([-179]), degrees([179])), degrees([2]))
    assert np.allclose(quadrotor.wrap(degrees([540, -181, 0])), degrees([-180, 179, 0]))


# --- what the paper prints ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "axis"), [(case, axis) for case in quadrotor.PRINTED for axis in quadrotor.AXES]
)
def test_galat_follows_from_the_printed_means(case, axis):
    """Each printed galat, to its printed digits; 26.39 from 26.3850 and 0.11 from 0.1150 are within
    one unit."""
    reference, estimate, galat = quadrotor.PRINTED[case][axis].split()
    ours = quadrotor.galat(np.array([float(reference)]), np.array([float(estimate)]))
    digits = len(galat.partition(".")[2])
    assert abs(ours - float(galat)) < 10.0**-digits
    if (case, axis) == ("0.16 R", "roll"):
        assert abs(ours - 0.004) < 0.0005  # printed as 0 %


def test_the_model_is_the_papers():
    m = quadrotor.model(Params(dt=0.1, q=1))
    F, H = np.zeros((6, 6)), np.zeros((3, 6))
    for axis in range(3):
        F[2 * axis, 2 * axis : 2 * axis + 2] = (
            1,
            0.1,
        )  # equation (14), as it is meant
        H[axis, 2 * axis] = 1  # equation (21)
    assert np.allclose(m.F, F) and np.allclose(m.H, H)
    assert np.allclose(
        m.B, np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 1]])
    )
    block = np.array([[0.1**3 / 3, 0.1**2 / 2], [0.1**2 / 2, 0.1]]) * DEG**2  # equation (18)
    assert np.allclose(m.Q, np.kron(np.eye(3), block))
    assert np.allclose(m.residual(degrees([179, 0, 0]), degrees([-179, 0, 0])), degrees([-2, 0, 0]))


def test_degrees_or_radians_change_q_over_r_by_3283():
    assert round(1 / DEG**2) == 3283


# --- bad input ----------------------------------------------------------------------------------


def test_a_silent_sensor_is_bridged(flight):
    t, gyr, acc, mag, rest_s = (np.array(part) for part in flight.sensors)
    mag[1000:1500] = np.nan
    acc[2000:2100] = np.nan
    angles = quadrotor.estimate(t, gyr, acc, mag, float(rest_s))
    assert np.isfinite(angles).all() and quadrotor.rmse_deg(flight.truth, angles).max() < 5
    without = quadrotor.estimate(t, gyr, flight.acc, None, float(rest_s))
    assert without[0, 2] == 0 and np.isfinite(without).all()
    assert quadrotor.rmse_deg(flight.truth[:, :2], without[:, :2]).max() < 1


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (dict(method="best"), "literal, paper, adaptive"),
        (dict(rest_s=0.05), "at least 10 samples of rest"),
        (dict(gyr=np.zeros((6320, 3))), r"gyr has shape \(6320, 3\), expected"),
        (dict(t=np.r_[0.02, np.arange(1, 6321) * 0.02 - 0.02]), "t does not increase"),
        (dict(gyr=np.full((6321, 3), np.nan)), r"gyr\[0\] is not a finite number"),
    ],
)
def test_bad_recordings_are_named_in_both_languages(flight, change, says):
    given = dict(zip(("t", "gyr", "acc", "mag", "rest_s"), flight.sensors)) | change
    with pytest.raises(ValueError, match=says) as error:
        quadrotor.estimate(**given)
    assert " / " in str(error.value)


def test_pitch_near_90_degrees_is_warned_of():
    t = np.arange(0, 4, 0.02)
    truth = np.column_stack([0 * t, np.clip(t - 1, 0, None) * 30 * DEG, 0 * t])
    gyr = quadrotor.body_rates(np.gradient(truth, 0.02, axis=0), truth)
    with pytest.warns(UserWarning, match="Euler angles fail"):
        angles = quadrotor.estimate(t, gyr, quadrotor.to_body([0, 0, -GRAVITY], truth), None, 0.9)
    assert np.isfinite(angles).all()


# --- recordings with a reference that may not be published with the book: KALMAN_RECORDINGS names
# their folder -------------

if "KALMAN_RECORDINGS" in os.environ:

    @pytest.mark.parametrize("name", ["broad10", "quad123", "p4rtk_dot1"])
    @pytest.mark.parametrize("method", LIMITS)
    def test_the_error_of_a_real_recording_stays_below_what_the_book_demands(name, method):
        data = np.load(Path(os.environ["KALMAN_RECORDINGS"]) / f"{name}.npz")
        flip = np.array([1, -1, -1])  # body forward-left-up -> forward-right-down
        if "q" in data:  # body to east-north-up, w first
            down = Rotation.from_matrix([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
            known = np.isfinite(data["q"]).all(axis=1)
            q = np.where(known[:, np.newaxis], data["q"], [1, 0, 0, 0])
            turn = (
                down
                * Rotation.from_quat(q, scalar_first=True)
                * Rotation.from_matrix(np.diag(flip))
            )
            truth = np.where(known[:, np.newaxis], turn.as_euler("ZYX")[:, ::-1], np.nan)
        else:
            truth = data["ref"] * flip + [0, 0, np.pi / 2]
        angles = quadrotor.estimate(
            data["t"],
            data["gyr"] * flip,
            data["acc"] * flip,
            data["mag"] * flip,
            float(data["static0"]),
            method,
        )
        error = quadrotor.wrap(angles - truth)[data["mask"]]
        error[:, 2] = quadrotor.wrap(error[:, 2] - np.angle(np.nanmean(np.exp(1j * error[:, 2]))))
        rmse = np.degrees(np.sqrt(np.nanmean(error**2, axis=0)))
        assert (rmse <= np.array(LIMITS[method][name].split(), dtype=float)).all(), rmse
