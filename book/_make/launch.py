"""The line at the top of a chapter that opens it elsewhere, where nothing has to be installed.

Colab and Binder take the notebooks from a branch of the repository (branch.py), so they need its
address in _config.yml; JupyterLite is there when `make lite` has made it. What is not there gets no
link, and without any link there is no line.
"""

import html

from edition import edition
from first_cell import NOTEBOOKS, project_of
from pages import change_all, way_up
from places import LITE

COLAB = "https://colab.research.google.com/github/{project}/blob/{branch}/{language}/{name}.ipynb"
BINDER = "https://mybinder.org/v2/gh/{project}/{branch}?urlpath=lab/tree/{language}/{name}.ipynb"
WORDS = {"id": "Jalankan bab ini di", "en": "Run this chapter in"}
HEADING = "</h1>"


def add_links(folder, language):
    """Below the title of every chapter and of its deeper pages."""

    def changed(page, text):
        if page.parent.name != "notebooks":
            return text
        line = line_of(language, page.stem, way_up(folder, page))
        return text.replace(HEADING, f"{HEADING}\n{line}", 1) if line else text

    change_all(folder, changed)


def line_of(language, name, up):
    """The line of one page; up: the way to the folder of its language."""
    links = " · ".join(
        f'<a href="{html.escape(address)}">{where}</a>'
        for where, address in addresses(language, name, up).items()
    )
    return f'<p class="launch">{WORDS[language]}: {links}</p>' if links else ""


def addresses(language, name, up):
    """{where: the address that opens this notebook there}"""
    found = {}
    project = project_of(edition()["repository"])
    if project:
        values = {"project": project, "branch": NOTEBOOKS, "language": language, "name": name}
        found["Colab"] = COLAB.format(**values)
        found["Binder"] = BINDER.format(**values)
    if LITE.exists():
        found["JupyterLite"] = f"{up}../lite/start.html#{language}-{name}"
    return found
