"""Slides of every chapter: there in both languages, whole, alive, and without another host."""

import sys

import pytest
from bs4 import BeautifulSoup
from conftest import ROOT
from site_helpers import note_trouble

sys.path.insert(0, str(ROOT / "book" / "_make"))

import slides

CHAPTER = "03_gyro"
BEAMER = {"width": 1280, "height": 720}
NAMES = [chapter.rpartition("/")[2] for chapter in slides.chapters()]
LARGEST = 0.95  # of the size of the page of the chapter
TITLES = {"id": "Salindia", "en": "Slides"}
READY = "document.documentElement.classList.contains('ready')"
EXPLORER = "e.closest('kalman-explorer').explorer"
INDICES = "() => { const { h, v } = Reveal.getIndices(); return [h, v]; }"
ALL = """() => [...document.querySelectorAll('section.part-slide')].map(slide => {
  const { h, v } = Reveal.getIndices(slide);
  return [h, v];
})"""
# What of the slide that is shown lies outside it, or can only be reached by scrolling
OUTSIDE = """() => {
  const slide = Reveal.getCurrentSlide();
  const frame = slide.getBoundingClientRect();
  const isOutside = element => {
    const box = element.getBoundingClientRect();
    const out = Math.max(frame.left - box.left, frame.top - box.top, box.right - frame.right,
      box.bottom - frame.bottom);
    return box.width > 0 && box.height > 0 && out > 1;
  };
  const scrolls = element => element.scrollHeight > element.clientHeight + 1
    || element.scrollWidth > element.clientWidth + 1;
  const parts = [...slide.querySelectorAll('*')].filter(element =>
    !element.closest('.katex-mathml, .katex svg, .explorer-live'));
  const boxes = slide.querySelectorAll('.slide-body, pre, .katex-display, .cell_output, ' +
    '.pst-scrollable-table-container');
  return [...parts.filter(isOutside), ...[...boxes].filter(scrolls)]
    .map(element => `${element.tagName} ${element.className}`);
}"""


@pytest.fixture(scope="module")
def deck(server, chromium):
    """The slides of one chapter as a beamer shows them -> (page, what went wrong)."""
    context = chromium.new_context(
        viewport=BEAMER, reduced_motion="reduce", service_workers="block"
    )
    page = context.new_page()
    trouble = note_trouble(page, server)
    page.goto(f"{server}/en/slides/{CHAPTER}.html")
    page.wait_for_function(READY)
    yield page, trouble
    context.close()


def parsed(path):
    return BeautifulSoup(path.read_text(encoding="utf-8"), "html.parser")


def text_of(part):
    """Without the mark of a link, and blanks."""
    for mark in part.select("a.headerlink"):
        mark.decompose()
    return " ".join(part.get_text().split())


# --- the files ----------------------------------------------------------------------------------


@pytest.mark.parametrize("language", ["id", "en"])
@pytest.mark.parametrize("name", NAMES)
def test_every_chapter_has_slides_with_all_its_sections(name, language, site):
    page = site / language / "notebooks" / f"{name}.html"
    made = site / language / "slides" / f"{name}.html"
    chapter, shown = parsed(page), parsed(made)
    assert chapter.select_one(f'.edition a[href="../slides/{name}.html"]').text == TITLES[language]
    article = chapter.find("article")
    assert text_of(shown.find("h1")) == text_of(article.find("h1"))
    assert [*map(text_of, shown.find_all("h2"))] == [*map(text_of, article.find_all("h2"))]
    for kind in ("kalman-explorer", ".exercise-worked, .slide-solution", ".katex-display"):
        without = [part for part in article.select(kind) if not part.find_parent(hidden=True)]
        assert len(shown.select(kind)) == len(without), kind
    assert made.stat().st_size < LARGEST * page.stat().st_size


@pytest.mark.parametrize("language", ["id", "en"])
def test_deeper_pages_have_no_slides(language, site):
    assert sorted(path.stem for path in (site / language / "slides").iterdir()) == NAMES
    for page in (site / language / "notebooks").glob("*_deeper.html"):
        assert parsed(page).select_one('.edition a[href*="slides"]') is None, page


@pytest.mark.parametrize("language", ["id", "en"])
def test_what_slides_load_is_kept_for_reading_without_a_network(language, site):
    worker = (site / language / "offline-worker.js").read_text(encoding="utf-8")
    loaded = [f"{slides.PLACE}/{name}" for name in ("reveal.js", "slides.js", "slides.css")]
    for name in [*loaded, *(f"slides/{name}.html" for name in NAMES)]:
        assert f'"{name}"' in worker and (site / language / name).exists(), name


def test_an_exercise_is_a_question_and_its_solution():
    exercise = """<p id="exercise-1-1">Which?</p><div class="exercise"><form>
      <fieldset class="exercise-choices"><label><input type="radio"><span
      class="exercise-letter">a.</span><span>this</span></label></fieldset><button>Check</button>
      </form><div class="exercise-hints">A hint</div><details class="exercise-solution">
      <summary>Solution</summary><div class="exercise-worked"><p>Because.</p></div>
      </details></div>"""
    page = f"<head></head><article><section><h1>T</h1><section><h2>S</h2>{exercise}</section>"
    shown = BeautifulSoup(slides.slides_of(page, "en", "01_theory"), "html.parser")
    part = shown.select("section.part")[-1]
    assert [text_of(child) for child in part.find_all(recursive=False)] == [
        "S",
        "Which?",
        "a. this",
        "SolutionBecause.",
    ]
    assert part.select_one("p")["data-slide"] == "new"
    assert part.select_one(".slide-solution")["data-slide"] == "last"
    assert not shown.select("form, input, button") and "A hint" not in shown.text


# --- in a browser -------------------------------------------------------------------------------


def test_nothing_is_cut_off_and_no_request_leaves(deck):
    page, trouble = deck
    places = page.evaluate(ALL)
    assert len(places) > 30 and max(v for _, v in places) >= 3
    cut = {}
    for h, v in places:
        page.evaluate("([h, v]) => Reveal.slide(h, v, 99)", [h, v])
        if found := page.evaluate(OUTSIDE):
            cut[h, v] = found
    assert cut == {}
    assert trouble == []


def test_arrows_go_on(deck):
    page, _ = deck
    page.evaluate("Reveal.slide(3, 0)")
    seen = []
    for key in ("ArrowDown", "Space", "ArrowUp", "ArrowLeft", "ArrowLeft", "ArrowRight"):
        page.keyboard.press(key)
        seen.append(page.evaluate(INDICES))
    assert seen[:3] == [[3, 1], [3, 2], [3, 1]]
    assert [h for h, _ in seen[3:]] == [2, 1, 2]  # a section opens where it was left
    page.wait_for_function("location.hash.startsWith('#/2')")


def test_a_solution_comes_one_step_after_its_question(deck):
    page, _ = deck
    slide = page.locator("section.part-slide:has(> .slide-body > .slide-solution.fragment)").first
    h, v = slide.evaluate("e => { const { h, v } = Reveal.getIndices(e); return [h, v]; }")
    page.evaluate("([h, v]) => Reveal.slide(h, v, -1)", [h, v])
    solution = slide.locator(".slide-solution")
    assert not solution.is_visible()
    page.keyboard.press("Space")
    assert solution.is_visible() and page.evaluate(INDICES) == [h, v]


def test_an_explorer_follows_its_slider_and_the_keys_stay_with_it(deck):
    page, _ = deck
    explorer = page.locator("kalman-explorer").first
    h, v = explorer.evaluate(
        "e => { const { h, v } = Reveal.getIndices(e.closest('section.part-slide'));"
        " Reveal.slide(h, v); return [h, v]; }"
    )
    slider, outcome = explorer.locator("input[type=range]").first, ".explorer-outcome"
    before = explorer.locator(outcome).inner_text()
    slider.focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    page.wait_for_function(
        "([e, before]) => e.querySelector('.explorer-outcome').textContent !== before",
        arg=[explorer.element_handle(), before],
    )
    assert page.evaluate(INDICES) == [h, v]
    slider.blur()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(INDICES)[0] == h + 1


@pytest.mark.parametrize("width", [640, 1920])
def test_a_pointer_meets_what_it_points_at_in_every_window(width, server, chromium):
    """A slide is shown smaller or larger than it is laid out; an address opens its explorer."""
    window = {"width": width, "height": width * 9 // 16}
    page = chromium.new_page(viewport=window, reduced_motion="reduce", service_workers="block")
    page.goto(f"{server}/en/slides/{CHAPTER}.html#gyro.mismatch:times_w=2")
    page.wait_for_function(READY)
    canvas = page.locator(".part-slide.present canvas.draggable").first
    assert canvas.evaluate(f"e => {EXPLORER}.s.times_w") == 2
    page.wait_for_function(f"e => {EXPLORER}.plots[0].x_of", arg=canvas.element_handle())
    box = canvas.bounding_box()
    page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 0.4 * box["height"])
    believed, meant = canvas.evaluate(f"""e => {{
      const {{ s, plots: [plot] }} = {EXPLORER};
      const meant = [plot.x_of(0.8 * e.clientWidth), plot.y_of(0.4 * e.clientHeight)];
      return [[s.times_w * s.sigma_w, s.times_v * s.sigma_v], meant];
    }}""")
    assert believed == pytest.approx(meant, rel=0.05)
    page.close()
