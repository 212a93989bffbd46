"""One module per paper: Params (what the reader may vary), model(p), simulate(p, rng), and what only it has."""
from dataclasses import field, fields


def param(default, *, min, max, step, unit, id, en, log=False):
    """A field of a paper's Params: its default, its range and step (log: decades), unit, and words in both languages."""
    return field(default=default, metadata=dict(min=min, max=max, step=step, unit=unit, id=id, en=en, log=log))


def describe(Params):
    """Name -> {default, min, max, step, unit, id, en, log} of every field: what sliders are made from."""
    return {f.name: {"default": f.default, **f.metadata} for f in fields(Params)}


def check(p):
    """ValueError in both languages if a field of the Params p lies outside its range."""
    for f in fields(p):
        value, low, high = getattr(p, f.name), f.metadata["min"], f.metadata["max"]
        if not low <= value <= high:
            high = f"{high} {f.metadata['unit']}".strip()
            raise ValueError(f"{f.name} = {value}: accepted are {low} to {high}. / "
                             f"{f.name} = {value}: yang diterima {low} sampai {high}.")
