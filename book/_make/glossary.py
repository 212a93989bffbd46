"""book/glossary.md out of book/terms.yml: a term, its other name, its meaning, its place.

lists.py writes it (make lists). The head of book/terms.yml says what its entries hold.
"""

import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "book" / "_ext"))
from texts import OTHER, headings, source_in  # noqa: E402

TERMS = ROOT / "book" / "terms.yml"
WORDS = {
    "id": {
        "see": "Lihat",
        "and": "dan",
        "bekal": "Bekal",
        "chapter": "bab {}",
        "deeper": "bab {}, lebih dalam",
        "seen": "Dalam sumber",
    },
    "en": {
        "see": "See",
        "and": "and",
        "bekal": "What we need",
        "chapter": "chapter {}",
        "deeper": "chapter {}, deeper",
        "seen": "In the sources",
    },
}


def read(path=TERMS):
    """book/terms.yml: {"terms": [...], "names": [...]}."""
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def places(term):
    """The cells and pages that explain a term: `explained` is one or a list."""
    explained = term.get("explained", [])
    return explained if isinstance(explained, list) else [explained]


def glossary(language, chapters):
    """The entries of the page in one language, in the order of its alphabet."""
    terms = sorted(read()["terms"], key=lambda term: plain(term[language]).casefold())
    return "\n" + "\n".join(entry(term, language, chapters) for term in terms)


def plain(name):
    """Without the stars of italics: they stand in italics already."""
    return name.replace("*", "")


def entry(term, language, chapters):
    other = plain(term[OTHER[language]])
    said = f": *{other}*. {term['means'][language]}"
    links = [bekal_link(term, language)]
    links += [place_link(place, language, chapters) for place in places(term)]
    links = [link for link in links if link]
    words = WORDS[language]
    if links:
        between = f" {words['and']} "
        said += f" {words['see']} {between.join(links)}."
    if "seen" in term:
        said += f" {words['seen']}: {term['seen']}."
    return f"{term[language]}\n{said}\n"


def bekal_link(term, language):
    """The idea of book/bekal.md that explains a term."""
    if "bekal" not in term:
        return ""
    return f"[{WORDS[language]['bekal']}](bekal.md#bekal-{term['bekal']})"


def place_link(place, language, chapters):
    """The chapter, its deeper page or another page that explains a term."""
    page = place.partition("#")[0]
    if page == "book/intro.md":
        return ""
    if page.startswith("book/"):
        path = ROOT / page
        name = headings(source_in(path.read_text(encoding="utf-8"), path, language))[0]
        return f"[{name}]({path.name})"
    chapter = next(chapter for chapter in chapters if page.startswith(chapter))
    kind = "chapter" if page == chapter else "deeper"
    name = WORDS[language][kind].format(chapters.index(chapter) + 1)
    return f"[{name}](../{page}.ipynb)"
