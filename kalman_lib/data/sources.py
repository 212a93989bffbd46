"""What read_table is given: a path, the bytes of a file or a text; which kind of file it is."""

from pathlib import Path

from .errors import InputError
from .grid import decode
from .limits import MAX_BYTES, too_large
from .sheets import grids

ENDINGS = (".csv", ".txt", ".tsv", ".dat", ".xlsx", ".xls", ".ods", ".zip")
LONGEST_PATH = 1000
ARCHIVE, COMPOUND = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"
ENCRYPTED = "EncryptedPackage".encode("utf-16-le")


def named_source(source):
    """(name, bytes or text) of what read_table is given."""
    if isinstance(source, (bytes, bytearray, memoryview)):
        return "", bytes(source)
    text = str(source)
    if isinstance(source, str) and ("\n" in text or len(text) > LONGEST_PATH):
        return "", text
    if isinstance(source, str) and not text.lower().endswith(ENDINGS) and not _is_file(text):
        return "", text
    path = Path(source)
    try:
        if path.stat().st_size > 5 * MAX_BYTES:
            raise too_large(path.stat().st_size)
        return path.name, path.read_bytes()
    except (OSError, ValueError):
        shown = repr(path.name[:60])
        raise InputError(
            f"The file {shown} cannot be opened.", f"Berkas {shown} tidak dapat dibuka."
        ) from None


def _is_file(text):
    try:
        return Path(text).is_file()
    except (OSError, ValueError):
        return False


def text_of(name, content):
    """The text of a file, None if it is a workbook; InputError: another kind of file."""
    if isinstance(content, str):
        return content
    if content.startswith(ARCHIVE):
        return None
    if content.startswith(COMPOUND):
        raise _old_or_locked(name, content)
    if len(content) > MAX_BYTES:
        raise too_large(len(content))
    text = decode(content)
    if text is None:
        raise unreadable(name)
    return text


def grids_of(name, content, skip=()):
    """{title: grid} of the sheets with numbers of a workbook."""
    return dict(grids(name, content, skip))


def unreadable(name):
    """The InputError for a file of another kind."""
    shown_en, shown_id = named(name)
    return InputError(
        f"{shown_en} is not a text file (.csv, .txt, .tsv) nor an Excel file (.xlsx); save it as "
        "one of these.",
        f"{shown_id} bukan berkas teks (.csv, .txt, .tsv) dan bukan berkas Excel (.xlsx); "
        "simpanlah sebagai salah satunya.",
    )


def named(name):
    shown = repr(name[:60])
    return (shown, shown) if name else ("This", "Ini")


def _old_or_locked(name, content):
    shown_en, shown_id = named(name)
    if ENCRYPTED in content[:2_000_000]:
        return InputError(
            f"{shown_en} is protected by a password; save it without one.",
            f"{shown_id} dikunci dengan kata sandi; simpanlah tanpa kata sandi.",
        )
    return InputError(
        f"{shown_en} is an old Excel file (.xls); open it and save it as .xlsx or .csv.",
        f"{shown_id} berkas Excel lama (.xls); bukalah lalu simpan sebagai .xlsx atau .csv.",
    )
