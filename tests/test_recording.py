"""A recording is read: signs and axes, a plain CSV, rates and gaps."""

import numpy as np
import pytest
from recording_files import (
    ACCELERATION,
    GYRO,
    PLAIN,
    TILTED,
    G,
    expected,
    own,
    phyphox,
    plain,
    refused,
    said,
    table,
    times,
)

from kalman_lib.data import read_recording
from kalman_lib.data.recording import AXES

# --- signs, by hand -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "lying, acc",
    [
        # on the table, face up: the table pushes along +z of the phone
        ([0, 0, G], [0, 0, -G]),
        # top edge raised by 30 degrees: the push has a part along +y
        ([0, G / 2, G * np.sqrt(3) / 2], [G / 2, 0, -G * np.sqrt(3) / 2]),
        # right edge lowered by 30 degrees: +x points down, the push has a part along -x
        ([-G / 2, 0, G * np.sqrt(3) / 2], [0, -G / 2, -G * np.sqrt(3) / 2]),
    ],
)
def test_a_phone_at_rest_in_three_poses(lying, acc):
    t = times(100)
    files = {
        "Gyroscope.csv": table(GYRO, t, np.zeros((len(t), 3))),
        "Accelerometer.csv": table(ACCELERATION, t, np.tile(lying, (len(t), 1))),
    }
    recording = read_recording(files)
    np.testing.assert_allclose(recording.acc, np.tile(acc, (len(t), 1)), atol=1e-9)
    assert (
        recording.mag is None and recording.reference is None and said(recording, "no magnetometer")
    )
    roll, pitch = (
        np.arctan2(-recording.acc[0, 1], -recording.acc[0, 2]),
        np.arctan2(recording.acc[0, 0], np.hypot(*recording.acc[0, 1:])),
    )
    np.testing.assert_allclose(
        np.degrees([roll, pitch]), [30 * (lying[0] < 0), 30 * (lying[1] > 0)], atol=1e-6
    )


@pytest.mark.parametrize(
    "turn, gyr",
    [
        ([0, 0, -1], [0, 0, 1]),  # flat, turning clockwise seen from above: heading increases
        ([1, 0, 0], [0, 1, 0]),  # the top edge rises (right-hand rule about x): pitch increases
        ([0, 1, 0], [1, 0, 0]),  # the right edge sinks (right-hand rule about y): roll increases
    ],
)
def test_turns_of_a_phone(turn, gyr):
    t = times(100)
    files = phyphox({})
    files["Gyroscope.csv"] = table(GYRO, t, np.tile(turn, (len(t), 1)))
    np.testing.assert_allclose(read_recording(files).gyr, np.tile(gyr, (len(t), 1)), atol=1e-12)


def test_the_axes_are_right_handed():
    for turn in AXES.values():
        assert np.linalg.det(turn) == pytest.approx(1)
        np.testing.assert_array_equal(turn @ turn.T, np.eye(3))


# --- a plain CSV --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "gyro, factor", [("rad/s", 1), ("deg/s", 180 / np.pi), ("°/s", 180 / np.pi)]
)
@pytest.mark.parametrize(
    "acceleration, scale", [("m/s2", 1), ("m/s^2", 1), ("m/s²", 1), ("g", 1 / G)]
)
def test_a_plain_file_in_its_units(gyro, factor, acceleration, scale):
    t = times(50)
    gyr, acc, mag = (np.tile(v, (len(t), 1)) for v in expected(0.2, -0.1, 1.0, 0.3))
    content = plain(PLAIN.format(g=gyro, a=acceleration), t, factor * gyr, scale * acc, 7 * mag)
    recording = read_recording({"own.csv": content})
    np.testing.assert_allclose(recording.gyr, gyr, atol=1e-12)
    np.testing.assert_allclose(recording.acc, acc, rtol=1e-12)
    np.testing.assert_allclose(recording.mag, 7 * mag, rtol=1e-12)
    assert said(recording, "forward-right-down")
    assert said(recording, "converted to rad/s") == (factor != 1)
    assert said(recording, "converted to m/s2") == (scale != 1)
    other = read_recording({"own.csv": content}, axes="flu")
    np.testing.assert_allclose(other.gyr, gyr * [1, -1, -1], atol=1e-12)
    with pytest.raises(ValueError):
        read_recording({"own.csv": content}, axes="xyz")


def test_a_plain_file_whose_z_points_up_is_told():
    assert not said(read_recording(own()), "upside down")
    recording = read_recording({"own.csv": own()["own.csv"].replace(b"-9.8", b"9.8")})
    assert said(recording, "upside down") and said(recording, "forward-left-up")
    assert np.allclose(recording.acc[0], [0, 0, -G])  # level, not upside down


def test_time_in_milliseconds_from_an_epoch_and_without_a_unit():
    t = times(50)
    body = [np.tile(v, (len(t), 1)) for v in expected(0, 0, 0, 0)]
    recording = read_recording({
        "own.csv": plain(
            PLAIN.format(g="rad/s", a="g").replace("t (s)", "t (ms)"),
            1.7e12 + 1000 * t,
            body[0],
            body[1] / G,
            body[2],
        )
    })
    np.testing.assert_allclose(recording.t, t, atol=1e-3)
    recording = read_recording({
        "own.csv": plain(
            PLAIN.format(g="rad/s", a="g").replace("t (s)", "t"), t, body[0], body[1] / G, body[2]
        )
    })
    assert recording.rate == pytest.approx(50) and said(recording, "seconds were taken")


def test_a_slow_magnetometer_with_empty_cells():
    cells = {(row, column): "" for row in range(200) if row % 5 for column in (7, 8, 9)}
    recording = read_recording(own(201, cells=cells))
    np.testing.assert_allclose(recording.mag, np.tile([20, 0, 40], (201, 1)))
    assert said(recording, "left out") and said(recording, "magnetometer 10 Hz")


def test_comments_blank_lines_other_columns_and_a_byte_order_mark():
    content = own()["own.csv"].decode().splitlines()
    content = ["# my run", ""] + [f"{content[0]},remark"] + [f"{row},calm" for row in content[1:]]
    recording = read_recording({"own.csv": ("\ufeff" + "\r\n\r\n".join(content)).encode()})
    assert len(recording.t) == 200


@pytest.mark.parametrize("end", [b"\r\n", b"\r"])
def test_line_ends_of_other_systems(end):
    assert len(read_recording({"own.csv": own()["own.csv"].replace(b"\n", end)}).t) == 200


def test_decimal_commas_mixed_with_points_are_refused():
    content = own()["own.csv"].replace(b",", b";").replace(b".", b",")
    assert len(read_recording({"own.csv": content}).t) == 200
    refused({"own.csv": content.replace(b"20,0", b"20.0", 1)}, "line 2", "'20.0'", "decimal comma")


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "cp1252"])
def test_encodings_of_the_degree_sign(encoding):
    header = PLAIN.format(g="°/s", a="m/s²")
    content = own(header=header)["own.csv"].decode().encode(encoding)
    assert len(read_recording({"own.csv": content}).t) == 200


# --- rates, gaps, overlap -----------------------------------------------------------------------


def test_different_starts_leave_only_the_common_time():
    recording = read_recording(phyphox(TILTED, starts=(0, 0.5, 1.0)))
    assert recording.t[0] == 0 and recording.t[-1] == pytest.approx(3.0)
    want = expected(TILTED["roll"], TILTED["pitch"], 0.5 + 0.4 * 1.0, 0.4)
    np.testing.assert_allclose(recording.mag[0], want[2], atol=1e-9)  # what was measured at 1 s
    assert said(recording, "Only the 3.00 s")


def test_linear_interpolation_between_two_samples():
    t = times(100)
    files = phyphox({})
    slow = np.arange(0, 4.5, 0.5)
    ramp = np.column_stack([slow, 2 * slow, 3 * slow])
    files["Magnetometer.csv"] = table(
        ["Time (s)"] + [f"Magnetic field {a} (µT)" for a in "xyz"], slow, ramp
    )
    np.testing.assert_allclose(
        read_recording(files).mag, np.column_stack([2 * t, t, -3 * t]), atol=1e-9
    )


def test_gaps_are_told():
    files = phyphox(TILTED)
    rows = files["Gyroscope.csv"].decode().splitlines()
    files["Gyroscope.csv"] = "\n".join(rows[:101] + rows[151:]).encode()  # after 0.99 s comes 1.5 s
    recording = read_recording(files)
    assert said(recording, "Gaps of the gyroscope: 1; the longest, 0.51 s, begins at 0.99 s")
    assert not said(read_recording(phyphox(TILTED)), "Gaps")


def test_sensors_that_do_not_overlap():
    refused(phyphox(TILTED, starts=(0, 10, 0)), "Gyroscope.csv", "Accelerometer.csv", "10.00")
    refused(phyphox(TILTED, starts=(0, 0, -4)), "Magnetometer.csv")


def test_repeated_rows_are_left_out_but_time_must_increase():
    files = phyphox(TILTED)
    rows = files["Gyroscope.csv"].decode().splitlines()
    want = read_recording(files)
    files["Gyroscope.csv"] = "\n".join(rows[:51] + [rows[50]] + rows[51:]).encode()
    recording = read_recording(files)
    np.testing.assert_array_equal(recording.gyr, want.gyr)
    assert said(recording, "1 rows that repeat")
    files["Gyroscope.csv"] = "\n".join(rows[:51] + [rows[49]] + rows[51:]).encode()
    refused(files, "Gyroscope.csv, line 52", "does not increase")
