"""A reader's table: pasted text and files, and what is refused."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from workbook_helpers import libreoffice, xlsx

from kalman_lib.data import InputError, read_file, read_text
from kalman_lib.data.table import MAX_READ

nan = np.nan

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
