"""Puts the finished pages of both languages into _build/site, with what readers take home."""

import io
import re
import shutil
import zipfile

import embeds
import found
import kept
import launch
import licences
import light
import mend
import older
import policy
import slides
import steady
import texts
import yaml
from downloads import notebooks_in
from edition import edition
from first_cell import in_archive
from pages import change_all, text_of_all
from places import BUILD, LITE, ROOT, SITE
from wheel import write_wheel

ZIP_NAMES = {"id": "filter-kalman", "en": "kalman-filter"}
ZIPPED_FOLDERS = ("notebooks/data", "kalman_lib")
ZIPPED_FILES = ("requirements.txt", "pyproject.toml", "LICENSE")
DATA = ROOT / "notebooks" / "data"
PDFS = BUILD / "pdf"
PDF_LINK = re.compile(r'\s*· <a class="whole-pdf"[^>]*>[^<]*</a>')
NOT_FOR_READERS = (
    "*.map",
    "*.ttf",
    "*.LICENSE.txt",
    "*webpack-macros.html",
    "bootstrap.js",
    "fontawesome.js",
    ".buildinfo*",
    "reports",
    "objects.inv",
    "fontawesome",
    "_downloads",
)


def assemble(outputs):
    """outputs: {language: folder of its pages}."""
    toc = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))
    page = f"{toc['root']}.html"
    shutil.rmtree(SITE, ignore_errors=True)
    wheel = write_wheel()
    for language, output in outputs.items():
        folder = SITE / language
        shutil.copytree(output, folder, ignore=shutil.ignore_patterns(*NOT_FOR_READERS))
        finish_pages(folder, language)
        lay_downloads(folder, language, wheel)
        kept.write_language(language, page)
    choose = kept.filled("choose.html", page=page, **edition()["title"])
    (SITE / "index.html").write_text(policy.with_policy(choose), encoding="utf-8")
    kept.write_root(page)
    if LITE.exists():
        shutil.copytree(LITE, SITE / "lite")
    found.write_found(page)
    policy.write_headers()
    licences.write_licences(outputs["en"])


def finish_pages(folder, language):
    """What is mended, added or made from the pages of one language, in this order."""
    remove_old_pictures(folder)
    mend.mend(folder, language)
    launch.add_links(folder, language)
    older.lead_to_newest(folder, language)
    policy.take_out_scripts(folder)
    embeds.show_lines(folder, language)
    sheet = embeds.sheet_of(folder)
    light.lighten(folder)
    slides.write_slides(language)
    embeds.write_embeds(language, sheet)
    policy.write_policy(folder)


def lay_downloads(folder, language, wheel):
    """What readers of one language take home."""
    take_pdf(folder, f"{ZIP_NAMES[language]}.pdf")
    write_workbook(folder / "kalman.xlsx")
    shutil.copy(wheel, folder)
    shutil.copytree(DATA, folder / "_sources" / "notebooks" / "data")  # notebooks ask for it
    write_zip(language, folder / f"{ZIP_NAMES[language]}.zip", wheel)


def built_pages():
    """What the last build made: {language: folder of its pages}."""
    return {language: BUILD / "work" / language / "_build" / "html" for language in ZIP_NAMES}


def take_pdf(folder, name):
    """The PDF of this build (make pdf), or no link to it."""
    made = PDFS / name
    if made.exists():
        shutil.copy(made, folder / name)
    else:
        change_all(folder, lambda page, text: PDF_LINK.sub("", text))


def remove_old_pictures(folder):
    """No picture stays that an older build has left."""
    shown = text_of_all(folder)
    for picture in (folder / "_images").glob("*"):
        if picture.name not in shown:
            picture.unlink()


def write_workbook(path):
    """The workbook that chapter 2 offers: the paper's table, as in its own cell."""
    from kalman_lib import data
    from kalman_lib.papers import smoother

    made = io.BytesIO()
    data.write_workbook(made, smoother.MEASURED, Q=1e-5, R=1e-5, x0=0, P0=1)
    path.write_bytes(steady.without_the_minute(made.getvalue()))


def write_zip(language, path, wheel):
    """What a reader needs to run the chapters.

    That is the notebooks in one language, their data, kalman_lib and the requirements; and the
    wheel beside the notebooks, for whoever opens one with a Python of his own.
    """
    top = path.stem
    with zipfile.ZipFile(path, "w") as archive:
        steady.add(archive, f"{top}/README.md", readme(language))
        for file in zipped_files():
            steady.add(archive, f"{top}/{file.relative_to(ROOT).as_posix()}", file.read_bytes())
        lock = without_hashes(ROOT / "requirements.lock")
        steady.add(archive, f"{top}/requirements.lock", lock)
        steady.add(archive, f"{top}/notebooks/{wheel.name}", wheel.read_bytes())
        workbook = path.parent / "kalman.xlsx"  # chapter 2 links to it
        steady.add(archive, f"{top}/kalman.xlsx", workbook.read_bytes())
        whole = path.with_suffix(".pdf")
        if whole.exists():
            steady.add(archive, f"{top}/{whole.name}", whole.read_bytes())
        place = in_archive(edition(), language)
        for name, text in notebooks_in(language, edition()["version"], place):
            steady.add(archive, f"{top}/notebooks/{name}", text)


def readme(language):
    """What the archive is and how it runs, from the lines of this language."""
    about = edition()
    values = {**about, "title": about["title"][language]}
    wanted = {name: values[name] for name in ("title", "version", "date")}
    lines = kept.filled("zip-readme.md", **wanted).splitlines()
    other = texts.OTHER[language]
    mine = [line.removeprefix(f"{language}: ") for line in lines if line[:4] != f"{other}: "]
    return "\n".join(mine) + "\n"


def without_hashes(lock):
    """The versions of a lock: beside hashes pip would refuse the folder of the package."""
    lines = lock.read_text(encoding="utf-8").splitlines()
    return "\n".join(line.removesuffix(" \\") for line in lines if "--hash" not in line) + "\n"


def zipped_files():
    found = []
    for folder in ZIPPED_FOLDERS:
        found += sorted((ROOT / folder).rglob("*"))
    found += [ROOT / name for name in ZIPPED_FILES]
    return [file for file in found if file.is_file() and "__pycache__" not in file.parts]
