"""A Block -> the columns of a Table: numbers, dates and clock times as seconds, notes."""

import re

import numpy as np

from . import clock, decimals
from .block import no_number
from .cells import has_letter, is_gap, is_value, number_in, quoted, shown, to_number
from .errors import InputError
from .limits import MAX_COLUMNS, MAX_NUMBER, too_wide
from .units import CLOCK_WORDS, canonical, unit_of, words_of

QUICK = re.compile(r"[0-9.,+\-eE\n]*")  # nothing but plain numbers and empty cells
DATE = re.compile("[0-9]-[0-9]")
NUMBERS, MOMENTS, DOTTED, WORDS, EMPTY = "numbers", "moments", "dotted", "words", "empty"


class Column:
    """A column on its way: what stands in it, and what it turns out to be."""

    def __init__(self, place, head, given, cells):
        self.place = place
        self.head = head
        self.cells = cells
        self.moments = moments_in(cells)
        self.kind = MOMENTS if self.moments else kind_of(cells, head)
        self.values = None
        self.unit = canonical(given) if given else unit_of(head)


def columns_of(block, decimal):
    """([Column with values], skipped names, decimal sign, notes) of a Block."""
    rows, names, notes = turned(block)
    width = len(names)
    if width > MAX_COLUMNS:
        raise too_wide(width)
    gaps = [""] * width
    cells = list(zip(*(row or gaps for _, row in rows)))
    units = block.units if len(block.units) == width else gaps
    columns = [Column(k, *parts) for k, parts in enumerate(zip(names, units, cells))]
    for column, name in zip(columns, unique(names)):
        column.name = name
    sign, remark = _sign(rows, columns, decimal)
    notes += [remark] if remark else []
    columns = _joined(columns, notes)
    lines = [line for line, _ in rows]
    for column in columns:
        _fill(column, sign, lines, notes)
    skipped = [one.name for one in columns if one.kind == WORDS]
    return [one for one in columns if one.values is not None], skipped, sign, notes


def turned(block):
    """(rows, names, notes): a row of numbers, or rows that begin with their names, as columns."""
    rows, names = block.rows, block.names
    filled = [cells for _, cells in rows if cells]
    is_row = len(filled) == 1 and not block.has_header and _are_numbers(filled[0])
    has_names = not block.has_header and len(filled) < len(filled[0]) - 1
    if is_row and len(filled[0]) > 1:
        columns, names = [[""], *([cell] for cell in filled[0])], [""]
    elif has_names and all(_is_named_row(cells) for cells in filled):
        columns, names = list(zip(*filled)), [shown(cells[0]).strip() for cells in filled]
    else:
        return rows, names, []
    note = {
        "en": "a row was read as a column",
        "id": "baris dibaca sebagai kolom",
    }
    return [(k, list(cells)) for k, cells in enumerate(columns[1:], start=1)], names, [note]


def _are_numbers(cells):
    return all(is_gap(cell) or _is_number(cell) for cell in cells)


def _is_number(cell):
    return isinstance(cell, float) or any(to_number(cell, sign) is not None for sign in ".,")


def _is_named_row(cells):
    return has_letter(cells[0]) and not is_value(cells[0]) and _are_numbers(cells[1:])


def unique(names):
    """The names, none of them empty or twice."""
    taken, counts, result = set(names), {}, []
    for position, name in enumerate(names, start=1):
        base = name or str(position)
        count = counts.get(base, 0) + 1
        unused = base if count == 1 else f"{base} ({count})"
        while count > 1 and unused in taken:
            count += 1
            unused = f"{base} ({count})"
        counts[base] = count
        result.append(unused)
    return result


# --- what stands in a column --------------------------------------------------------------------


def kind_of(cells, head):
    """NUMBERS, DOTTED ("10.30" may be a clock time), WORDS or EMPTY."""
    if is_plain(cells):
        if not any(cells):
            return WORDS if head else EMPTY
        return DOTTED if _are_dotted(cells, head) else NUMBERS
    known = [cell for cell in cells if not is_gap(cell)]
    if not known:
        return WORDS if head or any(cells) else EMPTY
    words = sum(not is_value(cell) for cell in known)
    return WORDS if 2 * words > len(known) else NUMBERS


def is_plain(cells):
    """Does nothing stand there but plain numbers and empty cells?"""
    if not all(isinstance(cell, str) for cell in cells):
        return False
    text = "\n".join(cells)
    return bool(QUICK.fullmatch(text)) and not DATE.search(text)


def moments_in(cells):
    """The dates and clock times of a column, None where there is a gap; None if it has others."""
    moments = []
    for cell in cells:
        one = clock.moment(cell) if isinstance(cell, str) else None
        if one is None and not is_gap(cell):
            return None
        moments.append(one)
    return moments if any(moments) else None


def _are_dotted(cells, head):
    if not CLOCK_WORDS & set(words_of(head)):
        return False
    return all(cell == "" or clock.dotted(cell) for cell in cells)


def _sign(rows, columns, decimal):
    """The decimal sign; "10.30" is a clock time where it would be the only number with a point."""
    dotted = [one for one in columns if one.kind == DOTTED]
    places = [one.place for one in columns if one.kind == NUMBERS]
    sign, remark = decimals.sign_of(rows, places, decimal)
    if not dotted:
        return sign, remark
    are_clocks = sign == "," or all("pukul" in words_of(one.head) for one in dotted)
    for column in dotted:
        column.kind = MOMENTS if are_clocks else NUMBERS
        column.moments = [clock.dotted(cell) for cell in column.cells] if are_clocks else None
    if are_clocks:
        return sign, remark
    return decimals.sign_of(rows, places + [one.place for one in dotted], decimal)


def _joined(columns, notes):
    """Dates in one column and clock times in another are one time."""
    dates = [one for one in columns if _has(one, 0) and not _has(one, 1)]
    clocks = [one for one in columns if _has(one, 1) and not _has(one, 0)]
    if not dates or not clocks:
        return columns
    date, time = dates[0], clocks[0]
    date.moments = [a and b and (a[0], b[1], b[2]) for a, b in zip(date.moments, time.moments)]
    if date.head and time.head:
        date.name = date.head = f"{date.head} {time.head}"
    return [one for one in columns if one is not time]


def _has(column, part):
    """Have the moments of a column a date (part 0), a clock time (part 1)?"""
    return bool(column.moments) and any(one and one[part] is not None for one in column.moments)


# --- values -------------------------------------------------------------------------------------


def _fill(column, sign, lines, notes):
    if column.kind == MOMENTS:
        _fill_seconds(column, notes)
    elif column.kind == NUMBERS:
        values = _quick_numbers(column.cells, sign)
        column.values = _numbers(column, sign, lines) if values is None else values
        if np.isnan(column.values).all():
            column.values, column.kind = None, WORDS
        else:
            _check_size(column, lines)


def _fill_seconds(column, notes):
    name = column.name[:40]
    try:
        seconds, assumed = clock.seconds_of(column.moments)
    except clock.NoTimes:
        column.kind = WORDS
        return
    start = next(k for k, value in enumerate(seconds) if value is not None)
    first = shown(column.cells[start])[:40]
    column.values = np.array([
        np.nan if value is None else value - seconds[start] for value in seconds
    ])
    column.unit = "s"
    notes.append({
        "en": f"{name}: seconds since {first}",
        "id": f"{name}: detik sejak {first}",
    })
    if "day" in assumed:
        notes.append({
            "en": f"{first} was read as day before month",
            "id": f"{first} dibaca dengan hari sebelum bulan",
        })
    if "midnight" in assumed:
        notes.append({"en": "it goes on after midnight", "id": "lewat tengah malam diteruskan"})


def _quick_numbers(cells, sign):
    """The values of a column of plain numbers, twenty times as quickly; None if it is not one."""
    if not is_plain(cells):
        return None
    joined = "\n".join(cells)
    if "," in joined and ("." in joined or sign != ","):
        return None
    if sign == "," and "." in joined:
        return None
    try:
        plain = joined.replace(",", ".").split("\n")
        return np.array([float(cell) if cell else np.nan for cell in plain])
    except ValueError:
        return None


def _numbers(column, sign, lines):
    """The values cell by cell; InputError where one is no number, or has another unit."""
    found = [number_in(cell, sign or ".") for cell in column.cells]
    for (value, _), cell, line in zip(found, column.cells, lines):
        if value is None:
            raise no_number(line, column.name, cell)
    units = [unit for _, unit in found if unit]
    if units:
        _check_unit(column, found, units[0], lines)
        column.unit = canonical(units[0])
    return np.array([value for value, _ in found], dtype=float)


def _check_unit(column, found, unit, lines):
    for (_, other), line in zip(found, lines):
        if other and canonical(other) != canonical(unit):
            raise InputError(
                f"Line {line}, column {quoted(column.name)}: the units {unit} and {other} are "
                "mixed.",
                f"Baris {line}, kolom {quoted(column.name)}: satuan {unit} dan {other} bercampur.",
            )


def _check_size(column, lines):
    """InputError: a number beyond all sense."""
    huge = np.flatnonzero(np.abs(column.values) > MAX_NUMBER)
    if len(huge):
        at = int(huge[0])
        name, cell = quoted(column.name), quoted(column.cells[at])
        raise InputError(
            f"Line {lines[at]}, column {name}: {cell} is too large (beyond {MAX_NUMBER:g}).",
            f"Baris {lines[at]}, kolom {name}: {cell} terlalu besar (di atas {MAX_NUMBER:g}).",
        )
