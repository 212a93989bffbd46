"""What has changed since the last build?"""

import hashlib
import json
import re

from places import ROOT

NOT_SOURCES = {"node_modules", "vendor", "bundle", "__pycache__", ".ipynb_checkpoints"}
MAKERS = (  # whatever makes the pages
    "book/_ext",
    "book/_locale",
    "book/_make",
    "book/_static",
    "book/_templates",
    "book/build.py",
    "book/explorers",
    "book/package-lock.json",
    "book/references.bib",
    "_config.yml",
    "_toc.yml",
    "kalman_lib",
    "notebooks/data",
    "requirements.lock",
)
HEADING = r'(?:^|")#+ [^"\n]*'
ROLE = r"\{[a-z:]+\}`[^`]*`"
LINK = r"\]\([^)]*\)"
TARGET = r"^\([\w-]+\)="
OUTLINE = re.compile("|".join((HEADING, ROLE, LINK, TARGET)), re.MULTILINE)


def fingerprint(*paths):
    """One number for the content of these files and folders."""
    digest = hashlib.sha256()
    for path in paths:
        files = sorted(path.rglob("*")) if path.is_dir() else [path]
        for file in files:
            if file.is_file() and is_source(file):
                name = file.relative_to(ROOT).as_posix()
                digest.update(name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def is_source(file):
    """Is it written by hand, not made by a tool?"""
    return not NOT_SOURCES & set(file.relative_to(ROOT).parts) and file.suffix != ".mo"


def frame():
    """One number for all that may show on other pages than its own.

    That is whatever makes the pages, and the headings, references and links in the texts. While it
    stays, a changed text changes its own page only.
    """
    outlines = []
    for path in sorted([*(ROOT / "book").glob("*.md"), *(ROOT / "notebooks").glob("*.ipynb")]):
        outlines.append([path.name, OUTLINE.findall(path.read_text(encoding="utf-8"))])
    digest = hashlib.sha256(json.dumps(outlines).encode())
    digest.update(fingerprint(*(ROOT / name for name in MAKERS)).encode())
    return digest.hexdigest()


def is_new(mark, value):
    """Does the file `mark` hold another value than this one?"""
    return not mark.exists() or mark.read_text() != value
