"""The workbook is recalculated by LibreOffice and compared with the library; the reader against
what was typed."""

import io
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from conftest import need_program
from openpyxl import Workbook, load_workbook
from openpyxl.formula.translate import Translator

from kalman_lib import LinearModel, kalman_filter, rts_smooth
from kalman_lib.data import InputError, read_file, read_text, write_workbook
from kalman_lib.data.table import MAX_READ
from kalman_lib.data.workbook import MAX_WRITE
from kalman_lib.data.workbook_parts import FIRST
from kalman_lib.papers import smoother

nan = np.nan

# --- the workbook -------------------------------------------------------------------------------

INDONESIAN = """<?xml version="1.0" encoding="UTF-8"?>
<oor:items xmlns:oor="http://openoffice.org/2001/registry"><item oor:path="/org.openoffice.Setup/L10N">
<prop oor:name="ooSetupSystemLocale" oor:op="fuse"><value>id-ID</value></prop></item></oor:items>"""


def libreoffice(profile, kind, out, files):
    """Convert the files in one call, with Indonesian settings; a second try, as two starts at once
    may collide."""
    soffice = need_program("soffice", "libreoffice", install="apt-get install libreoffice-calc")
    (profile / "user").mkdir(parents=True, exist_ok=True)
    if not (profile / "user/registrymodifications.xcu").exists():
        (profile / "user/registrymodifications.xcu").write_text(INDONESIAN)
    command = [
        soffice,
        f"-env:UserInstallation={profile.as_uri()}",
        "--headless",
        "--convert-to",
        kind,
        "--outdir",
        str(out),
        *map(str, files),
    ]
    for _ in range(2):
        result = subprocess.run(command, capture_output=True, text=True, timeout=300)
        if all(
            (out / Path(file).with_suffix("." + kind[:4].rstrip(":")).name).exists()
            for file in files
        ):
            return
    raise AssertionError(result.stderr)


def gappy(seed, T, scale=1.0):
    """A random walk with a tenth of its values missing, and a run of gaps at the start."""
    rng = np.random.default_rng(seed)
    z = scale * np.cumsum(rng.normal(size=T)) + scale * rng.normal(size=T)
    z[rng.random(T) < 0.1] = nan
    z[:2] = nan
    return z


CASES = {  # name: (z, Q, R, x0, P0)
    "paper": (smoother.MEASURED, 1e-5, 1e-5, 0, 1),
    "gaps": (gappy(1, 300), 0.7, 2.3, -1.5, 10),
    "full": (np.random.default_rng(2).normal(size=200), 1e-3, 1, 0.25, 4),
    "small_ratio": (gappy(3, 200), 1e-12, 1, 0, 1),
    "large_ratio": (gappy(4, 200), 1, 1e-12, 0, 1),
    "tiny_units": (gappy(5, 100, 1e-9), 1e-18, 3e-18, 0, 1e-18),
    "huge_units": (gappy(6, 100, 1e9), 1e18, 3e18, 1e9, 1e18),
    "still": (gappy(7, 100), 0, 1, 0, 5),
    "known": (gappy(8, 50), 0, 1, 0.5, 0),
    "one": (np.array([2.0]), 1, 1, 0, 1),
    "nothing": (np.full(5, nan), 1, 1, 3, 1),
    "long": (gappy(9, 20_000), 0.1, 4, 0, 1),
    "changed": (smoother.MEASURED, 1e-5, 1e-3, 0, 1),  # R is changed in the sheet, from 1e-5
}
NAMES = [
    "=1+1",
    "+1+1",
    "-1+1",
    "@SUM(1)",
    "\t=1+1",
    "\r=1+1",
    '=HYPERLINK("http://x")',
    "=cmd|' /C calc'!A0",
]


@pytest.fixture(scope="module")
def recalculated(tmp_path_factory):
    """{name: the workbook with LibreOffice's results}, all from one call."""
    folder = tmp_path_factory.mktemp("workbooks")
    (folder / "out").mkdir()
    for name, (z, Q, R, x0, P0) in CASES.items():
        write_workbook(folder / f"{name}.xlsx", z, Q, R, x0, P0)
    write_workbook(folder / "changed.xlsx", smoother.MEASURED, 1e-5, 1e-5)
    book = load_workbook(folder / "changed.xlsx")
    sheet, cell = next(book.defined_names["R_"].destinations)
    book[sheet][cell] = 1e-3
    book.save(folder / "changed.xlsx")
    for k, name in enumerate(NAMES):
        write_workbook(folder / f"name{k}.xlsx", [1.0, 2.0], 1, 1, name=name)
    libreoffice(folder / "profile", "xlsx", folder / "out", sorted(folder.glob("*.xlsx")))
    return {
        file.stem: load_workbook(file, data_only=True) for file in (folder / "out").glob("*.xlsx")
    }


def table(sheet, columns):
    """The numbers of a sheet, (columns, T); an empty cell or text is NaN."""
    rows = sheet.iter_rows(min_row=FIRST, max_col=columns, values_only=True)
    return np.array([[x if isinstance(x, (int, float)) else nan for x in row] for row in rows]).T


def expected(name):
    z, Q, R, x0, P0 = CASES[name]
    result = kalman_filter(LinearModel(F=1, H=1, Q=Q, R=R, x0=x0, P0=P0), z)
    return z, result, rts_smooth(result)


@pytest.mark.parametrize("name", CASES)
def test_the_filter_sheet_computes_what_the_library_computes(name, recalculated):
    z, result, _ = expected(name)
    No, measured, x_pred, P_pred, y, K, x, P = table(recalculated[name]["Filter"], 8)
    small = 1e-14 * max(
        np.nanmax(np.abs(z), initial=0), abs(CASES[name][3])
    )  # x may pass through zero
    np.testing.assert_array_equal(No, np.arange(1, len(z) + 1))
    np.testing.assert_allclose(measured, z, rtol=1e-14)
    np.testing.assert_allclose(x_pred, result.x_pred[:, 0], rtol=1e-12, atol=small)
    np.testing.assert_allclose(x, result.x[:, 0], rtol=1e-12, atol=small)
    np.testing.assert_allclose(y, result.y[:, 0], rtol=1e-12, atol=small)
    np.testing.assert_allclose(P_pred, result.P_pred[:, 0, 0], rtol=1e-12)
    np.testing.assert_allclose(P, result.P[:, 0, 0], rtol=1e-12)
    np.testing.assert_allclose(K, result.K[:, 0, 0], rtol=1e-12)
    assert recalculated[name]["Filter"]["F4"].value == np.isfinite(z).sum()  # N


@pytest.mark.parametrize("name", CASES)
def test_the_RTS_sheet_computes_what_the_library_computes(name, recalculated):
    z, result, smooth = expected(name)
    _, x, P, P_next, G, x_smooth, P_smooth = table(recalculated[name]["RTS"], 7)
    small = 1e-14 * max(np.nanmax(np.abs(z), initial=0), abs(CASES[name][3]))
    np.testing.assert_allclose(x, result.x[:, 0], rtol=1e-12, atol=small)
    np.testing.assert_allclose(P, result.P[:, 0, 0], rtol=1e-12)
    np.testing.assert_allclose(P_next, [*result.P_pred[1:, 0, 0], nan], rtol=1e-12)
    known = result.P_pred[1:, 0, 0] == 0  # then G = 0 / 0 is 0 by agreement
    gain = np.where(known, 0, result.P[:-1, 0, 0] / np.where(known, 1, result.P_pred[1:, 0, 0]))
    np.testing.assert_allclose(G, [*gain, nan], rtol=1e-12)
    np.testing.assert_allclose(x_smooth, smooth.x[:, 0], rtol=1e-12, atol=small)
    np.testing.assert_allclose(P_smooth, smooth.P[:, 0, 0], rtol=1e-12)


def test_the_paper_s_table_comes_out_to_every_printed_digit(recalculated):
    np.testing.assert_allclose(
        table(recalculated["paper"]["Filter"], 8)[6], smoother.FILTERED, rtol=0, atol=5e-7
    )


def test_no_cell_shows_an_error(recalculated):
    for name, book in recalculated.items():
        texts = [
            cell
            for sheet in book
            for row in sheet.iter_rows(values_only=True)
            for cell in row
            if isinstance(cell, str)
        ]
        assert not [text for text in texts if text.startswith("#") or text.startswith("Err:")], name


@pytest.mark.parametrize("k", range(len(NAMES)))
def test_a_name_is_never_a_formula(k, recalculated):
    shown = NAMES[k].strip()
    assert recalculated[f"name{k}"]["Filter"]["G4"].value == shown
    target = io.BytesIO()
    write_workbook(target, [1.0], 1, 1, name=NAMES[k])
    xml = zipfile.ZipFile(target).read("xl/worksheets/sheet1.xml").decode()
    cell = re.search(r'<c r="G4"[^>]*>.*?</c>', xml)[0]
    assert 't="inlineStr"' in cell and "<f>" not in cell
    assert load_workbook(target)["Filter"]["G4"].quotePrefix


@pytest.fixture(scope="module")
def written():
    target = io.BytesIO()
    write_workbook(target, smoother.MEASURED, 1e-5, 1e-5)
    return target


def test_the_workbook_has_charts_and_no_macros(written):
    parts = zipfile.ZipFile(written).namelist()
    assert [part for part in parts if "charts/chart" in part] == [
        "xl/charts/chart1.xml",
        "xl/charts/chart2.xml",
    ]
    assert not any("vba" in part.lower() or "externalLink" in part for part in parts)
    for part, ranges in (
        ("chart1", ["'Filter'!$B$7:$B$22", "'Filter'!$G$7:$G$22"]),
        ("chart2", ["'Filter'!$B$7:$B$22", "'Filter'!$G$7:$G$22", "'RTS'!$F$7:$F$22"]),
    ):
        xml = zipfile.ZipFile(written).read(f"xl/charts/{part}.xml").decode()
        assert re.findall(r"<val><numRef><f>(.*?)</f>", xml) == ranges
        assert xml.count('<delete val="0"') == 2  # both axes are drawn


def test_the_workbook_opens_on_the_form_in_both_languages(written):
    book = load_workbook(written)
    assert book.sheetnames == ["Filter", "RTS", "Catatan - Notes"] and book.active.title == "Filter"
    heads = [cell.value for cell in book["Filter"][FIRST - 1]]
    assert (
        heads[0] == "No"
        and "Terukur /\nMeasured" in heads[1]
        and "Terfilter /\nFiltered" in heads[6]
    )
    assert book["Filter"].freeze_panes == book["RTS"].freeze_panes == f"A{FIRST}"
    assert {name: next(defined.destinations) for name, defined in book.defined_names.items()} == {
        "Q_": ("Filter", "$B$4"),
        "R_": ("Filter", "$C$4"),
        "x0_": ("Filter", "$D$4"),
        "P0_": ("Filter", "$E$4"),
    }
    for sheet, columns in (("Filter", "CDEFGH"), ("RTS", "ABCDEFG")):
        assert all(
            book[sheet][f"{c}{r}"].data_type == "f"
            for c in columns
            for r in range(FIRST, FIRST + 16)
        )
    notes = list(book["Catatan - Notes"].iter_rows(values_only=True))
    assert all(indonesian and english for indonesian, english in notes)
    assert any("Rudiyanto" in english for _, english in notes)


def test_the_last_row_may_be_copied_down(written):
    book = load_workbook(written)
    for sheet, columns in (("Filter", "CDEFGH"), ("RTS", "ABCDEFG")):
        for c in columns:
            second, last = f"{c}{FIRST + 1}", f"{c}{FIRST + 15}"
            assert (
                Translator(book[sheet][second].value, second).translate_formula(last)
                == book[sheet][last].value
            )


def test_a_gap_is_an_empty_cell():
    target = io.BytesIO()
    write_workbook(target, [1.0, nan, 3.0], 1, 1)
    assert [row[0].value for row in load_workbook(target)["Filter"]["B7:B9"]] == [1, None, 3]


def test_100_000_rows_are_written(tmp_path):
    write_workbook(tmp_path / "long.xlsx", np.arange(MAX_WRITE, dtype=float), 1, 1)
    with zipfile.ZipFile(tmp_path / "long.xlsx") as parts:
        for sheet in ("sheet1", "sheet2"):
            assert parts.read(f"xl/worksheets/{sheet}.xml").count(b"<row ") == FIRST - 1 + MAX_WRITE
        assert b"'Filter'!$G$7:$G$5006" in parts.read("xl/charts/chart1.xml")


@pytest.mark.parametrize(
    "arguments, en, id",
    [
        (dict(Q=-1), "Q is -1, but must be >= 0", "Q bernilai -1"),
        (dict(Q=nan), "Q is nan", "Q bernilai nan"),
        (dict(R=0), "R is 0, but must be > 0", "R bernilai 0"),
        (dict(R=np.inf), "R is inf", "R bernilai inf"),
        (dict(x0=nan), "x0 is nan", "x0 bernilai nan"),
        (dict(P0=-1), "P0 is -1", "P0 bernilai -1"),
        (dict(z=[]), "one column", "satu kolom"),
        (dict(z=[[1.0]]), "one column", "satu kolom"),
        (dict(z=[1, np.inf]), "finite numbers", "bilangan berhingga"),
        (
            dict(z=np.zeros(MAX_WRITE + 1)),
            "100001 rows are too many",
            "100001 baris terlalu banyak",
        ),
    ],
)
def test_bad_arguments_are_named(arguments, en, id):
    with pytest.raises(InputError) as error:
        write_workbook(io.BytesIO(), **{"z": [1.0], "Q": 1, "R": 1, **arguments})
    assert (
        en in error.value.en
        and id in error.value.id
        and str(error.value) == f"{error.value.en} / {error.value.id}"
    )


# --- reading text -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text, columns, decimal",
    [
        ("1\n2\n3\n", {"1": [1, 2, 3]}, None),
        ("Suhu\n0,39\n-0,49\n", {"Suhu": [0.39, -0.49]}, ","),
        ("Suhu ruang\n25,1\n25,25", {"Suhu ruang": [25.1, 25.25]}, ","),
        ("\ufeffz\r\n0.39\r\n0.49\r\n\r\n", {"z": [0.39, 0.49]}, "."),
        ("1,5\n2,6", {"1": [1.5, 2.6]}, ","),  # no header: one column
        ("1,5\n2\n,5", {"1": [1.5, 2, 0.5]}, ","),
        ("v\n1,5\n2,6", {"v": [1.5, 2.6]}, ","),  # one name: one column
        ("t,v\n1,5\n2,6", {"t": [1, 2], "v": [5, 6]}, None),  # two names: two columns
        ("1, 5\n2, 6", {"1": [1, 2], "2": [5, 6]}, None),
        ('"1,5","2,5"\n"1","3,25"', {"1": [1.5, 1], "2": [2.5, 3.25]}, ","),
        ('"Suhu, C"\n"25,1"', {"Suhu, C": [25.1]}, ","),
        ("1,2.5\n2,3.5", {"1": [1, 2], "2": [2.5, 3.5]}, "."),
        ("1,2,3\n4,5,6", {"1": [1, 4], "2": [2, 5], "3": [3, 6]}, None),
        ("1;2,5\n3;4", {"1": [1, 3], "2": [2.5, 4]}, ","),
        ("t\tv\n0,5\t1.234,5\n1\t-2", {"t": [0.5, 1], "v": [1234.5, -2]}, ","),
        ("a;b\n1,234.5;0.5\n12,345,678;1", {"a": [1234.5, 12345678], "b": [0.5, 1]}, "."),
        ("1.234,5\n0,5", {"1": [1234.5, 0.5]}, ","),
        ("999.5\n1,234.5", {"1": [999.5, 1234.5]}, "."),  # not every line has a comma: thousands
        ("1.234.567\n5", {"1": [1234567, 5]}, ","),
        ("1.234\n2.345", {"1": [1.234, 2.345]}, "."),
        ("1,234\n2,345", {"1": [1.234, 2.345]}, ","),
        ("t v\n0.0 1.5\n0.5 2.5", {"t": [0, 0.5], "v": [1.5, 2.5]}, "."),
        ("   9.5    10.1\n  10.5   110.1", {"1": [9.5, 10.5], "2": [10.1, 110.1]}, "."),
        ("0,5 1,2\n0,6 1,3", {"1": [0.5, 0.6], "2": [1.2, 1.3]}, ","),
        ("Suhu ruang  Laju\n25,1  0,5", {"Suhu ruang": [25.1], "Laju": [0.5]}, ","),
        (
            "1\nNA\nn/a\nNaN\nnull\n-\n#N/A\n\n2",
            {"1": [1, nan, nan, nan, nan, nan, nan, nan, 2]},
            None,
        ),
        ("a;b\n1;\n;2\n;\n;3\n;\n", {"a": [1, nan, nan, nan], "b": [nan, 2, nan, 3]}, None),
        ("1;2;\n3;4;", {"1": [1, 3], "2": [2, 4]}, None),
        ("a;a;;a\n1;2;3;4", {"a": [1], "a (2)": [2], "3": [3], "a (3)": [4]}, None),
        ("\u22120,5\n\u20132\n+1e-3\n\u2212", {"1": [-0.5, -2, 0.001, nan]}, ","),
        ("1e5\n1E+300\n.5\n5.", {"1": [1e5, 1e300, 0.5, 5]}, "."),
    ],
)
def test_text_is_read(text, columns, decimal):
    result = read_text(text)
    assert list(result.columns) == list(columns) and result.decimal == decimal
    for name, values in columns.items():
        np.testing.assert_array_equal(result.columns[name], values)


@pytest.mark.parametrize(
    "text, decimal, columns",
    [
        ("1,5\n2,6", ".", {"1": [1, 2], "2": [5, 6]}),
        ("1,5\n2,6", ",", {"1": [1.5, 2.6]}),
        ("1.234\n2.345", ",", {"1": [1234, 2345]}),
        ("1,234.5\n2,345.5", ".", {"1": [1, 2], "2": [234.5, 345.5]}),
        ("t;v\n10.30;0,5", ",", {"v": [0.5]}),
        ("1\n2", ",", {"1": [1, 2]}),
    ],
)
def test_the_decimal_sign_can_be_chosen(text, decimal, columns):
    assert {
        name: list(values) for name, values in read_text(text, decimal).columns.items()
    } == columns


def test_labels_are_left_out_and_lines_are_kept():
    result = read_text(
        "\nTanggal,jam,Laju\n2024-01-01,10:00,1.5\n\n2024-01-02,10:01,NA\n2024-01-03,10:02,2.5\n\n"
    )
    assert result.skipped == ("Tanggal", "jam") and list(result.columns) == ["Laju"]
    np.testing.assert_array_equal(result.columns["Laju"], [1.5, nan, nan, 2.5])
    np.testing.assert_array_equal(result.lines, [3, 4, 5, 6])
    for word in ("4", "(Laju)", "gaps: 2", "point", "Tanggal, jam"):
        assert word in result.note_en
    for word in ("4", "(Laju)", "sel kosong: 2", "titik", "Tanggal, jam"):
        assert word in result.note_id


def test_a_first_line_without_a_number_is_no_header_unless_it_names_numbers():
    np.testing.assert_array_equal(
        read_text("2024-01-01;NA\n2024-01-02;1,5").columns["2"], [nan, 1.5]
    )


@pytest.mark.parametrize(
    "text, en, id",
    [
        ("1,5\n2,6", "'1,5' was read as one number", "'1,5' dibaca sebagai satu bilangan"),
        (
            "1.234\n2.345",
            "'1.234' was read as a decimal, not as thousands",
            "'1.234' dibaca sebagai desimal, bukan ribuan",
        ),
    ],
)
def test_the_note_says_what_was_chosen(text, en, id):
    assert en in read_text(text).note_en and id in read_text(text).note_id


@pytest.mark.parametrize(
    "text, en, id",
    [
        ("", "no column of numbers", "Tidak ada kolom bilangan"),
        ("\n \n", "no column of numbers", "Tidak ada kolom bilangan"),
        ("a\nb", "no column of numbers", "Tidak ada kolom bilangan"),
        ("1\nx\n", "Line 2, column '1': 'x' is neither", "Baris 2, kolom '1': 'x' bukan bilangan"),
        (
            "v\n1\n\n" + "y" * 50,
            "Line 4, column 'v': '" + "y" * 40 + "' is neither",
            "Baris 4, kolom 'v': '" + "y" * 40 + "' bukan",
        ),
        ("12.34.5\n1", "Line 1, column '1': '12.34.5'", "Baris 1, kolom '1': '12.34.5'"),
        ("s;m\ns;m/s\n1;2", "Line 2, column 's': 's'", "Baris 2, kolom 's': 's'"),
        ("1\n#DIV/0!", "Line 2, column '1': '#DIV/0!'", "Baris 2, kolom '1': '#DIV/0!'"),
        ("1\n0x10", "'0x10' is neither", "'0x10' bukan"),
        ("1\n1_000", "'1_000' is neither", "'1_000' bukan"),
        ("1\n=2+3", "'=2+3' is neither", "'=2+3' bukan"),
        (
            "a;b\n0,5;12.34\n",
            "'12.34' in line 2, '0,5' in line 2",
            "'12.34' di baris 2, '0,5' di baris 2",
        ),
        ("1.5\n1,5", "decimal point and comma", "titik dan koma desimal"),
        ("1,234\n1.234", "decimal point and comma", "titik dan koma desimal"),
        ("a\n1\n1,23,456.5", "'1,23,456.5' is neither", "'1,23,456.5' bukan"),
        (
            "1,234.5\n2,345.6",
            "Line 1, '1,234.5': the comma may separate",
            "Baris 1, '1,234.5': koma dapat memisahkan",
        ),
        (
            "1,234,567\n2,345,678",
            "comma may separate thousands or columns",
            "memisahkan ribuan atau kolom",
        ),
        (
            "1;2\n3;4;5",
            "Line 2 has not as many cells (3) as the first line (2)",
            "Banyaknya sel di baris 2 (3)",
        ),
        ("1;2\n3", "Line 2 has not as many cells (1)", "Banyaknya sel di baris 2 (1)"),
        ("1 2\n3 4 5\n", "Line 2 has not as many cells (3)", "baris 2 (3)"),
        ('"a\n1', "quotation marks", "Tanda kutip"),
        ("1\ninf", "Line 2, column '1': 'inf' is too large", "'inf' terlalu besar"),
        ("1\n-Infinity", "'-Infinity' is too large", "'-Infinity' terlalu besar"),
        ("1\n1e301", "'1e301' is too large", "'1e301' terlalu besar"),
        ("-1e999\n1", "'-1e999' is", "'-1e999'"),
        (
            "1\n" * (MAX_READ + 1),
            "200001 rows are too many; the limit is 200000",
            "200001 baris terlalu banyak",
        ),
    ],
)
def test_what_cannot_be_read_is_named_in_both_languages(text, en, id):
    with pytest.raises(InputError) as error:
        read_text(text)
    assert (
        en in error.value.en
        and id in error.value.id
        and str(error.value) == f"{error.value.en} / {error.value.id}"
    )


def test_200_000_rows_are_read():
    result = read_text("v\n" + "1,5\n" * MAX_READ)
    assert (
        result.columns["v"].shape == result.lines.shape == (MAX_READ,)
        and result.lines[-1] == MAX_READ + 1
    )


def test_a_wrong_decimal_argument_is_refused():
    with pytest.raises(ValueError, match="decimal must be"):
        read_text("1", decimal=";")


# --- reading files ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
)
def test_every_encoding_of_a_text_file_is_read(encoding):
    result = read_file("Data.CSV", "Suhu °C;n\r\n0,39;1\r\n–0,49;2\r\n".encode(encoding))
    assert list(result.columns) == ["Suhu °C", "n"]
    np.testing.assert_array_equal(result.columns["Suhu °C"], [0.39, -0.49])


@pytest.mark.parametrize(
    "name, content",
    [
        ("a.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"),
        ("a.ods", b"PK\x03\x04"),
        ("a.png", b"\x89PNG\r\n\x1a\n\0"),
        ("a.csv", b"\x89PNG\r\n\x1a\n\0"),
        ("a.csv", b"PK\x03\x04\0\0"),
        ("a.xlsx", b"1;2"),
        ("a.xlsx", b"PK\x03\x04broken"),
        ("a", b"1"),
        ("a.txt", b"\xff\xfea"),
        ("a.txt", b"1\n2\n\x81"),
    ],
)
def test_another_kind_of_file_is_refused(name, content):
    with pytest.raises(InputError) as error:
        read_file(name, content)
    assert (
        repr(name) in error.value.en
        and "is not a text" in error.value.en
        and "bukan berkas teks" in error.value.id
    )


def xlsx(*sheets):
    """A workbook with these sheets, each a list of rows -> bytes."""
    book = Workbook()
    book.remove(book.active)
    for k, rows in enumerate(sheets, start=1):
        sheet = book.create_sheet(f"Data {k}")
        for row in rows:
            sheet.append(row)
    target = io.BytesIO()
    book.save(target)
    return target.getvalue()


def test_the_first_sheet_with_numbers_is_read():
    date = np.datetime64("2024-01-01").astype("datetime64[s]").item()
    data = [["Waktu", "z", None], [date, 0.5], [], [date, "#N/A"], [date, 2]]
    result = read_file("a.xlsx", xlsx([["Judul"], ["teks"]], data, [[1], [2]]))
    assert list(result.columns) == ["z"] and result.skipped == ("Waktu",) and result.decimal is None
    np.testing.assert_array_equal(result.columns["z"], [0.5, nan, nan, 2])
    np.testing.assert_array_equal(result.lines, [2, 3, 4, 5])
    assert "sheet: Data 2" in result.note_en and "lembar: Data 2" in result.note_id


def test_numbers_that_excel_holds_as_text_are_read():
    result = read_file("a.xlsx", xlsx([["z"], ["0,39"], [1.5], ["-"]]))
    np.testing.assert_array_equal(result.columns["z"], [0.39, 1.5, nan])


@pytest.mark.parametrize(
    "rows, en, id",
    [
        (
            [["z"], [1], ["=1+1"]],
            "Cell A3 of sheet 'Data 1' holds a formula that was never calculated",
            "Sel A3 di lembar 'Data 1'",
        ),
        ([["z"], [1], [True]], "Line 3, column 'z': 'True'", "Baris 3, kolom 'z': 'True'"),
        ([["z"], [1], ["#DIV/0!"]], "'#DIV/0!' is neither", "'#DIV/0!' bukan"),
        ([["a"], ["b"]], "no column of numbers", "Tidak ada kolom bilangan"),
        ([], "no column", "Tidak ada kolom"),
    ],
)
def test_a_bad_sheet_is_named(rows, en, id):
    with pytest.raises(InputError) as error:
        read_file("a.xlsx", xlsx(rows))
    assert en in error.value.en and id in error.value.id


def test_what_an_indonesian_libreoffice_writes_is_read(tmp_path):
    """Formulas, one of them with an empty result, through LibreOffice with Indonesian settings, as
    .xlsx and .csv."""
    rows = [
        ["Tanggal", "Suhu", "Laju"],
        ["1 Mei", -0.39, '=IF(1=1,"","x")'],
        ["2 Mei", None, "=1234+0.5"],
        ["3 Mei", 0.48, 12.125],
    ]
    (tmp_path / "a.xlsx").write_bytes(xlsx(rows))
    (tmp_path / "out").mkdir()
    libreoffice(tmp_path / "profile", "xlsx", tmp_path / "out", [tmp_path / "a.xlsx"])
    libreoffice(tmp_path / "profile", "csv", tmp_path / "out", [tmp_path / "a.xlsx"])
    from_csv = (tmp_path / "out/a.csv").read_bytes()
    assert b'"-0,39"' in from_csv and b'"1234,5"' in from_csv
    for name in ("a.xlsx", "a.csv"):
        result = read_file(name, (tmp_path / "out" / name).read_bytes())
        assert list(result.columns) == ["Suhu", "Laju"] and result.skipped == ("Tanggal",)
        np.testing.assert_array_equal(result.columns["Suhu"], [-0.39, nan, 0.48])
        np.testing.assert_array_equal(result.columns["Laju"], [nan, 1234.5, 12.125])


def test_the_package_does_not_load_openpyxl():
    code = "import sys, kalman_lib; assert 'openpyxl' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parent.parent)
