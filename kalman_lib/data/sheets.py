"""The bytes of an Excel workbook, or of an archive of texts, in, grids out.

A workbook is an archive of XML, whose size is checked before and while it is read. (openpyxl fills
every row and cell up to the last one, however far away it is.)
"""

import io
import posixpath
import zipfile

from . import openxml
from .cells import is_number, quoted
from .errors import InputError
from .grid import decode, split
from .limits import MAX_BYTES, too_large
from .zips import DAMAGED, TEXTS, is_data

MAX_PART = 50_000_000  # bytes of one part of the archive
MAX_PARTS = 10_000


def grids(name, content, skip=()):
    """Yields (title, grid) of each sheet with numbers, without those in skip."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            yield from _grids(name, archive, skip)
    except InputError:
        raise
    except DAMAGED as error:
        raise damaged(name) from error


def damaged(name):
    shown_en, shown_id = (quoted(name), quoted(name)) if name else ("This file", "Berkas ini")
    return InputError(
        f"{shown_en} is damaged: it cannot be unpacked as an .xlsx file; save it again.",
        f"{shown_id} rusak: tidak dapat dibuka sebagai .xlsx; simpanlah sekali lagi.",
    )


def _grids(name, archive, skip):
    paths = archive.namelist()
    if len(paths) > MAX_PARTS:
        raise _too_large(name)
    book = next((path for path in paths if path.endswith("xl/workbook.xml")), None)
    if book is None:
        yield from _texts(name, archive, paths)
        return
    folder = posixpath.dirname(book)

    def part(path):
        return _part(name, archive, path) if path in paths else b""

    sheets, starts_1904 = openxml.sheets_in(part(book))
    targets = openxml.relations_in(part(f"{folder}/_rels/workbook.xml.rels"))
    strings = openxml.strings_in(part(f"{folder}/sharedStrings.xml"))
    formats = openxml.formats_in(part(f"{folder}/styles.xml"))
    for title, relation in sheets:
        path = posixpath.normpath(posixpath.join("/" + folder, targets.get(relation, ""))).strip(
            "/"
        )
        if title in skip or path not in paths or "worksheet" not in path:
            continue
        grid = openxml.grid_in(part(path), title, strings, formats, starts_1904)
        if any(is_number(cell) for _, cells in grid for cell in cells):
            yield title, grid


def _texts(name, archive, paths):
    """The same of an archive of texts, as phone apps export: each is a sheet of its own."""
    texts = [path for path in paths if path.lower().endswith(TEXTS) and is_data(path)]
    if not texts:
        raise _no_workbook(name)
    size = 0
    for path in texts:
        content = _part(name, archive, path)
        size += len(content)
        if size > MAX_BYTES:
            raise too_large(size)
        text = decode(content)
        grid = split(text.removeprefix("\ufeff"), None)[0] if text else []
        if any(is_number(cell) for _, cells in grid for cell in cells):
            yield path, grid


def _part(name, archive, path):
    """The bytes of one part; InputError while unpacking, if they are too many."""
    with archive.open(path) as file:
        content = file.read(MAX_PART + 1)
    if len(content) > MAX_PART:
        raise _too_large(name)
    return content


def _too_large(name):
    most = MAX_PART // 10**6
    shown_en, shown_id = (quoted(name), quoted(name)) if name else ("This file", "Berkas ini")
    return InputError(
        f"{shown_en} unpacks to more than {most} MB, the limit.",
        f"{shown_id} menjadi lebih dari {most} MB setelah dibuka; itu batasnya.",
    )


def _no_workbook(name):
    shown_en, shown_id = (quoted(name), quoted(name)) if name else ("This", "Ini")
    return InputError(
        f"{shown_en} is an archive, but not an Excel .xlsx file; open it and save it as .xlsx or "
        ".csv.",
        f"{shown_id} sebuah arsip, tetapi bukan berkas Excel .xlsx; bukalah lalu simpan sebagai "
        ".xlsx atau .csv.",
    )
