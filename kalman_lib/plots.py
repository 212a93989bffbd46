"""The figures of the book. The only room that imports matplotlib; it never runs a filter.

Every function returns a Figure that shows itself as the last value of a cell, with symbols and units only, so that it
serves both languages. Where a dict is asked for, its keys are the labels; heights are in inches.
"""
import io
import sys
from contextlib import contextmanager

import numpy as np
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as MatplotlibFigure
from PIL import Image

from .papers import quadrotor

GREY, DARK, GRID, PAPER = "#6b7278", "#3a4147", "#e3dfd6", "#fdfcf9"
TRUTH = dict(color="#222222", linewidth=1.0)
MEASUREMENT = dict(color="#c8641b", marker="o", markersize=3.2, linestyle="none")
ESTIMATE = dict(color="#1f6fb4", linewidth=1.8)
PREDICTION = dict(color="#8a4fa3", linewidth=1.6, linestyle=(0, (4, 2)))
RIVAL = dict(color="#3b7d3b", linewidth=1.6, linestyle=(0, (5, 1.5, 1, 1.5)))      # a moving average and the like
BAND = dict(color="#1f6fb4", alpha=0.16, linewidth=0)                                # +-2 sigma
PALE = dict(alpha=0.10, linewidth=0)                                                 # inside a bell or an ellipse
EDGE = dict(markeredgecolor=PAPER, zorder=5)                                         # of a single mark
STYLE = {       # paper background, few lines, text that stays readable on a phone
    "figure.facecolor": PAPER, "axes.facecolor": PAPER, "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.1, "font.family": "DejaVu Sans", "mathtext.fontset": "cm", "font.size": 11,
    "text.color": "#1d2327", "axes.labelsize": 11, "axes.labelcolor": DARK, "axes.titlesize": 11,
    "axes.titlelocation": "left", "axes.edgecolor": GREY, "axes.linewidth": 0.8, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "grid.color": GRID, "grid.linewidth": 0.6,
    "legend.frameon": False, "legend.fontsize": 10.5, "legend.handlelength": 1.6, "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    **{f"{x}tick.{part}": value for x in "xy" for part, value in (("color", GREY), ("labelcolor", DARK), ("labelsize", 10))}}


class Figure(MatplotlibFigure):
    """A matplotlib figure that shows itself in a notebook without pyplot and its global state."""

    def _repr_png_(self):
        return self.png(), {"width": 600}       # twice as fine as a notebook shows it

    def png(self, dpi=200):
        """The bytes of a PNG file with at most 96 colours, a third of the size."""
        with style.context(STYLE):
            self.set_dpi(dpi)
            self.canvas.draw()
        image = Image.fromarray(np.asarray(self.canvas.buffer_rgba())).convert("RGB")
        buffer = io.BytesIO()
        image.quantize(96, dither=Image.Dither.NONE).save(buffer, format="png", optimize=True)
        return buffer.getvalue()


def _print_ours_ourselves():
    """In a notebook pyplot, and with it `interact`, prints every figure of matplotlib its own way; ours print themselves."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is not None:
        shell.display_formatter.formatters["image/png"].for_type(Figure, Figure._repr_png_)


_print_ours_ourselves()
@contextmanager
def _figure(height, rows=1, columns=1, sharex=False, **names):
    """A figure in the book's style and its axes, which get names and a legend at the end of the block."""
    with style.context(STYLE):
        figure = Figure(figsize=(4.8, height))
        FigureCanvasAgg(figure)
        yield figure, figure.subplots(rows, columns, sharex=sharex)
        for ax in figure.axes:
            ax.set(**names)
            _legend(ax)


def _legend(ax):
    """A legend above the axes, where it can cover no data."""
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        ax.legend(handles, labels, loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=min(len(labels), 4),
                  borderaxespad=0.1, columnspacing=1.1, handletextpad=0.5)


def _series(ax, t, z=None, x=None, sigma=None, truth=None, rivals=None, names=None):
    names = {"z": "$z$", "x": "$x$", "truth": r"$x_{\mathrm{true}}$", **(names or {})}
    if sigma is not None:
        ax.fill_between(t, x - 2 * sigma, x + 2 * sigma, label=r"$\pm 2\sigma$", **BAND)
    if z is not None:
        ax.plot(t, z, label=names["z"], **MEASUREMENT if len(t) < 400 else {**MEASUREMENT, "markersize": 1.2})
    if truth is not None:
        ax.plot(t, truth, label=names["truth"], **TRUTH)
    for (label, values), look in zip((rivals or {}).items(), (RIVAL, PREDICTION)):
        ax.plot(t, values, label=label, **look)
    if x is not None:
        ax.plot(t, x, label=names["x"], **ESTIMATE)


def series(t, z=None, x=None, sigma=None, truth=None, rivals=None, names=None, xlabel="$k$", ylabel="", height=3.0):
    """One quantity over time t: measurements z, estimate x, its standard deviation sigma, truth; all (T,).

    rivals: dict of at most two other estimates (T,); names: dict with other labels for "z", "x", "truth".
    """
    with _figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _series(ax, t, z, x, sigma, truth, rivals, names)
    return figure


def panels(rows, xlabel="$k$", height=2.1, share=True):
    """Several quantities below each other: rows is a list of dicts, the arguments of `series`."""
    with _figure(height * len(rows), len(rows), sharex=share) as (figure, axes):
        for ax, row in zip(np.atleast_1d(axes), rows):
            row = dict(row)
            ax.set(ylabel=row.pop("ylabel", ""), xlabel=row.pop("xlabel", ""))
            _series(ax, **row)
        ax.set_xlabel(xlabel)
    return figure


def gaussians(curves, xlabel="$x$", height=2.8):
    """Bell curves: a dict of (mean, variance, look), look one of the module's styles."""
    means, sigmas = np.array([[mean, np.sqrt(variance)] for mean, variance, _ in curves.values()]).T
    x = np.linspace((means - 4 * sigmas).min(), (means + 4 * sigmas).max(), 600)
    with _figure(height, xlabel=xlabel, ylabel="$p$", ylim=(0, None)) as (figure, ax):
        for label, curve in curves.items():
            bell(ax, x, *curve, label)
    return figure


def bell(ax, x, mean, variance, look, label=None):
    """One bell curve at x (N,), as a line and a pale area."""
    density = np.exp(-(x - mean) ** 2 / (2 * variance)) / np.sqrt(2 * np.pi * variance)
    line = look.get("linestyle", "none")
    ax.plot(x, density, label=label, color=look["color"], linewidth=look.get("linewidth", 1.8),
            linestyle="-" if line == "none" else line)
    ax.fill_between(x, density, color=look["color"], **PALE)


def curve(lines, xlabel, ylabel, log=False, points=None, height=2.8, ylim=None):
    """Curves: a dict of (x, y), and one of points (x, y)."""
    with _figure(height, xlabel=xlabel, ylabel=ylabel, xscale="log" if log else "linear") as (figure, ax):
        for (label, (x, y)), look in zip(lines.items(), (ESTIMATE, RIVAL, PREDICTION, TRUTH)):
            ax.plot(x, y, label=label, **look)
        _points(ax, points, 6)
        if ylim:
            ax.set(ylim=ylim)
    return figure


def _points(ax, points, size, marks="osD^v", color=MEASUREMENT["color"], **look):
    for (label, (x, y)), mark in zip((points or {}).items(), marks):
        ax.plot(x, y, mark, color=color, markersize=size, label=label, **{**EDGE, **look})


def ellipses(states, z=None, R=None, xlabel="$p$ (m)", ylabel="$v$ (m/s)", height=3.4, limits=None):
    """Covariance ellipses (2 sigma): a dict of (x (2,), P (2, 2), look); a measurement z of the first state with variance
    R as a vertical stripe; limits ((low, high), (low, high))."""
    with _figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        if z is not None:
            color = MEASUREMENT["color"]
            ax.axvspan(z - 2 * np.sqrt(R), z + 2 * np.sqrt(R), color=color, alpha=0.12, linewidth=0)
            ax.axvline(z, color=color, linewidth=1.4, linestyle=(0, (1, 1.5)), label=r"$z \pm 2\sqrt{R}$")
        for label, (x, P, look) in states.items():
            outline = covariance_ellipse(x, P)
            ax.fill(*outline, color=look["color"], **PALE)
            ax.plot(*outline, color=look["color"], linewidth=1.8, linestyle=look.get("linestyle", "-"))
            ax.plot(*x, "o", color=look["color"], markersize=5, label=label)
        if limits is None:
            ax.margins(0.08)
        else:
            ax.set(xlim=limits[0], ylim=limits[1])
    return figure


def plane(states, lines, points, xlabel, ylabel, height=3.4, limits=None):
    """`ellipses` with lines, a dict of (x, y), first a true, then a predicted one, and a dict of points (x, y)."""
    figure = ellipses(states, xlabel=xlabel, ylabel=ylabel, height=height, limits=limits)
    with style.context(STYLE):
        ax = figure.axes[0]
        for (label, (x, y)), look in zip(lines.items(), (TRUTH, PREDICTION)):
            ax.plot(x, y, label=label, zorder=1.5, **look)
        _points(ax, points, 13, "*sD^v", TRUTH["color"])
        if isinstance(figure, Figure):
            _legend(ax)
    return figure


def covariance_ellipse(x, P, sigmas=2):
    """The outline (2, 181) around x (2,), `sigmas` standard deviations of P (2, 2) away."""
    variances, axes = np.linalg.eigh(P)
    turn = np.linspace(0, 2 * np.pi, 181)
    half = sigmas * np.sqrt(np.maximum(variances, 0))[:, np.newaxis]
    return np.asarray(x)[:, np.newaxis] + axes @ (half * np.array([np.cos(turn), np.sin(turn)]))


def poles(sets, zoom=None, height=2.6):
    """Poles in the complex plane with the unit circle: a dict of at most five (n,) complex; zoom ((low, high) real,
    (low, high) imaginary) adds a view of that part."""
    looks = ((ESTIMATE, "o", 7), (RIVAL, "s", 6), (PREDICTION, "x", 8), (MEASUREMENT, "^", 7), (TRUTH, "+", 9))
    turn = np.linspace(0, 2 * np.pi, 2000)
    reach = 1.08 * max(1, *(np.abs(values).max() for values in sets.values()))
    with _figure(height, columns=1 if zoom is None else 2, xlabel=r"$\mathrm{Re}\,p$") as (figure, axes):
        for k, ax in enumerate(np.atleast_1d(axes)):
            ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=1.0)
            for (label, values), (look, mark, size) in zip(sets.items(), looks):
                hollow = {} if mark in "x+" else {"markerfacecolor": "none"}
                ax.plot(np.real(values), np.imag(values), mark, color=look["color"], markersize=size, markeredgewidth=1.7,
                        label=None if k else label, clip_on=k == 1, **hollow)
            if k:
                ax.set(xlim=zoom[0], ylim=zoom[1])
            else:
                ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", ylabel=r"$\mathrm{Im}\,p$")
    return figure


def surface(x, y, values, xlabel, ylabel, best=None, drop=(0.5, 2, 5, 10, 20, 50), height=3.4):
    """A log-likelihood, values (len(y), len(x)), as its loss against the largest; best (x, y) as a mark."""
    with _figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _heights(ax, x, y, np.max(values) - values, drop, (0, 2 * drop[-1]), "Blues_r", "-%g", 0.6, 8)
        _points(ax, None if best is None else {r"$\max\ \ln L$": best}, 7, zorder=2)
    return figure


def contours(x, y, values, xlabel, ylabel, levels, points=None, fmt="%g", height=3.4):
    """Lines of equal values (len(y), len(x)) with their numbers, and a dict of points (x, y)."""
    ends = min(np.min(values), levels[0]) - 1, max(np.max(values), levels[-1]) + 1
    with _figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _heights(ax, x, y, values, levels, ends, "Blues", fmt, 0.8, 9)
        _points(ax, points, 7, zorder=2)
    return figure


def _heights(ax, x, y, values, levels, ends, colours, fmt, width, size):
    low, high = ends
    ax.contourf(x, y, np.minimum(values, high), levels=(low, *levels, high), cmap=colours, alpha=0.45)
    lines = ax.contour(x, y, values, levels=levels, colors=DARK, linewidths=width)
    ax.clabel(lines, fmt=fmt, fontsize=size)
    ax.grid(False)


def consistency(lines, bounds, ylabel, xlabel="$k$", height=2.6):
    """NEES or NIS over time, a dict of (T,), and the bounds between which they should lie."""
    top = 1.15 * max(bounds[1], *(np.nanmax(values) for values in lines.values()))
    with _figure(height, xlabel=xlabel, ylabel=ylabel, ylim=(0, top)) as (figure, ax):
        ax.axhspan(*bounds, label="95 % $\\chi^2$", **BAND)
        for (label, values), look in zip(lines.items(), (ESTIMATE, RIVAL)):
            ax.plot(np.arange(1, len(values) + 1), values, label=label, marker="o", markersize=3,
                    **{**look, "linewidth": 1.0})
        ax.xaxis.get_major_locator().set_params(integer=True)
    return figure


def intervals(samples, xlabel, height=4.2):
    """Single values in simulated distributions: a dict of (samples (N,) > 0, the value to mark). On a log axis the
    histogram, its middle 95 % (thick) and 99 % (thin), and the mark."""
    with _figure(height, xlabel=xlabel) as (figure, ax):
        for row, (values, mark) in enumerate(samples.values()):
            edges = np.linspace(*np.log10([values.min(), values.max()]), 50)
            count, _ = np.histogram(np.log10(values), edges)
            ax.fill_between(10 ** ((edges[1:] + edges[:-1]) / 2), row + 0.1, row + 0.1 - 0.62 * count / count.max(), **BAND)
            for probability, width in ((99, 1.2), (95, 4.0)):
                ax.plot(np.percentile(values, (50 - probability / 2, 50 + probability / 2)), [row + 0.18] * 2,
                        color=ESTIMATE["color"], linewidth=width, solid_capstyle="butt",
                        label=None if row else f"{probability} %")
            ax.plot([mark, mark], [row - 0.45, row + 0.32], color=MEASUREMENT["color"], linewidth=2.2, zorder=5)
        ax.set(xscale="log", yticks=range(len(samples)), yticklabels=list(samples), ylim=(len(samples) - 0.4, -0.7))
        ax.tick_params(axis="y", length=0)
        ax.grid(False, axis="y")
        ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    return figure


def craft(moments, height=1.9):
    """A craft with four rotors, seen from the south and from above: a dict of (estimate, truth or None), each roll, pitch
    and yaw (3,) in rad. Thick: the estimate, thin: the truth; the arrow is the nose."""
    circle = np.linspace(0, 2 * np.pi, 33)
    ring = 0.38 * np.column_stack([np.cos(circle), np.sin(circle), 0 * circle])
    tips = 0.75 * np.array([[1, 1, 0], [1, -1, 0], [-1, -1, 0], [-1, 1, 0]])
    nose = np.array([[-0.2, 0, 0], [1.25, 0, 0], [1.0, 0.14, 0], [1.25, 0, 0], [1.0, -0.14, 0]])
    shape = [nose, tips[[0, 2]], tips[[1, 3]], *(tip + ring for tip in tips)]
    with _figure(height) as (figure, ax):
        for place, (label, looks) in enumerate(moments.items()):
            for angles, look in zip(looks, ({**ESTIMATE, "linewidth": 2.2}, TRUTH)):
                for line in shape if angles is not None else ():
                    north, east, down = quadrotor.to_body(np.eye(3), np.tile(angles, (3, 1))) @ line.T
                    ax.plot(east + 3.2 * place, 0.6 * north - 0.8 * down, solid_capstyle="round", **look)
            ax.text(3.2 * place, -1.75, label, ha="center", va="bottom", fontsize="small")
        ax.set(xlim=(-1.6, 3.2 * len(moments) - 1.6), ylim=(-1.8, 1.45), aspect="equal")
        ax.set_axis_off()
    return figure
