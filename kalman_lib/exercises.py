"""Exercises that answer, in a notebook as on the page of the book.

    check("2.1", 0.27)    # is this the answer? If not: what to think of next
    check("2.4", "b")     # a choice is answered with its letter
    check("2.1")          # how is it answered, and what is there to choose?
    check("2.1", "?")     # the worked solution, after two tries or the right answer (an edition for
                          # students has none)

The questions stand in the chapters. What is right about them, and what is said then, is metadata of
their cells, which `make explorers` collects.
"""

import json
import math

import numpy as np

from .live import grading
from .live.made import made
from .live.notebook import language_of_notebook, shell

# fmt: off
WORDS = {
    "right": {"id": "**Benar.**", "en": "**Right.**"},
    "wrong": {"id": "**Belum.**", "en": "**Not yet.**"},
    "open": {
        "id": "Penyelesaiannya kini dapat dibuka: `check(\"{number}\", \"?\")`",
        "en": "The solution can be opened now: `check(\"{number}\", \"?\")`",
    },
    "kept": {
        "id": "Dalam edisi ini penyelesaiannya ada pada pengajar.",
        "en": "In this edition the lecturer has the solutions.",
    },
    "closed": {
        "id": "Cobalah dahulu: sesudah dua jawaban, penyelesaiannya dapat dibuka.",
        "en": "Try it first: after two answers the solution can be opened.",
    },
    "number": {
        "id": "Jawabannya satu bilangan{unit}, tanpa tanda kutip: `check(\"{number}\", 0.5)`",
        "en": "The answer is one number{unit}, without quotation marks: `check(\"{number}\", 0.5)`",
    },
    "choice": {
        "id": "Jawabannya satu huruf dalam tanda kutip: `check(\"{number}\", \"a\")`",
        "en": "The answer is one letter in quotation marks: `check(\"{number}\", \"a\")`",
    },
    "code": {
        "id": "Tulislah kodenya tanpa tanda kutip, agar Python menghitungnya: "
              "`check(\"{number}\", 2 * R)`",
        "en": "Write the code without quotation marks, so that Python computes it: "
              "`check(\"{number}\", 2 * R)`",
    },
    "point": {
        "id": "Python memakai titik desimal: 0.5, bukan 0,5.",
        "en": "Python has a decimal point: 0.5, not 0,5.",
    },
}
# fmt: on

_ASKED = object()  # no answer: what is asked for?
_states = {}  # number of the exercise -> what was tried in this kernel


def check(number, answer=_ASKED, *rest):
    """Say whether this answers the exercise ("2.1"); `...` stands for no answer yet."""
    if answer is ...:
        return
    exercise = _exercise(number)
    state = _states.setdefault(number, grading.State())
    if rest:
        _say(WORDS["point"])
    elif isinstance(answer, str) and answer.strip() == "?":
        _say(_solution(exercise, state))
    elif (value := _value(exercise, answer)) is None:
        _say(*_how_to_answer(number, exercise))
    else:
        _judge(number, exercise, state, value)


def _solution(exercise, state):
    if "solution" not in exercise:
        return WORDS["kept"]
    return exercise["solution"] if state.open else WORDS["closed"]


def _judge(number, exercise, state, value):
    name = grading.take(state, grading.grade(exercise, value))
    has_solution = "solution" in exercise
    if name is None:
        _say(WORDS["right"], *([exercise["solution"]] if has_solution else []))
        return
    told = [_joined(WORDS["wrong"], grading.hint(exercise, name))]
    if state.open and has_solution:
        told.append(_filled(WORDS["open"], number=number))
    _say(*told)


def _exercise(number):
    exercises = json.loads(made("exercises.json"))
    if number not in exercises:
        there = ", ".join(exercises) or "-"
        raise ValueError(
            f"there is no exercise {number!r}; there are {there}. / "
            f"tidak ada latihan {number!r}; yang ada {there}."
        )
    return exercises[number]


# --- what the reader answers ----------------------------------------------------------------------


def _value(exercise, answer):
    """The answer as it is graded; None: it is none of the kind that is asked for."""
    if answer is _ASKED:
        return None
    if exercise["kind"] == "number":
        return _number(answer)
    if exercise["kind"] == "choice":
        return _choice(answer, len(exercise["choices"]))
    return None if isinstance(answer, str) else answer


def _number(answer):
    """A finite float, from a number of Python or NumPy; an array of one element is one."""
    if isinstance(answer, (str, bool, np.bool_)):
        return None
    try:
        value = float(np.asarray(answer).item())
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def _choice(answer, count):
    """The place of a letter."""
    letter = answer.strip(" .)").lower() if isinstance(answer, str) else ""
    letters = grading.LETTERS[:count]
    return letters.index(letter) if len(letter) == 1 and letter in letters else None


def _how_to_answer(number, exercise):
    unit = f" ({exercise['unit']})" if exercise.get("unit") else ""
    told = [_filled(WORDS[exercise["kind"]], number=number, unit=unit)]
    for letter, choice in zip(grading.LETTERS, exercise.get("choices", [])):
        told.append({language: f"{letter}. {text}" for language, text in choice.items()})
    return told


# --- what is said ---------------------------------------------------------------------------------


def _filled(words, **values):
    return {language: text.format(**values) for language, text in words.items()}


def _joined(*parts):
    return {language: " ".join(part[language] for part in parts) for language in ("id", "en")}


def _say(*parts):
    """Paragraphs in the language of the notebook; where it is unknown, in both."""
    texts = {language: "\n\n".join(part[language] for part in parts) for language in ("id", "en")}
    language = language_of_notebook()
    text = texts[language] if language else "\n\n---\n\n".join(texts.values())
    if shell() is None:
        print(text)
        return
    from IPython.display import Markdown, display

    display(Markdown(text))
