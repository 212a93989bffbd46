"""The page computes as Python does: random numbers, bounds, rows with a silent sensor."""

import numpy as np
import pytest
from explorer_helpers import listed

from kalman_lib import LinearModel, chi2_bounds, kalman_filter, rts_smooth


def test_normal_numbers_and_their_seeds(bundle):
    moments, same, other = bundle.evaluate("""() => {
      const { generator } = KalmanExplorers.random, rng = generator(1), sums = [0, 0, 0, 0];
      for (let i = 0; i < 400000; i++) { const v = rng.normal(); for (let j = 0; j < 4;
      j++) sums[j] += v ** (j + 1) / 400000; }
      return [sums, generator(5).normal() === generator(5).normal(),
        generator(5).normal() === generator(6).normal()];
    }""")
    assert same and not other
    assert moments == pytest.approx([0, 1, 0, 3], abs=0.03)


@pytest.mark.parametrize("dof, runs", [(1, 1), (1, 500), (2, 10), (3, 200), (6, 37)])
def test_chi_square_bounds(dof, runs, bundle):
    assert bundle.evaluate(
        "([dof, runs]) => KalmanExplorers.metrics.chi2Bounds(dof, runs)", [dof, runs]
    ) == pytest.approx(chi2_bounds(dof, runs), rel=1e-9)


def test_a_row_of_which_one_sensor_is_silent(bundle):
    """The finite part of a row is a measurement, as in Python."""
    rng = np.random.default_rng(4)
    R = [[1, 0.5, 0.1], [0.5, 1, 0.2], [0.1, 0.2, 2]]
    model = LinearModel(
        [[1, 0.1], [0, 0.9]], [[1, 0], [0, 1], [1, 1]], 0.1 * np.eye(2), R, [0, 1], np.eye(2)
    )
    z = rng.normal(size=(60, 3))
    z[rng.random(z.shape) < 0.4] = np.nan
    theirs = bundle.evaluate(
        """([F, H, Q, R, x0, P0, z]) => {
  const { filters, models, papers } = KalmanExplorers;
  const model = models.linearModel({ F, H, Q, R, x0, P0 });
  const numbers = Float64Array.from(z, value => value === null ? NaN : value);
  const result = filters.kalmanFilter(model, numbers), smooth = papers.ship.rtsSmooth(result);
  return [result.x, result.P, result.K, smooth.x, smooth.P].map(values => Array.from(values));
}""",
        [listed(getattr(model, name)) for name in ("F", "H", "Q", "R", "x0", "P0")] + [listed(z)],
    )
    result = kalman_filter(model, z)
    smooth = rts_smooth(result)
    for ours, values in zip((result.x, result.P, result.K, smooth.x, smooth.P), theirs):
        np.testing.assert_allclose(np.ravel(ours), values, rtol=1e-9, atol=1e-12)
