"""Monte Carlo: the same experiment many times with fresh noise, on one processor or on a whole cluster.

The runs are cut into blocks of fixed size, and every block has a seed of its own, spawned from the generator that is
given (numpy SeedSequence.spawn). So the numbers are the same to the last bit for no executor, for one process, two, or a
cluster, in whatever order the blocks come back, and also if a worker dies and its block is computed again.
"""
import importlib
import inspect
import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .fast import kalman_filter
from .models import LinearModel

BLOCK = 500             # runs that share a seed; another number gives other noise


@dataclass(frozen=True, eq=False)
class Study:
    """The finished blocks of a study, by their number, and the seeds of all; interrupted, it can go on (resume=)."""
    seeds: list
    blocks: dict
    total: int

    @property
    def complete(self):
        return len(self.blocks) == self.total

    def collect(self, name):
        """What all finished blocks say about `name`, in the order of the blocks."""
        return [self.blocks[i][name] for i in sorted(self.blocks)]


@dataclass(frozen=True, eq=False)
class MonteCarlo(Study):
    """rmse (n, runs) of every run over time; over the runs: error (T, n, n), the mean of e e', which an honest filter's
    P (T, n, n) equals, and nees (T,), whose expectation is n."""

    @property
    def runs(self):
        return sum(self.collect("runs"))

    @property
    def rmse(self):
        return np.concatenate(self.collect("rmse"), axis=1)

    @property
    def error(self):
        return sum(self.collect("error")) / self.runs

    @property
    def P(self):
        return sum(self.collect("P")) / self.runs

    @property
    def nees(self):
        return sum(self.collect("nees")) / self.runs


@dataclass(frozen=True, eq=False)
class MismatchMap(Study):
    """Assumed value by assumed value: rmse (n, rows, columns) and nees (rows, columns) over all runs and steps.

    Rows and columns are the values of `assumed`, a dict with two fields of the Params; NaN where nothing is finished.
    """
    assumed: dict

    def _cells(self, name):
        """The mean of `name` over all finished blocks of runs, (rows, columns, ...)."""
        shape = tuple(len(values) for values in self.assumed.values())
        entry = next(iter(self.blocks.values()))[name] if self.blocks else np.zeros(shape[1])
        total, weight = np.zeros((shape[0], *entry.shape)), np.zeros(shape[0])
        for i in sorted(self.blocks):
            total[i % shape[0]] += self.blocks[i][name]
            weight[i % shape[0]] += self.blocks[i]["weight"]
        with np.errstate(invalid="ignore"):
            return total / weight.reshape(-1, *[1] * (total.ndim - 1))

    @property
    def rmse(self):
        return np.sqrt(np.moveaxis(self._cells("square"), -1, 0))

    @property
    def nees(self):
        return self._cells("nees")


def monte_carlo(paper, params, runs, rng, executor=None, assumed=None, resume=None):
    """Simulate a paper's experiment `runs` times, and filter every run -> MonteCarlo.

    paper    module with Params, model(p) and simulate(p, rng)
    params   the truth; assumed: what the filter believes (None: the truth)
    rng      numpy Generator
    executor any concurrent.futures.Executor, also Client(...).get_executor() of Dask; None: in this process
    resume   an interrupted MonteCarlo of the same study, whose blocks are not computed again; rng is not used then

    Ctrl+C (in Jupyter: interrupt the kernel) ends it early and gives what is finished; so does, with a warning, an
    executor that breaks, as a ProcessPoolExecutor does when one of its processes dies. `complete` tells.
    """
    sizes = [min(BLOCK, runs - first) for first in range(0, runs, BLOCK)]
    seeds = _seeds(rng, len(sizes)) if resume is None else resume.seeds
    tasks = [(_block, paper.__name__, params, assumed or params, size, seed) for size, seed in zip(sizes, seeds)]
    return MonteCarlo(seeds, _work(tasks, executor, resume), len(tasks))


def mismatch_map(paper, params, assumed, runs, rng, executor=None, resume=None):
    """What a wrong Q or R costs: the same runs filtered under every pair of assumptions -> MismatchMap.

    assumed  dict with two fields of the Params, each with the values that the filter is to believe in, for example
             {"sigma_w": [...], "sigma_v": [...]}; the truth is in params. The rest is as in monte_carlo.
    """
    (row_name, row_values), (column_name, column_values) = assumed.items()
    sizes = [min(BLOCK, runs - first) for first in range(0, runs, BLOCK)]
    seeds = _seeds(rng, len(sizes)) if resume is None else resume.seeds
    tasks = [(_row, paper.__name__, params, [replace(params, **{row_name: row, column_name: column})
                                             for column in column_values], size, seed)
             for size, seed in zip(sizes, seeds) for row in row_values]
    return MismatchMap(seeds, _work(tasks, executor, resume), len(tasks), assumed)


# --- what a worker does ----------------------------------------------------------------------------------------------

def _block(paper, params, assumed, runs, seed):
    """One block of a MonteCarlo: sums over its runs."""
    paper = importlib.import_module(paper)
    x, z, u = simulate_runs(paper, params, np.random.default_rng(seed), runs)
    estimate, P = filter_runs(paper.model(assumed), z, u)
    e = x - estimate
    shared = P.ndim == 3
    error = e @ e.swapaxes(1, 2)
    return {"runs": runs, "rmse": np.sqrt(np.mean(e ** 2, axis=0)), "error": error,
            "P": runs * P if shared else P.sum(axis=-1), "nees": _nees(e, error, P)}


def _row(paper, params, assumptions, runs, seed):
    """One row of a MismatchMap for a block of runs: sums over runs and steps, column by column."""
    paper = importlib.import_module(paper)
    x, z, u = simulate_runs(paper, params, np.random.default_rng(seed), runs)
    square, nees = [], []
    for p in assumptions:
        estimate, P = filter_runs(paper.model(p), z, u)
        e = np.subtract(x, estimate, out=estimate)
        error = e @ e.swapaxes(1, 2)
        square.append(np.einsum("kii->i", error))
        nees.append(_nees(e, error, P).sum())
    return {"weight": runs * len(x), "square": np.array(square), "nees": np.array(nees)}


def _nees(e, error, P):
    """The sum over the runs of e' P^-1 e, (T,). Where all runs share P it is the trace of P^-1 times the sum of e e'."""
    if P.ndim == 3:
        return np.einsum("kii->k", np.linalg.solve(P, error))
    return np.einsum("kir,rki->k", e, np.linalg.solve(P.transpose(3, 0, 1, 2), e.transpose(2, 0, 1)[..., np.newaxis])[..., 0])


def simulate_runs(paper, params, rng, runs):
    """x (T, n, runs), z (T, m, runs) and the common u (T, l) or None."""
    if "runs" in inspect.signature(paper.simulate).parameters:
        flight = paper.simulate(params, rng, runs=runs)
        return flight.x, flight.z, flight.u
    flights = [paper.simulate(params, rng) for _ in range(runs)]
    return np.stack([f.x for f in flights], axis=-1), np.stack([f.z for f in flights], axis=-1), flights[0].u


def filter_runs(model, z, u):
    """The estimates x (T, n, runs), and P (T, n, n) or, where every run has its own, (T, n, n, runs)."""
    linear = isinstance(model, LinearModel) and model.R.ndim == 2 and not np.isnan(z.max())
    if linear or (getattr(model, "many_runs", False) and z.shape[1] == 1):
        result = kalman_filter(model, z, u)
        return result.x, result.P
    results = [kalman_filter(model, z[:, :, run], u) for run in range(z.shape[2])]
    return np.stack([r.x for r in results], axis=-1), np.stack([r.P for r in results], axis=-1)


# --- who does it -----------------------------------------------------------------------------------------------------

def _seeds(rng, blocks):
    return rng.bit_generator.seed_seq.spawn(blocks)


def _work(tasks, executor, resume):
    """Do what is not yet done -> number of the task -> its answer; interrupted: those that are finished."""
    done = {} if resume is None else dict(resume.blocks)
    with _progress(len(tasks), len(done)) as bar:
        try:
            if executor is None:
                for i in range(len(tasks)):
                    if i not in done:
                        function, *arguments = tasks[i]
                        done[i] = function(*arguments)
                        bar.update()
            else:
                for last in (False, False, True):
                    _hand_out(tasks, executor, done, bar, last)
        except KeyboardInterrupt:
            print(f"{len(done)} / {len(tasks)} (resume=...)")
        except Exception as error:
            from concurrent.futures import BrokenExecutor
            if not (done and isinstance(error, BrokenExecutor)):
                raise
            warnings.warn(f"A process of the executor died, and with it the executor; {len(done)} of {len(tasks)} blocks are "
                          "finished: go on with resume= and another executor. / Satu proses eksekutor mati, dan eksekutornya "
                          f"ikut berakhir; {len(done)} dari {len(tasks)} blok selesai: lanjutkan dengan resume= dan eksekutor "
                          "lain.", stacklevel=3)
    return done


def _hand_out(tasks, executor, done, bar, last):
    """Let the executor do what is left. A block that fails is left for the next round: its worker may have died, and the
    seed makes its numbers the same again. If all fail, or some still do in the last round, it is not the worker."""
    from concurrent.futures import as_completed
    futures = {executor.submit(*tasks[i]): i for i in range(len(tasks)) if i not in done}
    errors = []
    try:
        for future in as_completed(futures):
            try:
                done[futures[future]] = future.result()
                bar.update()
            except Exception as error:
                errors.append(error)
    except KeyboardInterrupt:
        for future, i in futures.items():       # what has finished meanwhile counts, too
            if not future.cancel() and future.done() and future.exception() is None:
                done[i] = future.result()
        raise
    if errors and (last or len(errors) == len(futures)):
        raise errors[0]


def _progress(total, initial):
    """A progress bar for what takes longer than a second; none without tqdm, or where TQDM_DISABLE is set."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Silent()
    return tqdm(total=total, initial=initial, delay=1, leave=False, disable=bool(os.environ.get("TQDM_DISABLE")))


class _Silent:
    update: Callable = staticmethod(lambda: None)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return False
