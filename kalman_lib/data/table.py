"""A reader's table in: pasted text, .csv, .txt, .tsv or .xlsx -> Table."""

import csv
import re
from dataclasses import dataclass

import numpy as np

from . import sheets
from .cells import is_gap, is_number, quoted, to_number
from .errors import InputError
from .grid import NO_REMARK, decode, split

MAX_READ = 200_000  # rows
MAX_NUMBER = 1e300
MAX_LISTED = 5  # names of columns in a sentence


@dataclass(frozen=True, eq=False)
class Table:
    """What was read.

    columns   {name: float array (T,), NaN = gap}, in the units of the source
    lines     (T,) the line or row of each in the source
    skipped   names of columns without a number (dates, labels)
    decimal   "," or "."; None: no number had one
    note_en, note_id    one sentence that says what was understood
    """

    columns: dict
    lines: np.ndarray
    skipped: tuple
    decimal: str | None
    note_en: str
    note_id: str


def read_text(text, decimal=None):
    """A pasted text or CSV -> Table. decimal is its decimal sign, "," or "."; None: find out.

    Separators: tab, semicolon, comma or blanks. A line "1,5" without header is one number unless
    decimal=".". InputError: no numbers, ragged rows, a word among numbers, or a text that can be
    read in two ways."""
    if decimal not in (None, ",", "."):
        raise ValueError('decimal must be ",", "." or None. / decimal harus ",", "." atau None.')
    try:
        grid, remark = split(text.removeprefix("\ufeff"), decimal)
    except csv.Error as error:
        raise InputError(
            f"The quotation marks in the text do not pair up ({error}).",
            f"Tanda kutip dalam teks tidak berpasangan ({error}).",
        ) from None
    return _table_of(grid, decimal, remark)


def read_file(name, content, decimal=None):
    """The bytes of a .csv, .txt, .tsv or .xlsx file -> Table; of an .xlsx the first sheet with
    numbers.

    InputError: another kind of file, a formula without its result, and whatever read_text refuses.
    """
    suffix = name.lower().rpartition(".")[2]
    if suffix == "xlsx" and content.startswith(b"PK"):
        return _first_sheet(name, content, decimal)
    text = decode(content) if suffix in ("csv", "txt", "tsv") else None
    if text is None:
        raise sheets.unreadable(name)
    return read_text(text, decimal)


def _first_sheet(name, content, decimal):
    for title, grid, count in sheets.grids(name, content):
        chosen = (f"; sheet: {title}", f"; lembar: {title}")
        return _table_of(grid, decimal, chosen if count > 1 else NO_REMARK)
    return _table_of([], decimal, NO_REMARK)


def read_sheets(name, content, skip=()):
    """The bytes of an .xlsx file -> {title: Table} of its sheets with numbers, without those in
    skip.

    InputError as read_file.
    """
    found = sheets.grids(name, content, skip)
    return {title: _table_of(grid, None, NO_REMARK) for title, grid, _ in found}


# --- grid -> Table ------------------------------------------------------------------------------


def _table_of(grid, decimal, remark):
    """The Table of a grid; remark (en, id): how the grid was found."""
    grid = _trimmed(grid)
    if len(grid) - 1 > MAX_READ:  # one line may be the header
        raise too_long(len(grid), MAX_READ)
    columns = _columns_of(grid)
    has_header = _has_header(columns)
    rows = grid[1:] if has_header else grid
    heads = [cells[0] if has_header else "" for cells in columns]
    lines = np.array([line for line, _ in rows], dtype=int)
    sign, sign_remark = _decimal_sign(rows, decimal)
    numbers, skipped = {}, []
    for name, column in zip(_unique(heads), columns):
        cells = column[1:] if has_header else column
        values = [to_number(cell, sign or ".") for cell in cells]
        if any(value is not None and not np.isnan(value) for value in values):
            numbers[name] = _checked(name, values, cells, lines)
        elif any(column):
            skipped.append(name)
    if not numbers:
        raise InputError(
            "There is no column of numbers in it.", "Tidak ada kolom bilangan di dalamnya."
        )
    if len(lines) > MAX_READ:
        raise too_long(len(lines), MAX_READ)
    note_en, note_id = _note(numbers, len(lines), skipped, sign, sign_remark, remark)
    return Table(numbers, lines, tuple(skipped), sign, note_en, note_id)


def too_long(rows, limit):
    """The InputError for more rows than the limit."""
    return InputError(
        f"{rows} rows are too many; the limit is {limit}.",
        f"{rows} baris terlalu banyak; batasnya {limit}.",
    )


def _trimmed(grid):
    """The grid without the blank lines before and after."""
    filled = [k for k, (_, cells) in enumerate(grid) if cells]
    return grid[filled[0] : filled[-1] + 1] if filled else []


def _columns_of(grid):
    """The columns of cells; a blank line is a gap in each. InputError: ragged rows."""
    width = len(grid[0][1]) if grid else 0
    for line, cells in grid:
        if cells and len(cells) != width:
            raise InputError(
                f"Line {line} has not as many cells ({len(cells)}) as the first line ({width}).",
                f"Banyaknya sel di baris {line} ({len(cells)}) tidak sama dengan baris pertama "
                f"({width}).",
            )
    gaps = [""] * width
    return list(zip(*(cells or gaps for _, cells in grid)))


def _has_header(columns):
    """Is the first line one of names: no number in it, and a letter above a column of numbers?"""
    if any(is_number(column[0]) for column in columns):
        return False
    return any(
        not is_gap(column[0])
        and re.search(r"[^\W\d_]", column[0])
        and any(is_number(cell) for cell in column)
        for column in columns
    )


def _note(numbers, rows, skipped, sign, sign_remark, remark):
    """What was understood, in one sentence (en, id)."""
    gaps = sum(int(np.isnan(values).sum()) for values in numbers.values())
    signs = {",": ("comma", "koma"), ".": ("point", "titik"), None: ("none", "tidak ada")}
    sign_en, sign_id = signs[sign]
    count = f"{len(numbers)} ({_listed(numbers)})"
    en = f"Rows: {rows}; columns: {count}; gaps: {gaps}; decimal sign: {sign_en}"
    id = f"Baris: {rows}; kolom: {count}; sel kosong: {gaps}; tanda desimal: {sign_id}"
    if skipped:
        en += f"; left out, no numbers: {_listed(skipped)}"
        id += f"; tidak dipakai, tanpa bilangan: {_listed(skipped)}"
    return en + sign_remark[0] + remark[0] + ".", id + sign_remark[1] + remark[1] + "."


def _listed(names):
    shown = ", ".join(name[:40] for name in list(names)[:MAX_LISTED])
    return shown + ", ..." if len(names) > MAX_LISTED else shown


def _unique(names):
    """The names, none of them empty or twice."""
    result = []
    for position, name in enumerate(names, start=1):
        base = " ".join(str(name).split()) or str(position)
        name = base
        count = 1
        while name in result:
            count += 1
            name = f"{base} ({count})"
        result.append(name)
    return result


def _checked(name, values, cells, lines):
    """The values as an array; InputError where a cell is no number or one beyond all sense."""
    for value, cell, line in zip(values, cells, lines):
        if value is None:
            en, id = "neither a number nor a gap", "bukan bilangan dan bukan sel kosong"
        elif abs(value) > MAX_NUMBER:
            en = f"too large (beyond {MAX_NUMBER:g})"
            id = f"terlalu besar (di atas {MAX_NUMBER:g})"
        else:
            continue
        raise InputError(
            f"Line {line}, column {quoted(name)}: {quoted(cell)} is {en}.",
            f"Baris {line}, kolom {quoted(name)}: {quoted(cell)} {id}.",
        )
    return np.array(values, dtype=float)


# --- the decimal sign ---------------------------------------------------------------------------


def _decimal_sign(rows, decimal):
    """The decimal sign of the rows, None if no number has one, and a remark (en, id)."""
    proof, maybe = _signs_in(rows)
    found = proof or maybe
    if not found:
        return None, NO_REMARK
    if decimal:
        return decimal, NO_REMARK
    if len(found) == 2:
        raise _both_signs(*found["."], *found[","])
    ((sign, (_, cell)),) = found.items()
    if proof:
        return sign, NO_REMARK
    return sign, (
        f" ({quoted(cell)} was read as a decimal, not as thousands)",
        f" ({quoted(cell)} dibaca sebagai desimal, bukan ribuan)",
    )


def _signs_in(rows):
    """Two dicts {sign: the first (line, cell)}: cells that only this sign explains, or also this
    one."""
    proof, maybe = {}, {}
    for line, cells in rows:
        for cell in cells:
            if not isinstance(cell, str) or not ("," in cell or "." in cell):
                continue
            readings = [sign for sign in ",." if to_number(cell, sign) is not None]
            if len(readings) == 1:
                proof.setdefault(readings[0], (line, cell))
            elif readings:
                maybe.setdefault("," if "," in cell else ".", (line, cell))
    return proof, maybe


def _both_signs(line, cell, other_line, other):
    return InputError(
        f"Both decimal point and comma occur: {quoted(cell)} in line {line}, {quoted(other)} in "
        f"line {other_line}; use one, or choose the decimal sign.",
        f"Ada titik dan koma desimal: {quoted(cell)} di baris {line}, {quoted(other)} di baris "
        f"{other_line}; pakailah satu saja, atau pilih tanda desimal.",
    )
