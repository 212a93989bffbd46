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
    from kalman_lib import LinearModel, kalman_filter, plots

    rng = np.random.default_rng(1960)
    t = np.arange(60.0)
    truth = 3 * np.sin(t / 9) + 0.02 * t
    z = truth + rng.normal(0, 1, len(t))
    model = LinearModel(F=[[1, 1], [0, 1]], H=[[1, 0]], Q=0.008 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]), R=1,
                        x0=[0, 0], P0=np.eye(2))
    result = kalman_filter(model, z)
    moments = [(k, (result.x_pred[k, 0], result.P_pred[k, 0, 0]), (z[k], 1), (result.x[k, 0], result.P[k, 0, 0]))
               for k in (1, 21, 48)]
    figure = plots.cover(t, z, result.x[:, 0], np.sqrt(result.P[:, 0, 0]), truth, moments)
    offline.write_if_new(FILE, figure.png())


def setup(app):
    app.connect("builder-inited", draw)
    return {"parallel_read_safe": True}
