"""Recordings in each app's format, made from a motion whose numbers follow from geometry."""

import io
import zipfile

import numpy as np
import pytest

from kalman_lib.data import InputError, read_recording

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

    def along(vector):
        return np.column_stack([vector @ axis for axis in axes])

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


def phyphox(motion, language="en", rates=(100, 50, 20), starts=(0, 0, 0), style=None):
    """The files of a phyphox export, {name: bytes}."""
    time, *names = WORDS[language]
    files = {}
    for k, file in enumerate(("Gyroscope", "Accelerometer", "Magnetometer")):
        t, name = times(rates[k], start=starts[k]), names[k]
        files[f"{file}.csv"] = table(
            [time] + [name.format(axis) for axis in "xyz"],
            t,
            phone(t, **motion)[k],
            **(style or {}),
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


def own(rows=200, **changes):
    """A plain file at rest, with cells changed: {(row, column): text}."""
    t = times(50, rows / 50)[:rows]
    values = np.column_stack([t, np.zeros((rows, 3)), np.tile([0, 0, -G, 20, 0, 40], (rows, 1))])
    cells = [[repr(x) for x in row] for row in values.tolist()]
    for (row, column), text in changes.get("cells", {}).items():
        cells[row][column] = text
    header = changes.get("header", PLAIN.format(g="rad/s", a="m/s2"))
    return {"own.csv": (header + "\n" + "\n".join(map(",".join, cells)) + "\n").encode()}
