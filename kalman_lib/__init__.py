"""The small helper package of the book: models, simulation, filters and error measures."""

from .fast import kalman_filter, rts_smooth, smooth_runs
from .filters import FilterResult, SmootherResult, predict, update
from .metrics import chi2_bounds, degrees_of_freedom, nees, nis, rmse
from .models import LinearModel, NonlinearModel, subtract
from .simulate import Trajectory, simulate

_LATER = {  # names of the rooms that are opened when they are first used
    "montecarlo": ("mismatch_map", "monte_carlo"),
    "tuning": ("check_jacobians", "discretise", "fit", "log_likelihood", "steady", "whiteness"),
}

__all__ = [
    "FilterResult",
    "LinearModel",
    "NonlinearModel",
    "SmootherResult",
    "Trajectory",
    "chi2_bounds",
    "degrees_of_freedom",
    "kalman_filter",
    "nees",
    "nis",
    "predict",
    "rmse",
    "rts_smooth",
    "simulate",
    "smooth_runs",
    "subtract",
    "update",
    *(name for names in _LATER.values() for name in names),
]


def __getattr__(name):
    """A function of a room that is opened when it is first used."""
    for room, names in _LATER.items():
        if name in names:
            from importlib import import_module

            return getattr(import_module(f".{room}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
