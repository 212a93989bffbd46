"""What is right, and which hint comes next. Twin of book/explorers/grading/grade.js.

An exercise is the metadata of its cell; CONTRIBUTING.md describes it. A test puts the same answers
to both twins.
"""

from dataclasses import dataclass, field

import numpy as np

SLACK = 1 + 1e-9  # of the tolerance: what rounding to binary fractions leaves open
TRIES = 2  # wrong answers, after which the solution may be opened
LETTERS = "abcd"  # of the choices


@dataclass
class State:
    """What a reader has tried so far."""

    wrong: int = 0
    right: bool = False
    said: list = field(default_factory=list)  # the names of the hints

    @property
    def open(self):
        """May the solution be opened?"""
        return self.right or self.wrong >= TRIES


@dataclass(frozen=True)
class Verdict:
    """right, or the place of the typical mistake in the list; None: another one."""

    right: bool
    mistake: int | None = None


def grade(exercise, value):
    """value: a float, the place of a choice, or what a line of code has made -> Verdict."""
    same = _sameness(exercise)
    if same(value, exercise["answer"]):
        return Verdict(True)
    for place, mistake in enumerate(exercise["mistakes"]):
        if same(value, mistake["answer"]):
            return Verdict(False, place)
    return Verdict(False)


def take(state, verdict):
    """Count an answer -> the name of the hint to say: a place among the mistakes, "hint" or
    "second"; None when it is right.

    No hint is said twice while another one is left.
    """
    if verdict.right:
        state.right = True
        return None
    state.wrong += 1
    own = [] if verdict.mistake is None else [verdict.mistake]
    left = [name for name in [*own, "hint", "second"] if name not in state.said]
    name = left[0] if left else "second"
    state.said.append(name)
    return name


def hint(exercise, name):
    """{id, en} of the hint of this name."""
    return exercise[name] if name in ("hint", "second") else exercise["mistakes"][name]["hint"]


def _sameness(exercise):
    """The function (value, wanted) -> bool of the kind of this exercise."""
    if exercise["kind"] == "number":
        return lambda value, wanted: abs(value - wanted) <= exercise["tolerance"] * SLACK
    if exercise["kind"] == "choice":
        return lambda value, wanted: value == wanted
    return lambda value, text: same_value(value, evaluate(text, exercise.get("given", "")))


def evaluate(text, given):
    """What a line of code makes; None for a line that no Python can run, as a mistake may be."""
    names = {}
    exec(given, names)
    try:
        return eval(text, names)
    except Exception:
        return None


def same_value(value, wanted):
    """The same shape, and the same numbers but for rounding."""
    try:
        value, wanted = np.asarray(value, dtype=float), np.asarray(wanted, dtype=float)
    except (TypeError, ValueError):
        return False
    if value.shape != wanted.shape or not np.isfinite(wanted).all():
        return False
    size = np.max(np.abs(wanted), initial=0)
    return np.allclose(value, wanted, rtol=1e-6, atol=1e-9 * size)
