"""Old Excel workbooks (.xls), which phyphox writes on some phones: read by xlrd."""

import io

from .errors import InputError

MAX_BYTES = 20_000_000
MAX_CELLS = 1_000_000


def read_xls(place, content):
    """The bytes of a workbook -> [(title of a sheet, its text with tabs)], of sheets with cells."""
    if len(content) > MAX_BYTES:
        raise _refused(place)
    try:
        import xlrd
    except ImportError:
        raise _refused(place) from None
    try:
        book = xlrd.open_workbook(file_contents=content, logfile=io.StringIO(), on_demand=True)
        return [(sheet.name, _text_of(place, sheet)) for sheet in book.sheets() if sheet.nrows]
    except InputError:
        raise
    except Exception:  # a damaged file breaks xlrd in many ways
        raise _refused(place) from None


def _text_of(place, sheet):
    if sheet.nrows * sheet.ncols > MAX_CELLS:
        raise _refused(place)
    rows = (map(_shown, sheet.row_values(row)) for row in range(sheet.nrows))
    return "\n".join("\t".join(row) for row in rows)


def _shown(value):
    return repr(value) if isinstance(value, float) else " ".join(str(value).split())


def _refused(place):
    return InputError(
        f"{place}: this .xls file cannot be read here; open it and save it as .xlsx, or export a "
        ".csv.",
        f"{place}: berkas .xls ini tidak dapat dibaca di sini; simpanlah sebagai .xlsx, atau "
        "ekspor .csv.",
    )
