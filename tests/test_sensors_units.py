"""What the motion sensors of a phone say, in one unit, one sign and one set of axes: the facts that
book/explorers/sensors/units.js names, with their sources."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sensors_helpers import explorer, motion_of, readings, record

TINY = 1e-9


def module(page, room, call, *values):
    """What a function of a room of the sources says."""
    script = f"async values => {{ const m = await import('/sensors/{room}.js'); return {call}; }}"
    return page.evaluate(script, list(values))


def test_rates_are_about_x_y_z_in_degrees_and_the_force_points_up_at_rest(phone_page):
    """W3C, Device Orientation and Motion: alpha, beta, gamma of the rotation rate are about x, y,
    z; lying face up, accelerationIncludingGravity is (0, 0, 9.8)."""
    event = {
        "timeStamp": 7,
        "interval": 16,
        "rotationRate": {"alpha": 1, "beta": 2, "gamma": 3},
        "accelerationIncludingGravity": {"x": 0.1, "y": 0.2, "z": 9.8},
    }
    read = "m.readingOf(values[0])"
    assert module(phone_page, "units", read, event) == {
        "t": 7,
        "gyr": [1, 2, 3],
        "acc": [0.1, 0.2, 9.8],
    }
    nothing = {"alpha": None, "beta": None, "gamma": None}
    assert module(phone_page, "units", read, event | {"rotationRate": nothing}) is None
    assert module(phone_page, "units", read, event | {"rotationRate": None}) is None
    assert module(phone_page, "units", read, event | {"accelerationIncludingGravity": None}) is None


@pytest.mark.parametrize("angles", [(0, 0, 0), (33, 40, -25), (200, -70, 60), (310, 130, 10)])
def test_up_and_heading_are_those_of_the_rotation_z_x_y(angles, phone_page):
    """The device is turned by alpha about z, beta about x', gamma about y'' out of east, north,
    up."""
    alpha, beta, gamma = angles
    body_to_world = Rotation.from_euler("ZXY", angles, degrees=True).as_matrix()
    event = {"alpha": alpha, "beta": beta, "gamma": gamma, "absolute": True}
    up = module(phone_page, "units", "m.upOf(values[0])", event)
    assert np.allclose(up, body_to_world.T @ [0, 0, 1], atol=TINY)
    east, north, _ = body_to_world @ [0, 1, 0]
    heading = module(phone_page, "units", "m.headingOf(values[0])", event)
    assert heading == pytest.approx(np.degrees(np.arctan2(east, north)) % 360, abs=TINY)
    relative = module(
        phone_page, "units", "String(m.headingOf(values[0]))", event | {"absolute": False}
    )
    assert relative == "NaN"


def test_the_heading_of_webkit_is_its_own(phone_page):
    heading = "String(m.headingOf(values[0]))"
    assert (
        module(phone_page, "units", heading, {"webkitCompassHeading": 123.5, "alpha": 0}) == "123.5"
    )
    assert module(phone_page, "units", heading, {"webkitCompassHeading": -1, "alpha": 0}) == "NaN"


@pytest.mark.parametrize(
    "acc, up, vendor, sign",
    [
        ([0, 0, 9.8], [0, 0, 1], "Google Inc.", 1),
        ([0, 0, -9.8], [0, 0, 1], "Google Inc.", -1),
        ([0, 0, -9.8], [0, 0, 1], "Apple Computer, Inc.", -1),
        ([0, 0, 9.8], [0, 0, 1], "Apple Computer, Inc.", 1),
        ([0, -9.8, 0], None, "Apple Computer, Inc.", -1),
        ([0, 9.8, 0], None, "", 1),
        ([9.8, 0, 0], [0, 0, 1], "Apple Computer, Inc.", -1),  # shaken: the angles tell nothing
    ],
)
def test_the_sign_is_that_of_the_devices_own_angles_else_that_of_the_browser(
    acc, up, vendor, sign, phone_page
):
    assert module(phone_page, "units", "m.signOf(...values)", acc, up, vendor) == sign


def test_an_iphone_lies_the_same_way_up(phone_page):
    element = explorer(phone_page, "gyro")
    data = readings(np.arange(30) / 60, 0, [0.1, -0.2, -9.8], angles=[0, 0, 0])
    record(element, data)
    assert np.allclose(motion_of(element)["acc"], [-0.1, 0.2, 9.8], atol=TINY)
