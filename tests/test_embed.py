"""An explorer alone on a bare page, for a frame on somebody else's page: there for every explorer,
light, alive in a page of another origin, and a line of HTML for lecturers that leads to it."""

import contextlib
import functools
import http.server
import re
import sys
import threading

import pytest
from bs4 import BeautifulSoup
from conftest import ROOT, listen
from explorer_helpers import pages_with_explorers
from weigh import first_view, packing_host

sys.path.insert(0, str(ROOT / "book" / "_make"))

import embeds
import explorers
import found

LANGUAGES = ("id", "en")
MOST = 100_000  # bytes at the first view, packed
FRAME = {"width": 360, "height": 640}  # pixels, on a phone
BACKGROUNDS = {"light": "rgb(253, 252, 249)", "dark": "rgb(20, 24, 29)"}
# Pixels of the sentence that lie below the figure, which sticks to the upper edge
COVERED = """() => {
  const box = name => document.querySelector(name).getBoundingClientRect();
  return box('.explorer-figures.first').bottom - box('.explorer-outcome').top;
}"""
DRAWN = "document.querySelector('kalman-explorer').explorer?.shown"
each_language = pytest.mark.parametrize("language", LANGUAGES)


def parsed(path):
    return BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser")


def shown_in(site, language):
    """{(paper, view): the first page of the book that shows it}"""
    homes = {}
    for path in pages_with_explorers(site, language):
        for element in parsed(path).select("kalman-explorer"):
            homes.setdefault((element["paper"], element.get("view")), []).append(path)
    return homes


def bare_page(site, language, paper, view):
    return site / language / "embed" / (f"{paper}.{view}.html" if view else f"{paper}.html")


@contextlib.contextmanager
def other_origin(folder):
    """A host of a page that is not ours."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(folder))
    handler.func.log_message = lambda *arguments: None
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


# --- the files ----------------------------------------------------------------------------------


@each_language
def test_every_explorer_of_the_book_has_a_bare_page_that_leads_to_its_chapter(language, site):
    homes = shown_in(site, language)
    made = {path.name for path in (site / language / "embed").iterdir()}
    assert made == {bare_page(site, language, *key).name for key in homes} and len(made) > 12
    titles = set()
    for (paper, view), pages in homes.items():
        path = bare_page(site, language, paper, view)
        page = parsed(path)
        (element,) = page.select("kalman-explorer")
        assert page.html["lang"] == language
        assert (element["paper"], element.get("view")) == (paper, view)
        titles.add(page.title.text)
        assert page.title.text.startswith(page.h1.text)
        assert page.select_one("meta[name=robots]")["content"] == "noindex"
        link = page.select_one(".embed-source a")
        home, _, key = link["href"].partition("#")
        assert (path.parent / home).resolve() in pages and key == f"{path.stem}:"
        assert page.select_one("link[rel=canonical]")["href"] == home
        assert link["target"] == "_blank" and page.select("noscript img[alt]")
        loaded = [re.search(r"(\w+)\.js", tag["src"])[1] for tag in page.select("script")]
        assert loaded == ["embed", *explorers.scripts([paper])]
    assert len(titles) == len(made)


@each_language
def test_bare_pages_are_kept_with_their_language_and_not_in_the_sitemap(
    language, site, monkeypatch
):
    worker = (site / language / "offline-worker.js").read_text(encoding="utf-8")
    for path in (site / language / "embed").iterdir():
        assert f'"embed/{path.name}"' in worker
    for name in ("embed.css", "embed.js"):
        assert f'"_static/{name}"' in worker and (site / language / "_static" / name).exists()
    monkeypatch.setattr(found, "SITE", site)
    assert "/embed/" not in found.sitemap("https://kalman.example")


def chapter_with(paper, folder):
    """A small built language: one chapter with the explorer of a new paper, and the lecturers'."""
    for page, body in {
        "notebooks/01_theory": f'<h1>1. Toys</h1><kalman-explorer paper="{paper}">'
        f'<img alt="" src="../_images/toy.png"></kalman-explorer>',
        "book/teaching": f"<h1>Teaching</h1>{embeds.LINES}",
    }.items():
        path = folder / "en" / f"{page}.html"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(body, encoding="utf-8")
    return folder / "en"


@pytest.mark.parametrize("address", ["", "https://kalman.example/book/"])
def test_a_new_explorer_gets_its_line_by_itself(address, tmp_path, monkeypatch):
    edition = {**embeds.edition(), "address": address}
    monkeypatch.setattr(embeds, "edition", lambda: edition)
    monkeypatch.setattr(embeds, "names", lambda: {"toy": {"first": {"en": 'A "toy"', "id": "M"}}})
    monkeypatch.setattr(embeds.explorers, "scripts", lambda papers: ["core", *papers])
    folder = chapter_with("toy", tmp_path)
    embeds.show_lines(folder, "en")
    shown = parsed(folder / "book" / "teaching.html").select_one("pre").text
    frame = BeautifulSoup(shown, "html.parser").iframe
    root = address.rstrip("/") or embeds.PLACEHOLDER["en"]
    assert frame["src"] == f"{root}/en/embed/toy.html"
    assert frame["title"] == 'A "toy"' and frame["loading"] == "lazy"
    assert bool(address) == (
        embeds.PLACEHOLDER["en"] not in (folder / "book/teaching.html").read_text()
    )


@pytest.mark.parametrize("paper", ["gyro", "quadrotor", "workshop", "ship"])
def test_a_frame_lets_an_explorer_that_listens_to_a_phone_do_so(paper):
    """Elsewhere a frame has no sensors, unless the line for it grants them."""
    embed = embeds.Embed(paper, None, "A name", f"notebooks/{paper}", "")
    frame = BeautifulSoup(embeds.line(embed, "en", ""), "html.parser").iframe
    granted = set(frame["allow"].split("; ")) - {"clipboard-write"}
    sensors = {"accelerometer", "gyroscope", "magnetometer"}
    assert granted == (set() if paper == "ship" else sensors)


# --- in a browser -------------------------------------------------------------------------------


@each_language
def test_the_line_of_a_lecturer_shows_the_explorer_on_a_page_of_another_origin(
    language, site, server, chromium, tmp_path
):
    page = chromium.new_page(viewport={"width": 800, "height": 900}, service_workers="block")
    page.goto(f"{server}/{language}/book/teaching.html")
    assert page.locator(".embed-unknown").count() == 0
    lines = page.locator(".embed-lines pre").all_text_contents()
    assert len(lines) == len(list((site / language / "embed").iterdir()))
    (line,) = [text for text in lines if f"{server}/{language}/embed/theory.html" in text]
    line = line.replace("theory.html", "theory.html#theory:R=1")
    (tmp_path / "index.html").write_text(
        '<!DOCTYPE html><link rel="icon" href="data:,">'
        "<script>var heard = 0; onmessage = () => heard++</script>"
        f'<p style="height: 100px">A course</p>{line}<p style="height: 900px">Its end</p>',
        encoding="utf-8",
    )
    with other_origin(tmp_path) as address:
        trouble = listen(page)
        page.goto(address)
        frame = page.frame_locator("iframe")
        frame.locator("kalman-explorer.live .explorer-outcome span").first.wait_for()
        inside = page.frames[1]
        inside.wait_for_function(f"{DRAWN}.R === 1")
        before = frame.locator(".explorer-outcome").inner_text()
        slider = frame.locator("input[type=range]:visible").first
        slider.focus()
        page.keyboard.press("End")
        inside.wait_for_function(
            "before => document.querySelector('.explorer-outcome').textContent !== before",
            arg=before,
        )
        assert page.evaluate("heard") == 0
        assert page.evaluate("scrollY") == 0  # the page around is not scrolled to the frame
        assert trouble == []
    page.close()


@each_language
def test_a_bare_page_fits_the_frame_of_a_phone_in_both_schemes(language, site, server, chromium):
    for scheme, background in BACKGROUNDS.items():
        context = chromium.new_context(
            viewport=FRAME, color_scheme=scheme, reduced_motion="reduce", service_workers="block"
        )
        page = context.new_page()
        trouble = listen(page)
        for path in sorted((site / language / "embed").iterdir()):
            page.goto(f"{server}/{language}/embed/{path.name}")
            page.wait_for_function(DRAWN)
            assert page.evaluate("document.documentElement.scrollWidth") <= FRAME["width"], path
            body = "getComputedStyle(document.body).backgroundColor"
            assert page.evaluate(body) == background
            covered = page.evaluate(COVERED)
            assert covered <= 0, (path, covered)
            sight = page.locator(".explorer-plot:visible").first.bounding_box()
            assert sight["y"] + sight["height"] < FRAME["height"] / 2, path
        assert trouble == []
        page.emulate_media(color_scheme="light" if scheme == "dark" else "dark")
        page.wait_for_function(
            f"getComputedStyle(document.body).backgroundColor !== '{background}'"
        )
        context.close()


def test_the_link_below_leads_to_the_chapter_with_the_settings(site, server, chromium):
    context = chromium.new_context(service_workers="block", reduced_motion="reduce")
    page = context.new_page()
    page.goto(f"{server}/en/embed/gyro.drift.html#gyro.drift:sensor=true")
    page.wait_for_function(DRAWN)
    with context.expect_page() as opened:
        page.locator(".embed-source a").click()
    opened.value.wait_for_selector("article")
    assert opened.value.url == f"{server}/en/notebooks/03_gyro.html#gyro.drift:sensor=true"
    context.close()


def test_a_bare_page_is_light(site, chromium):
    with packing_host(site) as address:
        for path in sorted((site / "id" / "embed").iterdir()):
            size, requests, _ = first_view(chromium, f"{address}/id/embed/{path.name}")
            assert 30_000 < size <= MOST and requests >= 6, (path.name, size)
