"""The live explorers: one classic script and one style sheet, made from book/explorers and loaded where they are needed.

The modules are bundled by esbuild, because a browser refuses ES modules from file://. Every file in book/explorers/papers
belongs to the paper of the same name, and its ranges and words come from the Params of that paper. The script of a language
leaves out the words of the other one, where both stand side by side: a tenth of what a reader loads. It defines
KalmanExplorers, which holds the rooms and the papers, for the tests.

`python book/_ext/explorers.py FOLDER LANGUAGE` writes both files into FOLDER and does nothing else.
"""
import importlib
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import offline

SOURCES = offline.BOOK / "explorers"
ROOMS = ("filters", "linalg", "metrics", "random", "spreadsheet", "words", "xlsx")
DATA = offline.BOOK.parent / "notebooks" / "data"
TEXT = r'("(?:[^"\\]|\\.)*"|`[^`]*`)'
PAIR = re.compile(rf"\bid: {TEXT},\s+en: {TEXT}")


def entry(sources, language):
    """The text of the module that joins everything: papers found in the folder, their tables from Python."""
    from kalman_lib.papers import describe
    papers = sorted(path.stem for path in (sources / "papers").glob("*.js"))
    tables = {name: {field: {key: value for key, value in meta.items() if key not in {"id", "en"} - {language}} for field, meta in
                     describe(importlib.import_module(f"kalman_lib.papers.{name}").Params).items()} for name in papers}
    modules = {**{name: f"papers/{name}.js" for name in papers}, **{name: f"{name}.js" for name in (*ROOMS, "explorer")}}
    lines = [f"import * as {name} from {json.dumps((sources / path).as_posix())};" for name, path in modules.items()]
    lines += [f"const tables = {json.dumps(tables, ensure_ascii=False)}, papers = {{ {', '.join(papers)} }};",
              "explorer.define(papers, tables);", f"export {{ papers, tables, {', '.join(ROOMS)} }};"]
    return "\n".join(lines)


def words_of(language, sources, target):
    """A copy of the modules with the words of one language."""
    for path in sources.rglob("*.js"):
        text = PAIR.sub(lambda pair: f"{language}: {pair[1 if language == 'id' else 2]}", path.read_text(encoding="utf-8"))
        (target / path.relative_to(sources)).parent.mkdir(exist_ok=True)
        (target / path.relative_to(sources)).write_text(text, encoding="utf-8")
    return target


def bundle(target, language, sources=SOURCES):
    """Write explorers.js and explorers.css of one language into the folder target."""
    program = offline.NODE_MODULES / "esbuild" / "bin" / "esbuild"
    script = program.read_bytes()[:2] == b"#!"        # npm may have put the program itself in the place of its starter
    run = [str(offline.node_binary()), str(program)] if script else [str(program)]
    options = ["--minify", "--target=es2022", "--charset=utf8", "--log-level=warning"]
    data = [f"--alias:data={DATA.as_posix()}", "--loader:.csv=text"]     # import nile from "data/nile.csv"
    with tempfile.TemporaryDirectory() as folder:
        modules = words_of(language, sources, Path(folder))
        steps = [([*options, *data, "--bundle", "--format=iife", "--global-name=KalmanExplorers"], entry(modules, language), "explorers.js"),
                 ([*options, "--loader=css"], (sources / "explorer.css").read_text(encoding="utf-8"), "explorers.css")]
        for arguments, text, name in steps:
            made = subprocess.run([*run, *arguments], input=text, capture_output=True, encoding="utf-8", cwd=modules,
                                  env={**os.environ, "NODE_PATH": str(offline.NODE_MODULES)})
            if made.returncode != 0 or made.stderr:
                sys.exit(f"book/explorers could not be bundled ({name}):\n{made.stderr}")
            offline.write_if_new(target / name, made.stdout.encode())


def bundle_for(app, config):
    """The book's language is known: put its script among the static files."""
    folder = Path(app.doctreedir).parent / "explorers"
    bundle(folder / "vendor" / "explorers", config.language)
    config.html_static_path.append(str(folder))


def load(app, pagename, templatename, context, doctree):
    """Script and style sheet, only on a page that holds an explorer."""
    if "<kalman-explorer" in context.get("body", ""):
        app.add_js_file("vendor/explorers/explorers.js", loading_method="defer")
        app.add_css_file("vendor/explorers/explorers.css")


def setup(app):
    offline.install()
    app.connect("config-inited", bundle_for)
    app.connect("html-page-context", load)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


if __name__ == "__main__":
    offline.install()
    bundle(Path(sys.argv[1]), sys.argv[2])
