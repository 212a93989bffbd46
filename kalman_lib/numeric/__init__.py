"""Numerical analysis for the core, which says what it is for.

maximum.py      the top of a function of named numbers, and how well it is known
differences.py  the derivatives of a function
riccati.py      where a filter settles, and whether it does
time_step.py    from continuous time to a step
likelihood.py   the density of innovations, also of sensors that say nearly the same
squares.py      errors in units of what they may be
"""

from .differences import check_derivatives
from .likelihood import almost_singular, log_density, sensor_by_sensor
from .maximum import Fit, check_start, maximise
from .riccati import check_settles, settle
from .squares import normalised_squares
from .time_step import time_step

__all__ = [
    "Fit",
    "almost_singular",
    "check_derivatives",
    "check_settles",
    "check_start",
    "log_density",
    "maximise",
    "normalised_squares",
    "sensor_by_sensor",
    "settle",
    "time_step",
]
