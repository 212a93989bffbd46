"""The workbook that filters by its own formulas, as LibreOffice computes it."""

import io
import re
import zipfile

import numpy as np
import pytest
from openpyxl import load_workbook
from openpyxl.formula.translate import Translator
from workbook_helpers import CASES, NAMES, libreoffice, table

from kalman_lib import LinearModel, kalman_filter, rts_smooth
from kalman_lib.data import InputError, write_workbook
from kalman_lib.data.workbook import MAX_WRITE
from kalman_lib.data.workbook_parts import FIRST
from kalman_lib.papers import smoother

nan = np.nan


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
