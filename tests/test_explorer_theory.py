"""Chapter 1 in the page: two bells to drag, and axes that rest while a slider moves."""

import json

import numpy as np
import pytest
from explorer_helpers import RELATIVE, explorer_of, set_state, shown

from kalman_lib.papers import theory

BELLS = "kalman-explorer[view=bells]"


def test_two_rulers_are_fused_as_in_python(bundle):
    rng = np.random.default_rng(1)
    rulers = [[a, va, b, vb] for a, va, b, vb in rng.uniform(0.1, 30, (20, 4))]
    answers = bundle.evaluate(
        """text => JSON.parse(text).map((rulers) => {
          const { x, P, K } = KalmanExplorers.papers.theory.fuse(...rulers);
          return [x, P, K];
        })""",
        json.dumps(rulers),
    )
    ours = [theory.fuse(*ruler) for ruler in rulers]
    assert np.allclose(answers, ours, rtol=RELATIVE)


@pytest.fixture
def bells(site, opened):
    page, *_ = explorer_of("theory", site, opened, "en")
    element = page.locator(BELLS)
    element.scroll_into_view_if_needed()
    element.evaluate("e => { e.explorer.memo = {}; e.explorer.reset(); }")  # nothing is held
    shown(element)
    return page, element


def place(element, x, y):
    """Where (cm, 1/cm) lies in the window."""
    return element.evaluate(
        """(e, [x, y]) => {
          const [plot] = e.explorer.plots;
          const box = plot.canvas.getBoundingClientRect();
          const far = (of, size) => {
            const [at_0, at_1] = [of(0), of(size)];
            return (value) => (size * (value - at_0)) / (at_1 - at_0);
          };
          const across = far(plot.x_of, plot.width), up = far(plot.y_of, plot.height);
          return [box.left + across(x), box.top + up(y)];
        }""",
        [x, y],
    )


def drag(page, element, start, end):
    """Take the mouse from one place to another, in (cm, 1/cm)."""
    page.mouse.move(*place(element, *start))
    page.mouse.down()
    page.mouse.move(*place(element, *end), steps=12)
    page.mouse.up()
    shown(element)
    return element.evaluate("e => [e.explorer.s, e.explorer.r]")


def peak(sigma):
    return 1 / (sigma * np.sqrt(2 * np.pi))


def test_the_peak_moves_a_bell(bells):
    page, element = bells
    s, r = drag(page, element, (20, peak(2)), (26, peak(2)))
    assert s["a"] == pytest.approx(26, abs=0.2)
    assert (s["b"], s["sigma_a"], s["sigma_b"]) == (23, 2, 1)  # nothing else was taken along
    assert (r["x"], r["P"]) == pytest.approx(theory.fuse(s["a"], 4, 23, 1)[:2])


def test_a_shoulder_widens_a_bell(bells):
    page, element = bells
    shoulder = np.exp(-0.5) * peak(1)
    s, r = drag(page, element, (24, shoulder), (26, shoulder))
    assert s["sigma_b"] == pytest.approx(3, abs=0.2)
    assert (s["a"], s["b"], s["sigma_a"]) == (20, 23, 2)
    assert r["K"] == pytest.approx(4 / (4 + s["sigma_b"] ** 2))


def test_readings_far_apart_do_not_widen_the_blue_bell(bells):
    page, element = bells
    before = element.evaluate("e => e.explorer.r.P")
    set_state(element, a=15, b=28)
    shown(element)
    assert element.evaluate("e => e.explorer.r.P") == before
    assert "The blue bell does not know" in element.locator(".explorer-outcome").inner_text()


def test_the_axes_rest_while_a_slider_moves(site, opened):
    page, *_ = explorer_of("theory", site, opened, "en")
    element = page.locator("kalman-explorer:not([view])")
    limits = []
    for R in (0.01, 0.05, 0.2, 0.5):
        set_state(element, R=R)
        shown(element)
        limits.append(element.evaluate("e => e.explorer.r.limits"))
    assert all(other == limits[0] for other in limits)


def test_the_sentence_counts_moments_as_their_slider_does(site, opened):
    page, *_ = explorer_of("theory", site, opened, "en")
    element = page.locator("kalman-explorer:not([view])")
    for moment, title in (
        (1, "Moment 1 of 10, step 1: prediction."),
        (4, "Moment 4 of 10, step 2"),
    ):
        set_state(element, moment=moment)
        shown(element)
        assert title in element.locator(".explorer-outcome").inner_text()
