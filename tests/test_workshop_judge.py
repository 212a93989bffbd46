"""The builder of chapter 7 finds the noise, judges the filter, and says in words what is wrong."""

import numpy as np
import pytest
from conftest import ROOT
from workshop_helpers import OWN, as_text, own_data, pasted, shown

from kalman_lib import LinearModel, discretise, fit, kalman_filter, nis, whiteness
from kalman_lib.data import read_table
from kalman_lib.papers import workshop

Params = workshop.Params
AGREE = 1e-5  # of a noise: so near are the page and tuning.fit
CASES = {
    "constant": dict(pattern=1),
    "walk": dict(pattern=2, q=1),
    "velocity": dict(pattern=3),
    "velocity, uneven": dict(pattern=3),
    "acceleration": dict(pattern=4, q=1e-3),
    "own": dict(pattern=OWN, q=0.1),
    "walk, two sensors": dict(pattern=2, second=2, q=1),
    "velocity, its sensor and bias": dict(pattern=3, second=3, bias=1),
    "walk, input and bias": dict(pattern=2, second=5, bias=1, q=1),
}


def in_python(about, data, names):
    """tuning.fit of the same model to the same data."""
    p = Params(**about)
    has_two = p.second in (2, 3, 4)
    z = np.column_stack([data["z"], data["w"]]) if has_two else data["z"]
    u = data["w"] if p.second == 5 else None
    dt = np.diff(data["t"])
    dt = np.append(np.median(dt), dt)
    known = data["z"][np.isfinite(data["z"])]
    start = {"x0": float(known[0]), "P0": float(np.ptp(known) ** 2)}
    if p.pattern == OWN:
        start = {"x0": 0.0, "P0": float(100 * np.max(known**2))}

    def build(**noise):
        values = {**about, **start, **noise}
        return workshop.model(Params(**values), None if p.pattern == OWN else dt)

    return fit(build, {name: getattr(p, name) for name in names}, z, u)


@pytest.mark.parametrize("name", CASES)
def test_the_most_likely_noise_is_that_of_tuning_fit(name, bundle):
    about = CASES[name]
    data = own_data(Params(**about), steps=200, uneven="uneven" in name, gaps=True)
    page = shown(bundle, **about, likely=True, **pasted(data))
    found = in_python(about, data, list(page["found"]))
    assert found.at_bound == ()
    for noise, value in found.values.items():
        assert page["found"][noise] == pytest.approx(value, rel=AGREE), noise


def test_without_process_noise_the_page_says_so(bundle):
    """Up and down around a straight line: tuning.fit stops at the bound of q."""
    t = np.arange(100.0)
    data = {"t": t, "z": 2 * t + np.where(t % 2 == 0, 1, -1)}

    def line(q, R):
        F, Q = discretise([[0, 1], [0, 0]], np.diag([0, q]), 1)
        return LinearModel(F=F, H=[[1, 0]], Q=Q, R=R, x0=[1, 0], P0=4e4 * np.eye(2))

    assert fit(line, {"q": 0.01, "R": 9}, data["z"]).at_bound == ("q",)
    page = shown(bundle, pattern=3, search=True, q=10, R=1, **pasted(data))
    assert "q is too large: this data can do without it." in page["verdict"]


def test_the_numbers_of_the_judgement_are_those_of_python(bundle):
    about = dict(pattern=3, second=2)
    data = own_data(Params(**about), gaps=True, steps=120)
    page = shown(bundle, **about, **pasted(data))
    y, S = page["y"][2:], page["S"].reshape(-1, 2, 2)[2:]
    assert page["nis"] == pytest.approx(np.nansum(nis(y, S)) / np.isfinite(y).sum(), rel=1e-9)
    e = y / np.sqrt(np.einsum("kii->ki", S))
    theirs = whiteness(e)
    for i, ours in enumerate(page["white"]):
        np.testing.assert_allclose(ours["correlation"], theirs.correlation[:, i], rtol=1e-9)
        assert ours["p"] == pytest.approx(theirs.p[i], rel=1e-6, abs=1e-12)
        assert ours["band"] == pytest.approx(theirs.band[i], rel=1e-12)


# --- the verdict --------------------------------------------------------------------------------


def verdict(bundle, data, **state):
    return shown(bundle, search=True, **state, **pasted(data))["verdict"]


@pytest.fixture(scope="module")
def track():
    return own_data(Params(), steps=400)  # q 0.01, R 9


def test_a_right_filter_passes(bundle, track):
    assert verdict(bundle, track).startswith("The filter passes")


@pytest.mark.parametrize(
    "state, words",
    [
        (dict(R=3), ["too sure", "R is about three times too small."]),
        (dict(R=90), ["too cautious", "R is about ten times too large."]),
        (dict(q=1e-5), ["too sure", "q is about 500 times too small."]),
        (dict(q=1e-7), ["too sure", "q is more than a thousand times too small."]),
        (dict(q=2), ["q is about", "times too large."]),
    ],
)
def test_what_is_wrong_with_the_noise_is_named(state, words, bundle, track):
    said = verdict(bundle, track, **state)
    assert all(part in said for part in words) and not said.startswith("The filter passes")


def test_a_noise_far_from_the_likely_one_is_named_although_both_tests_pass(bundle):
    said = shown(bundle, search=True, q=1)["verdict"]  # the made-up data of the page, q 0.01
    assert "another noise is far more likely. q is about 100 times too large." in said


def test_outliers_are_named_and_the_gate_mends_them(bundle):
    data = own_data(Params(), outliers=True, steps=200)
    assert "are far larger than the others: try the gate" in verdict(bundle, data)
    said = verdict(bundle, data, gate=True)
    assert said.startswith("The filter passes") and "left out 14 of 200 measurements" in said


def test_a_gate_that_leaves_out_too_much_is_named(bundle):
    """A ramp seen by a filter that holds it for a constant: the gate keeps it from learning."""
    rng = np.random.default_rng(1)
    data = {"t": np.arange(100.0), "z": np.arange(100.0) + rng.normal(0, 0.1, 100)}
    said = verdict(bundle, data, pattern=1, R=0.01, gate=True)
    assert said.startswith("The gate leaves too much out")


def test_a_pattern_that_does_not_suit_is_named(bundle):
    """A swing of 12 samples, seen by a random walk: no noise makes its innovations white."""
    rng = np.random.default_rng(1)
    t = np.arange(300.0)
    data = {"t": t, "z": 10 * np.sin(2 * np.pi * t / 12) + rng.normal(0, 0.5, 300)}
    for state in (dict(pattern=2, likely=True), dict(pattern=3, likely=True)):
        assert "try another pattern" in verdict(bundle, data, **state)

    said = verdict(bundle, data, pattern=2, R=10)
    assert "try another pattern" in said and "R is" not in said  # R is not to blame


def test_outliers_are_named_although_a_noise_fitted_to_them_passes(bundle):
    """The lift of the chapter: five readings are metres off, and R may well be made large."""
    table = read_table(ROOT / "notebooks/data/lift.csv", missing=-999)
    t, z, _ = table.series()
    said = verdict(bundle, {"t": t, "z": z}, likely=True)
    assert said.startswith("With the most likely noise the filter passes")
    assert "is no proof" in said and "innovations are far larger than the others" in said
    assert "5 of" in verdict(bundle, {"t": t, "z": z}, likely=True, gate=True)


def test_few_measurements_are_not_judged(bundle):
    data = {"t": np.arange(10.0), "z": [1.0, 2, 1, 2, 1, 3, 1, np.nan, np.nan, np.nan]}
    data["z"] = np.array(data["z"])
    assert "too few measurements" in verdict(bundle, data, pattern=2)


# --- what is refused ----------------------------------------------------------------------------

REFUSED = """([kind, given]) => {
  const { papers, input } = KalmanExplorers;
  try {
    return JSON.stringify(papers.workshop.readMatrices(...given));
  } catch (error) {
    if (!(error instanceof input.InputError)) throw error;
    return [error.id, error.en];
  }
}"""


@pytest.mark.parametrize(
    "F, H, id, en",
    [
        ("", "1", "F masih kosong.", "F is still empty."),
        ("1 2; 3", "1 0", "Baris ke-2 dari F berisi 1", "Row 2 of F has 1 numbers"),
        ("1 2; 3 a", "1 0", "“a” di dalam F", "“a” in F is not a number."),
        ("1 2 3; 4 5 6", "1 0 0", "F harus persegi: sekarang 2 baris", "F must be square"),
        (
            "1 0; 0 1",
            "1 0 0",
            "H harus mempunyai 2 kolom",
            "H must have 2 columns, like F: it has 3.",
        ),
        ("1", "1;1;1", "H berisi 3 baris", "H has 3 rows"),
        (";".join(["1 " * 7] * 7), "1", "F berisi 7 keadaan", "F has 7 states"),
        ("[[1, x]]", "1", "“x” di dalam F", "“x” in F"),
    ],
)
def test_bad_matrices_are_one_clear_sentence(F, H, id, en, bundle):
    said = bundle.evaluate(REFUSED, ["", [F, H]])
    assert id in said[0] and en in said[1] and all(text.endswith(".") for text in said)


@pytest.mark.parametrize(
    "text, rows",
    [
        ("1 0.5\n0 1", [[1, 0.5], [0, 1]]),
        ("1 0,5; 0 1", [[1, 0.5], [0, 1]]),
        ("1, 0.5\n0, 1\n", [[1, 0.5], [0, 1]]),
        ("[[1, 0.5], [0, 1]]", [[1, 0.5], [0, 1]]),
        ("[[1,0.5],\n [0,1]]", [[1, 0.5], [0, 1]]),
        ("1\t-2e-3\n0\t1", [[1, -0.002], [0, 1]]),
    ],
)
def test_matrices_may_be_typed_in_many_ways(text, rows, bundle):
    call = "text => KalmanExplorers.papers.workshop.readMatrices(text, '1 0').F"
    assert bundle.evaluate(call, text) == rows


def test_data_that_cannot_be_used_is_refused_in_a_sentence(bundle):
    t, z = np.arange(12.0), np.arange(12.0)
    for state, columns, sentence in (
        (dict(second=2), {"t": t, "z": z}, "This table has no second column"),
        (dict(second=2, third=1), {"t": t, "z": z, "w": z}, "This table has no third column"),
        ({}, {"t": np.where(t == 6, 0, t), "z": z}, "the time goes back"),
        ({}, {"t": t[:5], "z": z[:5]}, "at least ten rows"),
    ):
        with pytest.raises(Exception, match=sentence):
            shown(bundle, **state, **pasted(columns))


# --- what is brought ----------------------------------------------------------------------------


def test_dates_become_days(bundle):
    days = "\n".join(f"2024-03-{day:02};{20 + day % 3}" for day in range(1, 25))
    page = shown(bundle, text=f"tanggal;suhu\n{days}")
    np.testing.assert_allclose(page["t"], np.arange(24), atol=1e-9)
    assert "suhu" in page["note"] and "tanggal (d)" in page["note"]


def test_a_code_for_missing_is_a_gap_and_equal_times_are_averaged(bundle):
    rows = [(k, 5.5 + k % 2) for k in range(12)] + [(12, -999), (13, 6), (13, 8)]
    text = "# logger 7\nt (s),z (m)\n" + "\n".join(f"{t},{z}" for t, z in rows)
    page = shown(bundle, pattern=2, text=text)
    assert np.isnan(page["y"][12, 0]) and len(page["x"]) == 14
    assert page["y"][13, 0] + page["x"][12, 0] == pytest.approx(7)


def test_a_recording_of_the_phone_is_a_table(bundle):
    T = 40
    t = np.cumsum(np.full(T, 0.02))
    acc = np.arange(3.0 * T)
    motion = dict(T=T, t=(t - t[0]).tolist(), acc=acc.tolist(), gyr=(-acc).tolist(), live=False)
    page = shown(bundle, pattern=2, motion=motion)
    z = page["y"][1:, 0] + page["x"][:-1, 0]
    np.testing.assert_allclose(z, acc[3::3], rtol=1e-9)  # acc x
    page = shown(bundle, pattern=2, second=2, motion=motion, axis="acc z", value2="gyr y")
    np.testing.assert_allclose(page["y"][1:, 0] + page["x"][:-1, 0], acc[5::3], rtol=1e-9)
    np.testing.assert_allclose(page["y"][1:, 1] + page["x"][:-1, 0], -acc[4::3], rtol=1e-9)


def test_a_scalar_model_agrees_with_a_hand_made_one(bundle):
    """Beside the module itself: the random walk with a known input, by the core alone."""
    data = own_data(Params(pattern=2, second=5, q=1))
    page = shown(bundle, pattern=2, second=5, q=0.5, R=4, **pasted(data))
    z, u = data["z"], data["w"]
    model = LinearModel(F=1, B=1, H=1, Q=0.5, R=4, x0=z[0], P0=np.ptp(z) ** 2)
    np.testing.assert_allclose(page["x"], kalman_filter(model, z, u).x, rtol=1e-9, atol=1e-9)
    assert as_text(data).startswith("t;z;w\n")
