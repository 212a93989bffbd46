"""Chapter 1 against the digits that its source prints, and against exact fractions worked out by
hand."""

from fractions import Fraction

import numpy as np
import pytest

from kalman_lib import kalman_filter
from kalman_lib.papers import theory


def worked_example():
    p = theory.Params()
    return kalman_filter(theory.model(p), [p.z], [p.u])


@pytest.mark.parametrize(
    "name, printed, half_a_digit",
    [
        ("x_pred", [2.5, 4], 0.05),
        ("P_pred", [[0.36, 0.5], [0.5, 1.1]], 0.005),
        ("K", [[0.88], [1.22]], 0.005),
        ("x", [2.24, 3.63], 0.005),
        ("P", [[0.04, 0.06], [0.06, 0.49]], 0.005),
    ],
)
def test_every_printed_number(name, printed, half_a_digit):
    ours = getattr(worked_example(), name)[0]
    assert np.abs(ours - printed).max() <= half_a_digit
    assert [float(word) for word in theory.PRINTED[name].split()] == np.ravel(printed).tolist()


def test_the_same_in_exact_fractions():
    """x_pred = (5/2, 4), P_pred = ((9/25, 1/2), (1/2, 11/10)), S = 41/100: the rest follows by
    hand."""
    result = worked_example()
    S = Fraction(9, 25) + Fraction(1, 20)
    K = Fraction(9, 25) / S, Fraction(1, 2) / S
    y = Fraction(22, 10) - Fraction(5, 2)
    assert result.S[0, 0, 0] == pytest.approx(float(S), rel=1e-14)
    assert result.K[0, :, 0] == pytest.approx([float(k) for k in K], rel=1e-14)
    assert result.x[0] == pytest.approx(
        [float(Fraction(5, 2) + K[0] * y), float(4 + K[1] * y)], rel=1e-14
    )
    P = [
        [(1 - K[0]) * Fraction(9, 25), (1 - K[0]) / 2],
        [(1 - K[0]) / 2, Fraction(11, 10) - K[1] / 2],
    ]
    assert result.P[0] == pytest.approx(np.array(P, dtype=float), rel=1e-13)


def test_fusing_two_rulers_is_the_product_of_two_gaussians():
    a, var_a, b, var_b = 20.0, 4.0, 23.0, 1.0
    x, var, K = theory.fuse(a, var_a, b, var_b)
    grid = np.linspace(0, 50, 500_001)
    density = np.exp(-((grid - a) ** 2) / (2 * var_a) - (grid - b) ** 2 / (2 * var_b))
    density /= density.sum()
    mean = (grid * density).sum()
    assert x == pytest.approx(mean, rel=1e-9)
    assert var == pytest.approx(((grid - mean) ** 2 * density).sum(), rel=1e-9)
    assert K == pytest.approx(0.8)


def test_fusing_needs_positive_variances():
    with pytest.raises(ValueError, match="variances 0 and 0: expected positive"):
        theory.fuse(1, 0, 2, 0)


def test_parameters_out_of_range_are_named():
    with pytest.raises(ValueError, match="R = 0.*0.0001 to 10 m²"):
        theory.model(theory.Params(R=0))


def test_simulation_follows_its_model():
    """Over many runs the end position has the mean and variance that the prediction alone
    computes."""
    p, rng = theory.Params(), np.random.default_rng(0)
    ends = np.array([theory.simulate(p, rng, steps=4).x[-1] for _ in range(4000)])
    alone = kalman_filter(theory.model(p), np.full(4, np.nan), np.full(4, p.u))
    assert np.abs(ends.mean(axis=0) - alone.x[-1]).max() < 4 * np.sqrt(alone.P[-1].max() / 4000)
    assert np.cov(ends.T) == pytest.approx(alone.P[-1], rel=0.15)
