"""A reader's table in: pasted text, .csv, .txt, .tsv or .xlsx -> Table."""

from dataclasses import dataclass, field

import numpy as np

from . import lists
from . import missing as gaps
from .block import find
from .build import columns_of
from .cells import shown
from .errors import InputError
from .grid import split
from .limits import MAX_BYTES, MAX_READ, too_large, too_long
from .notes import about, joined
from .roles import epoch_unit, roles
from .series import series_of
from .sources import grids_of, named_source, text_of

LINES_OF_CODES = 100  # around a table are asked what -999 means
SIGNS = (None, ",", ".")


@dataclass(frozen=True, eq=False)
class Table:
    """What was read.

    columns   {name: float array (T,), NaN = gap}, in the units of the source; dates and clock
              times in seconds since the first
    units     {name: unit}, of those that name one
    notes     [{"en", "id"}, ...]: what was understood, assumed and passed over
    time      the name of the column of times, None if there is none
    value     the name of the column that is taken as measured
    lines     (T,) the line or row of each in the source
    skipped   names of columns without a number (labels, remarks)
    decimal   "," or "."; None: no number had one
    codes     {number: how often}: what was taken as a gap, and what may be one
    sheet     the title of the sheet, None for a text
    sheets    the titles of all sheets with numbers
    """

    columns: dict
    units: dict
    notes: list
    time: str | None
    value: str
    lines: np.ndarray
    skipped: tuple = ()
    decimal: str | None = None
    codes: dict = field(default_factory=dict)
    sheet: str | None = None
    sheets: tuple = ()

    @property
    def note(self):
        """The notes as one sentence of each language: {"en", "id"}."""
        return joined(self.notes)

    def series(self, time=None, value=None):
        """Series(t, z, notes): t (T,) in seconds from 0 (None without a time column), z (T,).

        time, value: names of other columns. Equal times are averaged; InputError: they go back.
        """
        return series_of(self, time, value)


def read_table(source, sheet=None, decimal=None, missing=None):
    """A path, the bytes of a file, or pasted text -> Table.

    sheet     the title (or number from 0) of a sheet; None: the one with the longest table
    decimal   the decimal sign, "," or "."; None: find out
    missing   a number or several that stand for a gap; None: find out, []: there are none

    InputError, one sentence in each language: what cannot be understood, or only in two ways."""
    if decimal not in SIGNS:
        raise ValueError('decimal must be ",", "." or None. / decimal harus ",", "." atau None.')
    return read_named(*named_source(source), sheet, decimal, missing)


def read_named(name, content, sheet=None, decimal=None, missing=None):
    """The same of bytes or a text; name: that of the file in messages."""
    codes = None if missing is None else np.atleast_1d(np.asarray(missing, dtype=float))
    text = text_of(name, content)
    if text is not None:
        grid, remarks = _grid_of_text(text, decimal)
        return _table_of(grid, decimal, codes, remarks)
    grids = grids_of(name, content)
    title, grid = _chosen(grids, sheet)
    remarks = [_about_sheet(title, len(grids))] if len(grids) > 1 else []
    table = _table_of(grid, decimal, codes, remarks)
    object.__setattr__(table, "sheet", title)
    object.__setattr__(table, "sheets", tuple(grids))
    return table


def read_sheets(name, content, skip=()):
    """The bytes of an .xlsx file -> {title: Table} of its sheets with numbers, without those in
    skip; no code is taken for a gap."""
    grids = grids_of(name, content, skip)
    none = np.array([])
    return {title: _table_of(grid, None, none, []) for title, grid in grids.items()}


def _grid_of_text(text, decimal):
    if len(text) > MAX_BYTES:
        raise too_large(len(text))
    text = text.removeprefix("\ufeff")
    grid = lists.grid_of(text)
    if grid is not None:
        return grid, []
    grid, remark = split(text, decimal)
    return grid, [remark] if remark else []


def _chosen(grids, sheet):
    """(title, grid) of the sheet that the reader chose, or of the one with the longest table."""
    if not grids:
        return None, []
    if sheet is None:
        return max(grids.items(), key=lambda item: _size(item[1]))
    titles = list(grids)
    if isinstance(sheet, int) and 0 <= sheet < len(titles):
        sheet = titles[sheet]
    if sheet in grids:
        return sheet, grids[sheet]
    listed = ", ".join(title[:40] for title in titles[:5])
    raise InputError(
        f"There is no sheet {sheet!r} with numbers; there are: {listed}.",
        f"Tidak ada lembar {sheet!r} yang berisi bilangan; yang ada: {listed}.",
    )


def _size(grid):
    return sum(bool(cells) for _, cells in grid)


def _about_sheet(title, count):
    return {
        "en": f"sheet: {title[:40]} (of {count})",
        "id": f"lembar: {title[:40]} (dari {count})",
    }


# --- grid -> Table ------------------------------------------------------------------------------


def _table_of(grid, decimal, codes, remarks):
    """The Table of a grid; remarks: how the grid was found."""
    block = find(grid)
    if block is None:
        raise no_numbers()
    if len(block.rows) > MAX_READ:
        raise too_long(len(block.rows))
    found, skipped, sign, notes = columns_of(block, decimal)
    units = {one.name: one.unit for one in found if one.unit}
    columns = {one.name: one.values for one in found}
    heads = {one.name: one.head for one in found}
    moments = {one.name for one in found if one.moments}
    if set(columns) == moments:
        raise no_numbers()
    time, value = roles(columns, units, heads, moments)
    near = set(block.passed[:LINES_OF_CODES] + block.passed[-LINES_OF_CODES:])
    passed = [" ".join(map(shown, cells)) for line, cells in grid if line in near]
    counts, told = _without_codes(columns, units, time, heads, codes, gaps.codes_in(passed))
    if time and time not in units and epoch_unit(columns[time]):
        units[time] = epoch_unit(columns[time])
        told.append({
            "en": f"{time}: {units[time]} since 1970",
            "id": f"{time}: {units[time]} sejak 1970",
        })
    rows = len(next(iter(columns.values())))
    lines = np.array([line for line, _ in block.rows], dtype=int)
    lines = lines if len(lines) == rows else np.arange(1, rows + 1)
    summary = about(columns, units, time, value, skipped, sign, block.passed)
    notes = [*summary, *remarks, *notes, *told]
    return Table(columns, units, notes, time, value, lines, tuple(skipped), sign, counts)


def no_numbers():
    return InputError(
        "There is no column of numbers in it.", "Tidak ada kolom bilangan di dalamnya."
    )


def _without_codes(columns, units, time, heads, codes, explained):
    """Put gaps where codes stand -> ({code: how often}, notes)."""
    counts, doubts = {}, {}
    for name, values in columns.items():
        if name == time:
            continue
        if codes is None:
            sure, doubtful = gaps.suspects(heads[name], units.get(name, ""), values, explained)
        else:
            sure, doubtful = list(codes), []
        for code, count in gaps.counted(sure, values):
            counts[code] = counts.get(code, 0) + count
        for code, count in gaps.counted(doubtful, values):
            doubts[code] = doubts.get(code, 0) + count
        columns[name] = np.where(np.isin(values, sure), np.nan, values)
    notes = []
    if counts:
        notes.append(gaps.taken(counts))
    if doubts:
        notes.append(gaps.doubted(doubts))
    return {**counts, **doubts}, notes
