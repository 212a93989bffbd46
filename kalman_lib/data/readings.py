"""Which way of parting the lines of a text is right? Each gives a grid; the best one wins.

A good one leaves the longest table, with a header that fits, and no cell in which a number hides
among other things ("10:00 21" beside "5": the comma was a decimal one).
"""

import re
from typing import NamedTuple

from .block import header_of, longest_run
from .cells import is_gap, is_number, is_value, number_in, quoted, to_number
from .errors import InputError
from .units import is_unit

NO_REMARK = None
ONE_SIGN = ("tab", "semicolon")
THREE_DIGITS = re.compile(r"0[0-9]{2}([.,][0-9]*)?")
TIGHT_COMMA = re.compile(r"[0-9],[0-9]")
LONGEST = 200  # characters of a cell in which numbers may hide


class Reading(NamedTuple):
    """A way to part the lines, and how well it goes; larger is better."""

    name: str
    rows: list  # those of the table
    lines: list  # of these rows
    header: list  # the cells of the row above, or none
    whole: int  # rows without two numbers in one cell
    fits: bool  # is there a header, as wide as the table?
    plain: int  # minus: cells in which a number stands beside words
    words: int  # minus: cells of words

    def score(self):
        return self.whole, self.fits, self.plain, self.words


def best_of(ways, decimal):
    """(name of the best way, remark {en, id} or NO_REMARK); ways: {name: grid}."""
    found = [_weighed(name, grid, decimal) for name, grid in ways.items()]
    readings = {one.name: one for one in found if one is not None}
    if not readings:
        return next(iter(ways)), NO_REMARK
    for name in ONE_SIGN:
        if name in readings and len(readings[name].rows[0]) == 1 and len(readings) > 1:
            del readings[name]  # that sign stands elsewhere in the text
    best = max(readings.values(), key=Reading.score)  # of equal ones the first
    return _between_commas(best, readings, decimal)


def _weighed(name, grid, decimal):
    """The Reading of a grid, None if it cannot be meant."""
    run = longest_run(grid)
    if run is None:
        return None
    start, stop = run
    rows = [cells for _, cells in grid[start:stop] if cells]
    if not _is_possible(name, rows, decimal):
        return None
    head, _, first = header_of(grid, start, stop)
    header = grid[head][1] if head is not None else []
    body = rows[1:] if first > start else rows
    lines = [line for line, cells in grid[start:stop] if cells][-len(body) :]
    words = [cell for row in body for cell in row if not is_gap(cell) and not is_value(cell)]
    crowded = sum(any(map(_holds_two, row)) for row in body)
    if name in ("comma", "comma and blank"):  # thousands are not parted by blanks there
        crowded += sum(any(" " in cell and is_number(cell) for cell in row) for row in body)
    beside = sum(map(_holds_one, words))
    if name == "blank":  # 1 000, not 1 and 0
        beside += sum(bool(THREE_DIGITS.fullmatch(cell)) for row in body for cell in row[1:])
    fits = len(header) == len(rows[0]) and _is_name(name, header)
    return Reading(name, body, lines, header, len(rows) - crowded, fits, -beside, -len(words))


def _is_possible(name, rows, decimal):
    if name == "lines":
        return not decimal or all(_is_read(row[0], decimal) for row in rows)
    if name == "comma and blank":
        cells = [cell for row in rows for cell in row]
        has_decimals = any(TIGHT_COMMA.search(cell[:LONGEST]) for cell in cells)
        is_read = all(is_value(cell) or is_gap(cell) for cell in cells)
        return decimal != "." and has_decimals and is_read and len(rows[0]) > 1
    if name == "comma" and decimal == ",":
        return any("," in cell for row in rows for cell in row)  # between quotation marks
    return True


def _is_read(cell, decimal):
    """Is the cell understood with this decimal sign?"""
    return not is_number(cell) or number_in(cell, decimal)[0] is not None


def _is_name(name, header):
    """A comma in the name of a single column stands before its unit."""
    if name != "lines" or "," not in header[0]:
        return True
    return is_unit(header[0].rpartition(",")[2].strip())


def _holds_two(cell):
    """ "10:00 21", "0;1": two values in a cell that is neither."""
    if is_value(cell) or len(cell) > LONGEST:
        return False
    words = cell.replace(";", " ").replace("\t", " ").split()
    return len(words) > 1 and is_value(words[0]) and is_value(words[-1])


def _holds_one(cell):
    """ "A 21", "Sensor 1": a value beside words; "10:00,21": not parted."""
    words = cell[:LONGEST].split()
    beside = len(words) > 1 and (is_value(words[0]) or is_value(words[-1]))
    return beside or bool(TIGHT_COMMA.search(cell[:LONGEST]))


# --- a comma between two digits: of columns or of decimals? -------------------------------------


def _between_commas(best, readings, decimal):
    """The best reading, unless commas may as well be decimal ones; then the remark says so."""
    if best.name == "comma and blank":
        return best.name, _remark(best)
    if best.name == "comma" and not decimal and not best.fits and _are_open(best.rows):
        raise _either(best.lines[0], ",".join(best.rows[0]))
    comma, lines = readings.get("comma"), readings.get("lines")
    if best.name not in ("comma", "lines") or not comma or not lines or decimal:
        return best.name, NO_REMARK
    is_open = comma.score()[:3] == lines.score()[:3] and len(comma.rows[0]) > 1
    if not is_open or not any("," in row[0] for row in lines.rows):
        return best.name, NO_REMARK
    return "lines", _remark(lines)


def _are_open(rows):
    """Times and two whole numbers: 10:00,21,5 may end with 21.5."""
    return all(
        len(row) == 3 and not is_number(row[0]) and row[1].isdecimal() and row[2].isdecimal()
        for row in rows
    )


def _remark(reading):
    """That commas were taken for decimal ones; InputError where that is not certain."""
    cells = [cell for row in reading.rows for cell in row]
    places = [(line, cell) for line, row in zip(reading.lines, reading.rows) for cell in row]
    line, cell = next((line, cell) for line, cell in places if "," in cell)
    shown = quoted(cell)
    if any(to_number(cell, ",") is None and is_number(cell) for cell in cells):
        raise _either(line, cell)
    return {
        "en": f"{shown} was read as one number with decimal comma, not as columns",
        "id": f"{shown} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom",
    }


def _either(line, cell):
    shown = quoted(cell)
    return InputError(
        f"Line {line}, {shown}: the comma may separate thousands or columns; add a header "
        "line, use semicolons between columns, or choose the decimal sign.",
        f"Baris {line}, {shown}: koma dapat memisahkan ribuan atau kolom; tambahkan baris "
        "judul, pisahkan kolom dengan titik koma, atau pilih tanda desimal.",
    )
