"""Files, folders and archives of a recording in, {name: bytes} of its tables out."""

import io
import zipfile
from pathlib import Path

from .errors import InputError
from .zips import DAMAGED, TEXTS, is_data

MAX_BYTES = 60_000_000  # of all files together: an hour of three sensors at 100 Hz
MAX_PARTS = 1000  # of an archive
WORKBOOKS = (".xlsx", ".xls")
READABLE = (*TEXTS, *WORKBOOKS)


def open_files(files):
    """{name: bytes}, a path or a list of paths -> {name: bytes} of the tables in them."""
    if isinstance(files, dict):
        files = {name: content for name, content in files.items() if is_data(name)}
    else:
        files = _read_paths([files] if isinstance(files, (str, Path)) else files)
    tables = {}
    for name, content in files.items():
        if bytes(content[:2]) == b"PK" and not name.lower().endswith(".xlsx"):
            tables |= _unpack(name, content, _size(tables))
        else:
            tables[name] = bytes(content)
        _check_size(_size(tables))
    if not tables:
        raise InputError(
            "There is no table in the files; a .csv, .zip or .xlsx export is needed.",
            "Tidak ada tabel dalam berkas; diperlukan ekspor .csv, .zip atau .xlsx.",
        )
    return tables


def _read_paths(paths):
    """{path: bytes} of files, and of the files in folders."""
    found = []
    for path in map(Path, paths):
        if not path.exists():
            raise InputError(f"There is no file {str(path)!r}.", f"Tidak ada berkas {str(path)!r}.")
        found += _in_folder(path) if path.is_dir() else [path]
    found = [
        path for path in found if path.is_file() and path.suffix.lower() in (*READABLE, ".zip")
    ]
    _check_size(sum(path.stat().st_size for path in found))
    return {str(path): path.read_bytes() for path in found}


def _in_folder(folder):
    paths = sorted(folder.rglob("*"))
    return [path for path in paths if is_data(path.relative_to(folder).as_posix())]


def _unpack(name, content, size_so_far):
    """{name/part: bytes} of the tables in an archive."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            parts = [part for part in archive.infolist() if _is_table(part.filename)]
            if len(parts) > MAX_PARTS:
                raise _too_many(name, len(parts))
            _check_size(size_so_far + sum(part.file_size for part in parts))  # before unpacking
            tables = {}
            for part in parts:
                with archive.open(part) as file:  # its size may be a lie
                    tables[f"{name}/{part.filename}"] = file.read(MAX_BYTES + 1)
                _check_size(size_so_far + _size(tables))
            return tables
    except InputError:
        raise
    except DAMAGED:
        raise InputError(
            f"The archive {_short(name)} cannot be unpacked: it is damaged or locked; export it "
            "again.",
            f"Arsip {_short(name)} tidak dapat dibuka: rusak atau terkunci; eksporlah sekali lagi.",
        ) from None


def _short(name):
    return repr(name if len(name) <= 60 else "..." + name[-57:])


def _too_many(name, parts):
    return InputError(
        f"The archive {_short(name)} holds {parts} tables; the limit is {MAX_PARTS}.",
        f"Arsip {_short(name)} berisi {parts} tabel; batasnya {MAX_PARTS}.",
    )


def _is_table(path):
    return path.lower().endswith(READABLE) and is_data(path)


def _size(tables):
    return sum(len(content) for content in tables.values())


def _check_size(size):
    if size > MAX_BYTES:
        megabytes, most = size // 10**6, MAX_BYTES // 10**6
        raise InputError(
            f"The files hold {megabytes} MB; the limit is {most} MB.",
            f"Berkas berisi {megabytes} MB; batasnya {most} MB.",
        )
