"""Two languages from one source: pure work on texts. languages.py puts it into Sphinx.

A prose cell of a notebook carries the cell tag `lang-id` or `lang-en`; code cells carry neither. A
Markdown page says the same with a block break: `+++ {"tags": ["lang-id"]}`. Titles are written
"Indonesia | English".
"""

import json
import re

LANGUAGES = {"id": "Bahasa Indonesia", "en": "English"}
OTHER = {"id": "en", "en": "id"}
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
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
