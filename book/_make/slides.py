"""Slides of every chapter, made from its finished page: slides/<chapter>.html of each language.

A section of the page is one slide from left to right. Here its parts are put in a row, and what
only a page needs goes; how many slides below each other a section fills is found in the browser
(book/slides/slides.js), which alone knows how high a part is. Without a script, and on the way to
it, the file is a plain page.
"""

import copy
import html
import shutil
from pathlib import Path

import light
import offline
from bs4 import BeautifulSoup
from edition import edition
from lists import chapters
from places import ROOT, SITE
from texts import LANGUAGES, OTHER

WORDS = {
    "id": {
        "slides": "Salindia",
        "page": "Baca bab ini",
        "keys": "Panah kanan: bagian berikutnya. Panah bawah atau spasi: lanjut di bagian ini.",
    },
    "en": {
        "slides": "Slides",
        "page": "Read this chapter",
        "keys": "Right arrow: the next section. Down arrow or space: go on in this section.",
    },
}
SOURCE = ROOT / "book" / "slides"
REVEAL = offline.NODE_MODULES / "reveal.js" / "dist"
PLACE = "_static/vendor/slides"  # of the scripts and the sheet, in the folder of a language
HEAD = (
    "meta[charset], meta[name=viewport], meta[name=theme-color], link[rel=icon], "
    "link[rel=apple-touch-icon], link[rel=manifest], link[rel=canonical], link[rel=stylesheet], "
    "script[src*='/start.js']"
)
SCRIPTS = "script[src*='/vendor/explorers/'], script[src*='/offline.js']"
ONLY_FOR_A_PAGE = (
    "a.headerlink, .launch, .exercise-progress, .exercise-verdict, .exercise-hints, "
    ".toctree-wrapper, details.above-input, details.below-input"
)


def write_slides(language):
    """Slides of all chapters of one language, with what they load."""
    folder = SITE / language
    (folder / "slides").mkdir(exist_ok=True)
    for chapter in chapters():
        page = (folder / f"{chapter}.html").read_text(encoding="utf-8")
        name = chapter.rpartition("/")[2]
        text = slides_of(page, language, name)
        (folder / "slides" / f"{name}.html").write_text(text, encoding="utf-8")
    write_what_they_load(folder)


def write_what_they_load(folder):
    place = folder / PLACE
    place.mkdir(parents=True, exist_ok=True)
    shutil.copy(REVEAL / "reveal.js", place)
    shutil.copy(SOURCE / "slides.js", place)
    sheets = [
        Path(shutil.copy(sheet, place)) for sheet in (REVEAL / "reveal.css", SOURCE / "looks.css")
    ]
    names = [sheet.relative_to(folder).as_posix() for sheet in sheets]
    scripts = [f"{place}/*.js", f"{folder}/_static/vendor/explorers/*.js"]
    shown = [f"{folder}/slides/*.html", *scripts]
    css = light.purged(folder, names, shown)
    for sheet in sheets:
        sheet.unlink()
    (place / "slides.css").write_text(css, encoding="utf-8")


# --- one file -----------------------------------------------------------------------------------


def slides_of(page, language, name):
    """page: the text of a chapter's page; name: such as 03_gyro."""
    soup = BeautifulSoup(page, "html.parser")
    article = soup.find("article")
    for part in article.select(ONLY_FOR_A_PAGE):
        part.decompose()
    lead_to_the_page(article, name)
    chapter = article.find("section")
    title = chapter.find("h1").extract().decode_contents()
    parts = [first_part(language, title, name), *map(str, sections(chapter))]
    return frame(soup, language, name, BeautifulSoup(title, "html.parser").get_text(), parts)


def lead_to_the_page(article, name):
    """A slide shows no other place of its chapter: a link opens the page there."""
    for link in article.find_all("a", href=True):
        if link["href"].startswith("#"):
            link["href"] = f"../notebooks/{name}.html{link['href']}"
        elif not link["href"].startswith(("../", "http:", "https:", "mailto:")):
            link["href"] = f"../notebooks/{link['href']}"


def first_part(language, title, name):
    words, book = WORDS[language], html.escape(edition()["title"][language])
    other = OTHER[language]
    return (
        f'<section class="part front"><p class="slide-book">{book}</p><h1>{title}</h1>'
        f'<p class="slide-links"><a href="../notebooks/{name}.html">{words["page"]}</a> · '
        f'<a lang="{other}" hreflang="{other}" href="../../{other}/slides/{name}.html">'
        f'{LANGUAGES[other]}</a></p><p class="slide-keys">{words["keys"]}</p></section>'
    )


def frame(soup, language, name, title, parts):
    words, book = WORDS[language], edition()["title"][language]
    head = [str(part) for part in soup.head.select(HEAD)]
    twins = [(code, f"../../{code}/slides/{name}.html") for code in LANGUAGES]
    twins.append(("x-default", "../../index.html"))
    head += [f'<link rel="alternate" hreflang="{code}" href="{twin}">' for code, twin in twins]
    head.append(f'<link rel="stylesheet" href="../{PLACE}/slides.css">')
    head += [str(script) for script in soup.select(SCRIPTS)]
    head += [
        f'<script defer src="../{PLACE}/{script}"></script>'
        for script in ("reveal.js", "slides.js")
    ]
    whole = html.escape(f"{words['slides']}: {title} — {book}")
    return (
        f'<!DOCTYPE html>\n<html lang="{language}" data-content_root="../" data-theme="auto">'
        f"<head>{''.join(head)}<title>{whole}</title></head>"
        f'<body><main><div class="bd-content"><article class="bd-article">{"".join(parts)}'
        "</article></div></main></body></html>\n"
    )


# --- the parts of a section ---------------------------------------------------------------------


def sections(chapter):
    """What stands before the first heading, then every section: each with its parts in a row."""
    own = BeautifulSoup("", "html.parser")
    made, before = [], []
    for part in chapter.find_all(recursive=False):
        if part.name == "section":
            made.append(row(own, part.get("id"), part.find("h2"), blocks(own, part)))
        else:
            before += blocks_of(own, part)
    return [row(own, None, None, before), *made]


def row(own, name, heading, parts):
    section = own.new_tag("section", attrs={"class": "part"})
    if name == "critical-note":
        section["class"] = "part critical"
    if heading is not None:
        section.append(heading)
    for part in parts:
        section.append(part)
    for part in section.find_all(id=True):
        del part["id"]  # links lead to the page
    return section


def blocks(own, section):
    """The parts of a section and of the sections inside, without its heading."""
    found = []
    for part in section.find_all(recursive=False):
        if part.name == "section":
            found += blocks(own, part)
        elif part.name != "h2":
            found += blocks_of(own, part)
    return found


def blocks_of(own, part):
    """What a slide takes as one: the code of a cell, each of its outputs, a question, a table."""
    classes = part.get("class", [])
    if "cell" in classes:
        return pieces_of_cell(own, part)
    if "exercise" in classes:
        return pieces_of_exercise(own, part)
    if not part.contents:
        return []  # it was there for its name
    if is_question(part):
        part["data-slide"] = "new"
    elif part.name in ("h3", "h4") or part.get_text().rstrip().endswith(":"):
        part["data-slide"] = "leads"  # stands with what follows
    return [part]


def is_question(part):
    return part.name == "p" and part.get("id", "").startswith("exercise-")


def pieces_of_cell(own, cell):
    pieces = cell.select(":scope > .cell_input, :scope > .cell_output > *")
    made = []
    for piece in pieces:
        box = own.new_tag("div", attrs={"class": cell["class"]})
        inner = box
        if "cell_input" in piece.get("class", []):
            if len(pieces) > 1:
                box["data-slide"] = "leads"
        else:
            inner = own.new_tag("div", attrs={"class": piece.parent["class"]})
            box.append(inner)
        if piece.find("kalman-explorer") is not None:
            box["data-slide"] = "alone"
        inner.append(copy.copy(piece))
        made.append(box)
    return made


def pieces_of_exercise(own, exercise):
    """What there is to choose from, as a list; the solution, which is shown later."""
    made = []
    choices = exercise.select(".exercise-choices label")
    if choices:
        made.append(own.new_tag("ul", attrs={"class": "slide-choices"}))
    for choice in choices:
        choice.find("input").decompose()
        choice.select_one(".exercise-letter").append(" ")
        choice.name = "li"
        made[0].append(choice.extract())
    worked = exercise.select_one(".exercise-worked")
    if worked is not None:
        name = own.new_tag("p", attrs={"class": "slide-answer"})
        name.string = exercise.select_one(".exercise-solution summary").get_text(strip=True)
        worked.insert(0, name)
        worked["class"] = "slide-solution"
        worked["data-slide"] = "last"
        made.append(worked.extract())
    return made
