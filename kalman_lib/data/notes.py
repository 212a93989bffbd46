"""What was understood, in short sentences of both languages: [{"en", "id"}, ...]."""

import numpy as np

MAX_LISTED = 5  # names of columns, stretches of lines
LONGEST_NAME = 40


def joined(notes):
    """One sentence of each language."""
    return {language: "; ".join(one[language] for one in notes) + "." for language in ("en", "id")}


def about(columns, units, time, value, skipped, sign, passed):
    """The first notes on a table: its size, its columns, what was left out."""
    rows = len(next(iter(columns.values())))
    missing = sum(int(np.isnan(values).sum()) for values in columns.values())
    signs = {",": ("comma", "koma"), ".": ("point", "titik"), None: ("none", "tidak ada")}
    sign_en, sign_id = signs[sign]
    count = f"{len(columns)} ({listed(columns)})"
    notes = [
        {
            "en": f"Rows: {rows}; columns: {count}; gaps: {missing}; decimal sign: {sign_en}",
            "id": f"Baris: {rows}; kolom: {count}; sel kosong: {missing}; tanda desimal: {sign_id}",
        }
    ]
    if time:
        shown = _with_unit(time, units)
        notes.append({"en": f"time column: {shown}", "id": f"kolom waktu: {shown}"})
    if len(columns) > 1:
        shown = _with_unit(value, units)
        notes.append({"en": f"measured column: {shown}", "id": f"kolom terukur: {shown}"})
    if skipped:
        shown = listed(skipped)
        notes.append({
            "en": f"left out, no numbers: {shown}",
            "id": f"tidak dipakai, tanpa bilangan: {shown}",
        })
    return notes + _about_lines(passed)


def _with_unit(name, units):
    unit = units.get(name, "")
    shown = name[:LONGEST_NAME]
    return shown if not unit or unit in name else f"{shown} ({unit})"


def listed(names):
    shown = ", ".join(name[:LONGEST_NAME] for name in list(names)[:MAX_LISTED])
    return shown + ", ..." if len(names) > MAX_LISTED else shown


def _about_lines(passed):
    """ "lines 1-3, 9 were passed over"."""
    if not passed:
        return []
    stretches = [[passed[0], passed[0]]]
    for line in passed[1:]:
        if line == stretches[-1][1] + 1:
            stretches[-1][1] = line
        else:
            stretches.append([line, line])
    texts = [str(a) if a == b else f"{a}-{b}" for a, b in stretches]
    shown = ", ".join(texts[:MAX_LISTED]) + (", ..." if len(texts) > MAX_LISTED else "")
    one = len(passed) == 1
    return [
        {
            "en": f"line {shown} was passed over" if one else f"lines {shown} were passed over",
            "id": f"baris {shown} dilewati",
        }
    ]
