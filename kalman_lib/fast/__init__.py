"""The same results sooner. To understand the book, nobody needs to read this: see `filters.py`.

A form is chosen by itself where it gives what the readable loop gives, to 1e-12
(tests/test_fast.py); where rounding is in the way (`rounding.py`), or nothing fits, the loop does
the work.

numbers.py    one state, one sensor, in plain Python numbers
states.py     some states, entry by entry (entries.py) until the gain settles; from there on in one
              go (scan.py)
blocks.py     a long series with gaps, or with an R that changes in time, as many short ones side by
              side
runs.py       many runs of a linear model, which share their gains
extended.py   many runs of a nonlinear model with one sensor
smoothing.py  the smoothers of these results
lazy.py       results that compute what is asked for
"""

import functools

import numpy as np

from .. import filters, many
from ..checks import check_series, series, shaped_series, steps_of
from ..models import LinearModel, NonlinearModel, subtract
from . import extended, runs, smoothing, states
from .parts import Series

SHORT = 50  # steps: the loop itself is quick enough


@functools.wraps(filters.kalman_filter)
def kalman_filter(model, z, u=None, adapt_R=None, gate=None):
    if adapt_R is None and gate is None:
        try:
            quick = _quick(model, z, u)
        except np.linalg.LinAlgError:  # rounding has made a matrix singular that is not
            quick = None
        if quick is not None:
            return quick
    return filters.kalman_filter(model, z, u, adapt_R, gate)


def for_likelihood(model, z, u=None):
    """kalman_filter for a search that runs it a thousand times.

    It is fast also where the data lie far from zero: there y differs from the loop's by what
    rounding has done to z, which no likelihood can tell.
    """
    try:
        quick = _quick(model, z, u, strict=False)
    except np.linalg.LinAlgError:
        quick = None
    return filters.kalman_filter(model, z, u) if quick is None else quick


def _quick(model, z, u, strict=True):
    """The FilterResult of a fast form, or None.

    Then the loop does it, and says what is wrong if something is. strict: only where it is the
    loop's to 1e-12, however far from zero the data lie.
    """
    if not hasattr(model, "transition"):
        return None
    nonlinear = isinstance(model, NonlinearModel)
    copy = nonlinear or getattr(z, "ndim", 0) != 3  # else runs.py copies z in passing
    z = shaped_series("z", z, width=model.R.shape[-1], runs=True, copy=copy)
    if nonlinear or z.ndim == 2:  # else what is not finite shows at the end
        check_series("z", z)
    steps_of(model, len(z))
    u = None if u is None else series("u", u, steps=len(z))
    if not np.isfinite(model.R).all():
        return None
    if nonlinear:
        fixed = model.R.ndim == model.Q.ndim == 2
        runs_of_one_sensor = z.ndim == 3 and z.shape[1] == 1
        fits = runs_of_one_sensor and model.many_runs and fixed
        return extended.filter_runs(model, z, u) if fits else None
    if len(z) < SHORT or not _plain(model, u):
        return None
    s = Series.of(model, z, u)
    if z.ndim == 3:
        return runs.filter_runs(s)
    return states.filter_series(s, strict)


def _plain(model, u):
    """A linear model, fixed but for R, with the usual residual, and an input that fits it."""
    if not isinstance(model, LinearModel) or model.residual is not subtract:
        return False
    if any(M is not None and M.ndim == 3 for M in (model.F, model.H, model.Q, model.B)):
        return False
    return u is None or (model.B is not None and u.shape[1] == model.B.shape[1])


@functools.wraps(filters.rts_smooth)
def rts_smooth(result):
    quick = _quick_smooth(result) if result.x.ndim == 2 else None
    return filters.rts_smooth(result) if quick is None else quick


def smooth_runs(result):
    """rts_smooth of many runs at once: FilterResult -> SmootherResult, x (T, n, N) of both.

    P is (T, n, n), the same for all runs, or (T, n, n, N) where they do not share it.
    """
    if result.x.ndim != 3:
        raise ValueError(
            "smooth_runs takes the result of kalman_filter for many runs, x of shape (T, n, N). / "
            "smooth_runs menerima hasil kalman_filter untuk banyak percobaan, "
            "x berukuran (T, n, N)."
        )
    quick = _quick_smooth(result)
    return many.smooth_runs(result) if quick is None else quick


def _quick_smooth(result):
    """The SmootherResult of a fast form, or None."""
    try:
        return smoothing.smooth(result)
    except np.linalg.LinAlgError:
        return None
