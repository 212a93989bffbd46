"""The book on paper: whole, with links that lead somewhere, tagged and with an outline."""

import subprocess
import sys

import pytest
from bs4 import BeautifulSoup
from conftest import ROOT, need_program

sys.path.insert(0, str(ROOT / "book" / "_make"))

import whole
from edition import edition

DAY = edition()["date"]


@pytest.fixture(scope="module", params=["id", "en"])
def document(request, site, tmp_path_factory):
    path = whole.write_whole(request.param)
    text = path.read_text(encoding="utf-8")
    path.unlink()
    return request.param, BeautifulSoup(text, "html.parser")


def test_every_page_is_in_it_once_and_every_link_leads_somewhere(document):
    _, paper = document
    names = [page for _, pages in whole.pages_in_order() for page in pages]
    sections = [section["id"] for section in paper.select("section.page[id]")]
    assert sections == [whole.slug(name) for name in names] + ["solutions"]
    places = [part["id"] for part in paper.find_all(id=True)]
    assert len(places) == len(set(places))
    inside = {link["href"][1:] for link in paper.select('a[href^="#"]')}
    left_out = tuple(whole.slug(name) for name in whole.LEFT_OUT)
    lost = {name for name in inside - set(places) if not name.startswith(left_out)}
    assert lost == set()


def test_solutions_stand_at_the_end_only_and_choices_stay(document):
    language, paper = document
    assert not paper.select("form, input, script, .exercise-hints")
    worked = paper.select(".exercise-worked")
    exercises = paper.select(".exercise")
    assert len(worked) == len(exercises) >= 36
    assert all(part.find_parent(id="solutions") for part in worked)
    assert len(paper.select(".exercise-letter")) > 30


def test_pictures_are_there(document, site):
    language, paper = document
    for picture in paper.select("img"):
        assert (site / language / picture["src"]).exists(), picture["src"]


def test_a_page_is_printed_tagged_with_an_outline(site, tmp_path):
    import pikepdf

    chromium = need_program("chromium", "google-chrome", install="apt-get install chromium")
    page = whole.Page("en", "notebooks/01_theory")
    source = site / "en" / "printed.html"
    source.write_text(whole.frame("en", whole.cover("en"), str(page.article)), encoding="utf-8")
    program = f"import pathlib, pdf; pdf.print_pdf({chromium!r}, pathlib.Path({str(source)!r}), "
    program += f"pathlib.Path({str(tmp_path / 'one.pdf')!r}))"
    try:  # in a process of its own: the browser of the other tests may be open in this one
        subprocess.run([sys.executable, "-c", program], cwd=ROOT / "book" / "_make", check=True)
    finally:
        source.unlink()
    with pikepdf.open(tmp_path / "one.pdf") as printed:
        assert 5 < len(printed.pages) < 30
        assert printed.Root.MarkInfo.Marked and printed.Root.StructTreeRoot is not None
        day = DAY.replace("-", "")  # of the edition: the same source, the same bytes
        assert {str(printed.docinfo[made])[2:10] for made in ("/CreationDate", "/ModDate")} == {day}
        with printed.open_outline() as outline:
            titles = [item.title for item in outline.root]
        assert any("Theory" in title for title in titles)
