"""Who may import whom (the one rule of the house), and what importing the package must not load."""
import ast
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import conftest  # noqa: F401  (the build's own modules can be imported)
import explorers
import pytest

LIBRARY = Path(__file__).resolve().parent.parent / "kalman_lib"
NUMERICS = {"numpy"}
ALLOWED = {     # file -> what of our own it may import, and which packages; the standard library is free
    "checks.py": (set(), NUMERICS),
    "roots.py": (set(), NUMERICS),
    "models.py": ({"checks", "roots"}, NUMERICS),
    "metrics.py": ({"checks"}, NUMERICS | {"scipy"}),
    "simulate.py": ({"checks", "models"}, NUMERICS),
    "filters.py": ({"checks", "models", "roots", "many"}, NUMERICS | {"scipy"}),
    "many.py": ({"models", "filters"}, NUMERICS),
    "numeric.py": (set(), NUMERICS | {"scipy"}),
    "tuning.py": ({"checks", "models", "roots", "filters", "many", "fast", "numeric"}, NUMERICS | {"scipy"}),
    "montecarlo.py": ({"arguments", "blocks", "workers"}, NUMERICS),
    "arguments.py": (set(), NUMERICS),
    "blocks.py": ({"models", "fast"}, NUMERICS),
    "workers.py": (set(), {"tqdm"}),            # only if it is there
    "__init__.py": ({"models", "metrics", "simulate", "filters", "fast", "tuning", "montecarlo"}, set()),
    "spreadsheet.py": (set(), NUMERICS | {"openpyxl"}),
    "recording.py": ({"spreadsheet"}, NUMERICS),
    "plots.py": ({"metrics", "models", "papers"}, NUMERICS | {"matplotlib", "PIL"}),
    "explorer.py": ({"live", "papers"}, NUMERICS | {"anywidget", "traitlets", "IPython"}),
}
PAPER = ({"checks", "models", "simulate", "numeric", "tuning", "papers"}, NUMERICS)    # "papers": the package alone
LIVE = ({"fast", "filters", "papers", "plots", "recording", "spreadsheet"}, NUMERICS)    # what explorer.py stands on
FAST = ({"checks", "models", "roots", "filters", "many", "fast"}, NUMERICS)


def imports(path):
    """(our own rooms, outside packages) that the file imports anywhere in it."""
    own, outside = set(), set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            outside |= {name.name.split(".")[0] for name in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            outside.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            inside_papers = path.parent.name == "papers" and node.level == 1
            if inside_papers and node.module:
                own.add(f"papers.{node.module}")
            elif inside_papers:
                own.add("papers")
            elif path.parent.name == "fast" and node.level == 1:
                own.add("fast")
            else:
                own |= {node.module.split(".")[0]} if node.module else {name.name for name in node.names}
    return own, outside - set(sys.stdlib_module_names)


@pytest.mark.parametrize("path", sorted(LIBRARY.rglob("*.py")), ids=lambda path: str(path.relative_to(LIBRARY)))
def test_import_rules(path):
    folders = {"papers": PAPER, "fast": FAST, "live": LIVE}
    own_allowed, outside_allowed = folders.get(path.parent.name) or ALLOWED[path.name]
    own, outside = imports(path)
    assert own <= own_allowed, f"{path.name} may not import {own - own_allowed}"
    assert outside <= outside_allowed, f"{path.name} may not import {outside - outside_allowed}"


def test_importing_the_package_loads_no_heavy_library():
    papers = ", ".join(f"kalman_lib.papers.{path.stem}" for path in (LIBRARY / "papers").glob("[a-z]*.py"))
    code = f"import sys, kalman_lib, {papers}; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"matplotlib", "ipywidgets", "anywidget", "traitlets", "scipy", "openpyxl", "IPython", "tqdm", "concurrent.futures"} & set(loaded)


def test_the_wheel_holds_every_module_and_the_explorers(tmp_path):
    explorers.for_notebooks()
    source = tmp_path / "source"
    shutil.copytree(LIBRARY, source / "kalman_lib", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(LIBRARY.parent / name, source)
    subprocess.run([sys.executable, "-m", "pip", "wheel", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
                    "--disable-pip-version-check", "-w", tmp_path, source], check=True)
    wheel, = tmp_path.glob("*.whl")
    needed = [*LIBRARY.rglob("*.py"), *(explorers.FOR_NOTEBOOKS / name for name in ("widget.js", "widget.css", "starts.json"))]
    assert {path.relative_to(LIBRARY.parent).as_posix() for path in needed} <= set(zipfile.ZipFile(wheel).namelist())
