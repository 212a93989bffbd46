"""One cell of a table: a number, a gap, or neither."""

import re

import numpy as np

# A number with decimal point; a comma for thousands must stand before every group of three digits.
WHOLE = r"[0-9]+\.?[0-9]*"
FRACTION = r"\.[0-9]+"
THOUSANDS = r"[1-9][0-9]{0,2}(,[0-9]{3})+(\.[0-9]*)?"
EXPONENT = r"[eE][+-]?[0-9]+"
POINT = re.compile(f"[+-]?({WHOLE}|{FRACTION}|{THOUSANDS})({EXPONENT})?")
INFINITE = re.compile(r"[+-]?(inf|infinity|∞)", re.IGNORECASE)
GAPS = ("", "na", "n/a", "nan", "null", "-", "#n/a")
PLAIN_MINUS = str.maketrans("\u2212\u2013", "--")  # typeset text has longer ones
SWAP = str.maketrans(".,", ",.")


def is_gap(cell):
    """Does the cell say that nothing was measured?"""
    return isinstance(cell, str) and cell.translate(PLAIN_MINUS).lower() in GAPS


def is_number(cell):
    """Is it a number, with whichever decimal sign?"""
    return not is_gap(cell) and any(to_number(cell, decimal) is not None for decimal in ".,")


def to_number(cell, decimal):
    """The number in a cell, NaN for a gap, None for anything else; decimal: its sign, "," or
    "."."""
    if isinstance(cell, float):
        return cell
    text = cell.translate(PLAIN_MINUS)
    if decimal == ",":
        text = text.translate(SWAP)
    if POINT.fullmatch(text):
        return float(text.replace(",", ""))
    if INFINITE.fullmatch(text):
        return np.inf
    return np.nan if is_gap(cell) else None


def quoted(cell):
    """The cell as a message shows it: the beginning is enough to find it."""
    return repr(str(cell)[:40])
