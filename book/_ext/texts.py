"""Two languages from one source: pure work on texts. languages.py puts it into Sphinx.

A prose cell of a notebook carries the cell tag `lang-id` or `lang-en`; code cells carry neither. A
Markdown page says the same with a block break: `+++ {"tags": ["lang-id"]}`. Titles are written
"Indonesia | English".
"""

import copy
import json
import re
from pathlib import Path

import pybtex.database

LANGUAGES = {"id": "Bahasa Indonesia", "en": "English"}
OTHER = {"id": "en", "en": "id"}
BIBLIOGRAPHY = Path(__file__).resolve().parent.parent / "references.bib"
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
CITATION = re.compile(r"\{cite(?::\w)?\}`([^`]+)`")
FENCE = re.compile(r"\s*(`{3,}|~{3,}|:{3,})")
HEADING = re.compile(r"#{1,6}\s+(.*)")


def choose(text, language):
    """The part of "Indonesia | English" in one language; any other text unchanged."""
    parts = text.split(" | ")
    return parts[list(LANGUAGES).index(language)] if len(parts) == len(LANGUAGES) else text


def belongs(tags, language):
    """Does a piece of text with these tags appear in this language?"""
    return not any(f"lang-{other}" in tags for other in LANGUAGES if other != language)


def filter_notebook(notebook, language):
    """A copy of the notebook (a dict) without the other language's cells."""
    cells = notebook["cells"]
    kept = [cell for cell in cells if belongs(cell["metadata"].get("tags", []), language)]
    return {**notebook, "cells": kept}


def filter_markdown(text, language):
    """The text without the other language's blocks and without the lines that mark blocks."""
    kept, keep = [], True
    for line in text.splitlines():
        if line.startswith("+++"):
            keep = belongs(re.findall(r"lang-\w+", line), language)
            line = ""
        if keep:
            kept.append(line)
    return "\n".join(kept).strip() + "\n"


def source_in(text, path, language):
    """The Markdown of a page in one language, whether it is a notebook or a Markdown file."""
    if path.suffix != ".ipynb":
        return filter_markdown(text, language)
    cells = filter_notebook(json.loads(text), language)["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


def headings(markdown):
    """The text of every heading, in order, code and directives left out."""
    found, fence = [], None
    for line in markdown.splitlines():
        mark = FENCE.match(line)
        if mark and fence is None:
            fence = mark[1]
        elif mark and line.strip() == fence:
            fence = None
        elif not mark and fence is None and (heading := HEADING.match(line)):
            found.append(heading[1])
    return found


# --- what a reader takes home -------------------------------------------------------------------


def download_notebook(notebook, language, hint="", has_solutions=True):
    """The notebook in one language, with stored outputs, without what only this build knows.

    hint is a text for below its title; an edition without solutions leaves out their proofs, too.
    """
    notebook = copy.deepcopy(filter_notebook(notebook, language))
    if not has_solutions:
        notebook["cells"] = [cell for cell in notebook["cells"] if not is_proof(cell)]
    names = citations(BIBLIOGRAPHY, language)
    name_choices(notebook["cells"], language)
    for cell in notebook["cells"]:
        cell["metadata"].pop("book", None)
        if cell["cell_type"] == "markdown":
            cell["source"] = name_citations("".join(cell["source"]), names)
        for output in cell.get("outputs", []):
            # a live widget needs its kernel; its picture stays
            output.get("data", {}).pop(WIDGET_VIEW, None)
    if hint:
        below_title = {"cell_type": "markdown", "id": "needed", "metadata": {}, "source": hint}
        notebook["cells"].insert(1, below_title)
    for name in ("widgets", "book"):
        notebook["metadata"].pop(name, None)
    return notebook


def is_proof(cell):
    """Does this cell prove the answer of an exercise?"""
    return "proof" in cell["metadata"].get("tags", [])


def name_choices(cells, language):
    """Below the question of a choice, what there is to choose: the page has its own fields."""
    for question, cell in zip(cells, cells[1:]):
        exercise = cell["metadata"].get("book", {}).get("exercise", {})
        if question["cell_type"] == "markdown" and exercise.get("choices"):
            lines = [
                f"{letter}. {choice[language]}"
                for letter, choice in zip("abcd", exercise["choices"])
            ]
            question["source"] = "\n\n".join(["".join(question["source"]), *lines])


def name_citations(text, names):
    """{cite}`welch2006` -> [Welch and Bishop, 2006]."""

    def named(match):
        keys = [key.strip() for key in match[1].split(",")]
        return "[" + "; ".join(names[key] for key in keys) + "]"

    return CITATION.sub(named, text)


def citations(bibliography, language):
    """{key: "Welch and Bishop, 2006"} of every entry of the .bib file, in one language."""
    joint, others = {"id": (" dan ", " dkk."), "en": (" and ", " et al.")}[language]
    names = {}
    for key, entry in pybtex.database.parse_file(str(bibliography)).entries.items():
        people = [" ".join(person.last_names) for person in entry.persons.get("author", [])]
        authors = [choose(name.strip("{}"), language) for name in people]
        who = authors[0] + others if len(authors) > 2 else joint.join(authors)
        names[key] = f"{who}, {choose(entry.fields.get('year', ''), language)}"
    return names
