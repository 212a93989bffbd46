"""A figure in the book's style: how the functions of this room begin and end one."""

import io
import sys
from contextlib import contextmanager

import numpy as np
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as MatplotlibFigure
from PIL import Image

from .styles import STYLE

WIDTH = 4.8  # inches
BESIDE = 0.45  # inches of a figure that axes leave to their numbers and names
SHOWN_WIDTH = 600  # pixels: half of what is drawn
COLOURS = 96  # a third of the size of a file with all


class Figure(MatplotlibFigure):
    """A matplotlib figure that shows itself in a notebook without pyplot and its global state."""

    def _repr_png_(self):
        return self.png(), {"width": SHOWN_WIDTH}

    def png(self, dpi=200):
        """The bytes of a PNG file with at most 96 colours."""
        with style.context(STYLE):
            self.set_dpi(dpi)
            self.draw_without_rendering()  # the layout first: it decides how many ticks there are
            self.canvas.draw()
        image = Image.fromarray(np.asarray(self.canvas.buffer_rgba())).convert("RGB")
        buffer = io.BytesIO()
        few_colours = image.quantize(COLOURS, dither=Image.Dither.NONE)
        few_colours.save(buffer, format="png", optimize=True)
        return buffer.getvalue()


def print_ours_ourselves():
    """Our figures print themselves in a notebook.

    Otherwise pyplot, and with it `interact`, would print every figure of matplotlib its own way.
    """
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is not None:
        shell.display_formatter.formatters["image/png"].for_type(Figure, Figure._repr_png_)


print_ours_ourselves()


@contextmanager
def new_figure(height, rows=1, columns=1, sharex=False, **names):
    """A figure and its axes, which get names and a legend at the end of the block."""
    with style.context(STYLE):
        figure = Figure(figsize=(WIDTH, height))
        FigureCanvasAgg(figure)
        yield figure, figure.subplots(rows, columns, sharex=sharex)
        for ax in figure.axes:
            ax.set(**names)
            add_legend(ax)


def add_legend(ax):
    """A legend above the axes, where it can cover no data, in as many columns as there is room
    for: a wider one would take its room from the axes."""
    handles, labels = ax.get_legend_handles_labels()
    place = ax.get_subplotspec()
    columns = place.get_gridspec().ncols if place else 1
    room = ax.figure.bbox.width / columns - BESIDE * ax.figure.dpi
    for ncols in range(min(len(labels), 4), 0, -1):
        legend = ax.legend(
            handles,
            labels,
            loc="lower left",
            bbox_to_anchor=(-0.02, 1.0),
            ncols=ncols,
            borderaxespad=0.1,
            columnspacing=1.1,
            handletextpad=0.5,
        )
        if legend.get_window_extent().width <= room:
            return
