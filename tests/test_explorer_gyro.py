"""Chapter 3 in the page: the map of a wrong sigma."""

import re

import numpy as np
import pytest
from explorer_helpers import RELATIVE, explorer_of, set_state, shown

from kalman_lib import kalman_filter
from kalman_lib.papers import gyro


@pytest.mark.parametrize(
    "changes", [{}, {"sigma_w": 0.3, "sigma_v": 2.0, "T": 0.02, "duration": 5.0}]
)
def test_gyro_the_map_of_a_wrong_sigma_is_pythons(changes, site, opened):
    """Every cell of both maps; the chosen pair; and 500 runs of the page stay near it."""
    page, *_ = explorer_of("gyro", site, opened, "en")
    element = page.locator("kalman-explorer[view=mismatch]")
    set_state(element, **changes, times_w=3, times_v=0.25)
    page.wait_for_function(
        "e => e.explorer.r.runs.count === 500 && !e.explorer.work", arg=element.element_handle()
    )
    shown(element)
    ours = element.evaluate("""e => {
      const { cost, nees, best, wrong, runs } = e.explorer.r;
      const places = [...Array(31).keys()].map(i => i - 15);
      return { best, wrong, runs: runs.count, cost: places.map(j => places.map(i => cost(i, j))),
        nees: places.map(j => places.map(i => nees(i, j))) }; }""")
    p, times = gyro.Params(**changes), 10 ** (np.arange(-15, 16) / 15)
    rmse_, nees_ = gyro.expected(p, times * p.sigma_w, times[:, np.newaxis] * p.sigma_v)
    assert np.allclose(np.array(ours["cost"]) * ours["best"], rmse_, rtol=RELATIVE) and np.allclose(
        ours["nees"], nees_, rtol=RELATIVE
    )
    wrong = gyro.expected(p, 3 * p.sigma_w, 0.25 * p.sigma_v)
    assert ours["wrong"] == pytest.approx(wrong, rel=RELATIVE) and ours["runs"] == 500
    said = [
        float(word)
        for word in re.findall(
            r"experiments.*RMSE ([\d.]+) rad, NEES ([\d.]+)\.$",
            element.locator(".explorer-outcome").inner_text(),
        )[0]
    ]
    assert said == [pytest.approx(expected, rel=0.03) for expected in wrong]
    element.evaluate("e => e.explorer.reset()")


def test_gyro_a_phone_at_rest_drifts_as_python_says_until_the_sensor_holds_it(site, opened):
    """The fan is 2 sigma_w sqrt(T t); with the sensor, estimate and band are the filter's."""
    page, *_ = explorer_of("gyro", site, opened, "en")
    element = page.locator("kalman-explorer[view=drift]")
    p = gyro.Params(duration=60, T=0.1, sigma_w=0.5, sigma_v=2)
    read = """e => { const { z, alone, fan, band, x } = e.explorer.r;
      return [z, alone, fan, band, x].map(values => [...values]); }"""
    set_state(element, noise_w=0.5, noise_v=2)
    z, alone, fan, band, x = np.array(element.evaluate(read))
    assert np.allclose(fan, 2 * p.sigma_w * np.sqrt(p.T * gyro.times(p)), rtol=RELATIVE)
    assert np.array_equal(band, fan) and np.array_equal(x, alone)
    set_state(element, sensor=True)
    _, _, same, band, x = np.array(element.evaluate(read))
    u = np.diff(alone, prepend=0) / p.T
    result = kalman_filter(gyro.model(p), z, u)
    assert np.array_equal(same, fan) and np.allclose(x, result.x[:, 0], atol=1e-9)
    assert np.allclose(band, 2 * np.sqrt(result.P[:, 0, 0]), rtol=RELATIVE)
    element.evaluate("e => e.explorer.reset()")


def swipe(page, x, y, up):
    """A finger that begins at (x, y) of the window and goes up by so many pixels."""
    fingers = page.context.new_cdp_session(page)
    steps = [("touchStart", y), *(("touchMove", y - up * i / 6) for i in range(1, 7))]
    for kind, height in steps:
        points = [{"x": x, "y": height}]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    fingers.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    fingers.detach()


def test_gyro_a_finger_drags_the_belief_upwards_and_scrolls_beside_it(site, opened):
    page, *_ = explorer_of("gyro", site, opened, "en", has_touch=True)
    element = page.locator("kalman-explorer[view=mismatch]")
    canvas = element.locator("canvas").first

    def look():
        return canvas.evaluate("""canvas => {
          const element = canvas.closest('kalman-explorer');
          const { plots, s } = element.explorer;
          const plot = plots.find(one => one.canvas === canvas);
          const [x, y] = plot.place([s.times_w * s.sigma_w, s.times_v * s.sigma_v]);
          const box = canvas.getBoundingClientRect();
          return [box.left + x, box.top + y, element.getBoundingClientRect().top];
        }""")

    def place():  # of the mark and of the explorer's upper edge in the window, at rest
        shown(element)
        seen = None
        while seen != (now := look()):
            seen = now
            shown(element)
        return now

    element.evaluate("e => e.scrollIntoView({ block: 'center', behavior: 'instant' })")
    x, y, top = place()
    swipe(page, x, y, 50)
    assert place()[1:] == pytest.approx([y - 50, top], abs=8)
    assert element.evaluate("e => e.explorer.s.times_v") > 2
    before = element.evaluate("e => JSON.stringify(e.explorer.s)")
    swipe(page, x - 90, y + 30, 60)  # beside the mark
    scrolled = "([e, top]) => e.getBoundingClientRect().top < top - 20"
    page.wait_for_function(scrolled, arg=[element.element_handle(), top])
    assert element.evaluate("e => JSON.stringify(e.explorer.s)") == before
    element.evaluate("e => e.explorer.reset()")


def test_gyro_nothing_is_asked_before_its_rule_stands_on_the_page(site, opened):
    """The first view asks nothing; the simulation asks for sigma_w sqrt(T t), too."""
    page, *_ = explorer_of("gyro", site, opened, "en")
    first = page.locator("kalman-explorer[view=drift]")
    assert first.evaluate("e => e.explorer.view.question === undefined")
    assert first.locator("form").count() == 0
    element = page.locator("kalman-explorer[paper=gyro]:not([view])")
    set_state(element, sigma_w=0.5, T=0.2, duration=30)
    answers = element.evaluate("""e => {
      const { view, r, s, t } = e.explorer;
      return [...Array(5).keys()].map(kind => {
        const { text, answer } = view.question(r, s, t, { whole: () => kind });
        return text.startsWith("The gyroscope alone") ? answer : null;
      }).filter(answer => answer !== null);
    }""")
    assert answers == [pytest.approx(0.5 * np.sqrt(0.2 * 30))]
    element.evaluate("e => e.explorer.reset()")


def test_gyro_the_numbers_of_a_map_do_not_touch_and_the_truth_stands_above_the_belief(site, opened):
    page, *_ = explorer_of("gyro", site, opened, "id")
    element = page.locator("kalman-explorer[view=mismatch]")
    shown(element)
    boxes, order = element.evaluate("""e => {
      const { plots, r, s, t } = e.explorer;
      const boxes = [], ctx = new Proxy({}, { set: () => true, get: (_, name) =>
        name === "fillText" ? (text, x, y) => boxes.push([x, y, 6.5 * text.length]) : () => {} });
      const { layers, xlim, ylim } = plots[0].spec.draw(r, s, t);
      const box = plots[0].canvas.getBoundingClientRect();
      const scale = ([a, b], size) => v => size * Math.log(v / a) / Math.log(b / a);
      layers.find(layer => layer.paint).paint(ctx, scale(xlim, box.width - 60),
        scale(ylim, box.height - 45), { font: "sans-serif" });
      return [boxes, layers.map(layer => layer.look)];
    }""")
    assert len(boxes) >= 6 and order.index("truth") > order.index("measurement")
    for i, (x, y, width) in enumerate(boxes):
        for a, b, other in boxes[:i]:
            assert abs(x - a) >= (width + other) / 2 or abs(y - b) >= 12


def test_gyro_a_belief_that_comes_later_is_the_filters_own(site, opened):
    """First drawn without another belief, then with one: the optimum is another filter."""
    page, *_ = explorer_of("gyro", site, opened, "en")
    element = page.locator("kalman-explorer[paper=gyro]:not([view])")
    assert not element.evaluate("e => e.explorer.s.other")
    set_state(element, other=True, believed_w=1)
    page.wait_for_function(
        "e => e.explorer.r.runs.count === 500 && !e.explorer.work", arg=element.element_handle()
    )
    shown(element)
    gains = element.evaluate("""e => [e.explorer.r.filter, e.explorer.r.optimum]
      .map(filter => filter.K.at(-1))""")
    believed, true = gyro.Params(sigma_w=1), gyro.Params()
    assert gains == [pytest.approx(gyro.steady(p)[0], rel=0.2) for p in (believed, true)]
    assert "too confident" in element.locator(".explorer-outcome").inner_text()
    best = element.locator(".explorer-facts tr").last.locator("td").all_inner_texts()
    assert float(best[1]) == pytest.approx(gyro.steady(true)[1], rel=0.1)
    element.evaluate("e => e.explorer.reset()")
