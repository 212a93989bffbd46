"""The figures of the book. The only room that imports matplotlib; it never runs a filter.

Every function returns a Figure that shows itself as the last value of a cell. Figures carry symbols and units only,
so one figure serves both languages; the words are in the caption. Colours and marks mean the same everywhere:

truth          thin dark line          measurement    orange dots
estimate       blue line               prediction     purple dashes
band           light blue, +-2 sigma   rival          green dash-dots (moving average and the like)
"""
import io
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

import numpy as np
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as MatplotlibFigure
from PIL import Image

from .sketch import Sketch

STYLE = Path(__file__).with_name("kalman.mplstyle")
TRUTH = dict(color="#222222", linewidth=1.0)
MEASUREMENT = dict(color="#c8641b", marker="o", markersize=3.2, linestyle="none")
ESTIMATE = dict(color="#1f6fb4", linewidth=1.8)
PREDICTION = dict(color="#8a4fa3", linewidth=1.6, linestyle=(0, (4, 2)))
RIVAL = dict(color="#3b7d3b", linewidth=1.6, linestyle=(0, (5, 1.5, 1, 1.5)))
BAND = dict(color="#1f6fb4", alpha=0.16, linewidth=0)


class Figure(MatplotlibFigure):
    """A matplotlib figure that shows itself in a notebook without pyplot and its global state."""

    def _repr_png_(self):
        return self.png(), {"width": 600}       # twice as fine as a notebook shows it

    def png(self, dpi=200):
        """The figure as the bytes of a PNG file, with at most 96 colours: a third of the size, for slow connections."""
        with style.context(STYLE):
            self.set_dpi(dpi)
            self.canvas.draw()
        image = Image.fromarray(np.asarray(self.canvas.buffer_rgba())).convert("RGB")
        buffer = io.BytesIO()
        image.quantize(96, dither=Image.Dither.NONE).save(buffer, format="png", optimize=True)
        return buffer.getvalue()


_quick = ContextVar("whether figures are drawn as quick sketches", default=False)


@contextmanager
def live():
    """Inside this block every function below that has one pair of axes returns a Sketch, SVG in a few milliseconds."""
    before = _quick.set(True)
    try:
        yield
    finally:
        _quick.reset(before)


@contextmanager
def _figure(rows=1, height=3.0, columns=1, **options):
    """A figure in the book's style and its axes; the style holds inside the with block only."""
    if _quick.get():
        sketch = Sketch(height)
        yield sketch, sketch.axes[0]
        return
    with style.context(STYLE):
        figure = Figure(figsize=(4.8, height))
        FigureCanvasAgg(figure)
        yield figure, figure.subplots(rows, columns, **options)


def _legend(ax, **options):
    """A legend above the axes, where it can cover no data."""
    if _quick.get():
        return                                      # a Sketch always has one
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        ax.legend(handles, labels, loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=min(len(labels), 4),
                  borderaxespad=0.1, columnspacing=1.1, handletextpad=0.5, **options)


def _series(ax, t, z=None, x=None, sigma=None, truth=None, rivals=None, names=None):
    """Draw what is given of one quantity over time; a rival is another estimate with its own label."""
    names = {"z": "$z$", "x": "$x$", "truth": r"$x_{\mathrm{true}}$", **(names or {})}
    if sigma is not None:
        ax.fill_between(t, x - 2 * sigma, x + 2 * sigma, label=r"$\pm 2\sigma$", **BAND)
    if z is not None:
        mark = MEASUREMENT if len(t) < 400 else {**MEASUREMENT, "markersize": 1.2}
        ax.plot(t, z, label=names["z"], **mark)
    if truth is not None:
        ax.plot(t, truth, label=names["truth"], **TRUTH)
    for (label, values), look in zip((rivals or {}).items(), (RIVAL, PREDICTION)):
        ax.plot(t, values, label=label, **look)
    if x is not None:
        ax.plot(t, x, label=names["x"], **ESTIMATE)
    _legend(ax)


def series(t, z=None, x=None, sigma=None, truth=None, rivals=None, names=None, xlabel="$k$", ylabel="", height=3.0):
    """One quantity over time: t (T,), measurements z, estimate x with its standard deviation sigma, truth; all (T,).

    rivals is a dict label -> (T,) of at most two other estimates; names replaces the labels of z, x, truth.
    """
    with _figure(height=height) as (figure, ax):
        _series(ax, t, z, x, sigma, truth, rivals, names)
        ax.set(xlabel=xlabel, ylabel=ylabel)
    return figure


def panels(rows, xlabel="$k$", height=2.1, share=True):
    """Several quantities below each other: rows is a list of dicts, each the arguments of `series`."""
    with _figure(len(rows), height * len(rows), sharex=share) as (figure, axes):
        for ax, row in zip(np.atleast_1d(axes), rows):
            row = dict(row)
            ax.set(ylabel=row.pop("ylabel", ""), xlabel=row.pop("xlabel", ""))
            _series(ax, **row)
        np.atleast_1d(axes)[-1].set_xlabel(xlabel)
    return figure


def cover(t, z, x, sigma, truth, moments, height=4.2):
    """The picture of the cover: a whole run above, and below it the bell curves of three moments of that run.

    t, z, x, sigma, truth (T,) as in `series`; moments a list of (k, prediction, measurement, estimate), each of the
    three a (mean, variance).
    """
    with style.context(STYLE):
        figure = Figure(figsize=(4.8, height))
        FigureCanvasAgg(figure)
        axes = figure.subplot_mosaic([["run"] * 3, ["a", "b", "c"]], height_ratios=(2.2, 1))
        ax = axes["run"]
        _series(ax, t, z, x, sigma, truth)
        ax.set(xticks=[], yticks=[])
        ax.grid(False)
        for name, (k, prediction, measurement, estimate) in zip("abc", moments):
            ax.axvline(t[k], color="#6b7278", linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
            ax.text(t[k], 1, name, transform=ax.get_xaxis_transform(), ha="center", va="top", color="#3a4147",
                    fontweight="bold", backgroundcolor="#fdfcf9")
            means, sigmas = np.array([[m, v ** 0.5] for m, v in (prediction, measurement)]).T
            grid = np.linspace((means - 2.6 * sigmas).min(), (means + 2.6 * sigmas).max(), 300)
            for (mean, variance), look in ((prediction, PREDICTION), (measurement, MEASUREMENT), (estimate, ESTIMATE)):
                density = np.exp(-(grid - mean) ** 2 / (2 * variance)) / variance ** 0.5
                axes[name].plot(grid, density, color=look["color"], linewidth=1.6,
                                linestyle=look["linestyle"] if look is PREDICTION else "-")
                axes[name].fill_between(grid, density, color=look["color"], alpha=0.10, linewidth=0)
            axes[name].set(xticks=[], yticks=[], ylim=(0, None))
            axes[name].set_title(name, fontweight="bold", color="#3a4147")
            axes[name].spines["left"].set_visible(False)
    return figure


def gaussians(curves, xlabel="$x$", height=2.8):
    """Bell curves on one axis: curves is a dict label -> (mean, variance, look), look one of the module's styles."""
    with _figure(height=height) as (figure, ax):
        means, sigmas = np.array([[m, np.sqrt(v)] for m, v, _ in curves.values()]).T
        grid = np.linspace((means - 4 * sigmas).min(), (means + 4 * sigmas).max(), 600)
        for label, (mean, variance, look) in curves.items():
            density = np.exp(-(grid - mean) ** 2 / (2 * variance)) / np.sqrt(2 * np.pi * variance)
            look = {"linewidth": 1.8, **{k: v for k, v in look.items() if k in ("color", "linewidth", "linestyle")}}
            look["linestyle"] = "-" if look.get("linestyle") == "none" else look.get("linestyle", "-")
            ax.plot(grid, density, label=label, **look)
            ax.fill_between(grid, density, color=look["color"], alpha=0.10, linewidth=0)
        ax.set(xlabel=xlabel, ylabel="$p$", ylim=(0, None))
        _legend(ax)
    return figure


def curve(lines, xlabel, ylabel, log=False, points=None, height=2.8, ylim=None):
    """Curves y over x: lines is a dict label -> (x, y); points a dict label -> (x, y) of single marks."""
    with _figure(height=height) as (figure, ax):
        for (label, (x, y)), look in zip(lines.items(), (ESTIMATE, RIVAL, PREDICTION, TRUTH)):
            ax.plot(x, y, label=label, **look)
        for (label, (x, y)), mark in zip((points or {}).items(), "osD^v"):
            ax.plot(x, y, mark, color=MEASUREMENT["color"], markersize=6, markeredgecolor="#fdfcf9", label=label,
                    zorder=5)
        ax.set(xlabel=xlabel, ylabel=ylabel, xscale="log" if log else "linear")
        if ylim:
            ax.set_ylim(*ylim)
        _legend(ax)
    return figure


def ellipses(states, z=None, R=None, xlabel="$p$ (m)", ylabel="$v$ (m/s)", height=3.4, limits=None):
    """Covariance ellipses (2 sigma) in the plane of two states, with the measured position as a vertical stripe.

    states is a dict label -> (x (2,), P (2, 2), look); z (number) and R (variance) the measurement of the first state.
    """
    with _figure(height=height) as (figure, ax):
        if z is not None:
            ax.axvspan(z - 2 * np.sqrt(R), z + 2 * np.sqrt(R), color=MEASUREMENT["color"], alpha=0.12, linewidth=0)
            ax.axvline(z, color=MEASUREMENT["color"], linewidth=1.4, linestyle=(0, (1, 1.5)), label=r"$z \pm 2\sqrt{R}$")
        for label, (x, P, look) in states.items():
            outline = covariance_ellipse(x, P)
            ax.fill(*outline, color=look["color"], alpha=0.10, linewidth=0)
            ax.plot(*outline, color=look["color"], linewidth=1.8, linestyle=look.get("linestyle", "-"))
            ax.plot(*x, "o", color=look["color"], markersize=5, label=label)
        if limits is None:
            ax.autoscale_view()
            ax.margins(0.08)
        else:
            ax.set(xlim=limits[0], ylim=limits[1])
        ax.set(xlabel=xlabel, ylabel=ylabel)
        _legend(ax)
    return figure


def plane(states, lines, points, xlabel, ylabel, height=3.4, limits=None):
    """Covariance ellipses (2 sigma) as in `ellipses`, with curves and single marks in the same plane.

    lines is a dict label -> (x, y), the first drawn as the truth, the second as a prediction; points a dict
    label -> (x, y); an empty label stays out of the legend.
    """
    figure = ellipses(states, xlabel=xlabel, ylabel=ylabel, height=height, limits=limits)
    with style.context(STYLE):
        ax = figure.axes[0]
        for (label, (x, y)), look in zip(lines.items(), (TRUTH, PREDICTION)):
            ax.plot(x, y, label=label, zorder=1.5, **look)
        for (label, (x, y)), mark in zip(points.items(), "*sD^v"):
            ax.plot(x, y, mark, color=TRUTH["color"], markersize=13, markeredgecolor="#fdfcf9", label=label, zorder=5)
        _legend(ax)
    return figure


def covariance_ellipse(x, P, sigmas=2):
    """The outline (2, 181) of the ellipse around x (2,) whose half-axes are `sigmas` standard deviations of P (2, 2)."""
    variances, axes = np.linalg.eigh(P)
    turn = np.linspace(0, 2 * np.pi, 181)
    half = sigmas * np.sqrt(np.maximum(variances, 0))[:, np.newaxis]
    return np.asarray(x)[:, np.newaxis] + axes @ (half * np.array([np.cos(turn), np.sin(turn)]))


def poles(sets, zoom=None, height=2.6):
    """Poles in the complex plane with the unit circle: sets is a dict label -> (n,) complex numbers, at most five.

    zoom ((low, high) real, (low, high) imaginary) adds a second view of that part beside the first.
    """
    marks = ((ESTIMATE, "o", 7), (RIVAL, "s", 6), (PREDICTION, "x", 8), (MEASUREMENT, "^", 7), (TRUTH, "+", 9))
    with _figure(1, height, columns=1 if zoom is None else 2) as (figure, axes):
        for k, ax in enumerate(np.atleast_1d(axes)):
            turn = np.linspace(0, 2 * np.pi, 2000)
            ax.plot(np.cos(turn), np.sin(turn), color="#6b7278", linewidth=1.0)
            for (label, values), (look, mark, size) in zip(sets.items(), marks):
                hollow = {} if mark in "x+" else {"markerfacecolor": "none"}
                ax.plot(np.real(values), np.imag(values), mark, color=look["color"], markersize=size,
                        markeredgewidth=1.7, label=label if k == 0 else None, clip_on=False, **hollow)
            ax.set(xlabel=r"$\mathrm{Re}\,p$", ylabel=r"$\mathrm{Im}\,p$" if k == 0 else "")
            if k == 0:
                reach = 1.08 * max(1, *(np.abs(values).max() for values in sets.values()))
                ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
                _legend(ax)
            else:
                ax.set(xlim=zoom[0], ylim=zoom[1])
                for line in ax.lines[1:]:
                    line.set_clip_on(True)
    return figure


def surface(x, y, values, xlabel, ylabel, best=None, drop=(0.5, 2, 5, 10, 20, 50), height=3.4):
    """Contours of a log-likelihood, values (len(y), len(x)), as its loss against the best; the best pair as a mark."""
    with _figure(height=height) as (figure, ax):
        loss = np.max(values) - values
        ax.contourf(x, y, np.minimum(loss, 2 * drop[-1]), levels=(0, *drop, 2 * drop[-1]), cmap="Blues_r",
                    alpha=0.45)
        lines = ax.contour(x, y, loss, levels=drop, colors="#3a4147", linewidths=0.6)
        ax.clabel(lines, fmt="-%g", fontsize=8)
        if best is not None:
            ax.plot(*best, "o", color=MEASUREMENT["color"], markersize=7, markeredgecolor="#fdfcf9",
                    label=r"$\max\ \ln L$")
        ax.set(xlabel=xlabel, ylabel=ylabel)
        ax.grid(False)
        _legend(ax)
    return figure


def consistency(lines, bounds, ylabel, xlabel="$k$", height=2.6):
    """NEES or NIS over time, lines a dict label -> (T,), and the interval in which chi-square says they should lie."""
    with _figure(height=height) as (figure, ax):
        ax.axhspan(*bounds, label="95 % $\\chi^2$", **BAND)
        for (label, values), look in zip(lines.items(), (ESTIMATE, RIVAL)):
            ax.plot(np.arange(1, len(values) + 1), values, label=label, marker="o", markersize=3,
                    **{**look, "linewidth": 1.0})
        top = 1.15 * max(bounds[1], *(np.nanmax(values) for values in lines.values()))
        ax.set(xlabel=xlabel, ylabel=ylabel, ylim=(0, top))
        ax.xaxis.get_major_locator().set_params(integer=True)
        _legend(ax)
    return figure


def contours(x, y, values, xlabel, ylabel, levels, points=None, fmt="%g", height=3.4):
    """Lines of equal height of values (len(y), len(x)), each with its number; points a dict label -> (x, y) of marks."""
    with _figure(height=height) as (figure, ax):
        ends = min(np.min(values), levels[0]) - 1, max(np.max(values), levels[-1]) + 1
        ax.contourf(x, y, values, levels=(ends[0], *levels, ends[1]), cmap="Blues", alpha=0.45)
        lines = ax.contour(x, y, values, levels=levels, colors="#3a4147", linewidths=0.8)
        ax.clabel(lines, fmt=fmt, fontsize=9)
        for (label, at), mark in zip((points or {}).items(), "osD^v"):
            ax.plot(*at, mark, color=MEASUREMENT["color"], markersize=7, markeredgecolor="#fdfcf9", label=label)
        ax.set(xlabel=xlabel, ylabel=ylabel)
        ax.grid(False)
        _legend(ax)
    return figure


def intervals(samples, xlabel, height=4.2):
    """Where single values fall in simulated distributions: samples is a dict label -> (values (N,) > 0, the value to mark).

    One row each, on a log axis: the histogram, its middle 95 % as a thick line and 99 % as a thin one, the mark a stroke.
    """
    with _figure(height=height) as (figure, ax):
        for row, (values, mark) in enumerate(samples.values()):
            edges = np.linspace(*np.log10([values.min(), values.max()]), 50)
            count, _ = np.histogram(np.log10(values), edges)
            ax.fill_between(10 ** ((edges[1:] + edges[:-1]) / 2), row + 0.1, row + 0.1 - 0.62 * count / count.max(), **BAND)
            for probability, width in ((99, 1.2), (95, 4.0)):
                ax.plot(np.percentile(values, (50 - probability / 2, 50 + probability / 2)), [row + 0.18] * 2,
                        color=ESTIMATE["color"], linewidth=width, solid_capstyle="butt",
                        label=f"{probability} %" if row == 0 else None)
            ax.plot([mark, mark], [row - 0.45, row + 0.32], color=MEASUREMENT["color"], linewidth=2.2, zorder=5)
        ax.set(xscale="log", xlabel=xlabel, yticks=range(len(samples)), yticklabels=list(samples),
               ylim=(len(samples) - 0.4, -0.7))
        ax.tick_params(axis="y", length=0)
        ax.grid(False, axis="y")
        ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        _legend(ax)
    return figure


def craft(moments, height=1.9):
    """A craft with four rotors at several moments, seen from the south and from above (north is up, east to the right).

    moments is a dict label -> (estimate, truth): roll, pitch and yaw (3,) in rad; truth may be None. The thick craft is
    the estimate, the thin one the truth; the arrow is its nose.
    """
    circle = np.linspace(0, 2 * np.pi, 33)
    ring = 0.38 * np.column_stack([np.cos(circle), np.sin(circle), 0 * circle])
    tips = 0.75 * np.array([[1, 1, 0], [1, -1, 0], [-1, -1, 0], [-1, 1, 0]])
    nose = np.array([[-0.2, 0, 0], [1.25, 0, 0], [1.0, 0.14, 0], [1.25, 0, 0], [1.0, -0.14, 0]])
    shape = [nose, tips[[0, 2]], tips[[1, 3]], *(tip + ring for tip in tips)]
    with _figure(height=height) as (figure, ax):
        for place, (label, looks) in enumerate(moments.items()):
            for angles, look in zip(looks, ({**ESTIMATE, "linewidth": 2.2}, TRUTH)):
                for line in shape if angles is not None else ():
                    north, east, down = _to_ned(line, angles).T
                    ax.plot(east + 3.2 * place, 0.6 * north - 0.8 * down, solid_capstyle="round", **look)
            ax.text(3.2 * place, -1.75, label, ha="center", va="bottom", fontsize="small")
        ax.set(xlim=(-1.6, 3.2 * len(moments) - 1.6), ylim=(-1.8, 1.45), aspect="equal")
        ax.axis("off")
    return figure


def _to_ned(v, angles):
    """A vector v (N, 3) of the body's axes, seen north-east-down: turned by roll, then pitch, then yaw."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(angles), np.cos(angles)
    return v @ np.array([[cp * cy, cp * sy, -sp],
                         [sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, sr * cp],
                         [cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp]])
