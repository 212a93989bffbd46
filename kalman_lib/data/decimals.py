"""Which decimal sign do the numbers of a table have?"""

import re

from .cells import number_in, quoted
from .errors import InputError
from .units import CURRENCIES

NO_REMARK = None
SIGNS = (",", ".")
PROVES = {  # numbers that only this sign explains
    sign: re.compile(
        rf"[+-]?[0-9]*[{sign}]([0-9]{{1,2}}|[0-9]{{4,20}})|[+-]?0[{sign}][0-9]{{0,20}}"
    )
    for sign in SIGNS
}
ROUND = re.compile(r"[^0-9]*[0-9]{1,3}[.,]000[^0-9]*")


def sign_of(rows, columns, decimal):
    """The decimal sign of rows [(line, cells)] (None: no number has one) and a remark {en, id}.

    columns: the places of those that may hold numbers.
    """
    proof, maybe, is_round = _signs_in(rows, columns)
    found = proof or maybe
    if not found or decimal:
        return (decimal if found else None), NO_REMARK
    if len(found) == 2:
        raise _both_signs(*found["."], *found[","])
    ((sign, (line, cell)),) = found.items()
    if proof:
        return sign, NO_REMARK
    if is_round:
        raise _round(line, cell)
    return sign, {
        "en": f"{quoted(cell)} was read as a decimal, not as thousands",
        "id": f"{quoted(cell)} dibaca sebagai desimal, bukan ribuan",
    }


def _signs_in(rows, columns):
    """Two dicts {sign: the first (line, cell)}: cells that only this sign explains, or also this
    one; and whether all of the latter are whole thousands."""
    proof, maybe, is_round = {}, {}, True
    for line, cells in rows:
        for column in columns if cells else ():
            cell = cells[column]
            if not isinstance(cell, str) or not ("," in cell or "." in cell):
                continue
            if len(proof) == 1 and PROVES[next(iter(proof))].fullmatch(cell):
                continue  # it says the same again
            readings = [sign for sign in SIGNS if number_in(cell, sign)[0] is not None]
            if len(readings) == 1:
                proof.setdefault(readings[0], (line, cell))
            elif readings and number_in(cell, ".")[1] in CURRENCIES:
                proof.setdefault("," if "." in cell else ".", (line, cell))  # money: thousands
            elif readings:
                maybe.setdefault("," if "," in cell else ".", (line, cell))
                is_round = is_round and bool(ROUND.fullmatch(cell[:100]))
    return proof, maybe, is_round


def _both_signs(line, cell, other_line, other):
    return InputError(
        f"Both decimal point and comma occur: {quoted(cell)} in line {line}, {quoted(other)} in "
        f"line {other_line}; use one, or choose the decimal sign.",
        f"Ada titik dan koma desimal: {quoted(cell)} di baris {line}, {quoted(other)} di baris "
        f"{other_line}; pakailah satu saja, atau pilih tanda desimal.",
    )


def _round(line, cell):
    sign_en, sign_id = ("point", "titik") if "." in cell else ("comma", "koma")
    return InputError(
        f"Line {line}, {quoted(cell)}: the {sign_en} may be a thousand or a decimal sign; choose "
        "the decimal sign.",
        f"Baris {line}, {quoted(cell)}: {sign_id} di situ dapat berarti ribuan atau desimal; "
        "pilihlah tanda desimal.",
    )
