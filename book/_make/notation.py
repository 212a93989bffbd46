"""The two tables of book/notation.md out of book/letters.yml, whose head says what it holds.

lists.py writes them (make lists).
"""

from pathlib import Path

import yaml

LETTERS = Path(__file__).resolve().parent.parent / "letters.yml"
HEADS = {
    "id": ("| huruf | kode | artinya | ukuran |", "| bab | huruf | artinya |"),
    "en": ("| letter | code | meaning | size |", "| chapter | letter | meaning |"),
}


def read(path=LETTERS):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def for_all(language):
    """The letters of all chapters."""
    lines = [HEADS[language][0], "|---|---|---|---|"]
    for entry in read():
        if "chapters" not in entry:
            cells = (entry["letter"], entry.get("code", ""), entry[language], entry.get("size", ""))
            lines.append(row(cells))
    return "\n" + "\n".join(lines) + "\n\n"


def for_some(language):
    """The letters of single chapters, in the order of these."""
    lines = [HEADS[language][1], "|---|---|---|"]
    entries = [entry for entry in read() if "chapters" in entry]
    for entry in sorted(entries, key=lambda entry: entry["chapters"]):
        meaning = entry[language]
        if "apart" in entry:
            meaning += f" ({entry['apart'][language]})"
        lines.append(row((", ".join(map(str, entry["chapters"])), entry["letter"], meaning)))
    return "\n" + "\n".join(lines) + "\n\n"


def row(cells):
    """An empty cell is one blank, not two."""
    return "|" + "".join(f" {cell} |" if cell else " |" for cell in cells)
