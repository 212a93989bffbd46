"""What a worker does: one block of runs of a study, simulated and filtered.

A worker may be another process or another computer, so a paper comes as the name of its module.
"""

import importlib
import inspect

import numpy as np

from ..fast import kalman_filter
from ..models import LinearModel, subtract


def monte_carlo_block(paper, params, assumed, runs, seed):
    """One block of a MonteCarlo: sums over its runs."""
    paper = importlib.import_module(paper)
    x, z, u = simulate_runs(paper, params, np.random.default_rng(seed), runs)
    estimate, P = filter_runs(paper.model(assumed), z, u)
    e = x - estimate
    error = e @ e.swapaxes(1, 2)
    shared = P.ndim == 3
    return {
        "runs": runs,
        "rmse": np.sqrt(np.mean(e**2, axis=0)),
        "error": error,
        "P": runs * P if shared else P.sum(axis=-1),
        "nees": _nees(e, error, P),
    }


def mismatch_row(paper, params, assumptions, runs, seed):
    """One row of a MismatchMap for a block of runs: sums over runs and steps, column by column."""
    paper = importlib.import_module(paper)
    x, z, u = simulate_runs(paper, params, np.random.default_rng(seed), runs)
    square, nees = [], []
    for assumed in assumptions:
        estimate, P = filter_runs(paper.model(assumed), z, u)
        e = x - estimate
        error = e @ e.swapaxes(1, 2)
        square.append(np.einsum("kii->i", error))
        nees.append(_nees(e, error, P).sum())
    return {
        "runs": runs,
        "weight": runs * len(x),
        "square": np.array(square),
        "nees": np.array(nees),
    }


def simulate_runs(paper, params, rng, runs):
    """x (T, n, runs), z (T, m, runs) and the common u (T, l) or None."""
    if "runs" in inspect.signature(paper.simulate).parameters:
        flight = paper.simulate(params, rng, runs=runs)
        return flight.x, flight.z, flight.u
    flights = [paper.simulate(params, rng) for _ in range(runs)]
    x = np.stack([flight.x for flight in flights], axis=-1)
    z = np.stack([flight.z for flight in flights], axis=-1)
    return x, z, flights[0].u


def filter_runs(model, z, u):
    """The estimates x (T, n, runs), and P: shared (T, n, n), or one for a run (T, n, n, runs)."""
    linear = isinstance(model, LinearModel) and model.residual is subtract
    if linear or (getattr(model, "many_runs", False) and z.shape[1] == 1):
        result = kalman_filter(model, z, u)
        return result.x, result.P
    results = [kalman_filter(model, z[:, :, run], u) for run in range(z.shape[2])]
    x = np.stack([result.x for result in results], axis=-1)
    P = np.stack([result.P for result in results], axis=-1)
    return x, P


def _nees(e, error, P):
    """The sum over the runs of e' P^-1 e, (T,). error: the sum of e e'.

    Where all runs share P it is the trace of P^-1 times the sum of e e'.
    """
    if P.ndim == 3:
        return np.einsum("kii->k", np.linalg.solve(P, error))
    columns = e.transpose(2, 0, 1)[..., np.newaxis]  # (runs, T, n, 1)
    weighted = np.linalg.solve(P.transpose(3, 0, 1, 2), columns)[..., 0]
    return np.einsum("kir,rki->k", e, weighted)
