"""Many runs of one linear model at once, as a Monte Carlo study needs them: z (T, m, N).

What holds no data, P, S and K, is computed once. Read on in fast/runs.py for the same, sooner.
"""
from dataclasses import fields, replace

import numpy as np

from .filters import FilterResult, SmootherResult, kalman_filter, rts_smooth
from .models import LinearModel, at, subtract


def filter_runs(model, z, u, adapt_R, gate):
    """z (T, m, N): where all runs hear the same sensors, they share P, S and K, which hold no data."""
    if not isinstance(model, LinearModel) or model.residual is not subtract or adapt_R or gate:
        raise ValueError("z of shape (T, m, N) needs a LinearModel with the usual residual, and neither adapt_R nor "
                         "gate; filter run by run. / z berukuran (T, m, N) memerlukan LinearModel dengan residu "
                         "biasa, tanpa adapt_R dan gate; filterlah satu per satu.")
    silent = np.isnan(z)
    if (silent != silent[:, :, :1]).any():
        return _stacked([kalman_filter(model, z[:, :, run], u) for run in range(z.shape[2])])
    shared = kalman_filter(model, np.where(silent[:, :, 0], np.nan, 0.0), u)
    x_pred, x = (np.empty((len(z), len(model.x0), z.shape[2])) for _ in range(2))
    y = np.empty(z.shape)
    x_k = np.repeat(model.x0[:, np.newaxis], z.shape[2], axis=1)
    for k in range(len(z)):
        Bu = 0 if u is None else at(model.B, k) @ u[k]
        x_pred[k] = shared.F[k] @ x_k + np.reshape(Bu, (-1, 1))
        y[k] = z[k] - shared.H[k] @ x_pred[k] + shared.y[k][:, np.newaxis] * 0     # NaN where a sensor is silent
        x_k = x_pred[k] + shared.K[k] @ np.nan_to_num(y[k])
        x[k] = x_k
    return replace(shared, x_pred=x_pred, x=x, y=y, gated=np.zeros(z.shape, dtype=bool))


def smooth_runs(result):
    """rts_smooth of many runs, run by run: x (T, n, N) and P (T, n, n), or (T, n, n, N) where runs do not share it."""
    shared = result.P.ndim == 3
    each = []
    for run in range(result.x.shape[2]):
        def of_run(name, shape):
            array = getattr(result, name)
            return array if array is None or array.ndim <= shape else array[..., run]
        one = {name: of_run(name, 2) for name in ("x_pred", "x", "y", "gated")}
        one |= {name: of_run(name, 3) for name in ("P_pred", "P", "S", "K", "F", "R", "H", "Q")}
        each.append(rts_smooth(FilterResult(**one, start=result.start)))
    P = each[0].P if shared else np.stack([smooth.P for smooth in each], axis=-1)
    return SmootherResult(np.stack([smooth.x for smooth in each], axis=-1), P)


def _stacked(results):
    """Runs that differ in everything but the model: their arrays side by side, the runs last."""
    common = {name: getattr(results[0], name) for name in ("F", "R", "H", "Q", "start")}
    names = [field.name for field in fields(FilterResult) if field.name not in common]
    return FilterResult(**common, **{name: np.stack([getattr(r, name) for r in results], axis=-1) for name in names})
