"""The small helper package of the book: models, simulation, filters and error measures."""
from .fast import kalman_filter, rts_smooth, smooth_runs
from .filters import FilterResult, SmootherResult, predict, update
from .metrics import chi2_bounds, degrees_of_freedom, nees, nis, rmse
from .models import LinearModel, NonlinearModel, subtract
from .simulate import Trajectory, simulate

_LATER = {"mismatch_map": "montecarlo", "monte_carlo": "montecarlo"}    # rooms that are opened when first used

__all__ = ["FilterResult", "LinearModel", "NonlinearModel", "SmootherResult", "Trajectory", "chi2_bounds",
           "degrees_of_freedom", "kalman_filter", "nees", "nis", "predict", "rmse", "rts_smooth", "simulate", "smooth_runs",
           "subtract", "update", *_LATER]


def __getattr__(name):
    """Functions of the rooms that are opened when they are first used."""
    if name in _LATER:
        from importlib import import_module
        return getattr(import_module(f".{_LATER[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
