"""A file of a recording in, its sheets of numbers out."""

import csv
import io
import re
from typing import NamedTuple

import numpy as np

from .cells import quoted, to_number
from .clock import NoTimes, is_time, moment, seconds_of
from .columns import is_wanted, read_header
from .errors import InputError
from .grid import decode
from .limits import too_wide
from .table import read_sheets
from .xls import read_xls
from .zips import TEXTS

MAX_ROWS = 2_000_000  # of a file
MAX_COLUMNS = 1000
LONGEST_PLACE = 60  # characters in a message
METADATA_SHEETS = ("Metadata Device", "Metadata Time")  # so phyphox calls them
QUOTED_DECIMAL = re.compile(r'"[+-]?[0-9]+,[0-9]+([eE][+-]?[0-9]+)?"')
LOOKED_AT = 5000  # characters in which a quoted decimal comma shows itself


class Sheet(NamedTuple):
    """A table: values (T, columns), NaN where a cell is empty; place and lines (T,) are for
    messages."""

    place: str
    names: list
    values: np.ndarray
    lines: np.ndarray


def sheets_of(name, content):
    """The bytes of one file -> its Sheets: one of a text, several of a workbook."""
    place = name
    if len(name) > LONGEST_PLACE:
        place = "..." + name[-(LONGEST_PLACE - 3) :]
    if not content.strip():
        raise _empty(place)
    if name.lower().endswith(".xls") and content[:2] != b"PK":
        grids = read_xls(place, content)
        return [
            _read_csv(f"{place}, {title}", text)
            for title, text in grids
            if title not in METADATA_SHEETS
        ]
    if name.lower().endswith((".xlsx", ".xls")):
        tables = read_sheets(name, content, skip=METADATA_SHEETS)
        return [_sheet_of(f"{place}, {title}", table) for title, table in tables.items()]
    text = decode(content) if name.lower().endswith(TEXTS) else None
    if text is None:
        raise NoSensor(
            f"{place}: not a .csv, .zip or .xlsx file; export the recording as one of these.",
            f"{place}: bukan berkas .csv, .zip atau .xlsx; eksporlah rekaman sebagai salah "
            "satunya.",
        )
    text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    try:
        return [_read_csv(place, text)]
    except csv.Error as error:
        raise InputError(
            f"{place}: the text is no table ({error}).",
            f"{place}: teksnya bukan tabel ({error}).",
        ) from None


def _sheet_of(place, table):
    values = np.column_stack(list(table.columns.values()))
    return Sheet(place, list(table.columns), values, table.lines)


class NoSensor(InputError):
    """A file without a sensor: others may have them."""


def no_sensor(place, names):
    """The NoSensor that tells which headers were not understood."""
    shown = ", ".join(quoted(name) for name in names[:4])
    return NoSensor(
        f"{place}: none of its columns is needed ({shown}); a sensor's are called for example "
        "'Gyroscope x (rad/s)'.",
        f"{place}: tidak ada kolom yang diperlukan ({shown}); kolom sensor bernama misalnya "
        "'Gyroscope x (rad/s)'.",
    )


def _empty(place):
    return NoSensor(f"{place}: the file is empty.", f"{place}: berkasnya kosong.")


def _read_csv(place, text):
    """The text of a CSV -> Sheet; empty cells become NaN, columns of no sensor are passed over."""
    rows = text.count("\n")
    if rows > MAX_ROWS + 10:
        raise InputError(
            f"{place}: {rows} rows are too many; the limit is {MAX_ROWS}.",
            f"{place}: {rows} baris terlalu banyak; batasnya {MAX_ROWS}.",
        )
    line, start = _header_in(text)
    header, _, body = text[start:].partition("\n")
    body = body.rstrip()
    separator, names = _names_in(place, line, header.strip())
    if len(names) > MAX_COLUMNS:
        raise too_wide(len(names), MAX_COLUMNS)
    if not body:
        raise NoSensor(
            f"{place}: there is no row below the header.",
            f"{place}: tidak ada baris di bawah judul.",
        )
    wanted = [k for k, name in enumerate(names) if is_wanted(name)]
    if not wanted:
        raise no_sensor(place, names)
    body = _clocks_in_seconds(body, names, separator)
    values = _numbers_at_once(body, separator, len(names), wanted)
    if values is None:
        return _read_cells(place, names, body, separator, line, wanted)
    return Sheet(place, names, values, line + 1 + np.arange(len(values)))


def _clocks_in_seconds(body, names, separator):
    """The body with dates and clock times written as seconds, where a column of times holds
    them."""
    first = body.partition("\n")[0].split(separator)
    clocks = [
        k
        for k, name in enumerate(names[: len(first)])
        if read_header(name).kind == "time" and is_time(first[k].strip(' "'))
    ]
    clocks = [k for k in clocks if not _reads_as_number(first[k].strip(' "'))]
    if not clocks:
        return body
    rows = list(csv.reader(io.StringIO(body), delimiter=separator, skipinitialspace=True))
    for k in clocks:
        cells = [row[k].strip() if k < len(row) else "" for row in rows]
        try:
            seconds, _ = seconds_of([moment(cell) for cell in cells])
        except NoTimes:
            return body
        for row, second in zip(rows, seconds):
            if second is not None:
                row[k] = repr(float(second))
    text = io.StringIO()
    csv.writer(text, delimiter=separator, lineterminator="\n").writerows(rows)
    return text.getvalue().rstrip()


def _header_in(text):
    """The number of the header's line, and where it begins: blank lines and comments come
    before."""
    line, start = 1, 0
    while start < len(text):
        end = text.find("\n", start)
        end = len(text) if end < 0 else end
        if (first := text[start:end].strip()) and first[0] != "#":
            break
        line, start = line + 1, end + 1
    return line, min(start, len(text))


def _names_in(place, line, header):
    """The separator of a header line, and the names between."""
    if header == "" or header[0] == "#":
        raise _empty(place)
    separator = next((sign for sign in "\t;," if sign in header), ",")
    cells = next(csv.reader([header], delimiter=separator, skipinitialspace=True))
    names = [cell.strip() for cell in cells]
    if all(_reads_as_number(name) for name in names):
        raise InputError(
            f"{place}, line {line}: a line with the names and units of the columns is needed "
            "above the numbers.",
            f"{place}, baris {line}: diperlukan baris judul berisi nama dan satuan kolom di atas "
            "bilangan.",
        )
    return separator, names


def _reads_as_number(cell):
    return any(to_number(cell, decimal) is not None for decimal in ".,")


def _numbers_at_once(body, separator, width, wanted):
    """The values (rows, width) of a body that holds nothing but numbers; None if it holds more.

    A long recording is read thirty times as quickly as cell by cell.
    """
    rows = body.count("\n") + 1
    has_decimal_commas = separator != "," and "," in body
    is_mixed = has_decimal_commas and "." in body
    is_even = body.count(separator) == rows * (width - 1)
    if is_mixed or '"' in body or "\n\n" in body or not is_even:
        return None
    if has_decimal_commas:
        body = body.replace(",", ".")
    values = np.full((rows, width), np.nan)
    try:
        with io.TextIOWrapper(io.BytesIO(body.encode()), encoding="utf-8") as file:
            values[:, wanted] = np.loadtxt(
                file, delimiter=separator, ndmin=2, comments=None, usecols=wanted
            )
    except ValueError:  # not only numbers
        return None
    return values


def _read_cells(place, names, body, separator, line, wanted):
    """The same, cell by cell."""
    has_quoted = QUOTED_DECIMAL.search(body[:LOOKED_AT])
    sign = "," if (separator != "," and "," in body) or has_quoted else "."
    values, lines = [], []
    skips_blanks = separator != "\t"
    reader = csv.reader(io.StringIO(body), delimiter=separator, skipinitialspace=skips_blanks)
    for cells in reader:
        at = line + reader.line_num
        if not any(cell.strip() for cell in cells):
            continue
        if len(cells) != len(names):
            raise InputError(
                f"{place}, line {at}: {len(cells)} cells instead of {len(names)}.",
                f"{place}, baris {at}: {len(cells)} sel, seharusnya {len(names)}.",
            )
        row = np.full(len(names), np.nan)
        row[wanted] = [_number(place, at, names[k], cells[k].strip(), sign) for k in wanted]
        values.append(row)
        lines.append(at)
    return Sheet(place, names, np.array(values), np.array(lines))


def _number(place, line, name, cell, sign):
    number = None if sign == "," and "." in cell else to_number(cell, sign)
    if number is None:
        en, id = "", ""
        if sign == ",":
            en, id = " (others have a decimal comma)", " (yang lain memakai koma desimal)"
        raise InputError(
            f"{place}, line {line}, column {quoted(name)}: {quoted(cell)} is not a number{en}.",
            f"{place}, baris {line}, kolom {quoted(name)}: {quoted(cell)} bukan bilangan{id}.",
        )
    return number
