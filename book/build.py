"""Build the book in both languages: python book/build.py

    _config.yml   ->  _build/work/<language>   (Jupyter Book, once per language; one cache of executed notebooks)
                  ->  _build/site/<language>   (the same pages without what no reader needs, plus a workbook and a .zip)
                      _build/site/index.html   (leads to the reader's language)

The notebooks are executed side by side, then both languages are built side by side.
Does nothing when nothing changed since the last build; a second build at the same time waits for the first.
Open _build/site/index.html, no server needed.
"""
import hashlib
import json
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import time
import zipfile
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "_build"
SITE = BUILD / "site"
CACHE = BUILD / "cache"  # executed notebooks, common to both languages
ZIP_NAMES = {"id": "filter-kalman", "en": "kalman-filter"}
NOT_FOR_READERS = ("*.map", "*.ttf", "*.LICENSE.txt", "*webpack-macros.html", "fontawesome.js", ".buildinfo*", "reports",
                   "objects.inv", "fontawesome")

# jsonschema, which every process here imports, would spend two seconds on a grammar of addresses that nobody checks
WITHOUT_GRAMMAR = "import sys; sys.modules['rfc3987_syntax'] = None; "
sys.modules["rfc3987_syntax"] = None

sys.path.insert(0, str(ROOT / "book" / "_ext"))
try:
    import nbformat
    import yaml
    import jupyter_book  # noqa: F401  (these two only to see that they are there)
    import kalman_lib  # noqa: F401
    from filelock import FileLock
    from jupyter_cache import get_cache
    from jupyter_cache.base import CacheBundleIn
    from nbclient.exceptions import CellExecutionError
    import cover
    import explorers
    import languages
    import offline
    import running
except ImportError as error:
    sys.exit(f"The Python package {error.name!r} is missing: install it with\n    pip install -r requirements.lock\n"
             "    pip install --no-deps --no-build-isolation -e .")


def fingerprint(*paths):
    """One number for the content of these files and folders."""
    digest = hashlib.sha256()
    for path in paths:
        files = sorted(path.rglob("*")) if path.is_dir() else [path]
        for file in files:
            relative = file.relative_to(ROOT)
            if file.is_file() and not {"node_modules", "vendor", "__pycache__", ".ipynb_checkpoints", "bundle"} & set(relative.parts) \
                    and file.suffix != ".mo":
                digest.update(relative.as_posix().encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def frame():
    """One number for all that may show on other pages than its own: whatever makes the pages, and the headings, references
    and links in the texts. While it stays, a changed text changes its own page only."""
    outlines = []
    for path in sorted([*(ROOT / "book").glob("*.md"), *(ROOT / "notebooks").glob("*.ipynb")]):
        text = path.read_text(encoding="utf-8")
        outlines.append([path.name, re.findall(r'(?:^|")#+ [^"\n]*|\{[a-z:]+\}`[^`]*`|\]\([^)]*\)|^\([\w-]+\)=', text, re.MULTILINE)])
    parts = [ROOT / "book" / name for name in ("_ext", "_locale", "_static", "_templates", "explorers", "references.bib", "build.py", "package-lock.json")]
    digest = hashlib.sha256(json.dumps(outlines).encode())
    digest.update(fingerprint(*parts, *(ROOT / name for name in ("_config.yml", "_toc.yml", "kalman_lib", "notebooks/data", "requirements.lock"))).encode())
    return digest.hexdigest()


def is_new(mark, value):
    """Does the file `mark` hold another value than this one?"""
    return not mark.exists() or mark.read_text() != value


def write_config(language, folder):
    """The configuration of one language: _config.yml with absolute paths, the language and the common cache."""
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    config["execute"]["cache"] = str(CACHE)
    sphinx = config["sphinx"]
    sphinx["local_extensions"] = {name: str(ROOT / path) for name, path in sphinx["local_extensions"].items()}
    for key in ("locale_dirs", "templates_path", "html_static_path"):
        sphinx["config"][key] = [str(ROOT / path) for path in sphinx["config"][key]]
    sphinx["config"].update(language=language, book_site=True)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "config.yml"
    path.write_text(yaml.safe_dump(config, sort_keys=False, allow_unicode=True), encoding="utf-8")
    return path


def code_of(path):
    """The notebook as book/_ext/figures.py leaves it, which is what the cache compares: without the words of its figures."""
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        cell.metadata.pop("book", None)
    return notebook


def execute(path):
    """Run one notebook -> (the notebook with its outputs, seconds, None), or (None, 0, what went wrong)."""
    notebook = code_of(path)
    started = time.monotonic()
    try:
        running.run(notebook, path.parent)
    except CellExecutionError as error:
        return None, 0, str(error)
    return notebook, time.monotonic() - started, None


def execute_notebooks():
    """Fill the cache with the notebooks that it does not hold yet, as many at once as there are processors."""
    os.environ.setdefault("TQDM_DISABLE", "1")                  # no progress bars in the pages
    cache = get_cache(str(CACHE))

    def is_cached(path):
        try:
            return bool(cache.match_cache_notebook(code_of(path)))
        except KeyError:
            return False

    missing = [path for path in sorted((ROOT / "notebooks").glob("*.ipynb")) if not is_cached(path)]
    missing.sort(key=lambda path: -path.stat().st_size)         # the long ones first
    with ProcessPoolExecutor(max_workers=os.cpu_count(), mp_context=multiprocessing.get_context("spawn")) as pool:
        for path, (notebook, seconds, error) in zip(missing, pool.map(execute, missing)):
            if error:
                sys.exit(f"{error}\n{path.name} stopped at this cell.")
            cache.cache_notebook_bundle(CacheBundleIn(notebook, str(path), data={"execution_seconds": seconds}),
                                        check_validity=False, overwrite=True)
            print(f"Ran {path.name} in {seconds:.0f} s", flush=True)


def build_language(language, again):
    """Run Jupyter Book; any warning is an error. again: only the pages whose text has changed."""
    folder = BUILD / "work" / language
    command = [sys.executable, "-c", WITHOUT_GRAMMAR + "from jupyter_book.cli.main import main; main()", "build", str(ROOT), "--config", str(write_config(language, folder)),
               "--toc", str(ROOT / "_toc.yml"), "--path-output", str(folder), *([] if again else ["--all"]), "-n", "-W", "--keep-going"]
    if not again:
        shutil.rmtree(folder / "_build", ignore_errors=True)
    built = subprocess.run(command, cwd=ROOT, env={**os.environ, "PYTHONUTF8": "1"}, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, encoding="utf-8")
    print(f"\n=== {languages.LANGUAGES[language]} ===\n{built.stdout}", flush=True)
    if built.returncode != 0:
        sys.exit(f"The {languages.LANGUAGES[language]} book was not built: the message is above (warnings count as errors).")
    return folder / "_build" / "html"


def build_languages(again):
    """Both languages side by side -> {language: folder of its pages}. What both need is made before."""
    offline.copy_vendor()
    explorers.check()
    cover.draw()
    with ThreadPoolExecutor() as pool:
        return dict(zip(languages.LANGUAGES, pool.map(lambda language: build_language(language, again), languages.LANGUAGES)))


def write_zip(language, path):
    """What a reader needs to run the chapters: notebooks in one language, their data, kalman_lib, the requirements."""
    files = [file for folder in ("notebooks/data", "kalman_lib") for file in sorted((ROOT / folder).rglob("*"))
             if file.is_file() and "__pycache__" not in file.parts]
    files += [ROOT / name for name in ("requirements.txt", "requirements.lock", "pyproject.toml", "LICENSE") if (ROOT / name).exists()]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in files:
            archive.write(file, f"{path.stem}/{file.relative_to(ROOT).as_posix()}")
        archive.write(path.parent / "kalman.xlsx", f"{path.stem}/kalman.xlsx")  # chapter 2 links to it
        for notebook in sorted((ROOT / "notebooks").glob("*.ipynb")):
            content = languages.download_notebook(json.loads(notebook.read_text(encoding="utf-8")), language)
            archive.writestr(f"{path.stem}/notebooks/{notebook.name}", json.dumps(content, indent=1, ensure_ascii=False))


def write_workbook(path):
    """The workbook that chapter 2 offers: the paper's table, as in its own cell."""
    from kalman_lib import spreadsheet
    from kalman_lib.papers import smoother
    spreadsheet.write_workbook(path, smoother.MEASURED, Q=1e-5, R=1e-5, x0=0, P0=1)


def write_offline_worker(language, folder, version):
    """The script that keeps the pages of one language on the reader's device (over http; file:// needs no such thing)."""
    kept = [file.relative_to(folder).as_posix() for file in sorted(folder.rglob("*"))
            if file.suffix in {".html", ".css", ".js", ".png", ".svg", ".ico", ".woff2"} and file.is_file()]
    script = (ROOT / "book" / "_templates" / "offline-worker.js").read_text(encoding="utf-8")
    for name, value in {"language": language, "version": version[:12], "files": json.dumps(kept)}.items():
        script = script.replace("{{ " + name + " }}", value)
    (folder / "offline-worker.js").write_text(script, encoding="utf-8")


def remove_old_pictures(folder):
    """No picture stays that an older build has left."""
    shown = "".join(page.read_text(encoding="utf-8") for page in folder.rglob("*.html"))
    for picture in (folder / "_images").glob("*"):
        if picture.name not in shown:
            picture.unlink()


def assemble(outputs, version):
    """Put the finished pages of both languages into _build/site."""
    shutil.rmtree(SITE, ignore_errors=True)
    for language, output in outputs.items():
        shutil.copytree(output, SITE / language, ignore=shutil.ignore_patterns(*NOT_FOR_READERS))
        remove_old_pictures(SITE / language)
        write_workbook(SITE / language / "kalman.xlsx")
        write_offline_worker(language, SITE / language, version)
        write_zip(language, SITE / language / f"{ZIP_NAMES[language]}.zip")
    first_page = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))["root"] + ".html"
    choose = (ROOT / "book" / "_templates" / "choose.html").read_text(encoding="utf-8")
    (SITE / "index.html").write_text(choose.replace("{{ page }}", first_page), encoding="utf-8")


def main():
    started = time.monotonic()
    offline.install()
    explorers.for_notebooks()           # which the notebooks show while they run, and the readers' archive holds
    code = fingerprint(ROOT / "kalman_lib", ROOT / "notebooks" / "data", ROOT / "requirements.lock")
    everything = code + fingerprint(ROOT / "book", ROOT / "notebooks", ROOT / "_config.yml", ROOT / "_toc.yml")
    code_mark, site_mark, frame_mark = CACHE / "made-with", BUILD / "built-from", BUILD / "built-around"
    if (SITE / "index.html").exists() and not is_new(site_mark, everything):
        print("The book is up to date.")
    else:
        if is_new(code_mark, code):  # the cache looks at the cells of a notebook only, not at the code they import
            shutil.rmtree(CACHE, ignore_errors=True)
            CACHE.mkdir(parents=True)
            code_mark.write_text(code)
        execute_notebooks()
        around = frame()
        again = not is_new(frame_mark, around)
        frame_mark.unlink(missing_ok=True)      # until this build is done
        assemble(build_languages(again), everything)
        site_mark.write_text(everything)
        frame_mark.write_text(around)
        print(f"\nBuilt in {time.monotonic() - started:.0f} s.")
    print(f"Open {SITE / 'index.html'}")


if __name__ == "__main__":
    BUILD.mkdir(exist_ok=True)
    with FileLock(BUILD / "lock"):
        main()
