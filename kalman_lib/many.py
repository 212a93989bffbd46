"""Many runs of one linear model at once, as a Monte Carlo study needs them: z (T, m, N).

What holds no data, P, S and K, is computed once. Read on in fast/runs.py for the same, sooner.
"""

from dataclasses import fields, replace

import numpy as np

from .filters import FilterResult, SmootherResult, kalman_filter, rts_smooth
from .models import LinearModel, at, subtract


def filter_runs(model, z, u, adapt_R, gate):
    """The FilterResult of z (T, m, N), as kalman_filter describes it."""
    many_runs = getattr(model, "many_runs", False)
    linear = isinstance(model, LinearModel) and model.residual is subtract
    if not (linear or many_runs) or adapt_R or gate:
        raise ValueError(
            "z of shape (T, m, N) needs a LinearModel with the usual residual, and neither adapt_R "
            "nor gate; filter run by run. / z berukuran (T, m, N) memerlukan LinearModel dengan "
            "residu biasa, tanpa adapt_R dan gate; filterlah satu per satu."
        )
    silent = np.isnan(z)
    if many_runs or (silent != silent[:, :, :1]).any():
        return _stacked([kalman_filter(model, z[:, :, run], u) for run in range(z.shape[2])])
    return _sharing(model, z, u, silent[:, :, 0])


def _sharing(model, z, u, silent):
    """Runs that hear the same sensors, silent (T, m), share P, S and K, which hold no data."""
    shared = kalman_filter(model, np.where(silent, np.nan, 0.0), u)
    T, _, runs = z.shape
    n = len(model.x0)
    x_pred = np.empty((T, n, runs))
    x = np.empty((T, n, runs))
    y = np.empty(z.shape)
    x_k = np.repeat(model.x0[:, np.newaxis], runs, axis=1)
    for k in range(T):
        Bu = 0 if u is None else at(model.B, k) @ u[k]
        x_pred[k] = shared.F[k] @ x_k + np.reshape(Bu, (-1, 1))
        nothing = shared.y[k][:, np.newaxis] * 0  # NaN where a sensor is silent
        y[k] = z[k] - shared.H[k] @ x_pred[k] + nothing
        x_k = x_pred[k] + shared.K[k] @ np.nan_to_num(y[k])
        x[k] = x_k
    return replace(shared, x_pred=x_pred, x=x, y=y, gated=np.zeros(z.shape, dtype=bool))


def smooth_runs(result):
    """rts_smooth of many runs, run by run: x (T, n, N) and P (T, n, n).

    P is (T, n, n, N) where the runs do not share it.
    """
    each = [rts_smooth(run_of(result, run)) for run in range(result.x.shape[2])]
    x = np.stack([smooth.x for smooth in each], axis=-1)
    if result.P.ndim == 3:
        return SmootherResult(x, each[0].P)
    return SmootherResult(x, np.stack([smooth.P for smooth in each], axis=-1))


def run_of(result, run):
    """The FilterResult of one run of many."""
    parts = {"start": result.start}
    for part in fields(FilterResult):
        array = getattr(result, part.name)
        if part.name != "start":
            size = 2 if part.name in ("x_pred", "x", "y", "gated") else 3
            parts[part.name] = array if array is None or array.ndim <= size else array[..., run]
    return FilterResult(**parts)


def _stacked(results):
    """Runs that differ in everything but the model: their arrays side by side, the runs last."""
    common = {name: getattr(results[0], name) for name in ("R", "Q", "start")}
    F, H = results[0].F, results[0].H
    if all(np.array_equal(r.F, F) and np.array_equal(r.H, H) for r in results):
        common |= {"F": F, "H": H}
    names = [field.name for field in fields(FilterResult) if field.name not in common]
    own = {name: np.stack([getattr(r, name) for r in results], axis=-1) for name in names}
    return FilterResult(**common, **own)
