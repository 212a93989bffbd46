"""The page for lecturers (book/teaching.md) is true of the chapters: exercises, minutes, links."""

import json
import re
import sys

import pytest
from conftest import ROOT
from explorer_helpers import javascript

sys.path[:0] = [str(ROOT / "book" / "_make"), str(ROOT / "book" / "_ext")]
import exercise_cells  # noqa: E402
import lists  # noqa: E402
from texts import filter_markdown  # noqa: E402

LANGUAGES = ("id", "en")
MEETING, DAY, WEEKS = 100, 180, 14  # minutes of a meeting and of a short day; weeks
COLUMNS, CELL = 3, 30  # of a table that fits a phone; characters
PLANNED = {"id": ("Di kelas:", "Di rumah:"), "en": ("In class:", "At home:")}
CHAPTER = re.compile(r"^## (?:Bab|Chapter) (\d)", re.MULTILINE)
NUMBER = re.compile(r"(\d)\.(\d)(?:–\d\.(\d))?")  # 1.4 or 1.1–1.3
LINK = re.compile(r'<a href="\.\./(notebooks/\w+)\.html#([a-z.]+):([^"]*)">')
each_language = pytest.mark.parametrize("language", LANGUAGES)

# What an explorer answers to the settings of a link, and which of them it does not know
ASKED = """({ paper, view, settings, language }) => {
  const { papers, tables, speaker } = KalmanExplorers, { views } = papers[paper];
  const shown = views[view || Object.keys(views)[0]], s = { seed: 2 }, wrong = [];
  const fields = Object.entries(tables[paper]).map(([name, field]) => ({ name, ...field }));
  for (const { name, ...control } of [...fields, ...shown.controls]) {
    if (name && (!(name in s) || "default" in control)) s[name] = control.default ?? null;
  }
  Object.assign(s, shown.start);
  for (const [name, text] of settings) {
    const control = { ...tables[paper][name], ...shown.controls.find((c) => c.name === name) };
    if (control.kind === "check") s[name] = text === "true";
    else if (control.options) s[name] = control.options.find(([v]) => String(v) === text)?.[0];
    else s[name] = text >= control.min && text <= control.max ? Number(text) : undefined;
    if (s[name] === undefined) wrong.push(name);
  }
  const result = shown.compute(s, {});
  for (const _ of shown.refine?.(result, s) ?? []);
  return { wrong, outcome: shown.outcome(result, s, speaker.speaker(language)) };
}"""


def page(language):
    return filter_markdown((ROOT / "book" / "teaching.md").read_text(encoding="utf-8"), language)


def sections(language):
    """{number of the chapter: its text}, and the text before the first chapter as 0."""
    opening, *rest = CHAPTER.split(page(language))
    return {0: opening} | {int(rest[i]): rest[i + 1] for i in range(0, len(rest), 2)}


def exercises(number):
    """{"1.1": its metadata} of a chapter."""
    found = {}
    for cell in json.loads((ROOT / f"{lists.chapters()[number - 1]}.ipynb").read_text())["cells"]:
        if exercise_cells.is_exercise(cell):
            found[exercise_cells.number_of(cell)] = exercise_cells.about(cell)
    return found


def planned(line):
    """ "In class: 1.1–1.3, 1.5." -> ["1.1", "1.2", "1.3", "1.5"]"""
    found = []
    for chapter, first, last in NUMBER.findall(line):
        found += [f"{chapter}.{i}" for i in range(int(first), int(last or first) + 1)]
    return found


def tables(text):
    """Tables as lists of rows, the head first."""
    blocks = re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)
    rows = [[line.strip("| ").split(" | ") for line in block.splitlines()] for block in blocks]
    return [[head, *body] for head, _, *body in rows]


def minutes(text):
    """The sums of all tables whose second column is minutes."""
    timed = [body for head, *body in tables(text) if head[1] in ("Menit", "Minutes")]
    return [sum(int(row[1]) for row in body) for body in timed]


@each_language
def test_every_chapter_of_the_book_has_its_plan(language):
    assert set(range(len(lists.chapters()) + 1)) <= set(sections(language))


@each_language
@pytest.mark.parametrize("number", range(1, len(lists.chapters()) + 1))
def test_every_exercise_is_planned_once(number, language):
    text = sections(language)[number]
    lines = [line for line in text.splitlines() if any(w in line for w in PLANNED[language])]
    assert sorted(planned("".join(lines))) == sorted(exercises(number))


@each_language
def test_the_minutes_of_a_meeting_add_up(language):
    opening, *chapters = sections(language).values()
    assert minutes(opening) == [DAY, DAY]
    assert [minutes(text) for text in chapters] == [[MEETING, MEETING]] * len(chapters)


@each_language
def test_the_semester_gives_two_weeks_to_every_chapter(language):
    head, *weeks = tables(sections(language)[0])[0]
    assert [int(row[0]) for row in weeks] == list(range(1, WEEKS + 1))
    assert [int(row[1]) for row in weeks] == [1 + i // 2 for i in range(WEEKS)]


@each_language
def test_tables_fit_a_phone(language):
    for head, *body in tables(page(language)):
        assert {len(row) for row in (head, *body)} <= set(range(2, COLUMNS + 1)), head
        cells = [cell for row in (head, *body) for cell in row]
        assert [cell for cell in cells if len(cell) > CELL] == []


@each_language
@pytest.mark.parametrize("number", range(1, len(lists.chapters()) + 1))
def test_a_wrong_answer_is_one_that_the_exercise_expects(number, language):
    known, seen = exercises(number), 0
    for exercise, line in re.findall(
        r"^- \*\*(\d\.\d)\.\*\* (.*)$", sections(language)[number], re.M
    ):
        wrong = [str(mistake["answer"]) for mistake in known[exercise]["mistakes"]]
        for answer in re.findall(r"`([^`]+)`", line):
            is_number = known[exercise]["kind"] == "number"
            text = answer.replace(",", ".").replace("−", "-") if is_number else answer
            found = float(text) in map(float, wrong) if is_number else text in wrong
            assert found, (exercise, answer, wrong)
            seen += 1
    assert seen >= 5


@each_language
def test_a_link_to_an_explorer_shows_the_numbers_beside_it(language, bundle):
    _, *links = page(language).split('<a href="../')
    for text in links:
        line = '<a href="../' + text.splitlines()[0]
        ((notebook, key, chosen),) = LINK.findall(line)
        paper, _, view = key.partition(".")
        call = f'explore(\\"{paper}\\"' + (f', view=\\"{view}\\")' if view else ")")
        assert call in (ROOT / f"{notebook}.ipynb").read_text(encoding="utf-8"), line
        settings = [part.split("=") for part in chosen.split(",") if part]
        asked = dict(paper=paper, view=view, settings=settings, language=language)
        (answer,) = javascript(bundle, ASKED, asked)
        assert answer["wrong"] == [], line
        told = re.findall(r"[−\d.,]*\d", answer["outcome"])
        promised = re.findall(r"\*\*([−\d.,]*\d)[^*]*\*\*", line)
        assert promised and set(promised) <= set(told), (line, answer["outcome"])
    assert len(links) >= 12


def test_both_halves_hold_the_same_plan():
    halves = [page(language) for language in LANGUAGES]
    assert len({len(re.findall(r"^#+ ", half, re.MULTILINE)) for half in halves}) == 1
    assert len({json.dumps([LINK.findall(half)]) for half in halves}) == 1
    timed = [[[row[1] for row in table[1:]] for table in tables(half)] for half in halves]
    assert timed[0] == timed[1]
