"""Sheets, cells and charts of the workbook: how they look. Heights in points, widths in
characters."""

from openpyxl.cell import WriteOnlyCell
from openpyxl.chart import LineChart, Reference, Series
from openpyxl.chart.shapes import GraphicalProperties
from openpyxl.drawing.line import LineProperties
from openpyxl.styles import Alignment, Border, Font, PatternFill, Side

FIRST = 7  # the first row of both tables

WHOLE = "0"
SIX_DECIMALS = "0.000000"
POWER = "0.000000E+00"  # of a variance
SMALL = "[=0]0;[<0.001]0.000000E+00;0.000000"  # of a gain

DARK, PALE, WHITE, GREY = "1F3A5F", "DCE6F1", "FFFFFF", "BFBFBF"
INPUT, RESULT = "FFF2CC", "E2F0D9"  # yellow: to be changed; green
LINE_COLOURS = ("7F7F7F", "0072B2", "D55E00")
LINE_WIDTH = 28000  # 1/12700 point
MEASURED_COLUMN = 2  # drawn as dots


def new_sheet(book, title, widths, heights, frozen=f"A{FIRST}"):
    """A sheet whose rows above the cell `frozen` stay in sight."""
    sheet = book.create_sheet(title)
    sheet.freeze_panes = frozen
    for letter, width in zip("ABCDEFGH", widths):
        sheet.column_dimensions[letter].width = width
    for row, height in enumerate(heights, start=1):
        sheet.row_dimensions[row].height = height
    sheet.page_setup.orientation = "landscape"
    sheet.page_setup.fitToHeight = 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    return sheet


def title_cell(sheet, text, wrap=False):
    return styled_cell(sheet, text, bold=True, size=15, colour=DARK, wrap=wrap)


def write_rows(sheet, heads, formats, fills, contents, T):
    """The heads, then T rows of contents(row); fills {column: colour}."""
    sheet.append([])
    head = dict(bold=True, colour=WHITE, fill=DARK, centre=True)
    sheet.append([styled_cell(sheet, text, **head) for text in heads])
    row = [
        styled_cell(sheet, None, format=format, fill=fills.get(k), centre=k == 0)
        for k, format in enumerate(formats)
    ]
    for r in range(FIRST, FIRST + T):
        for cell, content in zip(row, contents(r)):
            cell.value = content  # the same cells again, as a row is written at once
        sheet.append(row)


def styled_cell(
    sheet,
    value,
    *,
    format="General",
    text=False,
    bold=False,
    size=11,
    colour="000000",
    fill=None,
    centre=False,
    wrap=True,
):
    """A cell with its looks. text=True: never a formula."""
    cell = WriteOnlyCell(sheet, value)
    if text:
        cell.data_type = "s"
        cell.quotePrefix = True
    cell.number_format = format
    cell.font = Font("Calibri", size, bold, color=colour)
    if isinstance(value, str):
        horizontal, vertical = ("center", "center") if centre else (None, "top")
        cell.alignment = Alignment(wrap_text=wrap, vertical=vertical, horizontal=horizontal)
    elif centre:
        cell.alignment = Alignment(horizontal="center")
    if fill:
        edge = Side("thin", color=GREY)
        cell.fill = PatternFill("solid", fgColor=fill)
        cell.border = Border(edge, edge, edge, edge)
    return cell


def chart(title, end, *lines):
    """A chart of lines (sheet, column, title) from row FIRST to the row `end`."""
    chart = LineChart()
    chart.title = title
    chart.width, chart.height = 20, 11  # centimetres
    chart.x_axis.title = "No"
    chart.y_axis.title = "nilai / value"
    chart.x_axis.delete = False
    chart.y_axis.delete = False
    chart.x_axis.tickLblPos = "low"
    chart.y_axis.number_format = "General"
    every = max(1, (end - FIRST + 1) // 16)
    chart.x_axis.tickLblSkip = every
    chart.x_axis.tickMarkSkip = every
    chart.y_axis.majorGridlines.spPr = GraphicalProperties(ln=LineProperties(solidFill="E0E0E0"))
    chart.legend.position = "b"
    chart.dispBlanksAs = "gap"
    for (sheet, column, name), colour in zip(lines, LINE_COLOURS):
        chart.series.append(_series(sheet, column, name, end, colour))
    first_sheet = lines[0][0]
    chart.set_categories(Reference(first_sheet, min_col=1, min_row=FIRST, max_row=end))
    return chart


def _series(sheet, column, name, end, colour):
    cells = Reference(sheet, min_col=column, min_row=FIRST, max_row=end)
    series = Series(cells, title=name)
    series.smooth = False
    line = series.graphicalProperties.line
    if column == MEASURED_COLUMN:
        series.marker.symbol = "circle"
        series.marker.size = 6
        series.marker.graphicalProperties.solidFill = colour
        line.noFill = True
    else:
        series.marker.symbol = "none"
        line.solidFill = colour
        line.width = LINE_WIDTH
    return series
