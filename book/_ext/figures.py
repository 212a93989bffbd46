"""Figures: words in the reader's language, no jumping layout.

A figure holds symbols and units only, so that one figure serves both languages. Its words are
metadata of the code cell:

    "book": {"alt": {"id": "...", "en": "..."}, "caption": {"id": "...", "en": "..."}}
"""

import base64
import html
import io
import json
import re
from pathlib import Path

from docutils import nodes
from PIL import Image
from sphinx.util import logging
from texts import LANGUAGES

logger = logging.getLogger(__name__)
EXPLORER = "<kalman-explorer"
CAPTION = "book-caption"
UNNUMBERED = "unnumbered"
OLD_ALT = re.compile(r'(<img\b[^>]*?)\s+alt="[^"]*"')


def take_words(app, docname, source):
    """Take the words out of the cells before the notebook runs.

    The caption becomes a text cell below its figure. The cache of executed notebooks compares code
    cells with their metadata: without the words there, one cache serves both languages, and a new
    caption runs nothing again.
    """
    if Path(app.env.doc2path(docname)).suffix != ".ipynb":
        return
    notebook = json.loads(source[0])
    cells, alts = [], {}
    for cell in notebook["cells"]:
        words = cell["metadata"].pop("book", {})
        if words:
            alts[len(cells)] = words.get("alt", {})
        cells.append(cell)
        caption = words.get("caption", {}).get(app.config.language)
        if caption:
            cells.append({
                "cell_type": "markdown",
                "id": f"caption-{len(cells)}",
                "metadata": {},
                "source": f"::::{{container}} {CAPTION}\n{caption}\n::::",
            })
    app.env.temp_data["alts"] = alts
    source[0] = json.dumps({**notebook, "cells": cells})


def is_cell_part(part):
    return lambda node: isinstance(node, nodes.container) and node.get("nb_element") == part


def place_words(app, doctree):
    """Give every picture its alt text, and join picture and caption to a figure."""
    alts = app.env.temp_data.get("alts", {})
    for cell in doctree.findall(is_cell_part("cell_code")):
        images = list(cell.findall(nodes.image))
        explorers = [raw for raw in cell.findall(nodes.raw) if EXPLORER in raw.astext()]
        if images or explorers:
            describe(cell, images, explorers, alts.get(cell["cell_index"], {}), app.config.language)
    for number, caption in enumerate(list(doctree.findall(is_caption)), start=1):
        join(caption, number)


def describe(cell, images, explorers, alt, language):
    """Write the alt text, which must exist in both languages."""
    missing = [other for other in LANGUAGES if not alt.get(other, "").strip()]
    if missing:
        logger.warning(
            "a figure without alt text in %s: the cell needs "
            '"book": {"alt": {"id": ..., "en": ...}}',
            ", ".join(missing),
            location=cell,
        )
        return
    for image in images:
        image["alt"] = alt[language]
    for raw in explorers:
        text = OLD_ALT.sub(r"\1", raw.astext())
        text = text.replace("<img", f'<img alt="{html.escape(alt[language])}"', 1)
        raw.children = []
        raw += nodes.Text(text)


def is_caption(node):
    return isinstance(node, nodes.container) and CAPTION in node["classes"]


def join(caption, number):
    """Put the output above a caption and the caption into one numbered figure."""
    cell = caption.parent[caption.parent.index(caption) - 1]
    outputs = list(cell.findall(is_cell_part("mime_bundle")))
    if not outputs or len(caption) != 1:
        logger.warning("a caption needs an output above it and has one paragraph", location=cell)
        return
    figure = nodes.figure(ids=[f"figure-{number}"])  # the id makes Sphinx number it
    outputs[-1].replace_self(figure)
    figure += [outputs[-1], nodes.caption("", "", *caption[0].children)]
    caption.parent.remove(caption)


def is_unnumbered(node):
    """A figure with `:figclass: unnumbered`: no text refers to it."""
    return isinstance(node, nodes.figure) and UNNUMBERED in node["classes"]


def take_ids(app, doctree):
    """Sphinx counts the figures that have an id, from the first page to the last."""
    for figure in doctree.findall(is_unnumbered):
        figure["ids"] = []


def give_ids(app, doctree, docname):
    """When all are counted, an id again: without one Sphinx would warn while writing."""
    for number, figure in enumerate(doctree.findall(is_unnumbered), start=1):
        figure["ids"] = [f"picture-{number}"]


def image_size(app, src):
    """Width and height of an image in pixels, or None for what Pillow cannot read (SVG)."""
    try:
        if src.startswith("data:"):
            return Image.open(io.BytesIO(base64.b64decode(src.split(",", 1)[1]))).size
        name = src.rsplit("/", 1)[-1]
        for source, copy in app.builder.images.items():
            if copy == name:
                return Image.open(Path(app.srcdir, source)).size
    except (OSError, ValueError):
        return None


def complete_images(app, pagename, templatename, context, doctree):
    """Say the size of every picture, so that the text does not jump, and load all but one late."""
    count = 0

    def complete(match):
        nonlocal count
        count += 1
        tag = match[0]
        extra = ' decoding="async"' if count == 1 else ' loading="lazy" decoding="async"'
        size = image_size(app, re.search(r'src="([^"]*)"', tag)[1])
        if size and not re.search(r"\b(width|height)=", tag):
            extra += f' width="{size[0]}" height="{size[1]}"'
        return "<img" + extra + tag[len("<img") :]

    if context.get("body"):
        context["body"] = re.sub(r'<img\b[^>]*\bsrc="[^>]*>', complete, context["body"])


def setup(app):
    app.connect("source-read", take_words, priority=600)  # after languages.py
    app.connect("doctree-read", place_words)
    app.connect("doctree-read", take_ids)
    app.connect("doctree-resolved", give_ids)
    app.connect("html-page-context", complete_images)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
