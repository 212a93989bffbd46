"""The main path as a reader walks it, passage by passage, and what stands there unexplained.

The head of book/terms.yml says the rule.
"""

import json
import re
import sys
from dataclasses import dataclass

from conftest import ROOT

sys.path[:0] = [str(ROOT / "book" / "_make"), str(ROOT / "book" / "_ext")]
import glossary  # noqa: E402
import lists  # noqa: E402
import notation  # noqa: E402, F401 (for the tests)
from texts import filter_markdown  # noqa: E402

INTRO, BEKAL = "book/intro.md", "book/bekal.md"
LINK = re.compile(r"\]\(([^)\s]+)\)")
LIST = re.compile(r"<!-- chapters: make lists -->.*?<!-- end -->", re.DOTALL)
IDEA = re.compile(r"^\(bekal-([\w-]+)\)=\n", re.MULTILINE)
CAPITALS = re.compile(r"\b[A-Z]{2,}\d*\b")
ENDINGS = {"en": "(?:s|es)?", "id": "(?:-?nya)?"}


@dataclass
class Passage:
    """What is read at one place: a cell, the words of a figure or exercise, a section."""

    place: str
    text: str
    announces: tuple = ()  # pages whose terms may be named here before they are explained

    @property
    def links(self):
        """Pages and anchors it links to, as book/terms.yml names them."""
        return {as_place(link) for link in LINK.findall(self.text)}


def as_place(link):
    """../book/bekal.md#bekal-rmse -> book/bekal.md#bekal-rmse; x.ipynb -> notebooks/x."""
    page, _, anchor = link.partition("#")
    name = page.rpartition("/")[2]
    folder = "notebooks/" if name.endswith(".ipynb") else "book/"
    page = folder + name.removesuffix(".ipynb")
    return f"{page}#{anchor}" if anchor else page


def prose(markdown):
    """The words alone: no code, mathematics, addresses; but the names of functions in it."""
    functions = r"\\operatorname\{(\w+)\}"
    code = r"```.*?```|(?:\{\w+\})?`[^`]*`|<[^>]*>"
    markdown = re.sub(code, " ", without_fences(markdown), flags=re.S)
    maths = r"\$\$.*?\$\$|\$[^$]*\$"
    markdown = re.sub(
        maths, lambda found: f" {' '.join(re.findall(functions, found[0]))} ", markdown, flags=re.S
    )
    return LINK.sub("", markdown).replace("[", "").replace("*", "")


def without_fences(markdown):
    """Directives lose their fences and options, not what they say."""
    markdown = re.sub(r"^:(?:width|figclass).*$", "", markdown, flags=re.MULTILINE)
    return re.sub(r"^(?:```\{figure\}.*|:::.*)$", "", markdown, flags=re.MULTILINE)


# --- the pages ----------------------------------------------------------------------------------


def deeper_pages(chapter):
    """The pages below a chapter."""
    _, parts = lists.contents()
    return [page for _, pages in parts for page in pages if page.startswith(chapter + "_")]


def notebook_passages(page, language):
    """Cells of prose and the words of code cells; a twin has the place of its English cell."""
    cells = json.loads((ROOT / f"{page}.ipynb").read_text(encoding="utf-8"))["cells"]
    found, twins = [], []
    for cell in cells:
        if cell["cell_type"] == "code":
            found.append(Passage(f"{page}#{cell['id']}", words_of(cell["metadata"], language)))
            continue
        twins.append(cell)
        if len(twins) == 2:
            indonesian, english = ("".join(twin["source"]) for twin in twins)
            text = {"id": indonesian, "en": english}[language]
            found.append(Passage(f"{page}#{cell['id']}", text))
            twins = []
    found[0].announces = (page, *deeper_pages(page))
    return [passage for passage in found if passage.text]


def words_of(metadata, language):
    """All texts in one language below metadata: captions, hints, solutions."""
    if isinstance(metadata, dict) and set(metadata) == {"id", "en"}:
        return metadata[language] + "\n\n"
    parts = list(metadata.values()) if isinstance(metadata, dict) else metadata
    if not isinstance(parts, list):
        return ""
    return "".join(words_of(part, language) for part in parts)


def intro_passages(language):
    text = filter_markdown((ROOT / INTRO).read_text(encoding="utf-8"), language)
    chapters = lists.chapters()
    pages = [page for chapter in chapters for page in (chapter, *deeper_pages(chapter))]
    parts = [Passage(INTRO, LIST.sub("", text))]
    if found := LIST.search(text):
        parts.append(Passage(INTRO + "#list", found[0], announces=tuple(pages)))
    return parts


def main_path(language):
    """The first page, then the chapters."""
    found = intro_passages(language)
    for chapter in lists.chapters():
        found += notebook_passages(chapter, language)
    return found


def ideas(language):
    """The ideas of book/bekal.md in the order of the page."""
    text = filter_markdown((ROOT / BEKAL).read_text(encoding="utf-8"), language)
    parts = IDEA.split(text)
    return [Passage(f"{BEKAL}#bekal-{name}", part) for name, part in zip(parts[1::2], parts[2::2])]


# --- the walk -----------------------------------------------------------------------------------


def words_for(term, language):
    """What stands for a term in a text."""
    words = term.get("words")
    if words == "everyday":
        return []
    if words:
        return words[language]
    name = re.sub(r"\*", "", term[language])
    return [part for part in re.split(r", | ?\(|\)", name) if part]


def pattern(term, language):
    """One expression for all words of a term, or None."""
    parts = [word_pattern(word, language) for word in words_for(term, language)]
    return re.compile("|".join(parts)) if parts else None


def word_pattern(word, language):
    flags = "-i" if re.fullmatch(r"[A-Z]{2,}\d*", word) else "i"
    ending = "" if word.endswith("!") else ENDINGS[language]
    flexible = r"\s+".join(re.escape(part) for part in word.rstrip("!").split())
    return rf"(?<!\w)(?{flags}:{flexible}){ending}(?!\w)"


def anchor_of(term):
    return f"{BEKAL}#bekal-{term['bekal']}" if "bekal" in term else None


def pages_of(term):
    """The pages that explain a term."""
    return {place.partition("#")[0] for place in glossary.places(term)}


def known_from(term, path):
    """The number of the passage from which on a reader knows a term; infinity if never."""
    places, anchor = glossary.places(term), anchor_of(term)
    for number, passage in enumerate(path):
        if passage.place in places or anchor in passage.links:
            return number
    return float("inf")


def announced(term, passage, path):
    """May the passage name what comes? Only if the pages it speaks of explain it."""
    if not passage.announces:
        return False
    if pages_of(term) & set(passage.announces):
        return True
    here = [other for other in path if other.place.partition("#")[0] in passage.announces]
    return any(anchor_of(term) in other.links for other in here)


def linked(term, passage):
    """Does the passage itself lead to the explanation, or to its page?"""
    own = passage.place.partition("#")[0]
    targets = {link.partition("#")[0] for link in passage.links if link.startswith("notebooks/")}
    targets |= {link for link in passage.links if link.startswith("book/")}
    pages = pages_of(term) | ({BEKAL} if "bekal" in term else set())
    return bool((pages - {own}) & targets)


def too_early(terms, path, language):
    """[(place, name)] of the passages of the main path that use a term before it is explained."""
    found = []
    for term in terms:
        search, known = pattern(term, language), known_from(term, path)
        for passage in path[: min(known, len(path))]:
            if search and search.search(prose(passage.text)):
                if not linked(term, passage) and not announced(term, passage, path):
                    found.append((passage.place, term[language]))
    return found


def too_early_in_ideas(terms, sections, path, language):
    """The same for book/bekal.md: an idea is read where the main path first links to it."""
    order = [section.place for section in sections]
    found = []
    for number, section in enumerate(sections):
        readers = (i for i, passage in enumerate(path) if section.place in passage.links)
        read = next(readers, len(path))
        for term in terms:
            search, anchor = pattern(term, language), anchor_of(term)
            above = anchor in order[: number + 1]
            if not above and read < known_from(term, path) and not linked(term, section):
                if search and search.search(prose(section.text)):
                    found.append((section.place, term[language]))
    return found


def texts_by_place(passages):
    """{place: its words}, for cells and for whole pages."""
    texts = {}
    for passage in passages:
        for place in (passage.place, passage.place.partition("#")[0]):
            texts[place] = texts.get(place, "") + prose(passage.text)
    return texts


def nowhere(terms, passages, language):
    """[(name, place)] of the terms whose place does not exist or does not hold them."""
    texts, found = texts_by_place(passages), []
    for term in terms:
        places = glossary.places(term) + ([anchor_of(term)] if "bekal" in term else [])
        search = pattern(term, language)
        lost = [place for place in places if place not in texts]
        empty = [p for p in places if p in texts and search and not search.search(texts[p])]
        found += [(term[language], place) for place in lost + empty or ([] if places else [None])]
    return found


def unknown_capitals(terms, names, passages):
    """{capitals: the first place} that neither a term nor a name explains."""
    listed = json.dumps([[term["en"], term["id"], term.get("words")] for term in terms])
    known = set(CAPITALS.findall(listed)) | {str(name) for name in names}
    found = {}
    for passage in passages:
        for capitals in CAPITALS.findall(prose(passage.text)):
            if capitals not in known:
                found.setdefault(capitals, passage.place)
    return found


def everything(language):
    """Every page of the book, for what may stand anywhere."""
    root, parts = lists.contents()
    found = intro_passages(language) + ideas(language)
    for page in (page for _, pages in parts for page in pages):
        if page.startswith("notebooks/"):
            found += notebook_passages(page, language)
        elif page + ".md" != BEKAL:
            text = (ROOT / f"{page}.md").read_text(encoding="utf-8")
            found.append(Passage(f"{page}.md", filter_markdown(text, language)))
    return found
