"""Who may import whom (the one rule of the house), and what importing the package must not load."""

import ast
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

LIBRARY = Path(__file__).resolve().parent.parent / "kalman_lib"
NUMERICS = {"numpy"}
WITH_SCIPY = NUMERICS | {"scipy"}

# Room -> (our own rooms that it may import, packages); the standard library is free, and so are the
# files of the same room. A room is a file of kalman_lib, or one of its folders.
ALLOWED = {
    "roots": (set(), NUMERICS),
    "frozen": (set(), set()),
    "checks": ({"roots"}, NUMERICS),
    "numeric": ({"checks", "roots"}, WITH_SCIPY),
    "models": ({"checks", "frozen"}, NUMERICS),
    "metrics": ({"checks", "numeric"}, WITH_SCIPY),
    "simulate": ({"checks"}, NUMERICS),
    "filters": ({"checks", "frozen", "models", "roots", "many"}, WITH_SCIPY),
    "many": ({"models", "filters"}, NUMERICS),
    "fast": ({"checks", "models", "roots", "filters", "many"}, NUMERICS),
    "tuning": ({"checks", "models", "filters", "many", "fast", "numeric"}, WITH_SCIPY),
    "montecarlo": ({"studies"}, NUMERICS),
    "studies": ({"models", "fast"}, NUMERICS | {"tqdm"}),  # tqdm only if it is there
    "__init__": (
        {"models", "metrics", "simulate", "filters", "fast", "tuning", "montecarlo"},
        set(),
    ),
    "data": (set(), NUMERICS | {"openpyxl", "xlrd"}),
    "plots": ({"metrics", "models", "papers"}, NUMERICS | {"matplotlib", "PIL"}),
    "live": ({"data", "fast", "filters", "papers", "plots"}, NUMERICS),
    "exercises": ({"live"}, NUMERICS | {"IPython"}),  # IPython only where it runs already
    "explorer": ({"live", "papers"}, NUMERICS | {"anywidget", "traitlets", "IPython"}),
}
# A paper, whether a file or a folder: the core, and of the other papers nothing ("papers": the
# package alone)
PAPER = ({"checks", "models", "simulate", "numeric", "tuning", "papers"}, NUMERICS)


def room_of(parts):
    """The room in which kalman_lib/<parts> stands: "filters", "data", "papers/gyro", ..."""
    first = parts[0].removesuffix(".py")
    if first == "papers" and len(parts) > 1 and parts[1] != "__init__.py":
        return f"papers/{parts[1].removesuffix('.py')}"
    return first


def imports(path, library=LIBRARY):
    """(our own rooms, outside packages) that the file imports anywhere in it, other than its own
    room."""
    parts = path.relative_to(library).parts
    own, outside = set(), set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            outside |= {name.name.split(".")[0] for name in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            outside.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            folder = parts[: len(parts) - node.level]
            own |= set(rooms_named(node, folder, library))
    return own - {room_of(parts)}, outside - set(sys.stdlib_module_names)


def rooms_named(node, folder, library):
    """The rooms that a statement `from ..x import y` in a file of this folder names."""
    target = (*folder, *(node.module or "").split(".")) if node.module else folder
    for name in node.names:
        inside = library.joinpath(*target, name.name)
        is_room = inside.is_dir() or inside.with_suffix(".py").exists()
        found = (*target, name.name) if is_room else target
        if found:
            yield room_of(found)


@pytest.mark.parametrize(
    "path", sorted(LIBRARY.rglob("*.py")), ids=lambda path: str(path.relative_to(LIBRARY))
)
def test_import_rules(path):
    room = room_of(path.relative_to(LIBRARY).parts)
    is_paper = room.startswith("papers")
    own_allowed, outside_allowed = PAPER if is_paper else ALLOWED[room]
    own, outside = imports(path)
    if not is_paper:  # who may import papers may import any of them; a paper no other one
        own = {name.split("/")[0] for name in own}
    assert own <= own_allowed, f"{path.name} may not import {own - own_allowed}"
    assert outside <= outside_allowed, f"{path.name} may not import {outside - outside_allowed}"


@pytest.mark.parametrize(
    "place, statement, expected",
    [
        ("data/table.py", "from . import sheets", set()),
        ("data/table.py", "from .cells import is_gap", set()),
        ("data/table.py", "from ..models import subtract", {"models"}),
        ("plots/attitude.py", "from ..papers import quadrotor", {"papers/quadrotor"}),
        ("papers/ship.py", "from . import gyro", {"papers/gyro"}),
        ("papers/ship.py", "from .gyro import Params", {"papers/gyro"}),
        ("papers/ship.py", "from . import check", {"papers"}),
        ("papers/quadrotor/model.py", "from .. import check", {"papers"}),
        ("papers/quadrotor/model.py", "from .route import REST", set()),
        ("papers/quadrotor/model.py", "from ..gyro import Params", {"papers/gyro"}),
        ("papers/quadrotor/model.py", "from ...models import LinearModel", {"models"}),
        ("simulate.py", "from . import plots", {"plots"}),
        ("simulate.py", "from .fast.states import x", {"fast"}),
    ],
)
def test_the_rules_see_every_form_of_import(tmp_path, place, statement, expected):
    library = tmp_path / "kalman_lib"
    shutil.copytree(LIBRARY, library, ignore=shutil.ignore_patterns("__pycache__"))
    path = library / place
    path.write_text(statement)
    assert imports(path, library) == (expected, set())


def test_importing_the_package_loads_no_heavy_library():
    folders = (LIBRARY / "papers").iterdir()
    names = [path.stem for path in folders if path.stem[0] not in "_."]
    papers = ", ".join(f"kalman_lib.papers.{name}" for name in sorted(names))
    code = f"import sys, kalman_lib, kalman_lib.exercises, {papers}; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {
        "matplotlib",
        "ipywidgets",
        "anywidget",
        "traitlets",
        "scipy",
        "openpyxl",
        "xlrd",
        "IPython",
        "tqdm",
        "concurrent.futures",
    }
    assert not heavy & set(run.stdout.split())
