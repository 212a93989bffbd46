"""What make lists writes: chapters in README.md and book/intro.md, glossary, notation, title.

The order is that of _toc.yml, the titles are the first headings of the chapters, and the sentence
about a chapter stands in the metadata of its notebook: {"book": {"sentence": {"id": ..., "en":
...}}}. The errata, with more to say, are written by hand; tests/test_lists.py names what they miss.
The glossary comes from book/terms.yml (glossary.py), the notation from book/letters.yml
(notation.py), title, authors and version from _config.yml (edition.py).
"""

import json
import re
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "book" / "_ext"), str(ROOT / "book" / "_make")]
import edition  # noqa: E402
from glossary import glossary  # noqa: E402
from notation import for_all, for_some  # noqa: E402
from texts import headings, source_in  # noqa: E402

README, INTRO = ROOT / "README.md", ROOT / "book" / "intro.md"
GLOSSARY, NOTATION = ROOT / "book" / "glossary.md", ROOT / "book" / "notation.md"
LIST = re.compile(r"(<!-- \w+: make lists -->\n).*?(<!-- end -->)", re.DOTALL)


def pages(entries):
    """The pages of a part of _toc.yml in reading order, those below others included."""
    found = []
    for entry in entries:
        found.append(entry["file"])
        found += pages(entry.get("sections", []))
    return found


def contents():
    """_toc.yml as a list of parts, each a list of its top pages and of all its pages."""
    toc = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))
    parts = [part["chapters"] for part in toc["parts"]]
    return toc["root"], [([entry["file"] for entry in part], pages(part)) for part in parts]


def chapters():
    """The chapters: the top pages of the parts that begin with a notebook."""
    _, parts = contents()
    return [page for top, _ in parts for page in top if top[0].startswith("notebooks/")]


def title(page, language):
    """The first heading of a page in one language."""
    path = next(path for path in (ROOT / f"{page}.ipynb", ROOT / f"{page}.md") if path.exists())
    return headings(source_in(path.read_text(encoding="utf-8"), path, language))[0]


def critical_notes():
    """Chapters that have a critical note, which the errata must name."""
    found = []
    for page in chapters():
        text = json.dumps(json.loads((ROOT / f"{page}.ipynb").read_text(encoding="utf-8")))
        if "## Critical note" in text:
            found.append(page)
    return found


def readme_list():
    """One numbered line a chapter, both titles."""
    lines = []
    for number, page in enumerate(chapters(), start=1):
        both = f"{title(page, 'id')} · {title(page, 'en')}"
        lines.append(f"{number}. [{both}]({page}.ipynb)\n")
    return "".join(lines)


def sentence(page, language):
    """What the first page of the book says about a chapter."""
    metadata = json.loads((ROOT / f"{page}.ipynb").read_text(encoding="utf-8"))["metadata"]
    return metadata["book"]["sentence"][language]


def intro_list(language):
    """One numbered line a chapter, its title and what it is about."""
    lines = []
    for number, page in enumerate(chapters(), start=1):
        link = f"[**{title(page, language)}**](../{page}.ipynb)"
        lines.append(f"{number}. {link}. {sentence(page, language)}\n")
    return "".join(lines)


def with_lists(text, *lists):
    """A text with its lists, one after the other, as they should be."""
    wanted = iter(lists)
    return LIST.sub(lambda marks: marks[1] + next(wanted) + marks[2], text)


def wanted():
    """{path: its text with the lists as they should be}."""
    languages = ("id", "en")
    written = {
        README: [readme_list()],
        INTRO: [intro_list(language) for language in languages],
        GLOSSARY: [glossary(language, chapters()) for language in languages],
        NOTATION: [table(language) for language in languages for table in (for_all, for_some)],
    }
    found = edition.texts()
    for path, parts in written.items():
        text = found.get(path) or path.read_text(encoding="utf-8")
        found[path] = with_lists(text, *parts)
    return found


if __name__ == "__main__":
    for path, text in wanted().items():
        if path.read_text(encoding="utf-8") != text:  # make takes what is newer for changed
            path.write_text(text, encoding="utf-8")
