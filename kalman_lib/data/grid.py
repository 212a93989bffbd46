"""Text in, grid out: finds what separates the columns.

A grid is a list of (line, cells): the number of the line in the source and its cells as text; a
blank line has no cells."""

import csv
import io
import re

from .cells import is_gap, is_number, quoted, to_number
from .errors import InputError

NO_REMARK = ("", "")
CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f]")  # no text holds these


def decode(content):
    """Bytes -> text: UTF-8, UTF-16 or Windows-1252; None if it is no text at all."""
    for encoding in _encodings(content):
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        return None if CONTROL.search(text) else text
    return None


def _encodings(content):
    """Those worth a try, judged by the first two bytes."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return ["utf-16"]
    if content[1:2] == b"\0":
        return ["utf-16-le"]
    if content[:1] == b"\0":
        return ["utf-16-be"]
    return ["utf-8-sig", "cp1252"]


def split(text, decimal):
    """A text -> its grid, and a remark (en, id) on how it was understood, NO_REMARK where that is
    plain.

    decimal: the decimal sign, "," or "."; None: not known.
    """
    for separator in "\t;":
        if separator in text:
            return read_rows(text, separator), NO_REMARK
    if "," not in text:
        return _between_blanks(read_rows(text, "\t")), NO_REMARK
    if '",' in text or ',"' in text:
        return read_rows(text, ","), NO_REMARK
    return _split_at_commas(text, decimal)


def _split_at_commas(text, decimal):
    """A text in which a comma separates either columns or the decimals."""
    columns = read_rows(text, ",")
    whole = _between_blanks(read_rows(text, "\t"))
    if decimal == ",":
        return whole, NO_REMARK
    if not any(is_number(cell) for cell in _first_cells(columns) + _first_cells(whole)):
        has_columns = len(_first_cells(columns)) > 1  # the header decides
        return (columns if has_columns else whole), NO_REMARK
    if ", " in text or not all(is_number(cell) or is_gap(cell) for cell in _all_cells(whole)):
        return columns, NO_REMARK
    if not _is_even(columns):
        return whole, NO_REMARK
    if decimal == ".":
        return columns, NO_REMARK
    return whole, _read_as_decimals(whole)


def _read_as_decimals(whole):
    """The remark that the commas were taken for decimal ones; InputError where that is not
    certain."""
    line, cell = next((line, cell) for line, cells in whole for cell in cells if "," in cell)
    if any(to_number(other, ",") is None for other in _all_cells(whole)):
        raise InputError(
            f"Line {line}, {quoted(cell)}: the comma may separate thousands or columns; add a "
            "header line, use semicolons between columns, or choose the decimal sign.",
            f"Baris {line}, {quoted(cell)}: koma dapat memisahkan ribuan atau kolom; tambahkan "
            "baris judul, pisahkan kolom dengan titik koma, atau pilih tanda desimal.",
        )
    return (
        f"; {quoted(cell)} was read as one number with decimal comma, not as columns",
        f"; {quoted(cell)} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom",
    )


def _all_cells(grid):
    return [cell for _, cells in grid for cell in cells]


def _first_cells(grid):
    """The cells of the first line that is not blank."""
    return next((cells for _, cells in grid if cells), [])


def read_rows(text, separator):
    """A text -> its grid, the cells between these separators."""
    reader = csv.reader(
        io.StringIO(text, newline=None),
        delimiter=separator,
        skipinitialspace=separator != "\t",
        strict=True,
    )
    grid = []
    for row in reader:
        cells = [cell.strip() for cell in row]
        grid.append((reader.line_num, cells if any(cells) else []))
    return grid


def _between_blanks(grid):
    """The cells between blanks, or between two and more where single ones are part of a name."""
    single = _cut(grid, r"\s+")
    several = _cut(grid, r"\s\s+")
    if _is_even(single) or not _is_even(several):
        return single
    return several if any(is_number(cell) for cell in _all_cells(several)) else single


def _cut(grid, blanks):
    return [(line, re.split(blanks, cells[0]) if cells else []) for line, cells in grid]


def _is_even(grid):
    """Have all lines as many cells?"""
    return len({len(cells) for _, cells in grid if cells}) <= 1
