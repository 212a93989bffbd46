"""What readers bring to the page is read as Python reads it, whatever it is."""

import base64
import json
import random

import pytest
import test_table
from explorer_helpers import as_in_python, javascript
from workbook_helpers import xlsx

from kalman_lib.data import read_file, read_text


def cases(test):
    """The arguments of a parametrized test."""
    return next(mark.args[1] for mark in test.pytestmark if mark.name == "parametrize")


KNOWN = [
    case[0]
    for test in (
        test_table.test_text_is_read,
        test_table.test_the_decimal_sign_can_be_chosen,
        test_table.test_the_note_says_what_was_chosen,
        test_table.test_what_cannot_be_read_is_named_in_both_languages,
    )
    for case in cases(test)
]
OURS = [
    "\nTanggal,jam,Laju\n2024-01-01,10:00,1.5\n\n2024-01-02,10:01,NA\n2024-01-03,10:02,2.5\n\n",
    "2024-01-01;NA\n2024-01-02;1,5",
    '"a""b";c\n"1";"2"\n',
    '"a\nb"\n1\n2\n',
    '"1" ;2\n',
    '1,"2"x\n3,4',
    'a"b;c\n1;2',
    ' "1";2',
    '1, "2"\n3, "4"',
    "<script>alert(1)</script>\n1\n",
    "1\n<img src=x>\n",
    "=cmd|' /C calc'!A0\n1\n2",
    "1\n=cmd|' /C calc'!A0",
    '1\nit\'s "so"\\\n',
    "1\n\u200b2\n",
    "1\n\x1b\t2",
    "z\n1\x85\n\u30002\n",
    "\ufeff1\n2",
    "1\r2\r\n3\n",
    "1\n\n\n2",
    "1e308\n2",
    "NaN\nNaN",
    "1;2\n\n3;4\n",
    "x²\n1\n2",
    "²\n1",
    "____\n1",
    "1\n" + "\U0001f600" * 50,
    "a;b\n1;1.000,5",
    "suhu ruang ; laju\n1;2",
    "0,5;0.5",
    "1\t\t\n2\t\t",
    "9" * 400,
    "a b c\n1 2 3",
    "1.5 2\n3",
    "-\n1",
    "+\n1",
    ".\n1",
    "1,\n2,\n",
    "1 000\n2 000",
    "1.000.000\n2",
    "1.000.00\n2",
    'a,b\n"1,5",2',
    '1 "2"\n',
    "a\n" + "b" * 131073,
    "\n",
    " ",
    "",
    ";",
    ",",
    "\t",
    '"',
    '""',
    '"",1\n"",2',
]


PIECES = [
    "1", "2", "12", "345", "000", ".", ",", ",", ";", "\t", " ", "  ", "\n", "\n", "\n", "\r\n",
    "-", "\u2212", "e5", "NA", "x", "Suhu", '"', '""', "inf", "+", "=1", "'", "\\", "/",
]  # fmt: skip


CELLS = ["1,5", "2.5", "1.234", "1,234", "3", "NA", "", "1.234,5", "-4", "word", "1e3", '"1,5"']


def random_texts(count):
    rng = random.Random(2)
    for _ in range(count):
        yield "".join(rng.choices(PIECES, k=rng.randint(1, 25)))
    for _ in range(count):
        yield random_table(rng)


def random_table(rng):
    separator = rng.choice(["\t", ";", ",", " ", ", "])
    width = rng.randint(1, 3)
    few = rng.sample(CELLS, rng.randint(1, 4))
    head = separator.join(["t", "v", "w"][:width]) + "\n"
    start = rng.choice(["", "a\n", head])
    rows = [separator.join(rng.choices(few, k=width)) for _ in range(rng.randint(1, 6))]
    return start + "\n".join(rows)


@pytest.mark.parametrize("decimal", [None, ",", "."])
def test_a_text_is_read_as_python_reads_it(decimal, bundle):
    texts = [*(text for text in KNOWN if len(text) < 1e5), *OURS, *random_texts(1500)]
    results = javascript(bundle, f"(text, _) => _.readText(text, {json.dumps(decimal)})", *texts)
    wrong = [
        (text, js, py)
        for text, js in zip(texts, results)
        if js != (py := as_in_python(read_text, text, decimal))
    ]
    assert wrong[:3] == []
    assert (
        sum("error" in result for result in results) > 300
        and sum("columns" in result for result in results) > 300
    )


def test_long_texts_are_read_or_refused_as_in_python(bundle):
    for text in ("v\n" + "1,5\n" * 200_000, "1\n" * 200_001, "1\n" * 200_003):
        assert javascript(bundle, "(text, _) => _.readText(text)", text) == [
            as_in_python(read_text, text)
        ]


def test_files_are_read_as_in_python(bundle):
    text, read = (
        "Suhu °C;n\r\n0,39;1\r\n–0,49;2\r\n",
        "([name, content], _) => _.readFile(name, _.bytes(content))",
    )
    files = [
        ("Data.CSV", text.encode(encoding))
        for encoding in cases(test_table.test_every_encoding_of_a_text_file_is_read)
    ] + [("a.tsv", b"1\t2\n"), ("b.txt", b"1\nx")]
    refused = list(cases(test_table.test_another_kind_of_file_is_refused)) + [
        ("a.xlsx", xlsx([[1], [2]])),
        ("<b>.exe", b"MZ\0\0"),
        ("csv", b"1"),
    ]

    def send(files):
        return [[name, base64.b64encode(content).decode()] for name, content in files]

    assert javascript(bundle, read, *send(files)) == [
        as_in_python(read_file, *file) for file in files
    ]
    for (name, _), answer in zip(refused, javascript(bundle, read, *send(refused))):
        assert (
            repr(name) in answer["error"][0]
            and "CSV" in answer["error"][0]
            and "bukan berkas teks" in answer["error"][0]
            and "save it as CSV" in answer["error"][1]
        )
