"""The quick drawings of the widgets: they show what matplotlib shows, at the places where it shows it."""
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from kalman_lib import plots
from kalman_lib.sketch import Axes, tick_words, ticks

RNG = np.random.default_rng(0)
T = np.arange(1, 101)
FIGURES = {
    "series": lambda: plots.series(T, z=RNG.normal(size=100), x=np.sin(T / 9), sigma=0.2 + 0 * T, truth=np.cos(T / 9),
                                   rivals={"MA(3)": np.sin(T / 8)}, names={"x": r"$x_{\mathrm{pred},1}$"}, ylabel="m/s"),
    "curve": lambda: plots.curve({r"$\sigma_\theta$": (T, T ** 2.0)}, "$t$ (s)", r"$\sigma\,/\,\sigma_0$",
                                 points={"<a&b>": (10, 100)}, ylim=(0, None)),
    "gaussians": lambda: plots.gaussians({"$z$": (1.0, 0.5, plots.MEASUREMENT), "$x_1$": (2.0, 0.1, plots.ESTIMATE)}),
    "ellipses": lambda: plots.ellipses({"$x_0$": (np.array([0, 5]), np.diag([0.01, 1]), plots.PREDICTION)}, z=2.2, R=0.05),
    "contours": lambda: plots.contours(T[:30] / 10.0, T[:30] / 10.0, np.add.outer(T[:30], 2.0 * T[:30]), r"$\sigma_w$", r"$\sigma_v$",
                                       (20, 50, 80), {r"$c\,\sigma$": (2, 1)}),
    "poles": lambda: plots.poles({"$p$": np.array([0.5 + 0.5j, 0.9])}),
    "craft": lambda: plots.craft({"0 s": ((0.1, -0.2, 1.0), (0, 0, 1.0))}),
}


def sketch(name):
    with plots.live():
        return FIGURES[name]()


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_of_a_widget_is_well_formed_svg_without_nan(name):
    svg = sketch(name).svg()
    ET.fromstring(svg)
    assert "nan" not in svg and "inf" not in svg and "$" not in svg and "\\" not in svg
    assert isinstance(FIGURES[name](), plots.Figure)        # outside the block: matplotlib as ever


@pytest.mark.parametrize("name", ["series", "curve", "contours", "gaussians", "ellipses"])
def test_the_legend_and_the_axes_say_what_matplotlib_says(name):
    words = re.sub(r"\s|\u200b|\u2009", "", "".join(ET.fromstring(sketch(name).svg()).itertext()))
    ax = FIGURES[name]().axes[0]
    labels = [ax.get_xlabel(), ax.get_ylabel(), *ax.get_legend_handles_labels()[1]]
    assert len(labels) > 2
    for label in labels:
        plain = re.sub(r"\\mathrm|\\,|[${}_\s]", "", label.replace(r"\sqrt", "√").replace(r"\pm", "±")
                       .replace(r"\sigma", "σ").replace(r"\theta", "θ"))
        assert plain in words, label


def test_a_map_is_dark_where_its_values_are_large_and_numbers_its_levels():
    values = np.add.outer(T[:30], 2.0 * T[:30])                         # 3 ... 90: 20, 50 and 80 are passed on the diagonal
    svg = sketch("contours").svg()
    areas = {}
    for path, opacity in re.findall(r'<path d="([^"]+)" fill="#1f6fb4" fill-opacity="([\d.]+)"', svg):
        rectangles = re.findall(r"M(-?\d+) (-?\d+)H(-?\d+)V(-?\d+)H", path)
        areas[float(opacity)] = sum(abs((int(c) - int(a)) * (int(d) - int(b))) for a, b, c, d in rectangles)
    share = np.array([areas[key] for key in sorted(areas)]) / sum(areas.values())
    cells = [((values >= low) & (values < high)).sum() for low, high in ((20, 50), (50, 80), (80, 999))]
    assert share == pytest.approx(np.array(cells) / sum(cells), abs=0.02)
    for level in ("20", "50", "80"):
        assert f">{level}</text>" in svg


def test_lines_stand_where_the_axes_say():
    """The corners of a line from (0, 0) to (10, 5) on axes with these limits, and the grid at 2."""
    ax = Axes()
    ax.set(xlim=(0, 10), ylim=(0, 5))
    ax.plot([0, 10], [0, 5], color="#123456")
    svg = ax.svg(480, 300)
    w, h = map(float, re.search(r'<svg width="([\d.]+)" height="([\d.]+)"', svg).groups())
    assert f'd="M0.0 {h:.1f} {w:.1f} 0.0"' in svg
    assert f"M{w / 5:.1f} 0V{h:.1f}" in svg


def test_a_gap_interrupts_a_line_and_hides_a_dot():
    ax = Axes()
    ax.plot([0, 1, 2, 3], [0, np.nan, 2, 3], color="#123456")
    ax.plot([0, 1, 2, 3], [0, np.nan, 2, 3], "o", color="#654321")
    svg = ax.svg(480, 300)
    line = re.search(r'd="([^"]*)" stroke="#123456"', svg)[1]
    dots = re.search(r'd="([^"]*)" stroke="#654321"', svg)[1]
    assert line.count("M") == 2 and dots.count("M") == 3


@pytest.mark.parametrize("gap", [False, True])
@pytest.mark.parametrize("mark", ["", "o"])
@pytest.mark.parametrize("length", [601, 1261, 3000, 100_000])
def test_a_long_series_keeps_its_peaks(length, mark, gap):
    y = np.zeros(length)
    y[length // 2] = 7.0
    if gap:
        y[length // 2 - 1] = np.nan
    ax = Axes()
    ax.plot(np.arange(len(y)), y, mark, color="#123456")
    svg = ax.svg(480, 300)
    assert len(svg) < 40_000
    places = re.search(r'd="([^"]*)" stroke="#123456"', svg)[1].replace("h0", "").replace("M", " ").split()
    heights = np.array(places[1::2], dtype=float)
    assert heights.min() < 0.06 * heights.max()


@pytest.mark.parametrize("low, high, most, expected", [
    (0, 20, 5, [0, 5, 10, 15, 20]), (-0.51, -0.26, 6, [-0.5, -0.45, -0.4, -0.35, -0.3]), (0, 0.9, 10, np.arange(10) / 10), (3, 3, 5, [])])
def test_ticks_are_round(low, high, most, expected):
    assert np.allclose(ticks(low, high, most), expected)


def test_a_logarithmic_axis_is_left_to_matplotlib():
    with plots.live():
        assert isinstance(plots.curve({"$y$": (T, T)}, "$x$", "$y$", log=True), plots.Figure)


def test_a_live_figure_inside_another_ends_only_itself():
    with plots.live():
        with plots.live():
            pass
        figure = plots.plane({}, {"$a$": (T, T)}, {name: (1, 1) for name in "abcd"}, "$x$", "$y$")
        assert figure.svg().count("<path") > 4
        assert "<path" in plots.poles({name: np.array([0.5j]) for name in "abcde"}).svg()
        assert "<path" in plots.surface(T, T, -np.outer(T, T), "$Q$", "$R$", best=np.array([1, 2])).svg()


def test_the_words_of_ticks():
    assert [tick_words(v, [-0.5, 0.0, 0.5]) for v in (-0.5, 0.0, 0.5)] == ["−0.5", "0.0", "0.5"]
    assert tick_words(2e6, [0, 2e6]) == "2e+06"


def test_words_are_escaped():
    with plots.live():
        svg = plots.series(T, x=1.0 * T, names={"x": "<script>"}).svg()
    assert "<script>" not in svg and "&lt;script&gt;" in svg
