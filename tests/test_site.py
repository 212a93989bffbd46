"""The built book in a real browser: every page, both languages, over http and from file://.

Pages are found in _build/site, none is listed here. One walk over all of them (the fixture `walk`)
collects what most tests then look at."""

import pytest
from site_helpers import LANGUAGES, PHONE, note_trouble, pages_of, twin, visit, weight
from weigh import CHAPTER, TEXT

# Texts of the chrome that are the same in both languages on purpose.
SAME_TEXT = {"Kalman", "Ctrl", "Model", "RMSE", "Jacobian", "Hessian"}
SAME_TEXT |= {"paper"}  # the name of a method in the code
SAME_TEXT |= {"1 Data"}  # of the workshop: the same word


@pytest.fixture(scope="module")
def walk(site, bases, chromium):
    """Every page, over http and file://: what went wrong, and (over http) what the page holds."""
    found = []
    for scheme, base in bases.items():
        context = chromium.new_context(
            viewport=PHONE, reduced_motion="reduce", service_workers="block", bypass_csp=False
        )
        page = context.new_page()
        trouble = note_trouble(page, base)
        for path in pages_of(site):
            name = path.relative_to(site).as_posix()
            entry = visit(page, path, scheme, f"{base}/{name}", trouble)
            found.append({"name": name, **entry})
        context.close()
    return found


@pytest.fixture(scope="module")
def pages(walk):
    """The pages with content, as seen over http, by name."""
    return {entry["name"]: entry for entry in walk if "chrome" in entry}


def test_every_page_is_there_in_both_languages(site, pages):
    names = {path.relative_to(site).as_posix() for path in pages_of(site)} - {"index.html"}
    assert len(names) >= 20
    assert {twin(name) for name in names} == names
    assert {name for name in pages if "/notebooks/" in name}, "no chapter was built"


def test_no_request_leaves_the_site_and_nothing_fails(walk):
    assert {
        (entry["scheme"], entry["name"]): entry["trouble"] for entry in walk if entry["trouble"]
    } == {}


def test_language_and_title(pages):
    for name, entry in pages.items():
        assert entry["lang"] == name.split("/")[0], name
        assert " | " not in entry["title"]
        assert entry["title"] != pages[twin(name)]["title"], name


def test_no_page_scrolls_sideways_on_a_phone(walk):
    assert {
        (entry["scheme"], entry["name"]): entry["width"]
        for entry in walk
        if entry.get("width", 0) > PHONE["width"]
    } == {}


def test_the_header_fits_a_narrow_phone(server, chromium, site):
    page = chromium.new_page()
    for language in LANGUAGES:
        for path in sorted((site / language / "notebooks").glob("*.html")):
            page.goto(f"{server}/{language}/notebooks/{path.name}")
            for width in (360, 320):
                page.set_viewport_size({"width": width, "height": 700})
                assert page.evaluate("document.documentElement.scrollWidth") <= width, (path, width)
    page.close()


def test_the_contents_of_a_page_close_when_a_section_is_chosen(server, chromium):
    page = chromium.new_page(viewport=PHONE)
    page.goto(f"{server}/id/notebooks/01_theory.html")
    page.locator(
        "button.secondary-toggle:visible, .sidebar-toggle.secondary-toggle:visible"
    ).first.click()
    dialog = page.locator("#pst-secondary-sidebar-modal")
    dialog.locator("a[href='#the-five-equations']").click()
    page.wait_for_function("!document.getElementById('pst-secondary-sidebar-modal').open")
    assert page.url.endswith("#the-five-equations")
    page.close()


def test_print_shows_the_page_and_no_chrome_even_from_the_dark_theme(server, chromium):
    page = chromium.new_page(color_scheme="dark")
    page.goto(f"{server}/id/notebooks/01_theory.html")
    assert (
        page.evaluate("getComputedStyle(document.querySelector('article figure img')).filter")
        != "none"
    )
    page.emulate_media(media="print")
    assert page.locator("article h1").first.is_visible()
    assert not page.locator(
        ".bd-header-article, .bd-sidebar-primary, .prev-next-footer"
    ).first.is_visible()
    assert (
        page.evaluate("getComputedStyle(document.querySelector('article figure img')).filter")
        == "none"
    )
    colours = page.evaluate(
        "[...new Set([...document.querySelectorAll('.highlight pre span')].map(s => "
        "getComputedStyle(s).color))]"
    )
    assert colours == ["rgb(0, 0, 0)"]
    folded = page.locator(
        "article details:not(.exercise details)"
    )  # solutions: a sheet of their own
    assert folded.count() > 2 and not folded.first.is_visible()  # closed: not printed
    page.evaluate(
        "document.querySelectorAll('details').forEach(details => { details.open = true })"
    )
    assert folded.first.is_visible()  # opened: printed
    page.close()


def test_every_image_has_an_alt_text_in_the_language_of_its_page(pages):
    for name, entry in pages.items():
        others = pages[twin(name)]["images"]
        assert len(others) == len(entry["images"]), name
        for image, other in zip(entry["images"], others):
            if image["decorative"]:
                continue
            assert (image["alt"] or "").strip() and "_images/" not in image["alt"], (name, image)
            assert image["alt"] != other["alt"], (name, image)


def test_a_slider_of_the_kernel_has_left_its_figure(site):
    """Without a kernel, a page would show what Python calls it: interactive(children=(...))."""
    pages = sorted(site.rglob("notebooks/*.html"))
    assert len(pages) > 12
    for path in pages:
        assert "interactive(children" not in path.read_text(encoding="utf-8"), path


def test_no_english_in_the_chrome_of_the_indonesian_pages(pages):
    english = {
        text for name, entry in pages.items() if name.startswith("en/") for text in entry["chrome"]
    }
    left = {
        text: name
        for name, entry in pages.items()
        if name.startswith("id/")
        for text in entry["chrome"]
        if text in english and text not in SAME_TEXT
    }
    assert len(english) > 20
    assert left == {}


def test_axe_finds_nothing_on_a_phone_and_on_a_laptop(pages):
    found = {
        (name, view): violations
        for name, entry in pages.items()
        for view, violations in entry["axe"].items()
        if violations
    }
    assert len(pages) > 50 and found == {}


def test_headings_tables_and_equations_can_be_read_aloud(pages):
    assert {name: entry["order"] for name, entry in pages.items() if entry["order"]} == {}


def test_every_page_is_light(pages, site, server):
    """What test_light.py measures on the way, here by the files that each page asks for."""
    heavy = {}
    for name, entry in pages.items():
        size = weight(site, server, entry["fetched"])
        is_text = "/book/" in name  # a search needs its index, slides and chapters their explorers
        if not 40_000 < size <= (TEXT if is_text else CHAPTER):
            heavy[name] = size
    assert heavy == {}
