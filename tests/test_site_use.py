"""The built book in use: links, languages, search, downloads, no network, no scripts."""

import json
import re
import urllib.parse
import zipfile
from pathlib import Path

import pytest
from site_helpers import LANGUAGES, PHONE, ROOT, Reader, is_redirect, pages_of, twin


def test_every_link_leads_somewhere(site):
    readers = {path: Reader(path) for path in pages_of(site)}
    dead = []
    for path, reader in readers.items():
        for link in reader.links:
            address = urllib.parse.urlsplit(link)
            if address.scheme or address.netloc:
                continue
            # 404.html is shown at addresses of any depth, so its links begin at the top
            start = site if address.path.startswith("/") else path.parent
            place = urllib.parse.unquote(address.path).lstrip("/")
            target = (start / place).resolve() if address.path else path
            name, colon, _ = urllib.parse.unquote(address.fragment).partition(":")
            fragment = name + colon
            if not target.is_file():
                dead.append((path.relative_to(site).as_posix(), link))
            elif (
                fragment and target in readers and fragment not in readers[target].ids | {"choose"}
            ):
                dead.append((path.relative_to(site).as_posix(), link))
    assert dead == []


def test_pages_name_their_other_language(site):
    for path in pages_of(site):
        text = path.read_text(encoding="utf-8")
        if "bd-article-container" not in text:
            continue
        links = dict(re.findall(r'<link rel="alternate" hreflang="([\w-]+)" href="([^"]+)">', text))
        assert set(links) == {"id", "en", "x-default"}, path
        name = path.relative_to(site).as_posix()
        assert (path.parent / links[name[:2]]).resolve() == path
        assert (path.parent / links[LANGUAGES[name[:2]]]).resolve() == site / twin(name)
        assert (path.parent / links["x-default"]).resolve() == site / "index.html"


@pytest.mark.parametrize("scheme", ["http", "file"])
def test_the_switcher_leads_to_the_same_section_and_back(scheme, bases, chromium, site):
    longest = max(
        (site / "id" / "notebooks").glob("*.html"),
        key=lambda path: path.read_text(encoding="utf-8").count("<section id="),
    )
    name = longest.relative_to(site / "id").as_posix()
    context = chromium.new_context(viewport=PHONE, reduced_motion="reduce", service_workers="block")
    page = context.new_page()
    page.goto(f"{bases[scheme]}/id/{name}")
    section = page.evaluate(
        "(() => { const s = document.querySelectorAll('article section section'); return "
        "s[Math.floor(s.length / 2)].id })()"
    )
    page.evaluate("id => document.getElementById(id).scrollIntoView()", section)
    for language, lang_name in (("en", "English"), ("id", "Bahasa Indonesia")):
        switcher = page.locator("a.language-switcher")
        assert switcher.inner_text() == lang_name and switcher.get_attribute("lang") == language
        box = switcher.bounding_box()  # not switcher.click(), which may scroll
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.wait_for_url(f"**/{language}/{name}#{section}")
        kept = "language => localStorage.getItem('book-language') === language"
        page.wait_for_function(kept, arg=language)
        assert (
            -5
            < page.evaluate(
                "id => document.getElementById(id).getBoundingClientRect().top", section
            )
            < PHONE["height"] / 2
        )
    context.close()


def test_the_first_page_chooses_and_remembers_the_language(server, chromium):
    for locale, language in (("id-ID", "id"), ("ms-MY", "id"), ("en-GB", "en"), ("fr-FR", "en")):
        context = chromium.new_context(locale=locale)
        page = context.new_page()
        page.goto(f"{server}/index.html")
        page.wait_for_url(f"**/{language}/**")
        page.locator("a.language-switcher").click()
        page.wait_for_url(f"**/{LANGUAGES[language]}/**")
        page.goto(f"{server}/index.html")
        page.wait_for_url(f"**/{LANGUAGES[language]}/**")
        context.close()


def test_after_one_visit_the_book_opens_without_a_network(server, chromium, site):
    """One page is read; then the network is gone, and every other page of that language still
    opens, figures included."""
    context = chromium.new_context(viewport=PHONE)
    page = context.new_page()
    page.goto(f"{server}/id/book/intro.html")
    page.wait_for_function(
        "document.querySelector('.offline-word')?.textContent.startsWith('Buku ini tersimpan')"
    )
    context.set_offline(True)
    pages = [path for path in pages_of(site / "id") if not is_redirect(path)]
    assert len(pages) >= 7
    for path in pages:
        page.goto(f"{server}/id/{path.relative_to(site / 'id').as_posix()}")
        page.wait_for_selector("h1")
        page.evaluate(
            "document.querySelectorAll('img').forEach(image => { image.loading = 'eager' })"
        )
        page.wait_for_function("[...document.images].every(image => image.complete)")
        assert page.evaluate("[...document.images].every(image => image.naturalWidth > 0)"), (
            path.name
        )
    for download in ("kalman.xlsx", "filter-kalman.zip", "_sources/notebooks/03_gyro.ipynb"):
        size = page.evaluate(
            "name => fetch(name).then(r => r.blob()).then(b => b.size)", f"{server}/id/{download}"
        )
        assert size == (site / "id" / download).stat().st_size
    page.goto(f"{server}/en/book/intro.html")  # the network really is gone
    assert page.url == f"{server}/unkept.html"
    context.close()


def test_without_javascript(server, chromium, site):
    context = chromium.new_context(java_script_enabled=False, viewport=PHONE)
    page = context.new_page()
    page.goto(f"{server}/index.html")
    assert page.locator("a[hreflang]").count() == 2 and page.locator("a[hreflang=en]").is_visible()
    page.locator("a[hreflang=en]").click()
    assert "/en/" in page.url
    page.locator("a.language-switcher").click()
    assert "/id/" in page.url
    chapter = min((site / "id" / "notebooks").glob("*.html"))
    page.goto(f"{server}/id/notebooks/{chapter.name}")
    assert page.locator(".katex-html").count() == page.locator(".katex math").count() > 0
    context.close()


@pytest.mark.parametrize("scheme", ["http", "file"])
@pytest.mark.parametrize(
    "language, word, status",
    [("id", "penguatan", "Bagian yang ditemukan"), ("en", "gain", "Sections found")],
)
def test_search(scheme, language, word, status, bases, chromium):
    page = chromium.new_page()
    errors = []
    page.on(
        "console", lambda message: errors.append(message.text) if message.type == "error" else None
    )
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{bases[scheme]}/{language}/search.html?q={word}")
    page.wait_for_selector("#search-results li a")
    page.wait_for_function(
        "text => document.querySelector('#search-results').innerText.includes(text)", arg=status
    )
    if language == "id":
        assert page.locator("#search-results h2").inner_text() == "Hasil pencarian"
    page.goto(f"{bases[scheme]}/{language}/search.html?q=qqqqzzzz")
    page.wait_for_function(
        "() => document.querySelector('#search-results .search-summary').innerText.length > 20"
    )
    assert ("Tidak ada halaman" in page.locator("#search-results").inner_text()) == (
        language == "id"
    )
    assert errors == []
    page.close()


def test_texts_that_appear_on_a_click(server, chromium, site):
    chapter = min((site / "id" / "notebooks").glob("*.html"))
    context = chromium.new_context(permissions=["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.goto(f"{server}/id/notebooks/{chapter.name}")
    button = page.locator("button.copybtn:visible").first
    assert button.get_attribute("data-tooltip") == "Salin"
    button.scroll_into_view_if_needed()
    button.dispatch_event("click")  # it shows only while the mouse is over its code
    page.wait_for_selector("button.copybtn[data-tooltip='Tersalin!']", state="attached")
    assert "Copy" not in page.evaluate(
        "[...document.querySelectorAll('.copybtn')].map(b => b.innerHTML).join()"
    )
    context.close()


@pytest.mark.parametrize("language", LANGUAGES)
def test_downloads_hold_one_language_and_the_outputs(language, site):
    sources = [
        path
        for folder in ("book", "notebooks")
        for path in (ROOT / folder).glob("*.*")
        if path.suffix in (".ipynb", ".md")
    ]
    checked = 0
    for source in sources:
        download = site / language / "_sources" / source.relative_to(ROOT)
        if not download.exists():
            continue
        checked += 1
        text = download.read_text(encoding="utf-8")
        assert f"lang-{LANGUAGES[language]}" not in text
        if source.suffix == ".md":
            assert "+++" not in text and text.strip()
            continue
        original, copy = json.loads(source.read_text(encoding="utf-8")), json.loads(text)
        others = [
            "".join(cell["source"])
            for cell in original["cells"]
            if f"lang-{LANGUAGES[language]}" in cell["metadata"].get("tags", [])
        ]
        assert others and not [cell for cell in copy["cells"] if "".join(cell["source"]) in others]
        assert any(cell.get("outputs") for cell in copy["cells"])
        assert "application/vnd.jupyter.widget-view+json" not in text
        assert not any("book" in cell["metadata"] for cell in copy["cells"])
        assert "{cite}" not in text
        if "welch2006" in source.read_text(encoding="utf-8"):
            assert {"id": "Welch dan Bishop, 2006", "en": "Welch and Bishop, 2006"}[
                language
            ] in text
        assert "kalman_lib" in "".join(copy["cells"][1]["source"])  # says what it needs to run
    assert checked >= 3


@pytest.mark.parametrize("name", ["id/filter-kalman", "en/kalman-filter"])
def test_the_zip_holds_what_is_needed_to_run_the_chapters(name, site):
    with zipfile.ZipFile(site / f"{name}.zip") as archive:
        names = {
            Path(entry).relative_to(Path(name).name).as_posix() for entry in archive.namelist()
        }
    wanted = {path.relative_to(ROOT).as_posix() for path in (ROOT / "notebooks").glob("*.ipynb")}
    wanted |= {path.relative_to(ROOT).as_posix() for path in (ROOT / "kalman_lib").rglob("*.py")}
    assert wanted | {"requirements.txt", "requirements.lock", "pyproject.toml"} <= names


@pytest.mark.parametrize("width", [1280, 390, 320])
def test_the_menu_of_downloads(width, server, chromium):
    page = chromium.new_page(viewport={"width": width, "height": 700})
    page.goto(f"{server}/id/notebooks/01_theory.html")
    button, menu = page.locator("button.dropdown-toggle"), page.locator(".dropdown-menu")
    assert not menu.is_visible() and button.get_attribute("aria-expanded") == "false"
    button.click()
    assert button.get_attribute("aria-expanded") == "true"
    box = menu.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= width
    page.mouse.click(width / 2, 650)
    assert not menu.is_visible()
    button.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.matches('.dropdown-menu a[href$=ipynb]')")
    page.keyboard.press("Escape")
    assert not menu.is_visible() and page.evaluate(
        "document.activeElement.matches('button.dropdown-toggle[aria-expanded=false]')"
    )
    page.close()


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_page_is_called_twice_or_not_at_all(language, site):
    for path in sorted((site / language).rglob("*.html")):
        text = path.read_text(encoding="utf-8")
        if path.parent.name in ("slides", "embed") or path.name == "index.html":
            continue  # the last one leads to the first page
        parts = re.search(r"<title>(.+?)</title>", text)[1].split(" &#8212; ")
        assert len(set(parts)) == len(parts), path
        assert re.search(r'<meta property="og:title" content="[^"]+">', text), path
