"""Recordings as readers really have them: useless files, headers of loggers, equal times, other
axes, a magnetometer that disagrees; and files made to do harm."""

import io
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest
from recording_files import (
    PLAIN,
    TILTED,
    G,
    own,
    phone,
    phyphox,
    plain,
    refused,
    said,
    sensor_logger,
    times,
    zipped,
)

from kalman_lib.data import InputError, read_recording
from kalman_lib.data.columns import read_header
from kalman_lib.papers import quadrotor

# --- files without a sensor ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("Annotation.csv", b""),
        ("Location.csv", b'"Time (s)","Latitude (\xc2\xb0)","Longitude (\xc2\xb0)"\n'),
        ("Annotation.csv", b"time,seconds_elapsed,text\n1,0.5,start here\n"),
        ("Barometer.csv", b"time,seconds_elapsed,pressure\n1,0.5,1013\n2,1.0,1012\n"),
        ("notes.txt", b"walked to the shop\nand back\n"),
    ],
)
def test_a_useless_file_is_passed_over(name, content):
    want = read_recording(phyphox(TILTED))
    for files in (
        {name: content} | phyphox(TILTED),
        {"all.zip": zipped({name: content} | phyphox(TILTED))},
    ):
        recording = read_recording(files)
        assert said(recording, f"Passed over: {'all.zip/' if 'all.zip' in files else ''}{name}")
        np.testing.assert_array_equal(recording.gyr, want.gyr)


def test_sensor_logger_with_an_empty_annotation():
    files, _ = sensor_logger(TILTED)
    assert len(read_recording(files | {"Annotation.csv": b""}).t) == 401


def test_without_a_sensor_the_headers_that_were_not_understood_are_named():
    refused({"run.csv": b"t (s),wx,wy,wz\n0,1,2,3\n"}, "run.csv", "'wx'", "Gyroscope x (rad/s)")


# --- headers ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("header", "kind", "unit"),
    [
        ("ax (G)", "acc", "g"),
        ("ay (mg)", "acc", "mg"),
        ("mx (mG)", "mag", "mG"),
        ("mx (G)", "mag", "G"),
        ("GYROSCOPE Z (rad/s)", "gyr", "rad/s"),
        ("gyro_x (deg/sec)", "gyr", "deg/sec"),
        ("Gyro.Y [rad/sec]", "gyr", "rad/sec"),
        ("Beschleunigung (ohne g) x (m/s^2)", "acc", "m/s2"),
        ("Waktu (detik)", "time", "detik"),
        ("Time since start in ms", "time", "ms"),
        ("timestamp", "time", None),
        ("Latitude (°)", None, "°"),
    ],
)
def test_headers_as_apps_and_loggers_write_them(header, kind, unit):
    column = read_header(header)
    assert (column.kind, column.unit) == (kind, unit)


@pytest.mark.parametrize(("unit", "factor"), [("mg", 1000 / G), ("G", 1 / G), ("g", 1 / G)])
def test_accelerations_in_thousandths_and_in_capitals(unit, factor):
    t = times(50)
    gyr, acc, mag = phone(t)
    file = plain(PLAIN.format(g="deg/sec", a=unit), t, np.degrees(gyr), acc * factor, mag)
    recording = read_recording({"own.csv": file})
    assert np.allclose(np.linalg.norm(recording.acc, axis=1), G)


def test_a_column_that_comes_twice_is_refused():
    header = PLAIN.format(g="rad/s", a="m/s2").replace("gy", "gx")
    refused(own(header=header), "'gx (rad/s)' comes twice")


def test_every_converted_column_is_told():
    header = PLAIN.format(g="rad/s", a="m/s2").replace("gx (rad/s)", "gx (deg/s)")
    recording = read_recording(own(header=header))
    assert said(recording, "converted to rad/s: gx (deg/s).")


@pytest.mark.parametrize("header", ["a" + " " * 20_000 + "b", "_" * 60_000 + "x", "(" * 50_000])
def test_a_long_header_takes_no_longer(header):
    """These took seconds to minutes when regular expressions read them."""
    assert read_header(header).kind is None
    refused({"own.csv": f"{header},b\n1,2\n".encode()}, "own.csv")


def test_too_many_columns_are_refused():
    refused({"own.csv": (",".join(["x (g)"] * 5000) + "\n1\n").encode()}, "5000 columns")


# --- times --------------------------------------------------------------------------------------


def test_rows_with_equal_times_are_averaged():
    """A logger with coarse stamps: two rows a stamp."""
    t = np.repeat(times(25, 3.96), 2)
    values = np.column_stack([
        t,
        np.zeros((len(t), 3)),
        np.tile([0, 0, -G, 20, 0, 40], (len(t), 1)),
    ])
    values[:, 1] = np.tile([0.1, 0.3], len(t) // 2)
    header = PLAIN.format(g="rad/s", a="m/s2")
    recording = read_recording({"own.csv": plain(header, *values.T)})
    assert len(recording.t) == len(t) // 2 and np.allclose(recording.gyr[:, 0], 0.2)
    assert said(recording, "share their times") and recording.rate == pytest.approx(25)


@pytest.mark.parametrize(
    "stamp",
    ["2024-01-01T10:{:02d}:{:06.3f}", "01/02/2024 10:{:02d}:{:06.3f}", "10:{:02d}:{:06.3f}"],
)
def test_dates_and_clock_times_become_seconds(stamp):
    t = times(50, 3.98)
    cells = {(k, 0): stamp.format(59, 56 + s) if s < 4 else "" for k, s in enumerate(t)}
    content = own(header=PLAIN.format(g="rad/s", a="m/s2").replace("t (s)", "time"), cells=cells)
    recording = read_recording(content)
    assert np.allclose(recording.t, t, atol=1e-6) and len(recording.t) == 200


def test_times_that_go_back_are_shown_with_all_digits():
    cells = {(10, 0): "134000.0000002", (11, 0): "134000.0000001"}
    cells |= {(k, 0): repr(134001.0 + k) for k in range(12, 200)}
    refused(own(cells=cells), "134000.0000001 s after 134000.0000002 s")


def test_times_that_hardly_differ_are_refused():
    cells = {(k, 0): repr(k * 5e-324) for k in range(200)}
    refused(own(cells=cells), "own.csv", "hardly differ")


# --- axes ---------------------------------------------------------------------------------------


def test_axes_by_name_and_by_letters():
    files = phyphox(TILTED)
    want = read_recording(files)
    for axes in ("phone", "y x -z", "+y +x -z", dict.fromkeys(("gyr", "acc", "mag"), "phone")):
        recording = read_recording(files, axes=axes)
        for name in ("gyr", "acc", "mag"):
            np.testing.assert_array_equal(getattr(recording, name), getattr(want, name))
    turned = read_recording(files, axes="x -y -z")
    np.testing.assert_allclose(turned.gyr, read_recording(files, axes="flu").gyr)


@pytest.mark.parametrize("axes", ["x y -z", "x x z", "x y", "xyz", "", 3, {"gyr": "frd"}])
def test_axes_of_no_frame_are_refused(axes):
    with pytest.raises(ValueError, match="axes is .* right-handed.* / axes berisi"):
        read_recording(own(), axes=axes)


def test_names_with_underscores_are_those_of_a_logger():
    header = ",".join(
        ["t (s)"]
        + [
            f"{name}_{axis} ({unit})"
            for name, unit in (("gyro", "deg/s"), ("acc", "g"), ("mag", "uT"))
            for axis in "xyz"
        ]
    )
    t = times(50)
    level = np.tile([0, 0, 0, 0, 0, 1.0, 20, 0, -40], (len(t), 1))  # z up
    recording = read_recording({"own.csv": plain(header, t, *level.T)})
    assert said(recording, "forward-left-up") and np.allclose(recording.acc[0], [0, 0, -G])


def tumbling(swap):
    """A plain file of a device that rests in twelve poses; its magnetometer's axes may be
    swapped."""
    rng, rows = np.random.default_rng(5), []
    for _ in range(12):
        angles = np.tile(rng.uniform([-1.5, -1.2, -3], [1.5, 1.2, 3]), (50, 1))
        acc = quadrotor.to_body([0, 0, -G], angles)
        mag = quadrotor.to_body([40, 0, 30], angles) + rng.normal(0, 0.5, (50, 3))
        rows.append(np.column_stack([np.zeros((50, 3)), acc, mag @ swap.T]))
    values = np.vstack(rows)
    t = np.arange(len(values)) / 50
    return {"own.csv": plain(PLAIN.format(g="rad/s", a="m/s2"), t, *values.T)}


def test_a_magnetometer_with_swapped_axes_is_told_and_the_right_ones_are_named():
    """As on MPU-9250 boards: x and y exchanged, z turned round."""
    swap = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
    assert not said(read_recording(tumbling(np.eye(3)), axes="frd"), "The angle between gravity")
    recording = read_recording(tumbling(swap), axes="frd")
    assert said(recording, "not the same in every pose") and said(recording, "read as y x -z")
    axes = {"gyr": "frd", "acc": "frd", "mag": "y x -z"}
    assert not said(read_recording(tumbling(swap), axes=axes), "The angle between gravity")


# --- old workbooks ------------------------------------------------------------------------------

XLS = (Path(__file__).parent / "phyphox.xls").read_bytes()


def test_an_old_workbook_of_phyphox():
    recording = read_recording({"phyphox.xls": XLS})
    assert np.allclose(recording.t, np.arange(24) / 50)
    assert np.allclose(recording.gyr[0], [0, 0, -0.5]) and np.allclose(recording.acc[0], [0, 0, -G])
    inside = read_recording({"all.zip": zipped({"phyphox.xls": XLS})})
    assert np.array_equal(inside.gyr, recording.gyr)


@pytest.mark.parametrize("content", [b"\xd0\xcf\x11\xe0" * 50, XLS[:3000], XLS[:100] + XLS[400:]])
def test_a_damaged_old_workbook_is_one_sentence(content):
    refused({"run.xls": content}, "run.xls", ".xlsx")


# --- files made to do harm ----------------------------------------------------------------------


@pytest.mark.parametrize("end", [14, 22, 60, 400])
def test_a_cut_archive_is_one_sentence(end):
    content = zipped(phyphox(TILTED))
    refused({"run.zip": content[:-end]}, "cannot be unpacked")


def test_every_archive_with_a_changed_byte_is_read_or_refused():
    content = bytearray(zipped({"own.csv": own(rows=12)["own.csv"][:400]}))
    for place in range(len(content)):
        changed = content.copy()
        changed[place] ^= 0x5A
        try:
            read_recording({"run.zip": bytes(changed)})
        except InputError as error:
            assert error.en and error.id


def test_an_archive_that_unpacks_to_much_needs_little_memory():
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for k in range(4):
            archive.writestr(f"{k}.csv", bytes(30_000_000))
    tracemalloc.start()
    refused({"bomb.zip": content.getvalue()}, "MB")
    assert tracemalloc.get_traced_memory()[1] < 10e6
    tracemalloc.stop()


@pytest.mark.parametrize(
    "metadata", [b'version\rplatform,\r"', b"\xff\xfe\x00", b'"' + b"a" * 200_000]
)
def test_a_strange_metadata_file_is_left_alone(metadata):
    files, _ = sensor_logger(TILTED)
    assert said(read_recording(files | {"Metadata.csv": metadata}), "Metadata.csv is missing")


@pytest.mark.parametrize(("column", "name"), [(5, "accelerometer"), (8, "magnetometer")])
def test_a_value_that_no_sensor_shows(column, name):
    refused(own(cells={(10, column): "1e308"}), "line 12", f"no {name} shows")
