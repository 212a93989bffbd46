"""What an exercise of a page consists of, as nodes: fields, verdict, hints, solution."""

import html
import json

from docutils import nodes
from docutils.statemachine import StringList

from kalman_lib.live.grading import LETTERS

VOID = {"input"}  # elements without an end
WORDS = {
    "id": {
        "answer": "Jawaban",
        "choices": "Pilihan",
        "code": "Kode",
        "check": "Periksa",
        "solution": "Penyelesaian",
    },
    "en": {
        "answer": "Answer",
        "choices": "Choices",
        "code": "Code",
        "check": "Check",
        "solution": "Solution",
    },
}


class Part(nodes.comment):
    """An element of HTML. As a comment it is not searched: no search tells a solution."""


def markdown(directive, text):
    """The nodes that a directive makes of a piece of Markdown, with its equations."""
    holder = nodes.container()
    lines = StringList(text.splitlines(), directive.env.docname)
    directive.state.nested_parse(lines, directive.content_offset, holder)
    return holder.children


def open_part(translator, node):
    attributes = "".join(
        f' {name}="{html.escape(str(value), quote=True)}"' if value != "" else f" {name}"
        for name, value in node["attributes"].items()
    )
    translator.body.append(f"<{node['tag']}{attributes}>")


def close_part(translator, node):
    if node["tag"] not in VOID:
        translator.body.append(f"</{node['tag']}>")


def part(tag, attributes, *children):
    """part("p", {"class": "a"}, "text", other nodes)"""
    found = [nodes.Text(child) if isinstance(child, str) else child for child in children]
    return Part("", "", *found, tag=tag, attributes=attributes)


def name_of(number):
    """ "3.2" -> "exercise-3-2", its id in the page."""
    return "exercise-" + number.replace(".", "-")


def block(number, about, language, parse):
    """Everything below the question. about: in one language; parse: Markdown -> nodes."""
    words, own = WORDS[language], name_of(number)
    fields = FIELDS[about["kind"]](own, about, words, parse)
    attributes = {
        "class": "exercise",
        "role": "group",
        "aria-labelledby": f"{own}-name",
        "data-exercise": number,
        "data-about": json.dumps(for_script(about), ensure_ascii=False),
    }
    verdict = part("div", {"class": "exercise-verdict", "id": f"{own}-verdict", "role": "status"})
    found = part(
        "div",
        attributes,
        part("form", {"novalidate": "", "autocomplete": "off"}, *fields),
        verdict,
        hints(about, parse),
        *solution(about, words, parse),
    )
    found["number"] = number
    return found


def for_script(about):
    """What the script has to know: no texts."""
    known = {
        name: about[name]
        for name in ("kind", "answer", "tolerance", "unit", "accept", "start")
        if about.get(name) not in (None, "", [])
    }
    return {**known, "mistakes": [mistake["answer"] for mistake in about["mistakes"]]}


def hints(about, parse):
    """Hidden; the script shows a copy of the one that fits."""
    texts = {"hint": about["hint"], "second": about["second"]}
    texts |= {str(place): mistake["hint"] for place, mistake in enumerate(about["mistakes"])}
    found = [part("div", {"data-hint": name}, *parse(text)) for name, text in texts.items()]
    return part("div", {"class": "exercise-hints", "hidden": ""}, *found)


def solution(about, words, parse):
    """Can be opened without a script, too; with one only after two tries. An edition for students
    has none."""
    if "solution" not in about:
        return []
    name = part("summary", {}, words["solution"])
    worked = part("div", {"class": "exercise-worked"}, *parse(about["solution"]))
    return [part("details", {"class": "exercise-solution"}, name, worked)]


# --- the fields of each kind ----------------------------------------------------------------------


def number_fields(own, about, words, parse):
    answers = [about["answer"], *(mistake["answer"] for mistake in about["mistakes"])]
    is_plain = all(value == 0 or value >= 1e-4 for value in answers)
    attributes = {
        "inputmode": "decimal" if is_plain else "text",  # the former has no minus on some phones
        "aria-describedby": f"{own}-unit {own}-verdict",
    }
    unit = part("span", {"class": "exercise-unit", "id": f"{own}-unit"}, about.get("unit", ""))
    line = [label(own, words["answer"]), text_field(own, attributes), unit, button(words)]
    return [part("div", {"class": "exercise-row"}, *line)]


def code_fields(own, about, words, parse):
    attributes = {
        "autocapitalize": "off",
        "autocorrect": "off",
        "spellcheck": "false",
        "aria-describedby": f"{own}-verdict",
    }
    before = about.get("start", "").strip()
    shown = [nodes.literal(before, before)] if before else []
    line = part("div", {"class": "exercise-code"}, *shown, text_field(own, attributes))
    return [part("div", {"class": "exercise-row"}, label(own, words["code"]), line, button(words))]


def choice_fields(own, about, words, parse):
    legend = part("legend", {"class": "exercise-unseen"}, words["choices"])
    rows = []
    for place, text in enumerate(about["choices"]):
        radio = {"type": "radio", "name": f"{own}-answer", "value": place}
        letter = part("span", {"class": "exercise-letter"}, f"{LETTERS[place]}.")
        rows.append(part("label", {}, part("input", radio), letter, inline(parse(text))))
    attributes = {"class": "exercise-choices", "aria-describedby": f"{own}-verdict"}
    return [
        part("fieldset", attributes, legend, *rows),
        part("div", {"class": "exercise-row"}, button(words)),
    ]


FIELDS = {"number": number_fields, "choice": choice_fields, "code": code_fields}


def label(own, word):
    return part("label", {"for": f"{own}-answer"}, word)


def text_field(own, attributes):
    return part(
        "input", {"type": "text", "id": f"{own}-answer", "autocomplete": "off"} | attributes
    )


def button(words):
    return part("button", {"type": "submit"}, words["check"])


def inline(found):
    """What stands in a label: the inside of its only paragraph."""
    is_paragraph = len(found) == 1 and isinstance(found[0], nodes.paragraph)
    return part("span", {}, *(found[0].children if is_paragraph else found))
