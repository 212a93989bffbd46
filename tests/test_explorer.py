"""explore() without a browser: what Python knows of an explorer, and what it refuses."""

import importlib
import subprocess
import sys

import conftest  # noqa: F401  (the build's own modules can be imported)
import explorers
import numpy as np
import pytest
from conftest import ROOT
from explorer_helpers import PAPERS

explorers.for_notebooks()

from kalman_lib import explorer as room  # noqa: E402  (it needs what was just made)
from kalman_lib.explorer import explore  # noqa: E402
from kalman_lib.live import made  # noqa: E402
from kalman_lib.papers import gyro, smoother, theory  # noqa: E402


@pytest.mark.parametrize("paper", PAPERS)
def test_every_paper_can_be_explored(paper):
    e = explore(paper)
    module = importlib.import_module(f"kalman_lib.papers.{paper}")
    assert e.paper == paper and type(e.params) is module.Params
    assert e.state == e.start and "seed" in e.state


def test_params_and_state_are_one():
    p = gyro.Params(sigma_w=5)
    e = explore("gyro", p)
    assert e.params == p and e.view == "flight"
    e.state = {"seed": 7, "sigma_v": np.float64(3)}
    assert e.params == gyro.Params(sigma_w=5, sigma_v=3) and e.state["seed"] == 7
    e.params = gyro.Params()
    assert e.params == gyro.Params() and e.state["seed"] == 7
    assert e.start["sigma_w"] == 5  # where "start again" leads


def test_a_view_starts_with_its_own_settings():
    e = explore("smoother", view="online")
    assert e.params == smoother.Params(Q=1e-3, R=0.09, P0=1000)
    assert explore("smoother", smoother.Params(), view="online").params == smoother.Params()
    e.state = {"typed": np.array([1.5, np.nan])}
    assert e.state["typed"] == [1.5, None]  # as JSON can hold it


@pytest.mark.parametrize(
    "wrong, kind, en, id",
    [
        (lambda: explore("rocket"), ValueError, "no explorer is called", "tidak ada penjelajah"),
        (lambda: explore("gyro", view="map"), ValueError, "has no view", "tidak punya tampilan"),
        (lambda: explore("gyro", theory.Params()), TypeError, "is needed", "diperlukan"),
        (lambda: explore("gyro", gyro.Params(T=-1)), ValueError, "accepted are", "diterima"),
        (lambda: setattr(explore("gyro"), "state", {"sigma": 1}), ValueError, "unknown", "dikenal"),
        (lambda: setattr(explore("gyro"), "state", {"T": 0}), ValueError, "accepted", "diterima"),
    ],
)
def test_what_makes_no_sense_is_refused_in_both_languages(wrong, kind, en, id):
    with pytest.raises(kind, match=en) as error:
        wrong()
    assert id in str(error.value)


def test_a_package_without_its_explorers_says_how_to_make_them(tmp_path, monkeypatch):
    monkeypatch.setattr(made, "BUNDLE", tmp_path)
    monkeypatch.setattr(room, "made", made.made.__wrapped__)
    with pytest.raises(FileNotFoundError, match="run `make explorers`.*jalankan `make explorers`"):
        explore("gyro")


def test_importing_starts_no_widget():
    code = "import kalman_lib.explorer, ipywidgets.widgets.widget as w; print(len(w._instances))"
    out = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert out.stdout.split() == ["0"] and out.stderr == ""
