"""The builder of chapter 7 in a browser: on a phone and on a desk, in both languages."""

import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT, listen
from explorer_helpers import shown
from workshop_helpers import as_text, own_data

from kalman_lib.papers import workshop

SIZES = {"phone": {"width": 390, "height": 844}, "desk": {"width": 1280, "height": 900}}
MOST_CONTROLS = 8  # to be seen at once, beside the five groups
PAGE = """<!doctype html><html lang="{language}"><meta charset="utf-8">
<meta name="viewport" content="width=device-width"><title>.</title>
<link rel="stylesheet" href="core.css">
<kalman-explorer paper="workshop"></kalman-explorer>
{scripts}"""
SEEN = """e => [...e.querySelectorAll('.explorer-controls > .explorer-control')].filter(
  part => part.offsetParent && !part.querySelector('[aria-pressed]')).length"""
WORDS = {
    "id": dict(
        groups="Data Gerak Derau Periksa Simpan".split(),
        passes="Filter ini lulus",
        likely="Besarnya derau",
        three="R kira-kira tiga kali terlalu kecil.",
        keep="Ambil nilainya",
        pattern="Bagaimana besaran itu berubah?",
        second="Kolom kedua dari data",
        column="Kolom kedua",
        gate="gerbang",
        code="Unduh kode itu",
        csv="Unduh data",
        excel="Unduh Excel",
        square="F harus persegi",
        device="tidak meninggalkan perangkat ini",
    ),
    "en": dict(
        groups="Data Motion Noise Check Save".split(),
        passes="The filter passes",
        likely="How much noise",
        three="R is about three times too small.",
        keep="Take these values",
        pattern="How does the quantity change?",
        second="The second column of the data",
        column="The second column",
        gate="gate",
        code="Download that code",
        csv="Download the data",
        excel="Download Excel",
        square="F must be square",
        device="Nothing leaves this device",
    ),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A page of its own for each language, with the scripts of the book."""
    import explorers

    made = tmp_path_factory.mktemp("pages")
    for language in WORDS:
        explorers.bundle(made / language, language)
        names = explorers.scripts(["workshop"])
        scripts = "".join(f'<script src="{name}.js"></script>' for name in names)
        text = PAGE.format(language=language, scripts=scripts)
        (made / language / "page.html").write_text(text, encoding="utf-8")
    return made


class Builder:
    """The explorer as a reader handles it: by what its controls are called."""

    def __init__(self, page, language):
        self.page = page
        self.words = WORDS[language]
        self.element = page.locator("kalman-explorer")

    def group(self, number):
        self.element.get_by_role("button", name=re.compile(f"^{number} ")).click()
        shown(self.element)

    def settle(self):
        """Until the most likely noise is found."""
        self.page.wait_for_function(
            "e => e.explorer.r?.found && !e.explorer.work && !e.explorer.frame",
            arg=self.element.element_handle(),
        )
        shown(self.element)

    def says(self):
        self.settle()
        return self.element.locator(".explorer-outcome").inner_text()

    def choose(self, name, value):
        self.element.get_by_label(self.words[name], exact=True).select_option(value)
        shown(self.element)

    def fill(self, name, text):
        field = self.element.locator(f"[id$='-{name}']").locator("..").locator("..")
        box = field.locator(".explorer-value")
        box.fill(text)
        box.press("Enter")
        shown(self.element)

    def check(self, name):
        self.element.get_by_role("checkbox", name=re.compile(self.words[name])).check()
        shown(self.element)

    def download(self, name, target):
        with self.page.expect_download() as info:
            self.element.get_by_role("button", name=self.words[name]).click()
        info.value.save_as(target / info.value.suggested_filename)

    def numbers(self, name):
        return np.array(self.element.evaluate(f"e => Array.from(e.explorer.r.result.{name})"))


@pytest.fixture(params=[(language, size) for language in WORDS for size in SIZES], ids="-".join)
def builder(request, folder, chromium):
    language, size = request.param
    context = chromium.new_context(viewport=SIZES[size], reduced_motion="reduce")
    page = context.new_page()
    trouble = listen(page)
    page.goto((folder / language / "page.html").as_uri())
    yield Builder(page, language)
    assert trouble == []
    assert page.evaluate("document.documentElement.scrollWidth") <= SIZES[size]["width"]
    context.close()


def test_it_works_at_once_and_shows_few_controls_at_a_time(builder):
    assert builder.says().startswith(builder.words["passes"])
    names = builder.element.locator("button[aria-pressed]").all_inner_texts()
    assert [name[2:] for name in names] == builder.words["groups"]
    for number in range(1, 6):
        builder.group(number)
        assert 1 <= builder.element.evaluate(SEEN) <= MOST_CONTROLS
        assert builder.element.locator(".explorer-message").is_hidden()
    builder.group(1)
    assert builder.words["device"] in builder.element.inner_text()


def test_the_noise_by_hand_and_by_likelihood(builder):
    builder.fill("R", "3")
    assert builder.words["three"] in builder.says()
    builder.choose("likely", "true")
    assert "NIS" in builder.says()
    assert builder.element.locator("input[type=range]:visible").count() == 0
    found = builder.element.evaluate("e => e.explorer.r.found.values.R")
    builder.element.get_by_role("button", name=builder.words["keep"]).click()
    assert builder.says().startswith(builder.words["passes"])
    kept = builder.element.evaluate("e => [e.explorer.s.likely, e.explorer.s.R]")
    assert kept == [False, pytest.approx(found, rel=1e-3)]


def test_own_data_from_the_table_to_the_program(builder, tmp_path):
    """Two sensors, uneven steps, gaps, outliers: the program that is handed over says the same."""
    about = dict(pattern=3, second=3)
    data = own_data(workshop.Params(**about), uneven=True, gaps=True, outliers=True, steps=150)
    builder.group(1)
    builder.element.locator("textarea[id$='-text']").fill(as_text(data))
    shown(builder.element)
    builder.group(2)
    builder.choose("second", "3")
    builder.group(1)
    builder.choose("column", "w")
    builder.group(4)
    builder.check("gate")
    builder.group(3)
    builder.choose("likely", "true")
    assert "NIS" in builder.says() and builder.numbers("gated").sum() > 5
    builder.group(5)
    builder.download("code", tmp_path)
    builder.download("csv", tmp_path)
    code = (tmp_path / "workshop.py").read_text(encoding="utf-8")
    saved = 'np.savez("result.npz", x=result.x, P=result.P)\n'
    (tmp_path / "workshop.py").write_text(code + saved, encoding="utf-8")
    run = [sys.executable, "workshop.py"]
    subprocess.run(run, cwd=tmp_path, check=True, env={"PYTHONPATH": str(ROOT)})
    result = np.load(tmp_path / "result.npz")
    for name in ("x", "P"):
        ours, theirs = builder.numbers(name), result[name].ravel()
        assert (np.abs(ours - theirs) <= 1e-9 * (1 + np.abs(theirs))).all()


def test_own_matrices_and_what_is_wrong_with_them(builder):
    builder.group(2)
    builder.choose("pattern", "5")
    box = builder.element.locator("textarea[id$='-F']")
    box.fill("1 0,1 0\n0 1 0,1")
    message = builder.element.locator(".explorer-message")
    message.get_by_text(builder.words["square"]).wait_for()
    box.fill("1 0,1\n-0,1 1")
    message.wait_for(state="hidden")
    assert builder.numbers("F")[:4].tolist() == [1, 0.1, -0.1, 1]


def test_a_scalar_filter_also_goes_into_a_workbook(builder, tmp_path):
    builder.group(5)
    excel = builder.element.get_by_role("button", name=builder.words["excel"])
    assert excel.is_hidden()
    builder.group(2)
    builder.choose("pattern", "2")
    builder.group(5)
    builder.download("excel", tmp_path)
    assert (tmp_path / "workshop.xlsx").read_bytes()[:2] == b"PK"


def test_a_link_leads_to_the_same_filter(builder):
    builder.group(2)
    builder.choose("pattern", "5")
    box = builder.element.locator("textarea[id$='-F']")
    box.fill("1 0,5; 0 0.9")
    builder.group(3)
    builder.fill("R", "2")
    before = builder.numbers("x")
    address = builder.page.evaluate("location.href")
    builder.page.goto("about:blank")
    builder.page.goto(address)
    builder.settle()
    np.testing.assert_array_equal(builder.numbers("x"), before)
