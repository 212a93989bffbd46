"""Parameters and trajectories of every paper, on which JavaScript and Python are compared."""

import dataclasses
import functools
import importlib

import numpy as np
from explorer_helpers import SETS, value_in

from kalman_lib.papers import describe


def parameter_sets(Params, rng):
    """The defaults, both ends of every field, SETS random ones over all ranges, and as many near
    the defaults."""
    table = describe(Params)
    whole = {
        name
        for name, meta in table.items()
        if isinstance(meta["default"], int)
        and isinstance(meta["step"], int)
        and meta["unit"] == ""
        and meta["min"] in (0, 1)
    }
    near = [
        Params(**{
            name: meta["default"]
            if name in whole
            else min(max(meta["default"] * rng.uniform(0.85, 1.15), meta["min"]), meta["max"])
            for name, meta in table.items()
        })
        for _ in range(SETS)
    ]
    places = [{name: end} for name in table for end in (0, 1)] + [
        {name: rng.uniform() for name in table} for _ in range(SETS)
    ]
    yield Params()
    for place in places:
        values = {name: value_in(table[name], at) for name, at in place.items()}
        yield Params(**{
            name: round(value) if name in whole else float(value) for name, value in values.items()
        })
    yield from near


def trim(trajectory, T):
    return dataclasses.replace(
        trajectory,
        x=trajectory.x[:T],
        z=trajectory.z[:T],
        u=None if trajectory.u is None else trajectory.u[:T],
    )


@functools.cache
def cases(name):
    """All (Params, Trajectory) of a paper: some with missed measurements; a run that explodes as
    long as it stays below 1e12, where a difference of two such numbers still has digits."""
    module, rng, found = (
        importlib.import_module(f"kalman_lib.papers.{name}"),
        np.random.default_rng(2026),
        [],
    )
    for number, p in enumerate(parameter_sets(module.Params, rng)):
        with np.errstate(all="ignore"):
            trajectory = module.simulate(p, rng)
        calm = (np.abs(trajectory.z) < 1e12).all(axis=1) & (np.abs(trajectory.x) < 1e12).all(axis=1)
        T = min(len(calm) if calm.all() else int(np.argmin(calm)), 300)
        if T < 2:
            continue
        trajectory = trim(trajectory, T)
        if number % 5 == 4:
            z = trajectory.z.copy()
            z[3::7] = np.nan
            trajectory = dataclasses.replace(trajectory, z=z)
        found.append((p, trajectory))
    return found
