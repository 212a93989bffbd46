"""What the walk over all pages (test_site.py) does not see: the frame of a page on a laptop and in
the dark, the pages without a language, the way of a keyboard through a page."""

import pytest
from site_helpers import PHONE, SIMPLIFY, WIDE, violations

PAGES = ("id/notebooks/06_quadrotor_deeper.html", "en/search.html")
PLAIN = ("404.html", "unkept.html", "index.html#choose")
FOCUS = """() => {
  const element = document.activeElement;
  const parts = [element, element.firstElementChild].filter(Boolean);
  const isDrawn = ({ outlineStyle, outlineWidth }) =>
    outlineStyle !== 'none' && parseFloat(outlineWidth) >= 3;
  return {
    name: element.outerHTML.slice(0, 120),
    isPage: element === document.body,
    isMarked: parts.some(part => isDrawn(getComputedStyle(part))),
  };
}"""


@pytest.fixture
def page(chromium):
    context = chromium.new_context(reduced_motion="reduce", service_workers="block")
    yield context.new_page()
    context.close()


@pytest.mark.parametrize(("size", "theme"), [(PHONE, "dark"), (WIDE, "light"), (WIDE, "dark")])
def test_axe_finds_nothing_in_the_frame_either(size, theme, server, page):
    for name in PAGES:
        page.goto(f"{server}/{name}")
        page.evaluate(SIMPLIFY)
        assert violations(page, size, theme) == [], name


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_nothing_on_the_pages_without_a_language(theme, server, page):
    page.emulate_media(color_scheme=theme)
    for name in PLAIN:
        page.goto(f"{server}/{name}")
        for size in (PHONE, WIDE):
            assert violations(page, size, theme) == [], name


@pytest.mark.parametrize("size", [PHONE, WIDE])
@pytest.mark.parametrize("name", ["notebooks/04_ship.html", "search.html"])
def test_the_keyboard_sees_where_it_is(name, size, server, page):
    page.set_viewport_size(size)
    page.goto(f"{server}/id/{name}")
    seen = []
    while True:
        page.keyboard.press("Tab")
        focus = page.evaluate(FOCUS)
        if focus["isPage"] or len(seen) > 300:
            break
        assert focus["isMarked"], focus["name"]
        seen.append(focus["name"])
    assert 5 < len(seen) <= 300


@pytest.mark.parametrize("name", ["notebooks/01_theory.html", "search.html"])
def test_the_skip_link_passes_the_toolbar(name, server, page):
    page.set_viewport_size(WIDE)
    page.goto(f"{server}/en/{name}")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent.trim()") == "Skip to main content"
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.closest('#text') !== null")


def test_every_skip_link_leads_to_the_content(site):
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        if 'class="skip-link' in text:
            assert 'class="skip-link d-print-none"><a href="#text"' in text, path
            assert text.count(' id="text"') == 1, path


def test_one_viewport_a_page(site):
    for path in site.rglob("*.html"):
        assert path.read_text(encoding="utf-8").count('name="viewport"') == 1, path
