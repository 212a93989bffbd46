"""Lists that name every chapter or every paper are complete: nothing goes stale in silence."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "book" / "_make"), str(ROOT / "book" / "_ext")]
import lists  # noqa: E402
from texts import filter_markdown  # noqa: E402

CHAPTERS = lists.chapters()
LANGUAGES = ("id", "en")


def page_in(name, language):
    return filter_markdown((ROOT / "book" / name).read_text(encoding="utf-8"), language)


def paper_of(chapter):
    """notebooks/03_gyro -> gyro."""
    return re.fullmatch(r"notebooks/\d\d_(\w+)", chapter)[1]


def test_every_page_is_in_the_contents_and_the_other_way_round():
    root, parts = lists.contents()
    listed = {root, *(page for _, pages in parts for page in pages)}
    there = {path.relative_to(ROOT).with_suffix("") for path in (ROOT / "book").glob("*.md")}
    there |= {path.relative_to(ROOT).with_suffix("") for path in ROOT.glob("notebooks/*.ipynb")}
    names = {path.as_posix() for path in there}
    assert names - listed == set(), "not in _toc.yml"
    assert listed - names == set(), "in _toc.yml, but there is no such page"


def test_the_readme_lists_the_chapters():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert lists.README_LIST.search(readme), "README.md has lost the marks of its list"
    assert lists.with_list(readme) == readme, "README.md is stale: make lists"


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_page_lists_the_chapters_under_their_titles(language):
    entry = r"^\d+\. \[\*\*(.+?)\*\*\]\(\.\./(notebooks/\w+)\.ipynb\)"
    found = re.findall(entry, page_in("intro.md", language), flags=re.MULTILINE)
    wanted = [(lists.title(chapter, language), chapter) for chapter in CHAPTERS]
    assert [item for item in wanted if item not in found] == [], "missing in book/intro.md"
    assert found == wanted, "another order, or a chapter that does not exist"


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_errata_name_every_chapter_with_a_critical_note(language):
    linked = set(re.findall(r"\(\.\./(notebooks/\w+)\.ipynb", page_in("errata.md", language)))
    assert set(lists.critical_notes()) - linked == set(), "missing in book/errata.md"


def test_every_chapter_has_its_paper_its_explorer_and_its_tests():
    papers = ROOT / "kalman_lib" / "papers"
    modules = {path.stem for path in papers.iterdir() if path.stem[0] not in "_."}
    explorers = {path.parent.name for path in ROOT.glob("book/explorers/papers/*/index.js")}
    tests = {path.stem.removeprefix("test_") for path in (ROOT / "tests").glob("test_*.py")}
    for chapter in CHAPTERS:
        paper = paper_of(chapter)
        assert paper in modules, f"{chapter}: kalman_lib/papers/{paper} is missing"
        assert paper in explorers, f"{chapter}: book/explorers/papers/{paper} is missing"
        assert paper in tests, f"{chapter}: tests/test_{paper}.py is missing"
    assert modules == explorers == {paper_of(chapter) for chapter in CHAPTERS}


def test_the_readme_says_how_many_chapters_there_are():
    numbers = {
        5: ("Lima", "Five"),
        6: ("Enam", "Six"),
        7: ("Tujuh", "Seven"),
        8: ("Delapan", "Eight"),
    }
    indonesian, english = numbers[len(CHAPTERS)]
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"{indonesian} bab" in readme and f"{english} chapters" in readme
