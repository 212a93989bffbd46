"""What the filters take and refuse: numbers from anywhere, and one sentence in both languages for the rest."""
import copy
import datetime
import pickle
import warnings
from dataclasses import FrozenInstanceError, fields, replace
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pandas as pd
import pytest

from kalman_lib import (LinearModel, NonlinearModel, degrees_of_freedom, fast, filters, kalman_filter, nees, nis,
                        predict, rts_smooth, simulate, smooth_runs, update)
from kalman_lib.papers import beetle

ONE = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1, B=1)
TWO = LinearModel(F=1, H=[[1], [2]], Q=0.01, R=np.eye(2), x0=0, P0=1)
NAN = float("nan")


def one_sentence_in_each_language(error):
    english, slash, indonesian = str(error.value).partition(" / ")
    assert slash and english.endswith(".") and indonesian.endswith(".")
    words = set(indonesian.replace(",", " ").replace(";", " ").split())
    assert not words & {"or", "and", "is", "has", "must", "expected", "the", "holds", "shape"}, indonesian


# --- taken -----------------------------------------------------------------------------------------------------------

EXPECTED = kalman_filter(ONE, np.array([1.0, NAN, 3.0, 4.0])).x


@pytest.mark.parametrize("z", [
    [1, NAN, 3, 4], (1, None, 3, 4), [[1], [None], [3], [4]], [1, pd.NA, 3, 4],
    np.array([1, NAN, 3, 4], dtype=np.float32), np.array([1, NAN, 3, 4], dtype=object),
    np.asfortranarray([[1], [NAN], [3], [4]]), [np.float32(1), NAN, np.int8(3), Decimal(4)], [Fraction(1), None, True * 3, 4],
    np.ma.masked_array([1, 999, 3, 4], [0, 1, 0, 0]), np.ma.masked_array([[1], [999], [3], [4]], [[0], [1], [0], [0]]),
    np.ma.masked_invalid([1, NAN, 3, 4]), pd.Series([1, NAN, 3, 4]), pd.Series([1, None, 3, 4], dtype="Int64"),
    pd.Series([1, pd.NA, 3, 4], dtype=object), pd.DataFrame({"z": [1, NAN, 3, 4]}), pd.DataFrame({"z": [1, NAN, 3, 4]}).z,
    pd.DataFrame({"z": [1, pd.NA, 3, 4]}, dtype="Float64"), np.array([1, NAN, 3, 4])[::-1][::-1]],
    ids=lambda z: type(z).__name__)
def test_numbers_from_anywhere_are_taken(z):
    assert np.array_equal(kalman_filter(ONE, z).x, EXPECTED)


def test_rows_of_two_sensors_from_anywhere():
    rows = [[1, 2], [NAN, NAN], [3, NAN]]
    expected = kalman_filter(TWO, rows).x
    for z in ([[1, 2], None, [3, None]], [(1, 2), [None, None], (3, pd.NA)], pd.DataFrame(rows, columns=["a", "b"]),
              pd.DataFrame(rows).convert_dtypes(), np.ma.masked_invalid(rows)):
        assert np.array_equal(kalman_filter(TWO, z).x, expected)


def test_masked_entries_are_silent_and_masked_inputs_are_refused():
    z = np.ma.masked_array([0.0, 0, 999, 0], [0, 0, 1, 0])
    assert np.array_equal(kalman_filter(ONE, z).x, np.zeros((4, 1)))
    with pytest.raises(ValueError, match=r"u\[1\] is .*nan") as error:
        kalman_filter(ONE, np.zeros(2), np.ma.masked_array([1.0, 2], [0, 1]))
    one_sentence_in_each_language(error)


def test_matrices_from_anywhere_are_taken():
    frames = LinearModel(F=pd.DataFrame([[1, 1], [0, 1]]), H=pd.Series([1, 0]), Q=[[Fraction(1, 2), 0], [0, 1]],
                         R=np.float32(2), x0=pd.Series([0, 0]), P0=np.asfortranarray(np.eye(2, dtype=int)))
    plain = LinearModel([[1, 1], [0, 1]], [1, 0], [[0.5, 0], [0, 1]], 2, [0, 0], np.eye(2))
    assert np.array_equal(kalman_filter(frames, [1, 2]).x, kalman_filter(plain, [1, 2]).x)


# --- refused ---------------------------------------------------------------------------------------------------------

REFUSED = [
    (["a", "b"], "text"), (["1", "2"], "text"), (np.array(["1", "2"]), "text"), ([1, "2"], "text"), ([b"1", b"2"], "text"),
    (pd.Series(["1", "2"]), "text"), (pd.Series(["a", "b"], dtype="category"), "text"),
    (np.array(["2026-01-01", "NaT"], dtype="datetime64[s]"), "dates"), (np.array([1, 2], dtype="timedelta64[s]"), "dates"),
    (pd.Series(pd.to_datetime(["2026-01-01", None])), "dates"), ([datetime.date(2026, 1, 1), 2], "dates"),
    ([pd.Timestamp("2026-01-01"), 2], "dates"), ([pd.NaT, 1.0], "dates"), ([pd.Timedelta("1s"), 2], "dates"),
    (pd.DataFrame({"t": pd.to_datetime(["2026-01-01", "2026-01-02"])}), "dates"), ([1 + 2j, 3], "complex"),
    (np.array([1, 2], dtype=complex), "complex"), ([object(), 1], "object"), ([{1: 2}, 1], "dict"), ([[1], [2, 3]], "equal length"),
    (np.zeros(2, dtype=[("a", float)]), "something else")]


@pytest.mark.parametrize("values, word", REFUSED, ids=lambda value: value if isinstance(value, str) else "")
def test_what_is_no_number_is_refused_in_one_sentence(values, word):
    for call in (lambda: kalman_filter(ONE, values), lambda: kalman_filter(ONE, np.zeros(2), values),
                 lambda: LinearModel(F=np.eye(2), H=[1, 0], Q=np.eye(2), R=1, x0=values, P0=np.eye(2))):
        with pytest.raises(ValueError, match=word) as error:
            call()
        one_sentence_in_each_language(error)


@pytest.mark.parametrize("call", [
    lambda: kalman_filter(ONE, np.zeros((5, 2))), lambda: kalman_filter(ONE, np.zeros((5, 2, 3))), lambda: kalman_filter(ONE, []),
    lambda: kalman_filter(ONE, 3.0), lambda: kalman_filter(ONE, [1, np.inf]), lambda: kalman_filter(ONE, [1, 2], [1, NAN]),
    lambda: kalman_filter(ONE, [1, 2], [1, 2, 3]), lambda: kalman_filter(ONE, [1, 2], np.ones((2, 2))),
    lambda: kalman_filter(TWO, [1, 2], [1, 2]), lambda: update(ONE, ONE.x0, ONE.P0, [1, 2]), lambda: update(ONE, ONE.x0, ONE.P0, [np.inf]),
    lambda: kalman_filter(ONE, [1, 2], gate=2), lambda: kalman_filter(ONE, [1, 2], gate="0.9"), lambda: kalman_filter(ONE, [1, 2], gate=0),
    lambda: kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: R * NAN), lambda: kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: [1, 2]),
    lambda: replace(TWO, R=[[np.inf, 0.1], [0.1, 1]]), lambda: replace(ONE, R=NAN), lambda: replace(ONE, R=-np.inf), lambda: replace(ONE, Q=np.inf),
    lambda: nees(np.zeros((3, 1)), np.zeros((3, 1)), np.zeros((3, 1, 1))), lambda: nis(np.zeros((3, 2)), np.zeros((3, 1, 1))),
    lambda: rts_smooth(kalman_filter(ONE, np.zeros((60, 1, 2)))), lambda: smooth_runs(kalman_filter(ONE, np.zeros(60)))])
def test_errors_are_one_sentence_in_each_language(call):
    with pytest.raises(ValueError) as error:
        call()
    one_sentence_in_each_language(error)


def test_NaN_from_adapt_R_is_called_NaN():
    with pytest.raises(ValueError, match="R from adapt_R at step 1.*NaN"):
        kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: R * (NAN if k else 1))


# --- results are values ----------------------------------------------------------------------------------------------

@pytest.mark.parametrize("T", [10, 49, 50, 60, 3000])
@pytest.mark.parametrize("runs", [None, 3])
def test_a_result_never_changes_when_its_input_does(T, runs):
    z = np.ones((T, 1) if runs is None else (T, 1, runs))
    u = np.ones((T, 1))
    result, same = kalman_filter(ONE, z, u), kalman_filter(ONE, z.copy(), u.copy())
    z[:], u[:] = 0, 7
    for field in fields(result):
        assert np.array_equal(getattr(result, field.name), getattr(same, field.name)), field.name


@pytest.mark.parametrize("z", [np.ones(20), np.ones(60), np.ones((60, 1, 3)), np.ones(3000)], ids=len)
def test_the_arrays_of_a_result_are_read_only(z):
    result = kalman_filter(ONE, z)
    smooth = (rts_smooth if z.ndim == 1 else smooth_runs)(result)
    for values in (result, smooth):
        for field in fields(values):
            with pytest.raises(ValueError, match="read-only"):
                array = getattr(values, field.name)
                array *= 57.3
            with pytest.raises((FrozenInstanceError, AttributeError)):
                setattr(values, field.name, 0)


def test_the_data_of_the_reader_stay_his():
    z = np.ones(60)
    kalman_filter(ONE, z)
    z[0] = 5
    assert z.flags.writeable and z[0] == 5


@pytest.mark.parametrize("T", [1, 2, 60])
def test_results_of_many_runs_can_be_pickled_replaced_and_smoothed(T):
    z = np.random.default_rng(0).normal(size=(T, 1, 4))
    result = kalman_filter(ONE, z)
    expected = smooth_runs(result)
    assert expected.P.shape == (T, 1, 1) and expected.x.shape == (T, 1, 4)
    for other in (pickle.loads(pickle.dumps(result)), replace(result, gated=None)):
        smooth = smooth_runs(other)
        np.testing.assert_allclose(smooth.x, expected.x, rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(smooth.P, expected.P, rtol=1e-12)


# --- nonlinear models ------------------------------------------------------------------------------------------------

def battery(**changes):
    """State of charge and a polarisation voltage; the terminal voltage sees the current u."""
    def ocv(soc):
        return 3.2 + 0.8 * soc + 0.1 * soc ** 2
    parts = dict(f=lambda x, u: np.array([x[0] - u[0] / 3600, 0.9 * x[1] + 0.01 * u[0]]),
                 F=lambda x, u: np.array([[1, 0], [0, 0.9]]), h=lambda x, u: ocv(x[0]) - x[1] - 0.05 * u[0],
                 H=lambda x, u: [0.8 + 0.2 * x[0], -1], Q=np.diag([1e-9, 1e-8]), R=1e-4, x0=[0.5, 0], P0=np.diag([0.1, 1e-4]))
    return NonlinearModel(**{**parts, **changes})


def test_h_sees_the_input():
    """The EKF against the same steps written out."""
    model, rng = battery(), np.random.default_rng(1)
    u = rng.uniform(0, 5, size=(200, 1))
    run = simulate(model, 200, rng, u, x0=[0.9, 0])
    result = kalman_filter(model, run.z, u)
    x, P = model.x0, np.array(model.P0)
    for k in range(200):
        F, H = model.F(x, u[k]), np.atleast_2d(model.H(model.f(x, u[k]), u[k]))
        x, P = model.f(x, u[k]), F @ P @ F.T + model.Q
        K = P @ H.T / (H @ P @ H.T + model.R)
        x, P = x + K @ (run.z[k] - model.h(x, u[k])), P - K @ H @ P
        np.testing.assert_allclose(result.x[k], x, rtol=1e-9)
    assert abs(result.x[-1, 0] - run.x[-1, 0]) < 0.05


@pytest.mark.parametrize("name, function, words", [
    ("h", lambda x, u: NAN if u[0] > 4 else x[0], r"h\(x, u\)\[0\] is nan at step 3"),
    ("f", lambda x, u: x * (np.inf if u[0] > 4 else 1), r"f\(x, u\)\[0\] is inf at step 3"),
    ("F", lambda x, u: np.eye(2) * (NAN if u[0] > 4 else 1), r"F\(x, u\)\[0, 0\] is nan at step 3"),
    ("H", lambda x, u: [1, NAN if u[0] > 4 else 0], r"H\(x, u\)\[0, 1\] is nan at step 3"),
    ("h", lambda x, u: "3", "holds text"), ("F", lambda x, u: np.eye(3), r"has shape \(3, 3\), expected \(2, 2\)")])
def test_the_first_number_that_is_not_finite_stops_the_filter(name, function, words):
    u = np.array([1.0, 2, 3, 5, 6])
    with pytest.raises(ValueError, match=words) as error:
        kalman_filter(battery(**{name: function}), np.full(5, 3.5), u)
    one_sentence_in_each_language(error)


def test_a_filter_that_diverges_says_at_which_step():
    """A wrong sign in F: the covariance grows without end."""
    model = battery(f=lambda x, u: 1e30 * x, F=lambda x, u: -1e30 * np.eye(2), h=lambda x, u: x[0] * 0, H=lambda x, u: [0, 0])
    with np.errstate(all="ignore"), pytest.raises(ValueError, match=r"at step \d+ .*langkah \d+") as error:
        kalman_filter(model, np.zeros(30), np.ones(30))
    one_sentence_in_each_language(error)


@pytest.mark.parametrize("residual, words", [
    (lambda z, z_pred: (z - z_pred) * NAN, r"residual\(z, z_pred\)\[0\] is nan at step 0"),
    (lambda z, z_pred: np.zeros(3), r"has shape \(3,\)"), (None, "residual must be a function")])
def test_a_residual_that_is_no_number_is_refused(residual, words):
    with pytest.raises(ValueError, match=words) as error:
        kalman_filter(replace(ONE, residual=residual), [1, 2])
    one_sentence_in_each_language(error)


@pytest.mark.parametrize("change, words", [
    (dict(h=lambda x, u: np.where(x > 0.6, NAN, x)), r"h\(x, u\)\[0\] is nan at step"), (dict(), r"z\[1\] is .*inf")])
def test_many_extended_runs_hide_nothing(change, words):
    parts = dict(f=lambda x, u: x, F=lambda x, u: [[1]], h=lambda x, u: x, H=lambda x, u: [1], Q=1, R=1, x0=0, P0=1)
    z = np.ones((20, 1, 2))
    if not change:
        z[1, 0, 0] = np.inf
    with pytest.raises(ValueError, match=words):
        kalman_filter(NonlinearModel(**{**parts, **change}, many_runs=True), z)


def test_functions_that_work_in_place_change_no_result():
    def f(x, u):
        x[0] = x[0] + 1
        return x
    model = NonlinearModel(f, lambda x, u: [[1]], lambda x, u: x, lambda x, u: [1], 0.1, 1, 0, 1, many_runs=True)
    z = np.ones((6, 1, 2))
    single = kalman_filter(model, z[:, :, 0])
    assert np.allclose(kalman_filter(model, z).x[..., 0], single.x, rtol=1e-12)
    expected = kalman_filter(replace(model, f=lambda x, u: x + 1), z[:, :, 0])
    assert np.array_equal(single.x, expected.x)


def test_an_R_that_follows_from_itself_is_refused():
    for v in ((0.1, 0.3), (0.3, 0.7), (1, 2)):
        with pytest.raises(ValueError, match="not positive definite") as error:
            LinearModel(1, np.ones((2, 1)), 1, np.outer(v, v), 0, 1)
        one_sentence_in_each_language(error)


def test_a_list_of_masked_rows_keeps_its_masks():
    z = np.ma.masked_array([[1, 2], [999, 2], [1, 2.0]], [[0, 0], [1, 0], [0, 0]])
    assert np.array_equal(kalman_filter(TWO, list(z)).x, kalman_filter(TWO, z).x)


@pytest.mark.parametrize("z", [np.zeros(1200), np.zeros((1200, 1, 2))], ids=["one", "many"])
def test_a_linear_model_that_overflows_says_at_which_step(z):
    with np.errstate(all="ignore"), pytest.raises(ValueError, match=r"no longer finite at step \d+") as error:
        kalman_filter(LinearModel(4, 0, 1, 1, 1, 1), z)
    one_sentence_in_each_language(error)


def test_copies_are_read_only_too():
    for result in (kalman_filter(ONE, np.ones(10)), kalman_filter(ONE, np.arange(90.0) % 7)):
        for twin in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result), copy.copy(result)):
            for field in fields(twin):
                assert not getattr(twin, field.name).flags.writeable, field.name


def test_a_sensor_that_never_speaks_is_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for z in (np.full(60, NAN), np.full((60, 1, 2), NAN)):
            assert np.array_equal(kalman_filter(ONE, z).x, np.zeros((60, 1, *z.shape[2:])))


@pytest.mark.parametrize("call", [
    lambda: simulate(ONE, 0, np.random.default_rng(0)), lambda: simulate(ONE, 2.5, np.random.default_rng(0)),
    lambda: simulate(ONE, 5, 1), lambda: simulate(ONE, 5, np.random.default_rng(0), x0=[NAN]),
    lambda: kalman_filter(None, [1.0]), lambda: kalman_filter(ONE, [1.0], adapt_R=3), lambda: kalman_filter(ONE, [10 ** 400]),
    lambda: update(ONE, [0], [[1]], [1], R=[[-0.5]]), lambda: update(ONE, [0], [[1]], [1], R=np.eye(2)),
    lambda: predict(ONE, [0, 0], [[1]]), lambda: predict(ONE, [0], [[-1]]), lambda: predict(ONE, [NAN], [[1]]),
    lambda: LinearModel(1, 1, 1, 1, [], 1), lambda: nees([["a"]], [[0]], [[[1]]]), lambda: nees([[0]], [[1]], [[[-1]]])])
def test_bad_arguments_are_one_sentence(call):
    with pytest.raises(ValueError) as error:
        call()
    one_sentence_in_each_language(error)


# --- the gate, and NIS with silent sensors -----------------------------------------------------------------------------

def test_the_gate_leaves_out_what_is_too_far():
    rng = np.random.default_rng(2)
    z = rng.normal(size=(200, 2)) * [1, 2]
    outliers = rng.random(z.shape) < 0.05
    z[outliers] += 60
    model = LinearModel(1, [[1], [1]], 1e-4, np.diag([1, 4]), 0, 1)
    result = kalman_filter(model, z, gate=0.9999)
    assert result.gated.shape == (200, 2) and np.array_equal(result.gated, outliers)
    without = kalman_filter(model, np.where(outliers, NAN, z))
    np.testing.assert_allclose(result.x, without.x, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(rts_smooth(result).x, rts_smooth(without).x, rtol=1e-12, atol=1e-14)
    assert np.array_equal(np.isnan(result.y), outliers) and not without.gated.any()


def test_the_gate_is_the_quantile_of_chi_square():
    """S = 2 in the first step: 3.29 standard deviations are the 0.999 quantile."""
    model = LinearModel(1, 1, 0, 1, 0, 1)
    for z, gated in ((3.29 * 2 ** 0.5, False), (3.30 * 2 ** 0.5, True)):
        assert kalman_filter(model, [z], gate=0.999).gated[0, 0] == gated


def test_NIS_counts_the_sensors_that_were_heard():
    rng = np.random.default_rng(3)
    y = rng.normal(size=(6, 3))
    y[1, 0] = y[2, :2] = y[3] = NAN
    A = rng.normal(size=(6, 3, 3))
    S = A @ A.swapaxes(1, 2) + np.eye(3)
    assert degrees_of_freedom(y).tolist() == [3, 2, 1, 0, 3, 3]
    values = nis(y, S)
    for k in (0, 1, 2, 4):
        heard = np.isfinite(y[k])
        part = S[k][np.ix_(heard, heard)]
        assert values[k] == pytest.approx(y[k, heard] @ np.linalg.inv(part) @ y[k, heard])
    assert np.isnan(values[3])


def test_nees_and_nis_of_many_extended_runs():
    p = beetle.Params()
    walks = [beetle.simulate(p, np.random.default_rng(seed)) for seed in range(3)]
    z = np.stack([walk.z for walk in walks], axis=-1)
    together = kalman_filter(beetle.model(p), z)
    truth = np.stack([walk.x for walk in walks], axis=-1)
    for run, walk in enumerate(walks):
        alone = kalman_filter(beetle.model(p), walk.z)
        np.testing.assert_allclose(nees(truth, together.x, together.P)[:, run], nees(walk.x, alone.x, alone.P), rtol=1e-8)
        np.testing.assert_allclose(nis(together.y, together.S)[:, run], nis(alone.y, alone.S), rtol=1e-9)


def test_the_readable_and_the_fast_filter_say_the_same_of_a_gap():
    z = np.ones(60)
    z[[0, 7, 59]] = NAN
    for package in (filters, fast):
        result = package.kalman_filter(ONE, z)
        assert np.isnan(result.y[[0, 7, 59]]).all() and (result.K[[0, 7, 59]] == 0).all()
        assert np.array_equal(result.x[7], result.x_pred[7])
