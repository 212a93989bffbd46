"""The small helper package of the book: models, simulation, filters and error measures. Needs NumPy only."""
from .fast import kalman_filter, rts_smooth, smooth_runs
from .filters import FilterResult, SmootherResult, predict, update
from .metrics import chi2_bounds, nees, nis, rmse
from .models import LinearModel, NonlinearModel, subtract
from .montecarlo import mismatch_map, monte_carlo
from .simulate import Trajectory

__all__ = ["FilterResult", "LinearModel", "NonlinearModel", "SmootherResult", "Trajectory", "chi2_bounds",
           "kalman_filter", "mismatch_map", "monte_carlo", "nees", "nis", "predict", "rmse", "rts_smooth", "smooth_runs", "subtract", "update"]
