"""Run notebooks from the top and store their outputs.

    python book/store_outputs.py [notebooks/NN_name.ipynb ...]

The stored outputs are what `make test` compares with and what readers download. Live widgets leave
their static picture only: their view is of no use without the kernel that made it (running.py).
"""

import os
import sys
from pathlib import Path

import nbformat

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "book" / "_ext"))

from running import run  # noqa: E402  (it lies in a folder of its own)


def store(path):
    """Execute one notebook in its own folder; what differs from kernel to kernel is not kept."""
    notebook = nbformat.read(path, as_version=4)
    run(notebook, path.parent)
    about = {name: value for name, value in notebook.metadata.items() if name == "book"}
    notebook.metadata = {
        **about,
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    }
    nbformat.write(notebook, path)


if __name__ == "__main__":
    os.environ["TQDM_DISABLE"] = "1"  # a progress bar is no output to keep
    for path in map(Path, sys.argv[1:] or sorted((ROOT / "notebooks").glob("*.ipynb"))):
        print(f"Running {path.name} ...", flush=True)
        store(path.resolve())
