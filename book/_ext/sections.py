"""What the search of the book finds: every section of every page, with its place.

Sphinx finds pages and opens them at their top. A page here is long, so each of its sections is an
entry of its own: its anchor, its title, its prose, the names in its code, which are found but
never quoted, and the terms that it explains: what is set off from the text, and "(RTS)". What an
exercise hides (hints, solutions) is left out. book/_static/search.js searches in what is written
here, also from file://.
"""

import json
import re
from pathlib import Path

import bs4

FILE = "sections.js"
LEFT_OUT = (
    "script, style, template, kalman-explorer, table.explorer-facts, .headerlink, "
    ".exercise, .copybtn, .toctree-wrapper, .prev-next-area, img, summary, .eqno"
)
HEAVY = re.compile(r"<math\b.*?</math>|data:image/[^\"]*|<script\b.*?</script>", re.DOTALL)
CODE = "pre"
ABBREVIATION = re.compile(r"\(([A-Z]{2,})\)")
NAME = re.compile(r"[^\W\d]\w{2,}")
BLOCKS = "p, li, dt, dd, td, th, h1, h2, h3, h4, figcaption, div"


def sections_in(page, html):
    """[[page, anchor, title, titles above, prose, names in the code, terms], ...] of one page."""
    html = HEAVY.sub("", html)
    article = bs4.BeautifulSoup(html, "html.parser").select_one("article.bd-article")
    if article is None:
        return []
    for equation in article.find_all("span", class_="katex"):
        equation.replace_with(equation.get_text())  # its hundreds of parts would take seconds
    for part in article.select(LEFT_OUT):
        part.decompose()
    found = []
    for section in reversed(article.select("section[id]")):  # the innermost ones first
        heading = section.find(re.compile("^h[1-6]$"))
        if heading is None:
            continue
        above = [title_of(outer) for outer in section.find_parents("section")]
        title = plain(heading.extract())
        anchor = "" if not above else section["id"]
        names = names_in(section)
        marked = " ".join(plain(part) for part in section.find_all(["strong", "em"]))
        text = prose(section)
        terms = f"{marked} {' '.join(ABBREVIATION.findall(text))}".strip()
        found.append([page, anchor, title, [name for name in above[::-1] if name], text])
        found[-1] += [names, terms]
        section.decompose()
    return found[::-1]


def title_of(section):
    heading = section.find(re.compile("^h[1-6]$"), recursive=False)
    return plain(heading) if heading else ""


def names_in(section):
    """The names in the code of a section; its code is gone then."""
    names = {}
    for code in section.select(CODE):
        lines = [line for line in code.get_text().splitlines() if not is_import(line)]
        names.update(dict.fromkeys(NAME.findall("\n".join(lines))))
        code.decompose()
    return " ".join(names)


def is_import(line):
    return re.match(r"\s*(from|import)\s", line) is not None


def prose(section):
    for block in section.select(BLOCKS):
        block.append(" ")
    return plain(section)


def plain(element):
    return " ".join(element.get_text().split())


def write(app, exception):
    """All pages as they lie there, also those that this build did not touch."""
    if exception is not None or app.builder.name != "html":
        return
    folder = Path(app.outdir)
    found = []
    for page in sorted(app.env.found_docs):
        path = folder / f"{page}.html"
        if path.exists():
            found += sections_in(page, path.read_text(encoding="utf-8"))
    text = json.dumps(found, ensure_ascii=False, separators=(",", ":"))
    (folder / "_static" / FILE).write_text(f"var bookSections = {text};\n", encoding="utf-8")


def load(app, pagename, templatename, context, doctree):
    if pagename == "search":
        app.add_js_file(FILE)
        app.add_js_file("search.js")


def setup(app):
    app.connect("html-page-context", load)
    app.connect("build-finished", write)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
