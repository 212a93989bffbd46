"""Monte Carlo: the same experiment many times with fresh noise, on one processor or on a cluster.

The runs are cut into blocks of fixed size, and every block has a seed of its own, spawned from
the generator that is given (numpy SeedSequence.spawn). So the numbers are the same to the last bit
for no executor, for one process, two, or a cluster, in whatever order the blocks come back, and
also if a worker dies and its block is computed again. That holds for one kind of processor and the
same versions of the libraries: others may round the last digit in another way.

In studies/ stands what a worker does, who does it, and what is refused.
"""

import copy
import importlib
from dataclasses import dataclass, field, replace

import numpy as np

from .studies.arguments import (
    check_axes,
    check_call,
    check_kind,
    check_params,
    check_rng,
    check_same,
)
from .studies.blocks import filter_runs, mismatch_row, monte_carlo_block, simulate_runs
from .studies.workers import do

__all__ = [
    "BLOCK",
    "MismatchMap",
    "MonteCarlo",
    "Study",
    "filter_runs",
    "mismatch_map",
    "monte_carlo",
    "simulate_runs",
]

BLOCK = 500  # runs that share a seed; another number gives other noise


@dataclass(frozen=True, eq=False)
class Study:
    """What a study is, and its finished blocks; with resume= it goes on, or becomes larger.

    paper    name of the module
    params   the truth
    assumed  what the filter believes
    planned  runs that were asked for
    seed     SeedSequence whose next children are the seeds of the blocks
    blocks   number of a block -> what its worker answered
    """

    paper: str
    params: object
    assumed: object
    planned: int
    seed: np.random.SeedSequence
    blocks: dict = field(repr=False)

    rows = 1  # how many blocks have the same runs

    @property
    def sizes(self):
        """How many runs share each seed."""
        return [min(BLOCK, self.planned - first) for first in range(0, self.planned, BLOCK)]

    @property
    def total(self):
        return len(self.sizes) * self.rows

    @property
    def complete(self):
        return len(self.blocks) == self.total

    def size(self, number):
        """How many runs the block of this number has."""
        return self.sizes[number // self.rows]

    def seeds(self):
        """A seed for each of the sizes. A larger study has the same ones, and then more."""
        return _twin(self.seed).spawn(len(self.sizes))

    def collect(self, name):
        """What all finished blocks say about `name`, in the order of the blocks."""
        if not self.blocks:
            raise ValueError(
                "No block of this study is finished yet: go on with resume=. / "
                "Belum ada blok studi ini yang selesai: lanjutkan dengan resume=."
            )
        return [self.blocks[i][name] for i in sorted(self.blocks)]


@dataclass(frozen=True, eq=False)
class MonteCarlo(Study):
    """The study of one filter, over all finished runs.

    runs     how many have finished
    rmse     (n, runs), of every run over time
    error    (T, n, n), the mean of e e' over the runs, which an honest filter's P (T, n, n) equals
    nees     (T,), the mean over the runs; its expectation is n
    """

    @property
    def runs(self):
        return sum(block["runs"] for block in self.blocks.values())

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

    def assumptions(self):
        """Every Params that the filter believes in."""
        return [self.assumed]

    def tasks(self):
        return [
            (monte_carlo_block, self.paper, self.params, self.assumed, size, seed)
            for size, seed in zip(self.sizes, self.seeds())
        ]


@dataclass(frozen=True, eq=False)
class MismatchMap(Study):
    """Assumed value by assumed value: rmse (n, rows, columns) and nees (rows, columns).

    Both are over all runs and steps. Rows and columns are the values of `assumed`, a dict with two
    fields of the Params; NaN where nothing is finished. A block is one row for one block of runs.
    """

    @property
    def rows(self):
        return self.shape[0]

    @property
    def shape(self):
        return tuple(len(values) for values in self.assumed.values())

    @property
    def rmse(self):
        model = importlib.import_module(self.paper).model(self.assumptions()[0])
        return np.sqrt(np.moveaxis(self._cells("square", len(model.x0)), -1, 0))

    @property
    def nees(self):
        return self._cells("nees")

    def _cells(self, name, *entries):
        """The mean of `name` over all finished blocks of runs, (rows, columns, ...)."""
        total, weight = np.zeros((*self.shape, *entries)), np.zeros(self.rows)
        for i in sorted(self.blocks):
            total[i % self.rows] += self.blocks[i][name]
            weight[i % self.rows] += self.blocks[i]["weight"]
        with np.errstate(invalid="ignore"):
            return total / weight.reshape(-1, *[1] * (total.ndim - 1))

    def assumptions(self):
        """Every Params that the filter believes in, row by row."""
        (row_name, rows), (column_name, columns) = self.assumed.items()
        return [
            replace(self.params, **{row_name: row, column_name: column})
            for row in rows.tolist()
            for column in columns.tolist()
        ]

    def tasks(self):
        believed, columns = self.assumptions(), self.shape[1]
        rows = [believed[i : i + columns] for i in range(0, len(believed), columns)]
        return [
            (mismatch_row, self.paper, self.params, row, size, seed)
            for size, seed in zip(self.sizes, self.seeds())
            for row in rows
        ]


def monte_carlo(paper, params, runs, rng=None, executor=None, assumed=None, resume=None):
    """Simulate a paper's experiment `runs` times, and filter every run -> MonteCarlo.

    paper    module with Params, model(p) and simulate(p, rng)
    params   the truth; assumed: what the filter believes (None: the truth)
    runs     how many: a whole number
    rng      numpy Generator. It spawns the seeds; they depend on what was spawned from it before,
             as by another study, but not on the numbers drawn from it
    executor any concurrent.futures.Executor, also Client(...).get_executor() of Dask; None: in this
             process
    resume   a MonteCarlo of the same study that was interrupted or had fewer runs; its blocks are
             not computed again, and the result is that of one study from the start: so if it grows,
             it takes the seeds that another study from its rng may have got since. rng is not used

    Ctrl+C (in Jupyter: interrupt the kernel) ends it early and gives what is finished; so do, with
    a warning, an executor that breaks, as a ProcessPoolExecutor does when one of its processes
    dies, and a block that fails. `complete` tells. If no block succeeds, the error is raised.
    """
    check_call(paper, params, runs, executor)
    assumed = params if assumed is None else assumed
    check_params("assumed", assumed, paper)
    study = _begin(MonteCarlo, paper, params, assumed, runs, rng, resume)
    do(study.tasks(), study.blocks, executor)
    return study


def mismatch_map(paper, params, assumed, runs, rng=None, executor=None, resume=None):
    """What a wrong Q or R costs: the same runs filtered under pairs of assumptions -> MismatchMap.

    assumed  dict with two fields of the Params, each with the values that the filter is to believe
             in, for example {"sigma_w": [...], "sigma_v": [...]}; the truth is in params. The rest
             is as in monte_carlo.
    """
    check_call(paper, params, runs, executor)
    check_axes(assumed, paper)
    axes = {name: np.array(values) for name, values in assumed.items()}
    study = _begin(MismatchMap, paper, params, axes, runs, rng, resume)
    do(study.tasks(), study.blocks, executor)
    return study


def _begin(kind, paper, params, assumed, runs, rng, resume):
    """A study of this kind: empty, or with those blocks of `resume` that are its own, too."""
    if resume is None:
        check_rng(rng)
        parent = rng.bit_generator.seed_seq
    else:
        check_kind(resume, kind)
        parent = resume.seed
    params, assumed = copy.deepcopy((params, assumed))
    study = kind(paper.__name__, params, assumed, int(runs), _twin(parent), {})
    if resume is not None:
        check_same(resume, study)
    for believed in study.assumptions():  # what the model refuses is told before any work
        paper.model(believed)
    if resume is None:
        parent.spawn(len(study.sizes))  # so the next study from this rng has other seeds
        return study
    for number, block in resume.blocks.items():
        if block["runs"] == study.size(number):  # the last one may have been smaller
            study.blocks[number] = block
    return study


def _twin(seed):
    """Another SeedSequence with the same children to come."""
    return np.random.SeedSequence(**seed.state)
