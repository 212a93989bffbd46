"""JupyterLite, which `make lite` adds: what it takes along, what it says, and what it refers to.

What was built is looked at by lite_checks.py, which `make lite` runs."""

import importlib.metadata
import json
import sys
import tomllib

import pytest
from conftest import ROOT
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

sys.path.insert(0, str(ROOT / "book" / "_make"))

import launch
import lite

NAMES = sorted(path.stem for path in (ROOT / "notebooks").glob("*.ipynb"))
# What Pyodide brings (its pyodide-lock.json), and what its kernel has in the place of another one
BROUGHT = {"numpy", "scipy", "matplotlib", "ipython", "traitlets", "typing-extensions", "xlrd"}
BROUGHT |= {"widgetsnbextension"}
BROWSER = {"sys_platform": "emscripten", "platform_system": "Emscripten", "python_version": "3.14"}


@pytest.fixture
def source(tmp_path, monkeypatch):
    """What goes into a JupyterLite, without the wheels."""
    monkeypatch.setattr(lite, "SOURCE", tmp_path)
    lite.write_contents()
    lite.write_settings()
    return tmp_path


def needed(requirements):
    """The packages that a browser has to install, those that they need included."""
    found = set()
    for text in requirements:
        requirement = Requirement(text)
        name = canonicalize_name(requirement.name)
        wanted = requirement.marker is None or requirement.marker.evaluate({**BROWSER, "extra": ""})
        if wanted and name not in BROUGHT:
            found |= {name} | needed(importlib.metadata.requires(name) or [])
    return found


def test_it_takes_along_what_pyodide_does_not_bring():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    chapters = project["dependencies"] + project["optional-dependencies"]["chapters"]
    assert needed(chapters) == set(lite.WHEELS)


def test_its_wheels_are_locked_with_their_hashes():
    entries = lite.locked(lite.WHEELS).strip().split("\n")
    pins = [line for line in entries if "==" in line]
    assert [pin.partition("==")[0] for pin in pins] == list(lite.WHEELS)
    assert all("--hash=sha256:" in line for line in entries if line not in pins)


def test_the_notebooks_lie_there_in_both_languages_with_their_data(source):
    for language in ("id", "en"):
        folder = source / "files" / language
        assert sorted(path.stem for path in folder.glob("*.ipynb")) == NAMES
        assert (folder / "data" / "nile.csv").exists()


def test_the_browser_asks_no_package_index(source):
    settings = json.loads((source / "jupyter-lite.json").read_text())
    plugins = settings["jupyter-config-data"]["litePluginSettings"]
    assert plugins[lite.KERNEL] == {"disablePyPIFallback": True}


@pytest.mark.parametrize("pyodide", [None, "a folder"])
def test_before_it_starts_it_says_what_is_downloaded_and_from_where(source, pyodide):
    page = lite.start_page(pyodide)
    assert page.count(f"{lite.SIZE} MB") == 2 and "{{" not in page
    assert (lite.CDN in page) == (pyodide is None)
    for language in ("id", "en"):
        assert (lite.HERE[language] in page) == (pyodide is not None)


def test_a_chapter_leads_to_its_line_on_that_page(source, monkeypatch, tmp_path):
    monkeypatch.setattr(launch, "LITE", tmp_path)
    page = lite.start_page(None)
    for language in ("id", "en"):
        for name in NAMES:
            address = launch.addresses(language, name, "../")["JupyterLite"]
            place, _, line = address.partition("#")
            assert place == f"../../lite/{lite.START}"
            link = f'<li id="{line}"><a href="lab/index.html?path={language}/{name}.ipynb">'
            assert page.count(link) == 1


def test_whoever_comes_from_a_chapter_sees_first_what_it_downloads(source, chromium, tmp_path):
    """On a phone: the paragraph of the language, and this chapter alone."""
    path = tmp_path / lite.START
    path.write_text(lite.start_page(None), encoding="utf-8")
    page = chromium.new_page(viewport={"width": 390, "height": 844})
    for language, word in (("id", "mengunduh"), ("en", "downloads")):
        page.goto("about:blank")
        page.goto(f"{path.as_uri()}#{language}-{NAMES[-1]}")
        assert page.locator("li:visible").count() == 1
        (paragraph,) = page.locator("p:visible").all()
        assert word in paragraph.inner_text()
        assert paragraph.bounding_box()["y"] >= 0 == page.evaluate("scrollY")
    page.goto(path.as_uri())
    assert page.locator("li:visible").count() == 2 * len(NAMES)
    page.close()
