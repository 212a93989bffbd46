"""Somebody else's Python: what the book needs is there, kalman_lib is not."""

import os
import site
import subprocess
import sys
from pathlib import Path

OURS = ("kalman_lib", "__editable__", "_virtualenv")
RUN = """
import json, sys
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
for code in json.loads(sys.argv[1]):
    shell.run_cell(code).raise_error()
"""


def foreign_python(folder):
    """A virtual environment that sees our libraries without kalman_lib -> its Python."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    packages = next(Path(folder).glob("lib/python*/site-packages"))
    libraries = Path(folder) / "libraries"
    libraries.mkdir()
    for place in site.getsitepackages():
        for entry in Path(place).iterdir():
            there = libraries / entry.name
            if not entry.name.startswith(OURS) and entry.suffix != ".pth" and not there.exists():
                there.symlink_to(entry)
    (packages / "libraries.pth").write_text(f"{libraries}\n")
    return Path(folder) / "bin" / "python"


def run_cells(python, folder, *cells, **variables):
    """Run cells of a notebook that lies in this folder, without a package index -> what they
    print."""
    import json

    left_out = {"PYTHONPATH", "KALMAN_LANGUAGE", "JPY_SESSION_NAME"}
    mine = {name: value for name, value in os.environ.items() if name not in left_out}
    quiet = {
        "PIP_NO_INDEX": "1",
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        "PIP_CONFIG_FILE": os.devnull,
    }
    home = {"IPYTHONDIR": str(Path(folder) / ".ipython")}
    done = subprocess.run(
        [str(python), "-c", RUN, json.dumps(cells)],
        cwd=folder,
        env={**mine, **quiet, **home, **variables},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
