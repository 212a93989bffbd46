"""Chapter 6, one axis in the hand. Expected values come from geometry."""

import numpy as np
from scipy.spatial.transform import Rotation

from kalman_lib.papers import quadrotor
from kalman_lib.papers.quadrotor import GRAVITY

CALM = dict(sigma_gyr=0, sigma_acc=0)


def hold(**changes):
    return quadrotor.hold(np.random.default_rng(0), **changes)


def test_it_is_tilted_put_back_and_pushed():
    t, held = quadrotor.hand_times(), hold(held=20, push=3, **CALM)
    roll, seen = held.x[:, 0], held.z[:, 0]
    assert np.allclose(roll[(t > 5) & (t < 9)], 20) and np.allclose(roll[(t < 3) | (t > 11)], 0)
    pushed = (t >= 13) & (t < 14)
    assert np.allclose(seen[~pushed], roll[~pushed])  # at rest the accelerometer is right
    assert np.allclose(seen[pushed], np.degrees(np.arctan(3 / GRAVITY)))  # nothing tilts


def test_a_push_while_it_hangs_aslant_is_geometry_too():
    """Specific force = acceleration - gravity, seen in the axes of a body that is rolled."""
    held = hold(held=30, push=0, **CALM)
    turn = Rotation.from_euler("x", 30, degrees=True)  # down goes left: right side down
    acc = turn.inv().apply([0, 0, -GRAVITY])
    assert np.isclose(held.z[70, 0], np.degrees(np.arctan2(-acc[1], -acc[2])))


def test_the_gyroscope_adds_up_to_the_truth_and_its_bias():
    held = hold(bias=0.5, **CALM)
    drift = 0.1 * np.cumsum(held.u[:, 0]) - held.x[:, 0]
    assert np.allclose(drift, 0.5 * quadrotor.hand_times())


def test_its_noises_have_the_size_that_is_asked_for():
    """0.1 m/s2 tilts the vertical by 0.1 / 9.81 rad."""
    many = [quadrotor.hold(np.random.default_rng(k), sigma_acc=0.1, push=0) for k in range(50)]
    off = np.array([(d.z - d.x)[:, 0] for d in many])
    assert np.isclose(off.std(), np.degrees(0.1 / GRAVITY), rtol=0.03)
    rates = np.array([d.u[:, 0] for d in many])
    assert np.isclose((rates - rates.mean(axis=0)).std(), 1, rtol=0.03)
