"""The licences of what the site carries besides the book: one file of texts, as they ask for."""

from importlib import metadata

import offline
from places import SITE

FILE = "licences.txt"
FROM_NPM = (
    "katex",
    "reveal.js",
    "@fontsource-variable/plus-jakarta-sans",
    "@fontsource-variable/source-serif-4",
)
FROM_PYTHON = (
    "Sphinx",
    "sphinx-book-theme",
    "pydata-sphinx-theme",
    "sphinx-copybutton",
    "sphinx-togglebutton",
    "sphinx-design",
    "myst-nb",
)
HEAD = "Besides the book, these pages carry the work of others, under these licences.\n"
LINE = "=" * 78


def write_licences(output):
    """output: the folder of one language as Sphinx left it, with the notes of its scripts."""
    texts = [HEAD]
    for name in FROM_NPM:
        texts += headed(name, (offline.NODE_MODULES / name / "LICENSE").read_text("utf-8"))
    for name in FROM_PYTHON:
        texts += headed(name, licence_of(name))
    for path in sorted(output.rglob("*.LICENSE.txt")):
        texts += headed(path.name.removesuffix(".LICENSE.txt"), path.read_text("utf-8"))
    (SITE / FILE).write_text("\n".join(texts), encoding="utf-8")


def headed(name, text):
    return [LINE, name, LINE, text]


def licence_of(name):
    """The licence that a Python package brings, or at least its name."""
    package = metadata.distribution(name)
    files = [file for file in package.files or () if "licen" in file.name.lower()]
    if files:
        return "\n".join(file.read_text("utf-8") for file in files)
    about = package.metadata
    return about.get("License-Expression") or about.get("License") or "see its home page"
