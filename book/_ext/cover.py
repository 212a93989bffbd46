"""Draws the picture of the cover from a real run of the filter: it is computed, not painted."""

from pathlib import Path

import numpy as np
import offline

FILE = offline.VENDOR / "cover.png"
SOURCES = [Path(__file__), *(offline.BOOK.parent / "kalman_lib").rglob("*.py")]
MOMENTS = {"a": 1, "b": 21, "c": 48}  # steps whose bell curves are drawn


def draw(app=None):
    """A synthetic wave, measured with noise; the filter knows position and velocity only.

    Only when a file that has a say in it is newer than the picture.
    """
    if FILE.exists() and FILE.stat().st_mtime > max(path.stat().st_mtime for path in SOURCES):
        return
    from kalman_lib import LinearModel, kalman_filter

    rng = np.random.default_rng(1960)
    t = np.arange(60.0)
    truth = 3 * np.sin(t / 9) + 0.02 * t
    z = truth + rng.normal(0, 1, len(t))
    model = LinearModel(
        F=[[1, 1], [0, 1]],
        H=[[1, 0]],
        Q=0.008 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]),
        R=1,
        x0=[0, 0],
        P0=np.eye(2),
    )
    offline.write_if_new(FILE, picture(t, z, kalman_filter(model, z), truth).png())


def picture(t, z, result, truth, height=4.2):
    """The run as in plots.series, and below it the bell curves of three moments of that run."""
    from matplotlib import style

    from kalman_lib import plots

    x, sigma = result.x[:, 0], np.sqrt(result.P[:, 0, 0])
    figure = plots.series(t, z, x, sigma, truth, xlabel="", height=height)
    with style.context(plots.STYLE):
        run = figure.axes[0]
        grid = figure.add_gridspec(2, 3, height_ratios=(2.2, 1))
        run.set_subplotspec(grid[0, :])
        run.set(xticks=[], yticks=[])
        run.grid(False)
        for place, (name, k) in enumerate(MOMENTS.items()):
            mark(run, t[k], name)
            draw_moment(figure.add_subplot(grid[1, place]), name, result, z, k)
    return figure


def mark(run, t, name):
    """A dotted line through the run, with its name at the top."""
    from kalman_lib import plots

    run.axvline(t, color=plots.GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
    run.text(
        t,
        1,
        name,
        transform=run.get_xaxis_transform(),
        ha="center",
        va="top",
        color=plots.DARK,
        fontweight="bold",
        backgroundcolor=plots.PAPER,
    )


def draw_moment(ax, name, result, z, k):
    """Prediction, measurement and estimate of step k as bell curves."""
    from kalman_lib import plots

    prediction = result.x_pred[k, 0], result.P_pred[k, 0, 0]
    measurement = z[k], 1
    estimate = result.x[k, 0], result.P[k, 0, 0]
    means = np.array([prediction[0], measurement[0]])
    sigmas = np.sqrt([prediction[1], measurement[1]])
    places = np.linspace((means - 2.6 * sigmas).min(), (means + 2.6 * sigmas).max(), 300)
    for (mean, variance), look in (
        (prediction, plots.PREDICTION),
        (measurement, plots.MEASUREMENT),
        (estimate, plots.ESTIMATE),
    ):
        plots.bell(ax, places, mean, variance, {**look, "linewidth": 1.6})
    ax.set(xticks=[], yticks=[], ylim=(0, None))
    ax.set_title(name, fontweight="bold", color=plots.DARK)
    ax.spines["left"].set_visible(False)


def setup(app):
    app.connect("builder-inited", draw)
    return {"parallel_read_safe": True}
