"""One letter, one meaning: book/letters.yml, book/notation.md and the equations of the chapters."""

import letters_helpers
import pytest
import terms_helpers
from letters_helpers import letters
from terms_helpers import Passage

ENTRIES = terms_helpers.notation.read()
CHAPTERS = terms_helpers.lists.chapters()
NUMBERS = range(1, len(CHAPTERS) + 1)
each_chapter = pytest.mark.parametrize("number", NUMBERS)
each_language = pytest.mark.parametrize("language", ("id", "en"))


def passages_of(number, language):
    return terms_helpers.notebook_passages(CHAPTERS[number - 1], language)


@each_language
@each_chapter
def test_every_letter_of_an_equation_is_in_the_notation(number, language):
    assert letters_helpers.unlisted(ENTRIES, passages_of(number, language), number) == {}


@each_language
@each_chapter
def test_no_letter_stands_before_it_is_explained(number, language):
    path, chapter = terms_helpers.main_path(language), CHAPTERS[number - 1]
    own = [i for i, passage in enumerate(path) if passage.place.startswith(f"{chapter}#")]
    assert letters_helpers.too_early(ENTRIES, path, number, own) == []


def test_one_letter_has_one_meaning():
    assert letters_helpers.two_meanings(ENTRIES, NUMBERS) == []


@each_language
def test_a_letter_stands_where_it_is_said_to_be_explained(language):
    texts = {}
    for passage in terms_helpers.everything(language):
        texts[passage.place] = texts.get(passage.place, "") + passage.text
    for entry in ENTRIES:
        found = letters("".join(letters_helpers.MATHS.findall(texts[entry["explained"]])))
        assert letters_helpers.listed(entry) & set(found), entry["letter"]


@each_language
def test_no_letter_is_listed_that_its_chapter_does_not_use(language):
    for entry in ENTRIES:
        for number in entry.get("chapters", []):
            chapter = CHAPTERS[number - 1]
            pages = (chapter, *terms_helpers.deeper_pages(chapter))
            cells = [c for page in pages for c in terms_helpers.notebook_passages(page, language)]
            equations = "".join(letters_helpers.MATHS.findall("".join(c.text for c in cells)) or [])
            assert letters_helpers.listed(entry) <= set(letters(equations)), entry["letter"]


# --- the tests can fail: small made-up books ----------------------------------------------------

GAIN = {"letter": "$K$", "explained": "notebooks/01_a#two"}
SPEED = {"letter": "$v$", "chapters": [2], "explained": "notebooks/01_a#one"}
NOISE = {"letter": "$w,\\ v$", "explained": "notebooks/01_a#one"}


def test_letters_are_read_without_words_indices_and_transposes():
    assert letters(r"x_\text{pred} = \tfrac12 \Delta t\, \sigma_w \operatorname{diag}(a)") == [
        "x",
        "t",
        r"\sigma",
        "a",
    ]
    with_rows = r"P H^\mathsf{T} + [0]^\mathsf T \cos\theta \begin{bmatrix} 1 \end{bmatrix}"
    assert letters(with_rows) == ["P", "H", r"\theta"]


def test_a_letter_that_is_not_listed_is_named_unless_it_is_the_source_s():
    table = "| source | this book |\n|---|---|\n| $G$ | $K$ |\n"
    book = [Passage("notebooks/01_a#one", table), Passage("notebooks/01_a#two", "$K + L$")]
    assert letters_helpers.unlisted([GAIN], book, 1) == {"L": "notebooks/01_a#two"}
    assert letters_helpers.unlisted([SPEED], [Passage("x#y", "$v$")], 1) == {"v": "x#y"}


def test_a_letter_before_its_cell_is_named():
    book = [Passage("notebooks/01_a#one", "$K$"), Passage("notebooks/01_a#two", "$K$")]
    found = letters_helpers.too_early([GAIN], book, 1, (0, 1))
    assert found == [("notebooks/01_a#one", "K")]


def test_two_meanings_must_be_told_apart():
    assert letters_helpers.two_meanings([SPEED, NOISE], (1, 2)) == [(2, "v")]
    apart = {**SPEED, "apart": {"id": "...", "en": "..."}}
    assert letters_helpers.two_meanings([apart, NOISE], (1, 2)) == []
    assert letters_helpers.two_meanings([GAIN, GAIN], (1,)) == [(1, "K")]
    assert letters_helpers.two_meanings([SPEED, SPEED], (1, 2)) == [(2, "v")]
