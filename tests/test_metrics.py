"""Error measures against SciPy, against definitions, and against the filter's own claim over many
runs."""

import numpy as np
import pytest
from scipy.stats import chi2

from kalman_lib import LinearModel, chi2_bounds, kalman_filter, nees, nis, rmse
from kalman_lib.metrics import agreement, chi2_quantile
from kalman_lib.simulate import simulate


@pytest.mark.parametrize("dof", [1, 2, 3, 6, 50, 1000, 200_000])
def test_chi_square_quantiles_are_scipy_s(dof):
    for p in (0.0001, 0.025, 0.5, 0.975, 0.9999):
        assert chi2_quantile(p, dof) == pytest.approx(chi2.ppf(p, dof), rel=1e-10)


def test_bounds_of_a_mean():
    assert chi2_bounds(2, runs=50) == pytest.approx([
        chi2.ppf(0.025, 100) / 50,
        chi2.ppf(0.975, 100) / 50,
    ])
    assert chi2_bounds(1, probability=0.99) == pytest.approx([
        chi2.ppf(0.005, 1),
        chi2.ppf(0.995, 1),
    ])
    with pytest.raises(ValueError, match="0 < p < 1"):
        chi2_quantile(1, 1)


def test_rmse_nees_nis_by_hand():
    assert rmse([1, 2, 3], [1, 2, 6]) == pytest.approx(np.sqrt(3))
    assert rmse([[0, 0], [0, 0]], [[3, 1], [3, 1]]) == pytest.approx([3, 1])
    P = np.array([[[4, 0], [0, 1.0]]])
    assert nees([[2, 3]], [[0, 0]], P) == pytest.approx([2 * 2 / 4 + 3 * 3 / 1])
    assert np.array_equal(np.isnan(nis([[1], [np.nan]], np.ones((2, 1, 1)))), [False, True])
    with pytest.raises(ValueError, match=r"\(3,\).*\(2,\)"):
        rmse([1, 2], [1, 2, 3])


def test_nees_and_nis_of_many_runs_are_those_of_every_run():
    rng = np.random.default_rng(8)
    A = rng.normal(size=(5, 3, 3))
    e, P = rng.normal(size=(5, 3, 4)), A @ A.swapaxes(1, 2) + np.eye(3)
    for run in range(4):
        each = [e[k, :, run] @ np.linalg.inv(P[k]) @ e[k, :, run] for k in range(5)]
        assert nis(e, P)[:, run] == pytest.approx(each)
        assert nees(e + 1, np.ones_like(e), P)[:, run] == pytest.approx(each)
        assert nis(e[:, :, run], P) == pytest.approx(each)


def test_a_true_model_is_consistent_and_a_wrong_one_is_not():
    rng = np.random.default_rng(7)
    truth = LinearModel(
        F=[[1, 0.5], [0, 1]],
        H=[[1, 0]],
        Q=0.1 * np.eye(2),
        R=0.05,
        x0=[0, 5],
        P0=np.diag([0.01, 1]),
    )
    proud = LinearModel(F=truth.F, H=truth.H, Q=0.01 * truth.Q, R=truth.R, x0=truth.x0, P0=truth.P0)
    means = {}
    for name, model in (("true", truth), ("proud", proud)):
        e, y = [], []
        for _ in range(100):
            t = simulate(truth, 20, rng)
            result = kalman_filter(model, t.z)
            e.append(nees(t.x, result.x, result.P)[-1])
            y.append(nis(result.y, result.S)[-1])
        means[name] = np.mean(e), np.mean(y)
    for dof, value in zip((2, 1), means["true"]):
        low, high = chi2_bounds(dof, runs=100, probability=0.999)
        assert low < value < high
    for dof, value in zip((2, 1), means["proud"]):
        assert value > chi2_bounds(dof, runs=100, probability=0.999)[1]


def test_agreement_is_half_of_the_last_printed_digit():
    lines = agreement({"K": "0.88 1.22"}, {"K": [[0.8849], [1.2251]]}).splitlines()
    assert lines[0].split() == ["K[0]", "0.88", "0.884900", "✓"]
    assert lines[1].split() == ["K[1]", "1.22", "1.225100", "✗"]
    with pytest.raises(ValueError, match="'1e-5' is no plain decimal number"):
        agreement({"K": "1e-5"}, {"K": [0.4]})
    with pytest.raises(ValueError, match="K: 1 numbers printed, 2 ours"):
        agreement({"K": "0.88"}, {"K": [1, 2]})
