"""Two languages from one source.

A prose cell of a notebook carries the cell tag `lang-id` or `lang-en`; code cells carry neither. A Markdown page says the
same with a block break: `+++ {"tags": ["lang-id"]}`. The book is built once per language (`language` in the configuration),
and this extension drops, while a page is read, what belongs to the other one. Titles are written "Indonesia | English".
"""
import json
import re
from pathlib import Path

import pybtex.database
from docutils import nodes
from sphinx.util import logging

LANGUAGES = {"id": "Bahasa Indonesia", "en": "English"}
MENDED = {'<summary aria-label="Toggle hidden content">': "<summary>",            # myst-nb: its own text says it already
          '<div role="list" class="citation-list">': '<div class="citation-list">',  # docutils: a list without list items
          ' role="doc-biblioentry"': ""}
HINT = {"id": "*Untuk menjalankan buku catatan ini diperlukan `kalman_lib` dan folder `data`. Keduanya ada, bersama perintah "
              "pemasangannya, dalam arsip lengkap di halaman “Cara memakai buku ini”.*",
        "en": "*To run this notebook, `kalman_lib` and the folder `data` are needed. Both are, with the commands to install them, "
              "in the complete archive on the page “How to use this book”.*"}
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
logger = logging.getLogger(__name__)


# --- pure text work (also used by book/build.py) --------------------------------------------------------------------

def choose(text, language):
    """The part of "Indonesia | English" in one language; any other text unchanged."""
    parts = text.split(" | ")
    return parts[list(LANGUAGES).index(language)] if len(parts) == len(LANGUAGES) else text


def belongs(tags, language):
    """Does a piece of text with these tags appear in this language?"""
    return not any(f"lang-{other}" in tags for other in LANGUAGES if other != language)


def filter_notebook(notebook, language):
    """A copy of the notebook (a dict) without the other language's cells."""
    cells = [cell for cell in notebook["cells"] if belongs(cell["metadata"].get("tags", []), language)]
    return {**notebook, "cells": cells}


def filter_markdown(text, language):
    """The Markdown text without the other language's blocks and without the lines that mark blocks."""
    kept, keep = [], True
    for line in text.splitlines():
        if line.startswith("+++"):
            keep = belongs(re.findall(r"lang-\w+", line), language)
            line = ""
        if keep:
            kept.append(line)
    return "\n".join(kept).strip() + "\n"


def citations(bibliography, language):
    """Key -> "Welch and Bishop, 2006" for every entry of the .bib file, in the words of one language."""
    joint, others = {"id": (" dan ", " dkk."), "en": (" and ", " et al.")}[language]
    names = {}
    for key, entry in pybtex.database.parse_file(str(bibliography)).entries.items():
        authors = [choose(" ".join(person.last_names).strip("{}"), language) for person in entry.persons.get("author", [])]
        who = authors[0] + others if len(authors) > 2 else joint.join(authors)
        names[key] = f"{who}, {choose(entry.fields.get('year', ''), language)}"
    return names


def download_notebook(notebook, language, hint=""):
    """The notebook a reader takes home: one language, stored outputs, nothing that only this build understands.

    hint is a text for below its title.
    """
    notebook = json.loads(json.dumps(filter_notebook(notebook, language)))  # a deep copy
    names = citations(Path(__file__).resolve().parent.parent / "references.bib", language)
    for cell in notebook["cells"]:
        cell["metadata"].pop("book", None)
        if cell["cell_type"] == "markdown":
            cell["source"] = re.sub(r"\{cite(?::\w)?\}`([^`]+)`", lambda match: "[" + "; ".join(
                names[key.strip()] for key in match[1].split(",")) + "]", "".join(cell["source"]))
        for output in cell.get("outputs", []):
            output.get("data", {}).pop(WIDGET_VIEW, None)  # a live widget needs its kernel; its picture stays
    if hint:
        notebook["cells"].insert(1, {"cell_type": "markdown", "id": "needed", "metadata": {}, "source": hint})
    notebook["metadata"].pop("widgets", None)
    return notebook


def headings(markdown):
    """The text of every heading, in order, code and directives left out."""
    found, fence = [], None
    for line in markdown.splitlines():
        if mark := re.match(r"\s*(`{3,}|~{3,}|:{3,})", line):
            if fence is None:
                fence = mark[1]
            elif line.strip() == fence:
                fence = None
        elif fence is None and (heading := re.match(r"#{1,6}\s+(.*)", line)):
            found.append(heading[1])
    return found


def source_in(text, path, language):
    """The Markdown of a page in one language, whether it is a notebook or a Markdown file."""
    if path.suffix != ".ipynb":
        return filter_markdown(text, language)
    cells = filter_notebook(json.loads(text), language)["cells"]
    return "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")


# --- Sphinx events --------------------------------------------------------------------------------------------------

def split_config(app, config):
    """Choose this language's part of every text in the configuration, theme options included."""
    def split(value):
        if isinstance(value, str):
            return choose(value, config.language)
        if isinstance(value, dict):
            return {key: split(part) for key, part in value.items()}
        return [split(part) for part in value] if isinstance(value, list) else value

    for name in ("html_title", "project", "author", "copyright", "html_theme_options", "nb_code_prompt_show",
                 "nb_code_prompt_hide", "book_solution_show", "book_solution_hide", "book_download_names", "togglebutton_hint", "togglebutton_hint_hide"):
        config[name] = split(config[name])


def split_toc(app, config):
    """The same for the captions and titles of the table of contents (which sphinx-external-toc reads at priority 900)."""
    for document in config.external_site_map.values():
        document.title = document.title and choose(document.title, config.language)
        for tree in document.subtrees:
            tree.caption = tree.caption and choose(tree.caption, config.language)
            for item in tree.items:
                if not isinstance(item, str) and item.title:  # a link; files are strings
                    item.title = choose(item.title, config.language)


def read_one_language(app, docname, source):
    """Leave only this language in the text of a page; remember the English headings for `name_sections`."""
    path = Path(app.env.doc2path(docname))
    app.env.temp_data["english_headings"] = headings(source_in(source[0], path, "en"))
    if path.suffix == ".ipynb":
        source[0] = json.dumps(filter_notebook(json.loads(source[0]), app.config.language))
    else:
        source[0] = filter_markdown(source[0], app.config.language)


def name_sections(app, doctree):
    """Name section n after English heading n in both languages, so that page.html#the-gain is the same section in both."""
    english = app.env.temp_data.get("english_headings", [])
    sections = list(doctree.findall(nodes.section))
    if len(sections) != len(english):
        logger.warning("the page has %d headings, its English text %d: both languages need the same headings in the same order",
                       len(sections), len(english), location=app.env.docname)
    used = set()
    for section, heading in zip(sections, english):
        slug = base = nodes.make_id(heading) or "section"
        count = 1
        while slug in used or doctree.ids.get(slug, section) is not section:
            count += 1
            slug = f"{base}-{count}"
        used.add(slug)
        section["ids"] = [slug] + [old for old in section["ids"] if old != slug]
        doctree.ids[slug] = section
        # a Markdown link page.ipynb#the-gain finds it, too, in both languages
        app.env.metadata[app.env.docname].setdefault("myst_slugs", {})[slug] = (section.line, slug, section[0].astext())


def add_language_links(app, pagename, templatename, context, doctree):
    """What layout.html and language-switcher.html need to lead to the same page in the other language."""
    if app.config.book_site:
        up = "../" * (pagename.count("/") + 1)  # out of this language's folder
        context["languages"] = [{"code": code, "name": name, "url": f"{up}{code}/{pagename}.html"}
                                for code, name in LANGUAGES.items()]
        context["choose_url"] = f"{up}index.html"


def mend_markup(app, pagename, templatename, context, doctree):
    """Take away what extensions write in English only, or with a role that screen readers stumble over."""
    for wrong, right in MENDED.items():
        context["body"] = context.get("body", "").replace(wrong, right)


def name_solutions(app, pagename, templatename, context, doctree):
    """A hidden cell is the solution of an exercise: its prompt says so (other prompts say "Show the code")."""
    context["body"] = re.sub(r'(<div class="cell tag_hide-cell[^>]*>\s*<details[^>]*>\s*<summary>\s*<p[^>]*>)[^<]*(</p>\s*<p[^>]*>)[^<]*',
                             rf"\g<1>{app.config.book_solution_show}\g<2>{app.config.book_solution_hide}", context.get("body", ""))


def name_downloads(app, pagename, templatename, context, doctree):
    """Say in words what the buttons of the download menu give; the theme shows file endings only."""
    for group in context.get("header_buttons", []):
        for button in group.get("buttons", []):
            button["text"] = app.config.book_download_names.get(button.get("text"), button.get("text"))


def write_downloads(app, exception):
    """Sphinx copied the sources of both languages into _sources: put this language's text there instead."""
    if exception or app.builder.format != "html":
        return
    for docname in app.env.all_docs:
        source = Path(app.env.doc2path(docname))
        copy = Path(app.outdir, "_sources", docname).with_name(source.name)
        if copy.exists():
            text = source.read_text(encoding="utf-8")
            if source.suffix == ".ipynb":
                text = json.dumps(download_notebook(json.loads(text), app.config.language, HINT[app.config.language]), indent=1, ensure_ascii=False)
            else:
                text = filter_markdown(text, app.config.language)
            copy.write_text(text, encoding="utf-8")


def write_index(app, exception):
    """index.html of one language leads to its first page."""
    if exception or app.builder.name != "html":
        return
    page = Path(app.outdir, "index.html")
    page.write_text(
        f'<!DOCTYPE html>\n<html lang="{app.config.language}"><head><meta charset="utf-8">'
        f'<meta name="viewport" content="width=device-width, initial-scale=1"><title>{app.config.html_title}</title>'
        f'<meta http-equiv="refresh" content="0; url={app.config.root_doc}.html"></head>\n'
        f'<body><main><h1><a href="{app.config.root_doc}.html">{app.config.html_title}</a></h1></main></body></html>\n',
        encoding="utf-8")


def setup(app):
    app.add_config_value("book_site", False, "html")  # set by book/build.py, which builds both languages beside each other
    app.connect("config-inited", split_config, priority=100)
    app.connect("config-inited", split_toc, priority=999)
    app.connect("source-read", read_one_language)
    app.connect("doctree-read", name_sections, priority=400)  # before the table of contents is collected (500)
    app.connect("html-page-context", add_language_links)
    app.add_config_value("book_download_names", {}, "html")
    app.add_config_value("book_solution_show", "", "html")
    app.add_config_value("book_solution_hide", "", "html")
    app.connect("html-page-context", mend_markup)
    app.connect("html-page-context", name_solutions, priority=600)  # after mend_markup
    app.connect("html-page-context", name_downloads, priority=600)  # after the theme has made its buttons
    app.connect("build-finished", write_downloads)
    app.connect("build-finished", write_index, priority=400)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
