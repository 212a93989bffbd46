"""A notebook that a reader takes home: its first cell runs anywhere, and it stands on its own."""

import functools
import http.server
import json
import re
import shlex
import sys
import threading

import pytest
from conftest import ROOT
from downloads_helpers import foreign_python, run_cells

sys.path.insert(0, str(ROOT / "book" / "_make"))

import wheel as wheels
from downloads import download_notebook
from first_cell import (
    MISSING,
    in_archive,
    in_branch,
    in_lite,
    needed_files,
    on_site,
    wheel_name,
)

from kalman_lib.live.notebook import language_of_notebook

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
LANGUAGES = ("id", "en")
SITE = "https://example.org/buku/"
REPOSITORY = "https://github.com/somebody/kalman"
RAW = "https://raw.githubusercontent.com/somebody/kalman/notebooks/"
PLACES = {"known": SITE, "unknown": ""}
each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
each_language = pytest.mark.parametrize("language", LANGUAGES)
IS_THERE = "from importlib.util import find_spec\nprint(find_spec('kalman_lib') is not None)"
KNOWS = """
from kalman_lib.live.made import made
from kalman_lib.live.notebook import language_of_notebook
print(len(made("starts.json")) > 100, language_of_notebook())
"""


def edition(address):
    return {"address": address, "repository": REPOSITORY, "version": "0.9", "date": "2026-11-28"}


@functools.cache
def source(path):
    return json.loads(path.read_text(encoding="utf-8"))


def taken(path, language, address="", place=on_site):
    """The cells of a notebook as it is taken home."""
    where = place(edition(address), language)
    return download_notebook(source(path), language, path.name, "0.9", where)["cells"]


def first_cell(cells):
    return next(cell for cell in cells if cell["cell_type"] == "code")["source"]


@each_language
@each_notebook
@pytest.mark.parametrize("address", PLACES.values(), ids=PLACES)
def test_below_the_title_a_short_cell_installs_what_is_missing(path, language, address):
    cells = taken(path, language, address)
    title, hint, first = cells[:3]
    assert title["source"].startswith("# ") and "kalman_lib" in hint["source"]
    assert first["cell_type"] == "code" and len(first["source"].splitlines()) <= 12
    names = [cell["id"] for cell in cells]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    "place, folder", [(on_site, f"{SITE}en/"), (in_branch, f"{RAW}en/"), (in_lite, "")]
)
def test_in_a_browser_the_line_with_pip_is_read_as_it_stands(place, folder):
    """There, a line that begins with %pip is taken apart before Python sees it."""
    code = first_cell(taken(NOTEBOOKS[0], "en", SITE, place))
    (line,) = re.findall(r"^\s*%pip\b(.*)$", code, re.MULTILINE)
    wheel = f" @ {folder}{wheel_name('0.9')}" if folder else ""
    assert shlex.split(line) == ["install", "-q", f"kalman_lib[chapters]{wheel}"]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    return wheels.write_wheel(tmp_path_factory.mktemp("wheel"))


@pytest.fixture
def python(tmp_path):
    return foreign_python(tmp_path / "other")


@pytest.fixture
def desk(tmp_path):
    """The folder in which the notebook lies."""
    folder = tmp_path / "desk"
    folder.mkdir()
    return folder


@pytest.fixture
def host(tmp_path):
    """A web server with the downloads of a site -> (its address, the folder, what was asked)."""
    asked = []

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *arguments):
            asked.append(self.path)

    folder = tmp_path / "site"
    serve = functools.partial(Quiet, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), serve) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}", folder, asked
        server.shutdown()


def test_it_installs_the_wheel_of_the_site_and_fetches_its_data(wheel, python, desk, host):
    address, folder, asked = host
    there = folder / "en" / "_sources" / "notebooks" / "data"
    there.mkdir(parents=True)
    (folder / "en" / wheel.name).write_bytes(wheel.read_bytes())
    nile = (ROOT / "notebooks" / "data" / "nile.csv").read_bytes()
    (there / "nile.csv").write_bytes(nile)
    (path,) = (path for path in NOTEBOOKS if path.stem == "02_smoother")
    code = first_cell(taken(path, "en", address))
    assert run_cells(python, desk, code, KNOWS).splitlines()[-1] == "True en"
    assert (desk / "data" / "nile.csv").read_bytes() == nile
    before = len(asked)
    assert run_cells(python, desk, code, KNOWS).splitlines() == ["True en"]  # all is there
    assert before > 0 and len(asked) == before


@each_language
def test_without_an_address_it_takes_the_wheel_beside_it_or_says_what_to_do(
    language, wheel, python, desk
):
    code = first_cell(taken(NOTEBOOKS[0], language))
    said = run_cells(python, desk, code, IS_THERE).splitlines()
    assert said == [MISSING[language].format(wheel=wheel.name), "False"]
    (desk / wheel.name).write_bytes(wheel.read_bytes())
    assert run_cells(python, desk, code, KNOWS).splitlines()[-1] == f"True {language}"


@each_notebook
def test_what_its_cells_open_lies_beside_it(path):
    needed = needed_files(source(path))
    assert all((path.parent / name).is_file() for name in needed)
    opened = {"02_smoother": ["data/nile.csv"], "07_workshop_deeper": ["07_workshop.ipynb"]}
    assert needed == opened.get(path.stem, needed)


# --- its language ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "tags, chosen, language",
    [
        (["lang-en"], "id", "en"),  # what the notebook itself says, as far as it is known
        (["lang-id", "lang-en"], "id", ""),
        (None, "id", "id"),  # Colab, Kaggle, a browser: only the first cell says it
        (None, "fr", ""),
        (None, None, ""),
    ],
)
def test_explorers_and_exercises_speak_its_language(tags, chosen, language, tmp_path, monkeypatch):
    path = tmp_path / "notebook.ipynb"
    if tags is not None:
        cells = [{"metadata": {"tags": [tag]}} for tag in tags]
        path.write_text(json.dumps({"cells": cells}))
    monkeypatch.setenv("JPY_SESSION_NAME", str(path))
    monkeypatch.delenv("KALMAN_LANGUAGE", raising=False)
    if chosen:
        monkeypatch.setenv("KALMAN_LANGUAGE", chosen)
    assert language_of_notebook() == language


# --- what it keeps --------------------------------------------------------------------------------


@each_language
@each_notebook
def test_every_figure_keeps_its_caption_and_its_number(path, language, site):
    """The numbers are those of the page."""
    page = (site / language / "notebooks" / f"{path.stem}.html").read_text(encoding="utf-8")
    numbers = re.findall(r'class="caption-number">([^<]*?) ?</span>', page)
    cells = taken(path, language)
    captions = [cell["source"] for cell in cells if cell["id"].startswith("caption-")]
    wanted = [
        cell["metadata"]["book"]["caption"][language]
        for cell in source(path)["cells"]
        if "caption" in cell["metadata"].get("book", {})
    ]
    assert len(wanted) >= 1 and len(numbers) == len(wanted)
    assert captions == [f"**{number}.** {text}" for number, text in zip(numbers, wanted)]


@each_language
@each_notebook
def test_who_is_cited_stands_in_the_list_at_the_end(path, language):
    cells = taken(path, language)
    texts = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
    assert "{cite" not in texts
    keys = set(re.findall(r"\{cite\}`(\w+)`", json.dumps(source(path))))
    last = cells[-1]["source"]
    assert last.startswith({"id": "## Daftar pustaka", "en": "## References"}[language])
    assert last.count("\n- ") == len(keys) > 0
    authors = [entry.partition("\n")[0] for entry in last.split("\n- ")[1:]]
    foreign = {"id": " and ", "en": " dan "}[language]
    assert not any(foreign in line for line in authors)


def test_a_source_is_told_as_on_the_page_of_references():
    (path,) = (path for path in NOTEBOOKS if path.stem == "01_theory")
    last = taken(path, "en")[-1]["source"].replace("\\", "")
    assert "A new approach to linear filtering and prediction problems" in last
    assert "https://doi.org/10.1115/1.3662552" in last


@each_language
@each_notebook
def test_no_link_leads_to_what_is_not_there(path, language):
    """With an address to the site, without one nowhere; other notebooks stay in the archive."""
    link = re.compile(r"\]\((?!https?:|#|mailto:|attachment:)([^)\s]+)")
    for address, place, allowed in (
        (SITE, on_site, "$^"),
        ("", in_archive, r"[\w-]+\.ipynb|data/"),
    ):
        texts = [c["source"] for c in taken(path, language, address, place) if "source" in c]
        for target in link.findall("\n".join("".join(text) for text in texts)):
            assert re.match(allowed, target), (target, place)


def test_pictures_of_explorers_keep_their_words():
    (path,) = (path for path in NOTEBOOKS if path.stem == "03_gyro")
    for language in LANGUAGES:
        (cell,) = (cell for cell in taken(path, language) if cell["id"] == "drift")
        (original,) = (cell for cell in source(path)["cells"] if cell["id"] == "drift")
        words = original["metadata"]["book"]["alt"][language]
        assert f'alt="{words}"' in "".join(cell["outputs"][0]["data"]["text/html"])
