"""The wheel of kalman_lib, explorers and exercises inside: the same bytes from the same sources.

`python book/_make/wheel.py` writes it into _build/wheel and takes away what lies there from an
older version.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from places import BUILD, ROOT

WHEELS = BUILD / "wheel"
SOURCES = ("pyproject.toml", "LICENSE")
DATE = (1980, 1, 1, 0, 0, 0)  # of every file in it: the first that an archive can tell
MODE = 0o644 << 16  # of every file, whatever the umask here


def write_wheel(folder=WHEELS):
    """Make the wheel in this folder, and leave no other one there -> its path.

    It is made from a copy: setuptools would leave a folder `build` in the sources, and take from
    it the next time what is there no more.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        source = Path(place) / "source"
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / "kalman_lib", source / "kalman_lib", ignore=ignored)
        for name in SOURCES:
            shutil.copy(ROOT / name, source)
        pip_wheel(source, place)
        (made,) = Path(place).glob("*.whl")
        for old in folder.glob("*.whl"):
            old.unlink()
        write_again(made, folder / made.name)
    return folder / made.name


def pip_wheel(source, target):
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check"]
    alone = ["--no-index", "--no-deps", "--no-build-isolation"]
    without = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [*command, *alone, "--wheel-dir", str(target), str(source)],
        env=without,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        sys.exit(f"The wheel of kalman_lib was not made:\n{done.stdout}{done.stderr}")


def write_again(made, target):
    """The same archive without what differs from day to day and from machine to machine."""
    with zipfile.ZipFile(made) as source, zipfile.ZipFile(target, "w") as archive:
        names = sorted(source.namelist(), key=lambda name: (".dist-info/" in name, name))
        for name in names:
            entry = zipfile.ZipInfo(name, DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, so that the mode below counts
            entry.external_attr = MODE
            archive.writestr(entry, source.read(name))


if __name__ == "__main__":
    print(write_wheel())
