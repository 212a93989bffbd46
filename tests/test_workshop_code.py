"""The builder of chapter 7 hands over programs, and they compute what the page shows."""

import itertools

import numpy as np
import pytest
from workshop_helpers import OWN, own_data, pasted, shown

from kalman_lib import kalman_filter
from kalman_lib.papers import workshop

Params = workshop.Params
PATTERNS = [
    dict(pattern=pattern, second=second, bias=bias, q={1: 1, 2: 1, 3: 0.01, 4: 1e-5}[pattern])
    for pattern, second, bias in itertools.product((1, 2, 3, 4), (1, 2, 3, 4, 5), (0, 1))
    if not (second == 1 and bias) and not (second in (3, 4) and pattern < second)
]
PATTERNS.append(dict(pattern=OWN, q=0.1))
WAYS = [
    {},
    dict(uneven=True),
    dict(gaps=True),
    dict(uneven=True, gaps=True, outliers=True),
]


def close(ours, theirs, scale):
    """Equal to 1e-9, of the value itself or of the scale of its column."""
    allowed = 1e-9 * (np.abs(theirs) + scale)
    assert ours.shape == theirs.shape and (np.abs(ours - theirs) <= allowed).all()


def run(code, csv, folder, monkeypatch):
    """Run a program where its data lies: its names."""
    (folder / "workshop.csv").write_text(csv, encoding="utf-8", newline="")
    monkeypatch.chdir(folder)
    names = {}
    exec(compile(code, "workshop.py", "exec"), names)
    return names


@pytest.mark.parametrize("way", WAYS, ids=lambda way: " ".join(way) or "even")
@pytest.mark.parametrize("about", PATTERNS, ids=lambda about: "-".join(map(str, about.values())))
def test_the_programs_give_the_numbers_of_the_page(about, way, bundle, tmp_path, monkeypatch):
    p = Params(**about)
    gate = bool(way.get("outliers"))
    page = shown(bundle, **about, gate=gate, **pasted(own_data(p, **way)))
    sigma = np.sqrt(page["P"][-1].diagonal())
    result = run(page["kalman"], page["csv"], tmp_path, monkeypatch)["result"]
    close(page["x"], result.x, np.abs(result.x).max(axis=0))
    close(page["P"], result.P, np.outer(sigma, sigma))
    assert np.array_equal(page["gated"], result.gated) and page["gated"].any() == gate
    theirs = run(page["filterpy"], page["csv"], tmp_path, monkeypatch)
    close(page["x"], np.array(theirs["x"]), np.abs(result.x).max(axis=0))
    close(page["P"][-1], theirs["P"][-1], np.outer(sigma, sigma))


def test_the_page_agrees_with_the_module_on_uneven_steps_and_own_matrices(bundle):
    p = Params(pattern=3, second=3, bias=1)
    data = own_data(p, uneven=True, gaps=True)
    page = shown(bundle, pattern=3, second=3, bias=1, **pasted(data))
    dt = np.diff(data["t"])
    dt = np.append(np.median(dt), dt)
    z = np.column_stack([data["z"], data["w"]])
    spread = np.nanmax(data["z"]) - np.nanmin(data["z"])
    start = dict(x0=float(data["z"][0]), P0=float(spread**2))
    result = kalman_filter(workshop.model(Params(pattern=3, second=3, bias=1, **start), dt), z)
    np.testing.assert_allclose(page["x"], result.x, rtol=1e-9, atol=1e-9)
    F, H = np.array([[1, 1], [0, 0.9]]), np.array([[1, 0], [0, 2]])
    text = {"F": "1 1; 0 0,9", "H": "[[1, 0], [0, 2]]"}
    page = shown(bundle, pattern=OWN, **text, **pasted(data))
    P0 = float(100 * np.nanmax(data["z"] ** 2))
    model = workshop.model(Params(pattern=OWN, P0=P0), F=F, H=H)
    np.testing.assert_allclose(page["x"], kalman_filter(model, z).x, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("gaps", [[3, 4, 20], [0, 1], [58, 59]])
def test_a_gap_in_a_known_input_is_no_change_and_is_told(gaps, bundle, tmp_path, monkeypatch):
    """The page, Python with the input that it was before, and both programs."""
    p = Params(pattern=3, second=5, q=0.01)
    data = own_data(p, uneven=True)
    whole = data["w"].copy()
    data["w"][gaps] = np.nan
    for k in sorted(gaps, reverse=gaps[0] == 0):
        whole[k] = whole[k + 1] if gaps[0] == 0 else whole[k - 1]
    page = shown(bundle, pattern=3, second=5, q=0.01, **pasted(data))
    assert f"missing (number of rows: {len(gaps)})" in page["verdict"]
    dt = np.diff(data["t"])
    dt = np.append(np.median(dt), dt)
    spread = np.ptp(data["z"])
    start = Params(pattern=3, second=5, q=0.01, x0=float(data["z"][0]), P0=float(spread**2))
    result = kalman_filter(workshop.model(start, dt), data["z"], whole)
    size = np.abs(result.x).max(axis=0)
    close(page["x"], result.x, size)
    close(page["x"], run(page["kalman"], page["csv"], tmp_path, monkeypatch)["result"].x, size)
    close(page["x"], np.array(run(page["filterpy"], page["csv"], tmp_path, monkeypatch)["x"]), size)


def test_a_known_input_that_is_empty_is_refused(bundle):
    """Its only value has no time."""
    rows = "\n".join(f"{k};{k % 3};" for k in range(20))
    with pytest.raises(Exception, match="The column of the known input is empty"):
        shown(
            bundle,
            pattern=3,
            second=5,
            text=f"t;z;w\n{rows}\n;1;5",
            time="t",
            value="z",
            value2="w",
        )


def test_the_csv_holds_what_went_in_and_what_came_out(bundle, tmp_path):
    p = Params(pattern=2, second=5, q=1)
    data = own_data(p, uneven=True, gaps=True)
    page = shown(bundle, pattern=2, second=5, q=1, factor=-2, **pasted(data))
    path = tmp_path / "a.csv"
    path.write_text(page["csv"], newline="")
    table = np.genfromtxt(path, delimiter=",", names=True)
    np.testing.assert_allclose(table["t"], data["t"] - data["t"][0], rtol=1e-14)
    np.testing.assert_array_equal(table["z"], data["z"])
    np.testing.assert_array_equal(table["u"], -2 * data["w"])
    np.testing.assert_array_equal(table["x_1"], page["x"][:, 0])
    np.testing.assert_array_equal(table["P_1"], page["P"][:, 0, 0])
    np.testing.assert_array_equal(table["y_1"], page["y"][:, 0])
