"""Reading the built book on a phone: long code is folded, the search opens the right section."""

import pytest
from site_helpers import LANGUAGES, PHONE

from kalman_lib.plots.figure import WIDTH
from kalman_lib.plots.styles import STYLE

LONG = 6  # lines of code that a phone shows


@pytest.fixture(scope="module")
def phone(chromium):
    context = chromium.new_context(viewport=PHONE, reduced_motion="reduce", service_workers="block")
    yield context
    context.close()


# --- code ---------------------------------------------------------------------------------------

CODE = """() => [...document.querySelectorAll('.cell:not(.tag_open-code) > * div.cell_input, ' +
  '.cell:not(.tag_open-code) > div.cell_input')].map(input => {
  const fold = input.closest('details');
  const lines = input.querySelector('pre').textContent.trim().split('\\n').length;
  return { lines, folded: fold !== null,
    open: fold === null || fold.open, exercise: input.closest('.exercise') !== null,
    bar: fold?.querySelector('summary').getBoundingClientRect().height ?? 0,
    costs: fold && !fold.open ? fold.offsetHeight : 0,
    width: input.scrollWidth - input.clientWidth };
})"""


@pytest.mark.parametrize("language", LANGUAGES)
def test_long_code_is_a_slim_bar_on_a_phone_and_open_on_a_laptop(language, site, server, phone):
    page = phone.new_page()
    for path in sorted((site / language / "notebooks").glob("*.html")):
        page.set_viewport_size(PHONE)
        page.goto(f"{server}/{language}/notebooks/{path.name}")
        for code in page.evaluate(CODE):
            assert code["open"] == (code["lines"] <= LONG and not code["folded"]), path.name
            assert code["bar"] <= 48 and code["costs"] <= 48, path.name
        assert page.locator(".tag_open-code details").count() == 0, path.name
        shut = page.evaluate(CODE)
        page.set_viewport_size({"width": 1200, "height": 900})
        page.wait_for_function("[...document.querySelectorAll('details.fold')].every(e => e.open)")
        wide = page.evaluate(CODE)
        assert sum(code["open"] for code in wide) >= sum(code["open"] for code in shut)
        assert all(code["width"] <= 1 for code in wide if code["open"]), path.name
    page.close()


def test_a_bar_opens_and_paper_shows_the_code(server, phone):
    page = phone.new_page()
    page.goto(f"{server}/en/notebooks/03_gyro.html")
    fold = page.locator("details.fold").first
    fold.locator("summary").click()
    fold.locator("pre").wait_for()
    fold.locator("summary").click()
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.locator("details.fold:not([open])").count() == 0
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert page.locator("details.fold[open]").count() == 0
    page.close()


def test_without_a_script_code_is_open(server, chromium):
    page = chromium.new_page(viewport=PHONE, java_script_enabled=False)
    page.goto(f"{server}/en/notebooks/03_gyro.html")
    assert page.locator("div.cell_input:not(details *) pre").first.is_visible()
    page.close()


# --- figures ------------------------------------------------------------------------------------


def test_the_numbers_of_a_figure_are_12_pixels_high_on_a_phone(site, server, phone):
    smallest = min(STYLE[name] for name in STYLE if name.endswith("size") and name != "font.size")
    page, seen = phone.new_page(), 0
    for path in sorted((site / "id" / "notebooks").glob("*.html")):
        page.goto(f"{server}/id/notebooks/{path.name}")
        widths = page.locator(".cell_output figure > a > img, figure > a > img").evaluate_all(
            "images => images.map(image => image.getBoundingClientRect().width)"
        )
        seen += len(widths)
        for width in widths:
            assert smallest / 72 * width / WIDTH >= 12, (path.name, width)
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"], path.name
    assert seen > 10
    page.close()


# --- equations ----------------------------------------------------------------------------------


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_table_leaves_room_for_its_equations(language, site, server, phone):
    page, seen = phone.new_page(), 0
    for path in sorted((site / language).glob("*/*.html")):
        page.goto(f"{server}/{path.relative_to(site).as_posix()}")
        spills = page.locator(":is(td, th) > p > .together").evaluate_all("""pieces => pieces.map(
          piece => piece.getBoundingClientRect().right -
            piece.parentElement.getBoundingClientRect().right)""")
        seen += len(spills)
        assert max(spills, default=0) <= 1, path.name
    assert seen > 100
    page.close()


# --- search -------------------------------------------------------------------------------------

ASKED = {  # query: what the first entry leads to
    ("id", "kovarians"): "book/bekal.html#covariance",
    ("en", "covariance"): "book/bekal.html#covariance",
    ("en", "Jacobian"): "book/bekal.html#jacobian",
    ("id", "RTS"): "notebooks/02_smoother",
    ("en", "RTS"): "notebooks/02_smoother",
}


def results(page, base, language, query):
    """[(address, title, excerpt), ...] as the search page lists them."""
    page.goto(f"{base}/{language}/search.html?q={query}")
    page.locator("#search-results ul.search li").first.wait_for()
    return page.locator("#search-results ul.search li").evaluate_all(
        """found => found.map(item => [item.querySelector('a').getAttribute('href'),
          item.querySelector('a').textContent, item.querySelector('p.context').textContent])"""
    )


@pytest.mark.parametrize("scheme", ["http", "file"])
@pytest.mark.parametrize("asked", ASKED)
def test_the_search_finds_the_section_that_answers(scheme, asked, bases, phone):
    page = phone.new_page()
    found = results(page, bases[scheme], *asked)
    assert found[0][0].startswith(ASKED[asked]), found[:4]
    for address, _, excerpt in found:
        assert "import " not in excerpt, (address, excerpt)
        assert len(excerpt) < 300
    page.close()


def test_a_result_opens_at_its_section(bases, phone):
    page = phone.new_page()
    (address, title, _), *_ = results(page, bases["http"], "en", "covariance")
    page.locator("#search-results ul.search li a").first.click()
    page.wait_for_function("location.hash !== ''")
    anchor = address.split("#")[1]
    heading = page.locator(f"#{anchor}").locator("h2, h3, h4").first
    assert heading.inner_text().split("#")[0].strip() in title
    page.wait_for_function(
        "id => { const top = document.getElementById(id).getBoundingClientRect().top;"
        " return top > -5 && top < 200; }",
        arg=anchor,
    )
    page.close()


def test_what_an_exercise_hides_is_not_found(bases, phone):
    page = phone.new_page()
    page.goto(f"{bases['http']}/en/search.html?q=hundredfold")
    page.locator("#search-results .search-summary:not(:empty)").wait_for()
    shown = page.locator("#search-results li").all_inner_texts()
    assert not [text for text in shown if "Solution" in text]
    page.close()


def test_nothing_shows_beside_the_header_of_a_phone(site, server, phone):
    """Figures are as wide as the window, the header is not: its own colour goes on beside it."""
    page = phone.new_page()
    page.set_viewport_size(PHONE)
    page.goto(f"{server}/id/notebooks/07_workshop.html")
    page.evaluate("window.scrollTo({ top: 3000, behavior: 'instant' })")
    page.wait_for_function("document.querySelector('.scrolled .bd-header-article')")
    sides = page.evaluate("""() => {
      const header = document.querySelector('.bd-header-article');
      const { backgroundColor, boxShadow } = getComputedStyle(header);
      const { left, right } = header.getBoundingClientRect();
      return { shadow: boxShadow, colour: backgroundColor, left, right };
    }""")
    assert (sides["left"], sides["right"]) == (16, PHONE["width"] - 16)
    wanted = [f"{sides['colour']} {x}px 0px 0px 0px" for x in (-16, 16)]
    assert sides["shadow"] == ", ".join(wanted)
    page.close()
