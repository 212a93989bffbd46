"""The XML of a workbook -> titles, strings, formats and grids (ECMA-376, SpreadsheetML).

Rows and cells are counted before they are read, and what is empty takes no room. Dates, which are
numbers with a format, become text such as "2024-01-01 10:00:00".
"""

import datetime
import re
from xml.parsers import expat

from .errors import InputError
from .limits import MAX_CELLS, MAX_READ, too_long, too_many_cells

MAX_TAGS = 4 * MAX_CELLS + 100_000
MAX_STRINGS = 300_000
LAST_ROW, LAST_COLUMN = 1_048_576, 16_384  # of Excel
DATE_FORMATS = {*range(14, 18), 22, *range(27, 37), *range(50, 59)}
CLOCK_FORMATS = {18, 19, 20, 21, 45, 46, 47}
QUOTED = re.compile(r'"[^"]*"|\\.|_.|\*.|\[[^\]hms]*\]')
EPOCHS = {False: datetime.date(1899, 12, 30), True: datetime.date(1904, 1, 1)}
LAST_DAY = 2_958_465  # 9999-12-31
TRUTH = {"0": "FALSE", "1": "TRUE"}


def read_xml(content, start, end, text):
    """Call start(name, attributes), end(name), text(characters); names without their prefix."""
    if not content:
        return
    if content.count(b"<") > 2 * MAX_TAGS:
        raise too_many_cells(content.count(b"<") // 2)
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler = lambda name, attributes: start(name.rpartition(":")[2], attributes)
    parser.EndElementHandler = lambda name: end(name.rpartition(":")[2])
    parser.CharacterDataHandler = text
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.Parse(content, True)


def _refuse_doctype(*_):
    raise ValueError("a workbook declares no entities")


def _nothing(*_):
    return None


def sheets_in(content):
    """[(title, id of its relation), ...] and whether days are counted from 1904."""
    sheets, from_1904 = [], []

    def start(name, attributes):
        if name == "sheet":
            relation = next((v for k, v in attributes.items() if k.endswith(":id")), "")
            sheets.append((attributes.get("name", ""), relation))
        elif name == "workbookPr":
            from_1904.append(attributes.get("date1904") in ("1", "true"))

    read_xml(content, start, _nothing, _nothing)
    return sheets, any(from_1904)


def relations_in(content):
    """{id: path}."""
    found = {}

    def start(name, attributes):
        if name == "Relationship":
            found[attributes.get("Id", "")] = attributes.get("Target", "")

    read_xml(content, start, _nothing, _nothing)
    return found


def strings_in(content):
    """The texts that cells share."""
    if content.count(b"<si") > MAX_STRINGS:
        raise too_many_cells(content.count(b"<si"), MAX_STRINGS)
    strings, pieces, inside = [], [], [False]

    def start(name, _):
        if name == "si":
            pieces.clear()
        inside[0] = name == "t"

    def end(name):
        inside[0] = False
        if name == "si":
            strings.append("".join(pieces).strip())

    read_xml(content, start, end, lambda text: pieces.append(text) if inside[0] else None)
    return strings


def formats_in(content):
    """For each style of a cell "date", "clock" or ""."""
    custom, styles, inside = {}, [], [False]

    def start(name, attributes):
        if name == "numFmt":
            custom[attributes.get("numFmtId")] = _kind(attributes.get("formatCode", ""))
        elif name == "cellXfs":
            inside[0] = True
        elif name == "xf" and inside[0]:
            styles.append(attributes.get("numFmtId", "0"))

    def end(name):
        inside[0] = inside[0] and name != "cellXfs"

    read_xml(content, start, end, _nothing)
    return [custom.get(number, _known_kind(number)) for number in styles]


def _known_kind(number):
    if not number.isdigit():
        return ""
    if int(number) in DATE_FORMATS:
        return "date"
    return "clock" if int(number) in CLOCK_FORMATS else ""


def _kind(code):
    """ "dd/mm/yyyy hh:mm" -> "date", "[h]:mm:ss" -> "clock", "0.00" -> ""."""
    signs = set(QUOTED.sub("", code[:200]).lower())
    if "general" in code.lower() or not signs & set("dmyhs"):
        return ""
    return "date" if signs & set("dy") else "clock"


# --- a sheet ------------------------------------------------------------------------------------


def grid_in(content, title, strings, formats, from_1904):
    """The grid of a sheet: a number as a float, anything else as text, all rows equally wide."""
    rows, cells = content.count(b"<row"), content.count(b"<c")
    if rows > MAX_READ + 1000:
        raise too_long(rows)
    if cells > MAX_CELLS + 1000:
        raise too_many_cells(cells)
    reader = _Reader(title, strings, formats, from_1904)
    read_xml(content, reader.start, reader.end, reader.text)
    return _filled(reader.rows)


class _Reader:
    """Takes the cells of a sheet as they come: rows [(number, {column: cell}), ...]."""

    def __init__(self, title, strings, formats, from_1904):
        self.title, self.strings, self.formats = title, strings, formats
        self.from_1904 = from_1904
        self.rows = []
        self.row = 0
        self.column = 0
        self.cell = {}
        self.into = None  # the name of the element whose text is wanted
        self.pieces = {}

    def start(self, name, attributes):
        if name == "row":
            self.row = int(attributes.get("r", self.row + 1))
            self.column = 0
            if not self.row <= LAST_ROW or (self.rows and self.row <= self.rows[-1][0]):
                raise ValueError("rows out of order")
            self.rows.append((self.row, {}))
        elif name == "c":
            self.cell = attributes
            self.pieces = {}
        elif name in ("v", "t", "f"):
            self.into = name
            self.pieces.setdefault(name, [])

    def text(self, text):
        if self.into:
            self.pieces[self.into].append(text)

    def end(self, name):
        if name in ("v", "t", "f"):
            self.into = None
        elif name == "c":
            place = self.cell.get("r")
            self.column = column_of(place) if place else self.column + 1
            content = self.content()
            if content != "":
                self.rows[-1][1][self.column] = content

    def content(self):
        kind = self.cell.get("t", "n")
        value = "".join(self.pieces.get("v", ())).strip()
        if kind == "inlineStr":
            return "".join(self.pieces.get("t", ())).strip()
        if value == "" and kind == "n" and "f" in self.pieces:
            raise uncalculated(self.cell.get("r", ""), self.title)
        if value == "":
            return ""
        if kind == "s":
            return self.strings[int(value)]
        if kind == "b":
            return TRUTH.get(value, value)
        return self.number(float(value)) if kind == "n" else value

    def number(self, value):
        style = int(self.cell.get("s", 0))
        kind = self.formats[style] if 0 <= style < len(self.formats) else ""
        if kind == "" or not 0 <= value <= LAST_DAY:
            return value
        return time_text(value, kind, self.from_1904)


def column_of(place):
    """ "BC12" -> 55."""
    column = 0
    for sign in place[:4]:
        if not "A" <= sign <= "Z":
            break
        column = 26 * column + ord(sign) - 64
    if not 1 <= column <= LAST_COLUMN:
        raise ValueError("no such column")
    return column


def time_text(serial, kind, from_1904):
    """A day and its fraction -> "2024-01-01 10:00:00", or "10:00:00" of a clock."""
    thousandths = round(serial * 86_400_000)
    day, rest = divmod(thousandths, 86_400_000)
    hours, rest = divmod(rest, 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    seconds, rest = divmod(rest, 1000)
    tail = f"{minutes:02d}:{seconds:02d}" + (f".{rest:03d}" if rest else "")
    if kind == "clock":
        return f"{24 * day + hours:02d}:{tail}"
    date = EPOCHS[from_1904] + datetime.timedelta(days=day)
    clock = f" {hours:02d}:{tail}" if thousandths % 86_400_000 else ""
    return date.isoformat() + clock


def uncalculated(place, title):
    return InputError(
        f"Cell {place} of sheet {title[:40]!r} holds a formula that was never calculated; open and "
        "save the file once in Excel or LibreOffice.",
        f"Sel {place} di lembar {title[:40]!r} berisi rumus yang belum pernah dihitung; buka dan "
        "simpan berkas itu sekali di Excel atau LibreOffice.",
    )


def _filled(rows):
    """Sparse rows -> a grid without the columns in which nothing stands."""
    rows = [(number, cells) for number, cells in rows if cells]
    if not rows:
        return []
    first, last = rows[0][0], rows[-1][0]
    if last - first > MAX_READ + 1000:
        raise too_long(last - first + 1)
    used = sorted({column for _, cells in rows for column in cells})
    if len(used) * len(rows) > 2 * MAX_CELLS:
        raise too_many_cells(len(used) * len(rows))
    grid, line = [], first
    for number, cells in rows:
        grid.extend((blank, []) for blank in range(line, number))
        grid.append((number, [cells.get(column, "") for column in used]))
        line = number + 1
    return grid
