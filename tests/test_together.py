"""A line parts neither a number from its unit nor an equation from the marks around it."""

import pytest
import together
from conftest import ROOT
from docutils import nodes

SPACE = "\N{NO-BREAK SPACE}"


def page(*parts):
    """A paragraph; $...$ is an equation."""
    paragraph = nodes.paragraph()
    for part in parts:
        bare = part.strip("$")
        paragraph += nodes.math(bare, bare) if part.startswith("$") else nodes.Text(part)
    together.keep(None, paragraph, "page")
    return paragraph


def pieces(*parts):
    return [(piece.astext(), piece["classes"]) for piece in page(*parts).findall(nodes.inline)]


@pytest.mark.parametrize(
    "text",
    ["2,2 m", "99 %", "5 m/s", "-2 m/s²", "1 cm²", "0.7 °C", "25 °C²", "4 m²/s²", "30 °/s", "3 s"],
)
def test_a_number_keeps_its_unit(text):
    for behind in ("", ".", ", lalu", " and"):
        assert page(f"It is {text}{behind}").astext() == f"It is {text.replace(' ', SPACE)}{behind}"


@pytest.mark.parametrize("text", ["10 langkah", "4 sensors", "2 mobil", "R = 9 di"])
def test_a_number_before_a_word_does_not(text):
    assert page(text).astext() == text


def test_code_stays_as_it_is():
    code = nodes.literal("5 m", "5 m")
    paragraph = nodes.paragraph("", "", code)
    together.keep(None, paragraph, "page")
    assert code.astext() == "5 m"


def test_an_equation_keeps_the_marks_around_it_and_its_unit():
    whole = [together.KEPT, together.WHOLE]
    assert pieces("as good (", "$P = R = 1$", "), and") == [("(P = R = 1),", whole)]
    assert pieces("", "$S = 4$", " cm², so") == [(f"S = 4{SPACE}cm²,", whole)]
    assert page("a (", "$P = R = 1$", "), and").astext() == "a (P = R = 1), and"


def test_equal_texts_beside_other_things_stay():
    paragraph = nodes.paragraph("", "", nodes.strong("a", "a"), nodes.Text(", "))
    paragraph += [nodes.math("x", "x"), nodes.Text(", "), nodes.math("y", "y"), nodes.Text(".")]
    together.keep(None, paragraph, "page")
    assert paragraph.astext() == "a, x, y."
    assert [piece.astext() for piece in paragraph.findall(nodes.inline)] == ["x,", "y."]


def test_only_a_long_equation_may_be_parted_inside():
    long = r"-2(1-K)\,\sigma_a^2 + 2K\,\sigma_b^2 = 0"
    assert pieces("", f"${long}$", ".") == [(f"{long}.", [together.KEPT])]
    assert pieces("so ", f"${long}$", " here") == []
    seen_is_short = r"e = x_\text{true} - x"
    assert pieces("", f"${seen_is_short}$", " is")[0][1] == [together.KEPT, together.WHOLE]


def test_the_style_sheet_knows_the_pieces():
    css = (ROOT / "book" / "_static" / "book.css").read_text(encoding="utf-8")
    assert f".{together.KEPT} {{ white-space: nowrap; }}" in css
    assert f".{together.KEPT}:not(.{together.WHOLE}) > .math {{ white-space: normal; }}" in css
