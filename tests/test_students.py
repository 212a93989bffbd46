"""The edition for students: `solutions: false` in _config.yml, and no solution is handed out."""

import json
import shutil

import pytest
from conftest import ROOT, listen
from exercise_cells import in_notebook, is_exercise
from test_recipe import run, sources

PAGE = "notebooks/02_smoother"
OVERVIEW = "book/exercises"
FOUND = in_notebook(ROOT / f"{PAGE}.ipynb")


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the book, with this one line changed, and two of its pages."""
    folder = tmp_path_factory.mktemp("students") / "book"
    for name in sources():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)
    (folder / "book" / "node_modules").symlink_to(ROOT / "book" / "node_modules")
    config = folder / "_config.yml"
    text = config.read_text(encoding="utf-8")
    assert text.count("solutions: true") == 1
    config.write_text(text.replace("solutions: true", "solutions: false"), encoding="utf-8")
    run(folder, "book/_ext/explorers.py")
    for page in (PAGE, OVERVIEW):
        run(folder, "book/build.py", "--only", page, "--language", "en")
    return folder


def built(copy, page):
    return copy / "_build" / "page" / "en" / "_build" / "html" / f"{page}.html"


def plain(text):
    """The longest piece of prose, by which a page would give a solution away."""
    return max(text.replace("\n", " ").split("$")[::2], key=len).strip()


def test_neither_page_nor_notebook_nor_bundle_holds_a_solution(copy):
    page = built(copy, PAGE)
    html = page.read_text(encoding="utf-8")
    bundle = json.loads((copy / "kalman_lib/live/bundle/exercises.json").read_text("utf-8"))
    download = next(page.parent.parent.rglob("_sources/**/02_smoother.ipynb"))
    notebook = download.read_text(encoding="utf-8")
    assert html.count('data-exercise="') == len(FOUND) and "exercise-solution" not in html
    assert len(bundle) >= 40 and not any("solution" in about for about in bundle.values())
    assert "proof" not in {
        tag for cell in json.loads(notebook)["cells"] for tag in cell["metadata"].get("tags", [])
    }
    assert sum(is_exercise(cell) for cell in json.loads(notebook)["cells"]) == len(FOUND)
    for found in FOUND:
        piece = plain(found.about["solution"]["en"])
        assert len(piece) > 15
        assert piece not in html and piece not in notebook, found.number


def test_the_overview_holds_no_answer(copy):
    html = built(copy, OVERVIEW).read_text(encoding="utf-8")
    assert "the lecturer has the answers" in html and "<table" not in html


def test_the_page_still_answers_and_promises_no_solution(copy, chromium):
    page = chromium.new_page()
    trouble = listen(page)
    page.goto(built(copy, PAGE).as_uri())
    for found in FOUND:
        if found.about["kind"] == "number":
            exercise = page.locator(f'.exercise[data-exercise="{found.number}"]')
            verdict = exercise.locator(".exercise-verdict")
            for answer in ("-98765", "-98766", found.about["answer"]):
                exercise.locator("input").fill(str(answer))
                exercise.locator("input").press("Enter")
                assert "can be opened" not in verdict.inner_text()
            assert verdict.inner_text().startswith("Right.")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.locator(".exercise-sheet").count() == 0
    assert trouble == []
    page.close()
