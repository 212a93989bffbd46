"""The page grades as Python does: the same answers to both twins, in the same order."""

import conftest  # noqa: F401  (the build's own modules can be imported)
import exercise_parts
import explorers
import pytest
from exercise_cases import EXERCISES, GRADED, SEQUENCES, TYPED
from exercise_cells import in_language
from page_helpers import LANGUAGES


@pytest.fixture(scope="module")
def script(chromium, tmp_path_factory):
    """A blank page with the script in both languages."""
    folder = tmp_path_factory.mktemp("exercises")
    explorers.bundle(folder, None, host="exercises")
    page = chromium.new_page()
    page.add_script_tag(path=folder / "exercises.js")
    yield page
    page.close()


def known(number):
    """What the page tells the script of an exercise."""
    return exercise_parts.for_script(in_language(EXERCISES[number], "en"))


@pytest.mark.parametrize("number, answer, right, mistake", GRADED)
def test_the_page_grades_as_python_does(script, number, answer, right, mistake):
    call = "([about, answer]) => KalmanExercises.grade(about, answer)"
    assert script.evaluate(call, [known(number), answer]) == {"right": right, "mistake": mistake}


@pytest.mark.parametrize("number, answers, hints", SEQUENCES)
def test_the_page_says_the_same_hints_as_python(script, number, answers, hints):
    call = """([about, answers]) => {
      const { grade, newState, take } = KalmanExercises, state = newState();
      return answers.map(answer => take(state, grade(about, answer)));
    }"""
    assert script.evaluate(call, [known(number), answers]) == hints


@pytest.mark.parametrize("text, unit, expected", TYPED)
def test_numbers_as_readers_type_them(script, text, unit, expected):
    call = "([text, unit]) => KalmanExercises.numberIn(text, unit)"
    found = script.evaluate(call, [text, unit])
    if isinstance(expected, float):
        assert found == {"value": expected}
    elif isinstance(expected, list):
        assert found["either"] == expected and "value" not in found
    else:
        assert "value" not in found and "either" not in found
    for language in LANGUAGES if "problem" in found else ():
        assert found["problem"][language].count(".") >= 1 and "{" not in found["problem"][language]


def test_what_is_typed_into_the_box_may_repeat_what_stands_before_it(script):
    call = "([about, answer]) => KalmanExercises.grade(about, answer).right"
    assert script.evaluate(call, [known("1.3"), "F = np.array([[1, dt], [0, 1]])"])
    assert not script.evaluate(call, [known("1.3"), "H = np.array([[1, dt], [0, 1]])"])
