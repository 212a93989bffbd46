"""A bare page for every explorer, embed/<paper>.html or embed/<paper>.<view>.html of each language:
the explorer alone, for a frame on somebody else's page (a course in Moodle, a blog).

The explorers are found in the finished pages of the book, so a new one gets its bare page, and its
line on the page for lecturers, by itself. Such a page loads the core and one paper, keeps nothing
on the device, and tells search engines that its chapter is the original.
"""

import html
import json
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

import explorers
import light
from edition import edition
from kept import filled
from lists import contents
from pages import version
from places import ROOT, SITE

SOURCE = ROOT / "book" / "embed"
LINES = '<div class="embed-lines"></div>'  # of book/teaching.md: here the lines for lecturers go
PLACEHOLDER = {"id": "https://ALAMAT-BUKU", "en": "https://BOOK-ADDRESS"}  # of an unknown site
SHEETS = ("_static/book.css", "_static/vendor/explorers/core.css")
HEIGHT = 640  # pixels of the frame: a phone shows all of it
EXPLORER = re.compile(r"<kalman-explorer\b[^>]*>\s*(<img [^>]*>)?")
HEADING = re.compile(r"<h1>(.*?)(?:<a class=\"headerlink|</h1>)", re.DOTALL)
SCRIPT = re.compile(r'src="\.\./(_static/vendor/explorers/(\w+)\.js[^"]*)"')
ICON = re.compile(r'<link rel="icon"[^>]*>')
TAG = re.compile(r"<[^>]+>")
WORDS = {
    "id": {
        "from": "Dari buku",
        "all": "Satu baris untuk setiap gambar",
        "unknown": "Gantilah {placeholder} dengan alamat situs buku ini.",
    },
    "en": {
        "from": "From the book",
        "all": "One line for each figure",
        "unknown": "Put the address of this book's site in the place of {placeholder}.",
    },
}


@dataclass(frozen=True)
class Embed:
    """An explorer of a page of the book."""

    paper: str
    view: str | None  # None: the first one
    name: str
    page: str  # such as notebooks/03_gyro
    still: str  # its picture for who has no script

    @property
    def key(self):
        """How the address behind # calls it."""
        return f"{self.paper}.{self.view}" if self.view else self.paper


def names():
    """{paper: {view: {id, en}}}, the first view first."""
    return json.loads((explorers.FOR_NOTEBOOKS / "names.json").read_text(encoding="utf-8"))


def embeds_in(folder, language):
    """{key: its embed}, in the order of the book; a page that comes first is its home."""
    root, parts = contents()
    found = {}
    for page in [root, *(page for _, pages in parts for page in pages)]:
        path = folder / f"{page}.html"
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        stills = [match[1] or "" for match in EXPLORER.finditer(text)]
        for (paper, view), still in zip(explorers.shown_in(text), stills):
            views = names()[paper]
            name = views[view or next(iter(views))][language]
            embed = Embed(paper, view, name, page, still)
            found.setdefault(embed.key, embed)
    return found


# --- the pages ----------------------------------------------------------------------------------


def sheet_of(folder):
    """Their style sheet, from those of the book and the explorers, as long as these lie there."""
    looks = Path(shutil.copy(SOURCE / "looks.css", folder / "_static"))
    shown = [
        f"{ROOT}/book/_templates/embed.html",
        f"{SOURCE}/embed.js",
        f"{folder}/_static/vendor/explorers/*.js",
    ]
    css = light.purged(folder, [*SHEETS, "_static/looks.css"], shown)
    looks.unlink()
    return css


def write_embeds(language, css):
    """The bare pages of one language, when its pages are light; css: what sheet_of has made."""
    folder = SITE / language
    (folder / "embed").mkdir(exist_ok=True)
    (folder / "_static" / "embed.css").write_text(css, encoding="utf-8")
    shutil.copy(SOURCE / "embed.js", folder / "_static")
    versions = {kind: version(folder / "_static" / f"embed.{kind}") for kind in ("css", "js")}
    for embed in embeds_in(folder, language).values():
        page = (folder / f"{embed.page}.html").read_text(encoding="utf-8")
        text = page_of(embed, page, language, versions)
        (folder / "embed" / f"{embed.key}.html").write_text(text, encoding="utf-8")


def page_of(embed, page, language, versions):
    """page: the text of the page of the book that shows it; versions: {css, js}."""
    wanted = explorers.scripts([embed.paper])
    scripts = {name: address for address, name in SCRIPT.findall(page)}
    book = html.escape(edition()["title"][language])
    title = plain(HEADING.search(page)[1])
    before = "" if title == book else f"{book}: "
    view = f' view="{embed.view}"' if embed.view else ""
    return filled(
        "embed.html",
        **versions,
        language=language,
        figure=html.escape(embed.name),
        book=book,
        original=original(embed, language),
        icon=ICON.search(page)[0],
        scripts="\n  ".join(f'<script defer src="../{scripts[name]}"></script>' for name in wanted),
        explorer=f'<kalman-explorer paper="{embed.paper}"{view}>',
        still=embed.still,
        source=f"{WORDS[language]['from']} {before}",
        page=f"{embed.page}.html#{embed.key}:",
        title=title,
    )


def original(embed, language):
    """The address of the chapter, where that of the site is known, else the way there."""
    address = edition()["address"].rstrip("/")
    return f"{address}/{language}/{embed.page}.html" if address else f"../{embed.page}.html"


def plain(markup):
    return " ".join(TAG.sub("", markup).split())


# --- the lines for lecturers --------------------------------------------------------------------


def show_lines(folder, language):
    """The line of HTML for every explorer on the page that asks for them."""
    path = folder / "book" / "teaching.html"
    text = path.read_text(encoding="utf-8")
    if LINES not in text:
        raise SystemExit(f"book/teaching.md has no {LINES}")
    address = edition()["address"].rstrip("/")
    items = "".join(
        f'<p><a href="../embed/{embed.key}.html">{html.escape(embed.name)}</a></p>'
        '<div class="highlight-html notranslate"><div class="highlight"><pre>'
        f"{html.escape(line(embed, language, address), quote=False)}</pre></div></div>"
        for embed in embeds_in(folder, language).values()
    )
    summary = f"<summary>{WORDS[language]['all']}</summary>"
    unknown = "" if address else address_unknown(language)
    made = f'<details class="embed-lines">{summary}{unknown}{items}</details>'
    path.write_text(text.replace(LINES, made), encoding="utf-8")


def address_unknown(language):
    """What is to be done about the placeholder; book.js puts the page's own address there."""
    placeholder = PLACEHOLDER[language]
    words = WORDS[language]["unknown"].format(placeholder=f"<code>{placeholder}</code>")
    return f'<p class="embed-unknown" data-placeholder="{placeholder}">{words}</p>'


def line(embed, language, address):
    """What a lecturer pastes into a page of a course."""
    root = address or PLACEHOLDER[language]
    allowed = "clipboard-write"  # the button that copies a link
    if explorers.listens(embed.paper):
        allowed = f"accelerometer; gyroscope; magnetometer; {allowed}"
    return (
        f'<iframe src="{root}/{language}/embed/{embed.key}.html" title="{html.escape(embed.name)}"'
        f' loading="lazy" allow="{allowed}" width="100%" height="{HEIGHT}"'
        ' style="border: 0"></iframe>'
    )
