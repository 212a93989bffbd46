"""What monte_carlo and mismatch_map refuse: one sentence in English, the same in Indonesian."""

import textwrap
from dataclasses import fields, is_dataclass
from inspect import isclass, ismodule

import numpy as np


def check_call(paper, params, runs, executor):
    """ValueError unless these four are what both functions take."""
    _check_paper(paper)
    check_params("params", params, paper)
    if isinstance(runs, bool) or not isinstance(runs, int | np.integer) or runs < 1:
        _refuse("runs", runs, "a whole number, 1 or more", "bilangan bulat, 1 atau lebih")
    if executor is not None:
        _check_executor(executor)


def _check_paper(paper):
    if not ismodule(paper):
        _refuse(
            "paper",
            paper,
            "a module with Params, model and simulate",
            "modul dengan Params, model, dan simulate",
        )
    missing = [name for name in ("model", "simulate") if not callable(getattr(paper, name, None))]
    if not is_dataclass(getattr(paper, "Params", None)):
        missing.insert(0, "Params")
    if missing:
        names = ", ".join(missing)
        _refuse(
            "paper",
            paper.__name__,
            f"a module with Params (a dataclass), model and simulate, not one without {names}",
            f"modul dengan Params (dataclass), model, dan simulate, bukan yang tanpa {names}",
        )


def check_params(name, value, paper):
    """ValueError unless the value is a Params of the paper."""
    if not isinstance(value, paper.Params):
        wanted = f"{paper.__name__}.Params(...)"
        _refuse(name, value, wanted, wanted)


def _check_executor(executor):
    if hasattr(executor, "get_executor"):  # the Client of Dask has a submit of another kind
        _refuse(
            "executor", executor, "what its get_executor() gives", "hasil get_executor() darinya"
        )
    if isclass(executor) or not callable(getattr(executor, "submit", None)):
        _refuse(
            "executor",
            executor,
            "None or an Executor, which has submit",
            "None atau sebuah Executor, yang punya submit",
        )


def check_rng(rng):
    """ValueError unless seeds can be spawned from rng."""
    is_generator = isinstance(rng, np.random.Generator)
    if is_generator and isinstance(rng.bit_generator.seed_seq, np.random.SeedSequence):
        return
    _refuse(
        "rng",
        rng,
        "a numpy Generator with a SeedSequence, as np.random.default_rng(1) is; "
        "None only with resume=",
        "Generator numpy dengan SeedSequence, seperti np.random.default_rng(1); "
        "None hanya bersama resume=",
    )


def check_axes(assumed, paper):
    """ValueError unless assumed is a dict: two fields of the Params, each with numbers."""
    names = [field.name for field in fields(paper.Params)]
    if not isinstance(assumed, dict) or len(assumed) != 2 or not set(assumed) <= set(names):
        _refuse(
            "assumed",
            assumed,
            f"a dict with two of {', '.join(names)}",
            f"dict dengan dua dari {', '.join(names)}",
        )
    for name, values in assumed.items():
        if not _is_series(values):
            _refuse(
                f"assumed.{name}",
                values,
                "a list or array of one or more numbers",
                "daftar atau array berisi satu bilangan atau lebih",
            )


def _is_series(values):
    try:
        array = np.array(values)
    except ValueError:  # lists of different lengths
        return False
    return array.ndim == 1 and array.size > 0 and array.dtype.kind in "biuf"


def check_kind(resume, kind):
    """ValueError unless `resume` is a study of this kind: a class."""
    if not isinstance(resume, kind):
        _refuse("resume", resume, f"a {kind.__name__}", f"sebuah {kind.__name__}")


def check_same(resume, study):
    """ValueError unless `resume` is the same study as `study`, with as many runs or fewer."""
    there, here = _identity(resume), _identity(study)
    if study.paper != resume.paper:
        there, here = {"paper": resume.paper}, {"paper": study.paper}
    shared = [name for name in here if name in there]
    differs = [name for name in shared if not np.array_equal(there[name], here[name])]
    if differs:
        pairs = [(name, _short(there[name]), _short(here[name])) for name in differs]
        en = ", ".join(f"{name} is {old} there and {new} here" for name, old, new in pairs)
        id = ", ".join(f"{name} di sana {old}, di sini {new}" for name, old, new in pairs)
        raise ValueError(
            f"resume= belongs to another study: {en}. / resume= berasal dari studi lain: {id}."
        )
    runs, before = study.planned, resume.planned
    if runs < before:
        raise ValueError(
            f"runs = {runs}: the study in resume= has {before}, and a study can only "
            f"grow. / runs = {runs}: studi dalam resume= punya {before}, dan sebuah "
            "studi hanya dapat bertambah."
        )


def _identity(study):
    """Name -> value of all that makes a study this one and no other, but for its seed and size."""
    facts = {"paper": study.paper}
    assumed = study.assumed
    if isinstance(assumed, dict):
        facts["assumed"] = " × ".join(assumed)
    else:
        assumed = _values(assumed)
    facts |= {f"params.{name}": value for name, value in _values(study.params).items()}
    return facts | {f"assumed.{name}": value for name, value in assumed.items()}


def _values(params):
    return {field.name: getattr(params, field.name) for field in fields(params)}


def _refuse(name, value, en, id):
    text = f"{name} = {_short(repr(value))}"
    raise ValueError(f"{text}: accepted is {en}. / {text}: yang diterima {id}.")


def _short(value):
    return textwrap.shorten(str(value), 60, placeholder=" ...")
