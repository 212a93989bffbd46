"""{exercise-overview}: a table of all exercises with answers and typical mistakes, for lecturers.

It is made from the metadata of the notebooks whenever its page is built, so nothing goes stale.
"""

import re
from decimal import Decimal

import exercise_cells
from docutils import nodes
from exercise_parts import markdown, name_of
from sphinx.util.docutils import SphinxDirective
from texts import headings, source_in

from kalman_lib.live.grading import LETTERS

CLASS = "exercise-overview"
LEAST_DECIMAL = 1e-6  # a smaller number is shown with its power of ten
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\([^)]*\)")  # leads elsewhere from another page
WORDS = {
    "id": {
        "number": "angka",
        "choice": "pilihan",
        "code": "kode",
        "head": ("Latihan", "Soal", "Jawaban", "Kekeliruan yang lazim"),
        "none": "Belum ada latihan.",
        "kept": "Edisi ini untuk mahasiswa: jawabannya ada pada pengajar.",
    },
    "en": {
        "number": "number",
        "choice": "choice",
        "code": "code",
        "head": ("Exercise", "Question", "Answer", "Typical mistakes"),
        "none": "There are no exercises yet.",
        "kept": "This is an edition for students: the lecturer has the answers.",
    },
}


class OverviewDirective(SphinxDirective):
    """A rubric and a table for every page that has exercises."""

    def run(self):
        self.language = self.config.language
        self.words = WORDS[self.language]
        if not exercise_cells.has_solutions():
            return [nodes.paragraph("", "", nodes.strong("", self.words["kept"]))]
        found = []
        for path in sorted(exercise_cells.NOTEBOOKS.glob("*.ipynb")):
            self.env.note_dependency(str(path))
            exercises = exercise_cells.in_notebook(path)
            if exercises:
                found += [self.rubric(path), self.table(exercises)]
        return found or [nodes.paragraph("", self.words["none"])]

    def rubric(self, path):
        text = path.read_text(encoding="utf-8")
        return nodes.rubric("", headings(source_in(text, path, self.language))[0])

    def table(self, exercises):
        head, body = nodes.thead(), nodes.tbody()
        head += self.row([[nodes.paragraph("", word)] for word in self.words["head"]])
        for exercise in exercises:
            body += self.row(self.cells(exercise))
        columns = [nodes.colspec(colwidth=width) for width in (10, 35, 20, 35)]
        group = nodes.tgroup("", *columns, head, body, cols=len(columns))
        return nodes.table("", group, classes=[CLASS, "colwidths-given"])

    def row(self, cells):
        return nodes.row("", *(nodes.entry("", *cell) for cell in cells))

    def cells(self, exercise):
        about = exercise_cells.in_language(exercise.about, self.language)
        return [
            self.link_to(exercise),
            [*self.parse(exercise.question[self.language]), *self.choices(about)],
            self.answer(about, about["answer"], is_right=True),
            self.mistakes(about),
        ]

    def link_to(self, exercise):
        page = self.env.app.builder.get_relative_uri(self.env.docname, exercise.page)
        address = f"{page}#{name_of(exercise.number)}"
        link = nodes.reference("", exercise.number, refuri=address, internal=True)
        kind = self.words[exercise.about["kind"]]
        return [nodes.paragraph("", "", link), nodes.paragraph("", kind)]

    def choices(self, about):
        return [
            node
            for letter, text in zip(LETTERS, about.get("choices", []))
            for node in self.parse(f"{letter}. {text}".replace(". ", "\\. ", 1))
        ]

    def answer(self, about, value, is_right=False):
        if about["kind"] == "choice":
            return [nodes.paragraph("", LETTERS[value])]
        if about["kind"] == "code":
            return [nodes.paragraph("", "", nodes.literal("", value))]
        text = self.decimal(value)
        if is_right:
            unit = f" ({about['unit']})" if about.get("unit") else ""
            text = f"{text} ± {self.decimal(about['tolerance'])}{unit}"
        return [nodes.paragraph("", text)]

    def mistakes(self, about):
        items = []
        for mistake in about["mistakes"]:
            value, hint = self.answer(about, mistake["answer"]), self.parse(mistake["hint"])
            value[0] += nodes.Text(": ")
            if hint and isinstance(hint[0], nodes.paragraph):
                value[0] += hint.pop(0).children
            items.append(nodes.list_item("", *value, *hint))
        return [nodes.bullet_list("", *items)]

    def decimal(self, value):
        shown = f"{Decimal(repr(value)):f}" if abs(value) >= LEAST_DECIMAL else repr(value)
        text = shown.replace("-", "\u2212")
        return text.replace(".", ",") if self.language == "id" else text

    def parse(self, text):
        return markdown(self, LINK.sub(r"\1", text))
