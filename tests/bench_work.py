"""A row of the bench, and what several rows need."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from bench_peers import Contender

from kalman_lib import fast, filters


@dataclass
class Work:
    name: str
    steps: int  # steps in all, over all runs
    reference: Callable  # () -> x of the first steps (and runs) by the readable loop
    ours: Callable
    c: Callable
    peers: dict = field(default_factory=dict)


def with_P(result):
    """x of a result; its P is computed, too."""
    assert result.P is not None
    return result.x


def smoothed(result, smooth):
    return fast.rts_smooth(result) if smooth else result


def first_steps(model, z, smooth):
    """x of the first 2,000 steps; a smoother sees 1,000 more."""
    result = filters.kalman_filter(model, z[:3000])
    return filters.rts_smooth(result).x[:2000] if smooth else result.x


def first_runs(model, z, u=None, runs=3, smooth=False):
    """x of the first runs, one by one."""
    results = [filters.kalman_filter(model, z[:, :, r], u) for r in range(runs)]
    if smooth:
        results = [filters.rts_smooth(result) for result in results]
    return np.stack([result.x for result in results], axis=-1)


def plus(drift, contenders):
    """The contenders, whose series lacks the known drift."""
    return {
        name: Contender(lambda run=peer.run: run() + drift, peer.share)
        for name, peer in contenders.items()
    }
