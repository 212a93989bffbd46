"""Every file is a room one can overlook: short lines, short functions, short files.

Who may import whom is held by test_imports.py, names and statements by ruff (`make lint`).
"""

import ast
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
LINE, CODE_CELL_LINE = 100, 76  # characters
CODE_CELL, FUNCTION, FILE = 12, 40, 300  # lines
CORE = ("models.py", "filters.py", "simulate.py", "metrics.py", "tuning.py")
CORE_LINES = 900  # together: what a reader of all chapters may have to read


def name_of(path):
    return path.relative_to(ROOT).as_posix()


def python_files():
    """The Python files of the book, in all its folders."""
    found = []
    for folder in ("kalman_lib", "book", "tests", "notebooks"):
        found += (ROOT / folder).rglob("*.py")
    return sorted(path for path in found if "node_modules" not in path.parts)


FILES = python_files()
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
each_file = pytest.mark.parametrize("path", FILES, ids=name_of)


def functions(tree):
    """Every function and method, also those inside others."""
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return [node for node in ast.walk(tree) if isinstance(node, kinds)]


@each_file
def test_a_file_is_short(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= FILE, f"{name_of(path)} has {len(lines)} lines: make two rooms of it"


def test_the_core_is_small():
    paths = [ROOT / "kalman_lib" / name for name in CORE]
    lines = {path.name: len(path.read_text(encoding="utf-8").splitlines()) for path in paths}
    total = sum(lines.values())
    assert total <= CORE_LINES, f"{total} lines: what is not core moves to another room: {lines}"


@each_file
def test_lines_are_short(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    long = [number for number, line in enumerate(lines, start=1) if len(line) > LINE]
    assert not long, f"{name_of(path)}, lines {long}: at most {LINE} characters"


@each_file
def test_a_function_is_short(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    lengths = {node.name: node.end_lineno - node.lineno + 1 for node in functions(tree)}
    long = {name: length for name, length in lengths.items() if length > FUNCTION}
    assert not long, f"{name_of(path)}: give its steps names, at most {FUNCTION} lines: {long}"


@each_file
def test_no_condition_stands_inside_another(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    outer = [node for node in ast.walk(tree) if isinstance(node, ast.IfExp)]
    nested = [
        node.lineno
        for node in outer
        if any(isinstance(part, ast.IfExp) for part in ast.walk(node) if part is not node)
    ]
    assert not nested, f"{name_of(path)}, lines {nested}: write 'a if b else c' once, or use if"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=name_of)
def test_code_cells_fit_a_narrow_page(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    for number, cell in enumerate(cells, start=1):
        if cell["cell_type"] != "code":
            continue
        lines = "".join(cell["source"]).splitlines()
        widest = max((len(line) for line in lines), default=0)
        place = f"{name_of(path)}, cell {number}"
        assert len(lines) <= CODE_CELL, f"{place}: {len(lines)} lines"
        assert widest <= CODE_CELL_LINE, f"{place}: {widest} characters in a line"
