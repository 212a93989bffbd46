"""Measurements in, a workbook out that filters them: the form of Rudiyanto, Setiawan and Saptomo
(2006), alive. Its cells hold the formulas of chapter 2, not their results."""

import re

import numpy as np
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName

from . import workbook_words as words
from .errors import InputError
from .limits import MAX_NUMBER, too_long
from .workbook_parts import (
    FIRST,
    INPUT,
    PALE,
    POWER,
    RESULT,
    SIX_DECIMALS,
    SMALL,
    WHOLE,
    chart,
    new_sheet,
    styled_cell,
    title_cell,
    write_rows,
)

MAX_WRITE = 100_000  # rows
CHART_ROWS = 5000  # a longer chart is slow
LAST_ROW = 1_048_576  # of any sheet
HEADING_LENGTH = 25  # characters; a longer note is a paragraph
LINE_LENGTH = 72  # characters


def write_workbook(target, z, Q, R, x0=0.0, P0=1.0, name="Measured"):
    """Write the measurements z (T,) and live formulas that filter and smooth them into an .xlsx.

    target  a path or a binary file object
    z       (T,) up to 100,000, NaN = gap
    Q, R    variances of process and measurement noise, unit of z squared
    x0, P0  first guess and its variance
    name    what was measured; never a formula

    InputError: z is empty, too long or infinite; Q, R, x0 or P0 out of range.
    """
    z = np.asarray(z, dtype=float)
    _check(z, Q, R, x0, P0)
    book = Workbook(write_only=True)  # row by row needs little memory
    book.calculation.fullCalcOnLoad = True
    book.properties.creator = words.CREATOR
    chart_end = FIRST + min(len(z), CHART_ROWS) - 1
    data_format = _format_of(z)
    _write_filter(book, z, (Q, R, x0, P0), str(name), data_format, chart_end)
    _write_rts(book, len(z), data_format, chart_end)
    _write_notes(book, chart_end)
    book.save(target)


def _check(z, Q, R, x0, P0):
    """InputError for whatever the workbook cannot hold."""
    if z.ndim != 1 or len(z) == 0 or (np.abs(z) > MAX_NUMBER).any():
        raise InputError(
            "z must be one column of finite numbers.", "z harus satu kolom bilangan berhingga."
        )
    if len(z) > MAX_WRITE:
        raise too_long(len(z), MAX_WRITE)
    for letter, value, is_good, en, id in (
        ("Q", Q, Q >= 0, ">= 0", ">= 0"),
        ("R", R, R > 0, "> 0", "> 0"),
        ("x0", x0, True, "finite", "berhingga"),
        ("P0", P0, P0 >= 0, ">= 0", ">= 0"),
    ):
        if not is_good or not abs(value) <= MAX_NUMBER:
            raise InputError(
                f"{letter} is {value}, but must be {en}.",
                f"{letter} bernilai {value}, seharusnya {id}.",
            )


def _format_of(z):
    """Six decimals, unless z is so large or small that it needs a power of ten."""
    scale = np.nanmax(np.abs(z), initial=0)
    return SIX_DECIMALS if scale == 0 or 0.01 <= scale < 1e6 else POWER


# --- sheet Filter: forwards ---------------------------------------------------------------------


def _write_filter(book, z, inputs, name, data_format, chart_end):
    widths = (7, 16, 17, 17, 16, 16, 16, 16)
    sheet = new_sheet(book, "Filter", widths, heights=(26, 18, 50, 18, 6, 50))
    sheet.append([title_cell(sheet, words.FILTER_TITLE)])
    sheet.append([styled_cell(sheet, words.FILTER_HINT, wrap=False)])
    _write_inputs(book, sheet, inputs, name)
    formats = (WHOLE, data_format, data_format, POWER, data_format, SMALL, data_format, POWER)
    fills = {1: INPUT, 6: RESULT}

    def contents(r):
        return _filter_row(r, z[r - FIRST])

    write_rows(sheet, words.FILTER_HEADS, formats, fills, contents, len(z))
    measured = (sheet, 2, words.MEASURED)
    filtered = (sheet, 7, words.FILTERED)
    sheet.add_chart(chart(words.CHART_TITLE, chart_end, measured, filtered), f"J{FIRST}")


def _write_inputs(book, sheet, inputs, name):
    """Two rows, labels and values: Q, R, x0, P0, how many measurements, and what was measured."""
    labels = [f"{letter}\n{id} /\n{en}" for letter, id, en in words.INPUTS]
    labels += [words.COUNT_LABEL, words.NAME_LABEL]
    label_cells = [styled_cell(sheet, label, fill=PALE, centre=True) for label in labels]
    sheet.append([None, *label_cells])
    look = dict(bold=True, fill=INPUT, centre=True)
    values = [styled_cell(sheet, float(value), **look) for value in inputs]
    count = styled_cell(sheet, f"=COUNT(B{FIRST}:B{LAST_ROW})", bold=True, centre=True)
    without_control = re.sub(r"[\x00-\x1f\x7f]", " ", name)
    short_name = " ".join(without_control.split())[:100]
    name_cell = styled_cell(sheet, short_name, text=True, bold=True, wrap=False)
    sheet.append([None, *values, count, name_cell])
    for (letter, _, _), column in zip(words.INPUTS, "BCDE"):
        cell_name = f"{letter}_"
        book.defined_names[cell_name] = DefinedName(cell_name, attr_text=f"Filter!${column}$4")


def _filter_row(r, z):
    """One step in formulas: number, z, x_pred, P_pred, y, K, x, P in columns A to H of row r."""
    is_first = r == FIRST
    known = f"=IF(ISNUMBER(B{r}),"
    return (
        r - FIRST + 1,
        None if np.isnan(z) else float(z),
        "=x0_" if is_first else f"=G{r - 1}",
        "=P0_+Q_" if is_first else f"=H{r - 1}+Q_",
        f'{known}B{r}-C{r},"")',
        f"{known}D{r}/(D{r}+R_),0)",
        f"{known}C{r}+F{r}*E{r},C{r})",
        f"{known}F{r}*R_,D{r})",
    )


# --- sheet RTS: backwards -----------------------------------------------------------------------


def _write_rts(book, T, data_format, chart_end):
    widths = (7, 16, 16, 20, 16, 16, 16)
    sheet = new_sheet(book, "RTS", widths, heights=(26, 18, 18, 18, 6, 50))
    sheet.append([title_cell(sheet, words.RTS_TITLE)])
    for line in words.RTS_LINES:
        sheet.append([styled_cell(sheet, line, wrap=False)])
    formats = (WHOLE, data_format, POWER, POWER, SMALL, data_format, POWER)
    write_rows(sheet, words.RTS_HEADS, formats, {5: RESULT}, _rts_row, T)
    measured = (book["Filter"], 2, words.MEASURED)
    filtered = (book["Filter"], 7, words.FILTERED)
    smoothed = (sheet, 6, words.SMOOTHED)
    sheet.add_chart(chart(words.RTS_TITLE, chart_end, measured, filtered, smoothed), f"I{FIRST}")


def _rts_row(r):
    """One step back: number, x, P, the next P_pred, G, x_smooth, P_smooth in columns A to G."""
    has_next = f"=IF(ISNUMBER(E{r}),"
    return (
        f"=Filter!A{r}",
        f"=Filter!G{r}",
        f"=Filter!H{r}",
        f'=IF(ISNUMBER(Filter!D{r + 1}),Filter!D{r + 1},"")',
        f'=IF(ISNUMBER(D{r}),IF(D{r}=0,0,C{r}/D{r}),"")',
        f"{has_next}B{r}+E{r}*(F{r + 1}-B{r}),B{r})",
        f"{has_next}E{r}*(Q_+E{r}*G{r + 1}),C{r})",
    )


# --- sheet Notes --------------------------------------------------------------------------------


def _write_notes(book, chart_end):
    sheet = new_sheet(book, words.NOTES_TITLE, widths=(76, 76), heights=(26,), frozen="A2")
    sheet.append([title_cell(sheet, text, wrap=True) for text in words.NOTES_HEADS])
    for row, pair in enumerate(words.NOTES, start=2):
        is_heading = len(pair[0]) < HEADING_LENGTH
        texts = [text.format(first=FIRST, chart_end=chart_end) for text in pair]
        more_lines = (max(len(text) for text in texts) - 1) // LINE_LENGTH
        sheet.row_dimensions[row].height = 19 + 16 * more_lines
        fill = PALE if is_heading else None
        sheet.append([styled_cell(sheet, text, bold=is_heading, fill=fill) for text in texts])
