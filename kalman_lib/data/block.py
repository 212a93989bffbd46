"""The table in a grid: the longest run of rows with numbers, its header, and what lies around.

A grid is a list of (line, cells); a blank line has no cells.
"""

import re
from dataclasses import dataclass, field

from .cells import has_letter, is_gap, is_value, quoted, shown
from .errors import InputError
from .units import AGGREGATES, is_unit

SUMMARIES = {
    "rata-rata",
    "rerata",
    "mean",
    "average",
    "avg",
    "total",
    "jumlah",
    "sum",
    "max",
    "min",
}
SUMMARIES |= {"maksimum", "minimum", "median", "std", "sd", "simpangan baku"}


@dataclass
class Block:
    """A table without its surroundings: rows [(line, cells)], names and units of the header (empty
    texts where there are none), lines that were passed over."""

    rows: list
    names: list
    units: list
    passed: list = field(default_factory=list)
    has_header: bool = False


def find(grid):
    """The Block of a grid, None if there is no number. InputError: the numbers are interrupted."""
    run = longest_run(grid)
    if run is None:
        return None
    start, stop = run
    check_whole(grid, start, stop)
    width = len(grid[start][1])
    head, units, start = header_of(grid, start, stop)
    names = _fitted(grid[head][1], width) if head is not None else [""] * width
    given = _fitted(grid[units][1], width) if units is not None else [""] * width
    used = {head, units, *range(start, stop)}
    passed = [line for k, (line, cells) in enumerate(grid) if cells and k not in used]
    names = [_plain(name) for name in names]
    return Block(
        grid[start:stop], names, [_plain_unit(one) for one in given], passed, head is not None
    )


def _plain(name):
    return " ".join(shown(name).lstrip("# ").split())


def _plain_unit(text):
    return shown(text).strip().strip("()[]").strip()


def _fitted(cells, width):
    """The cells of a header over so many columns; R leaves out the name of the first one."""
    if len(cells) == width - 1:
        return ["", *cells]
    return [*cells[:width], *[""] * (width - len(cells))]


# --- the run ------------------------------------------------------------------------------------


def holds_numbers(cells):
    """Is it a row of data: some number or time, and no sum or mean below a table?"""
    if isinstance(cells[0], str) and cells[0].lower().rstrip(":") in SUMMARIES:
        return False
    return any(is_value(cell) for cell in cells)


def longest_run(grid):
    """(start, stop) of the consecutive rows of equal width with most numbers; None: no number."""
    best, most = None, 0
    start = stop = rows = 0
    places = []  # of the numbers in the first row
    width = None
    for k, (_, cells) in enumerate(grid):
        if not cells:
            continue
        has_numbers = holds_numbers(cells)
        if len(cells) != width or not (has_numbers or _are_gaps(cells, places)):
            width, rows = None, 0
        if not has_numbers:
            continue  # gaps belong to the run if numbers follow
        if not rows:
            width, start = len(cells), k
            places = [at for at, cell in enumerate(cells) if is_value(cell)]
        rows, stop = rows + 1, k + 1
        if rows * len(places) > most:
            best, most = (start, stop), rows * len(places)
    return _with_gaps(grid, best)


def _are_gaps(cells, places):
    return all(is_gap(cells[at]) for at in places)


def _with_gaps(grid, run):
    """Rows of nothing but gaps directly above and below belong to the run, too."""
    if run is None:
        return None
    start, stop = run
    width = len(grid[start][1])
    while start > 0 and len(grid[start - 1][1]) == width and all(map(is_gap, grid[start - 1][1])):
        start -= 1
    while stop < len(grid) and len(grid[stop][1]) == width and all(map(is_gap, grid[stop][1])):
        stop += 1
    return start, stop


def check_whole(grid, start, stop):
    """InputError if more of the table stands outside the run: a word or an odd row parts it."""
    width = len(grid[start][1])
    others = [*range(start), *range(stop, len(grid))]
    for k in others:
        cells = grid[k][1]
        if len(cells) == width and _is_all_numbers(cells):
            raise _interrupted(grid, min(k, start), max(k, stop - 1), width)
    k = stop
    while k < len(grid) and len(grid[k][1]) == width and not _is_like(grid[k][1], grid[start][1]):
        k += 1
    if k < len(grid) and len(grid[k][1]) == width:
        raise _interrupted(grid, stop, k, width)
    _check_neighbours(grid, start, stop, width)


def _is_like(cells, first):
    """Are there numbers where they are in the first row, and words where words are?"""
    return holds_numbers(cells) and list(map(is_value, cells)) == list(map(is_value, first))


def _is_all_numbers(cells):
    return all(is_gap(cell) or is_value(cell) for cell in cells) and holds_numbers(cells)


def _interrupted(grid, first, last, width):
    for line, cells in grid[first:last]:
        if cells and len(cells) != width:
            return odd_row(line, len(cells), width)
        for column, cell in enumerate(cells, start=1):
            if not is_gap(cell) and not is_value(cell):
                return no_number(line, str(column), cell)
    line, cells = grid[last]
    return no_number(line, "1", cells[0])


def no_number(line, name, cell):
    return InputError(
        f"Line {line}, column {quoted(name)}: {quoted(cell)} is neither a number nor a gap.",
        f"Baris {line}, kolom {quoted(name)}: {quoted(cell)} bukan bilangan dan bukan sel kosong.",
    )


def odd_row(line, cells, width):
    return InputError(
        f"Line {line} has not as many cells ({cells}) as the first line ({width}).",
        f"Banyaknya sel di baris {line} ({cells}) tidak sama dengan baris pertama ({width}).",
    )


def _check_neighbours(grid, start, stop, width):
    """A row of numbers beside the run that is wider or narrower; a single word below a column."""
    first = start
    while first > 0 and grid[first - 1][1] and _is_all_numbers(grid[first - 1][1]):
        first -= 1
    below = grid[stop][1] if stop < len(grid) else []
    reach = stop + 1 if below and _is_all_numbers(below) else stop
    first_width = len(grid[first][1])
    for line, cells in grid[first:reach]:
        if cells and len(cells) != first_width:
            raise odd_row(line, len(cells), first_width)
    above = grid[start - 1][1] if start > 0 else []
    if len(above) == width and _are_digits(above):
        line = grid[start - 1][0]
        raise no_number(line, "1", next(cell for cell in above if not is_gap(cell)))
    if width == 1 and len(below) == 1 and (_is_cell(shown(below[0])) or _are_digits(below)):
        head, _, _ = header_of(grid, start, stop)
        name = shown(grid[head][1][0]) if head is not None else "1"
        raise no_number(grid[stop][0], name, below[0])


def _is_cell(text):
    """A single word or a formula: no remark below a table."""
    return len(text.split()) == 1 or text.startswith("=")


def _are_digits(cells):
    """Digits, and no letter: no title."""
    has_digit = any(sign.isdecimal() for cell in cells for sign in shown(cell))
    return has_digit and not any(map(has_letter, cells))


# --- the header ---------------------------------------------------------------------------------


def header_of(grid, start, stop):
    """(row of the names or None, row of the units or None, first row of the numbers)."""
    width = len(grid[start][1])
    if _names_the_next(grid, start, stop):
        return start, None, start + 1
    above = [k for k in range(max(0, start - 10), start) if grid[k][1]]
    while above and _all_in(grid[above[-1]][1], AGGREGATES):
        above.pop()
    if not above or not is_header(grid[above[-1]][1], width):
        return None, None, start
    has_two = len(above) > 1 and is_header(grid[above[-2]][1], width)
    if has_two and _are_units(grid[above[-1]][1]):
        return above[-2], above[-1], start
    return above[-1], None, start


def _names_the_next(grid, start, stop):
    """Is the first row of the run one of names, some of which are numbers: t, 1, 2?"""
    rows = [cells for _, cells in grid[start:stop] if cells][:20]
    if len(rows) < 2:
        return False
    return any(
        has_letter(column[0]) and not is_value(column[0]) and _are_numbers(column[1:])
        for column in zip(*rows)
    )


def _are_numbers(cells):
    return any(map(is_value, cells)) and all(is_value(cell) or is_gap(cell) for cell in cells)


def is_header(cells, width):
    """Can this row name so many columns?"""
    if not any(has_letter(cell) and not is_gap(cell) for cell in cells):
        return False
    filled = sum(cell != "" for cell in cells)
    if width == 1:
        return len(cells) == 1
    if len(cells) == width - 1:
        return width > 2 and filled == len(cells)
    return len(cells) >= width and (filled > 1 or cells[0] == "")


def _are_units(cells):
    texts = [_plain_unit(cell) for cell in cells]
    is_known = all(
        text in ("", "-") or is_unit(text) or _in_brackets(cell) for text, cell in zip(texts, cells)
    )
    return is_known and any(text not in ("", "-") for text in texts)


def _in_brackets(cell):
    return bool(re.fullmatch(r"[(\[][^()\[\]]{0,20}[)\]]", shown(cell)))


def _all_in(cells, words):
    texts = [shown(cell).lower() for cell in cells if cell != ""]
    return bool(texts) and all(text in words for text in texts)
