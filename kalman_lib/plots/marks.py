"""Single points in a figure."""

from .styles import EDGE, MEASUREMENT


def add_points(ax, points, size, marks="osD^v", color=MEASUREMENT["color"], **look):
    """A dict of points (x, y), each with a mark of its own; None: no point."""
    for (label, (x, y)), mark in zip((points or {}).items(), marks):
        ax.plot(x, y, mark, color=color, markersize=size, label=label, **{**EDGE, **look})
