"""Quantities over time: measurements, estimates with their uncertainty, truth; NEES and NIS."""

import numpy as np

from .figure import new_figure
from .styles import BAND, ESTIMATE, MEASUREMENT, PREDICTION, RIVAL, TRUTH

LABELS = {"z": "$z$", "x": "$x$", "truth": r"$x_{\mathrm{true}}$"}
MANY = 400  # measurements, which are drawn as smaller dots


def series(
    t,
    z=None,
    x=None,
    sigma=None,
    truth=None,
    rivals=None,
    names=None,
    xlabel="$k$",
    ylabel="",
    height=3.0,
):
    """One quantity over time t: measurements z, estimate x, its standard deviation sigma, truth;
    all (T,).

    rivals: dict of at most two other estimates (T,); names: dict with other labels for "z", "x",
    "truth"."""
    with new_figure(height, xlabel=xlabel, ylabel=ylabel) as (figure, ax):
        _draw_series(ax, t, z, x, sigma, truth, rivals, names)
    return figure


def panels(rows, xlabel="$k$", height=2.1, share=True):
    """Several quantities below each other: rows is a list of dicts, the arguments of `series`."""
    with new_figure(height * len(rows), len(rows), sharex=share) as (figure, axes):
        for ax, row in zip(np.atleast_1d(axes), rows):
            row = dict(row)
            ax.set(ylabel=row.pop("ylabel", ""), xlabel=row.pop("xlabel", ""))
            _draw_series(ax, **row)
        ax.set_xlabel(xlabel)
    return figure


def _draw_series(ax, t, z=None, x=None, sigma=None, truth=None, rivals=None, names=None):
    labels = {**LABELS, **(names or {})}
    if sigma is not None:
        ax.fill_between(t, x - 2 * sigma, x + 2 * sigma, label=r"$\pm 2\sigma$", **BAND)
    if z is not None:
        look = MEASUREMENT if len(t) < MANY else {**MEASUREMENT, "markersize": 1.2}
        ax.plot(t, z, label=labels["z"], **look)
    if truth is not None:
        ax.plot(t, truth, label=labels["truth"], **TRUTH)
    for (label, values), look in zip((rivals or {}).items(), (RIVAL, PREDICTION)):
        ax.plot(t, values, label=label, **look)
    if x is not None:
        ax.plot(t, x, label=labels["x"], **ESTIMATE)


def consistency(lines, bounds, ylabel, xlabel="$k$", height=2.6):
    """NEES or NIS over time, a dict of (T,), and the bounds between which they should lie."""
    top = 1.15 * max(bounds[1], *(np.nanmax(values) for values in lines.values()))
    with new_figure(height, xlabel=xlabel, ylabel=ylabel, ylim=(0, top)) as (figure, ax):
        ax.axhspan(*bounds, label="95% $\\chi^2$", **BAND)
        for (label, values), look in zip(lines.items(), (ESTIMATE, RIVAL)):
            steps = np.arange(1, len(values) + 1)
            thin = {**look, "linewidth": 1.0}
            ax.plot(steps, values, label=label, marker="o", markersize=3, **thin)
        ax.xaxis.get_major_locator().set_params(integer=True)
    return figure
