"""The recipe of CONTRIBUTING: a toy paper is added to a copy of the book, and all of it works.

Five things are written (a model, its test, an explorer, a notebook, a line in _toc.yml), then
`make lists` and `make outputs` run; no other file may have to change.
"""

import filecmp
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT, listen
from recipe import toy_notebook

HERE = Path(__file__).resolve().parent / "recipe"
NOTEBOOK = "notebooks/08_toy.ipynb"
WRITTEN = {"kalman_lib/papers/toy.py", "tests/test_toy.py", NOTEBOOK, "_toc.yml"}
EXPLORER = "book/explorers/papers/toy/"
BY_MAKE_LISTS = {"README.md", "book/intro.md"}
LAST_CHAPTER = "      - file: notebooks/07_workshop\n"


def sources():
    """The files of the book, as Git knows them or would add them."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


def run(copy, *arguments):
    """A Python program of the copy; what it prints if it fails is the reason."""
    environment = {**os.environ, "PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, *arguments]
    done = subprocess.run(command, cwd=copy, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, (
        f"{' '.join(arguments)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
    )
    return done.stdout


def pytest_in(copy, *arguments):
    """A notebook is run from the top, also where pytest-randomly is installed."""
    without = [
        part for name in ("cacheprovider", "xdist", "randomly") for part in ("-p", f"no:{name}")
    ]
    return run(copy, "-m", "pytest", "-q", *without, *arguments)


def add_the_toy(copy):
    """Steps 1 to 4 of the recipe."""
    shutil.copy(HERE / "toy.py", copy / "kalman_lib" / "papers" / "toy.py")
    shutil.copy(HERE / "toy_checks.py", copy / "tests" / "test_toy.py")
    shutil.copytree(HERE / "toy", copy / EXPLORER)
    toy_notebook.write(copy / NOTEBOOK)
    contents = copy / "_toc.yml"
    line = LAST_CHAPTER.replace("07_workshop", "08_toy")
    text = re.sub(r"(notebooks/07_workshop\n(?: {8}.*\n)*)", rf"\1{line}", contents.read_text())
    contents.write_text(text)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the book with the toy paper in it."""
    folder = tmp_path_factory.mktemp("book") / "book"
    for name in sources():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)  # as old as it is: else npm installs again
    (folder / "book" / "node_modules").symlink_to(ROOT / "book" / "node_modules")
    add_the_toy(folder)
    run(folder, "book/_make/lists.py")
    run(folder, "book/_ext/explorers.py")
    run(folder, "book/store_outputs.py", NOTEBOOK)
    return folder


def test_no_other_file_had_to_change(copy):
    changed = {
        name for name in sources() if not filecmp.cmp(ROOT / name, copy / name, shallow=False)
    }
    assert changed == {"_toc.yml"} | BY_MAKE_LISTS


def test_the_rules_of_the_house_hold(copy):
    rules = ("test_lists", "test_imports", "test_house", "test_notebooks", "test_exercises")
    rules += ("test_terms", "test_letters")
    files = [f"tests/{name}.py" for name in rules]
    pytest_in(copy, "-p", "tests.recipe.only_toy", *files)
    pytest_in(copy, "tests/test_toy.py")


def test_its_page_and_its_model_agree(copy):
    pytest_in(copy, "tests/test_explorer_parity.py", "-k", "toy")


def test_it_can_be_explored_in_a_notebook(copy):
    pytest_in(copy, "tests/test_explorer.py", "-k", "toy")


def test_its_notebook_gives_what_it_stores(copy):
    pytest_in(copy, "--nbval", NOTEBOOK)


def test_its_page_is_built_and_alive(copy, chromium):
    """In one language; that words are there in both was asked when the explorers were made."""
    built = run(copy, "book/build.py", "--only", NOTEBOOK, "--language", "en")
    path = re.search(r"Open (.+\.html)", built)[1]
    page = chromium.new_page()
    trouble = listen(page)
    page.goto(Path(path).as_uri())
    element = page.locator("kalman-explorer[paper=toy]")
    before = element.locator(".explorer-outcome").inner_text()
    element.locator("input[type=range]").first.press("End")
    page.wait_for_function(
        "before => document.querySelector('.explorer-outcome').innerText !== before", arg=before
    )
    assert trouble == []
    page.close()
