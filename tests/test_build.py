"""What book/build.py builds again when something has changed."""

import shutil
import sys

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book"))
import build
import changes


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A copy of what the build reads."""
    for folder in ("book", "kalman_lib", "notebooks"):
        shutil.copytree(
            ROOT / folder,
            tmp_path / folder,
            ignore=shutil.ignore_patterns("node_modules", "vendor", "__pycache__"),
        )
    for name in ("_config.yml", "_toc.yml", "requirements.lock"):
        shutil.copyfile(ROOT / name, tmp_path / name)
    monkeypatch.setattr(changes, "ROOT", tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    "name, old, new, own_page_only",
    [
        ("book/intro.md", ".\n", "!\n", True),
        (
            "notebooks/03_gyro.ipynb",
            "Giroskop di dalamnya",
            "Giroskop itu",
            True,
        ),
        ("notebooks/03_gyro.ipynb", "# The gyroscope", "# A gyroscope", False),
        ("notebooks/03_gyro.ipynb", "{cite}`woodman2007`", "{cite}`kalman1960`", False),
        ("book/intro.md", "](", "](../", False),
        ("book/_static/book.css", "body {", "body  {", False),
        ("book/explorers/drawing/plot.js", "const", "const ", False),
        ("kalman_lib/filters.py", '"""', '"""A', False),
        ("_toc.yml", "book/cluster", "book/clusters", False),
    ],
)
def test_a_changed_text_changes_its_own_page_only(name, old, new, own_page_only, tree):
    before, path = build.frame(), tree / name
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert (build.frame() == before) == own_page_only


def test_pictures_that_no_page_shows_are_removed(tmp_path):
    (tmp_path / "_images").mkdir()
    for name in ("old.png", "new.png"):
        (tmp_path / "_images" / name).write_bytes(b"")
    (tmp_path / "page.html").write_text('<img src="_images/new.png">', encoding="utf-8")
    build.remove_old_pictures(tmp_path)
    assert [path.name for path in (tmp_path / "_images").iterdir()] == ["new.png"]
