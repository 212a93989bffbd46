"""The live explorers: a core and one script per paper, made from book/explorers and loaded where
they are needed.

A page loads core.js and core.css once, and the script of each paper it shows: classic scripts,
because a browser refuses ES modules from file://. What only some readers need (files.js,
sensors.js, and the folder "later" of a paper) is fetched when a reader first needs it. Every folder
in book/explorers/papers belongs to the paper of the same name, and its ranges and words come from
the Params of that paper. bundle.mjs does the bundling and leaves out the words of the other
language.

The same explorers are the widgets of the notebooks: one ES module with all papers in both
languages, which belongs to the package (kalman_lib/live/bundle, made, not stored in Git).

With it go the exercises of the chapters, which kalman_lib.exercises asks (exercise_cells.py).

`python book/_ext/explorers.py` makes what the notebooks need.
"""

import importlib
import importlib.util
import json
import re
import subprocess
import sys
from pathlib import Path

import exercise_cells
import offline

SOURCES = offline.BOOK / "explorers"
DATA = offline.BOOK.parent / "notebooks" / "data"
FOLDER = "vendor/explorers"
ROOMS = ("files", "sensors")  # what only some readers need: a script each, fetched then
LATER = "later"  # the folder of a paper with what only some of its readers need: a script, too
FOR_NOTEBOOKS = offline.BOOK.parent / "kalman_lib" / "live" / "bundle"
ELEMENT = re.compile(r"<kalman-explorer\b([^>]*)>")


class Mistake(Exception):
    """What is wrong with the explorers, in one sentence."""


def paper_names(sources):
    """The papers that have an explorer: one folder each."""
    folders = sorted(path for path in (sources / "papers").iterdir() if path.is_dir())
    for folder in folders:
        if not (folder / "index.js").exists():
            raise Mistake(f"book/explorers/papers/{folder.name}/index.js is missing.")
        if importlib.util.find_spec(f"kalman_lib.papers.{folder.name}") is None:
            raise Mistake(
                f"book/explorers/papers/{folder.name} has no paper: "
                f"kalman_lib/papers/{folder.name}.py is missing."
            )
    return [folder.name for folder in folders]


def rooms(sources=SOURCES):
    """{name of a script that is fetched when a reader needs it: its folder in the sources}"""
    found = {room: room for room in ROOMS}
    for path in sorted(sources.glob(f"papers/*/{LATER}")):
        found[f"{path.parent.name}_{LATER}"] = path.relative_to(sources).as_posix()
    return found


def table(name, language):
    """The fields of the paper's Params with the words of one language; language None: of both."""
    from kalman_lib.papers import describe

    module = importlib.import_module(f"kalman_lib.papers.{name}")
    left_out = {"id", "en"} - {language} if language else set()
    return {
        field: {key: value for key, value in meta.items() if key not in left_out}
        for field, meta in describe(module.Params).items()
    }


def bundle(target, language, sources=SOURCES, host="page"):
    """Write scripts and style sheet of one language (None: with both) into a folder ->
    {paper: its views}.

    host: "page" of the book, "cell" of a notebook, or "exercises" of a page.
    """
    papers = {name: table(name, language) for name in paper_names(sources)}
    question = {
        "host": host,
        "sources": str(sources),
        "data": str(DATA),
        "language": language,
        "papers": papers,
        "rooms": rooms(sources),
    }
    program = Path(__file__).with_name("bundle.mjs")
    made = subprocess.run(
        [str(offline.node_binary()), str(program)],
        input=json.dumps(question),
        capture_output=True,
        encoding="utf-8",
    )
    if made.returncode != 0:
        raise Mistake(made.stderr.strip())
    answer = json.loads(made.stdout)
    for name, text in answer["files"].items():
        offline.write_if_new(target / name, text.encode())
    return answer["views"]


def scripts(papers):
    """The scripts that a page with these papers loads, in their order."""
    return ["core", *papers]


def listens(paper, sources=SOURCES):
    """Does this paper offer the control that listens to a phone's motion sensors?"""
    modules = (sources / "papers" / paper).rglob("*.js")
    return any('/own/phone.js"' in path.read_text(encoding="utf-8") for path in modules)


def for_notebooks(target=FOR_NOTEBOOKS):
    """Write what kalman_lib.explorer shows in a notebook: a module, its styles, its starts; and
    the exercises for kalman_lib.exercises."""
    write_exercises(target)
    try:
        return bundle(target, None, host="cell")
    except Mistake as mistake:
        sys.exit(str(mistake))


def write_exercises(target=FOR_NOTEBOOKS):
    offline.write_if_new(target / exercise_cells.FILE, exercise_cells.as_json().encode())


def bundle_for(app, config):
    """The book's language is known: put its scripts among the static files."""
    from sphinx.errors import ExtensionError

    folder = Path(app.doctreedir).parent / "explorers"
    try:
        app.explorer_views = bundle(folder / FOLDER, config.language)
        if not FOR_NOTEBOOKS.exists():  # the notebooks run soon; book/build.py has made it before
            for_notebooks()
    except Mistake as mistake:
        raise ExtensionError(str(mistake)) from mistake
    config.html_static_path.append(str(folder))


def shown_in(body):
    """[(paper, view or None), ...] of the explorers in a page."""
    shown = []
    for attributes in ELEMENT.findall(body):
        values = dict(re.findall(r'([\w-]+)="([^"]*)"', attributes))
        shown.append((values.get("paper", ""), values.get("view")))
    return shown


def problems(shown, views):
    """One sentence for every explorer of a page that does not exist."""
    for paper, view in shown:
        if paper not in views:
            folder = f"book/explorers/papers/{paper}"
            yield f'the explorer "{paper}" does not exist: {folder}/index.js is missing'
        elif view is not None and view not in views[paper]:
            yield f'the explorer "{paper}" has no view "{view}"; it has {", ".join(views[paper])}'


def load(app, pagename, templatename, context, doctree):
    """Scripts and style sheet, only on a page that holds an explorer."""
    from sphinx.util import logging

    shown = shown_in(context.get("body", ""))
    for problem in problems(shown, app.explorer_views):
        logging.getLogger(__name__).warning(
            "%s", problem, location=pagename
        )  # the build takes warnings for errors
    if shown:
        papers = dict.fromkeys(paper for paper, _ in shown)
        for name in scripts(papers):
            app.add_js_file(f"{FOLDER}/{name}.js", loading_method="defer")
        app.add_css_file(f"{FOLDER}/core.css")


def setup(app):
    offline.install()
    app.connect("config-inited", bundle_for)
    app.connect("html-page-context", load)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


if __name__ == "__main__":
    offline.install()
    for_notebooks()
