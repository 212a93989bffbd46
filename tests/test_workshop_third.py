"""A third column in the workshop: a known input beside two sensors."""

import itertools

import numpy as np
import pytest
from test_workshop_code import close, run
from workshop_helpers import own_data, pasted, shown

from kalman_lib import kalman_filter
from kalman_lib.papers import workshop

CASES = [
    dict(pattern=pattern, second=second, bias=bias, third=1, q={2: 1, 3: 0.01, 4: 1e-5}[pattern])
    for pattern, second, bias in itertools.product((2, 3, 4), (2, 3, 4), (0, 1))
    if not (second in (3, 4) and pattern < second)
]


@pytest.mark.parametrize("about", CASES, ids=lambda about: "-".join(map(str, about.values())))
def test_two_sensors_and_a_known_input(about, bundle, tmp_path, monkeypatch):
    """The page, the module, and both programs, to 1e-9; the third column is scaled, too."""
    data = own_data(workshop.Params(**about), uneven=True, gaps=True)
    page = shown(bundle, **about, factor3=0.5, **(pasted(data | {"v": 2 * data["v"]})))
    dt = np.diff(data["t"])
    dt = np.append(np.median(dt), dt)
    spread = np.nanmax(data["z"]) - np.nanmin(data["z"])
    start = dict(x0=float(data["z"][0]), P0=float(spread**2))
    model = workshop.model(workshop.Params(**about, **start), dt)
    z = np.column_stack([data["z"], data["w"]])
    result = kalman_filter(model, z, data["v"])
    sigma = np.sqrt(result.P[-1].diagonal())
    size = np.abs(result.x).max(axis=0)
    ours = run(page["kalman"], page["csv"], tmp_path, monkeypatch)["result"]
    theirs = run(page["filterpy"], page["csv"], tmp_path, monkeypatch)
    for x in (result.x, ours.x, np.array(theirs["x"])):
        close(page["x"], x, size)
    for P in (result.P, ours.P):
        close(page["P"], P, np.outer(sigma, sigma))
    assert page["note"].startswith("Filtered are z and w; the input is v; their times are t")


def test_without_a_second_sensor_the_third_column_is_not_used(bundle):
    data = own_data(workshop.Params(pattern=3, second=3, third=1), gaps=True)
    plain = shown(bundle, pattern=3, **pasted(data))
    other = shown(bundle, pattern=3, third=1, **pasted(data))
    np.testing.assert_array_equal(plain["x"], other["x"])


def test_the_input_moves_the_quantity_in_made_up_data():
    """It swings by ten standard deviations of its sensor, and both sensors see it."""
    p = workshop.Params(pattern=3, second=2, third=1, q=1e-9, R=1, R2=1)
    made = workshop.simulate(p, np.random.default_rng(1))
    x = made.x[:, 0] - np.polyval(np.polyfit(np.arange(100), made.x[:, 0], 1), np.arange(100))
    assert made.u.shape == (100, 1) and 8 < np.ptp(x) / 2 < 12
    assert np.abs(made.z - made.x[:, :1]).max() < 5
