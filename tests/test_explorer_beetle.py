"""Chapter 5 in the page: the second sensor, and what the distance alone cannot show."""

import dataclasses

import numpy as np
import pytest
from explorer_helpers import SETS, close, explorer_of, set_state, shown

from kalman_lib import kalman_filter
from kalman_lib.papers import beetle


def test_beetle_with_the_bearing_as_in_python(bundle):
    rng, cases = np.random.default_rng(6), []
    for _ in range(SETS):
        p = beetle.Params(
            theta0=rng.uniform(-1, 1),
            theta=rng.uniform(-1, 1),
            v=rng.uniform(1, 4),
            R_bearing=10 ** rng.uniform(-4, -2),
            dt=rng.uniform(0.1, 1),
        )
        cases.append((p, beetle.simulate(p, rng, 40, bearing=True)))
    answers = bundle.evaluate(
        """cases => cases.map(([p, z]) => {
      const { bearing_model, away_sigma } = KalmanExplorers.papers.beetle,
        r = KalmanExplorers.filters.kalmanFilter(bearing_model(p), Float64Array.from(z));
      return { x: Array.from(r.x), P: Array.from(r.P), K: Array.from(r.K),
        s: Array.from(away_sigma(r.x, r.P, 4)) }; })""",
        [[dataclasses.asdict(p), np.ravel(walk.z).tolist()] for p, walk in cases],
    )
    for (p, walk), answer in zip(cases, answers):
        result = kalman_filter(beetle.bearing_model(p), walk.z)
        for name, theirs in {
            "x": result.x,
            "P": result.P,
            "K": result.K,
            "s": beetle.away_sigma(result.x[:, :3], result.P[:, :3, :3]),
        }.items():
            assert not close(
                answer[name],
                np.reshape(theirs, (-1, np.size(answer[name]) // 40)),
                np.size(answer[name]) // 40,
                1e-11,
            ), (name, p)


@pytest.mark.parametrize("motion", ["reduce", "no-preference"])
def test_beetle_walks_only_for_who_wants_motion(motion, site, opened):
    page, trouble, element = explorer_of("beetle", site, opened, reduced_motion=motion)
    play = element.locator(".explorer-control.buttons button").first
    play.scroll_into_view_if_needed()
    for expected in (0, 20):
        play.click()
        if motion == "reduce":
            shown(element)
            assert element.evaluate("e => e.explorer.s.moment") == expected
    if motion == "no-preference":  # the first press started it, the second stopped it
        assert element.evaluate("e => e.explorer.playing") is None
        play.click()
        page.wait_for_function(  # while it walks, the button says so
            "([e, button]) => e.explorer.s.moment > 0.5 && button.innerText === 'Berhenti'",
            arg=[element.element_handle(), play.element_handle()],
        )
    element.evaluate("e => e.explorer.reset()")
    assert trouble == []


def test_beetle_what_the_distance_cannot_show_and_the_bearing_can(site, opened):
    *_, element = explorer_of("beetle", site, opened, "en")
    left = {}
    for bearing in (False, True):
        set_state(element, bearing=bearing)
        left[bearing] = element.evaluate(
            "e => [e.explorer.r.theta.share.at(-1), e.explorer.r.s.share.at(-1)]"
        )
        assert (
            "The distance shows only s" in element.locator(".explorer-outcome").inner_text()
        ) != bearing
    assert left[False][0] > 0.4 and left[False][1] < 0.1 and left[True][0] < 0.1
    element.evaluate("e => e.explorer.reset()")
