"""The workbook that chapter 2 writes in the page computes what the library computes."""

import base64

import numpy as np
import pytest
import workbook_helpers
from explorer_helpers import javascript
from openpyxl import load_workbook

from kalman_lib import LinearModel, kalman_filter, rts_smooth
from kalman_lib.data import write_workbook

nan = np.nan

WORKBOOKS = {
    name: case for name, case in workbook_helpers.CASES.items() if name not in ("changed", "long")
}


@pytest.fixture(scope="module")
def workbooks(bundle, tmp_path_factory):
    """{name: (what the page wrote, what LibreOffice made of it)}: the cases of
    test_workbook.py, and names like formulas."""
    folder = tmp_path_factory.mktemp("from-the-page")
    (folder / "out").mkdir()
    write = """([z, Q, R, x0, P0, name], _) => {
      z = Float64Array.from(z, v => v ?? NaN);
      const p = { Q, R, x0, P0 }, result = _.run(p, { z });
      return btoa(Array.from(_.writeWorkbook({ z, p, result, smooth: _.smoothed(result, Q),
        name }), b => String.fromCharCode(b)).join(""));
    }"""
    asked = {
        name: [
            [None if v != v else v for v in np.asarray(z).tolist()],
            *map(float, rest),
            "Terukur",
        ]
        for name, (z, *rest) in WORKBOOKS.items()
    }
    asked |= {
        f"name{k}": [[1.0, 2.0], 1, 1, 0, 1, name] for k, name in enumerate(workbook_helpers.NAMES)
    }
    for name, content in zip(asked, javascript(bundle, write, *asked.values())):
        (folder / f"{name}.xlsx").write_bytes(base64.b64decode(content))
    workbook_helpers.libreoffice(
        folder / "profile", "xlsx", folder / "out", sorted(folder.glob("*.xlsx"))
    )
    return {
        name: (
            folder / f"{name}.xlsx",
            load_workbook(folder / "out" / f"{name}.xlsx", data_only=True),
        )
        for name in asked
    }


@pytest.mark.parametrize("name", WORKBOOKS)
def test_the_workbook_of_the_page_computes_what_the_library_computes(name, workbooks):
    z, Q, R, x0, P0 = WORKBOOKS[name]
    result = kalman_filter(LinearModel(F=1, H=1, Q=Q, R=R, x0=x0, P0=P0), z)
    smooth, small = rts_smooth(result), 1e-14 * max(np.nanmax(np.abs(z), initial=0), abs(x0))
    path, recalculated = workbooks[name]
    for book in (
        recalculated,
        load_workbook(path, data_only=True),
    ):  # LibreOffice's numbers, and those the page wrote
        No, measured, x_pred, P_pred, y, K, x, P = workbook_helpers.table(book["Filter"], 8)
        np.testing.assert_array_equal(No, np.arange(1, len(z) + 1))
        np.testing.assert_allclose(measured, z, rtol=1e-14)
        for ours, theirs in ((x_pred, result.x_pred), (x, result.x), (y, result.y)):
            np.testing.assert_allclose(ours, theirs[:, 0], rtol=1e-12, atol=small)
        for ours, theirs in ((P_pred, result.P_pred), (P, result.P), (K, result.K)):
            np.testing.assert_allclose(ours, theirs[:, 0, 0], rtol=1e-12)
        _, x, P, P_next, G, x_smooth, P_smooth = workbook_helpers.table(book["RTS"], 7)
        if Q + P0 > 0:  # else the state is known, G = 0/0 is 0 by agreement
            np.testing.assert_allclose(x_smooth, smooth.x[:, 0], rtol=1e-12, atol=small)
            np.testing.assert_allclose(P_smooth, smooth.P[:, 0, 0], rtol=1e-12)
            np.testing.assert_allclose(
                G, [*(result.P[:-1] / result.P_pred[1:])[:, 0, 0], nan], rtol=1e-12
            )
        assert book["Filter"]["F4"].value == np.isfinite(z).sum()


def test_its_formulas_are_live_and_those_of_python(workbooks, tmp_path):
    path = workbooks["gaps"][0]
    write_workbook(tmp_path / "python.xlsx", *WORKBOOKS["gaps"])
    ours, theirs = load_workbook(path), load_workbook(tmp_path / "python.xlsx")
    for sheet in ("Filter", "RTS"):
        formulas = [
            {
                cell.coordinate: cell.value
                for row in book[sheet]
                for cell in row
                if cell.data_type == "f"
            }
            for book in (ours, theirs)
        ]
        assert formulas[0] == formulas[1] and len(formulas[0]) > 1800
    assert {name: next(defined.destinations) for name, defined in ours.defined_names.items()} == {
        name: next(defined.destinations) for name, defined in theirs.defined_names.items()
    }


@pytest.mark.parametrize("k", range(len(workbook_helpers.NAMES)))
def test_in_the_workbook_a_name_is_never_a_formula(k, workbooks):
    path, recalculated = workbooks[f"name{k}"]
    cell = load_workbook(path)["Filter"]["G4"]
    assert (
        cell.data_type != "f"
        and cell.quotePrefix
        and cell.value == recalculated["Filter"]["G4"].value == workbook_helpers.NAMES[k].strip()
    )
