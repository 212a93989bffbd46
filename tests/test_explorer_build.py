"""How the live explorers are made and loaded: who may import whom, what a page loads, what stops
the build."""

import gzip
import importlib
import json
import re
import shutil
import subprocess
from types import SimpleNamespace

import explorers as explorers_to_bundle
import offline
import pytest
from conftest import ROOT
from explorer_helpers import PAPERS, SOURCES, pages_with_explorers

from kalman_lib.live.pictures import PICTURES
from kalman_lib.papers import describe

# --- who may import whom ------------------------------------------------------------------------

ALLOWED = {
    "numerics": {"numerics"},
    "language": {"language"},
    "files": {"files", "files/recording", "language"},
    "drawing": {"drawing"},
    "element": {"element", "drawing", "language", "numerics"},
    "sensors": {"sensors", "language", "numerics"},
    "own": {"own", "language", "files", "sensors"},
    "papers": {"numerics", "language", "own", "files", "sensors"},  # and each its own folder
    "grading": {"grading", "language"},
    "exercise": {"exercise", "grading", "drawing", "language"},
    "jupyter": {"jupyter", "element", "drawing", "language"},
    "": {"numerics", "language", "element"},  # core.js
}
TOUCH_THE_DOCUMENT = {"element", "drawing", "jupyter", "exercise", "sensors", "own"}
FILES = sorted(SOURCES.rglob("*.js"))


def room_of(path):
    """ "numerics", ..., "papers/gyro"; "" for core.js."""
    parts = path.relative_to(SOURCES).parent.parts
    return "/".join(parts)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(SOURCES).as_posix())
def test_import_rules(path):
    text = path.read_text(encoding="utf-8")
    room = room_of(path)
    names = re.findall(r'^(?:import|export)[^;]*? from "([^"]+)"', text, re.MULTILINE)
    imported = {
        room_of((path.parent / name).resolve()) for name in names if not name.startswith("data/")
    }
    kind, paper, *_ = [*room.split("/"), ""]
    own = {f"papers/{paper}", f"papers/{paper}/later"} if kind == "papers" else set()
    allowed = ALLOWED[kind] | own
    assert imported <= allowed, f"{path.name} may not import from {imported - allowed}"
    code = "\n".join(
        line for line in text.splitlines() if not line.lstrip().startswith(("//", "*", "/*"))
    )
    if room not in TOUCH_THE_DOCUMENT:
        found = re.search(r"\b(document|innerHTML|localStorage)\b|(?<!\.)\bwindow[.\[]", code)
        assert not found, f"{path.name} must not touch the document"
    assert "innerHTML" not in code and "insertAdjacentHTML" not in code and "eval(" not in code


@pytest.mark.parametrize("paper", PAPERS)
def test_a_paper_has_its_four_rooms(paper):
    found = {path.name for path in (SOURCES / "papers" / paper).glob("*.js")}
    assert {"index.js", "model.js", "view.js", "words.js", "questions.js"} <= found


def test_the_files_are_formatted_and_linted():
    """Lines, functions and files are short, one statement a line: what eslint.config.mjs and
    Prettier ask."""
    everything = "**/*.{js,mjs,css}"
    for program, *arguments in (
        ("eslint/bin/eslint.js", "."),
        ("prettier/bin/prettier.cjs", "--check", everything),
    ):
        made = subprocess.run(
            [str(offline.node_binary()), f"node_modules/{program}", *arguments],
            cwd=offline.BOOK,
            capture_output=True,
            encoding="utf-8",
        )
        assert made.returncode == 0, made.stdout + made.stderr


def test_every_view_starts_somewhere_and_has_a_still_picture(tmp_path):
    views = explorers_to_bundle.for_notebooks(tmp_path)
    starts = json.loads((tmp_path / "starts.json").read_text())
    assert {paper: list(found) for paper, found in starts.items()} == views
    assert set(PICTURES) <= {(paper, view) for paper, found in views.items() for view in found}
    for paper, found in starts.items():
        fields = set(describe(importlib.import_module(f"kalman_lib.papers.{paper}").Params))
        assert all(fields <= set(start) for start in found.values())


# --- what a page loads --------------------------------------------------------------------------


def shown_in(path):
    return dict.fromkeys(
        re.findall(r'<kalman-explorer paper="(\w+)"', path.read_text(encoding="utf-8"))
    )


def test_scripts_only_where_they_are_needed(site):
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        scripts = re.findall(r"<script[^>]*vendor/explorers/[^>]*>", text)
        papers = shown_in(path)
        loaded = [re.search(r"vendor/explorers/(\w+)\.js", tag)[1] for tag in scripts]
        assert loaded == (explorers_to_bundle.scripts(papers) if papers else []) and all(
            " defer" in tag for tag in scripts
        ), path


@pytest.mark.parametrize("language", ["id", "en"])
def test_the_core_and_one_paper_are_small(language, site):
    made = site.parent / "work" / language / "_build" / "html"  # the site has one sheet for all
    folder = made / "_static" / "vendor" / "explorers"
    sizes = {file.name: len(gzip.compress(file.read_bytes(), 9)) for file in folder.iterdir()}
    core = sizes.pop("core.js") + sizes.pop("core.css")
    rooms = {room: sizes.pop(f"{room}.js") for room in explorers_to_bundle.rooms()}
    assert set(sizes) == {f"{paper}.js" for paper in PAPERS}
    assert core + max(sizes.values()) <= 45_000, (core, sizes)
    assert max(rooms.values()) <= 32_000, rooms  # fetched when a reader needs them


@pytest.mark.parametrize("language, other", [("id", "en"), ("en", "id")])
def test_ranges_and_words_come_from_python(language, other, site, opened):
    tables = {}
    for path in pages_with_explorers(site, language):
        tables |= opened(path)[0].evaluate("KalmanExplorers.tables")
    for name in PAPERS:
        expected = describe(importlib.import_module(f"kalman_lib.papers.{name}").Params)
        assert tables[name] == {
            field: {key: value for key, value in meta.items() if key != other}
            for field, meta in expected.items()
        }


def test_a_page_loads_the_words_of_its_language(site):
    """The words of the other one are left out: those of every view's name, for one, and every
    other pair."""
    pair = re.compile(r'id: "([^"\\]+)",\s+en: "([^"\\]+)"')
    for language in ("id", "en"):
        for paper in PAPERS:
            script = (
                site / language / "_static" / "vendor" / "explorers" / f"{paper}.js"
            ).read_text(encoding="utf-8")
            words = pair.findall(
                (SOURCES / "papers" / paper / "words.js").read_text(encoding="utf-8")
            )
            assert len(words) > 5
            for texts in words:
                if (
                    min(map(len, texts)) > 20
                    and texts[0] not in texts[1]
                    and texts[1] not in texts[0]
                ):
                    assert [text in script for text in texts] == [
                        language == "id",
                        language == "en",
                    ], texts


# --- what stops the build -----------------------------------------------------------------------


@pytest.fixture
def sources(tmp_path):
    """A copy of the explorers that a test may spoil."""
    shutil.copytree(SOURCES, tmp_path / "explorers")
    return tmp_path / "explorers"


def sentence(tmp_path, sources):
    """What the bundler refuses, in one sentence."""
    with pytest.raises(explorers_to_bundle.Mistake) as refused:
        explorers_to_bundle.bundle(tmp_path / "made", "id", sources)
    text = str(refused.value)
    assert text.endswith(".") and "\n" not in text and str(tmp_path) not in text
    return text


@pytest.mark.parametrize("missing", ["id", "en"])
@pytest.mark.parametrize("way", ["left out", "empty"])
def test_words_in_one_language_only_stop_the_build(way, missing, tmp_path, sources):
    file = sources / "papers" / "ship" / "words.js"
    text = file.read_text(encoding="utf-8")
    instead = r"\1" if way == "left out" else rf'\1{missing}: "",'
    changed = re.sub(
        rf'(FACTS = {{\s+fit: {{ (?:id: "[^"]*", )?){missing}: "[^"]+",?', instead, text
    )
    assert changed != text
    file.write_text(changed, encoding="utf-8")
    line = text[: text.index("fit: {", text.index("FACTS"))].count("\n") + 1
    assert (
        sentence(tmp_path, sources)
        == f'papers/ship/words.js, line {line}: words are missing in "{missing}".'
    )


def test_a_paper_without_an_index_stops_the_build(tmp_path, sources):
    (sources / "papers" / "ship" / "index.js").unlink()
    assert sentence(tmp_path, sources) == "book/explorers/papers/ship/index.js is missing."


def test_a_paper_without_views_stops_the_build(tmp_path, sources):
    file = sources / "papers" / "ship" / "index.js"
    file.write_text('export * from "./model.js";\n', encoding="utf-8")
    assert sentence(tmp_path, sources) == "book/explorers/papers/ship/index.js exports no views."


def test_an_explorer_without_a_paper_stops_the_build(tmp_path, sources):
    shutil.copytree(sources / "papers" / "ship", sources / "papers" / "boat")
    assert (
        sentence(tmp_path, sources)
        == "book/explorers/papers/boat has no paper: kalman_lib/papers/boat.py is missing."
    )


def test_a_mistake_in_the_code_stops_the_build(tmp_path, sources):
    file = sources / "papers" / "ship" / "view.js"
    file.write_text(file.read_text(encoding="utf-8") + "const = 1;\n", encoding="utf-8")
    assert "view.js" in sentence(tmp_path, sources)


@pytest.mark.parametrize(
    "element, problem",
    [
        (
            '<kalman-explorer paper="boat">',
            'the explorer "boat" does not exist: book/explorers/papers/boat/index.js is missing',
        ),
        (
            '<kalman-explorer paper="gyro" view="storm">',
            'the explorer "gyro" has no view "storm"; it has flight, mismatch',
        ),
    ],
)
def test_a_page_with_an_explorer_that_does_not_exist_stops_the_build(
    element, problem, caplog, monkeypatch
):
    """A warning with its page; book/build.py takes warnings for errors (-W)."""
    app = SimpleNamespace(
        explorer_views={"gyro": ["flight", "mismatch"]},
        add_js_file=lambda *_, **__: None,
        add_css_file=lambda *_: None,
    )
    explorers_to_bundle.load(
        app,
        "notebooks/03_gyro",
        "page.html",
        {"body": f"<p>{element}<img></kalman-explorer></p>"},
        None,
    )
    assert [record.getMessage() for record in caplog.records] == [problem]
    assert caplog.records[0].location == "notebooks/03_gyro"
    assert '"-W"' in (ROOT / "book" / "build.py").read_text(encoding="utf-8")
