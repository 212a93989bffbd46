"""What filters take and refuse: numbers from anywhere; for the rest one sentence a language."""

import datetime
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pandas as pd
import pytest
from checks_helpers import NAN, ONE, TWO, one_sentence_in_each_language

from kalman_lib import (
    LinearModel,
    kalman_filter,
    nees,
    nis,
    predict,
    rts_smooth,
    simulate,
    smooth_runs,
    update,
)

# --- taken ----------------------------------------------------------------------------------------


EXPECTED = kalman_filter(ONE, np.array([1.0, NAN, 3.0, 4.0])).x


@pytest.mark.parametrize(
    "z",
    [
        [1, NAN, 3, 4],
        (1, None, 3, 4),
        [[1], [None], [3], [4]],
        [1, pd.NA, 3, 4],
        np.array([1, NAN, 3, 4], dtype=np.float32),
        np.array([1, NAN, 3, 4], dtype=object),
        np.asfortranarray([[1], [NAN], [3], [4]]),
        [np.float32(1), NAN, np.int8(3), Decimal(4)],
        [Fraction(1), None, True * 3, 4],
        np.ma.masked_array([1, 999, 3, 4], [0, 1, 0, 0]),
        np.ma.masked_array([[1], [999], [3], [4]], [[0], [1], [0], [0]]),
        np.ma.masked_invalid([1, NAN, 3, 4]),
        pd.Series([1, NAN, 3, 4]),
        pd.Series([1, None, 3, 4], dtype="Int64"),
        pd.Series([1, pd.NA, 3, 4], dtype=object),
        pd.DataFrame({"z": [1, NAN, 3, 4]}),
        pd.DataFrame({"z": [1, NAN, 3, 4]}).z,
        pd.DataFrame({"z": [1, pd.NA, 3, 4]}, dtype="Float64"),
        np.array([1, NAN, 3, 4])[::-1][::-1],
    ],
    ids=lambda z: type(z).__name__,
)
def test_numbers_from_anywhere_are_taken(z):
    assert np.array_equal(kalman_filter(ONE, z).x, EXPECTED)


def test_rows_of_two_sensors_from_anywhere():
    rows = [[1, 2], [NAN, NAN], [3, NAN]]
    expected = kalman_filter(TWO, rows).x
    for z in (
        [[1, 2], None, [3, None]],
        [(1, 2), [None, None], (3, pd.NA)],
        pd.DataFrame(rows, columns=["a", "b"]),
        pd.DataFrame(rows).convert_dtypes(),
        np.ma.masked_invalid(rows),
    ):
        assert np.array_equal(kalman_filter(TWO, z).x, expected)


def test_masked_entries_are_silent_and_masked_inputs_are_refused():
    z = np.ma.masked_array([0.0, 0, 999, 0], [0, 0, 1, 0])
    assert np.array_equal(kalman_filter(ONE, z).x, np.zeros((4, 1)))
    with pytest.raises(ValueError, match=r"u\[1\] is .*nan") as error:
        kalman_filter(ONE, np.zeros(2), np.ma.masked_array([1.0, 2], [0, 1]))
    one_sentence_in_each_language(error)


def test_matrices_from_anywhere_are_taken():
    frames = LinearModel(
        F=pd.DataFrame([[1, 1], [0, 1]]),
        H=pd.Series([1, 0]),
        Q=[[Fraction(1, 2), 0], [0, 1]],
        R=np.float32(2),
        x0=pd.Series([0, 0]),
        P0=np.asfortranarray(np.eye(2, dtype=int)),
    )
    plain = LinearModel([[1, 1], [0, 1]], [1, 0], [[0.5, 0], [0, 1]], 2, [0, 0], np.eye(2))
    assert np.array_equal(kalman_filter(frames, [1, 2]).x, kalman_filter(plain, [1, 2]).x)


# --- refused --------------------------------------------------------------------------------------


REFUSED = [
    (["a", "b"], "text"),
    (["1", "2"], "text"),
    (np.array(["1", "2"]), "text"),
    ([1, "2"], "text"),
    ([b"1", b"2"], "text"),
    (pd.Series(["1", "2"]), "text"),
    (pd.Series(["a", "b"], dtype="category"), "text"),
    (np.array(["2026-01-01", "NaT"], dtype="datetime64[s]"), "dates"),
    (np.array([1, 2], dtype="timedelta64[s]"), "dates"),
    (pd.Series(pd.to_datetime(["2026-01-01", None])), "dates"),
    ([datetime.date(2026, 1, 1), 2], "dates"),
    ([pd.Timestamp("2026-01-01"), 2], "dates"),
    ([pd.NaT, 1.0], "dates"),
    ([pd.Timedelta("1s"), 2], "dates"),
    (pd.DataFrame({"t": pd.to_datetime(["2026-01-01", "2026-01-02"])}), "dates"),
    ([1 + 2j, 3], "complex"),
    (np.array([1, 2], dtype=complex), "complex"),
    ([object(), 1], "object"),
    ([{1: 2}, 1], "dict"),
    ([[1], [2, 3]], "equal length"),
    (np.zeros(2, dtype=[("a", float)]), "something else"),
]


@pytest.mark.parametrize(
    "values, word", REFUSED, ids=lambda value: value if isinstance(value, str) else ""
)
def test_what_is_no_number_is_refused_in_one_sentence(values, word):
    for call in (
        lambda: kalman_filter(ONE, values),
        lambda: kalman_filter(ONE, np.zeros(2), values),
        lambda: LinearModel(F=np.eye(2), H=[1, 0], Q=np.eye(2), R=1, x0=values, P0=np.eye(2)),
    ):
        with pytest.raises(ValueError, match=word) as error:
            call()
        one_sentence_in_each_language(error)


@pytest.mark.parametrize(
    "call",
    [
        lambda: kalman_filter(ONE, np.zeros((5, 2))),
        lambda: kalman_filter(ONE, np.zeros((5, 2, 3))),
        lambda: kalman_filter(ONE, []),
        lambda: kalman_filter(ONE, 3.0),
        lambda: kalman_filter(ONE, [1, np.inf]),
        lambda: kalman_filter(ONE, [1, 2], [1, NAN]),
        lambda: kalman_filter(ONE, [1, 2], [1, 2, 3]),
        lambda: kalman_filter(ONE, [1, 2], np.ones((2, 2))),
        lambda: kalman_filter(TWO, [1, 2], [1, 2]),
        lambda: update(ONE, ONE.x0, ONE.P0, [1, 2]),
        lambda: update(ONE, ONE.x0, ONE.P0, [np.inf]),
        lambda: kalman_filter(ONE, [1, 2], gate=2),
        lambda: kalman_filter(ONE, [1, 2], gate="0.9"),
        lambda: kalman_filter(ONE, [1, 2], gate=0),
        lambda: kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: R * NAN),
        lambda: kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: [1, 2]),
        lambda: replace(TWO, R=[[np.inf, 0.1], [0.1, 1]]),
        lambda: replace(ONE, R=NAN),
        lambda: replace(ONE, R=-np.inf),
        lambda: replace(ONE, Q=np.inf),
        lambda: nees(np.zeros((3, 1)), np.zeros((3, 1)), np.zeros((3, 1, 1))),
        lambda: nis(np.zeros((3, 2)), np.zeros((3, 1, 1))),
        lambda: rts_smooth(kalman_filter(ONE, np.zeros((60, 1, 2)))),
        lambda: smooth_runs(kalman_filter(ONE, np.zeros(60))),
    ],
)
def test_errors_are_one_sentence_in_each_language(call):
    with pytest.raises(ValueError) as error:
        call()
    one_sentence_in_each_language(error)


def test_NaN_from_adapt_R_is_called_NaN():
    with pytest.raises(ValueError, match="R from adapt_R at step 1.*NaN"):
        kalman_filter(ONE, [1, 2], adapt_R=lambda k, y, HPH, R: R * (NAN if k else 1))


def test_an_R_that_follows_from_itself_is_refused():
    for v in ((0.1, 0.3), (0.3, 0.7), (1, 2)):
        with pytest.raises(ValueError, match="not positive definite") as error:
            LinearModel(1, np.ones((2, 1)), 1, np.outer(v, v), 0, 1)
        one_sentence_in_each_language(error)


def test_a_list_of_masked_rows_keeps_its_masks():
    z = np.ma.masked_array([[1, 2], [999, 2], [1, 2.0]], [[0, 0], [1, 0], [0, 0]])
    assert np.array_equal(kalman_filter(TWO, list(z)).x, kalman_filter(TWO, z).x)


@pytest.mark.parametrize(
    "call",
    [
        lambda: simulate(ONE, 0, np.random.default_rng(0)),
        lambda: simulate(ONE, 2.5, np.random.default_rng(0)),
        lambda: simulate(ONE, 5, 1),
        lambda: simulate(ONE, 5, np.random.default_rng(0), x0=[NAN]),
        lambda: kalman_filter(None, [1.0]),
        lambda: kalman_filter(ONE, [1.0], adapt_R=3),
        lambda: kalman_filter(ONE, [10**400]),
        lambda: update(ONE, [0], [[1]], [1], R=[[-0.5]]),
        lambda: update(ONE, [0], [[1]], [1], R=np.eye(2)),
        lambda: predict(ONE, [0, 0], [[1]]),
        lambda: predict(ONE, [0], [[-1]]),
        lambda: predict(ONE, [NAN], [[1]]),
        lambda: LinearModel(1, 1, 1, 1, [], 1),
        lambda: nees([["a"]], [[0]], [[[1]]]),
        lambda: nees([[0]], [[1]], [[[-1]]]),
    ],
)
def test_bad_arguments_are_one_sentence(call):
    with pytest.raises(ValueError) as error:
        call()
    one_sentence_in_each_language(error)
