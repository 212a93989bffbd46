"""Planes: covariance ellipses of two states, likelihoods of two parameters, poles."""

import numpy as np
from matplotlib import style

from .figure import Figure, add_legend, new_figure
from .marks import add_points
from .styles import DARK, ESTIMATE, GREY, MEASUREMENT, PALE, PREDICTION, RIVAL, STYLE, TRUTH

POLES = (
    (ESTIMATE, "o", 7),
    (RIVAL, "s", 6),
    (PREDICTION, "x", 8),
    (MEASUREMENT, "^", 7),
    (TRUTH, "+", 9),
)
WITHOUT_INSIDE = "x+"  # marks that are lines only


# --- two states ---------------------------------------------------------------------------------


def ellipses(states, z=None, R=None, xlabel="$p$ (m)", ylabel="$v$ (m/s)", height=3.4, limits=None):
    """Covariance ellipses (2 sigma): a dict of (x (2,), P (2, 2), look).

    A measurement z of the first state with variance R is a vertical stripe; limits ((low, high),
    (low, high))."""
    with new_figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        if z is not None:
            _draw_measurement(ax, z, R)
        for label, (x, P, look) in states.items():
            _draw_ellipse(ax, x, P, look, label)
        if limits is None:
            ax.margins(0.08)
        else:
            ax.set(xlim=limits[0], ylim=limits[1])
    return figure


def _draw_measurement(ax, z, R):
    color = MEASUREMENT["color"]
    reach = 2 * np.sqrt(R)
    ax.axvspan(z - reach, z + reach, color=color, alpha=0.12, linewidth=0)
    dotted = (0, (1, 1.5))
    ax.axvline(z, color=color, linewidth=1.4, linestyle=dotted, label=r"$z \pm 2\sqrt{R}$")


def _draw_ellipse(ax, x, P, look, label):
    outline = covariance_ellipse(x, P)
    color, linestyle = look["color"], look.get("linestyle", "-")
    ax.fill(*outline, color=color, **PALE)
    ax.plot(*outline, color=color, linewidth=1.8, linestyle=linestyle)
    ax.plot(*x, "o", color=color, markersize=5, label=label)


def covariance_ellipse(x, P, sigmas=2):
    """The outline (2, 181) around x (2,), `sigmas` standard deviations of P (2, 2) away."""
    variances, axes = np.linalg.eigh(P)
    turn = np.linspace(0, 2 * np.pi, 181)
    half = sigmas * np.sqrt(np.maximum(variances, 0))[:, np.newaxis]
    circle = np.array([np.cos(turn), np.sin(turn)])
    return np.asarray(x)[:, np.newaxis] + axes @ (half * circle)


def plane(states, lines, points, xlabel, ylabel, height=3.4, limits=None):
    """`ellipses` with lines, a dict of (x, y), first a true, then a predicted one, and a dict of
    points (x, y)."""
    figure = ellipses(states, xlabel=xlabel, ylabel=ylabel, height=height, limits=limits)
    with style.context(STYLE):
        ax = figure.axes[0]
        for (label, (x, y)), look in zip(lines.items(), (TRUTH, PREDICTION)):
            ax.plot(x, y, label=label, zorder=1.5, **look)
        add_points(ax, points, 13, "*sD^v", TRUTH["color"])
        if isinstance(figure, Figure):
            add_legend(ax)
    return figure


# --- two parameters -----------------------------------------------------------------------------


def surface(x, y, values, xlabel, ylabel, best=None, drop=(0.5, 2, 5, 10, 20, 50), height=3.4):
    """A log-likelihood, values (len(y), len(x)), as its loss against the largest; best (x, y) as a
    mark."""
    loss = np.max(values) - values
    ends = (0, 2 * drop[-1])
    points = None if best is None else {r"$\max\ \ln L$": best}
    with new_figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _draw_heights(ax, x, y, loss, drop, ends, "Blues_r", "-%g", 0.6, 10)
        add_points(ax, points, 7, zorder=2)
    return figure


def contours(x, y, values, xlabel, ylabel, levels, points=None, fmt="%g", height=3.4):
    """Lines of equal values (len(y), len(x)) with their numbers, and a dict of points (x, y)."""
    ends = min(np.min(values), levels[0]) - 1, max(np.max(values), levels[-1]) + 1
    with new_figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _draw_heights(ax, x, y, values, levels, ends, "Blues", fmt, 0.8, 10)
        add_points(ax, points, 7, zorder=2)
    return figure


def _draw_heights(ax, x, y, values, levels, ends, colours, fmt, width, size):
    low, high = ends
    steps = (low, *levels, high)
    ax.contourf(x, y, np.minimum(values, high), levels=steps, cmap=colours, alpha=0.45)
    lines = ax.contour(x, y, values, levels=levels, colors=DARK, linewidths=width)
    ax.clabel(lines, fmt=fmt, fontsize=size)
    ax.grid(False)


# --- poles --------------------------------------------------------------------------------------


def poles(sets, zoom=None, height=2.6):
    """Poles in the complex plane with the unit circle: a dict of at most five (n,) complex.

    zoom ((low, high) real, (low, high) imaginary) adds a view of that part.
    """
    columns = 1 if zoom is None else 2
    reach = 1.08 * max(1, *(np.abs(values).max() for values in sets.values()))
    with new_figure(height, columns=columns, xlabel=r"$\mathrm{Re}\,\lambda$") as (figure, axes):
        whole, *parts = np.atleast_1d(axes)
        _draw_poles(whole, sets, is_part=False)
        whole.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
        whole.set(ylabel=r"$\mathrm{Im}\,\lambda$")
        for part in parts:
            _draw_poles(part, sets, is_part=True)
            part.set(xlim=zoom[0], ylim=zoom[1])
    return figure


def _draw_poles(ax, sets, is_part):
    """The unit circle and the poles; a part clips them and names none."""
    turn = np.linspace(0, 2 * np.pi, 2000)
    ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=1.0)
    for (label, values), (look, mark, size) in zip(sets.items(), POLES):
        inside = {} if mark in WITHOUT_INSIDE else {"markerfacecolor": "none"}
        ax.plot(
            np.real(values),
            np.imag(values),
            mark,
            color=look["color"],
            markersize=size,
            markeredgewidth=1.7,
            label=None if is_part else label,
            clip_on=is_part,
            **inside,
        )
