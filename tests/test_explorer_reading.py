"""What a reader has before him: what is to be watched, and what there is to say about it.

Every explorer of the built book, in the windows of phones and laptops; none is listed here.
"""

import pytest
from explorer_helpers import PHONE, explorer_of, explorers, paste, shown

LARGE_TEXT = "html { font-size: %d%% !important; }"
WINDOWS = {  # a phone, one between the bars of its browser, a small one, one lying on its side
    "phone": PHONE,
    "bars": {"width": 390, "height": 664},
    "small": {"width": 360, "height": 560},
    "landscape": {"width": 844, "height": 390},
}
LAPTOP = {"width": 1440, "height": 900}
STICKY = 0.4  # of the window's area is the most that may stay in sight


def settled(element):
    """The explorer has followed its window."""
    element.evaluate("e => { void e.offsetWidth; return new Promise(requestAnimationFrame); }")
    shown(element)


def sliders(element):
    return element.locator("input[type=range]:visible:not(:disabled)").all()


# --- what stays in sight ------------------------------------------------------------------------


@pytest.mark.parametrize("window", WINDOWS)
def test_the_first_figure_stays_in_sight_and_leaves_room(window, site, opened):
    for name, _, _, element in explorers(site, opened, viewport=WINDOWS[window]):
        settled(element)
        found = element.evaluate("""e => {
          const figures = e.querySelector('.explorer-figures.first');
          const { width, height } = figures.getBoundingClientRect();
          const canvases = [...figures.querySelectorAll('canvas')];
          return { position: getComputedStyle(figures).position,
            highest: Math.max(...canvases.map(canvas => canvas.clientHeight)),
            share: width * height / innerWidth / innerHeight };
        }""")
        assert found["position"] == "sticky", name
        assert found["share"] <= STICKY + 0.01, name
        assert found["highest"] >= 95, name  # lower than that a figure tells nothing


@pytest.mark.parametrize("window", ["phone", "landscape"])
def test_a_slider_does_not_move_under_the_finger(window, site, opened):
    for name, _, _, element in explorers(site, opened, viewport=WINDOWS[window]):
        for slider in sliders(element):
            shift = slider.evaluate(
                """async (slider, e) => {
              const frame = () => new Promise(done => requestAnimationFrame(done));
              const top = () => slider.getBoundingClientRect().top;
              slider.scrollIntoView({ block: 'center', behavior: 'instant' });
              slider.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
              await frame();
              const [low, high] = [Number(slider.min), Number(slider.max)], before = top();
              const shifts = [];
              for (let i = 0; i <= 8; i++) {
                slider.value = low + (high - low) * i / 8;
                slider.dispatchEvent(new Event('input', { bubbles: true }));
                await frame();
                e.explorer.words(true);
                await frame();
                shifts.push(Math.abs(top() - before));
              }
              return Math.max(...shifts);
            }""",
                element.element_handle(),
            )
            assert shift < 1, (name, slider.get_attribute("id"))
            element.evaluate("e => e.explorer.reset()")
            shown(element)


def test_on_a_laptop_figure_and_sliders_stand_beside_each_other(site, opened):
    for name, page, _, element in explorers(site, opened, viewport=LAPTOP):
        settled(element)
        found = element.evaluate("""e => {
          const box = part => part.getBoundingClientRect();
          const figures = e.querySelector('.explorer-figures.first');
          return { width: box(e).width, right: box(e).right,
            beside: box(e.querySelector('.explorer-side')).left >= box(figures).right,
            sticky: getComputedStyle(figures).position, column: e.parentElement.clientWidth };
        }""")
        assert found["width"] == pytest.approx(985, abs=15) and found["width"] > found["column"]
        assert found["beside"] and found["sticky"] == "sticky", name
        assert found["right"] <= LAPTOP["width"] - 10
        for slider in sliders(element):
            assert slider.bounding_box()["width"] >= 180, name
        element.scroll_into_view_if_needed()
        assert page.evaluate("document.documentElement.scrollWidth") <= LAPTOP["width"], name


def test_the_contents_of_the_page_step_aside_while_an_explorer_passes(site, opened):
    page, _, element = explorer_of("gyro", site, opened, viewport=LAPTOP)
    contents = page.locator(".bd-sidebar-secondary nav.page-toc")
    page.evaluate("scrollTo({ top: 0, behavior: 'instant' })")
    contents.wait_for(state="visible")
    element.evaluate("e => e.scrollIntoView({ block: 'start', behavior: 'instant' })")
    contents.wait_for(state="hidden")


# --- large text ---------------------------------------------------------------------------------


@pytest.mark.parametrize("percent", [150, 200])
def test_large_text_leaves_sliders_and_header_usable(percent, site, opened):
    for name, page, _, element in explorers(
        site, opened, extra_http_headers={"X-Text": str(percent)}
    ):
        if not page.evaluate("document.documentElement.dataset.large"):
            page.add_style_tag(content=LARGE_TEXT % percent)
            page.evaluate("document.documentElement.dataset.large = 'yes'")
        settled(element)
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"], name
        for slider in sliders(element):
            assert slider.bounding_box()["width"] >= 120, name
        share = element.evaluate("""e => {
          const figures = e.querySelector('.explorer-figures.first.stays');
          return figures ? figures.getBoundingClientRect().height / innerHeight : 0;
        }""")
        assert share <= STICKY + 0.01, name
        sizes = element.evaluate("e => e.explorer.plots.map(plot => plot.text)")
        assert max(size or 0 for size in sizes) == pytest.approx(percent / 100), name


# --- messages -----------------------------------------------------------------------------------

BESIDE = """e => {
  const message = e.querySelector('.explorer-message'), box = message.getBoundingClientRect();
  const field = e.explorer.touching.getBoundingClientRect();
  return { gap: box.top - field.bottom, seen: box.top >= 0 && box.bottom <= innerHeight,
    text: message.textContent };
}"""


def test_a_value_out_of_range_is_answered_beside_its_field(site, opened):
    for name, _, _, element in explorers(site, opened):
        for field in element.locator(".explorer-control.slider .explorer-value:visible").all():
            if field.is_disabled():
                continue
            before = field.input_value()
            field.fill("99999999")
            field.press("Enter")
            message = element.locator(".explorer-message")
            if message.is_hidden():  # it is in the range
                element.evaluate("e => e.explorer.reset()")
                shown(element)
                continue
            found = element.evaluate(BESIDE)
            assert "yang diterima" in found["text"], name
            assert -1 <= found["gap"] < 40 and found["seen"], (name, found)
            assert field.get_attribute("aria-invalid") == "true"
            assert field.get_attribute("aria-describedby") == message.get_attribute("id")
            assert field.input_value() == "99999999"
            field.fill(before)
            assert message.is_hidden() and field.get_attribute("aria-invalid") is None, name
            assert field.get_attribute("aria-describedby") is None


def test_what_was_copied_is_said_beside_the_button(site, opened):
    for name, page, _, element in explorers(site, opened):
        button = element.locator(".explorer-buttons button", has_text="Salin tautan")
        if button.count() == 0:
            continue
        button.click()
        element.locator(".explorer-message").wait_for()
        found = element.evaluate(BESIDE)
        assert -1 <= found["gap"] < 40 and found["seen"], (name, found)
        assert element.locator("[aria-invalid]").count() == 0, name
        page.evaluate("history.replaceState(null, '', location.pathname)")


def test_unreadable_text_is_answered_below_it(site, opened):
    page, _ = opened(site / "id" / "notebooks" / "02_smoother.html")
    element = page.locator("kalman-explorer:not([view])").first
    paste(element, "1,2\nbukan\n1,3")
    message = element.locator(".explorer-message")
    message.wait_for()
    box = element.locator("textarea")
    assert box.get_attribute("aria-invalid") == "true"
    assert box.get_attribute("aria-describedby") == message.get_attribute("id")
    edge, text = box.bounding_box(), message.bounding_box()
    assert 0 <= text["y"] - (edge["y"] + edge["height"]) < 40
    paste(element, "1,2\n1,3")
    assert message.is_hidden() and box.get_attribute("aria-invalid") is None
