"""A reader's table: files of every kind, sheets, what is refused, and how much is read."""

import datetime
import io
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook
from table_refused import HUGE
from workbook_helpers import libreoffice, xlsx

from kalman_lib.data import InputError, read_table
from kalman_lib.data.limits import MAX_READ

nan = np.nan


def refused(source, **options):
    with pytest.raises(InputError) as error:
        read_table(source, **options)
    assert str(error.value) == f"{error.value.en} / {error.value.id}"
    return error.value.en, error.value.id


# --- text ---------------------------------------------------------------------------------------


def test_labels_are_left_out_and_lines_are_kept():
    result = read_table("\nKota,Laju\nBogor,1.5\n\nDepok,NA\nBogor,2.5\n\n")
    assert result.skipped == ("Kota",) and list(result.columns) == ["Laju"]
    np.testing.assert_array_equal(result.columns["Laju"], [1.5, nan, nan, 2.5])
    np.testing.assert_array_equal(result.lines, [3, 4, 5, 6])
    for word in ("4", "(Laju)", "gaps: 2", "point", "Kota"):
        assert word in result.note["en"]
    for word in ("4", "(Laju)", "sel kosong: 2", "titik", "Kota"):
        assert word in result.note["id"]


def test_200_000_rows_are_read_and_no_more():
    result = read_table("v\n" + "1,5\n" * MAX_READ)
    assert result.columns["v"].shape == result.lines.shape == (MAX_READ,)
    assert result.lines[-1] == MAX_READ + 1
    en, id = refused("1\n" * (MAX_READ + 1))
    assert "200001 rows are too many" in en and "200001 baris terlalu banyak" in id


def test_a_wrong_decimal_argument_is_refused():
    with pytest.raises(ValueError, match="decimal must be"):
        read_table("1", decimal=";")


@pytest.mark.parametrize("name", HUGE)
def test_what_is_huge_is_refused_or_read_cell_by_cell_once(name, monkeypatch):
    """No cell is looked at more often than a few times, so nothing grows faster than the text."""
    from kalman_lib.data import cells

    looks = []
    plain = cells.to_number
    monkeypatch.setattr(cells, "to_number", lambda *given: looks.append(1) or plain(*given))
    text = HUGE[name]()
    try:
        table = read_table(text)
    except InputError as error:
        assert len(error.en) < 300 and len(error.id) < 300
    else:
        assert table.columns
    assert len(looks) < 2_000_000


# --- series -------------------------------------------------------------------------------------


def test_two_columns_become_times_in_seconds_and_measurements():
    table = read_table("t (ms);v\n1000;1\n1500;2\n1500;4\n;9\n2000;5")
    t, z, notes = table.series()
    np.testing.assert_allclose(t, [0, 0.5, 1])
    np.testing.assert_allclose(z, [1, 3, 5])
    assert [note["en"] for note in notes] == [
        "rows without a time: 1",
        "equal times were averaged: 1 rows fewer",
    ]


def test_times_that_go_back_are_told_with_every_digit():
    table = read_table("t;v\n1340000.25;1\n1340000.125;2\n1340001;3", decimal=".")
    with pytest.raises(InputError) as error:
        table.series()
    assert "Line 3" in error.value.en and "1340000.125 after 1340000.25" in error.value.en


def test_another_column_can_be_chosen():
    table = read_table("t;u;v\n0;1;2\n1;3;4\n2;4;9")
    t, z, _ = table.series(time="u", value="t")
    np.testing.assert_allclose(t, [0, 2, 3])
    np.testing.assert_allclose(z, [0, 1, 2])


# --- files --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
)
def test_every_encoding_of_a_text_file_is_read(encoding, tmp_path):
    content = "Suhu °C;n\r\n0,39;1\r\n–0,49;2\r\n".encode(encoding)
    (tmp_path / "Data.CSV").write_bytes(content)
    for source in (content, tmp_path / "Data.CSV", str(tmp_path / "Data.CSV")):
        result = read_table(source)
        assert list(result.columns) == ["Suhu °C", "n"] and result.units == {"Suhu °C": "°C"}
        np.testing.assert_array_equal(result.columns["Suhu °C"], [0.39, -0.49])


@pytest.mark.parametrize(
    "content, en, id",
    [
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "old Excel file", "Excel lama"),
        (
            b"\xd0\xcf\x11\xe0" + "EncryptedPackage".encode("utf-16-le"),
            "protected by a password",
            "kata sandi",
        ),
        (b"\x89PNG\r\n\x1a\n\0", "is not a text file", "bukan berkas teks"),
        (b"PK\x03\x04broken", "is damaged", "rusak"),
        (b"1\n2\n\x81", "is not a text file", "bukan berkas teks"),
        (b"", "no column of numbers", "Tidak ada kolom bilangan"),
    ],
)
def test_another_kind_of_file_is_refused(content, en, id):
    said = refused(content)
    assert en in said[0] and id in said[1]


def test_a_file_that_does_not_exist_is_named(tmp_path):
    en, id = refused(str(tmp_path / "none.csv"))
    assert "none.csv" in en and "cannot be opened" in en and "tidak dapat dibuka" in id


# --- workbooks ----------------------------------------------------------------------------------


def test_the_sheet_with_the_longest_table_is_read_and_another_can_be_chosen():
    date = datetime.datetime(2024, 1, 1, 10)
    later = datetime.datetime(2024, 1, 1, 10, 0, 30)
    data = [["Waktu", "z", None], [date, 0.5], [], [later, "#N/A"], [later, 2]]
    content = xlsx([["Info"], [2026]], data, [["v"], [1], [2]])
    result = read_table(content)
    assert list(result.columns) == ["Waktu", "z"] and result.time == "Waktu"
    np.testing.assert_array_equal(result.columns["Waktu"], [0, nan, 30, 30])
    np.testing.assert_array_equal(result.columns["z"], [0.5, nan, nan, 2])
    np.testing.assert_array_equal(result.lines, [2, 3, 4, 5])
    assert result.sheet == "Data 2" and result.sheets == ("Data 1", "Data 2", "Data 3")
    assert "sheet: Data 2" in result.note["en"] and "lembar: Data 2" in result.note["id"]
    for chosen in ("Data 3", 2):
        assert read_table(content, sheet=chosen).columns["v"].tolist() == [1, 2]
    en, id = refused(content, sheet="Data 9")
    assert "'Data 9'" in en and "Data 1, Data 2" in en and "Tidak ada lembar" in id


def test_numbers_that_excel_holds_as_text_are_read():
    result = read_table(xlsx([["z"], ["0,39"], [1.5], ["-"]]))
    np.testing.assert_array_equal(result.columns["z"], [0.39, 1.5, nan])


@pytest.mark.parametrize(
    "rows, en, id",
    [
        (
            [["z"], [1], ["=1+1"]],
            "Cell A3 of sheet 'Data 1' holds a formula that was never calculated",
            "Sel A3 di lembar 'Data 1'",
        ),
        ([["z"], [1], [True]], "Line 3, column 'z': 'TRUE'", "Baris 3, kolom 'z': 'TRUE'"),
        ([["z"], [1], ["#DIV/0!"]], "'#DIV/0!' is neither", "'#DIV/0!' bukan"),
        ([["a"], ["b"]], "no column of numbers", "Tidak ada kolom bilangan"),
        ([], "no column", "Tidak ada kolom"),
    ],
)
def test_a_bad_sheet_is_named(rows, en, id):
    said = refused(xlsx(rows))
    assert en in said[0] and id in said[1]


def archive(**parts):
    """A workbook of one sheet, with these parts in place of its own."""
    book, content = Workbook(), io.BytesIO()
    book.active.append([1])
    book.save(content)
    made = io.BytesIO()
    with zipfile.ZipFile(content) as old, zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as new:
        for path in old.namelist():
            new.writestr(path, parts.get(Path(path).stem, old.read(path)))
        for name in set(parts) - {Path(path).stem for path in old.namelist()}:
            new.writestr(f"xl/{name}.xml", parts[name])
    return made.getvalue()


def sheet_of(*rows):
    return f"<worksheet><sheetData>{''.join(rows)}</sheetData></worksheet>"


def row(number, *cells):
    return f'<row r="{number}">' + "".join(cells) + "</row>"


FAR = [row(k, f'<c r="A{k}"><v>{k}</v></c>', f'<c r="XFD{k}"/>') for k in range(1, 2001)]
WIDE = [row(k, f'<c r="A{k}"><v>{k}</v></c><c r="ZZ{k}"><v>1</v></c>') for k in range(1, 2001)]
HOSTILE = {
    "a row far below": [row(1, '<c r="A1"><v>1</v></c>'), row(999_999_999, "<c><v>2</v></c>")],
    "the last row": [row(1, '<c r="A1"><v>1</v></c>'), row(1_048_576, "<c><v>2</v></c>")],
    "many rows": ["<row/>" * 400_000],
    "many cells": [row(1, "<c/>" * 2_000_000)],
    "many tags": ["<a/>" * 10_000_000],
    "much text": [row(1, '<c t="str"><v>' + "x" * 60_000_000 + "</v></c>")],
    "no such column": [row(1, '<c r="XFE1"><v>1</v></c>')],
    "no such string": [row(1, '<c r="A1" t="s"><v>9</v></c>')],
    "no number": [row(1, '<c r="A1"><v>one</v></c>')],
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_sheet_is_refused_in_one_sentence(name):
    for sentence in refused(archive(sheet1=sheet_of(*HOSTILE[name]))):
        assert len(sentence) < 200 and sentence.endswith(".")


def test_empty_cells_far_away_take_no_room():
    for rows in (FAR, WIDE):
        table = read_table(archive(sheet1=sheet_of(*rows)))
        np.testing.assert_array_equal(next(iter(table.columns.values())), np.arange(1, 2001))


def test_entities_and_too_many_strings_are_refused():
    bomb = '<!DOCTYPE a [<!ENTITY b "x">]>' + sheet_of(row(1, '<c r="A1"><v>1</v></c>'))
    assert "damaged" in refused(archive(sheet1=bomb))[0]
    strings = "<sst>" + "<si><t>x</t></si>" * 1_000_000 + "</sst>"
    assert "too many" in refused(archive(sharedStrings=strings))[0]


def test_a_damaged_archive_is_one_sentence():
    content = xlsx([["z"], *([k / 7] for k in range(500))])
    rng = np.random.default_rng(4)
    for _ in range(200):
        broken = bytearray(content)
        for at in rng.integers(0, len(broken), 5):
            broken[at] = rng.integers(256)
        for part in (bytes(broken), content[: rng.integers(4, len(content))], content[14:]):
            try:
                read_table(part)
            except InputError as error:
                assert len(error.en) < 300


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
        result = read_table(tmp_path / "out" / name)
        assert list(result.columns) == ["Suhu", "Laju"] and result.skipped == ("Tanggal",)
        np.testing.assert_array_equal(result.columns["Suhu"], [-0.39, nan, 0.48])
        np.testing.assert_array_equal(result.columns["Laju"], [nan, 1234.5, 12.125])


def test_the_package_does_not_load_openpyxl():
    code = "import sys, kalman_lib; assert 'openpyxl' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parent.parent)
