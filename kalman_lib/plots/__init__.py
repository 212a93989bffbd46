"""The figures of the book. The only room that imports matplotlib; it never runs a filter.

Every function returns a Figure that shows itself as the last value of a cell, with symbols and
units only, so that it serves both languages. Where a dict is asked for, its keys are the labels;
heights are in inches.

    styles.py        colours and lines: one look means one thing in every chapter
    figure.py        Figure, and how a function below begins and ends one
    over_time.py     series, panels, consistency
    curves.py        curve, gaussians, intervals
    planes.py        ellipses, plane, surface, contours, poles
    attitude.py      craft
"""

from .attitude import craft
from .curves import bell, curve, gaussians, intervals
from .figure import Figure
from .over_time import consistency, panels, series
from .planes import contours, covariance_ellipse, ellipses, plane, poles, surface
from .styles import (
    BAND,
    DARK,
    EDGE,
    ESTIMATE,
    GREY,
    GRID,
    MEASUREMENT,
    PALE,
    PAPER,
    PREDICTION,
    RIVAL,
    STYLE,
    TRUTH,
)

__all__ = [
    "BAND",
    "DARK",
    "EDGE",
    "ESTIMATE",
    "Figure",
    "GREY",
    "GRID",
    "MEASUREMENT",
    "PALE",
    "PAPER",
    "PREDICTION",
    "RIVAL",
    "STYLE",
    "TRUTH",
    "bell",
    "consistency",
    "contours",
    "covariance_ellipse",
    "craft",
    "curve",
    "ellipses",
    "gaussians",
    "intervals",
    "panels",
    "plane",
    "poles",
    "series",
    "surface",
]
