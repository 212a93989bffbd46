"""Draws the picture of the cover from a real run of the filter, so that it is computed, not painted."""
from pathlib import Path

import numpy as np

import offline

FILE = offline.VENDOR / "cover.png"
SOURCES = [Path(__file__), *(offline.BOOK.parent / "kalman_lib").rglob("*.py")]


def draw(app=None):
    """A synthetic wave, measured with noise and tracked by a filter that knows position and velocity only.

    Only when a file that has a say in it is newer than the picture.
    """
    if FILE.exists() and FILE.stat().st_mtime > max(path.stat().st_mtime for path in SOURCES):
        return
    from kalman_lib import LinearModel, kalman_filter

    rng = np.random.default_rng(1960)
    t = np.arange(60.0)
    truth = 3 * np.sin(t / 9) + 0.02 * t
    z = truth + rng.normal(0, 1, len(t))
    model = LinearModel(F=[[1, 1], [0, 1]], H=[[1, 0]], Q=0.008 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]), R=1,
                        x0=[0, 0], P0=np.eye(2))
    result = kalman_filter(model, z)
    moments = [(k, (result.x_pred[k, 0], result.P_pred[k, 0, 0]), (z[k], 1), (result.x[k, 0], result.P[k, 0, 0]))
               for k in (1, 21, 48)]
    figure = picture(t, z, result.x[:, 0], np.sqrt(result.P[:, 0, 0]), truth, moments)
    offline.write_if_new(FILE, figure.png())


def picture(t, z, x, sigma, truth, moments, height=4.2):
    """A run as in plots.series, and below it the bell curves of three moments of that run.

    moments is a list of (k, prediction, measurement, estimate), each of the latter a (mean, variance).
    """
    from matplotlib import style

    from kalman_lib import plots

    figure = plots.series(t, z, x, sigma, truth, xlabel="", height=height)
    with style.context(plots.STYLE):
        run = figure.axes[0]
        grid = figure.add_gridspec(2, 3, height_ratios=(2.2, 1))
        run.set_subplotspec(grid[0, :])
        run.set(xticks=[], yticks=[])
        run.grid(False)
        for name, place, (k, *beliefs) in zip("abc", range(3), moments):
            run.axvline(t[k], color=plots.GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
            run.text(t[k], 1, name, transform=run.get_xaxis_transform(), ha="center", va="top", color=plots.DARK,
                     fontweight="bold", backgroundcolor=plots.PAPER)
            means, sigmas = np.array([[mean, np.sqrt(variance)] for mean, variance in beliefs[:2]]).T
            places = np.linspace((means - 2.6 * sigmas).min(), (means + 2.6 * sigmas).max(), 300)
            ax = figure.add_subplot(grid[1, place])
            for belief, look in zip(beliefs, (plots.PREDICTION, plots.MEASUREMENT, plots.ESTIMATE)):
                plots.bell(ax, places, *belief, {**look, "linewidth": 1.6})
            ax.set(xticks=[], yticks=[], ylim=(0, None))
            ax.set_title(name, fontweight="bold", color=plots.DARK)
            ax.spines["left"].set_visible(False)
    return figure


def setup(app):
    app.connect("builder-inited", draw)
    return {"parallel_read_safe": True}
