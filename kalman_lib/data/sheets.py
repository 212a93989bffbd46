"""The bytes of an Excel workbook in, grids out."""

import io
import warnings

from openpyxl import load_workbook

from .cells import is_number
from .errors import InputError


def grids(name, content, skip=()):
    """Yields (title, grid, number of sheets) of each sheet with numbers, without those in skip."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # openpyxl warns of decorations that it cannot keep
            results = _sheets(content, data_only=True)
            formulas = _sheets(content, data_only=False)
            for sheet, formula_sheet in zip(results, formulas):
                if sheet.title in skip:
                    continue
                grid = _grid(sheet, formula_sheet)
                if any(is_number(cell) for _, cells in grid for cell in cells):
                    yield sheet.title, grid, len(results)
    except InputError:
        raise
    except Exception as error:  # a damaged file breaks openpyxl in many ways
        raise unreadable(name) from error


def unreadable(name):
    """The InputError for a file of another kind."""
    shown = repr(name[:60])
    return InputError(
        f"{shown} is not a text (.csv, .txt, .tsv) or Excel .xlsx file; save it as one of these.",
        f"{shown} bukan berkas teks (.csv, .txt, .tsv) atau Excel .xlsx; simpanlah sebagai itu.",
    )


def _sheets(content, data_only):
    return load_workbook(io.BytesIO(content), read_only=True, data_only=data_only).worksheets


def _grid(sheet, formula_sheet):
    """The grid of a sheet, all its rows equally wide."""
    sheet.reset_dimensions()  # which may be wrong in the file
    formula_sheet.reset_dimensions()
    grid = []
    for line, rows in enumerate(zip(sheet.iter_rows(), formula_sheet.iter_rows()), start=1):
        cells = [_content(sheet, cell, formula) for cell, formula in zip(*rows)]
        grid.append((line, cells if any(cell != "" for cell in cells) else []))
    width = max((len(cells) for _, cells in grid), default=0)
    return [(line, _widened(cells, width)) for line, cells in grid]


def _widened(cells, width):
    """The cells of a row, followed by empty ones; a blank row stays without cells."""
    return cells + [""] * (width - len(cells)) if cells else []


def _content(sheet, cell, formula):
    """A number as a float, anything else as text; InputError: a formula whose result is not
    stored."""
    if cell.value is None and formula.data_type == "f" and cell.data_type == "n":
        place = formula.coordinate
        raise InputError(
            f"Cell {place} of sheet {sheet.title!r} holds a formula that was never calculated; "
            "open and save the file once in Excel or LibreOffice.",
            f"Sel {place} di lembar {sheet.title!r} berisi rumus yang belum pernah dihitung; "
            "buka dan simpan berkas itu sekali di Excel atau LibreOffice.",
        )
    if cell.value is None:
        return ""
    if type(cell.value) in (int, float):
        return float(cell.value)
    return str(cell.value).strip()
