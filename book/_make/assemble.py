"""Puts the finished pages of both languages into _build/site, with what readers take home."""

import json
import shutil
import zipfile

import texts
import yaml
from places import ROOT, SITE

ZIP_NAMES = {"id": "filter-kalman", "en": "kalman-filter"}
ZIPPED_FOLDERS = ("notebooks/data", "kalman_lib")
ZIPPED_FILES = ("requirements.txt", "requirements.lock", "pyproject.toml", "LICENSE")
KEPT_OFFLINE = {".html", ".css", ".js", ".png", ".svg", ".ico", ".woff2"}
NOT_FOR_READERS = (
    "*.map",
    "*.ttf",
    "*.LICENSE.txt",
    "*webpack-macros.html",
    "fontawesome.js",
    ".buildinfo*",
    "reports",
    "objects.inv",
    "fontawesome",
)


def assemble(outputs, version):
    """outputs: {language: folder of its pages}; version: what tells this site from an older one."""
    shutil.rmtree(SITE, ignore_errors=True)
    for language, output in outputs.items():
        folder = SITE / language
        shutil.copytree(output, folder, ignore=shutil.ignore_patterns(*NOT_FOR_READERS))
        remove_old_pictures(folder)
        write_workbook(folder / "kalman.xlsx")
        write_offline_worker(language, folder, version)
        write_zip(language, folder / f"{ZIP_NAMES[language]}.zip")
    toc = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))
    choose = template("choose.html").replace("{{ page }}", f"{toc['root']}.html")
    (SITE / "index.html").write_text(choose, encoding="utf-8")


def template(name):
    return (ROOT / "book" / "_templates" / name).read_text(encoding="utf-8")


def remove_old_pictures(folder):
    """No picture stays that an older build has left."""
    shown = "".join(page.read_text(encoding="utf-8") for page in folder.rglob("*.html"))
    for picture in (folder / "_images").glob("*"):
        if picture.name not in shown:
            picture.unlink()


def write_workbook(path):
    """The workbook that chapter 2 offers: the paper's table, as in its own cell."""
    from kalman_lib import data
    from kalman_lib.papers import smoother

    data.write_workbook(path, smoother.MEASURED, Q=1e-5, R=1e-5, x0=0, P0=1)


def write_offline_worker(language, folder, version):
    """The script that keeps the pages of one language on the reader's device.

    It works over http; file:// needs no such thing.
    """
    files = [file for file in sorted(folder.rglob("*")) if file.suffix in KEPT_OFFLINE]
    kept = [file.relative_to(folder).as_posix() for file in files if file.is_file()]
    values = {"language": language, "version": version[:12], "files": json.dumps(kept)}
    script = template("offline-worker.js")
    for name, value in values.items():
        script = script.replace("{{ " + name + " }}", value)
    (folder / "offline-worker.js").write_text(script, encoding="utf-8")


def write_zip(language, path):
    """What a reader needs to run the chapters.

    That is the notebooks in one language, their data, kalman_lib and the requirements.
    """
    top = path.stem
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in zipped_files():
            archive.write(file, f"{top}/{file.relative_to(ROOT).as_posix()}")
        workbook = path.parent / "kalman.xlsx"  # chapter 2 links to it
        archive.write(workbook, f"{top}/kalman.xlsx")
        for source in sorted((ROOT / "notebooks").glob("*.ipynb")):
            notebook = json.loads(source.read_text(encoding="utf-8"))
            content = texts.download_notebook(notebook, language)
            text = json.dumps(content, indent=1, ensure_ascii=False)
            archive.writestr(f"{top}/notebooks/{source.name}", text)


def zipped_files():
    found = []
    for folder in ZIPPED_FOLDERS:
        found += sorted((ROOT / folder).rglob("*"))
    found += [ROOT / name for name in ZIPPED_FILES]
    return [file for file in found if file.is_file() and "__pycache__" not in file.parts]
