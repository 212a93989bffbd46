"""Chapter 4 in the page: the fit, and recordings of the reader."""

import math

import numpy as np
import pytest
from explorer_helpers import RELATIVE, SETS, pages_with_explorers

from kalman_lib.papers import ship


def run_of(site, opened, language):
    """(browser page, trouble, locator) of the view that takes recordings."""
    path = next(
        path
        for path in pages_with_explorers(site, language)
        if '<kalman-explorer paper="ship">' in path.read_text(encoding="utf-8")
    )
    page, trouble = opened(path)
    return page, trouble, page.locator('kalman-explorer[paper="ship"]:not([view])')


def test_ship_continues_two_speeds_as_one_does_by_hand(bundle):
    """0.9 and 1 m/s: 1.6 - 0.72, then a straight line, then the mean of both."""
    said = bundle.evaluate(
        """models => models.map(([a1, a2]) => {
          const { compute } = KalmanExplorers.papers.ship.views.poles;
          return Array.from(compute({ a1, a2 }).s.subarray(0, 5));
        })""",
        [[1.6, -0.8], [2, -1], [0.5, 0.5]],
    )
    expected = [
        [0.9, 1, 0.88, 0.608, 0.2688],
        [0.9, 1, 1.1, 1.2, 1.3],
        [0.9, 1, 0.95, 0.975, 0.9625],
    ]
    assert np.allclose(said, expected, rtol=1e-12)


def test_ship_a_pole_follows_the_pointer(bundle):
    """Above the real axis both move as mirror images; on it the nearer one moves alone."""
    drag = """([[x, y], [a1, a2]]) => {
      const { poles, views } = KalmanExplorers.papers.ship;
      const moved = views.poles.plots[0].drag(x, y, { a1, a2 }, { poles: poles(a1, a2) });
      return poles(moved.a1, moved.a2).flat();
    }"""
    above = bundle.evaluate(drag, [[0.3, -0.6], [1.6, -0.8]])
    assert np.allclose(above, [0.3, 0.6, 0.3, -0.6], atol=1e-12)
    beside = bundle.evaluate(drag, [[-0.4, 0.01], [1.4, -0.48]])  # poles at 0.8 and 0.6
    assert np.allclose(beside, [0.8, 0, -0.4, 0], atol=1e-12)
    landed = bundle.evaluate(drag, [[0.5, 0.01], [1.6, -0.8]])
    assert np.allclose(landed, [0.5, 0, 0.5, 0], atol=1e-6)


@pytest.mark.parametrize("real", [0.8, 0.3, 0, -0.4])
def test_ship_a_dragged_pole_tells_the_noise_that_moves_it_there(real, bundle):
    sigma = bundle.evaluate(
        """([x, s]) => {
          const { compute, plots } = KalmanExplorers.papers.ship.views.noise;
          return plots[0].drag(x, 0, s, compute(s, {})).sigma;
        }""",
        [real, {"sigma": 0.1, "seed": 2}],
    )
    still = ship.towing_run(np.random.default_rng(0), 0)[1].x[:, 0]
    pole = ship.poles(*ship.expected_fit(still, sigma)[1:])[1].real
    assert abs(pole - real) < 0.06  # between two points of the curve


def test_ship_the_fit_and_what_noise_does_to_it_as_in_python(bundle):
    rng = np.random.default_rng(4)
    still = ship.towing_run(rng, 0)[1].x[:, 0]
    sigmas = [0, 1e-3, 0.01, 0.1, 0.5]
    series = [still + sigma * rng.normal(size=len(still)) for sigma in sigmas] + [
        ship.simulate(ship.Params(), rng).z[:, 0] for _ in range(SETS)
    ]
    ours = bundle.evaluate(
        """([series, sigmas]) => {
      const { towing_run, fit, expected_fit, poles } = KalmanExplorers.papers.ship, { x,
        t } = towing_run(KalmanExplorers.random.generator(1), 0);
      const fits = series.map(z => Array.from(fit(Float64Array.from(z)))),
        expected = sigmas.map(sigma => Array.from(expected_fit(x, sigma)));
      return { x: Array.from(x), t: Array.from(t), fits, expected, poles: fits.map(([, a1, a2]) =>
        poles(a1, a2).flat()),
               none: [[1, 2, 3, 4, 5, 6], [2, 2, 2, 2, 2, 2, 2], [1, 2], [1, 2, 4, 8, 16,
                 32]].map(z => fit(Float64Array.from(z))) };
    }""",
        [[z.tolist() for z in series], sigmas],
    )
    assert np.allclose(ours["x"], still, rtol=1e-12, atol=1e-15) and np.allclose(
        ours["t"], 0.1 * np.arange(len(still))
    )
    for z, theta, pair in zip(series, ours["fits"], ours["poles"]):
        p = ship.fitted(z, ship.Params())
        assert np.allclose(theta, [p.c, p.a1, p.a2], rtol=RELATIVE, atol=0)
        assert np.allclose(
            np.reshape(pair, (2, 2)) @ [1, 1j], ship.poles(p.a1, p.a2), rtol=1e-7
        )  # a root of a small difference
    for sigma, theta in zip(sigmas, ours["expected"]):
        assert np.allclose(
            theta, ship.expected_fit(still, sigma), rtol=1e-8 if sigma == 0 else RELATIVE, atol=0
        )
    assert ours["none"] == [None] * 4


def test_ship_tells_uneven_sampling_with_the_words_of_python(bundle):
    times = [
        [0, 1, 2, 3, 4, 5],
        [0, 0.1, 0.2, 0.31, 0.4, 0.55],
        [3, 3.25, 3.5, 3.75, 9],
        [0, 1, 1, 2, 3],
        [0, 2, 1, 3, 4, 5],
        [0, 1, 2],
        [0, 1, math.nan, 3, 4, 5],
    ]
    said = bundle.evaluate(
        """times => times.map(t => {
      try { const { dt, uneven, en,
        id } = KalmanExplorers.papers.ship.sampling(Float64Array.from(t, v => v ?? NaN));
      return [dt, uneven, en, id]; }
      catch ({ en, id }) { return [`${en} / ${id}`]; } })""",
        [[None if value != value else value for value in t] for t in times],
    )
    for t, ours in zip(times, said):
        try:
            sampled = ship.sampling(t)
        except ValueError as error:
            assert ours == [str(error)]
        else:
            assert ours[0] == pytest.approx(sampled.dt, rel=1e-12) and ours[1:] == [
                sampled.uneven,
                sampled.en,
                sampled.id,
            ]
