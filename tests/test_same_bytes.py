"""The same source makes the same bytes: else every build is a new version for a reader's copy."""

import datetime
import io
import re
import sys
import zipfile

import pytest
import yaml
from conftest import ROOT
from openpyxl import load_workbook

sys.path.insert(0, str(ROOT / "book" / "_make"))

import assemble
from wheel import write_wheel

CONFIG = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
DAY = datetime.date.fromisoformat(CONFIG["sphinx"]["config"]["book_edition"]["date"])
LATER = datetime.datetime(2031, 5, 6, 7, 8, 9)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """What two builds leave, the second of them years later."""
    first, second = (tmp_path_factory.mktemp(name) for name in ("first", "second"))
    build(first)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("time.localtime", lambda seconds=None: LATER.timetuple())
        patch.setattr("openpyxl.writer.excel.datetime", Calendar)
        patch.setattr("openpyxl.packaging.core.datetime", Calendar)
        build(second)
    return first, second


class Calendar:
    """The module datetime for whoever asks it what time it is."""

    timezone = datetime.timezone

    class datetime(datetime.datetime):
        @classmethod
        def now(cls, tz=None):
            return LATER.replace(tzinfo=tz)


def build(folder):
    assemble.write_workbook(folder / "kalman.xlsx")
    assemble.write_zip("en", folder / "kalman-filter.zip", write_wheel(folder))


@pytest.mark.parametrize("name", ["kalman.xlsx", "kalman-filter.zip"])
def test_two_builds_leave_the_same_bytes(name, made):
    first, second = (folder / name for folder in made)
    assert first.read_bytes() == second.read_bytes()
    with zipfile.ZipFile(first) as archive:
        days = {entry.date_time for entry in archive.infolist()}
    assert days == {(DAY.year, DAY.month, DAY.day, 0, 0, 0)}


def test_the_workbook_says_the_day_of_the_edition_and_still_opens(made):
    content = (made[0] / "kalman.xlsx").read_bytes()
    book = load_workbook(io.BytesIO(content))
    assert book.sheetnames[:2] == ["Filter", "RTS"]
    assert book.properties.created.date() == book.properties.modified.date() == DAY


def test_the_workbook_is_otherwise_what_the_library_writes(made, tmp_path):
    from kalman_lib import data
    from kalman_lib.papers import smoother

    data.write_workbook(tmp_path / "plain.xlsx", smoother.MEASURED, Q=1e-5, R=1e-5, x0=0, P0=1)
    with (
        zipfile.ZipFile(tmp_path / "plain.xlsx") as plain,
        zipfile.ZipFile(made[0] / "kalman.xlsx") as dated,
    ):
        assert plain.namelist() == dated.namelist()
        for name in plain.namelist():
            texts = [archive.read(name) for archive in (plain, dated)]
            if name == "docProps/core.xml":
                texts = [re.sub(rb"\d{4}-\d\d-\d\dT[\d:]+Z", b"", text) for text in texts]
            assert texts[0] == texts[1], name
