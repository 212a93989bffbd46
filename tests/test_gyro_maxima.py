"""Chapter 3: the eight maxima that the paper prints, against 20,000 simulated runs."""

from math import erf, sqrt

import numpy as np
import pytest
from gyro_cases import PAPER, RUNS, case, fly

from kalman_lib import plots
from kalman_lib.papers import gyro


@pytest.fixture(scope="module")
def largest():
    """figure -> (2, RUNS) largest errors of every run."""
    return {figure: gyro.maxima(*fly(case(figure), seed=figure, runs=RUNS)) for figure in PAPER}


def test_measurement_maxima_follow_their_exact_law(largest):
    """200 independent Gaussian errors: P(max < a) = (2 Phi(a / sigma) - 1)^200."""
    for figure, (_, sigma_v, printed, _) in PAPER.items():
        exact = erf(printed / sigma_v / sqrt(2)) ** 200
        spread = sqrt(exact * (1 - exact) / RUNS)
        assert gyro.ranks(largest)[figure][0] == pytest.approx(exact, abs=4 * spread)
        assert 0.005 < exact < 0.995  # all four inside the 99 % interval, by mathematics
    assert 0.005 < erf(2.3 / sqrt(2)) ** 200 < 0.025  # 23 rad: outside the 95 % interval


def test_the_eight_printed_maxima_against_20000_runs(largest):
    rank = np.concatenate(list(gyro.ranks(largest).values()))
    assert ((0.005 < rank) & (rank < 0.995)).sum() == 8
    inside = (0.025 < rank) & (rank < 0.975)
    assert inside.sum() == 7 and not inside[4]  # the one outside: 23 rad of Figure 6


def test_the_intervals_are_those_computed_independently(largest):
    """FACTS.md, another program and other random numbers: 95 % intervals of both maxima."""
    known = {
        4: (23.6, 38.1, 5.7, 11.3),
        5: (2.36, 3.81, 1.83, 3.02),
        6: (23.6, 38.1, 0.83, 2.84),
        7: (2.36, 3.81, 0.57, 1.13),
    }
    for figure, interval in known.items():
        ours = np.quantile(largest[figure], (0.025, 0.975), axis=1).T.ravel()
        assert ours == pytest.approx(interval, rel=0.02)


def test_the_table_marks_inside_outside_and_between(largest):
    own = {figure: gyro.maxima(*fly(case(figure))) for figure in PAPER}
    lines = gyro.table(own, largest).splitlines()
    assert len(lines) == 9 and max(map(len, lines)) <= 44
    assert [line.split()[2] for line in lines[1:]] == "28 6 3.2 2.3 23 2 3 0.8".split()
    assert [float(line.split()[3]) for line in lines[1:]] == [
        round(value, 1) for pair in own.values() for value in pair
    ]
    assert [line.split()[-1] for line in lines[1:]] == ["✓"] * 4 + ["(✓)"] + ["✓"] * 3
    sample = {7: np.array([np.linspace(10, 20, 100), np.linspace(0, 1, 100)])}
    assert gyro.table(own, sample).splitlines()[1].endswith("✗")


def test_every_printed_maximum_stands_beside_its_runs(largest):
    rows = gyro.beside_printed(largest)
    printed = [value for values in PAPER.values() for value in values[2:]]
    assert list(rows)[:3] == ["4 $z$", "4 $x$", "5 $z$"] and len(rows) == 8
    assert [value for _, value in rows.values()] == printed
    assert np.array_equal(rows["6 $x$"][0], largest[6][1])


def test_the_figure_has_numbers_between_the_powers_of_ten(largest):
    figure = plots.intervals(gyro.beside_printed(largest), "rad")
    (ax,) = figure.axes
    figure.canvas.draw()
    low, high = ax.get_xlim()
    ticks = [tick for tick in ax.get_xticks() if low <= tick <= high]
    assert ticks == pytest.approx([0.5, 1, 2, 5, 10, 20, 50])
    assert {label.get_fontsize() for label in ax.get_yticklabels()} == {12}
