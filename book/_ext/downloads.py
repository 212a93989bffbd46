"""What a reader takes home: a notebook in one language that stands on its own.

Captions below the figures, citations as names with a list at the end, the choices of an exercise,
and a first cell that installs what is missing (first_cell.py). What only this build knows is gone.
"""

import copy
import functools
import html
import json
import re
from pathlib import Path

import pybtex.database
from exercise_cells import PROOF, has_solutions
from first_cell import first_cells
from indonesian import EnglishStyle, IndonesianStyle
from pybtex.backends.markdown import Backend
from texts import WIDGET_VIEW, choose, filter_notebook

BIBLIOGRAPHY = Path(__file__).resolve().parent.parent / "references.bib"
NOTEBOOKS = BIBLIOGRAPHY.parent.parent / "notebooks"
STYLES = {"id": IndonesianStyle, "en": EnglishStyle}
REFERENCES = {"id": "Daftar pustaka", "en": "References"}
FIGURE = {"id": "Gambar", "en": "Fig."}  # as on the page
CITATION = re.compile(r"\{cite(?::\w)?\}`([^`]+)`")
PAGE_LINK = re.compile(r"\[([^\[\]]*)\]\(\.\./(book/[\w-]+)\.md(#[\w-]+)?\)")
NOTEBOOK_LINK = re.compile(r"\[([^\[\]]*)\]\(([\w-]+)\.ipynb(#[\w-]+)?\)")
DATA_LINK = re.compile(r"\[([^\[\]]*)\]\((data/[\w.-]+)\)")
EMPTY_ALT = re.compile(r'(<kalman-explorer[^>]*><img) alt=""')


def download_notebook(notebook, language, name="", version="", place=None):
    """The notebook in one language, with stored outputs.

    name: of its file, such as 03_gyro.ipynb, for the numbers of its figures; version: of the wheel
    that its first cell installs; place: where it will be opened, for that cell and for links.
    """
    notebook = copy.deepcopy(filter_notebook(notebook, language))
    cells = [cell for cell in notebook["cells"] if has_solutions() or not is_proof(cell)]
    name_choices(cells, language)
    keys = cited(cells)
    names = citations(language)
    for cell in cells:
        if cell["cell_type"] == "markdown":
            cell["source"] = name_citations("".join(cell["source"]), names)
    notebook["cells"] = cells = with_captions(cells, language, name)
    for cell in cells:
        for output in cell.get("outputs", []):
            # a live widget needs its kernel; its picture stays
            output.get("data", {}).pop(WIDGET_VIEW, None)
    if keys:
        cells.append(reference_list(keys, language))
    if place is not None:
        lead_to_the_site(cells, place)
        cells[1:1] = first_cells(notebook, language, version, place)
    for name in ("widgets", "book"):
        notebook["metadata"].pop(name, None)
    return notebook


def notebooks_in(language, version, place):
    """All notebooks as they are taken home: (name of the file, its text)."""
    for path in sorted(NOTEBOOKS.glob("*.ipynb")):
        notebook = json.loads(path.read_text(encoding="utf-8"))
        content = download_notebook(notebook, language, path.name, version, place)
        yield path.name, json.dumps(content, indent=1, ensure_ascii=False)


def is_proof(cell):
    """Does this cell prove the answer of an exercise? (An edition for students has none.)"""
    return PROOF in cell["metadata"].get("tags", [])


def text_cell(name, source):
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": source}


# --- words of figures and exercises ---------------------------------------------------------------


def with_captions(cells, language, name):
    """The cells without the metadata of the book: a caption becomes a text below its figure, the
    alternative text of an explorer part of its picture."""
    found = []
    number = figures_before(name)
    for cell in cells:
        words = cell["metadata"].pop("book", {})
        found.append(cell)
        describe(cell, words.get("alt", {}).get(language, ""))
        if "caption" in words:
            number += 1
            called = f"{FIGURE[language]} {int(name[:2])}.{number}." if name else FIGURE[language]
            text = f"**{called}** {words['caption'][language]}"
            found.append(text_cell(f"caption-{number}", text))
    return found


def describe(cell, alt):
    for output in cell.get("outputs", []):
        page = output.get("data", {}).get("text/html")
        if page and alt:
            text = rf'\g<1> alt="{html.escape(alt)}"'.replace("\\s", "\\\\s")
            output["data"]["text/html"] = EMPTY_ALT.sub(text, "".join(page), count=1)


@functools.cache
def figures_before(name):
    """How many figures the chapter has before this notebook: the page numbers them, too."""
    count = 0
    for path in sorted(NOTEBOOKS.glob(f"{name[:2]}_*.ipynb")) if name else []:
        if path.name < name:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            count += sum("caption" in cell["metadata"].get("book", {}) for cell in cells)
    return count


def name_choices(cells, language):
    """Below the question of a choice, what there is to choose: the page has its own fields."""
    for question, cell in zip(cells, cells[1:]):
        exercise = cell["metadata"].get("book", {}).get("exercise", {})
        if question["cell_type"] == "markdown" and exercise.get("choices"):
            lines = [
                f"{letter}. {choice[language]}"
                for letter, choice in zip("abcd", exercise["choices"])
            ]
            question["source"] = "\n\n".join(["".join(question["source"]), *lines])


# --- sources --------------------------------------------------------------------------------------


def keys_in(match):
    return [key.strip() for key in match[1].split(",")]


def cited(cells):
    """The keys of all citations in the texts."""
    texts = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
    return {key for text in texts for match in CITATION.finditer(text) for key in keys_in(match)}


def name_citations(text, names):
    """{cite}`welch2006` -> [Welch and Bishop, 2006]."""
    return CITATION.sub(lambda match: f"[{'; '.join(names[key] for key in keys_in(match))}]", text)


@functools.cache
def sources(language):
    """The entries of references.bib; of "Indonesia | English" one half."""
    entries = pybtex.database.parse_file(str(BIBLIOGRAPHY)).entries
    for entry in entries.values():
        for name, value in list(entry.fields.items()):
            entry.fields[name] = choose(value, language)
        for person in entry.persons.get("author", []):
            last = [choose(part.strip("{}"), language) for part in person.last_names]
            person.last_names = last
    return entries


@functools.cache
def citations(language):
    """{key: "Welch and Bishop, 2006"} of every source."""
    joint, others = {"id": (" dan ", " dkk."), "en": (" and ", " et al.")}[language]
    names = {}
    for key, entry in sources(language).items():
        authors = [" ".join(person.last_names) for person in entry.persons.get("author", [])]
        who = authors[0] + others if len(authors) > 2 else joint.join(authors)
        names[key] = f"{who}, {entry.fields.get('year', '')}"
    return names


def reference_list(keys, language):
    """The cell at the end: the cited sources in the order of their authors."""
    data = pybtex.database.BibliographyData(sources(language))
    made = STYLES[language]().format_bibliography(data, sorted(keys))
    lines = [f"- {entry.text.render(Backend('utf-8'))}" for entry in made]
    return text_cell("references", "\n".join([f"## {REFERENCES[language]}", "", *lines]))


# --- links ----------------------------------------------------------------------------------------


def lead_to_the_site(cells, place):
    """A link to what is not there leads to the site, if its address is known; else the words alone
    stay."""
    page = rf"[\1]({place.pages}/\2.html\3)" if place.pages else r"\1"
    notebook = rf"[\1]({place.pages}/notebooks/\2.html\3)" if place.pages else r"\1"
    file = rf"[\1]({place.files}/\2)" if place.files else r"\1"
    for cell in cells:
        if cell["cell_type"] == "markdown":
            cell["source"] = PAGE_LINK.sub(page, "".join(cell["source"]))
            if place.is_alone:
                cell["source"] = NOTEBOOK_LINK.sub(notebook, cell["source"])
                cell["source"] = DATA_LINK.sub(file, cell["source"])
