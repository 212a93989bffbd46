"""The page "Bekal / What we need": every idea has its name, its text, one picture and one check in
both languages, the pictures can be read on a phone, and the numbers are right."""

import re

import bekal
import bekal_checks
import pytest
from conftest import ROOT
from site_helpers import Reader
from texts import filter_markdown

LANGUAGES = ("id", "en")
PAGE = (ROOT / "book" / "bekal.md").read_text(encoding="utf-8")
IDEA = re.compile(r"^\(bekal-([\w-]+)\)=\n### (.+)\n", re.MULTILINE)
CHECK = {"id": "**Soal.** ", "en": "**Question.** "}
ANSWER = {"id": "Jawaban", "en": "Answer"}
FIGURE = (
    r"```{figure} _static/vendor/bekal-([\w-]+)\.png\n:width: 420px\n:figclass: unnumbered\n"
    r":alt: (.+)\n\n(.+)\n```"
)
NUMBER = r"(?<![\w.])-?\d+(?:\.\d+)?"
COLUMN = 350  # pixels: what a phone of 390 pixels leaves for a picture
LABEL = 12  # pixels, at least
WORDS = 90  # of an idea: about five lines
SENTENCE = 25  # words, at most
ANSWERS = bekal_checks.answers()


def ideas(language):
    """{name: text below its heading} in the order of the page."""
    parts = IDEA.split(filter_markdown(PAGE, language))
    return {name: text.split("\n## ")[0] for name, text in zip(parts[1::3], parts[3::3])}


NAMES = list(ideas("en"))
each_idea = pytest.mark.parametrize("name", NAMES)
each_language = pytest.mark.parametrize("language", LANGUAGES)


def check_of(name, language):
    """Question and answer of an idea."""
    _, check = ideas(language)[name].split(CHECK[language])
    question, answer = check.split(f"\n\n:::{{dropdown}} {ANSWER[language]}\n")
    assert answer.rstrip().endswith("\n:::")
    return question, answer.rstrip().removesuffix(":::")


def plain_numbers(text, language):
    """The numbers of a text as Python writes them; exponents and indices do not count."""
    if language == "id":
        text = re.sub(r"(?<=\d)\.(?=\d{3}\b)", "", text)  # 100.000
        text = re.sub(r"(?<=\d)(?:\{,\}|,)(?=\d)", ".", text)
    text = re.sub(r"(?<=\d),(?=\d{3}\b)", "", text)
    text = re.sub(r"[\^_](?:\{[^}]*\}|\w)|\\tfrac\{1\}\{2\}", " ", text)
    text = re.sub(r"(?<=[\d)}]) - ", " minus ", text).replace("−", "-")
    return re.findall(NUMBER, text)


def test_both_languages_have_the_same_ideas_and_each_has_its_picture_and_its_numbers():
    assert NAMES == list(ideas("id")) == list(bekal.pictures())
    assert set(NAMES) == set(ANSWERS)
    assert len(NAMES) >= 20


@each_language
@each_idea
def test_an_idea_has_one_picture_and_one_check(name, language):
    text = ideas(language)[name]
    figures = re.findall(FIGURE, text)
    assert [picture for picture, _, _ in figures] == [name]
    assert text.count("{figure}") == text.count("{dropdown}") == text.count(CHECK[language]) == 1
    for words in figures[0][1:]:
        assert len(words) > 30 and "..." not in words
    question, answer = check_of(name, language)
    assert "?" in question or re.search(r"\b(Hitung|Compute|Kalikan|Multiply)\b", question)
    assert len(answer.split()) >= 15  # it explains


@each_language
@each_idea
def test_an_idea_is_short(name, language):
    body = ideas(language)[name].split("```{figure}")[0]
    body = re.sub(r"\$\$.*?\$\$|^\|.*$", " ", body, flags=re.DOTALL | re.MULTILINE)
    words = re.sub(r"\$[^$]*\$", "x", body).split()
    assert len(words) <= WORDS


@each_language
def test_sentences_are_short(language):
    text = re.sub(r"\$\$.*?\$\$", ".", filter_markdown(PAGE, language), flags=re.DOTALL)
    text = re.sub(r"\$[^$]*\$", "x", re.sub(r"^[|:`(#].*$", "\n", text, flags=re.MULTILINE))
    sentences = re.split(r"(?<=[.!?:;])\s+|\n\n", text)
    assert [sentence for sentence in sentences if len(sentence.split()) > SENTENCE] == []


@each_language
@each_idea
def test_the_numbers_of_an_answer_are_computed_again(name, language):
    question, answer = check_of(name, language)
    printed = plain_numbers(answer, language)
    computed = ANSWERS[name]
    for number, value in computed.items():
        decimals = len(number.partition(".")[2])
        assert abs(value - float(number)) <= 0.5001 * 10**-decimals, (number, value)
        assert number in printed, f"{number} is not in the answer: {printed}"
    body = ideas(language)[name].split(CHECK[language])[0]
    given = {number.lstrip("-") for number in plain_numbers(body + question, language)}
    known = given | {number.lstrip("-") for number in computed}
    assert [number for number in printed if number.lstrip("-") not in known] == []


@each_idea
def test_both_languages_print_the_same_numbers(name):
    def numbers(language):
        return sorted(plain_numbers(ideas(language)[name].split(":alt:")[0], language)), sorted(
            plain_numbers("\n".join(check_of(name, language)), language)
        )

    assert numbers("id") == numbers("en")


@each_idea
def test_a_picture_can_be_read_on_a_phone_and_holds_no_words(name):
    picture = bekal.pictures()[name]()
    picture.canvas.draw()
    inches, _ = picture.get_size_inches()
    labels = [text for text in picture.findobj(match=is_label) if text.get_visible()]
    for label in labels:
        assert label.get_fontsize() / 72 * COLUMN / inches >= LABEL, label.get_text()
        words = re.sub(r"\$[^$]*\$", "", label.get_text())
        assert not re.search(r"[A-Za-z]{4,}", words), words
        assert not re.search(r"\d[.,]\d", label.get_text()), "a decimal sign has one language"
    assert len(picture.png()) < 40_000  # bytes: a page of them stays light


def is_label(artist):
    from matplotlib.text import Text

    return isinstance(artist, Text) and bool(artist.get_text().strip())


def test_every_link_to_an_idea_leads_somewhere():
    for path in [*(ROOT / "book").glob("*.md"), *(ROOT / "notebooks").glob("*.ipynb")]:
        text = path.read_text(encoding="utf-8")
        assert set(re.findall(r"\]\([^)]*#bekal-([\w-]+)\)", text)) <= set(NAMES), path.name


@each_language
def test_the_built_page_has_the_names_and_leaves_the_chapters_their_figure_numbers(language, site):
    path = site / language / "book" / "bekal.html"
    ids = Reader(path).ids
    assert {f"bekal-{name}" for name in NAMES} <= ids
    assert "caption-number" not in path.read_text(encoding="utf-8")
    links = [
        link for link in Reader(path.with_name("glossary.html")).links if "bekal.html#" in link
    ]
    assert len(links) >= len(NAMES)
    assert {link.partition("#")[2] for link in links} <= ids
