"""How much is read, and the sentences for what is more: checked before and while reading."""

from .errors import InputError

MAX_READ = 200_000  # rows of a table
MAX_BYTES = 16_000_000  # of a text
MAX_CELLS = 1_000_000  # of a table
MAX_COLUMNS = 1000
MAX_NUMBER = 1e300


def too_long(rows, limit=MAX_READ):
    """The InputError for more rows than the limit."""
    return InputError(
        f"{rows} rows are too many; the limit is {limit}.",
        f"{rows} baris terlalu banyak; batasnya {limit}.",
    )


def too_wide(columns, limit=MAX_COLUMNS):
    return InputError(
        f"{columns} columns are too many; the limit is {limit}.",
        f"{columns} kolom terlalu banyak; batasnya {limit}.",
    )


def too_large(size, limit=MAX_BYTES):
    megabytes, most = -(-size // 10**6), limit // 10**6
    return InputError(
        f"{megabytes} MB are too much; the limit is {most} MB.",
        f"{megabytes} MB terlalu besar; batasnya {most} MB.",
    )


def too_many_cells(cells, limit=MAX_CELLS):
    return InputError(
        f"{cells} cells are too many; the limit is {limit}.",
        f"{cells} sel terlalu banyak; batasnya {limit}.",
    )
