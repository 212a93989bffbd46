"""Text in, grid out: finds what separates the columns.

A grid is a list of (line, cells): the number of the line in the source and its cells as text; a
blank line has no cells. Every way to part the lines is tried on the first of them (readings.py
weighs the results); the best one parts the whole text.
"""

import csv
import io
import re

from .errors import InputError
from .limits import MAX_CELLS, MAX_READ, too_long, too_many_cells
from .readings import NO_REMARK, best_of

TRIED_LINES = 500  # tell how the columns are separated
TRIED_SIGNS = 200_000
AROUND = 1000  # lines of text around a table
CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f]")  # no text holds these
TIGHT_COMMA = re.compile(r"[0-9],[0-9]")
NAMED_DAY = re.compile(r"\b([0-9]{1,2}) ([A-Za-z]{3,9}) ([0-9]{4})\b")
HALF_OF_DAY = re.compile(r"([0-9]) ([AaPp]\.?[Mm]\b)")


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
    """A text -> its grid, and a remark {en, id} on how it was understood, NO_REMARK where that is
    plain.

    decimal: the decimal sign, "," or "."; None: not known.
    """
    lines = text.count("\n") + 1
    if lines > MAX_READ + AROUND:
        raise too_long(lines)
    sample = "\n".join(text[:TRIED_SIGNS].split("\n")[:TRIED_LINES])
    ways = _tried(sample)
    if not ways:
        return _part(text, "lines"), NO_REMARK
    name, remark = best_of(ways, decimal)
    sign = {"tab": "\t", "semicolon": ";", "comma": ",", "comma and blank": ", "}.get(name, " ")
    cells = text.count(sign) + lines
    if name not in ("lines", "two blanks", "blank") and cells > MAX_CELLS:
        raise too_many_cells(cells)
    return _part(text, name), remark


def _tried(sample):
    """{name: grid} of the ways that part the sample without trouble."""
    found = {}
    for name in _ways(sample):
        try:
            found[name] = _part(sample, name, strict=False)
        except InputError:
            continue
    return found


def _ways(sample):
    """How the lines may be parted, the likeliest first."""
    ways = []
    if "\t" in sample:
        ways.append("tab")
    if ";" in sample:
        ways.append("semicolon")
    if ", " in sample and TIGHT_COMMA.search(sample):
        ways.append("comma and blank")
    if "," in sample:
        ways.append("comma")
    return [*ways, "two blanks", "blank", "lines"]


def _part(text, name, strict=True):
    """The grid of a text, parted in one of these ways."""
    signs = {"tab": "\t", "semicolon": ";", "comma": ","}
    if name in signs:
        return read_rows(text, signs[name], strict)
    grid = read_rows(text, "\t", strict)
    if name == "lines":
        return grid
    if name == "comma and blank":
        return _cut(grid, ", +")
    grid = [(line, [_glued(cells[0])] if cells else []) for line, cells in grid]
    return _cut(grid, r"\s\s+" if name == "two blanks" else r"[^\S\u00a0\u202f\u2009]+")


def _glued(text):
    """One word of "1 Mei 2024", of "10:00 PM" and of "# t"."""
    text = NAMED_DAY.sub(r"\1-\2-\3", HALF_OF_DAY.sub(r"\1\2", text))
    return "#" + text[1:].lstrip() if text.startswith("#") else text


def _cut(grid, blanks):
    """The cells between these blanks; InputError if they are too many."""
    between, result, total = re.compile(blanks), [], 0
    for line, cells in grid:
        parts = between.split(cells[0]) if cells else []
        total += len(parts)
        if total > MAX_CELLS:
            raise too_many_cells(total)
        result.append((line, parts))
    return result


def read_rows(text, separator, strict=True):
    """A text -> its grid, the cells between these separators."""
    reader = csv.reader(
        io.StringIO(text, newline=None),
        delimiter=separator,
        skipinitialspace=separator != "\t",
        strict=strict,
    )
    grid, total = [], 0
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            grid.append((reader.line_num, cells if any(cells) else []))
            total += len(cells)
            if total > MAX_CELLS:
                raise too_many_cells(total)
    except csv.Error as error:
        is_long = "larger" in str(error)
        raise _too_long_cell(reader.line_num) if is_long else _unpaired(reader.line_num) from None
    return grid


def _too_long_cell(line):
    return InputError(
        f"Line {line}: a cell is too long; no column can be told apart.",
        f"Baris {line}: sebuah sel terlalu panjang; kolomnya tidak dapat dibedakan.",
    )


def _unpaired(line):
    return InputError(
        f"The quotation marks do not pair up (line {line}).",
        f"Tanda kutip tidak berpasangan (baris {line}).",
    )


__all__ = ["NO_REMARK", "decode", "read_rows", "split"]
