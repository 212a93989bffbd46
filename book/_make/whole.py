"""All pages of one language as one document for paper: cover, contents, chapters, deeper pages as
appendices, references, and the solutions of the exercises at the end.

It is put together from the finished pages, so that it says what they say.
"""

import html
from pathlib import PurePosixPath

import yaml
from bs4 import BeautifulSoup
from edition import edition
from places import ROOT, SITE
from texts import choose

WORDS = {
    "id": {
        "contents": "Isi",
        "deeper": "Pendalaman",
        "solutions": "Penyelesaian latihan",
        "edition": "Edisi",
        "by": "oleh",
    },
    "en": {
        "contents": "Contents",
        "deeper": "Deeper",
        "solutions": "Solutions of the exercises",
        "edition": "Edition",
        "by": "by",
    },
}
NOT_ON_PAPER = (
    "script, form, a.headerlink, .launch, .exercise-progress, .exercise-verdict, .exercise-hints, "
    ".toctree-wrapper, details:not(.exercise-solution), .cell.tag_hide-cell"
)
# The exercises stand in their chapters; what is for lecturers leads to live figures
LEFT_OUT = {"book/exercises", "book/teaching"}
TALL = 0.8  # height by width: panels above each other
LONG = 12  # rows: a table that may go on on the next page


def pages_in_order():
    """Parts of _toc.yml as [(caption, [pages])], the deeper pages of all chapters in one of their
    own."""
    toc = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))
    parts, deeper = [(None, [toc["root"]])], []
    for part in toc["parts"]:
        names = [entry["file"] for entry in part["chapters"]]
        parts.append((part["caption"], [name for name in names if name not in LEFT_OUT]))
        for entry in part["chapters"]:
            deeper += [section["file"] for section in entry.get("sections", [])]
    behind = next(i for i, (_, pages) in enumerate(parts) if "book/use" in pages)
    parts.insert(behind, ("deeper", deeper))
    return parts


def slug(page):
    return page.replace("/", "-")


class Page:
    """The article of one page, with names that are its own in the whole."""

    def __init__(self, language, page):
        text = (SITE / language / f"{page}.html").read_text(encoding="utf-8")
        self.name = page
        self.article = BeautifulSoup(text, "html.parser").find("article")
        self.title = self.article.find("h1").get_text().removesuffix("#")
        self.solutions = self.take_solutions()
        self.keep_choices()
        for part in self.article.select(NOT_ON_PAPER):
            part.decompose()
        self.rename()

    def take_solutions(self):
        """[(name of the exercise, its worked answer), ...]"""
        found = []
        for exercise in self.article.select(".exercise"):
            worked = exercise.select_one(".exercise-worked")
            name = self.article.find(id=exercise["aria-labelledby"]).get_text()
            if worked is not None:
                found.append((name, worked.extract()))
        for solution in self.article.select(".exercise-solution"):
            solution.decompose()
        return found

    def keep_choices(self):
        """What a reader may choose from stays, as lines; buttons and fields go."""
        for form in self.article.select(".exercise form"):
            for choice in form.select(".exercise-choices label"):
                choice.name = "p"
                choice.find("input").decompose()
                choice.select_one(".exercise-letter").append(" ")
                form.insert_before(choice.extract())

    def rename(self):
        """Names and addresses count from the whole document."""
        self.article.attrs = {"class": self.article["class"]}
        mine = slug(self.name)
        for part in self.article.find_all(id=True):
            part["id"] = f"{mine}--{part['id']}"
        for key in ("aria-labelledby", "aria-describedby", "for"):
            for part in self.article.find_all(attrs={key: True}):
                part[key] = " ".join(f"{mine}--{name}" for name in part[key].split())
        for link in self.article.find_all("a", href=True):
            address = self.address(link["href"])
            if address is None:
                link.unwrap()
            else:
                link["href"] = address
        for table in self.article.find_all("table"):
            if len(table.find_all("tr")) > LONG:
                table["class"] = [*table.get("class", []), "long"]
        for picture in self.article.find_all("img", src=True):
            picture["src"] = self.place(picture["src"])
            picture["loading"] = "eager"
            if int(picture.get("height", 0)) > int(picture.get("width", 1)) * TALL:
                picture["class"] = [*picture.get("class", []), "tall"]

    def place(self, address):
        """A file of the site, seen from the folder of its language."""
        if address.startswith("data:"):
            return address
        parts = []
        for part in (PurePosixPath(self.name).parent / address).parts:
            parts = parts[:-1] if part == ".." and parts else [*parts, part]
        return "/".join(parts)

    def address(self, href):
        """The place in the whole; None: a picture or a download, which paper does not open."""
        if href.startswith(("http:", "https:", "mailto:")):
            return href
        page, _, name = href.partition("#")
        if page and not page.endswith(".html"):
            return None
        target = self.place(page).removesuffix(".html") if page else self.name
        return f"#{slug(target)}--{name}" if name else f"#{slug(target)}"


def sheet_of(solutions, words):
    worked = "".join(
        f'<p class="solution"><b>{html.escape(name)}</b></p>{answer}' for name, answer in solutions
    )
    return (
        f'<section class="page" id="solutions"><article class="bd-article">'
        f"<h1>{words['solutions']}</h1>{worked}</article></section>"
    )


def write_whole(language):
    """-> the path of the document, in the folder of the language, for its style and pictures."""
    words = WORDS[language]
    parts, contents, solutions = [], [], []
    for caption, names in pages_in_order():
        pages = [Page(language, name) for name in names]
        if caption:
            title = words["deeper"] if caption == "deeper" else choose(caption, language)
            contents.append(f'<li class="part">{html.escape(title)}</li>')
        for page in pages:
            contents.append(f'<li><a href="#{slug(page.name)}">{html.escape(page.title)}</a></li>')
            parts.append(f'<section class="page" id="{slug(page.name)}">{page.article}</section>')
            solutions += page.solutions
    if solutions:  # an edition for students has none
        contents.append(f'<li class="part"><a href="#solutions">{words["solutions"]}</a></li>')
        parts.append(sheet_of(solutions, words))
    path = SITE / language / "whole.html"
    path.write_text(
        frame(language, cover(language), contents_page(words, contents), *parts), encoding="utf-8"
    )
    return path


def cover(language):
    about, words = edition(), WORDS[language]
    authors = ", ".join(about["authors"])
    by = f"<p>{words['by']} {html.escape(authors)}</p>" if authors else ""
    picture = next((SITE / language / "_static" / "vendor").glob("cover.*"))
    return (
        f'<section class="front"><h1>{html.escape(about["title"][language])}</h1>{by}'
        f'<img src="_static/vendor/{picture.name}" alt="">'
        f"<p>{words['edition']} {about['version']}, {about['date']}. CC BY 4.0</p></section>"
    )


def contents_page(words, contents):
    return (
        f'<section class="page"><h1>{words["contents"]}</h1><ul>{"".join(contents)}</ul></section>'
    )


def frame(language, *parts):
    title = html.escape(edition()["title"][language])
    style = (ROOT / "book" / "_static" / "paper.css").read_text(encoding="utf-8")
    return (
        f'<!DOCTYPE html>\n<html lang="{language}" data-theme="light" data-mode="light">'
        f'<head><meta charset="utf-8"><title>{title}</title>'
        f'<link rel="stylesheet" href="_static/all.css"><style>{style}</style></head>'
        f'<body class="whole">{"".join(parts)}</body></html>'
    )
