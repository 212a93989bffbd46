"""Chapter 6: the adaptive filter, which compares vectors: its parts against SciPy's rotations, the
general update, and motions that are known exactly."""

from dataclasses import replace

import numpy as np
import pytest
from quadrotor_cases import ATTITUDES, body_to_ned
from scipy.spatial.transform import Rotation

from kalman_lib import LinearModel, update
from kalman_lib.papers import quadrotor
from kalman_lib.papers.quadrotor import DEG, FIELD, GRAVITY, METHODS
from kalman_lib.papers.quadrotor.blocks import LOOKS_BACK, Block, Kind
from kalman_lib.papers.quadrotor.quaternion import (
    angles_of,
    matrix_of,
    product,
    quaternion_of,
    turn_by,
)
from kalman_lib.papers.quadrotor.vectors import TILT, VectorFilter

HOW = METHODS["adaptive"]


@pytest.mark.parametrize("angles", ATTITUDES)
def test_a_quaternion_is_scipys(angles):
    q = quaternion_of(*angles)
    expected = body_to_ned(angles)
    assert np.allclose(q, expected.as_quat(scalar_first=True)) or np.allclose(
        q, -expected.as_quat(scalar_first=True)
    )
    assert np.allclose(matrix_of(q), expected.as_matrix())
    assert np.allclose(angles_of(q), angles)
    turned = product(q, turn_by(0.3, -0.2, 0.5))
    assert np.allclose(
        matrix_of(turned), (expected * Rotation.from_rotvec([0.3, -0.2, 0.5])).as_matrix()
    )


def started(angles, seconds=4.0, dt=0.01):
    """A filter that lies still at these angles, and its sensors."""
    t = np.arange(0, seconds, dt)
    truth = np.tile(angles, (len(t), 1))
    acc, mag = (quadrotor.to_body(v, truth) for v in ([0, 0, -GRAVITY], FIELD))
    f = VectorFilter(HOW, t, 0 * acc, np.zeros(len(t), dtype=bool))
    f.start(t, 0 * acc, acc, mag, 1)
    return f, acc[0], mag[0]


@pytest.mark.parametrize("angles", ATTITUDES)
def test_it_starts_where_the_sensors_say(angles):
    f, *_ = started(angles)
    assert np.allclose(matrix_of(f.q), body_to_ned(angles).as_matrix(), atol=1e-9)


def test_the_prediction_moves_the_error_as_F_says():
    """Two filters, the second with another attitude and bias: their distance after a step."""
    e, s, rates, h = (
        np.array([2e-5, -1e-5, 3e-5]),
        np.array([1e-4, 2e-4, -1e-4]),
        [0.5, -1, 2],
        0.01,
    )
    one, _, _ = started(ATTITUDES[4])
    other, _, _ = started(ATTITUDES[4])
    other.set_attitude(product(turn_by(*e), other.q))
    other.s = s
    for f in (one, other):
        f.predict(np.array(rates), h)
    turned = Rotation.from_matrix(other.C) * Rotation.from_matrix(one.C).inv()
    assert np.allclose(turned.as_rotvec(), e - h * one.C @ s, atol=2e-8)


@pytest.mark.parametrize("angles", ATTITUDES)
def test_an_error_of_the_attitude_is_the_innovation_that_undoes_it(angles):
    """Turned wrongly by e about north, east and down: forward and right see e by the heading."""
    f, acc, mag = started(angles)
    e = np.array([0.02, -0.03, 0.05])
    f.set_attitude(product(turn_by(*-e), f.q))
    true_yaw = np.array(angles_of(f.q))[2]
    ahead = np.array([np.cos(true_yaw), np.sin(true_yaw), 0])
    right = np.array([-np.sin(true_yaw), np.cos(true_yaw), 0])
    f.tilt.lasts = f.yaw.lasts = 9
    assert np.allclose(f.update_tilt(acc, 0.01), [ahead @ e, right @ e], atol=3e-3)
    f, acc, mag = started(angles)
    f.set_attitude(product(turn_by(0, 0, -0.05), f.q))
    f.yaw.lasts = 9
    assert np.isclose(f.update_yaw(mag, 0.01), 0.05)


def test_the_update_is_the_general_one():
    """One axis after the other gives what the general update gives of both at once."""
    f, *_ = started([0, 0, 0])
    A = np.random.default_rng(1).normal(size=(6, 6))
    f.P = P = 1e-4 * A @ A.T
    y, H = [0.01, -0.02], np.eye(6)[:2]
    f.blend(f.tilt, y, [H[0, :3], H[1, :3]], f.R[:2])
    model = LinearModel(np.eye(6), H, 0 * P, np.diag(f.R[:2]), np.zeros(6), P)
    x, expected, *_ = update(model, np.zeros(6), P, y)
    assert np.allclose(f.P, expected) and np.allclose(f.s, x[3:])
    assert np.allclose(Rotation.from_matrix(f.C).as_rotvec(), x[:3])


def test_what_changes_is_noise_and_what_lasts_is_an_error():
    kind = Kind(1.0, least=1e-6, usual=1e-6, lasting=0.01)
    block = Block(kind, axes=1)
    for y in (2, -2) * LOOKS_BACK:
        R = block.noise(0, y, P=0)
    assert np.isclose(R, 4, rtol=0.1)  # y^2
    for y in [2] * LOOKS_BACK:
        R = block.noise(0, y, P=0)
    assert np.isclose(R, 0.01)
    assert np.isclose(block.noise(0, 2, P=1), 1e-6)  # the filter expects as much


def test_a_silent_sensor_completes_no_block():
    block = Block(TILT, axes=2)
    found = [block.is_full_with(np.full(3, np.nan), 0.1) for _ in range(25)]
    assert not any(found)
    block.start_again()
    assert [block.is_full_with(np.ones(3), 0.25) for _ in range(4)] == [False] * 3 + [True]
    assert np.allclose(block.mean(), 1)


def test_a_turn_over_the_top_is_followed():
    """Pitch through 90 degrees and on, exactly: where Euler angles fail the quaternion does not."""
    t = np.arange(0, 12, 0.01)
    turned = Rotation.from_euler("y", np.clip(t - 3, 0, 6)[:, np.newaxis] * 60 * DEG)
    gyr = np.where((t > 3) & (t <= 9), 60 * DEG, 0)[:, np.newaxis] * [0, 1, 0]
    acc, mag = (turned.inv().apply(v) for v in ([0, 0, -GRAVITY], FIELD))
    with pytest.warns(UserWarning, match="Euler angles fail"):
        angles = quadrotor.estimate(t, gyr, acc, mag, 2.5)
    off = [
        (body_to_ned(a).inv() * Rotation.from_matrix(b)).magnitude()
        for a, b in zip(angles[::20], turned.as_matrix()[::20])
    ]
    assert np.degrees(max(off)) < 2


def test_a_bias_that_was_not_taken_off_is_found():
    flight = quadrotor.simulate(quadrotor.Params(bias=1), np.random.default_rng(2))
    rates = quadrotor.body_rates(flight.x[:, 1::2], flight.truth)
    bias = (flight.gyr - rates).mean(axis=0)
    raw = quadrotor.attitude(*flight.sensors, replace(HOW, without=("rest mean",)))
    assert np.abs(np.degrees(raw.s[-1] - bias)).max() < 0.1 < np.abs(np.degrees(bias)).max()
