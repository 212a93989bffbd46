"""What chapters 3 and 6 make of a phone's motion sensors. Real Chromium, whose sensors DevTools
overrides, or to which readings are handed."""

import re

import numpy as np
import pytest
from explorer_helpers import set_state
from scipy.spatial.transform import Rotation
from sensors_helpers import (
    START,
    STOP,
    UP,
    Phone,
    explorer,
    motion_of,
    readings,
    record,
    result_of,
    tap,
)

from kalman_lib import LinearModel, kalman_filter

TINY = 1e-9


# --- chapter 3 ----------------------------------------------------------------------------------


def angle_by_python(t, u, z, sigma_w, sigma_v):
    """The filter of chapter 3 with uneven steps, from the second reading on."""
    T = np.diff(t)[:, np.newaxis, np.newaxis]
    model = LinearModel(F=1, B=T, H=1, Q=(sigma_w * T) ** 2, R=sigma_v**2, x0=0, P0=0)
    return kalman_filter(model, z[1:], u[1:])


def test_gyro_overridden_sensors_are_added_up_and_filtered_as_python_does(phone_page):
    """Rates of 0.5 and -0.3 rad/s about y, and a tilt: the browser rounds to 0.1 degrees a second
    and to 0.1 m/s2, as the specification asks."""
    element, phone = explorer(phone_page, "gyro"), Phone(phone_page)
    tap(element, START["en"])
    told = [(0, (0, 0, 0)), (0.5, (-0.9, 0.04, 9.77)), (-0.3, (2.5, 0, 9.5))]
    for rate, force in told:
        phone.set((0.02, rate, -0.01), force or UP)
        rounded = round(np.degrees(rate), 1)
        phone_page.wait_for_function(
            "([e, rate]) => e.explorer.s.motion?.gyr.filter((value, i) => i % 3 === 1 && "
            "Math.abs(value - rate) < 0.01).length > 20",
            arg=[element.element_handle(), rounded],
        )
    tap(element, STOP["en"])
    set_state(element, sensor=True, sigma=0.7, noise_v=2)
    motion = motion_of(element)
    rates = {tuple(rate) for rate in motion["gyr"].round(6).tolist()}
    assert rates <= {(1.1, beta, -0.6) for beta in (0, 28.6, -17.2)} | {(0, 0, 0)}
    t, u = motion["t"], motion["gyr"][:, 1]
    assert np.all(np.diff(t) > 0) and not motion["live"]
    alone, fan, x, P, z = result_of(element, "alone", "fan", "filter.x", "filter.P", "z")
    steps = np.diff(t)
    assert np.allclose(alone[1:], np.cumsum(steps * u[1:]), rtol=TINY, atol=TINY)
    assert np.allclose(fan[1:], 2 * 0.7 * np.sqrt(np.cumsum(steps**2)), rtol=TINY)
    angle = np.degrees(np.arctan2(-motion["acc"][:, 0], motion["acc"][:, 2]))
    assert np.allclose(z - z[0], angle - angle[0], atol=TINY)
    assert abs(z[t <= 5].mean()) < TINY
    result = angle_by_python(t, u, z, 0.7, 2)
    assert np.allclose(x[1:], result.x[:, 0], rtol=TINY, atol=TINY)
    assert np.allclose(P[1:], result.P[:, 0, 0], rtol=TINY)


def test_gyro_even_steps_give_the_fan_of_the_chapter(phone_page):
    """2 sigma sqrt(T t), and of a mean that was subtracted the exact error of a sum."""
    element = explorer(phone_page, "gyro")
    T, t = 0.02, 0.02 * np.arange(601)
    record(element, readings(t, [0, 0.3, 0], UP))
    set_state(element, sigma=0.5)
    fan, alone = result_of(element, "fan", "alone")
    assert np.allclose(fan, 2 * 0.5 * np.sqrt(T * t), atol=TINY)
    assert alone[-1] == pytest.approx(0.3 * t[-1])
    set_state(element, centred=True)
    fan, alone = result_of(element, "fan", "alone")
    assert np.abs(alone).max() < TINY
    rest = np.sum(t <= 5)
    sums = np.tril(np.full((len(t), len(t)), T))  # of the noise of every reading but the first
    sums[:, 0] = 0
    of_mean = np.where(np.arange(len(t)) < rest, 1 / rest, 0)
    errors = sums - np.outer(t, of_mean)
    assert np.allclose(fan[1:], 2 * 0.5 * np.sqrt((errors**2).sum(axis=1))[1:], atol=1e-6)


def test_gyro_a_quarter_turn_and_back_misses_zero_until_the_tilt_is_switched_on(phone_page):
    element = explorer(phone_page, "gyro")
    t = np.arange(900) / 60
    angle = 90 * (np.clip((t - 6) / 2, 0, 1) - np.clip((t - 10) / 2, 0, 1))
    rate = 1.02 * np.gradient(angle, t) + 0.4  # a scale and a bias, as every gyroscope has
    radians = np.radians(angle)
    zero = 0 * t
    acc = 9.8 * np.column_stack([-np.sin(radians), zero, np.cos(radians)])
    record(element, readings(t, np.column_stack([zero, rate, zero]), acc))
    alone, x = result_of(element, "alone", "x")
    assert alone[-1] > 4 and x[-1] == alone[-1]
    assert alone[t == 9.0] == pytest.approx(90 * 1.02 + 0.4 * 9, abs=0.1)
    set_state(element, sensor=True, sigma=1)
    alone, x = result_of(element, "alone", "x")
    assert alone[-1] > 4 and abs(x[-1]) < 0.5
    said = element.locator(".explorer-outcome").inner_text()
    assert "standard deviation" in said and "With the angle sensor" in said


@pytest.mark.parametrize("turn, axis", [("pitch", 0), ("roll", 1), ("yaw", 2)])
def test_gyro_every_way_to_turn_has_its_axis_and_its_other_sensor(turn, axis, phone_page):
    """A turn by 20 degrees about x, y or z: gyroscope and other sensor agree in size and sign."""
    element = explorer(phone_page, "gyro")
    t = np.arange(480) / 60
    angle = 20 * np.clip((t - 6) / 1, 0, 1)
    about = np.eye(3)[axis]
    rate = np.gradient(angle, t)[:, np.newaxis] * about
    turned = Rotation.from_rotvec(np.radians(angle)[:, np.newaxis] * about).as_matrix()
    acc = 9.8 * turned[:, 2]  # up in the axes of the device
    angles = Rotation.from_matrix(turned).as_euler("ZXY", degrees=True)
    data = readings(t, rate, acc)
    for reading, three in zip(data, angles.tolist()):
        reading["angles"] = three
    record(element, data)
    set_state(element, turn=turn)
    alone, z = result_of(element, "alone", "z")
    assert alone[-1] == pytest.approx(20, abs=0.2) and z[-1] == pytest.approx(20, abs=1e-6)


# --- chapter 6 ----------------------------------------------------------------------------------


def direction_by_python(t, gyr, z, R, sigma):
    """The filter of a direction (3) that the gyroscope turns (deg/s) and z (T, 3) measures."""
    T = np.diff(t)[:, np.newaxis]
    turns = np.radians(T * (gyr[1:] + gyr[:-1]) / 2)
    F = Rotation.from_rotvec(-turns).as_matrix()
    one = np.eye(3)
    Q = (np.radians(sigma) * T[:, np.newaxis]) ** 2 * one
    R = np.radians(1) ** 2 * R * one
    return kalman_filter(LinearModel(F=F, H=one, Q=Q, R=R, x0=z[0], P0=R), z[1:])


def units(values):
    return values / np.linalg.norm(values, axis=1, keepdims=True)


def test_quadrotor_three_opinions_of_overridden_sensors_are_pythons(phone_page):
    element, phone = explorer(phone_page, "quadrotor"), Phone(phone_page)
    phone.set((0, 0, 0), (0, 0, 9.81), heading=40)
    tap(element, START["en"])
    told = [((0, 0.6, 0), (-2, 0, 9.6)), ((0.3, -0.2, 0.5), (1, 3, 9)), ((0, 0, 0), (0, 7, 7))]
    for rates, force in told:
        phone.set(rates, force, heading=40)
        phone_page.wait_for_function(
            "([e, y]) => e.explorer.s.motion?.acc.filter((value, i) => i % 3 === 1 && "
            "Math.abs(value - y) < 0.01).length > 20",
            arg=[element.element_handle(), force[1]],
        )
    tap(element, STOP["en"])
    set_state(element, R_acc=30)
    motion = motion_of(element)
    T = len(motion["t"])
    assert motion["heading"][-1] == pytest.approx(40, abs=0.1)
    up, north, gyro, acc, K = result_of(
        element, "seen.up.filter", "seen.north.filter", "seen.up.gyro", "seen.up.acc", "seen.K"
    )
    z = units(motion["acc"])
    assert np.allclose(acc.reshape(-1, 3)[:T], z, atol=TINY)
    result = direction_by_python(motion["t"], motion["gyr"], z, R=30, sigma=1)
    assert np.allclose(up.reshape(-1, 3)[1:T], result.x, atol=TINY)
    assert np.allclose(K[1:T], result.K[:, 0, 0], rtol=TINY)
    assert np.allclose(gyro.reshape(-1, 3)[1:T], turned(motion, z[0]), atol=TINY)
    compass = north_by_python(units(result.x), motion["heading"][1:])
    first = north_by_python(z[:1], motion["heading"][:1])
    result = direction_by_python(
        motion["t"], motion["gyr"], np.vstack([first, compass]), R=100, sigma=1
    )
    assert np.allclose(north.reshape(-1, 3)[1:T], result.x, atol=TINY)


def turned(motion, start):
    """The direction that the gyroscope alone has, from the second reading on."""
    steps = np.diff(motion["t"])[:, np.newaxis]
    turns = np.radians(steps * (motion["gyr"][1:] + motion["gyr"][:-1]) / 2)
    found = [start]
    for turn in turns:
        found.append(Rotation.from_rotvec(-turn).apply(found[-1]))
    return np.array(found[1:])


def north_by_python(up, heading):
    """North in the device's axes, where its top edge, seen from above, has this heading."""
    forward = units(np.array([0, 1, 0]) - up[:, 1:2] * up)
    right = np.cross(forward, up)
    h = np.radians(heading)[:, np.newaxis]
    return np.cos(h) * forward - np.sin(h) * right


def test_quadrotor_an_upright_phone_that_turns_round_does_not_lose_the_vertical(phone_page):
    """Pitch 90 degrees, where Euler angles fail; then roll, pitch and yaw of a tilt."""
    element = explorer(phone_page, "quadrotor")
    t = np.arange(600) / 60
    rate = np.where((t > 2) & (t < 6), 45, 0)[:, np.newaxis] * [0, 1, 0]  # about its long side
    record(element, readings(t, rate, [0, 9.8, 0]))
    up, acc = result_of(element, "seen.up.filter", "seen.up.gyro")
    upright = np.tile([0, 1, 0], (len(t), 1))
    assert np.allclose(up.reshape(-1, 3)[: len(t)], upright, atol=TINY)
    assert np.allclose(acc.reshape(-1, 3)[: len(t)], upright, atol=TINY)


def test_quadrotor_the_accelerometer_is_deceived_by_a_push_and_the_filter_hardly(phone_page):
    element = explorer(phone_page, "quadrotor")
    t = np.arange(600) / 60
    push = np.where((t > 5) & (t < 6), 5, 0)[:, np.newaxis] * [1, 0, 0]
    record(element, readings(t, 0, UP + push))
    set_state(element, when=5.5)
    said = element.locator(".explorer-outcome").inner_text()
    gyro, acc, filtered = map(
        float,
        re.search(
            "roll is (.+)° by the gyroscope, (.+)° by the accelerometer, (.+)° by the filter",
            said.replace("\u2212", "-"),
        ).groups(),
    )
    assert gyro == 0 and acc == pytest.approx(-np.degrees(np.arctan2(5, 9.8)), abs=0.1)
    assert -8 < filtered < 0
    assert "Without a compass" in said


def test_quadrotor_a_recording_is_replayed_in_its_own_time_to_its_end(phone_page):
    element = explorer(phone_page, "quadrotor")
    record(element, readings(np.arange(101) / 50, 0, UP))
    seconds = element.evaluate("""e => {
      const { controls, s } = e.explorer;
      const items = controls.flatMap(control => control.items ?? []);
      return items.find(item => item.play === 'when').seconds(s);
    }""")
    assert seconds == 2
    phone_page.emulate_media(reduced_motion="no-preference")
    set_state(element, when=0.1)
    tap(element, "Replay")
    handle = element.element_handle()
    phone_page.wait_for_function(
        "e => e.explorer.playing === null && e.explorer.r.k === 100", arg=handle
    )
    assert element.evaluate("e => e.explorer.s.when") == 2
