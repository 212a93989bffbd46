"""What readers bring to the page is read as Python reads it, whatever it is."""

import base64
import random

import numpy as np
from explorer_helpers import javascript
from table_cases import READ, options_of
from table_refused import HUGE, REFUSED
from test_table import HOSTILE, archive, sheet_of
from test_table_archives import LIGHT, PRESSURE, phone_app
from workbook_helpers import xlsx

from kalman_lib.data import InputError, read_table

TABLE = """table => ({
    columns: table.columns,
    units: table.units,
    time: table.time,
    value: table.value,
    lines: table.lines,
    skipped: table.skipped,
    decimal: table.decimal,
    codes: [...table.codes],
    sheets: table.sheets,
    notes: table.notes.map(({ en, id }) => [en, id]),
  })"""
READ_TABLE = f"([text, options], _) => ({TABLE})(_.readTable({{ text }}, options))"


def in_python(source, options):
    """The same as TABLE gives of the page."""
    try:
        table = read_table(source, **options)
    except InputError as error:
        return {"error": [error.id, error.en]}
    return {
        "columns": [[name, plain(values)] for name, values in table.columns.items()],
        "units": table.units,
        "time": table.time,
        "value": table.value,
        "lines": table.lines.tolist(),
        "skipped": list(table.skipped),
        "decimal": table.decimal,
        "codes": [[code, count] for code, count in table.codes.items()],
        "sheets": list(table.sheets),
        "notes": [[note["en"], note["id"]] for note in table.notes],
    }


def plain(values):
    return ["nan" if np.isnan(one) else one for one in values.tolist()]


def differing(bundle, cases):
    """The cases [(text, options), ...] that the page reads otherwise."""
    answers = javascript(bundle, READ_TABLE, *(list(case) for case in cases))
    pairs = [(case, answer, in_python(*case)) for case, answer in zip(cases, answers)]
    return [pair for pair in pairs if pair[1] != pair[2]]


def test_the_page_reads_and_refuses_alike(bundle):
    cases = [(text, options_of(more)) for text, _, more in READ]
    cases += [(text, options) for text, options, _, _ in REFUSED]
    assert differing(bundle, cases)[:2] == []


# --- texts that nobody would write ----------------------------------------------------------------

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
    "-", "\u2212", "e5", "NA", "x", "Suhu", '"', '""', "inf", "+", "=1", "'", "\\", "/", ":", "[",
    "]", "\u00a0", "10:00", "2024-01-02", "#", "(s)", "°C", "=",
]  # fmt: skip
CELLS = [
    "1,5", "2.5", "1.234", "1,234", "3", "NA", "", "1.234,5", "-4", "word", "1e3", '"1,5"', "-999",
    "10:00", "10:05", "01/02/2024", "2024-03-04 05:06:07", "21 °C", "Rp 1.500", "85", "1 234",
    "10.30",
]  # fmt: skip
HEADS = ["t", "v", "w", "No", "waktu (s)", "Suhu, °C", "pukul", "speed_kmh", "", "T", "3"]
ABOVE = ["", "a\n", "Data suhu\n\n", "sep=;\n", "# a, b\n", "Kota;Bogor\n"]
BELOW = ["", "\n", "\n\nCatatan: basah", "\n8888: tidak terukur", "\nRata-rata;3"]


def random_texts(count):
    rng = random.Random(2)
    for _ in range(count):
        yield "".join(rng.choices(PIECES, k=rng.randint(1, 25)))
    for _ in range(2 * count):
        yield random_table(rng)


def random_table(rng):
    separator = rng.choice(["\t", ";", ",", " ", ", "])
    width = rng.randint(1, 3)
    few = rng.sample(CELLS, rng.randint(1, 4))
    head = separator.join(rng.choices(HEADS, k=width)) + "\n" if rng.random() < 0.6 else ""
    rows = [separator.join(rng.choices(few, k=width)) for _ in range(rng.randint(1, 6))]
    return rng.choice(ABOVE) + head + "\n".join(rows) + rng.choice(BELOW)


def test_any_text_is_read_as_python_reads_it(bundle):
    rng = random.Random(3)
    options = [{}, {}, {"decimal": ","}, {"decimal": "."}, {"missing": [3]}]
    cases = [(text, rng.choice(options)) for text in [*OURS, *random_texts(700)]]
    assert differing(bundle, cases)[:2] == []
    refused = sum("error" in in_python(*case) for case in cases)
    assert 300 < refused < len(cases) - 300


def test_long_texts_are_read_or_refused_as_in_python(bundle):
    for text in ("1\n" * 200_001, *(make() for make in HUGE.values())):
        assert differing(bundle, [(text, {})]) == []


# --- files --------------------------------------------------------------------------------------

READ_FILE = f"""async ([content, options]) => {{
  const {{ opened, readTable }} = KalmanExplorers.papers.smoother;
  const {{ InputError }} = KalmanExplorers.input;
  const bytes = Uint8Array.from(atob(content), sign => sign.charCodeAt(0));
  const plain = value => value instanceof Map ? [...value].map(([name, one]) => [name,
    Array.from(one, number => Number.isNaN(number) ? "nan" : number)]) : value;
  try {{
    const file = await opened({{ name: "a.csv", bytes }});
    const table = ({TABLE})(readTable({{ file }}, options));
    return {{ ...table, columns: plain(table.columns) }};
  }} catch (error) {{
    if (!(error instanceof InputError)) throw error;
    return {{ error: [error.id, error.en] }};
  }}
}}"""


def from_file(bundle, content, options=None):
    return bundle.evaluate(READ_FILE, [base64.b64encode(content).decode(), options or {}])


def test_every_encoding_is_read_as_in_python(bundle):
    text = "Suhu °C;n\r\n0,39;1\r\n–0,49;2\r\n"
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"):
        content = text.encode(encoding)
        assert from_file(bundle, content) == in_python(content, {})


def test_workbooks_are_read_as_in_python(bundle):
    dates = [["Waktu", "z"], [np.datetime64("2024-01-01T10:00").astype(object), 0.5]]
    dates += [
        [np.datetime64("2024-01-01T10:00:30").astype(object), "0,75"],
        [None, None],
        [None, 2],
    ]
    book = xlsx([["Info"], [2026]], dates, [["v"], [1], [2], [-999], [1.5]])
    for options in ({}, {"sheet": "Data 3"}, {"sheet": "Data 3", "missing": []}, {"sheet": "x"}):
        assert from_file(bundle, book, options) == in_python(book, options)
    for rows in ([["z"], [1], ["=1+1"]], [["z"], [1], [True]], [["a"]], [], [["z"], [1], ["#N/A"]]):
        assert from_file(bundle, xlsx(rows)) == in_python(xlsx(rows), {})


def test_the_archive_of_a_phone_app_is_read_as_in_python(bundle, tmp_path):
    content = phone_app(Pressure=PRESSURE, Light=LIGHT, Empty="")
    for options in ({}, {"sheet": "Light.csv"}, {"sheet": "Light.csv", "decimal": ","}):
        assert from_file(bundle, content, options) == in_python(content, options)
    huge = "1\n" * 4_100_000
    for parts in ({}, {"Words": "a\nb\n"}, {"a": huge}, {"a": "1" * 17_000_000}):
        (tmp_path / "a.csv").write_bytes(phone_app(**parts))
        answer = from_file(bundle, phone_app(**parts))
        assert answer == in_python(tmp_path / "a.csv", {}) and "error" in answer


def test_what_is_no_table_is_refused_as_in_python(bundle, tmp_path):
    locked = b"\xd0\xcf\x11\xe0" + "EncryptedPackage".encode("utf-16-le")
    refused = [b"\xd0\xcf\x11\xe0\xa1\xb1", locked, b"\x89PNG\0", b"PK\x03\x04broken", b"1\n\x81"]
    refused += [archive(sheet1=sheet_of(*rows)) for rows in HOSTILE.values()]
    for content in refused:
        (tmp_path / "a.csv").write_bytes(content)
        assert from_file(bundle, content) == in_python(tmp_path / "a.csv", {})
