"""What lets the site stay on a reader's device: the workers that keep it, its manifest, its icons.

The site may lie in any folder of a host, so every address here is relative.
"""

import hashlib
import json

from edition import edition
from places import ROOT, SITE
from policy import with_policy

PAGES = {".html", ".css", ".js", ".png", ".svg", ".webp", ".ico", ".woff2", ".webmanifest"}
DOWNLOADS = {".xlsx", ".ipynb", ".md", ".pdf", ".whl", ".zip"}  # kept last
WORKER = "offline-worker.js"
CHOOSE = "choose.js"  # of index.html
UNKEPT = "unkept.html"  # the page for a language that was never opened
PAPER = "#fdfcf9"
ACCENT = "#0f6b6b"
ICON_SIZES = (192, 512)  # pixels, what browsers ask for


def filled(name, **values):
    """A template of the site with its values in the places of {{ name }}."""
    text = (ROOT / "book" / "_templates" / name).read_text(encoding="utf-8")
    for key, value in values.items():
        text = text.replace("{{ " + key + " }}", value)
    return text


def plain_page(name, **values):
    """A page that speaks both languages: its title and its text in the common frame."""
    title, text = filled(name, **values).split("\n", 1)
    indonesian, english = title.split(" | ")
    return with_policy(filled("plain.html", id=indonesian, en=english, text=text.rstrip()))


def write_language(language, page):
    """Everything of one language, when its folder is complete; page: where it begins."""
    folder = SITE / language
    write_icons(folder)
    write_manifest(language, page)
    write_worker(folder, files_in(folder), None)


def write_root(page):
    """The folder above both: the page that chooses a language, and the one that says what is
    missing."""
    (SITE / UNKEPT).write_text(plain_page(UNKEPT, page=page), encoding="utf-8")
    (SITE / CHOOSE).write_text(filled(CHOOSE), encoding="utf-8")
    write_worker(SITE, [SITE / "index.html", SITE / CHOOSE, SITE / UNKEPT], UNKEPT)


def files_in(folder):
    """The files of one language: pages and what they show first, then downloads, the small ones
    first."""
    files = [path for path in sorted(folder.rglob("*")) if path.is_file() and path.name != WORKER]
    pages = [path for path in files if path.suffix in PAGES]
    downloads = [path for path in files if path.suffix in DOWNLOADS]
    return pages + sorted(downloads, key=lambda path: path.stat().st_size)


def write_worker(folder, files, otherwise):
    """Its list says what each file holds, so a new version fetches only what has changed."""
    listed = {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()[:12]
        for path in files
    }
    script = filled(WORKER, files=json.dumps(listed), otherwise=json.dumps(otherwise))
    version = hashlib.sha256(script.encode()).hexdigest()[:12]
    (folder / WORKER).write_text(script.replace("{{ version }}", version), encoding="utf-8")


def write_manifest(language, page):
    """What a phone asks before it puts the book among its apps."""
    name = edition()["title"][language]
    icons = [
        {"src": f"icon-{size}.png", "sizes": f"{size}x{size}", "type": "image/png"}
        for size in ICON_SIZES
    ]
    manifest = {
        "name": name,
        "short_name": name.split(",")[0],
        "lang": language,
        "start_url": page,
        "scope": "./",
        "display": "minimal-ui",
        "background_color": PAPER,
        "theme_color": ACCENT,
        "icons": icons + [{**icons[-1], "purpose": "maskable"}],
    }
    text = json.dumps(manifest, indent=1, ensure_ascii=False)
    (SITE / language / "manifest.webmanifest").write_text(text, encoding="utf-8")


def write_icons(folder):
    """The mark of the book: a wave on the colour of the accent (the same as in layout.html)."""
    import numpy as np
    from matplotlib.figure import Figure

    for size in ICON_SIZES:
        figure = Figure(figsize=(size / 100, size / 100), dpi=100, facecolor=ACCENT)
        axes = figure.add_axes([0, 0, 1, 1])
        axes.set_axis_off()
        axes.set(xlim=(0, 32), ylim=(32, 0))
        x = np.linspace(7, 25, 100)
        y = 17.5 - 0.3 * (x - 16) - 4 * np.sin((x - 13) / 2.4)
        axes.plot(x, y, color="white", linewidth=size / 13, solid_capstyle="round")
        figure.savefig(folder / f"icon-{size}.png")
