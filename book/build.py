"""Build the book in both languages: python book/build.py

    _config.yml   ->  _build/work/<language>   (Jupyter Book, once per language; the executed
                                                notebooks are common to both)
                  ->  _build/site/<language>   (the same pages without what no reader needs, plus a
                                                workbook and a .zip)
                      _build/site/index.html   (leads to the reader's language)

The notebooks are executed side by side, then both languages are built side by side. Does nothing
when nothing changed since the last build; a second build at the same time waits for the first.
Open _build/site/index.html, no server needed.

One page while writing it: python book/build.py --only notebooks/03_gyro [--language id] [--watch]
builds nothing but this page, with the outputs that its notebook stores, in a few seconds.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# jsonschema, which every process here imports, would spend two seconds on a grammar of addresses
# that nobody checks
WITHOUT_GRAMMAR = "import sys; sys.modules['rfc3987_syntax'] = None; "
sys.modules["rfc3987_syntax"] = None

SOURCES = ("book", "notebooks", "_config.yml", "_toc.yml", "pyproject.toml", "LICENSE")
REFERENCES = "book/references"  # the page with the bibliography
BOOK = Path(__file__).resolve().parent
sys.path[:0] = [str(BOOK / "_make"), str(BOOK / "_ext")]
try:
    import bekal
    import cover
    import explorers
    import jupyter_book  # noqa: F401  (these two only to see that they are there)
    import offline
    import yaml
    from assemble import PDFS, assemble
    from changes import fingerprint, frame, is_new
    from chapters import execute_notebooks
    from filelock import FileLock
    from places import BUILD, CACHE, LITE, ROOT, SITE
    from texts import LANGUAGES

    import kalman_lib  # noqa: F401
except ImportError as error:
    sys.exit(
        f"The Python package {error.name!r} is missing: install it with\n"
        "    pip install -r requirements.lock\n"
        "    pip install --no-deps --no-build-isolation -e ."
    )


def write_config(language, folder, execute="cache", site=True):
    """The configuration of one language: _config.yml with absolute paths and the common cache.

    execute: "cache", or "off" to show stored outputs. site: does the other language lie beside it?
    """
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    config["execute"].update(cache=str(CACHE), execute_notebooks=execute)
    sphinx = config["sphinx"]
    extensions = sphinx["local_extensions"].items()
    sphinx["local_extensions"] = {name: str(ROOT / path) for name, path in extensions}
    for key in ("locale_dirs", "templates_path", "html_static_path"):
        sphinx["config"][key] = [str(ROOT / path) for path in sphinx["config"][key]]
    sphinx["config"].update(language=language, book_site=site)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "config.yml"
    path.write_text(yaml.safe_dump(config, sort_keys=False, allow_unicode=True), encoding="utf-8")
    return path


def run_jupyter_book(config, toc, folder, *options):
    """Jupyter Book in a process of its own -> its CompletedProcess."""
    program = WITHOUT_GRAMMAR + "from jupyter_book.cli.main import main; main()"
    places = ["--config", str(config), "--toc", str(toc), "--path-output", str(folder)]
    return subprocess.run(
        [sys.executable, "-c", program, "build", str(ROOT), *places, *options],
        cwd=ROOT,
        env={**os.environ, "PYTHONUTF8": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )


def build_language(language, again):
    """Run Jupyter Book; any warning is an error. again: only the pages whose text has changed."""
    folder = BUILD / "work" / language
    config = write_config(language, folder)
    scope = [] if again else ["--all"]
    if not again:
        shutil.rmtree(folder / "_build", ignore_errors=True)
    strict = ["-n", "-W", "--keep-going"]
    built = run_jupyter_book(config, ROOT / "_toc.yml", folder, *scope, *strict)
    print(f"\n=== {LANGUAGES[language]} ===\n{built.stdout}", flush=True)
    if built.returncode != 0:
        sys.exit(
            f"The {LANGUAGES[language]} book was not built: the message is above "
            "(warnings count as errors)."
        )
    return folder / "_build" / "html"


def prepare():
    """What both languages need."""
    offline.copy_vendor()
    cover.draw()
    bekal.draw()


def build_languages(again):
    """Both languages side by side -> {language: folder of its pages}."""
    prepare()
    with ThreadPoolExecutor() as pool:
        folders = pool.map(lambda language: build_language(language, again), LANGUAGES)
        return dict(zip(LANGUAGES, folders))


def build():
    """The whole book, or nothing if nothing has changed."""
    started = time.monotonic()
    offline.install()
    explorers.for_notebooks()  # for the notebooks that run here, and for the readers' archive
    code = fingerprint(ROOT / "kalman_lib", ROOT / "notebooks" / "data", ROOT / "requirements.lock")
    sources = [ROOT / name for name in SOURCES]
    everything = code + fingerprint(*sources)
    site_mark, frame_mark = BUILD / "built-from", BUILD / "built-around"
    if (SITE / "index.html").exists() and not is_new(site_mark, everything):
        print("The book is up to date.")
        return
    forget_old_outputs(code)
    execute_notebooks()
    around = frame()
    again = not is_new(frame_mark, around)
    frame_mark.unlink(missing_ok=True)  # until this build is done
    pages = build_languages(again)
    for other in (PDFS, LITE):  # they show another build
        shutil.rmtree(other, ignore_errors=True)
    assemble(pages)
    site_mark.write_text(everything)
    frame_mark.write_text(around)
    print(f"\nBuilt in {time.monotonic() - started:.0f} s.")


def forget_old_outputs(code):
    """Empty the cache if the code has changed: it looks at the cells of a notebook only."""
    mark = CACHE / "made-with"
    if is_new(mark, code):
        shutil.rmtree(CACHE, ignore_errors=True)
        CACHE.mkdir(parents=True)
        mark.write_text(code)


# --- one page while writing it ------------------------------------------------------------------


def build_page(page, language):
    """One page with the outputs that its notebook stores -> its HTML file, or None.

    Its only neighbour is the bibliography, so links to other pages lead nowhere. Warnings are
    printed and do not stop it.
    """
    started = time.monotonic()
    folder = BUILD / "page" / language
    folder.mkdir(parents=True, exist_ok=True)
    toc = folder / "toc.yml"
    chapters = [{"file": REFERENCES}] if page != REFERENCES else []
    toc.write_text(yaml.safe_dump({"format": "jb-book", "root": page, "chapters": chapters}))
    config = write_config(language, folder, execute="off", site=False)
    built = run_jupyter_book(config, toc, folder, "-q")
    result = folder / "_build" / "html" / f"{page}.html"
    if built.returncode != 0 or not result.exists():
        print(built.stdout, flush=True)
        return None
    lines = built.stdout.splitlines()
    warnings = [line for line in lines if "WARNING" in line and "xref_missing" not in line]
    print(*warnings, sep="\n", end="\n" if warnings else "")
    print(f"Open {result} (built in {time.monotonic() - started:.0f} s)", flush=True)
    return result


def watch_page(page, language):
    """Build the page again whenever its source is saved."""
    source = source_of(page)
    seen = None
    print(f"Watching {source.relative_to(ROOT)} (stop with Ctrl+C)", flush=True)
    while True:
        now = source.stat().st_mtime_ns if source.exists() else seen
        if now != seen:
            seen = now
            build_page(page, language)
        time.sleep(0.3)


def source_of(page):
    """The notebook or the Markdown file of a page such as notebooks/03_gyro."""
    for suffix in (".ipynb", ".md"):
        source = ROOT / f"{page}{suffix}"
        if source.exists():
            return source
    sys.exit(f"There is no page {page}: {page}.ipynb and {page}.md are missing.")


def arguments():
    parser = argparse.ArgumentParser(description="Build the book, or one page of it.")
    parser.add_argument("--only", metavar="PAGE", help="one page, such as notebooks/03_gyro")
    parser.add_argument("--language", choices=LANGUAGES, default="id", help="of that page")
    parser.add_argument("--watch", action="store_true", help="again whenever it is saved")
    chosen = parser.parse_args()
    if chosen.watch and not chosen.only:
        parser.error("--watch needs --only PAGE")
    return chosen


def main():
    chosen = arguments()
    BUILD.mkdir(exist_ok=True)
    if not chosen.only:
        with FileLock(BUILD / "lock"):
            build()
        print(f"Open {SITE / 'index.html'}")
        return
    page = chosen.only.removesuffix(".ipynb").removesuffix(".md")
    source_of(page)
    offline.install()
    explorers.for_notebooks()
    prepare()
    try:
        if chosen.watch:
            watch_page(page, chosen.language)
        elif build_page(page, chosen.language) is None:
            sys.exit(f"{page} was not built: the message is above.")
    except KeyboardInterrupt:
        print()


if __name__ == "__main__":
    main()
