"""Chapter 7: its cases as they stand there, against filterpy, statsmodels and the truth."""

import functools
import re

import numpy as np
import pytest
import workshop_lift
from conftest import ROOT
from scipy.optimize import minimize_scalar
from scipy.stats import chi2
from statsmodels.stats.diagnostic import acorr_ljungbox
from workshop_peers import (
    CASES,
    by_filterpy,
    by_statsmodels,
    extended_by_filterpy,
    run_case,
    sources,
    statsmodels_of,
)

from kalman_lib import LinearModel, discretise, kalman_filter

GATE = chi2.ppf(0.999, 1)
GPS = slice(99, None, 100)
case = functools.cache(run_case)


# --- the same numbers as two other libraries ------------------------------------------------------


def peers(name):
    """Our x and P of a case, then those of filterpy and of statsmodels, and the truth (T, n)."""
    c = case(name)
    if name == "bus":
        model = c.found.model
        return (
            (c.kf.x, c.kf.P),
            by_filterpy(model, c.z_bus),
            by_statsmodels(model, c.z_bus),
            c.ride.x,
        )
    if name == "room":
        ours = c.gated
        theirs = by_filterpy(c.room, c.z_room, limit=GATE)
        left = np.where(ours.gated, np.nan, c.z_room)
        return (ours.x, ours.P), theirs, by_statsmodels(c.room, left), c.day.x
    if name == "gps":
        ours, z, u = c.kf, c.z_gps, c.u
        return (ours.x, ours.P), by_filterpy(c.car, z, u), by_statsmodels(c.car, z, u), c.trip.x
    return battery_peers(c)


def battery_peers(c):
    """statsmodels gets the tangents that filterpy has found."""
    model, z, u = c.battery(0.5, 0.3**2), c.use.z, c.u
    x, P, H, h, x_pred = extended_by_filterpy(model, c.f, c.h, c.H_of, c.F_of, z, u)
    offset = h - np.einsum("kij,kj->ki", H, x_pred)
    drawn = -10 / 7200 * u  # what the current takes out, a shift of the state
    linear = LinearModel(1, 1, Q=model.Q, R=model.R, x0=model.x0, P0=model.P0, B=1)
    theirs = by_statsmodels(linear, z, drawn, H=H, offset=offset)
    return (c.kf.x, c.kf.P), (x, P), theirs, c.use.x


@functools.cache
def compared(name):
    return peers(name)


FOUR = ("bus", "room", "battery", "gps")


@pytest.mark.parametrize("name", FOUR)
def test_a_case_is_that_of_filterpy_and_statsmodels(name):
    (x, P), *others, _ = compared(name)
    for x_other, P_other in others:
        assert np.abs(x - x_other).max() < 1e-8 * np.abs(x).max()
        assert np.abs(P - P_other).max() < 1e-8 * np.abs(P).max()


@pytest.mark.parametrize("name", FOUR)
def test_the_truth_lies_inside_the_bands(name):
    """Of one run: errors that hang together in time, so the share scatters around 95 %."""
    (x, P), _, _, truth = compared(name)
    inside = np.abs(truth - x) < 2 * np.sqrt(np.einsum("kii->ki", P))
    assert inside.mean(axis=0).min() > 0.9


DEEPER = (ROOT / "notebooks" / "07_workshop_deeper.ipynb").read_text(encoding="utf-8")
ROW = re.compile(r"\| ([\w/]+) \| [^|]+ \| ([\d.,]+) \| ([\d.,]+) \| ([\d.,]+) \|")
NAMES = dict(bus="bus", suhu="room", temperature="room", GPS="gps")
NAMES |= dict(baterai="battery", battery="battery")


def test_the_table_of_errors_prints_what_all_three_find():
    found = {}
    for name, *printed in ROW.findall(DEEPER):
        found.setdefault((NAMES[name], "," in printed[0]), []).append(printed)
    assert len(found) == 2 * len(FOUR)
    for (name, _), rows in found.items():
        *three, truth = compared(name)
        for column, (x, _) in enumerate(three):
            rmse = np.sqrt(np.mean((truth - x) ** 2, axis=0))
            printed = [row[column].replace(",", ".") for row in rows]
            digits = [len(text.partition(".")[2]) for text in printed]
            assert [f"{e:.{d}f}" for e, d in zip(rmse, digits)] == printed


# --- the judges -----------------------------------------------------------------------------------


def judged(y, S, lags=10):
    """Mean NIS, the ends of its band, and p of Ljung and Box of the first sensor, by others."""
    heard = np.isfinite(y)
    total = sum(y[k, m] @ np.linalg.solve(S[k][np.ix_(m, m)], y[k, m]) for k, m in enumerate(heard))
    N = heard.sum()
    first = (y[:, 0] / np.sqrt(S[:, 0, 0]))[heard[:, 0]]
    p = acorr_ljungbox(first, lags=[lags]).lb_pvalue.iloc[0]
    return total / N, chi2.ppf(0.025, N) / N, chi2.ppf(0.975, N) / N, p


def innovations(name):
    c = case(name)
    kf = c.gated if name == "room" else c.kf
    return (kf.y[GPS], kf.S[GPS]) if name == "gps" else (kf.y, kf.S)


@pytest.mark.parametrize("name", [*FOUR, "lift"])
def test_both_judges_let_the_filter_go(name):
    mean, low, high, p = judged(*innovations(name))
    assert low < mean < high
    assert p > 0.01


@pytest.mark.parametrize("name", ["bus", "battery", "gps"])
def test_our_judge_says_the_same(name, capsys):
    y, S = innovations(name)
    case(name).judge(y, S)
    mean, low, high, _, p = map(float, re.findall(r"-?\d+\.\d+", capsys.readouterr().out))
    expected = judged(y, S)
    assert (mean, low, high) == pytest.approx(expected[:3], abs=0.006)
    assert p == pytest.approx(expected[3], abs=0.001)  # no gaps in the first sensor


WRONG = {  # (Q, R) of a filter whose truth is (1, 1) -> what the table of the chapter says
    (0.05, 1): ("NIS > 1", "late"),
    (1, 0.05): ("NIS > 1", "trembles"),
    (1, 20): ("NIS < 1", "late"),
    (20, 1): ("NIS < 1", "trembles"),
    (0.2, 0.2): ("NIS > 1", "white"),
    (5, 5): ("NIS < 1", "white"),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_the_table_of_tuning_points_the_right_way(wrong):
    rng = np.random.default_rng(7)
    z = np.cumsum(rng.normal(size=20_000)) + rng.normal(size=20_000)
    result = kalman_filter(LinearModel(1, 1, *wrong, x0=0, P0=1), z)
    y = result.y[100:, 0]
    size = "NIS > 1" if np.mean(y**2 / result.S[100:, 0, 0]) > 1 else "NIS < 1"
    r1 = np.corrcoef(y[1:], y[:-1])[0, 1]
    direction = "late" if r1 > 0 else "trembles"
    assert (size, "white" if abs(r1) < 0.03 else direction) == WRONG[wrong]


# --- Q, the gate, the project ---------------------------------------------------------------------


@pytest.mark.parametrize("order", (1, 2, 3))
def test_the_noise_of_the_patterns_is_that_of_bar_shalom(order):
    """Bar-Shalom, Li and Kirubarajan (2001), (6.2.2-4) and (6.2.3-4), and a random walk."""
    dt, q = 0.7, 0.3
    full = q * np.array([
        [dt**5 / 20, dt**4 / 8, dt**3 / 6],
        [dt**4 / 8, dt**3 / 3, dt**2 / 2],
        [dt**3 / 6, dt**2 / 2, dt],
    ])  # fmt: skip
    _, Q = discretise(np.eye(order, k=1), np.diag([0] * (order - 1) + [q]), dt)
    assert Q == pytest.approx(full[3 - order :, 3 - order :], rel=1e-12)


def test_the_file_of_the_lift_is_the_made_up_ride():
    stored = workshop_lift.LIFT.read_text(encoding="utf-8")
    assert stored == workshop_lift.text()
    assert "Sintetis" in stored and "Synthetic" in stored


def test_the_gate_finds_the_outliers_of_the_lift_and_nothing_else():
    *_, outliers = workshop_lift.ride(np.random.default_rng(2))
    gated = np.flatnonzero(case("lift").kf.gated[:, 0]) + 1
    assert gated.tolist() == sorted(outliers)


def test_the_random_walk_in_the_lift_is_convicted_and_its_q_is_that_of_statsmodels():
    c = case("lift")
    kf = kalman_filter(c.lift(0.1), c.z[1:], gate=0.999)
    clean = np.where(kf.gated, np.nan, c.z[1:, np.newaxis])

    def cost(log_q):
        return -statsmodels_of(c.lift(np.exp(log_q)), clean).ssm.loglike()

    best = minimize_scalar(cost, bounds=(-8, 3), method="bounded", options={"xatol": 1e-8})
    q = c.kf.Q[5, 1, 1] / c.dt[5]
    assert q == pytest.approx(np.exp(best.x), rel=1e-4)
    assert judged(c.late.y, c.late.S)[3] < 1e-6


def test_the_lift_is_as_fast_as_it_was_made():
    c = case("lift")
    speed, sigma = c.smooth.x[c.k, 1], np.sqrt(c.smooth.P[c.k, 1, 1])
    assert abs(speed - workshop_lift.SPEED) < 2 * sigma < 0.4
    inside = np.abs(c.truth[1:] - c.kf.x[:, 0]) < 2 * np.sqrt(c.kf.P[:, 0, 0])
    assert inside.mean() > 0.9


@pytest.mark.parametrize("name", FOUR)
def test_a_case_has_at_most_25_short_lines_and_needs_no_paper(name):
    code = sources()
    lines = [line for cell in CASES[name] for line in code[cell].splitlines() if line.strip()]
    assert len(lines) <= 25 and max(map(len, lines)) <= 46
    assert "kalman_lib.papers" not in "".join(code.values())
