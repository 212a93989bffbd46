"""The first cell of a notebook that a reader takes home: it runs wherever the notebook is opened.

Where `kalman_lib` is missing (Colab, Kaggle, a browser, another environment of VS Code), it
installs the wheel of this edition. A line with %pip holds no name in braces: in a browser the line
is read as it stands, before Python sees it.
"""

import re

from packaging.version import Version

DATA = re.compile(r"\"(data/[\w.]+|\d\d_\w+\.ipynb)\"")
MISSING = {
    "id": "kalman_lib belum ada: letakkan {wheel} di samping buku catatan ini, "
    "lalu jalankan sel ini lagi.",
    "en": "kalman_lib is missing: put {wheel} beside this notebook, then run this cell again.",
}
HINTS = {
    "fetches": {
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


def first_cells(notebook, language, edition, place="site"):
    """The hint and the cell that go below the title.

    place: where the wheel is looked for: "site" (its address stands in the edition), "beside" the
    notebook, or the "index" of a JupyterLite. Without an address: beside the notebook.
    """
    address = edition.get("address", "").rstrip("/")
    wheel = wheel_name(edition["version"])
    if place == "index":
        code = START.format(language=language, place="")
    elif place == "site" and address:
        code = from_site(notebook, language, f"{address}/{language}", wheel)
    else:
        sentence = MISSING[language].format(wheel=wheel)
        code = BESIDE.format(language=language, wheel=wheel, sentence=sentence)
    hint = HINTS["beside" if code.startswith(BESIDE[:60]) else "fetches"][language]
    return [
        {"cell_type": "markdown", "id": "needed", "metadata": {}, "source": hint},
        {
            "cell_type": "code",
            "id": "install",
            "metadata": {},
            "execution_count": None,
            "outputs": [],
            "source": code,
        },
    ]


def from_site(notebook, language, folder, wheel):
    """The wheel and what the notebook reads, from the site."""
    code = START.format(language=language, place=f" @ {folder}/{wheel}")
    names = ", ".join(f'"{name}"' for name in needed_files(notebook))
    if names:
        code += FETCH.format(names=names, folder=f"{folder}/_sources/notebooks")
    return code


def needed_files(notebook):
    """The files beside the notebook that its cells open."""
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    return sorted({name for cell in code for name in DATA.findall("".join(cell["source"]))})
