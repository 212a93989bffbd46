"""Chapter 2 in the page: draw a path, and the filter and the moving average run after it."""

import numpy as np
import pytest
from explorer_helpers import javascript

from kalman_lib import kalman_filter, rmse
from kalman_lib.papers import smoother

RACE = """([q, window, path], _) => {
  const { draw } = _.views;
  const s = { seed: 3, q, window, average: true, shape: "own", path: Float64Array.from(path) };
  const r = draw.compute(s, {});
  const late = (line) => _.lag(line, r.truth, 30);
  return [[...r.z], [...r.result.x], [...r.lines.average], late(r.result.x),
    late(r.lines.average), r.K];
}"""

DRAG = """(places, _) => {
  const { draw } = _.views, memo = {}, hand = {};
  let s = { ...draw.start, seed: 2, q: 0.1, average: false, shape: "mixed" };
  for (const [x, y] of places) {
    s = { ...s, ...draw.plots[0].drag(x, y, s, draw.compute(s, memo), hand) };
  }
  return [s.shape, [...s.path]];
}"""


@pytest.mark.parametrize("q", [1e-4, 0.1, 10])
@pytest.mark.parametrize("window", [1, 12])
def test_the_race_has_the_numbers_of_python(bundle, q, window):
    path = smoother.ready_path()
    (answer,) = javascript(bundle, RACE, [q, window, path.tolist()])
    z, x, average = (np.array(line) for line in answer[:3])
    p = smoother.Params(Q=q * 0.64, R=0.64, x0=5, P0=1000)
    np.testing.assert_allclose(x, kalman_filter(smoother.model(p), z).x[:, 0], rtol=1e-9)
    np.testing.assert_allclose(average, smoother.moving_average(z, window), rtol=1e-9)
    late = [smoother.lag(line, path, 30) for line in (x, average)]
    assert answer[3:5] == pytest.approx(late, rel=1e-6)
    assert answer[5] == pytest.approx(smoother.steady_gain(q), rel=1e-12)
    assert rmse(path, z) == pytest.approx(0.8, rel=0.25)


def test_the_ready_made_path_is_python_s(bundle):
    (answer,) = javascript(bundle, "(name, _) => [..._.path_of(name)]", "mixed")
    np.testing.assert_allclose(answer, smoother.ready_path(), rtol=1e-12)


def test_a_pointer_draws_without_holes_and_stays_in_the_figure(bundle):
    (answer,) = javascript(bundle, DRAG, [[10, 2], [20, 7], [30.2, 99], [28, -5]])
    shape, path = answer
    ready = smoother.ready_path()
    assert shape == "own" and path[9] == 2 and path[14] == pytest.approx(4.5)
    assert path[19] == 7 and path[29] == 10 and path[27] == 0
    assert path[:9] == pytest.approx(ready[:9]) and path[30:] == pytest.approx(ready[30:])
