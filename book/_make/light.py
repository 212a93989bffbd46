"""Makes the finished pages of one language light: what a phone with a poor connection has to fetch.

One style sheet instead of twelve, without the rules and files that no page uses; fonts with the
letters and weights of this book; pictures in the smaller of two formats.
"""

import base64
import hashlib
import html
import io
import json
import re
import subprocess
from pathlib import Path

import offline
from fontTools import subset
from fontTools.ttLib import TTFont
from fontTools.varLib import instancer
from pages import change_all, pages_of, text_of_all, version, way_up
from PIL import Image
from policy import START

SHEET = "_static/all.css"
LINK = re.compile(r'\s*<link\b[^>]*\brel="stylesheet"[^>]*>')
ADDRESS = re.compile(r'href="([^"?]+)[^"]*"')
INSIDE = re.compile(r'src="data:image/png;base64,([^"]+)"')
STILL = re.compile(r"(<kalman-explorer[^>]*>\s*)<img ([^>]*)>")
TAG = re.compile(r"<[^>]+>")
WORKS_ON = {  # script: what the pages hold that it works on
    "design-tabs.js": 'class="sd-tab',
    "clipboard.min.js": '<div class="highlight',
    "copybutton.js": '<div class="highlight',
    "togglebutton.js": 'class="toggle',
}
STOPPING = re.compile(r'\s*<script src="([^"]*)"></script>')
REGULAR = 400
WEIGHTS = (REGULAR, 700)  # of upright letters; bold italic ones are rare: the browser makes them
WRITTEN = re.compile(r'<span class="([^"]*)"[^>]*>([^<]+)')
RARE = {  # fonts for a few letters of equations: the classes of these letters
    "KaTeX_SansSerif": {"mathsf", "textsf"},
    "KaTeX_Caligraphic": {"mathcal"},
}
UNUSED = (
    "_static/locales",
    "_static/images",
)  # of the theme, for other languages and launch buttons


def lighten(folder):
    remove_unused(folder)
    take_out_pictures(folder)
    shrink_pictures(folder)
    one_sheet(folder)
    remove_unused_scripts(folder)
    let_text_come_first(folder)
    shrink_fonts(folder)


# --- files and pictures -------------------------------------------------------------------------


def remove_unused(folder):
    """What the theme brings and no page of this book shows."""
    text = text_of_all(folder)
    for name in UNUSED:
        for path in sorted((folder / name).rglob("*")):
            if path.is_file() and path.name not in text:
                path.unlink()


def take_out_pictures(folder):
    """A picture inside a page, such as the still one of an explorer, becomes a file: a reader whose
    explorer lives never fetches it."""

    def change(page, text):
        def taken_out(found):
            content = base64.b64decode(found[1])
            name = f"_images/{hashlib.sha256(content).hexdigest()}.png"
            (folder / name).write_bytes(content)
            return f'src="{way_up(folder, page)}{name}"'

        return STILL.sub(fetched_when_seen, INSIDE.sub(taken_out, text))

    change_all(folder, change)


def fetched_when_seen(found):
    picture = found[2] if "loading=" in found[2] else f'loading="lazy" {found[2]}'
    return f"{found[1]}<img {picture}>"


def shrink_pictures(folder):
    """A picture as WebP, without loss, where that is smaller; pages then show that one."""
    renamed = {}
    pictures = [*(folder / "_images").glob("*.png"), *(folder / "_static/vendor").glob("*.png")]
    for picture in sorted(pictures):
        made = io.BytesIO()
        Image.open(picture).save(made, "WEBP", lossless=True, method=4)
        if made.tell() < picture.stat().st_size:
            picture.with_suffix(".webp").write_bytes(made.getvalue())
            picture.unlink()
            renamed[f"/{picture.name}"] = f"/{picture.stem}.webp"
    name = re.compile("|".join(map(re.escape, renamed)) or r"(?!)")
    change_all(folder, lambda page, text: name.sub(lambda found: renamed[found[0]], text))


# --- style sheets -------------------------------------------------------------------------------


def one_sheet(folder):
    """Purge and join the style sheets, and link every page to the result."""
    texts = {page: page.read_text(encoding="utf-8") for page in pages_of(folder)}
    used = {page: sheets_of(folder, page, text) for page, text in texts.items()}
    sheets = in_order(used.values())
    (folder / SHEET).write_text(purged(folder, sheets), encoding="utf-8")
    here = version(folder / SHEET)
    for page, text in texts.items():
        if used[page]:
            address = f"{way_up(folder, page)}{SHEET}?v={here}"
            link = f'\n    <link rel="stylesheet" href="{address}">'
            first = LINK.search(text)
            rest = LINK.sub("", text[first.end() :])
            page.write_text(text[: first.start()] + link + rest, encoding="utf-8")
    for sheet in (folder / "_static").rglob("*.css"):
        if sheet != folder / SHEET:
            sheet.unlink()


def sheets_of(folder, page, text):
    """The style sheets of a page, from the folder of the language, in their order."""
    addresses = [ADDRESS.search(link)[1] for link in LINK.findall(text)]
    return [(page.parent / name).resolve().relative_to(folder).as_posix() for name in addresses]


def in_order(lists):
    """All sheets in an order that every page agrees with."""
    longest = max(lists, key=len)
    for sheets in lists:
        rest = iter(longest)
        if not all(sheet in rest for sheet in sheets):
            raise SystemExit(f"The style sheets stand in two orders: {sheets} and {longest}.")
    return longest


def purged(folder, sheets, shown=None):
    """One sheet, with the rules for what is shown: all pages and scripts, or these patterns."""
    shown = shown or [f"{folder}/**/*.html", f"{folder}/_static/**/*.js"]
    program = Path(__file__).with_name("light.mjs")
    made = subprocess.run(
        [str(offline.node_binary()), str(program)],
        input=json.dumps({"folder": str(folder), "sheets": sheets, "shown": shown}),
        capture_output=True,
        encoding="utf-8",
    )
    if made.returncode != 0:
        raise SystemExit(made.stderr.strip())
    return made.stdout


# --- scripts ------------------------------------------------------------------------------------


def remove_unused_scripts(folder):
    """An extension of Sphinx brings its script to every page; here only to those it works on."""

    def change(page, text):
        for script, sign in WORKS_ON.items():
            if sign not in text:
                text = re.sub(rf"\s*<script[^>]*/{script}[^>]*></script>", "", text)
        return text

    change_all(folder, change)


def let_text_come_first(folder):
    """Scripts of the head that stop the page run at its end, in their order, and are all fetched at
    once: one after the other they keep a slow phone from its text for seconds, as a browser that
    meets a policy in a page does not look ahead. The one that chooses the theme stays, behind the
    style sheet, beside which it is fetched."""

    def change(page, text):
        head, end, body = text.partition("</head>")
        scripts = STOPPING.findall(head)
        theme = "".join(tag_of(script) for script in scripts if START in script)
        later = [script for script in scripts if START not in script]
        head = LINK.sub(lambda sheet: sheet[0] + theme, STOPPING.sub("", head), count=1)
        for script in later:
            head += f'\n    <link rel="preload" as="script" href="{script}">'
        return head + end + body.replace("</body>", "".join(map(tag_of, later)) + "\n</body>")

    def tag_of(script):
        return f'\n    <script src="{script}"></script>'

    change_all(folder, change)


# --- fonts --------------------------------------------------------------------------------------


def shrink_fonts(folder):
    """Only the letters that pages and scripts hold, only the weights that are used; a font that the
    style sheet does not name goes. A letter that only a reader types comes from his own fonts."""
    css = (folder / SHEET).read_text(encoding="utf-8")
    letters, rare = letters_of(folder), rare_letters_of(folder)
    for path in sorted((folder / "_static").rglob("*.woff2")):
        if path.name in css:
            shrink_font(path, rare.get(path.name.partition("-")[0], letters))
        else:
            path.unlink()


def letters_of(folder):
    shown = set(html.unescape(TAG.sub("", text_of_all(folder))))
    for script in (folder / "_static").rglob("*.js"):
        shown |= set(script.read_text(encoding="utf-8"))
    return sorted(map(ord, shown))


def rare_letters_of(folder):
    """{font: the letters that the equations of all pages take from it}"""
    used = {font: set() for font in RARE}
    for classes, text in WRITTEN.findall(text_of_all(folder)):
        for font, kinds in RARE.items():
            if kinds & set(classes.split()):
                used[font] |= set(html.unescape(text))
    return {font: sorted(map(ord, letters)) for font, letters in used.items()}


def shrink_font(path, letters):
    font = TTFont(path, recalcTimestamp=False)  # the same letters, the same file
    if "fvar" in font:
        weights = REGULAR if "italic" in path.name else WEIGHTS
        font = instancer.instantiateVariableFont(font, {"wght": weights})
        font = written_and_read(font)  # what it varies by refers to letters that are there
    subsetter = subset.Subsetter()
    subsetter.populate(unicodes=letters)
    subsetter.subset(font)
    font.flavor = "woff2"
    font.save(path)


def written_and_read(font):
    stored = io.BytesIO()
    font.flavor = None
    font.save(stored)
    stored.seek(0)
    return TTFont(stored, recalcTimestamp=False)
