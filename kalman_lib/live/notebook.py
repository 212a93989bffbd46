"""The notebook around: its shell and its language. Loads nothing."""

import json
import os
import sys
from pathlib import Path

LANGUAGES = ("id", "en")
CHOSEN = "KALMAN_LANGUAGE"  # set by the first cell of a notebook that was downloaded


def shell():
    """The IPython that runs this; None in plain Python."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


def language_of_notebook():
    """The language of its texts, where they are in one alone; "" where in both, or unknown."""
    running = shell()
    opened = running.user_ns.get("__vsc_ipynb_file__") if running else None  # in VS Code
    path = Path(opened or os.environ.get("JPY_SESSION_NAME", ""))  # in JupyterLab and Notebook
    try:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        tags = {tag for cell in cells for tag in cell["metadata"].get("tags", [])}
    except (OSError, ValueError, KeyError, TypeError):
        tags = set()  # Colab, Kaggle, a browser: nobody says which file this is
    found = [language for language in LANGUAGES if f"lang-{language}" in tags]
    chosen = os.environ.get(CHOSEN, "")
    if not found and chosen in LANGUAGES:
        return chosen
    return found[0] if len(found) == 1 else ""
