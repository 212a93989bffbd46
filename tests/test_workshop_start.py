"""Where the filter of the workshop starts, if the reader says so: x0 and P0."""

import numpy as np
import pytest
from test_workshop_code import close, run
from workshop_helpers import OWN, START, own_data, pasted, shown

from kalman_lib import kalman_filter
from kalman_lib.papers import workshop

Params = workshop.Params
F, H = np.array([[1, 0.5], [0, 0.9]]), np.array([[1, 0], [0, 2.0]])
TEXTS = {"F": "1 0.5; 0 0.9", "H": "1 0; 0 2"}
WHOLE = [[4, 1.5], [1.5, 1]]

# what is set, what is typed for x0 and P0, and what that means
CASES = {
    "walk": (dict(pattern=2, q=1), "20", "0", [20], [0]),
    "velocity": (dict(pattern=3, second=3, q=0.01), "1; -2,5", "4 0.25", [1, -2.5], [4, 0.25]),
    "matrix": (dict(pattern=3, q=0.01), "[1, -2]", "4 1.5; 1.5 1", [1, -2], WHOLE),
    "bias": (dict(pattern=3, second=3, bias=1, q=0.01), "1 2 3", "9 8 7", [1, 2, 3], [9, 8, 7]),
    "input": (dict(pattern=2, second=5, bias=1, q=1), "−3 0,5", "1 1e-4", [-3, 0.5], [1, 1e-4]),
    "x0 alone": (dict(pattern=3, q=0.01), "5 1", "", [5, 1], None),
    "P0 alone": (dict(pattern=2, q=1), "", "2", None, [2]),
    "own": (dict(pattern=OWN, q=0.1), "3 4", "[[4, 1.5], [1.5, 1]]", [3, 4], WHOLE),
}


def set_up(name):
    """(state of the page, the model that it must be, z, u)."""
    about, text_x, text_P, x0, P0 = CASES[name]
    p = Params(**about)
    data = own_data(p, uneven=True, gaps="w" not in own_data(p) or p.second != 5)
    state = about | pasted(data) | {"first_x": text_x, "first_P": text_P}
    z, u = data["z"], None
    if p.pattern == OWN:
        data["w"] = data["z"] / 2
        state |= TEXTS | pasted(data)
    if p.second == 5:
        u = data["w"]
    elif "w" in data:
        z = np.column_stack([z, data["w"]])
    first = data["z"]
    spread = np.nanmax(first) - np.nanmin(first)
    found = dict(x0=float(first[0]), P0=float(spread**2)) if p.pattern != OWN else {}
    dt = np.diff(data["t"])
    dt = np.append(np.median(dt), dt)
    return state, workshop.model(Params(**about, **found), dt, F, H, x0=x0, P0=P0), z, u


@pytest.mark.parametrize("name", CASES)
def test_it_starts_where_the_reader_says(name, bundle, tmp_path, monkeypatch):
    """The page, the module, and both programs that it hands over, to 1e-9."""
    state, model, z, u = set_up(name)
    result = kalman_filter(model, z, u)
    page = shown(bundle, **state)
    size = np.abs(result.x).max(axis=0)
    sigma = np.sqrt(result.P[-1].diagonal())
    ours = run(page["kalman"], page["csv"], tmp_path, monkeypatch)
    theirs = run(page["filterpy"], page["csv"], tmp_path, monkeypatch)
    for x in (result.x, ours["result"].x, np.array(theirs["x"])):
        close(page["x"], x, size)
    for P in (result.P, ours["result"].P):
        close(page["P"], P, np.outer(sigma, sigma))
    close(page["P"][-1], theirs["P"][-1], np.outer(sigma, sigma))
    np.testing.assert_array_equal(ours["x0"], model.x0)
    np.testing.assert_allclose(ours["P0"], np.asarray(model.P0), rtol=1e-15)


def test_nothing_said_is_the_first_measurement_as_before(bundle):
    state = dict(pattern=2, q=1) | pasted(own_data(Params(pattern=2, q=1)))
    plain = shown(bundle, **state)
    empty = shown(bundle, **state, first_x=" \n", first_P="")
    np.testing.assert_array_equal(plain["x"], empty["x"])


def test_made_up_data_stays_the_same_and_the_fit_starts_there_too(bundle):
    """A start that is surely wrong is no part of the data, but of what is most likely."""
    plain = shown(bundle, likely=True)
    other = shown(bundle, likely=True, first_x="500 0", first_P="1 1")
    assert (
        plain["csv"].splitlines()[1].split(",")[:4] == other["csv"].splitlines()[1].split(",")[:4]
    )
    assert other["found"]["q"] > 10 * plain["found"]["q"]


REFUSED = (
    "changes => {"
    + START
    + """
  const { input } = KalmanExplorers;
  try {
    view.compute({ ...start, ...changes }, {});
  } catch (error) {
    if (!(error instanceof input.InputError)) throw error;
    return [error.id, error.en];
  }
}"""
)


@pytest.mark.parametrize(
    "changes, id, en",
    [
        (
            dict(first_x="1 2 3"),
            "x₀ berisi 3 bilangan, tetapi keadaannya 2: tuliskan satu untuk setiap keadaan.",
            "x₀ has 3 numbers, but there are 2 states: type one for each.",
        ),
        (dict(first_x="1 a"), "“a” di dalam x₀ bukan bilangan.", "“a” in x₀ is not a number."),
        (dict(first_x="1 2; 3 4"), "x₀ berisi 4 bilangan", "x₀ has 4 numbers"),
        (
            dict(first_P="1"),
            "P₀ memerlukan 2 varians, satu untuk setiap keadaan, atau matriks 2 × 2.",
            "P₀ needs 2 variances, one for each state, or a matrix of 2 × 2.",
        ),
        (dict(first_P="1 2; 3"), "Baris ke-2 dari P₀", "Row 2 of P₀ has 1 numbers"),
        (
            dict(first_P="1 -1"),
            "Varians di dalam P₀ tidak boleh negatif.",
            "No variance in P₀ may be negative.",
        ),
        (
            dict(first_P="1 2; 3 1"),
            "P₀ harus simetris: kovarians ke-1,2 sama dengan yang ke-2,1.",
            "P₀ must be symmetric: its covariance 1,2 is the same as 2,1.",
        ),
        (
            dict(first_P="1 2; 2 1"),
            "P₀ bukan kovarians: korelasi di dalamnya lebih dari 1.",
            "P₀ is no covariance: a correlation in it is larger than 1.",
        ),
        (
            dict(first_x="1e200 0"),
            "Bilangan di dalam x₀ terlalu besar: batasnya 1 × 10¹⁵.",
            "A number in x₀ is too large: the limit is 1 × 10¹⁵.",
        ),
        (dict(pattern=OWN, first_P="1 1 1"), "P₀ memerlukan 2", "P₀ needs 2 variances"),
    ],
)
def test_a_bad_start_is_one_clear_sentence(changes, id, en, bundle):
    said = bundle.evaluate(REFUSED, changes)
    assert id in said[0] and en in said[1] and all(text.endswith(".") for text in said)


def test_a_matrix_without_full_rank_is_a_covariance(bundle):
    """Two states that are surely equal: what is refused is only what cannot be."""
    page = shown(bundle, first_P="1 1; 1 1")
    assert np.isfinite(page["x"]).all()
