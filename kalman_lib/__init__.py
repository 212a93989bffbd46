"""The small helper package of the book: models, simulation, filters and error measures."""
from .fast import kalman_filter, rts_smooth, smooth_runs
from .filters import FilterResult, SmootherResult, predict, update
from .metrics import chi2_bounds, nees, nis, rmse
from .models import LinearModel, NonlinearModel, subtract
from .simulate import Trajectory
from .tuning import check_jacobians, discretise, fit, log_likelihood, steady, whiteness

__all__ = ["FilterResult", "LinearModel", "NonlinearModel", "SmootherResult", "Trajectory",
           "check_jacobians", "chi2_bounds", "discretise", "fit", "kalman_filter", "log_likelihood", "mismatch_map",
           "monte_carlo", "nees", "nis", "predict", "rmse", "rts_smooth", "smooth_runs", "steady", "subtract", "update",
           "whiteness"]


def __getattr__(name):
    """monte_carlo and mismatch_map are imported when they are first used."""
    if name in ("mismatch_map", "monte_carlo"):
        from . import montecarlo
        return getattr(montecarlo, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
