"""Exercises that answer: check() in a notebook, and what every exercise of the book owes."""

import copy
import json
import re
import subprocess
import sys

import conftest  # noqa: F401  (the build's own modules can be imported)
import exercise_cells
import numpy as np
import pytest
from downloads import download_notebook
from exercise_cases import EXERCISES, GRADED, SEQUENCES
from test_notebooks import skeleton

from kalman_lib import exercises as room
from kalman_lib.exercises import check
from kalman_lib.live import grading

ALL = exercise_cells.everywhere()
each = pytest.mark.parametrize("exercise", ALL, ids=lambda exercise: exercise.number)
LANGUAGES = ("id", "en")

# --- the exercises of the chapters ----------------------------------------------------------------


@each
def test_an_exercise_is_complete_in_both_languages(exercise):
    assert list(exercise_cells.problems(exercise)) == []


@pytest.mark.parametrize("page", sorted({exercise.page for exercise in ALL}))
def test_exercises_are_numbered_in_the_order_of_the_page(page):
    numbers = [exercise.number for exercise in ALL if exercise.page == page]
    chapter = numbers[0].split(".")[0]
    first = int(numbers[0].split(".")[1])  # a second floor goes on where its chapter ends
    assert numbers == [f"{chapter}.{first + i}" for i in range(len(numbers))]
    assert first == 1 or page.endswith("_deeper")


def test_no_number_is_given_twice():
    numbers = [exercise.number for exercise in ALL]
    assert len(set(numbers)) == len(numbers)


def value_of(exercise, answer):
    """The answer as a reader has it: a number, a letter, or what a line of code makes."""
    if exercise.about["kind"] == "choice":
        return grading.LETTERS[answer]
    if exercise.about["kind"] == "code":
        return grading.evaluate(answer, exercise.about.get("given", ""))
    return answer


@each
def test_the_answer_is_right_and_every_typical_mistake_gets_its_own_hint(exercise, book, told):
    about = exercise.about
    for language in LANGUAGES:
        room._states.clear()
        assert told(language, exercise.number, value_of(exercise, about["answer"])) == (
            f"{room.WORDS['right'][language]}\n\n{about['solution'][language]}"
        )
        for mistake in about["mistakes"]:
            value = value_of(exercise, mistake["answer"])
            if value is None:  # a line that no Python can run: only the page can tell it
                continue
            room._states.clear()
            text = told(language, exercise.number, value)
            assert text == f"{room.WORDS['wrong'][language]} {mistake['hint'][language]}"


@each
def test_the_code_that_is_accepted_makes_the_same(exercise):
    about = exercise.about
    if about["kind"] != "code":
        return
    wanted = value_of(exercise, about["answer"])
    assert wanted is not None
    for text in about.get("accept", []):
        assert grading.same_value(value_of(exercise, text), wanted), text
    for mistake in about["mistakes"]:
        value = value_of(exercise, mistake["answer"])
        assert value is None or not grading.same_value(value, wanted), mistake["answer"]


@each
def test_both_languages_say_the_same(exercise):
    about = exercise.about
    pairs = [exercise.question, about["hint"], about["second"], about["solution"]]
    pairs += [mistake["hint"] for mistake in about["mistakes"]] + about.get("choices", [])
    for words in pairs:
        a, b = skeleton(words["id"]), skeleton(words["en"])
        assert a == b, words["en"]
        assert not a["headings"], "a heading belongs to the page"


def test_a_notebook_to_take_home_names_the_choices_and_keeps_its_exercises():
    path = exercise_cells.NOTEBOOKS / "02_smoother.ipynb"
    source = json.loads(path.read_text(encoding="utf-8"))
    for language in LANGUAGES:
        cells = download_notebook(source, language)["cells"]
        texts = ["".join(cell["source"]) for cell in cells]
        assert [text for text in texts if text.startswith("check(")] == [
            f'check("{found.number}", ...)' for found in exercise_cells.in_notebook(path)
        ]
        for found in exercise_cells.in_notebook(path):
            for letter, choice in zip("abcd", found.about.get("choices", [])):
                question = texts[texts.index(f'check("{found.number}", ...)') - 1]
                assert f"\n\n{letter}. {choice[language]}" in question
        for cell in cells:
            if "proof" in cell["metadata"].get("tags", []):
                assert cell["metadata"]["jupyter"]["source_hidden"]


# --- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "number, change, problem",
    [
        ("1.1", lambda a: a.pop("second"), "'second' is missing"),
        ("1.1", lambda a: a.update(choices=[]), "no meaning in a number"),
        ("1.1", lambda a: a.update(kind="essay"), "the kind is one of"),
        ("1.1", lambda a: a["hint"].pop("en"), 'hint has no words in "en"'),
        (
            "1.1",
            lambda a: a["mistakes"][0]["hint"].update(id=" "),
            'mistake 0 has no words in "id"',
        ),
        ("1.1", lambda a: a.update(answer="2.24"), "every answer of a number is one"),
        ("1.1", lambda a: a.update(tolerance=0.3), "cannot tell 2.24 from 2.5"),
        ("1.1", lambda a: a.update(tolerance=0), "greater than 0"),
        ("1.1", lambda a: a.update(mistakes=[]), "no typical mistake"),
        ("1.2", lambda a: a["mistakes"].pop(), "each other one is a mistake"),
        ("1.2", lambda a: a["choices"].pop(), "each other one is a mistake"),
        ("1.2", lambda a: a["choices"][0].pop("id"), 'choice 0 has no words in "id"'),
        ("1.3", lambda a: a.update(answer=1), "every answer of a code is one"),
    ],
)
def test_what_is_wrong_with_an_exercise_is_one_sentence(number, change, problem):
    question = {"id": "Berapa?", "en": "How much?"}
    about = copy.deepcopy(EXERCISES[number])
    good = exercise_cells.Exercise(number, "notebooks/01_theory", question, about)
    assert list(exercise_cells.problems(good)) == []
    change(about)
    assert any(problem in sentence for sentence in exercise_cells.problems(good))


def test_an_exercise_that_stands_in_the_wrong_place_is_told():
    question = {"id": "Berapa?", "en": ""}
    exercise = exercise_cells.Exercise("3.1", "notebooks/01_theory", question, EXERCISES["1.1"])
    assert list(exercise_cells.problems(exercise)) == [
        "exercise 3.1: this is chapter 1",
        'exercise 3.1: no question starts with "**Exercise 3.1.**" above its cell',
    ]


# --- check() --------------------------------------------------------------------------------------


@pytest.fixture
def book(monkeypatch):
    """The exercises of the notebooks as they are now, and no answer yet."""
    monkeypatch.setattr(room, "made", lambda name: exercise_cells.as_json())
    monkeypatch.setattr(room, "_states", {})


@pytest.fixture
def cases(monkeypatch):
    """Three exercises of the tests' own in their place."""
    monkeypatch.setattr(room, "made", lambda name: json.dumps(EXERCISES))
    monkeypatch.setattr(room, "_states", {})


@pytest.fixture
def told(monkeypatch, capsys):
    """The function (language, number, answers) -> what check() says."""

    def tell(language, *arguments):
        monkeypatch.setattr(room, "language_of_notebook", lambda: language)
        assert check(*arguments) is None
        return capsys.readouterr().out.rstrip("\n")

    return tell


def test_an_edition_for_students_answers_without_a_solution(told, monkeypatch):
    bare = {name: value for name, value in EXERCISES["1.1"].items() if name != "solution"}
    monkeypatch.setattr(room, "_exercise", lambda number: bare)
    for language, word in (("id", "pengajar"), ("en", "lecturer")):
        room._states.clear()
        assert told(language, "1.1", bare["answer"]) == room.WORDS["right"][language]
        assert word in told(language, "1.1", "?")


@pytest.mark.parametrize("number, answer, right, mistake", GRADED)
def test_what_is_right(number, answer, right, mistake):
    exercise = EXERCISES[number]
    is_code = exercise["kind"] == "code"
    value = grading.evaluate(answer.strip(), exercise["given"]) if is_code else answer
    assert grading.grade(exercise, value) == grading.Verdict(right, mistake)


@pytest.mark.parametrize("number, answers, hints", SEQUENCES)
def test_no_hint_is_said_twice_while_another_one_is_left(number, answers, hints):
    state = grading.State()
    found = [grading.take(state, grading.grade(EXERCISES[number], answer)) for answer in answers]
    assert found == hints
    assert state.open and state.right == (None in hints)


def test_dots_are_no_answer(cases, told):
    assert told("en", "1.1", ...) == ""
    assert room._states == {}


def test_a_reader_on_the_way_to_the_answer(cases, told):
    assert told("en", "1.1", "?") == room.WORDS["closed"]["en"]
    assert told("en", "1.1", 2.5) == "**Not yet.** The root."
    assert told("en", "1.1", "?") == room.WORDS["closed"]["en"]
    assert told("id", "1.1", 9).startswith("**Belum.** Pertama.\n\nPenyelesaiannya kini dapat")
    assert told("id", "1.1", "?") == EXERCISES["1.1"]["solution"]["id"]
    assert told("en", "1.1", 2.24).startswith("**Right.**\n\n$v = ")


def test_where_the_language_is_unknown_both_are_said(cases, told):
    assert told("", "1.1", 2.5) == "**Belum.** Akarnya.\n\n---\n\n**Not yet.** The root."


@pytest.mark.parametrize(
    "answer", [2.24, np.float64(2.24), np.float32(2.24), np.array([2.24]), np.array([[2.24]])]
)
def test_numbers_of_python_and_numpy_are_taken(cases, told, answer):
    assert told("en", "1.1", answer).startswith("**Right.**")


@pytest.mark.parametrize(
    "answer", ["2.24", "2,24", True, None, [1, 2], np.array([2.24, 1]), 2 + 1j, float("nan"), {}]
)
def test_what_is_no_number_is_told_in_a_sentence_and_not_counted(cases, told, answer):
    text = told("en", "1.1", answer)
    assert text.startswith("The answer is one number (m/s), without") and '("1.1", 0.5)' in text
    assert told("id", "1.1", answer).startswith("Jawabannya satu bilangan (m/s)")
    assert not room._states["1.1"].wrong


def test_a_decimal_comma_is_explained(cases, told):
    assert told("id", "1.1", 2, 24) == room.WORDS["point"]["id"]


@pytest.mark.parametrize("answer", ["b", "B", " b. ", "b)"])
def test_a_letter_is_a_choice(cases, told, answer):
    assert told("en", "1.2", answer).startswith("**Right.**")


@pytest.mark.parametrize("answer", [1, "", "d", "turun", None])
def test_what_is_no_letter_is_told_with_the_choices(cases, told, answer):
    text = told("id", "1.2", answer)
    assert text.endswith("a. naik\n\nb. turun\n\nc. tetap $K$") and '("1.2", "a")' in text
    assert told("id", "1.2") == text and not room._states["1.2"].wrong


def test_code_is_compared_by_what_it_makes(cases, told):
    dt = 0.1
    assert told("en", "1.3", np.array([[1, dt], [0, 1]])).startswith("**Right.**")
    assert told("en", "1.3", [[1, dt], [0, 1]]).startswith("**Right.**")
    assert "Transposed." in told("en", "1.3", np.array([[1, 0], [dt, 1]]))
    assert told("en", "1.3", "np.eye(2)").startswith("Write the code without quotation marks")
    for other in (1, np.ones(3), {"F": 1}, check):
        assert told("en", "1.3", other).startswith("**Not yet.**")


def test_an_unknown_number_is_refused_in_both_languages(cases):
    with pytest.raises(ValueError, match="no exercise '9.9'; there are 1.1, .*tidak ada latihan"):
        check("9.9", 1)


def test_it_is_shown_as_markdown_in_a_notebook(tmp_path):
    code = (
        "import IPython; from IPython.testing.globalipapp import start_ipython\n"
        "start_ipython(); import kalman_lib.exercises as room, json\n"
        f"room.made = lambda name: {json.dumps(json.dumps(EXERCISES))}\n"
        "import IPython.display as d; d.display = lambda x: print(type(x).__name__, x.data)\n"
        "room.check('1.1', 2.5)"
    )
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "Markdown **Belum.** Akarnya." in made.stdout, made.stderr


def test_the_words_are_there_in_both_languages():
    for words in room.WORDS.values():
        assert set(words) == set(LANGUAGES) and words["id"] != words["en"]
        places = [sorted(re.findall(r"\{\w+\}", text)) for text in words.values()]
        assert places[0] == places[1]
