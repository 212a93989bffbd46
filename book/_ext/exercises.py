"""The exercises of a page: the cell check("3.2", ...) becomes a field that answers.

While the page is read, a directive takes the place behind every exercise cell; it makes the fields,
the hints and the solution, all of them rendered here, in the language of the book. The script
(book/explorers/exercise) shows the hint that fits an answer. The cells themselves, and the proofs
behind them, are run and then left out. How an exercise is written: CONTRIBUTING.md.
"""

import functools
import json
from pathlib import Path

import exercise_cells
import exercise_overview
import exercise_parts
import explorers
from docutils import nodes
from exercise_parts import Part
from figures import is_cell_part
from sphinx.errors import ExtensionError
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective

FOLDER = "vendor/exercises"
NAME = {"id": "Latihan", "en": "Exercise"}
logger = logging.getLogger(__name__)


def place_directives(app, docname, source):
    """Behind every exercise cell stands a Markdown cell with a directive; its metadata waits."""
    path = Path(app.env.doc2path(docname))
    if path.suffix != ".ipynb":
        return
    notebook = json.loads(source[0])
    cells, waiting = [], {}
    for cell in notebook["cells"]:
        cells.append(cell)
        if exercise_cells.is_exercise(cell):
            number = exercise_cells.number_of(cell)
            waiting[number] = exercise_cells.about(cell)
            cells.append({
                "cell_type": "markdown",
                "id": f"exercise-{len(cells)}",
                "metadata": {},
                "source": f"```{{exercise}} {number}\n```",
            })
    if waiting:
        report_problems(path, docname)
    app.env.temp_data["exercises"] = waiting
    source[0] = json.dumps({**notebook, "cells": cells})


def report_problems(path, docname):
    """The build takes warnings for errors."""
    for exercise in exercise_cells.in_notebook(path):
        for problem in exercise_cells.problems(exercise):
            logger.warning("%s", problem, location=docname)


class ExerciseDirective(SphinxDirective):
    """Everything of an exercise that stands below its question."""

    required_arguments = 1

    def run(self):
        number = self.arguments[0]
        about = self.env.temp_data["exercises"][number]
        if any(exercise_cells.problems_of_metadata(about)):
            return []  # report_problems has told it
        about = exercise_cells.for_students(about)
        about = exercise_cells.in_language(about, self.config.language)
        parse = functools.partial(exercise_parts.markdown, self)
        return [exercise_parts.block(number, about, self.config.language, parse)]


def leave_out_cells(app, doctree):
    """The line check(...) and the proof of the answer are for the notebook."""
    for cell in list(doctree.findall(is_cell_part("cell_code"))):
        tags = {name.removeprefix("tag_") for name in cell["classes"]}
        if tags & {exercise_cells.TAG, exercise_cells.PROOF}:
            cell.parent.remove(cell)


def name_questions(app, doctree):
    """ "Exercise 3.2." gets an id, which names the fields below it, and the page its progress."""
    is_first = True
    blocks = doctree.findall(lambda node: isinstance(node, Part) and node.get("number"))
    for block in list(blocks):
        question = question_of(doctree, block["number"], app.config.language)
        if question is None:
            logger.warning("exercise %s has no question above it", block["number"], location=block)
            continue
        paragraph, name = question
        own = exercise_parts.name_of(block["number"])
        paragraph["ids"].append(own)
        name["ids"].append(f"{own}-name")
        if is_first:
            line = exercise_parts.part("p", {"class": "exercise-progress", "hidden": ""})
            paragraph.parent.insert(paragraph.parent.index(paragraph), line)
        is_first = False


def question_of(doctree, number, language):
    """The paragraph of a question and its bold beginning."""
    wanted = f"{NAME[language]} {number}."
    for strong in doctree.findall(nodes.strong):
        if strong.astext() == wanted and isinstance(strong.parent, nodes.paragraph):
            return strong.parent, strong
    return None


# --- script and style sheet -----------------------------------------------------------------------


def bundle_for(app, config):
    """Put the script of this language among the static files."""
    folder = Path(app.doctreedir).parent / "exercises"
    try:
        explorers.bundle(folder / FOLDER, config.language, host="exercises")
    except explorers.Mistake as mistake:
        raise ExtensionError(str(mistake)) from mistake
    config.html_static_path.append(str(folder))


def load(app, pagename, templatename, context, doctree):
    """Script and style sheet, only on a page that holds an exercise; the overview needs no
    script."""
    body = context.get("body", "")
    has_exercises = '<div class="exercise"' in body
    if has_exercises:
        app.add_js_file(f"{FOLDER}/exercises.js", loading_method="defer")
    if has_exercises or exercise_overview.CLASS in body:
        app.add_css_file(f"{FOLDER}/exercises.css")


def setup(app):
    app.add_node(Part, html=(exercise_parts.open_part, exercise_parts.close_part))
    app.add_directive("exercise", ExerciseDirective)
    app.add_directive(exercise_overview.CLASS, exercise_overview.OverviewDirective)
    app.connect("config-inited", bundle_for)
    # after languages.py, before figures.py takes the metadata of the cells
    app.connect("source-read", place_directives, priority=550)
    app.connect("doctree-read", leave_out_cells, priority=450)  # before figures.py
    app.connect("doctree-read", name_questions, priority=450)
    app.connect("html-page-context", load)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
