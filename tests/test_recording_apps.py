"""Recordings of phyphox and Sensor Logger, in each of their formats."""

import io
import warnings

import numpy as np
import pytest
from openpyxl import Workbook
from recording_files import (
    ACCELERATION,
    TILTED,
    WORDS,
    expected,
    phone,
    phyphox,
    refused,
    said,
    sensor_logger,
    table,
    times,
    zipped,
)

from kalman_lib.data import read_recording

# --- phyphox ------------------------------------------------------------------------------------

STYLES = [
    {},
    {"separator": ";"},
    {"separator": "\t"},
    {"separator": ";", "decimal": ","},
    {"separator": "\t", "decimal": ","},
]


@pytest.mark.parametrize("language", WORDS)
@pytest.mark.parametrize("style", STYLES)
def test_phyphox_in_its_five_formats_and_three_languages(language, style):
    recording = read_recording(phyphox(TILTED, language, style=style))
    t = recording.t
    np.testing.assert_allclose(t, times(100), atol=1e-12)
    assert recording.rate == pytest.approx(100)
    for k, values in enumerate((recording.gyr, recording.acc, recording.mag)):
        for i in (
            0,
            137,
            -1,
        ):  # the magnetometer is read at 20 Hz: its curve bends between its samples
            want = expected(TILTED["roll"], TILTED["pitch"], 0.5 + 0.4 * t[i], 0.4)
            np.testing.assert_allclose(
                values[i], want[k], atol=1e-9 if k < 2 else 50 * (0.4 * 0.05) ** 2 / 8
            )
    assert said(recording, "100 Hz") and said(recording, "50 Hz") and said(recording, "20 Hz")
    assert said(recording, "interpolated linearly") and said(recording, "a phone")


def test_phyphox_as_zip_as_folder_and_as_paths(tmp_path):
    files = phyphox(TILTED)
    want = read_recording(files)
    meta = {
        "meta/device.csv": '"property","value"\n"version","1.1"\n',
        "meta/time.csv": '"event","experiment time"\n',
    }
    (tmp_path / "run.zip").write_bytes(zipped(files | meta))
    (tmp_path / "run").mkdir()
    for name, content in files.items():
        (tmp_path / "run" / name).write_bytes(content)
    for source in (
        tmp_path / "run.zip",
        str(tmp_path / "run.zip"),
        tmp_path / "run",
        sorted((tmp_path / "run").iterdir()),
        {"run.zip": memoryview(zipped(files | meta))},
    ):
        for key in ("t", "gyr", "acc", "mag"):
            np.testing.assert_array_equal(getattr(read_recording(source), key), getattr(want, key))


def test_a_folder_of_the_reader_may_be_called_meta(tmp_path):
    """Only what an app put into a folder of that name is left out."""
    files, folder = phyphox(TILTED), tmp_path / "meta"
    want = read_recording(files)
    (folder / "meta").mkdir(parents=True)
    (folder / "meta" / "device.csv").write_text("property,value\nversion,1.1\n")
    for name, content in files.items():
        (folder / name).write_bytes(content)
    (folder / "run.zip").write_bytes(zipped(files))
    for source in (folder / "run.zip", [folder / name for name in files]):
        np.testing.assert_array_equal(read_recording(source).gyr, want.gyr)
    (folder / "run.zip").unlink()
    np.testing.assert_array_equal(read_recording(folder).gyr, want.gyr)


def test_phyphox_as_a_workbook_with_a_sheet_per_sensor():
    files, book = phyphox(TILTED), Workbook()
    for name, content in files.items():
        sheet = book.create_sheet(name.removesuffix(".csv"))
        for row in content.decode().splitlines():
            sheet.append([
                float(cell) if cell[0] != '"' else cell.strip('"') for cell in row.split(",")
            ])
        sheet.append(["NaN"] * 4)  # phyphox fills columns that are too short
    extra = book.create_sheet("Metadata Device")
    extra.append(["property", "value"])
    extra.append(["build", 123])
    content = io.BytesIO()
    book.save(content)
    recording, want = read_recording({"run.xlsx": content.getvalue()}), read_recording(files)
    for key in ("t", "gyr", "acc", "mag"):
        np.testing.assert_allclose(getattr(recording, key), getattr(want, key), atol=1e-9)


def test_one_table_with_all_sensors_and_its_own_clock_for_each():
    parts = phyphox(TILTED, rates=(100, 100, 100))
    blocks = [part.decode().splitlines() for part in parts.values()]
    recording = read_recording({"all.csv": "\n".join(map(",".join, zip(*blocks))).encode()})
    want = read_recording(parts)
    for key in ("gyr", "acc", "mag"):
        np.testing.assert_array_equal(getattr(recording, key), getattr(want, key))
    assert not said(recording, "interpolated")


def test_shorter_columns_filled_with_NaN_are_only_shorter():
    files = phyphox(TILTED)
    want = read_recording(files)
    files["Accelerometer.csv"] += b"NaN,NaN,NaN,NaN\n" * 3
    recording = read_recording(files)
    np.testing.assert_array_equal(recording.acc, want.acc)
    assert not said(recording, "left out")


def test_bare_axes_with_units_are_understood():
    files = phyphox(TILTED)
    want = read_recording(files)
    for name, stem in (
        ("Gyroscope.csv", "Gyroscope "),
        ("Accelerometer.csv", "Acceleration "),
        ("Magnetometer.csv", "Magnetic Field "),
    ):
        files[name] = files[name].replace(stem.encode(), b"")
    recording = read_recording(files)
    for key in ("gyr", "acc", "mag"):
        np.testing.assert_array_equal(getattr(recording, key), getattr(want, key))


def test_acceleration_without_gravity_is_refused_with_and_without_its_name():
    files = phyphox({})
    t = times(50)
    for name in (
        "Linear Acceleration",
        "Beschleunigung (ohne g)",
        "Percepatan (tanpa g)",
        "Acceleration without g",
    ):
        header = ["Time (s)"] + [f"{name} {axis} (m/s^2)" for axis in "xyz"]
        files["Accelerometer.csv"] = table(header, t, np.zeros((len(t), 3)))
        refused(files, "Accelerometer.csv", "no gravity")
    files["Accelerometer.csv"] = table(ACCELERATION, t, np.zeros((len(t), 3)))
    refused(files, "gravity was taken out")


def test_linear_acceleration_and_gravity_are_added():
    files = phyphox(TILTED)
    want = read_recording(files)
    for name, share in (("Linear Acceleration", 0.25), ("Gravity", 0.75)):
        t, header = times(50), ["Time (s)"] + [f"{name} {axis} (m/s^2)" for axis in "xyz"]
        files[f"{name}.csv"] = table(header, t, share * phone(t, **TILTED)[1])
    del files["Accelerometer.csv"]
    recording = read_recording(files)
    np.testing.assert_allclose(recording.acc, want.acc, atol=1e-9)
    assert said(recording, "were added")


# --- Sensor Logger ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "platform, standard", [("android", "false"), ("android", ""), ("ios", "false"), ("ios", "true")]
)
@pytest.mark.parametrize("total", [True, False])
def test_sensor_logger(platform, standard, total):
    files, moved = sensor_logger(TILTED, platform, standard)
    if not total:
        del files["TotalAcceleration.csv"]
    recording = read_recording({"run.zip": zipped(files)})
    gyr, acc, mag = phone(recording.t, **TILTED)

    def turn(xyz):
        return np.column_stack([xyz[:, 1], xyz[:, 0], -xyz[:, 2]])

    np.testing.assert_allclose(recording.gyr, turn(gyr), atol=1e-9)
    np.testing.assert_allclose(recording.acc, turn(acc + moved), atol=1e-9)
    np.testing.assert_allclose(recording.mag, turn(mag), atol=1e-9)
    assert said(recording, "iPhone") == (platform == "ios" and standard == "false")
    if said(recording, "iPhone"):
        assert recording.reference is None and said(recording, "left out")
        return
    assert said(recording, "Reference")
    np.testing.assert_allclose(recording.reference[:, 0], TILTED["roll"], atol=1e-9)
    np.testing.assert_allclose(recording.reference[:, 1], TILTED["pitch"], atol=1e-9)
    np.testing.assert_allclose(
        recording.reference[:, 2], TILTED["yaw0"] + TILTED["yaw_rate"] * recording.t, atol=1e-9
    )


def test_sensor_logger_without_metadata_tells_which_sign_was_taken():
    files, _ = sensor_logger(TILTED)
    del files["Metadata.csv"]
    recording = read_recording(files)
    assert said(recording, "Metadata.csv is missing") and recording.reference is not None
    files, _ = sensor_logger(TILTED, "ios")
    del files["Metadata.csv"]
    recording = read_recording(files)  # the app's orientation contradicts the sign: it is not used
    assert recording.reference is None and said(recording, "differs from gravity")


def test_sensor_logger_with_half_a_metadata_file_and_a_phone_upright():
    files, _ = sensor_logger({"pitch": np.pi / 2})
    files["Metadata.csv"] = b"version,device name,platform\n3,Phone\n"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        recording = read_recording(files)
    assert said(recording, "Metadata.csv is missing")


def test_sensor_logger_needs_gravity():
    files, _ = sensor_logger(TILTED)
    del files["TotalAcceleration.csv"], files["Gravity.csv"]
    refused(files, "Accelerometer.csv", "TotalAcceleration", "Gravity")


def test_real_rows_of_an_android_phone_agree_with_the_convention():
    """Rows of a real recording (SM-S926U1, app 1.28) about 2.83 s after the start, lying still."""
    qz, qy, qx, qw = (
        0.8110520839691162,
        0.5081670880317688,
        0.14988213777542114,
        0.24798399209976196,
    )  # Orientation
    roll, pitch, yaw = 0.020312074571847916, -1.1166518926620483, -2.535446882247925
    z, y, x = 4.18983268737793, 8.69791030883789, -0.035892341285943985  # TotalAcceleration
    up = np.array([x, y, z]) / np.linalg.norm([x, y, z])
    # the right edge sinks by roll, the top edge rises by -pitch
    assert np.degrees(np.arctan2(-up[0], up[2])) == pytest.approx(np.degrees(roll), abs=1)
    assert np.degrees(np.arcsin(up[1])) == pytest.approx(np.degrees(-pitch), abs=1)
    # and by the quaternion (phone to east-north-up): up in phone axes, heading of the top edge
    # clockwise from north
    by_quaternion = 2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), 1 - 2 * (qx**2 + qy**2)
    np.testing.assert_allclose(by_quaternion, up, atol=0.02)
    assert np.arctan2(2 * (qx * qy - qw * qz), 1 - 2 * (qx**2 + qz**2)) == pytest.approx(
        yaw, abs=1e-3
    )


def test_yaw_of_the_reference_is_interpolated_across_180_degrees():
    files, _ = sensor_logger({"yaw0": 3.0, "yaw_rate": 0.4})
    rows = files["Orientation.csv"].decode().splitlines()
    files["Orientation.csv"] = "\n".join(rows[:1] + rows[1::10]).encode()  # 10 Hz
    recording = read_recording(files)
    error = recording.reference[:, 2] - (3.0 + 0.4 * recording.t)
    assert (
        np.abs(np.angle(np.exp(1j * error))).max() < 1e-5
        and np.abs(recording.reference[:, 2]).max() <= np.pi
    )
