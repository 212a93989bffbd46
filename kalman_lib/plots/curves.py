"""Curves of one variable: functions, bell curves, histograms of simulated values."""

import numpy as np
from matplotlib.ticker import LogLocator

from .figure import new_figure
from .marks import add_points
from .styles import BAND, ESTIMATE, INK, MEASUREMENT, PALE, PREDICTION, RIVAL, TRUTH

ROW_HEIGHT = 0.62  # of the highest bar of a histogram; the rows are 1 apart


def curve(lines, xlabel, ylabel, log=False, points=None, height=2.8, ylim=None):
    """Curves: a dict of (x, y), and one of points (x, y)."""
    scale = "log" if log else "linear"
    with new_figure(height, xlabel=xlabel, ylabel=ylabel, xscale=scale) as (figure, ax):
        looks = (ESTIMATE, RIVAL, PREDICTION, TRUTH)
        for (label, (x, y)), look in zip(lines.items(), looks):
            ax.plot(x, y, label=label, **look)
        add_points(ax, points, 6)
        if ylim:
            ax.set(ylim=ylim)
    return figure


def gaussians(curves, xlabel="$x$", height=2.8):
    """Bell curves: a dict of (mean, variance, look), look one of the styles."""
    means = np.array([mean for mean, _, _ in curves.values()])
    sigmas = np.array([np.sqrt(variance) for _, variance, _ in curves.values()])
    x = np.linspace((means - 4 * sigmas).min(), (means + 4 * sigmas).max(), 600)
    with new_figure(height, xlabel=xlabel, ylabel="$p$", ylim=(0, None)) as (figure, ax):
        for label, (mean, variance, look) in curves.items():
            bell(ax, x, mean, variance, look, label)
    return figure


def bell(ax, x, mean, variance, look, label=None):
    """One bell curve at x (N,), as a line and a pale area."""
    density = np.exp(-((x - mean) ** 2) / (2 * variance)) / np.sqrt(2 * np.pi * variance)
    color = look["color"]
    linestyle = look.get("linestyle", "none")
    if linestyle == "none":  # the look of dots
        linestyle = "-"
    linewidth = look.get("linewidth", 1.8)
    ax.plot(x, density, label=label, color=color, linewidth=linewidth, linestyle=linestyle)
    ax.fill_between(x, density, color=color, **PALE)


def intervals(samples, xlabel, height=4.2):
    """Single values in simulated distributions: a dict of (samples (N,) > 0, the value to mark).

    On a log axis the histogram, its middle 95 % (thick) and 99 % (thin), and the mark.
    """
    with new_figure(height, xlabel=xlabel) as (figure, ax):
        for row, (values, mark) in enumerate(samples.values()):
            _draw_histogram(ax, row, values)
            _draw_middle(ax, row, values)
            ends = [row - 0.45, row + 0.32]
            ax.plot([mark, mark], ends, color=MEASUREMENT["color"], linewidth=2.2, zorder=5)
        rows = len(samples)
        ax.set(xscale="log", ylim=(rows - 0.4, -0.7))
        ax.set(yticks=range(rows), yticklabels=list(samples))
        ax.tick_params(axis="y", length=0, labelsize=12, labelcolor=INK)
        ax.grid(False, axis="y")
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    return figure


def _draw_histogram(ax, row, values):
    logarithms = np.log10(values)
    edges = np.linspace(logarithms.min(), logarithms.max(), 50)
    count, _ = np.histogram(logarithms, edges)
    middles = 10 ** ((edges[1:] + edges[:-1]) / 2)
    ground = row + 0.1
    ax.fill_between(middles, ground, ground - ROW_HEIGHT * count / count.max(), **BAND)


def _draw_middle(ax, row, values):
    """The middle 99 % and 95 % as lines below the histogram."""
    for probability, width in ((99, 1.2), (95, 4.0)):
        ends = np.percentile(values, (50 - probability / 2, 50 + probability / 2))
        ax.plot(
            ends,
            [row + 0.18, row + 0.18],
            color=ESTIMATE["color"],
            linewidth=width,
            solid_capstyle="butt",
            label=None if row else f"{probability}%",
        )
