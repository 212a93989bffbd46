"""On paper stands what the reader has set: figures in light colours and as wide as the paper, the
outcome, the settings in words. The default picture is printed only where there is no script."""

import pytest
from conftest import listen
from explorer_helpers import live, pages_with_explorers, set_state

WIDE = {"width": 1280, "height": 900}
PAPER = 642  # pixels between the margins of A4, 20 mm each
# A number for what a canvas shows, how many of its points are painted, how sharp it is
PICTURES = """e => [...e.querySelectorAll('.explorer-paper canvas')].map(canvas => {
  const { width, height } = canvas;
  const data = canvas.getContext('2d').getImageData(0, 0, width, height).data;
  let sum = 7, inked = 0;
  for (let i = 0; i < data.length; i += 4) {
    sum = (sum * 31 + data[i] + 3 * data[i + 1] + 5 * data[i + 2] + 7 * data[i + 3]) | 0;
    inked += data[i + 3] > 200;
  }
  return { sum, inked, ratio: width / canvas.clientWidth };
})"""


@pytest.fixture
def printed(site, server, chromium):
    """open(path, **options) -> a page of the book that can be printed, and what went wrong."""
    contexts = []

    def open_page(name, **options):
        options = {"viewport": WIDE, "reduced_motion": "reduce", **options}
        contexts.append(chromium.new_context(service_workers="block", **options))
        page = contexts[-1].new_page()
        trouble = listen(page)
        page.goto(f"{server}/{name}")
        page.evaluate("document.fonts.ready.then(() => true)")
        return page, trouble

    yield open_page
    for context in contexts:
        context.close()


def preview(page):
    """As a browser does before it prints."""
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")


def end(page):
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")


def paper(element):
    """(what is printed in words, its pictures)"""
    sheet = element.locator(".explorer-paper")
    assert sheet.is_visible() and not element.locator("> img").is_visible()
    assert not element.locator("> .explorer").is_visible()
    return sheet.locator("> p").all_inner_texts(), element.evaluate(PICTURES)


def test_the_state_of_the_reader_is_printed(printed):
    page, trouble = printed("en/notebooks/03_gyro.html")
    element = page.locator("kalman-explorer[paper=gyro]:not([view])")
    preview(page)
    _, before = paper(element)
    end(page)
    assert element.locator(".explorer-paper").count() == 0
    set_state(element, sigma_w=7.5, seed=4)
    preview(page)
    (outcome, settings), after = paper(element)
    assert outcome == element.locator(".explorer-outcome").text_content()
    assert "σw" in settings and "= 7.5 " in settings and settings.endswith("noise number 4")
    assert len(after) == len(before) and after[0]["sum"] != before[0]["sum"]
    assert all(picture["inked"] > 1000 for picture in after)
    box = element.locator(".explorer-paper").bounding_box()
    assert 0.9 * PAPER < box["width"] <= PAPER
    assert trouble == []


def test_colours_are_light_a_dark_page_prints_what_a_light_one_prints(printed):
    found = []
    for scheme in ("light", "dark"):
        page, _ = printed("id/notebooks/01_theory.html", color_scheme=scheme)
        element = page.locator("kalman-explorer[view=bells]")
        set_state(element, b=27.5)
        preview(page)
        found.append(paper(element))
    assert found[0] == found[1]
    assert "27,5 cm" in found[0][0][1]


def test_settings_of_a_group_that_is_closed_are_told(printed):
    page, _ = printed("en/notebooks/07_workshop.html")
    element = page.locator("kalman-explorer[paper=workshop]")
    preview(page)
    settings = paper(element)[0][1]
    for name in ("R (noise variance of the sensor) = 9", "q (process noise", "outliers"):
        assert name in settings, settings
    assert "measurement matrix" not in settings  # of a pattern that was not chosen


def test_every_explorer_prints_its_figures_and_words(site, printed):
    for language in ("id", "en"):
        for path in pages_with_explorers(site, language):
            page, trouble = printed(
                path.relative_to(site).as_posix(), viewport={**WIDE, "width": 390}
            )
            preview(page)
            for element in live(page):
                name = path.name, element.get_attribute("view")
                words, pictures = paper(element)
                shown = element.locator("> .explorer .explorer-plot:not([hidden])").count()
                assert len(pictures) == shown > 0, name
                assert all(picture["inked"] > 500 for picture in pictures), (name, pictures)
                assert all(picture["ratio"] >= 2 for picture in pictures), name  # sharp on paper
                assert len(words) == 2 and "undefined" not in " ".join(words), (name, words)
                assert words[1].startswith({"id": "Setelan: ", "en": "Settings: "}[language]), name
            assert trouble == [], path


def test_the_printer_of_the_browser_finds_it_laid_out(printed):
    """The real way to paper: what beforeprint has done when the document is printed."""
    page, trouble = printed("en/notebooks/01_theory.html")
    page.evaluate("""() => {
      window.laid = [];
      addEventListener('beforeprint', () =>
        laid.push(document.querySelectorAll('kalman-explorer.live.on-paper').length));
    }""")
    assert len(page.pdf()) > 10_000
    assert page.evaluate("laid") == [len(live(page))]
    assert page.locator(".explorer-paper").count() == 0  # and the page is as it was
    assert trouble == []


def test_a_print_from_a_script_that_only_changes_the_medium(printed):
    page, _ = printed("en/notebooks/03_gyro.html")
    element = page.locator("kalman-explorer[view=drift]")
    set_state(element, sensor=True)
    page.emulate_media(media="print")
    element.locator(".explorer-paper").wait_for()
    assert "yes" in paper(element)[0][1]
    page.emulate_media(media="screen")
    page.wait_for_function("!document.querySelector('.explorer-paper')")


def test_code_that_opens_for_paper_is_there_at_once(printed):
    """On a phone it is folded; the theme fades in what opens, and paper shows the first moment."""
    page, _ = printed(
        "en/notebooks/03_gyro.html",
        viewport={"width": 390, "height": 844},
        reduced_motion="no-preference",
    )
    preview(page)
    code = page.locator("details.fold[open] > div").first
    assert code.is_visible() and code.evaluate("e => e.getAnimations().length") == 0
    assert code.evaluate("e => getComputedStyle(e).opacity") == "1"


def test_without_a_script_the_picture_is_printed(printed):
    page, _ = printed("en/notebooks/03_gyro.html", java_script_enabled=False)
    page.emulate_media(media="print")
    assert page.locator("kalman-explorer > img").first.is_visible()
