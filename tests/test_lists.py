"""Lists that name every chapter or every paper are complete: nothing goes stale in silence."""

import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "book" / "_make"), str(ROOT / "book" / "_ext")]
import edition  # noqa: E402
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


@pytest.mark.parametrize("path", lists.wanted(), ids=lambda path: path.name)
def test_what_make_lists_writes_is_up_to_date(path):
    text = path.read_text(encoding="utf-8")
    marked = {lists.README: 1, lists.INTRO: 2, lists.GLOSSARY: 2, lists.NOTATION: 4}
    assert len(lists.LIST.findall(text)) == marked.get(path, 0), "it has lost the marks of its list"
    assert lists.wanted()[path] == text, f"{path.name} is stale: make lists"


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_a_sentence_about_every_chapter_stands_in_its_notebook(chapter):
    indonesian, english = (lists.sentence(chapter, language) for language in LANGUAGES)
    assert indonesian != english and min(len(indonesian), len(english)) > 30


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


def test_who_adopts_the_book_changes_one_file(tmp_path):
    """Another title, author and address in _config.yml: after `make lists` no old one is left."""
    copy = tmp_path / "book"
    not_sources = ("_build", ".git", ".venv", "node_modules", "__pycache__", "bundle", "vendor")
    shutil.copytree(ROOT, copy, symlinks=True, ignore=shutil.ignore_patterns(*not_sources))
    config = copy / "_config.yml"
    text = config.read_text(encoding="utf-8")
    old = re.search(r'^title: "(.*) \| (.*)"$', text, re.MULTILINE)
    text = text.replace(old[0], "title: Judul Baru | A New Title")
    text = text.replace('author: ""', 'author: "Budi Santoso, Siti Aminah"')
    config.write_text(text.replace('address: ""', 'address: "https://example.org/kf"'), "utf-8")
    subprocess.run([sys.executable, "book/_make/lists.py"], cwd=copy, check=True)
    for path in copy.rglob("*"):
        if path.is_file() and path.suffix in (
            ".md",
            ".py",
            ".js",
            ".toml",
            ".cff",
            ".html",
            ".yml",
        ):
            assert not set(old.groups()) & set(re.findall("|".join(old.groups()), path.read_text()))
    cited = yaml.safe_load((copy / "CITATION.cff").read_text(encoding="utf-8"))
    assert cited["preferred-citation"]["title"] == "Judul Baru / A New Title"
    assert [author["name"] for author in cited["authors"]] == ["Budi Santoso", "Siti Aminah"]
    assert cited["url"] == "https://example.org/kf"
    licence = (copy / "LICENSE").read_text(encoding="utf-8").splitlines()
    assert licence[:3] == (ROOT / "LICENSE").read_text(encoding="utf-8").splitlines()[:3]
    assert licence[3] == f"Copyright (c) {cited['date-released'][:4]} Budi Santoso, Siti Aminah"
    about = (copy / "book" / "about.md").read_text(encoding="utf-8")
    assert about.count("author  = {Budi Santoso and Siti Aminah},") == 2


@pytest.mark.parametrize(
    "title, author, wanted",
    [
        ("Filter", "", (["Filter", "Filter"], [])),
        ("A | B", "Siti, Budi", (["A", "B"], ["Siti", "Budi"])),
        ("A: B | C: D", "Siti, M.T.; Budi", (["A: B", "C: D"], ["Siti, M.T.", "Budi"])),
        ('The "filter"', "", None),
        ("A\\B", "", None),
        ("A", "{Siti}", None),
        ("A | B | C", "", None),
    ],
)
def test_titles_and_authors_are_taken_or_refused_in_a_sentence(title, author, wanted, monkeypatch):
    changed = {**edition.settings(), "title": title, "author": author}
    monkeypatch.setattr(edition, "settings", lambda: changed)
    if wanted is None:
        with pytest.raises(SystemExit, match="_config.yml: one title"):
            edition.edition()
    else:
        about = edition.edition()
        assert (list(about["title"].values()), about["authors"]) == wanted


def test_lists_that_are_right_are_left_alone(monkeypatch):
    """make would take what was written again for changed, and install it again."""
    monkeypatch.setattr(Path, "write_text", lambda *_, **__: pytest.fail("written again"))
    runpy.run_path(str(ROOT / "book" / "_make" / "lists.py"), run_name="__main__")


def test_a_bundle_is_made_again_for_an_edition_without_solutions():
    """It holds the exercises: `make wheel` and `make branch` hand it over."""
    bundle = "kalman_lib/live/bundle/widget.js"
    command = ["make", "--dry-run", f"PYTHON={sys.executable}", "-W", "_config.yml", bundle]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert "book/_ext/explorers.py" in said
