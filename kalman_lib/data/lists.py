"""A list as programs write it -> its grid: [1.0, 2.0], np.array([...]), x = [1; 2; 3], {1, 2}."""

import re

from .limits import MAX_CELLS, MAX_READ, too_long

OPENING, CLOSING = "[({", "])}"
LONGEST_START = 80  # characters before the first bracket
MAX_NAMES = 1000
MAX_DEPTH = 4  # brackets around a list
NAME_AT_THE_END = re.compile(r"[^\W\d]\w{0,60}\s{0,9}$")
ASSIGNED = re.compile(r"([^\W\d]\w{0,60})\s{0,9}=")
HEAD = re.compile(r"[\w.=:\"'\s]*")
ALLOWED = re.compile(r"[0-9\s.,;eE+\-\u2212\[\](){}nNaAuUlLoOiIfF]*")
DTYPE = re.compile(r",\s{0,9}dtype\s{0,9}=[\w.\"' ]{1,20}\)$")


def grid_of(text):
    """The grid of a list, of a list of rows, or of several named lists; None if it is none."""
    body = text.strip()
    if not body or body[-1] not in CLOSING + ";" or not _bracket_in(body[:LONGEST_START]):
        return None
    statements = _statements(body)
    columns = [_rows_of(inside) for _, inside in statements]
    if not columns or any(rows is None for rows in columns):
        return None
    if len(columns) == 1:
        return _grid_of_one(statements[0][0], columns[0])
    flat = [[cell for row in rows for cell in row] for rows in columns]
    if len({len(cells) for cells in flat}) != 1:
        return None
    names = [name or str(k) for k, (name, _) in enumerate(statements, start=1)]
    return [(1, names)] + [(k, list(row)) for k, row in enumerate(zip(*flat), start=1)]


def _bracket_in(start):
    return any(sign in start for sign in OPENING)


def _grid_of_one(name, rows):
    if len(rows) == 1:
        rows = [[cell] for cell in rows[0]]
    head = [(1, [name])] if name and rows and len(rows[0]) == 1 else []
    return head + [(k, cells) for k, cells in enumerate(rows, start=1)]


def _statements(body):
    """[(name or "", what stands between the brackets), ...]; empty if something else is there."""
    starts = _starts(body)
    if len(starts) < 2:
        one = _statement(body)
        return [one] if one else []
    found = [_statement(body[a:b]) for a, b in zip(starts, [*starts[1:], len(body)])]
    return found if all(found) and starts[0] == 0 else []


def _starts(body):
    """Where the names before signs of equality begin; none if there are too many of them."""
    if body.count("=") > MAX_NAMES:
        return []
    starts, at = [], body.find("=")
    while at >= 0:
        before = body[max(0, at - LONGEST_START) : at]
        if found := NAME_AT_THE_END.search(before):
            starts.append(at - len(before) + found.start())
        at = body.find("=", at + 1)
    return starts


def _statement(text):
    """ "z = np.array([1, 2])" -> ("z", "[1, 2]"); None if it is none."""
    text = DTYPE.sub(")", text.strip().rstrip(";").rstrip())
    at = next((k for k, sign in enumerate(text[:LONGEST_START]) if sign in OPENING), -1)
    if at < 0 or text[-1] not in CLOSING:
        return None
    head = text[:at].strip()
    named = ASSIGNED.match(head)
    if not HEAD.fullmatch(head) or (head and not named and head[0].isdigit()):
        return None
    return (named[1] if named else ""), text[at:]


def _rows_of(inside):
    """ "[[0, 21.5], [1, 21.7]]" -> [["0", "21.5"], ["1", "21.7"]]; None if it is no list."""
    inside = inside.replace("...\n", " ")  # goes on in the next line
    if not ALLOWED.fullmatch(inside):
        return None
    if max(map(inside.count, ", \n;")) > (MAX_CELLS if inside.count("[") > 2 else MAX_READ):
        raise too_long(max(map(inside.count, ", \n;")))
    plain = inside.translate(str.maketrans("({)}", "[[]]"))
    for _ in range(MAX_DEPTH):
        if plain[:1] == "[" and plain[-1:] == "]" and _is_around(plain):
            plain = plain[1:-1].strip()
    if "[" in plain:
        parts = [part.partition("[")[2] for part in plain.split("]") if "[" in part]
    else:
        lines = [line.strip() for line in plain.split("\n") if line.strip()]
        is_matrix = ";" in plain or not all(line.endswith(",") for line in lines[:-1])
        parts = re.split("[;\n]", plain) if is_matrix else [" ".join(lines)]
    rows = [_cells_of(part) for part in parts]
    return [row for row in rows if row]


def _is_around(plain):
    """Do the first and the last bracket belong together?"""
    inner = plain[1:-1]
    opening, closing = inner.find("["), inner.find("]")
    return closing < 0 or 0 <= opening < closing


def _cells_of(part):
    if "," not in part:
        return part.split()
    cells = [cell.strip() for cell in part.split(",")]
    return cells[:-1] if cells[-1] == "" else cells
