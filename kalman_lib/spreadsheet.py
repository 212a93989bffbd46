"""Numbers in, workbooks out. The only room that knows openpyxl.

The workbook is the form of Rudiyanto, Setiawan and Saptomo (2006), alive.
"""
import csv
import io
import re
import warnings
from dataclasses import dataclass

import numpy as np
from openpyxl import Workbook, load_workbook
from openpyxl.cell import WriteOnlyCell
from openpyxl.chart import LineChart, Reference, Series
from openpyxl.chart.shapes import GraphicalProperties
from openpyxl.drawing.line import LineProperties
from openpyxl.styles import Alignment, Border, Font, PatternFill, Side
from openpyxl.workbook.defined_name import DefinedName

MAX_READ, MAX_WRITE = 200_000, 100_000          # rows
MAX_NUMBER = 1e300


class InputError(ValueError):
    """What is wrong with the reader's input: one sentence in each language, .en and .id."""

    def __init__(self, en, id):
        super().__init__(f"{en} / {id}")
        self.en, self.id = en, id


@dataclass(frozen=True, eq=False)
class Table:
    """What was read: columns {name: float array (T,), NaN = gap}, in the units of the source; lines (T,) the line or row of
    each in the source; skipped: names of columns without a number (dates, labels); decimal "," or "." (None: no number
    had one); note_en, note_id: one sentence that says what was understood."""
    columns: dict
    lines: np.ndarray
    skipped: tuple
    decimal: str | None
    note_en: str
    note_id: str


# --- reading: source -> grid [(line, cells)] -> Table ----------------------------------------------------------------

def read_text(text, decimal=None):
    """A pasted text or CSV -> Table. decimal is its decimal sign, "," or "."; None: find out.

    Separators: tab, semicolon, comma or blanks. A line "1,5" without header is one number unless decimal=".".
    InputError: no numbers, ragged rows, a word among numbers, or a text that can be read in two ways.
    """
    if decimal not in (None, ",", "."):
        raise ValueError('decimal must be ",", "." or None. / decimal harus ",", "." atau None.')
    try:
        grid, *remark = _split(text.removeprefix("\ufeff"), decimal)
    except csv.Error as error:
        raise InputError(f"The quotation marks in the text do not pair up ({error}).",
                         f"Tanda kutip dalam teks tidak berpasangan ({error}).") from None
    return _table(grid, decimal, *remark)


def read_file(name, content, decimal=None):
    """The bytes of a .csv, .txt, .tsv or .xlsx file -> Table; of an .xlsx the first sheet with numbers.

    InputError: another kind of file, a formula without its result, and whatever read_text refuses.
    """
    suffix = name.lower().rpartition(".")[2]
    if suffix == "xlsx" and content.startswith(b"PK"):
        for title, grid, sheets in _grids(name, content):
            return _table(grid, decimal, *[(f"; sheet: {title}", f"; lembar: {title}")][:sheets - 1])
        return _table([], decimal)
    text = decode(content) if suffix in ("csv", "txt", "tsv") else None
    if text is None:
        raise _unreadable(name)
    return read_text(text, decimal)


def read_sheets(name, content, skip=()):
    """The bytes of an .xlsx file -> {title: Table} of its sheets with numbers, without those in skip; InputError as
    read_file."""
    return {title: _table(grid, None) for title, grid, _ in _grids(name, content, skip)}


def _unreadable(name):
    return InputError(f"{name[:60]!r} is not a text (.csv, .txt, .tsv) or Excel .xlsx file; save it as one of these.",
                      f"{name[:60]!r} bukan berkas teks (.csv, .txt, .tsv) atau Excel .xlsx; simpanlah sebagai itu.")


def decode(content):
    """Bytes -> text: UTF-8, UTF-16 or Windows-1252; None if it is no text at all."""
    encodings = ["utf-8-sig", "cp1252"]
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        encodings = ["utf-16"]
    elif b"\0" in content[:2]:
        encodings = ["utf-16-le" if content[1:2] == b"\0" else "utf-16-be"]
    for encoding in encodings:
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        return None if re.search(r"[\x00-\x08\x0e-\x1f]", text) else text
    return None


def _grids(name, content, skip=()):
    """The bytes of a workbook -> (title, grid, number of sheets) of each sheet with numbers."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")         # of decorations
            results, formulas = (load_workbook(io.BytesIO(content), read_only=True, data_only=data_only).worksheets
                                 for data_only in (True, False))
            for sheet, formula_sheet in zip(results, formulas):
                grid = [] if sheet.title in skip else _sheet_grid(sheet, formula_sheet)
                if any(_is_number(cell) for _, cells in grid for cell in cells):
                    yield sheet.title, grid, len(results)
    except InputError:
        raise
    except Exception as error:                      # a damaged file breaks openpyxl in many ways
        raise _unreadable(name) from error


def _sheet_grid(sheet, formula_sheet):
    sheet.reset_dimensions()                        # which may be wrong
    formula_sheet.reset_dimensions()
    grid = []
    for line, rows in enumerate(zip(sheet.iter_rows(), formula_sheet.iter_rows()), start=1):
        cells = []
        for cell, formula in zip(*rows):
            value = cell.value
            if value is None and formula.data_type == "f" and cell.data_type == "n":
                raise InputError(
                    f"Cell {formula.coordinate} of sheet {sheet.title!r} holds a formula that was never calculated; "
                    "open and save the file once in Excel or LibreOffice.",
                    f"Sel {formula.coordinate} di lembar {sheet.title!r} berisi rumus yang belum pernah dihitung; "
                    "buka dan simpan berkas itu sekali di Excel atau LibreOffice.")
            cells.append(float(value) if type(value) in (int, float) else "" if value is None else str(value).strip())
        grid.append((line, cells if any(cell != "" for cell in cells) else []))
    width = max((len(cells) for _, cells in grid), default=0)
    return [(line, cells and cells + [""] * (width - len(cells))) for line, cells in grid]


def _split(text, decimal):
    """A text -> its grid, perhaps followed by a remark (en, id): finds the separator."""
    for separator in "\t;":
        if separator in text:
            return [_csv(text, separator)]
    if "," not in text:
        return [_blanks(_csv(text, "\t"))]
    if '",' in text or ',"' in text:
        return [_csv(text, ",")]
    commas, whole = _csv(text, ","), _blanks(_csv(text, "\t"))
    if decimal == ",":
        return [whole]
    first, first_whole = (next((cells for _, cells in grid if cells), []) for grid in (commas, whole))
    if not any(map(_is_number, first + first_whole)):                               # headers decide
        return [commas if len(first) > 1 else whole]
    if ", " in text or not all(_is_number(cell) or _is_gap(cell) for _, cells in whole for cell in cells):
        return [commas]
    if not _even(commas):
        return [whole]
    if decimal == ".":
        return [commas]
    line, cell = next((line, cell) for line, cells in whole for cell in cells if "," in cell)
    if any(to_number(cell, ",") is None for _, cells in whole for cell in cells):
        raise InputError(f"Line {line}, {cell[:40]!r}: the comma may separate thousands or columns; add a header line, "
                         "use semicolons between columns, or choose the decimal sign.",
                         f"Baris {line}, {cell[:40]!r}: koma dapat memisahkan ribuan atau kolom; tambahkan baris "
                         "judul, pisahkan kolom dengan titik koma, atau pilih tanda desimal.")
    return whole, (f"; {cell[:40]!r} was read as one number with decimal comma, not as columns",
                   f"; {cell[:40]!r} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom")


def _csv(text, separator):
    """A text -> [(line, cells)]; a blank line has no cells."""
    reader = csv.reader(io.StringIO(text, newline=None), delimiter=separator, skipinitialspace=separator != "\t",
                        strict=True)
    grid = [(reader.line_num, [cell.strip() for cell in row]) for row in reader]
    return [(line, cells if any(cells) else []) for line, cells in grid]


def _blanks(grid):
    """The cells between blanks, or between two and more where single ones are part of a name."""
    single, several = ([(line, re.split(blanks, cells[0]) if cells else []) for line, cells in grid]
                       for blanks in (r"\s+", r"\s\s+"))
    if not _even(single) and _even(several) and any(_is_number(cell) for _, cells in several for cell in cells):
        return several
    return single


def _even(grid):
    return len({len(cells) for _, cells in grid if cells}) <= 1


# With decimal point; a thousands comma must stand before every group of three digits
POINT = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+|[1-9][0-9]{0,2}(,[0-9]{3})+(\.[0-9]*)?)([eE][+-]?[0-9]+)?")
INFINITE = re.compile(r"[+-]?(inf|infinity|∞)", re.IGNORECASE)
MINUS = str.maketrans("\u2212\u2013", "--")      # of typeset text
SWAP = str.maketrans(".,", ",.")


def _is_gap(cell):
    return isinstance(cell, str) and cell.translate(MINUS).lower() in ("", "na", "n/a", "nan", "null", "-", "#n/a")


def to_number(cell, decimal):
    """The number in a cell, NaN for a gap, None for anything else."""
    if isinstance(cell, float):
        return cell
    text = cell.translate(MINUS).translate(SWAP if decimal == "," else {})
    if POINT.fullmatch(text):
        return float(text.replace(",", ""))
    if INFINITE.fullmatch(text):
        return np.inf
    return np.nan if _is_gap(cell) else None


def _is_number(cell):
    return not _is_gap(cell) and (to_number(cell, ".") is not None or to_number(cell, ",") is not None)


def _table(grid, decimal, *remarks):
    filled = [k for k, (_, cells) in enumerate(grid) if cells]
    grid = grid[filled[0]:filled[-1] + 1] if filled else []
    _check_length(len(grid) - 1, MAX_READ, len(grid))
    width = len(grid[0][1]) if grid else 0
    for line, cells in grid:
        if cells and len(cells) != width:
            raise InputError(f"Line {line} has not as many cells ({len(cells)}) as the first line ({width}).",
                             f"Banyaknya sel di baris {line} ({len(cells)}) tidak sama dengan baris pertama ({width}).")
    columns = list(zip(*(cells or [""] * width for _, cells in grid)))
    has_header = not any(_is_number(column[0]) for column in columns) and any(
        not _is_gap(column[0]) and re.search(r"[^\W\d_]", column[0]) and any(map(_is_number, column))
        for column in columns)                      # a letter above numbers
    lines = np.array([line for line, _ in grid[has_header:]], dtype=int)
    sign, *sign_remark = _decimal_sign(grid[has_header:], decimal)
    numbers, skipped = {}, []
    for name, column in zip(_unique([column[0] if has_header else "" for column in columns]), columns):
        cells = column[has_header:]
        values = [to_number(cell, sign or ".") for cell in cells]
        if any(value is not None and value == value for value in values):
            numbers[name] = _checked(name, values, cells, lines)
        elif any(column):
            skipped.append(name)
    if not numbers:
        raise InputError("There is no column of numbers in it.", "Tidak ada kolom bilangan di dalamnya.")
    _check_length(len(lines), MAX_READ)
    gaps = sum(int(np.isnan(values).sum()) for values in numbers.values())
    en, id = {",": ("comma", "koma"), ".": ("point", "titik"), None: ("none", "tidak ada")}[sign]
    notes = [(f"Rows: {len(lines)}; columns: {len(numbers)} ({_listed(numbers)}); gaps: {gaps}; decimal sign: {en}",
              f"Baris: {len(lines)}; kolom: {len(numbers)} ({_listed(numbers)}); sel kosong: {gaps}; tanda desimal: {id}")]
    if skipped:
        notes.append((f"; left out, no numbers: {_listed(skipped)}", f"; tidak dipakai, tanpa bilangan: {_listed(skipped)}"))
    note_en, note_id = map("".join, zip(*notes, *sign_remark, *remarks, ".."))
    return Table(numbers, lines, tuple(skipped), sign, note_en, note_id)


def _check_length(rows, limit, told=None):
    if rows > limit:
        raise InputError(f"{told or rows} rows are too many; the limit is {limit}.",
                         f"{told or rows} baris terlalu banyak; batasnya {limit}.")


def _listed(names):
    return ", ".join(name[:40] for name in list(names)[:5]) + (", ..." if len(names) > 5 else "")


def _unique(names):
    """The names, none of them empty or twice."""
    result = []
    for position, name in enumerate(names, start=1):
        base = name = " ".join(str(name).split()) or str(position)
        count = 1
        while name in result:
            count += 1
            name = f"{base} ({count})"
        result.append(name)
    return result


def _decimal_sign(grid, decimal):
    """The decimal sign of a grid, None if no number has one, perhaps followed by a remark."""
    proof, maybe = {}, {}                           # sign -> the first cell that it alone, or also it, explains
    for line, cells in grid:
        for cell in cells:
            if isinstance(cell, str) and ("," in cell or "." in cell):
                readings = [sign for sign in ",." if to_number(cell, sign) is not None]
                if len(readings) == 1:
                    proof.setdefault(readings[0], (line, cell))
                elif readings:
                    maybe.setdefault("," if "," in cell else ".", (line, cell))
    found = proof or maybe
    if not found or decimal:
        return [decimal if found else None]
    if len(found) == 2:
        (line, cell), (other_line, other) = found["."], found[","]
        raise InputError(f"Both decimal point and comma occur: {cell[:40]!r} in line {line}, {other[:40]!r} in line "
                         f"{other_line}; use one, or choose the decimal sign.",
                         f"Ada titik dan koma desimal: {cell[:40]!r} di baris {line}, {other[:40]!r} di baris "
                         f"{other_line}; pakailah satu saja, atau pilih tanda desimal.")
    (sign, (_, cell)), = found.items()
    return [sign] if proof else (sign, (f" ({cell[:40]!r} was read as a decimal, not as thousands)",
                                        f" ({cell[:40]!r} dibaca sebagai desimal, bukan ribuan)"))


def _checked(name, values, cells, lines):
    for value, cell, line in zip(values, cells, lines):
        if value is None or abs(value) > MAX_NUMBER:
            en, id = ("neither a number nor a gap", "bukan bilangan dan bukan sel kosong") if value is None else (
                f"too large (beyond {MAX_NUMBER:g})", f"terlalu besar (di atas {MAX_NUMBER:g})")
            raise InputError(f"Line {line}, column {name[:40]!r}: {str(cell)[:40]!r} is {en}.",
                             f"Baris {line}, kolom {name[:40]!r}: {str(cell)[:40]!r} {id}.")
    return np.array(values, dtype=float)


# --- writing: the form of the paper, alive ---------------------------------------------------------------------------

FIRST = 7                                       # the first row of both tables
SMALL = "[=0]0;[<0.001]0.000000E+00;0.000000"   # format of a gain
POWER = "0.000000E+00"                          # format of a variance
DARK, PALE, INPUT, RESULT = "1F3A5F", "DCE6F1", "FFF2CC", "E2F0D9"     # colours
CHART_ROWS = 5000                               # a longer chart is slow

INPUTS = (("Q", "varians proses", "process var."), ("R", "varians ukur", "measurement var."),
          ("x0", "tebakan awal", "initial guess"), ("P0", "varians x0", "variance of x0"))
FILTER_HEADS = ("No", "Terukur /\nMeasured\nz", "Prediksi /\nPrediction\nx_pred",
                "Varians prediksi /\nIts variance\nP_pred", "Inovasi /\nInnovation\ny", "Penguatan /\nGain\nK",
                "Terfilter /\nFiltered\nx", "Varians /\nVariance\nP")
RTS_HEADS = ("No", "Terfilter /\nFiltered\nx", "Varians /\nVariance\nP", "P_pred berikutnya /\nnext P_pred",
             "Penguatan /\nGain\nG", "Terhaluskan /\nSmoothed\nx_smooth", "Varians /\nVariance\nP_smooth")
NOTES = (
    ("Apa ini?", "What is this?"),
    ("Filter Kalman skalar untuk satu kolom pengukuran, dihitung oleh rumus biasa tanpa makro: lembar Filter maju (waktu "
     "nyata), lembar RTS mundur (setelah semua data ada). Kuning: masukan yang boleh diubah; hijau: hasil.",
     "A scalar Kalman filter for one column of measurements, in plain formulas without macros: sheet Filter forwards "
     "(real time), sheet RTS backwards (once all data is there). Yellow: input, change it freely; green: result."),
    ("Persamaan", "Equations"),
    ("Model: x berubah acak dengan varians Q di setiap langkah; z mengukur x dengan varians derau R. Yang menentukan "
     "adalah Q/R: yang kecil lebih halus, tetapi lebih terlambat.",
     "Model: x changes at random with variance Q in every step; z measures x with noise variance R. What matters is Q/R: a "
     "small one is smoother, but lags more."),
    ("Prediksi: x_pred = x sebelumnya; P_pred = P sebelumnya + Q (baris pertama memakai x0 dan P0).",
     "Prediction: x_pred = previous x; P_pred = previous P + Q (the first row uses x0 and P0)."),
    ("Pembaruan: y = z - x_pred; K = P_pred / (P_pred + R); x = x_pred + K y; P = K R, sama dengan (1 - K) P_pred pada "
     "makalah. Sel Terukur yang kosong: K = 0.",
     "Update: y = z - x_pred; K = P_pred / (P_pred + R); x = x_pred + K y; P = K R, which equals the paper's "
     "(1 - K) P_pred. An empty Measured cell: K = 0."),
    ("Penghalusan: G = P / P_pred berikutnya; x_smooth = x + G (x_smooth berikutnya - x); "
     "P_smooth = G (Q + G P_smooth berikutnya). Baris terakhir: x dan P.",
     "Smoothing: G = P / next P_pred; x_smooth = x + G (next x_smooth - x); P_smooth = G (Q + G next P_smooth). "
     "Last row: x and P."),
    ("Memakai data sendiri", "Using your own data"),
    ("Tempelkan data sebagai bilangan ke kolom Terukur (B) lembar Filter, mulai baris {first}. Data lebih panjang: salin "
     "baris terakhir ke bawah sampai data habis, di kedua lembar, dan tarik jangkauan grafik (baris {first} sampai "
     "{chart_end}). Data lebih pendek: kosongkan sel Terukur yang berlebih.",
     "Paste your data as numbers into the Measured column (B) of sheet Filter, from row {first} on. Longer data: copy the "
     "last row down to where the data ends, on both sheets, and drag the range of the charts (rows {first} to "
     "{chart_end}). Shorter data: clear the Measured cells left over."),
    ("Sel bernama: Q_, R_, x0_, P0_ (Excel tidak mengizinkan nama R).",
     "Named cells: Q_, R_, x0_, P0_ (Excel does not allow the name R)."),
    ("Sumber", "Source"),
    ("Formulir ini mengikuti lembar kerja Rudiyanto, Setiawan dan Saptomo (2006), yang memakai makro Excel.",
     "The form follows the worksheet of Rudiyanto, Setiawan and Saptomo (2006), which used an Excel macro."),
)


def write_workbook(target, z, Q, R, x0=0.0, P0=1.0, name="Measured"):
    """Write the measurements z (T,) and live formulas that filter and smooth them into an .xlsx.

    target  a path or a binary file object
    z       (T,) up to 100,000, NaN = gap
    Q, R    variances of process and measurement noise, unit of z squared; x0, P0 first guess and its variance
    name    what was measured; never a formula

    InputError: z is empty, too long or infinite; Q, R, x0 or P0 out of range.
    """
    z = np.asarray(z, dtype=float)
    if z.ndim != 1 or len(z) == 0 or (np.abs(z) > MAX_NUMBER).any():
        raise InputError("z must be one column of finite numbers.", "z harus satu kolom bilangan berhingga.")
    _check_length(len(z), MAX_WRITE)
    for letter, value, ok, en, id in (("Q", Q, Q >= 0, ">= 0", ">= 0"), ("R", R, R > 0, "> 0", "> 0"),
                                      ("x0", x0, True, "finite", "berhingga"), ("P0", P0, P0 >= 0, ">= 0", ">= 0")):
        if not ok or not abs(value) <= MAX_NUMBER:
            raise InputError(f"{letter} is {value}, but must be {en}.", f"{letter} bernilai {value}, seharusnya {id}.")
    book = Workbook(write_only=True)                # row by row needs little memory
    book.calculation.fullCalcOnLoad = True
    book.properties.creator = "Filter Kalman, Makalah demi Makalah / The Kalman Filter, Paper by Paper"
    chart_end = FIRST + min(len(z), CHART_ROWS) - 1
    scale = np.nanmax(np.abs(z), initial=0)
    data = "0.000000" if scale == 0 or 0.01 <= scale < 1e6 else POWER       # format of z and x
    _write_filter(book, z, (Q, R, x0, P0), str(name), data, chart_end)
    _write_rts(book, len(z), data, chart_end)
    _write_notes(book, chart_end)
    book.save(target)


def _write_filter(book, z, inputs, name, data, chart_end):
    sheet = _new_sheet(book, "Filter", (7, 16, 17, 17, 16, 16, 16, 16), (26, 18, 50, 18, 6, 50),
                       "Filter Kalman skalar / Scalar Kalman filter",
                       "Ubah sel kuning; semua rumus menghitung ulang. / Change the yellow cells; every formula follows.")
    labels = [f"{letter}\n{id} /\n{en}" for letter, id, en in INPUTS]
    labels += ["N\njumlah data /\nhow many", "Data\nnama kolom /\ncolumn name"]
    sheet.append([None] + [_cell(sheet, label, fill=PALE, centre=True) for label in labels])
    values = [_cell(sheet, float(value), bold=True, fill=INPUT, centre=True) for value in inputs]
    count = _cell(sheet, f"=COUNT(B{FIRST}:B1048576)", bold=True, centre=True)
    name = " ".join(re.sub(r"[\x00-\x1f\x7f]", " ", name).split())[:100]         # no control characters
    sheet.append([None] + values + [count, _cell(sheet, name, text=True, bold=True, wrap=False)])
    for (letter, _, _), column in zip(INPUTS, "BCDE"):
        book.defined_names[f"{letter}_"] = DefinedName(f"{letter}_", attr_text=f"Filter!${column}$4")

    def contents(r):
        known, z_k = f"=IF(ISNUMBER(B{r}),", z[r - FIRST]
        return (r - FIRST + 1, None if np.isnan(z_k) else float(z_k),
                f"=G{r - 1}" if r > FIRST else "=x0_", f"=H{r - 1}+Q_" if r > FIRST else "=P0_+Q_",
                f'{known}B{r}-C{r},"")', f"{known}D{r}/(D{r}+R_),0)",
                f"{known}C{r}+F{r}*E{r},C{r})", f"{known}F{r}*R_,D{r})")

    _write_rows(sheet, FILTER_HEADS, ("0", data, data, POWER, data, SMALL, data, POWER), {1: INPUT, 6: RESULT}, contents, len(z))
    sheet.add_chart(_chart("Filter Kalman / Kalman filter", chart_end,
                           (sheet, 2, "Terukur / Measured"), (sheet, 7, "Terfilter / Filtered")), f"J{FIRST}")


def _write_rts(book, T, data, chart_end):
    sheet = _new_sheet(book, "RTS", (7, 16, 16, 20, 16, 16, 16), (26, 18, 18, 18, 6, 50),
                       "Penghalus RTS / RTS smoother",
                       "Berjalan mundur: setiap nilai juga mengenal pengukuran sesudahnya. / "
                       "Runs backwards: every value knows the later measurements too.",
                       "G = P / P_pred'     x_smooth = x + G (x_smooth' - x)     P_smooth = G (Q + G P_smooth')",
                       "Tanda ' = baris berikutnya. / The sign ' = the next row.")

    def contents(r):
        known = f"=IF(ISNUMBER(E{r}),"              # not in the last row
        return (f"=Filter!A{r}", f"=Filter!G{r}", f"=Filter!H{r}",
                f'=IF(ISNUMBER(Filter!D{r + 1}),Filter!D{r + 1},"")',
                f'=IF(ISNUMBER(D{r}),IF(D{r}=0,0,C{r}/D{r}),"")',
                f"{known}B{r}+E{r}*(F{r + 1}-B{r}),B{r})", f"{known}E{r}*(Q_+E{r}*G{r + 1}),C{r})")

    _write_rows(sheet, RTS_HEADS, ("0", data, POWER, POWER, SMALL, data, POWER), {5: RESULT}, contents, T)
    first_sheet = book["Filter"]
    sheet.add_chart(_chart("Penghalus RTS / RTS smoother", chart_end,
                           (first_sheet, 2, "Terukur / Measured"), (first_sheet, 7, "Terfilter / Filtered"),
                           (sheet, 6, "Terhaluskan / Smoothed")), f"I{FIRST}")


def _write_notes(book, chart_end):
    sheet = _new_sheet(book, "Catatan - Notes", (76, 76), (26,), frozen="A2")
    sheet.append([_title(sheet, text, True) for text in ("Catatan", "Notes")])
    for row, pair in enumerate(NOTES, start=2):
        heading = len(pair[0]) < 25
        pair = [text.format(first=FIRST, chart_end=chart_end) for text in pair]
        sheet.row_dimensions[row].height = 19 + 16 * ((max(map(len, pair)) - 1) // 72)
        sheet.append([_cell(sheet, text, bold=heading, fill=PALE if heading else None) for text in pair])


def _new_sheet(book, title, widths, heights, *texts, frozen=f"A{FIRST}"):
    """A sheet with widths (characters), heights (points), a title and more lines."""
    sheet = book.create_sheet(title)
    sheet.freeze_panes = frozen
    for letter, width in zip("ABCDEFGH", widths):
        sheet.column_dimensions[letter].width = width
    for row, height in enumerate(heights, start=1):
        sheet.row_dimensions[row].height = height
    sheet.page_setup.orientation, sheet.page_setup.fitToHeight = "landscape", 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    for k, text in enumerate(texts):
        sheet.append([_cell(sheet, text, wrap=False) if k else _title(sheet, text, False)])
    return sheet


def _title(sheet, text, wrap):
    return _cell(sheet, text, bold=True, size=15, colour=DARK, wrap=wrap)


def _write_rows(sheet, heads, formats, fills, contents, T):
    """The heads, then T rows of contents(r)."""
    sheet.append([])
    sheet.append([_cell(sheet, text, bold=True, colour="FFFFFF", fill=DARK, centre=True) for text in heads])
    row = [_cell(sheet, None, format=format, fill=fills.get(k), centre=k == 0) for k, format in enumerate(formats)]
    for r in range(FIRST, FIRST + T):
        for cell, content in zip(row, contents(r)):     # the same cells again: a row is written at once
            cell.value = content
        sheet.append(row)


def _cell(sheet, value, format="General", text=False, bold=False, size=11, colour="000000", fill=None, centre=False,
          wrap=True):
    """A styled cell. text=True: never a formula."""
    cell = WriteOnlyCell(sheet, value)
    if text:
        cell.data_type, cell.quotePrefix = "s", True
    cell.number_format, cell.font = format, Font("Calibri", size, bold, color=colour)
    horizontal = "center" if centre else None
    if isinstance(value, str):
        cell.alignment = Alignment(wrap_text=wrap, vertical=horizontal or "top", horizontal=horizontal)
    elif centre:
        cell.alignment = Alignment(horizontal=horizontal)
    if fill:
        cell.fill = PatternFill("solid", fgColor=fill)
        cell.border = Border(*(Side("thin", color="BFBFBF"),) * 4)
    return cell


def _chart(title, chart_end, *lines):
    """A chart of (sheet, column, title), column 2 as dots."""
    chart = LineChart()
    chart.title, chart.width, chart.height = title, 20, 11          # centimetres
    chart.x_axis.title, chart.y_axis.title = "No", "nilai / value"
    chart.x_axis.delete = chart.y_axis.delete = False
    chart.x_axis.tickLblPos, chart.y_axis.number_format = "low", "General"
    chart.x_axis.tickLblSkip = chart.x_axis.tickMarkSkip = max(1, (chart_end - FIRST + 1) // 16)
    chart.y_axis.majorGridlines.spPr = GraphicalProperties(ln=LineProperties(solidFill="E0E0E0"))
    chart.legend.position, chart.dispBlanksAs = "b", "gap"
    for (sheet, column, name), colour in zip(lines, ("7F7F7F", "0072B2", "D55E00")):
        series = Series(Reference(sheet, min_col=column, min_row=FIRST, max_row=chart_end), title=name)
        series.smooth, series.marker.symbol = False, "none"
        line = series.graphicalProperties.line
        if column == 2:
            series.marker.symbol, series.marker.size = "circle", 6
            series.marker.graphicalProperties.solidFill = colour
            line.noFill = True
        else:
            line.solidFill, line.width = colour, 28000              # 1/12700 point
        chart.series.append(series)
    chart.set_categories(Reference(lines[0][0], min_col=1, min_row=FIRST, max_row=chart_end))
    return chart
