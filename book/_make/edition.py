"""Title, authors, version and date of this edition: they stand in _config.yml, and everything else
takes them from there.

Who adopts the book changes _config.yml alone and calls `make lists`, which writes them into the
files below; pages and site take them while they are built.
"""

import re

import yaml
from first_cell import wheel_name
from places import ROOT
from settings import about_edition, settings

QUOTED = r'"[^"]*"'
UNFIT = re.compile(r'["\\{}]')  # the title stands in programs and in BibTeX, too


def edition():
    """{title: {id, en}, authors: [names], address, repository, version, date}"""
    title = str(settings()["title"])
    author = str(settings()["author"] or "")
    titles = title.split(" | ")  # one title serves both languages
    if len(titles) > 2 or UNFIT.search(title + author):
        raise SystemExit(
            '_config.yml: one title, or two with " | " between them; title and author hold no '
            'straight quotation mark ("), backslash or brace. Write “ ” instead.'
        )
    names = author.split(";" if ";" in author else ",")
    authors = [name.strip() for name in names if name.strip()]
    return {**about_edition(), "title": {"id": titles[0], "en": titles[-1]}, "authors": authors}


def written(about):
    """{path: [(what stands there, what should)]}; each must be found."""
    title = about["title"]
    both = f"{title['id']} / {title['en']}"
    first = (r"\A# .*", f"# {title['id']} · {title['en']}")
    return {
        "README.md": [first],
        "book/intro.md": [heading("id", title), heading("en", title)],
        "book/about.md": [*quotation("id", about), *quotation("en", about)],
        "book/use.md": [(r"kalman_lib-[^-\s]+-py3-none-any\.whl", wheel_name(about["version"]))],
        "LICENSE": [copyright_of(about, both)],
        "pyproject.toml": [
            (r'^version = ".*', f'version = "{about["version"]}"'),
            (r'^description = ".*', f'description = "The small helper package of the book {both}"'),
        ],
        "kalman_lib/data/workbook_words.py": [(f"CREATOR = {QUOTED}", f'CREATOR = "{both}"')],
        "book/explorers/files/xlsx.js": [(f"AUTHOR = {QUOTED}", f'AUTHOR = "{both}"')],
    }


def copyright_of(about, both):
    """The first authors keep their line, as the licence asks; others get one below it."""
    holder = ", ".join(about["authors"]) or f'The authors of "{both}"'
    first = re.search(r"Copyright \(c\) \d{4} (.*)", (ROOT / "LICENSE").read_text(encoding="utf-8"))
    own = "" if holder == first[1] else f"\nCopyright (c) {about['date'][:4]} {holder}"
    return r"(\A(?:(?!Copyright).*\n)*Copyright .*)(?:\nCopyright .*)?", rf"\g<1>{own}"


def heading(language, title):
    """The first heading of the half of a page in this language."""
    mark = rf'(\+\+\+ {{"tags": \["lang-{language}"\]}}\n\n)# .*'
    return mark, rf"\g<1># {title[language]}"


def quotation(language, about):
    """How the page about the book tells to cite it."""
    mark = rf'(lang-{language}"\]}}(?:(?!lang-)[\s\S])*?'
    year, number = about["date"][:4], about["version"]
    author = " and ".join(about["authors"]) or f"{{{about['title'][language]}}}"
    return [
        (mark + r"title   = \{)[^}]*", rf"\g<1>{about['title'][language]}"),
        (mark + r"author  = )\{.*\},", rf"\g<1>{{{author}}},"),
        (mark + r"year    = \{)[^}]*", rf"\g<1>{year}"),
        (mark + r"edition = \{)[^}]*", rf"\g<1>{number}"),
    ]


def citation(about):
    """CITATION.cff: the repository is software, what is cited is the book."""
    both = f"{about['title']['id']} / {about['title']['en']}"
    names = about["authors"] or [f"The authors of {about['title']['en']}"]
    authors = [{"name": name} for name in names]
    links = {}
    if about["address"]:
        links["url"] = about["address"]
    if about["repository"]:
        links["repository-code"] = about["repository"]
    book = {
        "type": "book",
        "title": both,
        "authors": [dict(author) for author in authors],  # no reference in the YAML
        "year": int(about["date"][:4]),
        "edition": about["version"],
        **({"url": about["address"]} if about["address"] else {}),
    }
    content = {
        "cff-version": "1.2.0",
        "message": "If you use this book in teaching or research, please cite it as below.",
        "title": both,
        "type": "software",
        "version": about["version"],
        "date-released": about["date"],
        "license": ["MIT", "CC-BY-4.0"],
        **links,
        "authors": authors,
        "preferred-citation": book,
    }
    return yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=120)


def texts():
    """{path: its text as it should be}"""
    about = edition()
    found = {ROOT / "CITATION.cff": citation(about)}
    for name, changes in written(about).items():
        text = (ROOT / name).read_text(encoding="utf-8")
        for pattern, wanted in changes:
            text, count = re.subn(pattern, wanted, text, flags=re.MULTILINE)
            if not count:
                raise SystemExit(f"{name}: nothing fits {pattern}")
        found[ROOT / name] = text
    return found
