"""The copy on a reader's device: complete, kept up to date, on every kind of host.

A small site of a few pages with the book's own worker and script; every test has a browser and a
host of its own. The whole book without a network: test_site_use.py.
"""

import contextlib
import http.server
import itertools
import os
import shutil
import sys
import threading
from pathlib import Path

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_make"))

import kept

DAYS = itertools.count(1_500_000_000, 86_400)  # when the files of a version were written
PAGES = ("book/intro.html", "notebooks/01_theory.html", "notebooks/02_smoother.html")
PAGE = """<!DOCTYPE html><html lang="{language}" data-content_root="../"><meta charset="utf-8">
<link rel="icon" href="data:,"><link rel="alternate" hreflang="x-default" href="../../index.html">
<script src="../_static/offline.js"></script><main><h1>{name} {version}</h1></main>"""


def write_site(folder, version, monkeypatch):
    """Both languages with workers, as book/_make/assemble.py writes them."""
    monkeypatch.setattr(kept, "SITE", folder)
    shutil.rmtree(folder, ignore_errors=True)
    for language in ("id", "en"):
        for name in PAGES:
            path = folder / language / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(PAGE.format(language=language, name=name, version=version))
        static = folder / language / "_static"
        static.mkdir()
        shutil.copy(ROOT / "book" / "_static" / "offline.js", static)
        (folder / language / "book.zip").write_bytes(b"PK" + bytes(100))
        kept.write_language(language, PAGES[0])
    (folder / "index.html").write_text("<!DOCTYPE html><title>Choose</title><h1>Choose</h1>")
    kept.write_root(PAGES[0])
    day = next(DAYS)  # a host tells seconds only: two versions of one second would be the same
    for path in folder.rglob("*"):
        os.utime(path, (day, day))


class Host(http.server.SimpleHTTPRequestHandler):
    """A static host with a cache header, which may fail or redirect."""

    failing = ()  # addresses that answer 503
    drops_html = False  # /x.html leads to /x
    asked = None  # a list of addresses

    def do_GET(self):
        path = self.path.partition("?")[0]
        self.asked.append(path)
        if path in self.failing:
            return self.send_error(503)
        if self.drops_html and path.endswith(".html"):
            self.send_response(308)
            self.send_header("Location", path.removesuffix(".html"))
            return self.end_headers()
        if self.drops_html and Path(self.translate_path(f"{path}.html")).is_file():
            self.path = f"{path}.html"
        return super().do_GET()

    def end_headers(self):
        self.send_header("Cache-Control", "max-age=600")
        super().end_headers()

    def log_message(self, *arguments):
        pass


@contextlib.contextmanager
def host(folder, **settings):
    """A host of this folder -> (its address, its handler, whose settings a test may change)."""
    given = {"asked": [], **settings}
    handler = type("OneHost", (Host,), given)
    serve = lambda *arguments: handler(*arguments, directory=str(folder))  # noqa: E731
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), serve) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}", handler
        server.shutdown()


@pytest.fixture
def context(chromium):
    made = chromium.new_context()
    yield made
    made.close()


def word(page):
    return page.locator(".offline-word").inner_text()


def visit(context, address):
    """A page whose copy is told about."""
    page = context.new_page()
    page.goto(address)
    page.wait_for_selector(".offline-word")
    return page


def test_the_copy_is_complete_and_says_so(tmp_path, context, monkeypatch):
    write_site(tmp_path, "one", monkeypatch)
    with host(tmp_path) as (address, _):
        page = visit(context, f"{address}/en/{PAGES[0]}")
        assert word(page) == "This book is kept on this device and can be read without a network."
    for name in PAGES:  # the host is gone
        page.goto(f"{address}/en/{name}")
        assert page.locator("h1").inner_text() == f"{name} one"
    kept_zip = "fetch('../book.zip').then(r => r.blob()).then(b => b.size)"
    assert page.evaluate(kept_zip) == 102
    page.goto(f"{address}/")
    assert page.locator("h1").inner_text() == "Choose"
    page.goto(f"{address}/id/{PAGES[1]}")  # a language that was never opened
    assert page.url == f"{address}/{kept.UNKEPT}"
    page.locator("a[hreflang=en]").click()
    page.wait_for_url(f"{address}/en/{PAGES[0]}")


def test_a_new_version_reaches_the_reader(tmp_path, context, monkeypatch):
    """Under max-age=600, where the browser's own cache holds the old pages."""
    write_site(tmp_path, "one", monkeypatch)
    with host(tmp_path) as (address, handler):
        visit(context, f"{address}/id/{PAGES[0]}").close()
        write_site(tmp_path, "two", monkeypatch)
        handler.asked.clear()
        page = visit(context, f"{address}/id/{PAGES[0]}")
        assert page.locator("h1").inner_text() == f"{PAGES[0]} one"
        page.wait_for_selector(".newer-word")
        assert "Ada versi baru buku ini." in page.locator(".newer-word").inner_text()
        page.locator(".newer-word button").click()
        page.wait_for_function("document.querySelector('h1')?.textContent.endsWith('two')")
        for name in PAGES:
            page.goto(f"{address}/id/{name}")
            assert page.locator("h1").inner_text() == f"{name} two"
        assert "/id/book.zip" not in handler.asked  # what has not changed is not fetched again


def test_a_new_version_comes_without_a_tap_when_the_book_was_closed(tmp_path, context, monkeypatch):
    write_site(tmp_path, "one", monkeypatch)
    with host(tmp_path) as (address, _):
        visit(context, f"{address}/id/{PAGES[0]}").close()
        write_site(tmp_path, "two", monkeypatch)
        page = visit(context, f"{address}/id/{PAGES[0]}")
        page.wait_for_selector(".newer-word")
        page.goto("about:blank")
        page.goto(f"{address}/id/{PAGES[1]}")
        for _ in range(1000):  # until the old worker has ended
            if "two" in page.locator("h1").inner_text():
                break
            page.goto("about:blank")
            page.goto(f"{address}/id/{PAGES[1]}")
        assert page.locator("h1").inner_text() == f"{PAGES[1]} two"


def test_one_failing_file_does_not_undo_the_rest(tmp_path, context, monkeypatch):
    write_site(tmp_path, "one", monkeypatch)
    broken = f"/id/{PAGES[1]}"
    with host(tmp_path, failing=(broken,)) as (address, handler):
        page = visit(context, f"{address}/id/{PAGES[0]}")
        count = len(kept.files_in(tmp_path / "id"))
        assert word(page) == (
            f"Tersimpan untuk dibaca tanpa jaringan: {count - 1} dari {count} berkas."
        )
        handler.failing = ()
        page.reload()  # the next visit tries it again
        page.wait_for_function(
            "document.querySelector('.offline-word')?.textContent.startsWith('Buku ini tersimpan')"
        )
    page.goto(address + broken)
    assert page.locator("h1").inner_text() == f"{PAGES[1]} one"


def test_hosts_that_drop_html(tmp_path, context, monkeypatch):
    write_site(tmp_path, "one", monkeypatch)
    with host(tmp_path, drops_html=True) as (address, _):
        page = visit(context, f"{address}/en/{PAGES[0]}")
        assert word(page).startswith("This book is kept")
    for name in PAGES:
        for path in (name, name.removesuffix(".html")):
            page.goto(f"{address}/en/{path}")
            assert page.locator("h1").inner_text() == f"{name} one"


def test_two_books_of_one_host_leave_each_other_alone(tmp_path, context, monkeypatch):
    for book in ("old", "new"):
        write_site(tmp_path / book, book, monkeypatch)
    with host(tmp_path) as (address, _):
        for book in ("old", "new"):
            visit(context, f"{address}/{book}/en/{PAGES[0]}")
        write_site(tmp_path / "new", "newer", monkeypatch)
        page = visit(context, f"{address}/new/en/{PAGES[0]}")
        page.wait_for_selector(".newer-word")
        page.locator(".newer-word button").click()
        page.wait_for_function("document.querySelector('h1')?.textContent.endsWith('newer')")
    for book, version in (("old", "old"), ("new", "newer")):
        page.goto(f"{address}/{book}/en/{PAGES[2]}")
        assert page.locator("h1").inner_text() == f"{PAGES[2]} {version}"


def test_the_version_follows_what_was_built(tmp_path, monkeypatch):
    def worker(version):
        write_site(tmp_path, version, monkeypatch)
        return (tmp_path / "en" / kept.WORKER).read_text()

    assert worker("one") == worker("one") != worker("two")
