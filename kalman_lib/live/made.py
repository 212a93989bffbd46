"""What `make explorers` has made from the sources of the book: explorers and exercises."""

import functools
from pathlib import Path

BUNDLE = Path(__file__).parent / "bundle"


@functools.cache
def made(name):
    """The text of one of the files."""
    try:
        return (BUNDLE / name).read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileNotFoundError(
            "The explorers and exercises are not made yet: run `make explorers` in the folder of "
            "the book. / Penjelajah dan latihannya belum dibuat: jalankan `make explorers` di "
            "folder buku ini."
        ) from None
