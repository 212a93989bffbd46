"""A wide window shows more around the text than a phone: for screen readers and keyboards, too."""

import pytest
from site_helpers import AXE

PAGES = (
    "book/intro.html",
    "book/glossary.html",
    "notebooks/03_gyro.html",
    "notebooks/06_quadrotor_deeper.html",
    "search.html",
)
# also the rules that axe-core leaves out by itself
AUDIT = """() => axe.run(document, { rules: { 'label-content-name-mismatch': { enabled: true } } })
  .then(({ violations }) => violations.map(({ id, nodes }) =>
    [id, nodes.slice(0, 3).map(node => node.target.join(' '))]))"""
SHORTEN = """() => document.querySelectorAll('.katex, .highlight').forEach(e => {
  e.textContent = 'x';  // thousands of parts: slow
})"""


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("language", ["id", "en"])
def test_axe_finds_nothing(language, theme, server, chromium):
    context = chromium.new_context(
        viewport={"width": 1280, "height": 900}, color_scheme=theme, service_workers="block"
    )
    page = context.new_page()
    for name in PAGES:
        page.goto(f"{server}/{language}/{name}")
        page.evaluate(SHORTEN)
        page.evaluate(AXE.read_text(encoding="utf-8"))
        assert page.evaluate(AUDIT) == [], (name, language, theme)
    context.close()


def test_the_skip_link_passes_the_toolbar(server, chromium):
    page = chromium.new_page(viewport={"width": 1280, "height": 900})
    page.goto(f"{server}/en/notebooks/01_theory.html")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent.trim()") == "Skip to main content"
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.closest('article') !== null")
    page.close()


def test_one_viewport_a_page(site):
    for path in site.rglob("*.html"):
        assert path.read_text(encoding="utf-8").count('name="viewport"') == 1, path
