"""What book/build.py builds again when something has changed."""

import shutil
import sys

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_make"))
sys.path.insert(0, str(ROOT / "book"))
import assemble
import build
import changes
import chapters
import nbformat
from jupyter_cache import get_cache


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


def test_what_has_run_is_found_again(tmp_path, monkeypatch):
    """Otherwise every page would run it once more, and show what only a running kernel can."""
    path = tmp_path / "notebooks" / "01_toy.ipynb"
    path.parent.mkdir()
    words = {"book": {"caption": {"id": "Satu.", "en": "One."}}, "tags": ["toy"]}
    cell = nbformat.v4.new_code_cell("1", metadata=words)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    nbformat.write(nbformat.v4.new_notebook(cells=[cell], metadata=kernel), path)
    monkeypatch.setattr(chapters, "ROOT", tmp_path)
    monkeypatch.setattr(chapters, "CACHE", tmp_path / "cache")
    chapters.execute_notebooks()
    assert chapters.is_cached(path, get_cache(str(tmp_path / "cache")))


def test_pictures_that_no_page_shows_are_removed(tmp_path):
    (tmp_path / "_images").mkdir()
    for name in ("old.png", "new.png"):
        (tmp_path / "_images" / name).write_bytes(b"")
    (tmp_path / "page.html").write_text('<img src="_images/new.png">', encoding="utf-8")
    assemble.remove_old_pictures(tmp_path)
    assert [path.name for path in (tmp_path / "_images").iterdir()] == ["new.png"]
