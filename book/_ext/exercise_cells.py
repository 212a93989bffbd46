"""The exercises of the notebooks: pure work on their cells. exercises.py puts them into the pages.

An exercise is a question in two Markdown cells and a code cell with the tag `exercise`, whose only
line is check("3.2", ...); what is right about it is metadata of that cell (CONTRIBUTING.md).
`python book/_ext/explorers.py` writes them all into kalman_lib/live/bundle/exercises.json.
"""

import json
import re
from dataclasses import dataclass
from pathlib import Path

from settings import about_edition
from texts import LANGUAGES

NOTEBOOKS = Path(__file__).resolve().parent.parent.parent / "notebooks"
FILE = "exercises.json"
TAG, PROOF = "exercise", "proof"
KINDS = {  # what an exercise of each kind has beside what all of them have
    "number": {"tolerance", "unit"},
    "choice": {"choices"},
    "code": {"accept", "given", "start"},
}
OPTIONAL = {"unit", "accept", "given", "start"}
COMMON = {"kind", "answer", "mistakes", "hint", "second", "solution"}
CALL = re.compile(r'check\("(\d+\.\d+)", \.\.\.\)')
QUESTION = {"id": r"^\*\*Latihan {}\.\*\*", "en": r"^\*\*Exercise {}\.\*\*"}


@dataclass(frozen=True)
class Exercise:
    """One exercise: number "3.2"; page "notebooks/03_gyro"; question {id, en}, Markdown;
    about: the metadata of its cell."""

    number: str
    page: str
    question: dict
    about: dict


def is_exercise(cell):
    return TAG in cell["metadata"].get("tags", [])


def number_of(cell):
    """ "3.2" of the cell with the line check("3.2", ...); "" if it has another one."""
    call = CALL.fullmatch("".join(cell["source"]).strip())
    return call[1] if call else ""


def about(cell):
    return cell["metadata"].get("book", {}).get("exercise", {})


def in_notebook(path):
    """The exercises of a notebook, in their order."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    found = []
    for place, cell in enumerate(cells):
        if is_exercise(cell):
            number = number_of(cell)
            question = {
                language: question_in("".join(before["source"]), number, language)
                for language, before in zip(LANGUAGES, cells[max(place - 2, 0) : place])
            }
            found.append(Exercise(number, f"notebooks/{path.stem}", question, about(cell)))
    return found


def question_in(markdown, number, language):
    """The text behind "**Exercise 3.2.**"; "" if it is not there."""
    mark = QUESTION[language].format(re.escape(number))
    start = re.search(mark, markdown, flags=re.MULTILINE)
    return markdown[start.end() :].strip() if start else ""


def everywhere(folder=NOTEBOOKS):
    """All exercises, in the order of the chapters."""
    return [found for path in sorted(folder.glob("*.ipynb")) for found in in_notebook(path)]


def as_json(folder=NOTEBOOKS):
    """What kalman_lib.exercises reads: {number: about}."""
    return json.dumps({found.number: for_students(found.about) for found in everywhere(folder)})


def has_solutions():
    """Does this edition hold the solutions?"""
    return about_edition()["solutions"]


def for_students(about):
    """Everything about an exercise that a reader of this edition may see."""
    kept = about if has_solutions() else set(about) - {"solution"}
    return {name: value for name, value in about.items() if name in kept}


# --- what is wrong with one -----------------------------------------------------------------------


def problems(exercise):
    """One sentence for everything that the metadata lacks or has too much."""
    yield from problems_of_place(exercise)
    for problem in problems_of_metadata(exercise.about):
        yield f"exercise {exercise.number}: {problem}"


def problems_of_metadata(about):
    kind, given = about.get("kind"), set(about)
    if kind not in KINDS:
        yield f"the kind is one of {', '.join(KINDS)}, not {kind!r}"
        return
    missing = (COMMON | KINDS[kind]) - OPTIONAL - given
    for name in sorted(missing):
        yield f"{name!r} is missing"
    for name in sorted(given - COMMON - KINDS[kind]):
        yield f"{name!r} has no meaning in a {kind}"
    if not missing:
        yield from problems_of_words(about)
        yield from problems_of_answers(about)


def problems_of_place(exercise):
    chapter = re.match(r"notebooks/0*(\d+)_", exercise.page)
    if not exercise.number:
        yield f'{exercise.page}: the only line of an exercise cell is check("3.2", ...)'
    elif chapter and exercise.number.split(".")[0] != chapter[1]:
        yield f"exercise {exercise.number}: this is chapter {chapter[1]}"
    for language, mark in QUESTION.items():
        if not exercise.question.get(language):
            start = mark.format(exercise.number).replace("\\", "").removeprefix("^")
            yield f'exercise {exercise.number}: no question starts with "{start}" above its cell'


def problems_of_words(about):
    words = {name: about[name] for name in ("hint", "second", "solution")}
    words |= {f"choice {i}": words for i, words in enumerate(about.get("choices", []))}
    words |= {f"mistake {i}": one.get("hint", {}) for i, one in enumerate(about["mistakes"])}
    for name, text in words.items():
        for language in LANGUAGES:
            if not isinstance(text, dict) or not str(text.get(language, "")).strip():
                yield f'{name} has no words in "{language}"'


def problems_of_answers(about):
    answers = [about["answer"], *(mistake.get("answer") for mistake in about["mistakes"])]
    if not about["mistakes"]:
        yield "it knows no typical mistake"
    if about["kind"] == "choice":
        places = list(range(len(about.get("choices", []))))
        if sorted(answers, key=str) != places or not 3 <= len(places) <= 4:
            yield "one of 3 or 4 choices is right, each other one is a mistake"
        return
    wanted = (int, float) if about["kind"] == "number" else str
    if not all(isinstance(answer, wanted) for answer in answers):
        yield f"every answer of a {about['kind']} is one"
    elif about["kind"] == "number":
        yield from problems_of_numbers(about["tolerance"], sorted(answers))


def problems_of_numbers(tolerance, answers):
    if not tolerance > 0:
        yield "the tolerance is greater than 0"
    for one, next_one in zip(answers, answers[1:]):
        if next_one - one <= tolerance:
            yield f"the tolerance cannot tell {one} from {next_one}"


# --- in one language ------------------------------------------------------------------------------


def in_language(about, language):
    """The same with the texts of one language in the place of {id, en}."""
    if isinstance(about, dict):
        if set(about) == set(LANGUAGES):
            return about[language]
        return {name: in_language(value, language) for name, value in about.items()}
    if isinstance(about, list):
        return [in_language(value, language) for value in about]
    return about
