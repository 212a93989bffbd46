"""What archives have in common, recordings (archives.py) and workbooks (sheets.py) alike."""

import struct
import zipfile
import zlib
from lzma import LZMAError
from xml.parsers.expat import ExpatError

TEXTS = (".csv", ".txt", ".tsv")
NOT_DATA = {"meta", "__macosx"}  # folders that phyphox and macOS add
DAMAGED = (  # what unpacking a damaged or locked archive raises
    zipfile.BadZipFile,
    zlib.error,
    LZMAError,
    struct.error,
    ExpatError,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    ValueError,
    LookupError,
    OverflowError,
)


def is_data(path):
    """Does a file lie outside the folders that apps add? path: in the archive or the folder."""
    return not NOT_DATA & set(path.replace("\\", "/").lower().split("/")[:-1])
