"""Maximum likelihood against what is printed, statsmodels and closed forms."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from statsmodels.datasets import nile
from statsmodels.tools.numdiff import approx_hess
from statsmodels.tsa.statespace.structural import UnobservedComponents
from tuning_helpers import bilingual

from kalman_lib import (
    LinearModel,
    fit,
)
from kalman_lib.numeric import maximise
from kalman_lib.simulate import simulate

NILE = nile.load_pandas().data["volume"].to_numpy()


def local_level(Q, R):
    return LinearModel(F=1, H=1, Q=Q, R=R, x0=NILE[0], P0=R)


def test_the_nile_as_durbin_and_koopman_print_it():
    """Time Series Analysis by State Space Methods, 2.10: 15,099 and 1,469.1.

    ln L = -632.5456 (diffuse start).
    """
    found = fit(local_level, dict(Q=1000, R=1000), NILE[1:])
    assert f"{found.values['R']:.0f}" == "15099"
    assert found.values["Q"] == pytest.approx(1469.1, abs=0.1)
    assert found.log_likelihood == pytest.approx(-632.5456, abs=1e-3)
    assert found.at_bound == () and isinstance(found.model, LinearModel)
    assert found.model.Q[0, 0] == found.values["Q"]
    peer = UnobservedComponents(NILE, "llevel", use_exact_diffuse=True)

    def loglike(logs):
        return peer.loglike(np.exp(logs))

    logs = np.log([found.values["R"], found.values["Q"]])
    assert found.log_likelihood >= loglike(np.log([15098.52, 1469.18])) - 1e-9
    sd = np.sqrt(np.diag(np.linalg.inv(-approx_hess(logs, loglike)))) * np.exp(logs)
    assert [found.errors["R"], found.errors["Q"]] == pytest.approx(sd, rel=2e-3)


@pytest.mark.parametrize("Q, R", [(1e-3, 1e9), (1e9, 1e-3), (1e8, 1e8), (1, 1)])
def test_a_poor_start_finds_the_same_maximum(Q, R):
    found = fit(local_level, dict(Q=Q, R=R), NILE[1:])
    assert found.log_likelihood == pytest.approx(-632.5456, abs=1e-3)
    assert found.values == pytest.approx(dict(Q=1469.18, R=15098.5), rel=1e-4)


def constant(R, P0=1e12):
    return LinearModel(F=1, H=1, Q=0, R=R, x0=0, P0=P0)


def test_closed_form_of_a_known_mean():
    """A state known to be 0: R is the mean square of z, its standard error R sqrt(2 / T)."""
    z = np.random.default_rng(3).normal(0, 2, 400)
    found = fit(lambda R: constant(R, P0=0), dict(R=1), z)
    mean_square = np.mean(z**2)
    assert found.values["R"] == pytest.approx(mean_square, rel=1e-6)
    assert found.errors["R"] == pytest.approx(mean_square * np.sqrt(2 / 400), rel=1e-3)
    assert found.log_likelihood == pytest.approx(
        -200 * (np.log(2 * np.pi * mean_square) + 1), rel=1e-12
    )


def test_standard_errors_are_honest():
    """Of 60 series, the true log Q and log R lie within +-2 standard errors in about 57.

    In fewer than 50: 1 in 1,000.
    """
    inside = np.zeros(2)
    true = LinearModel(F=1, H=1, Q=0.5, R=2, x0=0, P0=0)
    for seed in range(60):
        z = simulate(true, 200, np.random.default_rng(seed)).z
        found = fit(lambda Q, R: replace(true, Q=Q, R=R), dict(Q=1, R=1), z)
        for i, (name, value) in enumerate(dict(Q=0.5, R=2).items()):
            error = abs(np.log(found.values[name] / value))
            inside[i] += error < 2 * found.errors[name] / found.values[name]
    assert (inside >= 50).all()


def test_inputs_and_gaps_take_part():
    rng = np.random.default_rng(5)
    true = LinearModel(F=0.8, H=1, Q=0.1, R=0.4, x0=0, P0=1, B=1)
    u = rng.normal(size=600)
    z = simulate(true, 600, rng, u=u).z
    z[100:130] = np.nan
    found = fit(lambda Q, R, gain: replace(true, Q=Q, R=R, B=gain), dict(Q=1, R=1, gain=0.1), z, u)
    for name, value in dict(Q=0.1, R=0.4, gain=1).items():
        assert abs(found.values[name] - value) < 4 * found.errors[name]
        assert found.errors[name] < 0.3 * value


def test_names_in_free_may_be_negative():
    rng = np.random.default_rng(6)
    z = simulate(LinearModel(F=-0.7, H=1, Q=1, R=0.5, x0=0, P0=2), 800, rng).z
    found = fit(
        lambda a, Q: LinearModel(F=a, H=1, Q=Q, R=0.5, x0=0, P0=2), dict(a=0, Q=1), z, free=("a",)
    )
    assert abs(found.values["a"] + 0.7) < 4 * found.errors["a"] and found.errors["a"] < 0.05


def test_several_starts_find_the_higher_of_two_peaks():
    """Two sharp peaks in ln a, at 1 and at 100; the search that starts at 1 alone stays there."""

    def two_peaks(a):
        return np.logaddexp(-(np.log(a) ** 2) * 50, 3 - np.log(a / 100) ** 2 * 50)

    assert maximise(two_peaks, dict(a=1.1)).values["a"] == pytest.approx(100, rel=1e-4)
    alone = maximise(two_peaks, dict(a=1.1), factors=())
    assert alone.values["a"] == pytest.approx(1, rel=1e-4)
    assert alone.errors["a"] == pytest.approx(0.1, rel=2e-2)


def test_a_maximum_at_a_bound_says_so():
    """Measurements without noise: R = 0 is the best; and a constant: Q = 0."""
    walk = np.cumsum(np.random.default_rng(0).normal(size=200))
    found = fit(lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=0, P0=0), dict(Q=1, R=1), walk)
    assert found.at_bound == ("R",) and np.isnan(found.errors["R"])
    assert found.values["R"] == pytest.approx(1e-12)
    assert found.values["Q"] == pytest.approx(np.mean(np.diff(walk, prepend=0) ** 2))
    assert found.errors["Q"] == pytest.approx(found.values["Q"] * np.sqrt(2 / 200), rel=1e-2)
    still = np.random.default_rng(2).normal(5, 0.01, 100)
    found = fit(
        lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=5, P0=1), dict(Q=1e-4, R=1e-4), still
    )
    assert found.at_bound == ("Q",) and np.isnan(found.errors["Q"]) and found.errors["R"] < 2e-5


def test_a_flat_likelihood_claims_no_accuracy():
    z = np.random.default_rng(4).normal(size=100)
    found = fit(lambda R, idle: constant(R), dict(R=1, idle=3), z)
    assert not np.isfinite(found.errors["idle"]) and found.values["idle"] == pytest.approx(3)
    assert found.errors["R"] < 0.3 and found.at_bound == ()
    found = fit(lambda a, b: constant(a * b), dict(a=1, b=1), z)  # only the product is known
    assert not np.isfinite(found.errors["a"]) and not np.isfinite(found.errors["b"])


def test_what_overflows_explains_nothing_and_warns_nobody():
    z = np.random.default_rng(7).normal(size=300)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = fit(lambda a, R: LinearModel(F=a, H=1, Q=1, R=R, x0=1e5, P0=0), dict(a=0.5, R=1), z)
    assert np.isfinite(found.log_likelihood) and found.values["a"] < 1.5
    with pytest.raises(ValueError) as error:
        fit(lambda a: LinearModel(F=a, H=1e200, Q=1e200, R=1, x0=1e200, P0=0), dict(a=1e60), z)
    assert bilingual(error)


@pytest.mark.parametrize(
    "start, said",
    [
        (dict(Q=0, R=1), "Q = 0"),
        (dict(Q=1, R=-1), "R = -1"),
        (dict(Q=np.nan, R=1), "Q = nan"),
        (dict(Q=1, R=[1, 2]), "R"),
        (dict(Q="a", R=1), "Q"),
        ({}, "start"),
        ([1, 2], "start"),
        (dict(Q=1, S=1), "S"),
        (dict(Q=np.inf, R=1), "Q = inf"),
    ],
)
def test_a_start_that_cannot_be_one_is_named(start, said):
    with pytest.raises(ValueError, match=said) as error:
        fit(local_level, start, NILE)
    assert bilingual(error)


def test_an_error_of_the_model_comes_through():
    with pytest.raises(ValueError, match="z has shape"):
        fit(local_level, dict(Q=1, R=1), np.ones((5, 2)))
    with pytest.raises(ValueError, match="free.*c") as error:
        fit(local_level, dict(Q=1, R=1), NILE, free=("c",))
    assert bilingual(error)


def test_a_fit_prints_no_words():
    found = fit(local_level, dict(Q=1000, R=1000), NILE[1:])
    assert str(found) == repr(found)
    assert all(words in str(found) for words in ("Q = 1469", "±", "ln L = -632.5"))
    walk = np.cumsum(np.random.default_rng(0).normal(size=200))
    found = fit(lambda Q, R: LinearModel(F=1, H=1, Q=Q, R=R, x0=0, P0=0), dict(Q=1, R=1), walk)
    assert "R ≤ 1e-12" in str(found)
