"""One cell of a table: a number, a gap, a time, or words.

Every pattern reads a cell once from left to right, whatever stands in it; nothing is tried twice.
"""

import re

import numpy as np

from .clock import is_time
from .units import CURRENCIES, is_unit

LONGEST_NUMBER = 400  # characters
EXPONENT = r"([eE][+-]?[0-9]+)?"
GROUPS = "\u00a0\u202f\u2009 '\u2019"  # blanks and apostrophes between groups of three digits
# A number with decimal point; whole groups of three digits where something parts the thousands.
PLAIN = re.compile(rf"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+){EXPONENT}")
WITH_COMMAS = re.compile(rf"[+-]?[1-9][0-9]{{0,2}}(,[0-9]{{3}})+(\.[0-9]*)?{EXPONENT}")
WITH_GROUPS = re.compile(rf"[+-]?[1-9][0-9]{{0,2}}([{GROUPS}][0-9]{{3}})+(\.[0-9]*)?{EXPONENT}")
GROUP_SIGNS = re.compile(f"[,{GROUPS}]")
DIGITS_FIRST = re.compile(rf"[+-]?[0-9.,{GROUPS}]*[0-9.,]")
CURRENCY = re.compile("|".join(map(re.escape, CURRENCIES)))
BEGINS = re.compile(rf"[+\-\u2212\u2013]?[0-9.,]|{CURRENCY.pattern}")
INFINITE = re.compile(r"[+-]?(inf|infinity|∞)", re.IGNORECASE)
EITHER = re.compile(rf"[+-]?[0-9]{{1,30}}([.,][0-9]{{1,30}})?{EXPONENT}")
LONGEST_GAP = 4  # characters
GAPS = ("", "na", "n/a", "nan", "null", "none", "-", "--", "---", "#n/a", "nat")
PLAIN_MINUS = str.maketrans("\u2212\u2013", "--")  # typeset text has longer ones
SWAP = str.maketrans(".,", ",.")


def is_gap(cell):
    """Does the cell say that nothing was measured?"""
    if not isinstance(cell, str) or len(cell) > LONGEST_GAP:
        return False
    return cell == "" or cell.translate(PLAIN_MINUS).lower() in GAPS


def is_number(cell):
    """Is it a number, with whichever decimal sign, alone or with its unit?"""
    if isinstance(cell, float) or EITHER.fullmatch(cell):
        return True
    if not BEGINS.match(cell):
        return bool(INFINITE.fullmatch(cell))
    return any(number_in(cell, decimal)[0] is not None for decimal in ".,")


def is_value(cell):
    """A number or a time?"""
    if isinstance(cell, float) or EITHER.fullmatch(cell):
        return True
    return is_time(cell) or is_number(cell)


def has_letter(cell):
    return isinstance(cell, str) and any(sign.isalpha() for sign in cell)


def to_number(cell, decimal):
    """The number in a cell, NaN for a gap, None for anything else; decimal: its sign, "," or
    "."."""
    if isinstance(cell, float):
        return cell
    if len(cell) > LONGEST_NUMBER:
        return None
    text = cell.translate(PLAIN_MINUS)
    if decimal == ",":
        text = text.translate(SWAP)
    if PLAIN.fullmatch(text):
        return float(text)
    if WITH_COMMAS.fullmatch(text) or WITH_GROUPS.fullmatch(text):
        return float(GROUP_SIGNS.sub("", text))
    if INFINITE.fullmatch(text):
        return np.inf
    return np.nan if is_gap(cell) else None


def number_in(cell, decimal):
    """(number, unit): as to_number, also beside a unit or a currency, "21,5 °C", "Rp 1.500"."""
    number = to_number(cell, decimal)
    if number is not None:
        return number, ""
    digits, unit = parted(cell)
    return (to_number(digits, decimal), unit) if unit else (None, "")


def parted(cell):
    """ "21,5 °C" -> ("21,5", "°C"); the unit is "" where there is none that we know."""
    if len(cell) > LONGEST_NUMBER:
        return cell, ""
    text = cell.translate(PLAIN_MINUS)
    if found := CURRENCY.match(text):
        return text[found.end() :].strip(" .\u00a0"), found[0]
    found = DIGITS_FIRST.match(text)
    rest = text[found.end() :].strip() if found else ""
    return (found[0], rest) if is_unit(rest) or rest in CURRENCIES else (cell, "")


def quoted(cell):
    """The cell as a message shows it: the beginning is enough to find it."""
    return repr(shown(cell)[:40])


def shown(cell):
    """The cell as text; 2019, not 2019.0, of a workbook."""
    return f"{cell:.15g}" if isinstance(cell, float) else cell
