"""What of a recording is refused, in a sentence that names the place."""

import io
import zipfile

import pytest
from recording_files import PLAIN, TILTED, own, phyphox, refused, zipped

from kalman_lib.data import read_recording

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
