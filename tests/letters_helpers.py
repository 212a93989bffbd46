"""The letters of the equations, compared with book/letters.yml, whose head says the rule."""

import re

from terms_helpers import without_fences

LATIN_OR_GREEK = (
    r"[A-Za-z]|\\(?:var)?(?:alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|rho"
    r"|sigma|tau|phi|chi|psi|omega|Gamma|Theta|Lambda|Xi|Sigma|Phi|Psi|Omega)(?![A-Za-z])"
)
LETTER = re.compile(rf"({LATIN_OR_GREEK})")
MATHS = re.compile(r"\$\$.*?\$\$|\$[^$]*\$", re.DOTALL)
NO_LETTERS = (
    r"\\(?:begin|end|operatorname|mathit|mathrm|text|mathbf|phantom)\{[^}]*\}"  # words, layout
    r"|\^\{?\\mathsf\{?\s?T\}*"  # the transpose
    r"|\\mathcal\s?\w"
    r"|_(?:\{[^}]*\}|\\[a-zA-Z]+|\w)"  # indices
)
OTHER_COMMANDS = r"\\[a-zA-Z]+"
SOURCE = ("this book", "buku ini")


def own_equations(text):
    """The equations of a text, without the letters of a source in the first column of a table."""
    lines, inside = [], False
    for line in without_fences(text).splitlines():
        heads = line.startswith("|") and any(words in line for words in SOURCE)
        inside = heads or (inside and line.startswith("|"))
        lines.append("|" + line.split("|", 2)[2] if inside else line)
    return MATHS.findall("\n".join(lines))


def letters(maths):
    """The letters of an equation without their indices, in order."""
    maths = re.sub(NO_LETTERS, " ", maths.replace("_\\text", "_"))
    found = []
    for letter in re.findall(rf"{LATIN_OR_GREEK}|{OTHER_COMMANDS}", maths):
        if LETTER.fullmatch(letter):
            found.append(letter)
    return found


def listed(entry):
    """The letters of an entry of book/letters.yml."""
    return set(letters(entry["letter"]))


def entries_for(entries, chapter):
    """Those of all chapters and those of this one (a number)."""
    return [entry for entry in entries if chapter in entry.get("chapters", [chapter])]


def unlisted(entries, passages, chapter):
    """{letter: the first place} that a chapter uses though it is not listed for it."""
    known = set().union(*map(listed, entries_for(entries, chapter)))
    found = {}
    for passage in passages:
        for maths in own_equations(passage.text):
            for letter in letters(maths):
                if letter not in known:
                    found.setdefault(letter, passage.place)
    return found


def too_early(entries, path, chapter, places):
    """[(place, letter)] of a chapter that stand before the cell which explains them.

    places: the numbers of the passages of this chapter in the path. An opening may name what its
    chapter explains.
    """
    order = [passage.place for passage in path]
    found = []
    for number in places:
        if path[number].announces:
            continue
        for letter in {x for maths in own_equations(path[number].text) for x in letters(maths)}:
            explained = [
                e["explained"] for e in entries_for(entries, chapter) if letter in listed(e)
            ]
            before = [place for place in explained if place in order[: number + 1]]
            if explained and not before:
                found.append((path[number].place, letter))
    return found


def two_meanings(entries, chapters):
    """[(chapter, letter)] that mean two things in one chapter without being told apart."""
    found = []
    for chapter in chapters:
        seen = {}
        for entry in entries_for(entries, chapter):
            for letter in listed(entry):
                seen.setdefault(letter, []).append(entry)
        for letter, those in seen.items():
            if len(those) > 1 and not allowed_twice(letter, those):
                found.append((chapter, letter))
    return found


def allowed_twice(letter, entries):
    """x and x_pred are one letter with an index; `apart` says how we tell two meanings apart."""
    general = [entry for entry in entries if "chapters" not in entry]
    own = [entry for entry in entries if "chapters" in entry]
    if any("apart" not in entry for entry in own):
        return False
    return len(own) <= 1 and (bool(own) or all("_\\text" in e["letter"] for e in general[1:]))
