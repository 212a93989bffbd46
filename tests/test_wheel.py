"""The wheel of kalman_lib: complete, always the same bytes, and where readers find it."""

import hashlib
import os
import re
import sys
import time
import zipfile

import explorers
import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_make"))

import wheel as wheels
from edition import edition
from first_cell import wheel_name

LIBRARY = ROOT / "kalman_lib"
ARCHIVES = {"id": "filter-kalman", "en": "kalman-filter"}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    explorers.for_notebooks()
    folder = tmp_path_factory.mktemp("wheel")
    (folder / "kalman_lib-0.1-py3-none-any.whl").write_bytes(b"of an older version")
    return wheels.write_wheel(folder)


def test_it_holds_every_module_the_explorers_and_the_exercises(made):
    names = ("widget.js", "widget.css", "starts.json", "exercises.json")
    needed = [*LIBRARY.rglob("*.py"), *(explorers.FOR_NOTEBOOKS / name for name in names)]
    held = set(zipfile.ZipFile(made).namelist())
    assert {path.relative_to(ROOT).as_posix() for path in needed} <= held
    assert not [name for name in held if "__pycache__" in name or name.startswith("build/")]


def test_it_is_named_after_the_edition_and_no_older_one_stays(made):
    assert made.name == wheel_name(edition()["version"])
    assert list(made.parent.glob("*.whl")) == [made]


def test_its_bytes_depend_on_its_sources_alone(made, tmp_path):
    """Not on the day, on the order of a folder or on who makes it."""
    before = os.umask(0o077)
    try:
        os.environ["TZ"] = "Asia/Jakarta"
        time.tzset()
        again = wheels.write_wheel(tmp_path)
    finally:
        os.umask(before)
        del os.environ["TZ"]
        time.tzset()
    assert again.read_bytes() == made.read_bytes()
    with zipfile.ZipFile(made) as archive:
        assert {entry.date_time for entry in archive.infolist()} == {wheels.DATE}


def test_making_it_leaves_nothing_in_the_sources(made):
    assert not (ROOT / "build").exists()


def test_its_record_fits_its_files(made):
    """pip checks it: every file with its hash, once."""
    import base64

    with zipfile.ZipFile(made) as archive:
        (record,) = (name for name in archive.namelist() if name.endswith("/RECORD"))
        lines = [line.split(",") for line in archive.read(record).decode().split()]
        assert sorted(name for name, _, _ in lines) == sorted(archive.namelist())
        for name, told, size in lines:
            content = archive.read(name)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode()
            assert name == record or told == f"sha256={digest.rstrip('=')}"
            assert name == record or int(size) == len(content)


@pytest.mark.parametrize("language", ARCHIVES)
def test_readers_find_it_on_the_site_and_in_the_archive(language, site, made):
    name = wheel_name(edition()["version"])
    folder = site / language
    content = made.read_bytes()
    assert [path.name for path in folder.glob("*.whl")] == [name]
    assert (folder / name).read_bytes() == content
    with zipfile.ZipFile(folder / f"{ARCHIVES[language]}.zip") as archive:
        inside = [entry for entry in archive.namelist() if entry.endswith(".whl")]
        assert inside == [f"{ARCHIVES[language]}/notebooks/{name}"]  # beside the notebooks
        assert archive.read(inside[0]) == content
    use = (folder / "book" / "use.html").read_text(encoding="utf-8")
    assert re.findall(r'href="\.\./([^"]*\.whl)"', use) == [name]
    assert f'"{name}"' in (folder / "offline-worker.js").read_text()  # kept with the language
