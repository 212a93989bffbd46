"""One module per paper: Params, model(p), simulate(p, rng), and what only this paper has."""

from dataclasses import field, fields


def param(default, *, min, max, step, unit, id, en, log=False):
    """A field of a paper's Params: what the reader may vary.

    default, min, max, step    in this unit; with log the step is in decades
    id, en                     its words in both languages
    """
    about = dict(min=min, max=max, step=step, unit=unit, id=id, en=en, log=log)
    return field(default=default, metadata=about)


def describe(Params):
    """{name: {default, min, max, step, unit, id, en, log}} of every field: makes the sliders."""
    return {f.name: {"default": f.default, **f.metadata} for f in fields(Params)}


def check(p):
    """ValueError in both languages if a field of the Params p lies outside its range."""
    for f in fields(p):
        value = getattr(p, f.name)
        low, high = f.metadata["min"], f.metadata["max"]
        if not low <= value <= high:
            high = f"{high} {f.metadata['unit']}".strip()
            raise ValueError(
                f"{f.name} = {value}: accepted are {low} to {high}. / "
                f"{f.name} = {value}: yang diterima {low} sampai {high}."
            )
