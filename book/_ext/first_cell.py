"""The first cell of a notebook that a reader takes home: it runs wherever the notebook is opened.

Where `kalman_lib` is missing (Colab, Kaggle, a browser, another environment of VS Code), it
installs the wheel of this edition. A line with %pip holds no name in braces: in a browser the line
is read as it stands, before Python sees it.
"""

import re
from dataclasses import dataclass

from packaging.version import Version

NOTEBOOKS = "notebooks"  # the branch of the repository that holds them as they are taken home
RAW = "https://raw.githubusercontent.com"
DATA = re.compile(r"\"(data/[\w.]+|\d\d_\w+\.ipynb)\"")
MISSING = {
    "id": "kalman_lib belum ada: letakkan {wheel} di samping buku catatan ini, "
    "lalu jalankan sel ini lagi.",
    "en": "kalman_lib is missing: put {wheel} beside this notebook, then run this cell again.",
}
HINTS = {
    "installs": {
        "id": "*Sel berikut memasang `kalman_lib` di tempat yang belum memilikinya, misalnya di "
        "Colab, Kaggle, atau VS Code.*",
        "en": "*The next cell installs `kalman_lib` where it is missing, for example in Colab, "
        "Kaggle or VS Code.*",
    },
    "beside": {
        "id": "*Untuk menjalankan buku catatan ini diperlukan `kalman_lib`; sebagian bab juga "
        "memerlukan folder `data`. Keduanya ada dalam arsip lengkap di halaman “Cara memakai "
        "buku ini”.*",
        "en": "*To run this notebook, `kalman_lib` is needed; some chapters need the folder "
        "`data`, too. Both are in the complete archive on the page “How to use this book”.*",
    },
}
START = """\
import os
from importlib.util import find_spec
os.environ["KALMAN_LANGUAGE"] = "{language}"
if find_spec("kalman_lib") is None:
    %pip install -q "kalman_lib[chapters]{place}\""""
FETCH = """
from pathlib import Path
from urllib.request import urlretrieve
for name in [{names}]:
    if not Path(name).exists():
        Path(name).parent.mkdir(exist_ok=True)
        urlretrieve("{folder}/" + name, name)"""
BESIDE = """\
import os
from importlib.util import find_spec
from pathlib import Path
os.environ["KALMAN_LANGUAGE"] = "{language}"
if find_spec("kalman_lib") is None:
    if Path("{wheel}").exists():
        %pip install -q "./{wheel}[chapters]"
    else:
        print("{sentence}")"""


def wheel_name(version):
    """The name of the wheel of this edition, as pip writes it."""
    return f"kalman_lib-{Version(version)}-py3-none-any.whl"


def project_of(repository):
    """ "owner/name" of a repository at GitHub; "" elsewhere."""
    found = re.fullmatch(r"https://github\.com/([\w.-]+/[\w.-]+?)(?:\.git)?/?", repository)
    return found[1] if found else ""


def raw_address(repository):
    """Where the files of that branch can be fetched one by one."""
    project = project_of(repository)
    return f"{RAW}/{project}/{NOTEBOOKS}" if project else ""


@dataclass(frozen=True)
class Place:
    """Where a notebook is opened, and what it finds there."""

    wheel: str = ""  # address of the folder with the wheel; "": the wheel lies beside the notebook
    files: str = ""  # address of the folder with what its cells open; "": beside it, too
    pages: str = ""  # address of the pages of its language; "": nobody knows it
    is_lite: bool = False  # a JupyterLite, whose index has the wheel
    is_alone: bool = False  # no other notebook lies beside it


def on_site(edition, language):
    """A notebook that is downloaded from its page."""
    pages = pages_of(edition, language)
    files = f"{pages}/_sources/notebooks" if pages else ""
    return Place(wheel=pages, files=files, pages=pages, is_alone=True)


def in_archive(edition, language):
    """A notebook beside all others, their data and the wheel."""
    return Place(pages=pages_of(edition, language))


def in_branch(edition, language):
    """The same in a branch of the repository: what opens it from there may take it alone."""
    raw = raw_address(edition["repository"])
    files = f"{raw}/{language}" if raw else ""
    return Place(wheel=files, files=files, pages=pages_of(edition, language))


def in_lite(edition, language):
    """A notebook in a JupyterLite, its data beside it."""
    return Place(pages=pages_of(edition, language), is_lite=True)


def pages_of(edition, language):
    address = edition["address"].rstrip("/")
    return f"{address}/{language}" if address else ""


def first_cells(notebook, language, version, place):
    """The hint and the cell that go below the title."""
    wheel = wheel_name(version)
    installs = place.wheel or place.is_lite
    if installs:
        where = f" @ {place.wheel}/{wheel}" if place.wheel else ""
        code = START.format(language=language, place=where) + fetching(notebook, place.files)
    else:
        sentence = MISSING[language].format(wheel=wheel)
        code = BESIDE.format(language=language, wheel=wheel, sentence=sentence)
    hint = HINTS["installs" if installs else "beside"][language]
    first = {"cell_type": "code", "id": "install", "metadata": {}, "source": code}
    return [
        {"cell_type": "markdown", "id": "needed", "metadata": {}, "source": hint},
        {**first, "execution_count": None, "outputs": []},
    ]


def fetching(notebook, folder):
    """The lines that fetch what the notebook opens."""
    names = ", ".join(f'"{name}"' for name in needed_files(notebook))
    return FETCH.format(names=names, folder=folder) if names and folder else ""


def needed_files(notebook):
    """The files beside the notebook that its cells open."""
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    return sorted({name for cell in code for name in DATA.findall("".join(cell["source"]))})
