"""Paper and pen of the pictures: small, few lines, labels of at least 12 pixels on a phone."""

from contextlib import contextmanager

from kalman_lib import plots

WIDTH = 3.8  # inches
HEIGHT = 2.2
DOTS = 220  # per inch: twice what the widest page shows
LABEL = 12  # points; on a column of 350 pixels 15 pixels

BLUE = plots.ESTIMATE["color"]
ORANGE = plots.MEASUREMENT["color"]
PURPLE = plots.PREDICTION["color"]
GREY, DARK, PAPER = plots.GREY, plots.DARK, plots.PAPER
PALE_BLUE = "#d9e6f1"  # BLUE as a wash
PALE_GREY = "#dedbd1"

PEN = {
    **plots.STYLE,
    "font.size": LABEL,
    "axes.labelsize": LABEL + 2,
    "xtick.labelsize": LABEL,
    "ytick.labelsize": LABEL,
    "axes.grid": False,
}


class Picture(plots.Figure):
    """A figure that is stored at twice its size on the page."""

    def png(self, dpi=DOTS):
        return super().png(dpi)


@contextmanager
def paper(height=HEIGHT, rows=1, columns=1, **names):
    """A picture and its axes; the names (labels, limits, ticks) hold for all axes."""
    from matplotlib import style
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with style.context(PEN):
        picture = Picture(figsize=(WIDTH, height))
        FigureCanvasAgg(picture)
        yield picture, picture.subplots(rows, columns)
        for ax in picture.axes:
            ax.set(**names)


def arrow(ax, start, end, color, width=2.0):
    """An arrow from one point to another, in the units of the axes."""
    look = dict(
        arrowstyle="-|>",
        color=color,
        linewidth=width,
        shrinkA=0,
        shrinkB=0,
        mutation_scale=13,
    )
    ax.annotate("", end, start, arrowprops=look, annotation_clip=False)


def bare(ax):
    """Neither frame nor ticks."""
    ax.set(xticks=[], yticks=[])
    for spine in ax.spines.values():
        spine.set_visible(False)


def cross(ax):
    """The axes through zero as thin lines."""
    ax.axhline(0, color=GREY, linewidth=0.8, zorder=0)
    ax.axvline(0, color=GREY, linewidth=0.8, zorder=0)
