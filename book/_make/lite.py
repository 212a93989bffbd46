"""JupyterLite for whoever wants it: the chapters run in the browser, under lite/ of the site.

    python book/_make/lite.py PYTHON [FOLDER]

PYTHON: that of the environment with book/lite/needs.lock; FOLDER: a Pyodide of our own (its full
distribution), which goes into the site; without it the browser asks a CDN for it. `make lite` calls
this. What the browser will download, and from where, stands on lite/start.html, to which the
chapters lead.
"""

import html
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "book" / "_make"), str(ROOT / "book" / "_ext")]
import kept  # noqa: E402
from downloads import notebooks_in  # noqa: E402
from edition import edition  # noqa: E402
from first_cell import in_lite  # noqa: E402
from lists import title  # noqa: E402
from places import BUILD, LITE  # noqa: E402
from texts import LANGUAGES  # noqa: E402
from wheel import write_wheel  # noqa: E402

SOURCE = BUILD / "lite-source"
START = "start.html"
KERNEL = "@jupyterlite/pyodide-kernel-extension:kernel"
WHEELS = (  # what the chapters need and Pyodide does not bring; all of it plain Python
    "anywidget",
    "comm",
    "et-xmlfile",
    "filterpy",
    "ipywidgets",
    "jupyterlab-widgets",
    "openpyxl",
    "psygnal",
)
CDN = "cdn.jsdelivr.net"
SIZE = 45  # MB, about: Pyodide with NumPy, SciPy and Matplotlib 40, JupyterLab 5
HERE = {"id": "situs ini juga", "en": "this site, too"}


def write_lite(python, pyodide=None):
    """pyodide: a folder, or None -> the folder of the finished JupyterLite."""
    for folder in (SOURCE, LITE):
        shutil.rmtree(folder, ignore_errors=True)
    write_contents()
    write_wheels()
    write_settings()
    if pyodide:
        shutil.copytree(pyodide, SOURCE / "static" / "pyodide")
    build(python)
    (LITE / START).write_text(start_page(pyodide), encoding="utf-8")
    return LITE


def write_contents():
    """The notebooks of both languages, each with their data."""
    for language in LANGUAGES:
        folder = SOURCE / "files" / language
        shutil.copytree(ROOT / "notebooks" / "data", folder / "data")
        place = in_lite(edition(), language)
        for name, text in notebooks_in(language, edition()["version"], place):
            (folder / name).write_text(text, encoding="utf-8")


def write_wheels():
    """kalman_lib and what it needs, as they are locked."""
    folder = SOURCE / "pypi"
    write_wheel(folder)
    needed = SOURCE / "wheels.txt"
    needed.write_text(locked(WHEELS), encoding="utf-8")
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    plain = ["--no-deps", "--only-binary", ":all:", "--platform", "any", "--require-hashes"]
    subprocess.run([*command, *plain, "-r", str(needed), "-d", str(folder)], check=True)


def locked(names):
    """The entries of requirements.lock with these names, hashes included."""
    text = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    entries = re.findall(r"^(([\w.-]+)==.*(?:\n +--hash.*)*)", text, re.MULTILINE)
    by_name = {name: entry for entry, name in entries}
    return "\n".join(by_name[name] for name in names) + "\n"


def write_settings():
    """The browser asks no package index: what there is lies here or in Pyodide."""
    plugins = {KERNEL: {"disablePyPIFallback": True}}
    settings = {
        "jupyter-lite-schema-version": 0,
        "jupyter-config-data": {"litePluginSettings": plugins},
    }
    (SOURCE / "jupyter-lite.json").write_text(json.dumps(settings), encoding="utf-8")


def build(python):
    command = [python, "-m", "jupyterlite_core.app", "build", "--apps", "lab", "--no-sourcemaps"]
    places = ["--lite-dir", str(SOURCE), "--output-dir", str(LITE), "--no-unused-shared-packages"]
    done = subprocess.run([*command, *places], cwd=SOURCE, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"JupyterLite was not built:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")


# --- the page before it ---------------------------------------------------------------------------


def start_page(pyodide):
    """What will be downloaded and from where, and every chapter in both languages."""
    words = {"size": str(SIZE)}
    for language in LANGUAGES:
        words[f"{language}_host"] = HERE[language] if pyodide else CDN
        words[f"{language}_chapters"] = "\n".join(chapter_links(language))
    return kept.plain_page("lite-start.html", **words)


def chapter_links(language):
    for path in sorted((SOURCE / "files" / language).glob("*.ipynb")):
        name = html.escape(title(f"notebooks/{path.stem}", language))
        address = f"lab/index.html?path={language}/{path.name}"
        yield f'      <li id="{language}-{path.stem}"><a href="{address}">{name}</a></li>'


def main():
    import assemble

    python, *folder = sys.argv[1:]
    pyodide = Path(folder[0]).expanduser().resolve() if folder and folder[0] else None
    if pyodide and not (pyodide / "pyodide-lock.json").exists():
        sys.exit(f"{pyodide} holds no Pyodide: pyodide-lock.json is missing.")
    write_lite(python, pyodide)
    assemble.assemble(assemble.built_pages())
    size = sum(path.stat().st_size for path in LITE.rglob("*") if path.is_file())
    print(f"{LITE.parent / 'site' / 'lite' / START} ({size / 1e6:.0f} MB on the host)")


if __name__ == "__main__":
    main()
