"""The figures of the explorers are painted by a second thread, and look the same without it."""

import pytest
from explorer_helpers import PICTURE, explorer_of, pages_with_explorers, picture, shown


@pytest.mark.parametrize("scheme", ["http", "file"])
def test_the_picture_is_the_same_without_a_second_thread(scheme, site, server, chromium):
    base, drawn = {"http": server, "file": site.as_uri()}[scheme], {}
    for threads in (True, False):
        context = chromium.new_context(
            viewport={"width": 1280, "height": 900}, service_workers="block", color_scheme="light"
        )
        if not threads:
            context.add_init_script("delete window.Worker")
        page = context.new_page()
        page.goto(f"{base}/{pages_with_explorers(site, 'en')[0].relative_to(site).as_posix()}")
        element = page.locator("kalman-explorer").first
        element.scroll_into_view_if_needed()
        page.evaluate("document.fonts.ready.then(() => true)")
        shown(element)
        element.evaluate("async e => { e.explorer.draw(true); await e.explorer.painted(); }")
        drawn[threads] = element.evaluate("""e => [...e.querySelectorAll('canvas')].map(canvas => {
          const copy = Object.assign(document.createElement('canvas'), { width: canvas.width,
            height: canvas.height }).getContext('2d');
          copy.drawImage(canvas, 0, 0);
          return copy.getImageData(0, 0, canvas.width, canvas.height).data.filter((value, i) =>
            i % 4 === 3 && value > 0).length;
        })""")
        refused = element.evaluate(
            """e => { try { return e.querySelector('canvas').getContext('2d') === null; } catch {
            return true; } }"""
        )
        assert refused == threads  # a canvas that was handed over has no context in the page
        context.close()
    assert min(drawn[True]) > 1000 and drawn[True] == pytest.approx(drawn[False], rel=0.02)


def test_a_theme_that_changes_while_all_is_hidden_is_seen_afterwards(site, opened):
    """As JupyterLab does it: away and back within one frame, which no observer notices."""
    page, _, element = explorer_of("gyro", site, opened, color_scheme="light")
    element.locator("canvas").first.scroll_into_view_if_needed()
    shown(element)
    before = picture(element)
    element.evaluate("""e => {
      const display = (value) => { document.body.style.display = value; };
      requestAnimationFrame(() => {
        display('none');
        document.documentElement.dataset.theme = 'dark';
        e.explorer.plots.forEach(plot => plot.forgetSize());  // as a new size does
      });
      e.explorer.drawAgain();  // the frame that the new theme finds already asked for
      requestAnimationFrame(() => display(''));
    }""")
    page.wait_for_function(
        f"([e, before]) => {{ {PICTURE} return picture(e) !== before; }}",
        arg=[element.element_handle(), before],
    )


HELD_PAINTER = """
  const Quick = Worker, later = setTimeout;
  let held = [];
  window.Worker = class extends Quick {
    set onmessage(hear) {
      super.onmessage = (event) => (held ? held.push(() => hear(event)) : hear(event));
    }
  };
  window.letGo = () => {
    const calls = held;
    held = null;
    calls.forEach((call) => call());
  };
  // nobody tires of waiting for it: THREAD_WAIT of painter.js
  window.setTimeout = (call, wait, ...more) => (wait === 3000 ? 0 : later(call, wait, ...more));"""


def test_what_waits_for_a_painter_that_comes_late_is_waited_for(site, server, chromium):
    """painted() promises a picture, also before there is anything to draw on."""
    context = chromium.new_context(service_workers="block")
    context.add_init_script(HELD_PAINTER)
    page = context.new_page()
    page.goto(f"{server}/{pages_with_explorers(site, 'en')[0].relative_to(site).as_posix()}")
    element = page.locator("kalman-explorer").first
    element.locator("canvas").first.scroll_into_view_if_needed()
    assert element.evaluate("""async e => {
      const [plot] = e.explorer.plots;
      const before = Boolean(plot.place);
      const painted = e.explorer.painted();
      letGo();
      await painted;
      return [before, Boolean(plot.place)];
    }""") == [False, True]
    context.close()
