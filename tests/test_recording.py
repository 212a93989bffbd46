"""Files in each app's format, made from a motion whose numbers follow from geometry; and the real
x-IMU recording."""

import gzip
import io
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook

from kalman_lib.data import InputError, Recording, read_recording, read_ximu, rest_seconds
from kalman_lib.data.recording import AXES

XIMU = Path(__file__).resolve().parent.parent / "notebooks" / "data" / "ximu.csv.gz"
G = 9.80665
FIELD = np.array([40.0, 0.0, 30.0])  # magnetic field, north-east-down, uT


# --- a phone that moves as we say, in its own axes ----------------------------------------------


def directions(roll, pitch, yaw):
    """Where the phone's top edge, right edge and back point, in north-east-down: heading yaw, then
    the top edge is raised by pitch, then the right edge is lowered by roll, each turn by its
    elementary picture."""
    top = np.array([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), -np.sin(pitch)])
    level_right = np.array([-np.sin(yaw), np.cos(yaw), 0 * yaw])
    level_back = np.cross(top, level_right, axis=0)
    right = np.cos(roll) * level_right + np.sin(roll) * level_back
    return top, right, np.cross(top, right, axis=0)


def phone(t, roll=0.0, pitch=0.0, yaw0=0.0, yaw_rate=0.0):
    """What an Android phone measures at times t (n,), tilted by constant angles (rad) while its
    heading turns clockwise by yaw_rate (rad/s): gyr, acc, mag (n, 3) along x = right edge, y = top
    edge, z = out of the screen."""
    yaw = yaw0 + yaw_rate * t
    top, right, back = directions(roll + 0 * t, pitch + 0 * t, yaw)
    axes = right, top, -back
    up, turn = np.array([0, 0, -1]), np.array([0, 0, yaw_rate])  # clockwise from above = about down
    along = lambda vector: np.column_stack([vector @ axis for axis in axes])
    return along(turn), along(G * up), along(FIELD)


def times(rate, seconds=4.0, start=0.0):
    return start + np.arange(int(seconds * rate) + 1) / rate


def table(header, *columns, separator=",", decimal=".", digits="%.12e"):
    """A CSV as phyphox writes it."""
    rows = np.column_stack(columns)
    lines = [separator.join(f'"{name}"' for name in header)]
    lines += [separator.join(digits % value for value in row).replace(".", decimal) for row in rows]
    return ("\n".join(lines) + "\n").encode()


def zipped(files):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return content.getvalue()


WORDS = {
    "en": ("Time (s)", "Gyroscope {} (rad/s)", "Acceleration {} (m/s^2)", "Magnetic Field {} (µT)"),
    "de": ("Zeit (s)", "Gyroskop {} (rad/s)", "Beschleunigung {} (m/s^2)", "Magnetfeld {} (µT)"),
    "id": ("Waktu (s)", "Giroskop {} (rad/s)", "Percepatan {} (m/s²)", "Medan magnet {} (μT)"),
}

GYRO, ACCELERATION = (
    ["Time (s)"] + [WORDS["en"][k].format(axis) for axis in "xyz"] for k in (1, 2)
)


def phyphox(motion, language="en", rates=(100, 50, 20), starts=(0, 0, 0), style={}):
    """The files of a phyphox export, {name: bytes}."""
    time, *names = WORDS[language]
    files = {}
    for k, file in enumerate(("Gyroscope", "Accelerometer", "Magnetometer")):
        t, name = times(rates[k], start=starts[k]), names[k]
        files[f"{file}.csv"] = table(
            [time] + [name.format(axis) for axis in "xyz"], t, phone(t, **motion)[k], **style
        )
    return files


METADATA = "version,device name,platform,appVersion,standardisation\n3,{},{},1.50,{}\n"


def sensor_logger(motion, platform="android", standard="false", rate=100.0):
    """The files of a Sensor Logger export. On iOS accelerations have the opposite sign unless
    standardised."""
    t = times(rate)
    gyr, acc, mag = phone(t, **motion)
    sign = -1 if platform == "ios" and standard != "true" else 1
    roll, pitch = float(motion.get("roll", 0)), float(motion.get("pitch", 0))
    yaw = motion.get("yaw0", 0) + motion.get("yaw_rate", 0) * t
    header = ["time", "seconds_elapsed", "z", "y", "x"]

    def file(values):
        return (
            "\n".join(
                [",".join(header)]
                + [
                    f"{1700000000000000000 + round(1e9 * s)},{s!r},{z!r},{y!r},{x!r}"
                    for s, (x, y, z) in zip(t.tolist(), values.tolist())
                ]
            )
            + "\n"
        ).encode()

    moved = 0.3 * np.column_stack([np.sin(t), np.cos(t), 0 * t])  # acceleration that the user adds
    angles = zip(t.tolist(), np.angle(np.exp(1j * yaw)).tolist())
    orientation = "time,seconds_elapsed,qz,qy,qx,qw,roll,pitch,yaw\n" + "".join(
        f"{1700000000000000000 + round(1e9 * s)},{s!r},0,0,0,1,{roll!r},{-pitch!r},{y!r}\n"
        for s, y in angles
    )
    return {
        "Accelerometer.csv": file(sign * moved),
        "Gravity.csv": file(sign * acc),
        "TotalAcceleration.csv": file(sign * (acc + moved)),
        "Gyroscope.csv": file(gyr),
        "Magnetometer.csv": file(mag),
        "Orientation.csv": orientation.encode(),
        "GyroscopeUncalibrated.csv": file(gyr + 1),
        "Metadata.csv": METADATA.format("Phone", platform, standard).encode(),
    }, moved


PLAIN = "t (s),gx ({g}),gy ({g}),gz ({g}),ax ({a}),ay ({a}),az ({a}),mx (uT),my (uT),mz (uT)"


def plain(header, *columns):
    return (
        header
        + "\n"
        + "\n".join(",".join(map(repr, row)) for row in np.column_stack(columns).tolist())
    ).encode()


def expected(roll, pitch, yaw, yaw_rate):
    """gyr, acc, mag in forward-right-down, from the directions the body axes point to."""
    axes = directions(roll, pitch, yaw)
    vectors = np.array([0, 0, yaw_rate]), np.array([0, 0, -G]), FIELD
    return [np.array([vector @ axis for axis in axes]) for vector in vectors]


def said(recording, words):
    """Is there a note with these English words?"""
    assert all(set(note) == {"en", "id"} and note["en"] and note["id"] for note in recording.notes)
    return any(words in note["en"] for note in recording.notes)


def refused(files, *words, **options):
    with pytest.raises(InputError) as error:
        read_recording(files, **options)
    for word in words:
        assert word in error.value.en, error.value.en
    assert (
        error.value.id
        and error.value.id != error.value.en
        and "\n" not in error.value.en + error.value.id
    )
    return error.value


TILTED = {"roll": np.radians(20), "pitch": np.radians(30), "yaw0": 0.5, "yaw_rate": 0.4}


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
    parts, t = phyphox(TILTED, rates=(100, 100, 100)), times(100)
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
    turn = lambda xyz: np.column_stack([xyz[:, 1], xyz[:, 0], -xyz[:, 2]])
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
    assert said(
        read_recording({"own.csv": own()["own.csv"].replace(b"-9.8", b"9.8")}), "upside down"
    )


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


def own(rows=200, **changes):
    """A plain file at rest, with cells changed: {(row, column): text}."""
    t = times(50, rows / 50)[:rows]
    values = np.column_stack([t, np.zeros((rows, 3)), np.tile([0, 0, -G, 20, 0, 40], (rows, 1))])
    cells = [[repr(x) for x in row] for row in values.tolist()]
    for (row, column), text in changes.get("cells", {}).items():
        cells[row][column] = text
    header = changes.get("header", PLAIN.format(g="rad/s", a="m/s2"))
    return {"own.csv": (header + "\n" + "\n".join(map(",".join, cells)) + "\n").encode()}


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


# --- what is refused ----------------------------------------------------------------------------


def test_missing_sensors():
    for name, words in (
        ("Gyroscope.csv", "no gyroscope"),
        ("Accelerometer.csv", "no accelerometer"),
    ):
        files = phyphox(TILTED)
        del files[name]
        refused(files, words)


@pytest.mark.parametrize(
    "cell, words",
    [
        ("abc", "'abc' is not a number"),
        ("nan", "missing"),
        ("", "missing"),
        ("inf", "infinite"),
        ("1;5", "not a number"),
        ("1_000", "not a number"),
        ("٢", "not a number"),
    ],
)
def test_a_bad_cell_is_named_with_its_line(cell, words):
    refused(own(cells={(10, 2): cell}), "own.csv, line 12", words)


def test_a_bad_time():
    refused(own(cells={(10, 0): "0.1"}), "line 12", "does not increase")
    refused(own(cells={(10, 0): ""}), "line 12", "missing")


def test_a_row_with_too_few_cells():
    content = own()["own.csv"] + b"4.0,0,0\n"
    refused({"own.csv": content}, "line 202", "3 cells instead of 10")


@pytest.mark.parametrize(
    "header, words",
    [
        (PLAIN.format(g="rpm", a="m/s2"), "gx (rpm)"),
        (PLAIN.format(g="rad/s", a="mm/s2"), "ax (mm/s2)"),
        ("t (s),gx,gy,gz,ax (g),ay (g),az (g),mx,my,mz", "gx"),
        (PLAIN.format(g="rad/s", a="g").replace("(g)", ""), "ax"),
        (PLAIN.format(g="rad/s", a="m/s2").replace("t (s)", "t (h)"), "t (h)"),
    ],
)
def test_unknown_or_missing_units(header, words):
    refused(own(header=header), "own.csv", words, "rad/s, deg/s")


def test_units_that_cannot_be_right():
    refused(own(header=PLAIN.format(g="rad/s", a="g")), "9.8")  # 9.8 g
    refused(own(cells={(10, 1): "180"}), "line 12", "deg/s")  # 180 rad/s


def test_no_header_no_time_and_no_rows():
    rows = own()["own.csv"].split(b"\n", 1)
    refused({"own.csv": rows[1]}, "line 1", "names and units")
    refused({"own.csv": rows[0] + b"\n"}, "no row below")
    refused({"own.csv": b"\n".join(own()["own.csv"].splitlines()[:5])}, "only 4 measurements")
    refused({"own.csv": rows[0].replace(b"t (s)", b"no") + b"\n" + rows[1]}, "no column of time")


@pytest.mark.parametrize(
    "name, content", [("own.csv", b""), ("own.csv", b" \n \n"), ("own.csv", b"# only this\n")]
)
def test_empty_files(name, content):
    refused({name: content}, "own.csv", "empty")


def test_other_kinds_of_files(tmp_path):
    refused({"run.json": b"[]"}, "run.json", ".csv")
    refused({"run.csv": b"\x00\x01\x02"}, "run.csv", ".csv")
    refused({"run.xls": b"\xd0\xcf\x11\xe0"}, "run.xls", ".xlsx")
    refused({"run.zip": b"PK\x03\x04broken"}, "cannot be unpacked")
    refused({"run.zip": zipped({"picture.jpg": b"x"})}, "no table")
    refused({}, "no table")
    refused(tmp_path, "no table")
    refused(tmp_path / "nothing.csv", "no file")
    with open(tmp_path / "huge.csv", "wb") as file:
        file.truncate(2_000_000_000)
    refused(tmp_path, "2000 MB")  # before it is read


def test_two_recordings_at_once():
    files = phyphox(TILTED)
    refused(files | {"again/Gyroscope.csv": files["Gyroscope.csv"]}, "twice", "again")


def test_a_long_recording_is_read_and_a_huge_one_refused():
    rows = 300_000  # longer than a spreadsheet may be
    line = "{:.3f},0,0,0.01,0,0,-9.81\n"
    header = "t (s),gx (rad/s),gy (rad/s),gz (rad/s),ax (m/s2),ay (m/s2),az (m/s2)\n"
    content = (header + "".join(line.format(k / 1000) for k in range(rows))).encode()
    for long in (content, content.replace(b"\n", b",calm\n").replace(b"2),calm", b"2),remark")):
        recording = read_recording({"long.csv": long})
        assert len(recording.t) == rows and recording.rate == pytest.approx(1000)
    refused({"huge.csv": header.encode() + b"1\n" * 2_000_020}, "huge.csv", "2000000")
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.csv", bytes(410_000_000))
    refused({"bomb.zip": content.getvalue()}, "MB")


# --- rest ---------------------------------------------------------------------------------------


def still_then_moving(rest, rate=100.0, bias=0.05):
    rng = np.random.default_rng(1)
    t = times(rate, 8.0)
    moving = (t >= rest)[:, None]
    gyr = bias + 0.01 * rng.normal(size=(len(t), 3)) + moving * np.sin(6 * t)[:, None]
    acc = [0, 0, -G] + 0.05 * rng.normal(size=(len(t), 3)) + moving * 3 * np.cos(7 * t)[:, None]
    return Recording(t, gyr, acc, None, rate, [])


@pytest.mark.parametrize("rest", [1.0, 3.0, 5.5])
def test_the_length_of_the_rest(rest):
    assert rest - 0.26 < rest_seconds(still_then_moving(rest)) <= rest + 0.01


def test_no_rest_and_nothing_but_rest():
    assert rest_seconds(still_then_moving(0.0)) == 0
    assert rest_seconds(still_then_moving(100.0)) == pytest.approx(8.0, abs=0.26)
    assert said(read_recording(phyphox({})), "lies still for its first 4.00 s")
    assert said(read_recording(phyphox(TILTED)), "does not begin at rest")  # it turns at 0.4 rad/s


# --- the real recording -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def ximu():
    return read_ximu(XIMU)


def tilts(recording, rows, signs=(1, 1, 1)):
    """Degrees between "up" by the accelerometer (mean of each quarter second in rows) and by the
    device's angles."""
    up = recording.acc.reshape(-1, 64, 3)[rows].mean(axis=1) * signs
    roll, pitch, _ = recording.reference[32::64][rows].T
    device = np.column_stack([
        np.sin(pitch),
        -np.sin(roll) * np.cos(pitch),
        -np.cos(roll) * np.cos(pitch),
    ])
    return np.degrees(np.arccos((up * device).sum(axis=1) / np.linalg.norm(up, axis=1)))


def test_the_ximu_file_is_the_published_one(ximu):
    assert len(ximu.t) == 12_626 and ximu.rate == 256 and XIMU.stat().st_size < 1_200_000
    assert ximu.t[-1] == pytest.approx(49.3, abs=0.05)
    with gzip.open(XIMU, "rt") as file:
        rows = file.read().splitlines()
    assert (
        len(rows) == 12_627 and sum(row.endswith(",,,") for row in rows) == 6313
    )  # 6,313 with the device's angles
    # the first row as the device wrote it: deg/s, g, gauss, degrees; forward-left-up
    np.testing.assert_allclose(np.degrees(ximu.gyr[0]), [2.1875, 2, -10.125])
    np.testing.assert_allclose(ximu.acc[0] / G, [-0.009277344, -0.01171875, -1.050293])
    np.testing.assert_allclose(ximu.mag[0], [0.3051758, -0.01708984, 0.2055664])
    np.testing.assert_allclose(
        np.degrees(ximu.reference[0]), [-1.707944, -0.6089312, 150.0818], rtol=1e-6
    )


def test_the_ximu_tells_what_was_converted(ximu):
    assert said(ximu, "axes were converted") and said(ximu, "128 Hz")


def test_the_ximu_lies_still_first(ximu):
    rest = int(rest_seconds(ximu) * 256)
    assert rest >= 2 * 256
    f = ximu.acc[:rest].mean(axis=0)
    assert np.linalg.norm(f) == pytest.approx(G, rel=0.02) and f[2] < -9.5
    roll, pitch = np.degrees([np.arctan2(-f[1], -f[2]), np.arctan2(f[0], np.hypot(f[1], f[2]))])
    device = np.degrees(ximu.reference[:rest].mean(axis=0))
    assert abs(roll - device[0]) < 2 and abs(pitch - device[1]) < 2


def test_the_ximu_angles_are_those_of_gravity_in_every_quiet_quarter_second(ximu):
    """Also tilted by more than 60 degrees, where any other signs are off by more than 30."""
    whole = len(ximu.t) // 64 * 64
    cut = Recording(
        ximu.t[:whole], ximu.gyr[:whole], ximu.acc[:whole], None, 256, [], ximu.reference[:whole]
    )
    acc, gyr = cut.acc.reshape(-1, 64, 3), cut.gyr.reshape(-1, 64, 3)
    quiet = ((acc.std(axis=1) < 0.5) & (np.abs(gyr).max(axis=1) < 0.2)).all(axis=1)
    assert quiet.sum() >= 20 and np.degrees(np.abs(cut.reference[32::64][quiet, 1])).max() > 60
    rms = lambda x: np.sqrt(np.mean(x**2))
    assert rms(tilts(cut, quiet)) < 2.5
    for signs in (
        (1, -1, 1),
        (-1, 1, 1),
        (-1, -1, 1),
        (1, 1, -1),
        (1, -1, -1),
        (-1, 1, -1),
        (-1, -1, -1),
    ):
        assert rms(tilts(cut, quiet, signs)) > 30


def test_the_ximu_gyroscope_is_the_rate_of_the_devices_angles(ximu):
    roll, pitch, yaw = np.unwrap(ximu.reference[::2], axis=0).T
    roll_rate, pitch_rate, yaw_rate = (np.gradient(angle) * 128 for angle in (roll, pitch, yaw))
    rates = np.array([
        roll_rate - yaw_rate * np.sin(pitch),
        pitch_rate * np.cos(roll) + yaw_rate * np.cos(pitch) * np.sin(roll),
        -pitch_rate * np.sin(roll) + yaw_rate * np.cos(pitch) * np.cos(roll),
    ])
    fine = np.abs(pitch) < 1.2
    for k in range(3):
        slope = np.polyfit(rates[k][fine], ximu.gyr[::2][fine, k], 1)[0]
        assert (
            np.corrcoef(rates[k][fine], ximu.gyr[::2][fine, k])[0, 1] > 0.98 and 0.9 < slope < 1.1
        )


def test_the_ximu_reaches_the_limits_of_Euler_angles(ximu):
    assert (
        np.degrees(np.abs(ximu.reference[:, 1])).max() > 89
        and np.degrees(np.abs(ximu.reference[:, 0])).max() > 170
    )
