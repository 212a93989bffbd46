"""What a line must not part: a number and its unit, an equation and the marks around it.

A writer types plain spaces. In the page a line never ends between 2.2 and m, nor between an
equation and the bracket, comma or unit beside it, nor inside a short equation such as 1 - K.
"""

import re

from docutils import nodes

KEPT, WHOLE = "together", "whole"  # classes in book.css
SHORT = 16  # signs that can be seen: such an equation is not parted either
END = r"(?![A-Za-z0-9])"
UNIT = (
    rf"(?:%|°C?|(?:km|cm|mm|m|kg|g|ms|s|min|rad|Hz|kHz|µT){END})[²³]?"
    rf"(?:[/·](?:km|m|s|h|min|rad){END}[²³]?)*{END}"
)
NUMBER = re.compile(rf"(?<=\d) (?={UNIT})")
BEHIND = re.compile(rf"(?: {UNIT})?[)\]”’.,;:!?%]*")
BEFORE = re.compile(r"[(\[“‘]*$")
SIGNS = [  # LaTeX -> the signs that can be seen
    (re.compile(r"\\(?:text|mathrm|mathsf)\b|\\[,;:! ]"), ""),
    (re.compile(r"\\[A-Za-z]+"), "x"),
    (re.compile(r"[{}^_\s]"), ""),
]


def keep(app, doctree, docname):
    for text in list(doctree.findall(nodes.Text)):
        if not isinstance(text.parent, (nodes.literal, nodes.literal_block, nodes.raw, nodes.math)):
            kept = NUMBER.sub("\N{NO-BREAK SPACE}", text)
            if kept != text:
                text.parent.replace(text, nodes.Text(kept))
    for equation in list(doctree.findall(nodes.math)):
        join(equation)


def join(equation):
    """Put an equation and the marks around it into one piece of the line."""
    parent, place = equation.parent, equation.parent.index(equation)
    head, tail = taken(parent, place - 1, BEFORE.search), taken(parent, place + 1, BEHIND.match)
    is_short = width(equation.astext()) <= SHORT
    if head or tail or is_short:
        piece = nodes.inline(classes=[KEPT, WHOLE] if is_short else [KEPT])
        parent[place] = piece
        piece += [nodes.Text(head), equation, nodes.Text(tail)]


def width(latex):
    """About how many signs of an equation can be seen."""
    for pattern, sign in SIGNS:
        latex = pattern.sub(sign, latex)
    return len(latex)


def taken(parent, place, marks):
    """Take the marks away from the text at this place, if one is there -> the marks."""
    text = parent[place] if 0 <= place < len(parent) else None
    found = marks(text) if isinstance(text, nodes.Text) else None
    if not found or not found[0]:
        return ""
    parent[place] = nodes.Text(text[: found.start()] + text[found.end() :])
    return found[0].replace(" ", "\N{NO-BREAK SPACE}")


def setup(app):
    app.connect("doctree-resolved", keep)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
