"""An edition of an earlier year leads every page to the same page of the newest one."""

import sys

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_make"))

import older
from edition import edition

PAGE = '<article><h1>A title<a class="headerlink" href="#a">#</a></h1>\n<p>Text.</p></article>'
SAID = {
    "id": "Ini edisi 2.1 tahun 2025. Halaman yang sama ada dalam",
    "en": "This is edition 2.1 of 2025. The same page is in",
}
LINKS = {"id": "edisi terbaru", "en": "the newest edition"}


@pytest.fixture(params=SAID)
def site(request, tmp_path):
    """(language, folder) of two pages."""
    for name in ("notebooks/03_gyro.html", "index.html"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(PAGE, encoding="utf-8")
    return request.param, tmp_path


def of(monkeypatch, newest):
    about = {**edition(), "newest": newest, "version": "2.1", "date": "2025-08-01"}
    monkeypatch.setattr(older, "edition", lambda: about)


@pytest.mark.parametrize("name", ["notebooks/03_gyro.html", "index.html"])
def test_every_page_leads_to_its_newest_self(name, site, monkeypatch):
    language, folder = site
    of(monkeypatch, "https://example.org/kalman/")
    older.lead_to_newest(folder, language)
    address = f"https://example.org/kalman/{language}/{name}"
    line = f'{SAID[language]} <a href="{address}">{LINKS[language]}</a>.'
    expected = PAGE.replace("</h1>\n", f'</h1>\n<p class="older-edition">{line}</p>\n')
    assert (folder / name).read_text(encoding="utf-8") == expected


def test_the_newest_edition_says_nothing(site, monkeypatch):
    language, folder = site
    of(monkeypatch, "")
    older.lead_to_newest(folder, language)
    assert (folder / "index.html").read_text(encoding="utf-8") == PAGE


def test_this_edition_is_the_newest():
    assert edition()["newest"] == ""
