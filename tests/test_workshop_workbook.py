"""The workbook of the workshop: its formulas give what the library computes."""

import base64

import numpy as np
import pytest
import workbook_helpers
from openpyxl import load_workbook
from workshop_helpers import SHOWN, own_data, pasted, shown

from kalman_lib.papers import workshop

CASES = {
    "walk": (dict(pattern=2, q=1), {}),
    "constant": (dict(pattern=1), {}),
    "uneven": (dict(pattern=2, q=1), dict(uneven=True, gaps=True)),
    "input": (dict(pattern=2, second=5, q=1), dict(gaps=True)),
    "start": (dict(pattern=2, q=1), dict(gaps=True)),
    "gate": (dict(pattern=2, q=1), dict(outliers=True, gaps=True)),
}
MORE = {"gate": dict(gate=True), "start": dict(first_x="20", first_P="0,5")}
WRITTEN = SHOWN.replace(
    "const plain =",
    "return btoa(String.fromCharCode(..._.writeWorkbook(r))); const plain =",
)
COLUMNS = "ABCDEFGHIJKL"


@pytest.fixture(scope="module")
def workbooks(bundle, tmp_path_factory):
    """{name: (what the page shows, its workbook, what LibreOffice made of it)}."""
    folder = tmp_path_factory.mktemp("workshop")
    (folder / "out").mkdir()
    pages = {}
    for name, (about, way) in CASES.items():
        state = about | pasted(own_data(workshop.Params(**about), **way)) | MORE.get(name, {})
        pages[name] = shown(bundle, **state)
        path = folder / f"{name}.xlsx"
        path.write_bytes(base64.b64decode(bundle.evaluate(WRITTEN, state)))
    files = sorted(folder.glob("*.xlsx"))
    workbook_helpers.libreoffice(folder / "profile", "xlsx", folder / "out", files)
    return {
        name: (page, folder / f"{name}.xlsx", folder / "out" / f"{name}.xlsx")
        for name, page in pages.items()
    }


def columns(path):
    """{letter: numbers} of the table; an empty cell is NaN."""
    sheet = load_workbook(path, data_only=True)["Filter"]
    rows = [row for row in sheet.iter_rows(min_row=7, values_only=True) if row[0] is not None]
    numbers = [[np.nan if value in (None, "") else float(value) for value in row] for row in rows]
    return dict(zip(COLUMNS, np.array(numbers).T))


@pytest.mark.parametrize("name", CASES)
def test_the_formulas_give_the_numbers_of_the_page(name, workbooks):
    page, written, computed = workbooks[name]
    for path in (computed, written):
        table = columns(path)
        np.testing.assert_allclose(table["K"], page["x"][:, 0], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(table["L"], page["P"][:, 0, 0], rtol=1e-9)
        np.testing.assert_allclose(table["I"], page["S"].reshape(-1), rtol=1e-9)
    assert page["gated"].any() == (name == "gate")


def test_the_formulas_are_live(workbooks):
    sheet = load_workbook(workbooks["uneven"][1])["Filter"]
    assert sheet["G8"].value == "=L7+q_*C8" and sheet["I8"].value == "=G8+R_"
    assert sheet["C4"].value == 9
    sheet = load_workbook(workbooks["start"][1])["Filter"]
    assert (sheet["D4"].value, sheet["E4"].value) == (20, 0.5)
