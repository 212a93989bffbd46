"""Chapter 2 in the page: the form, what is downloaded from it, and one measurement at a time."""

import csv
import re

import numpy as np
import pytest
from explorer_helpers import estimates, javascript, paste, picture, shown
from openpyxl import load_workbook
from own_helpers import form_in, from_the_first

from kalman_lib import kalman_filter, rts_smooth
from kalman_lib.data import InputError, read_table
from kalman_lib.papers import smoother

nan = np.nan

# --- the same numbers, beyond what test_explorer_parity.py compares -----------------------------


def test_lag_likelihood_and_smoother_as_in_python(bundle):
    rng = np.random.default_rng(3)
    for make in (smoother.silkworm_room, smoother.cutting_force, smoother.tank_level):
        data = make(rng)
        z, truth = data.z[:, 0].copy(), data.x[:, 0]
        p = smoother.Params(Q=0.01, R=0.1, x0=float(z[0]))
        z[5:9] = nan
        x, P, K, smooth = smoother.scalar_filter(z, p)
        result = kalman_filter(smoother.model(p), z)
        (answer,) = javascript(
            bundle,
            """([z, truth, name], _) => {
          z = Float64Array.from(z, v => v ?? NaN); truth = Float64Array.from(truth);
          const p = { Q: 0.01, R: 0.1, x0: z[0], P0: 1 }, r = _.run(p, { z }), s = _.smoothed(r,
            p.Q), pair = _.maximum_likelihood(z), look = _.LOOK_ALIKES[name];
          return [_.lag(r.x, truth), _.lag(r.x, s.x), pair[0], pair[1], s.x, s.P, truth.map((_,
            k) => look.truth(k)), _.steady_gain(0.1)];
        }""",
            [[None if v != v else v for v in z.tolist()], truth.tolist(), make.__name__],
        )
        Q, R = smoother.maximum_likelihood(z)
        assert answer[:2] == pytest.approx(
            [smoother.lag(x, truth), smoother.lag(x, smooth)], rel=1e-9
        )
        assert answer[2:4] == pytest.approx([Q, R], rel=1e-5)
        np.testing.assert_allclose(answer[4], smooth, rtol=1e-12)
        np.testing.assert_allclose(answer[5], rts_smooth(result).P[:, 0, 0], rtol=1e-9)
        np.testing.assert_allclose(answer[6], truth, rtol=1e-12, atol=1e-12)
        assert answer[7] == pytest.approx(smoother.steady_gain(0.1), rel=1e-14)
    refused = javascript(
        bundle, "(z, _) => _.maximum_likelihood(Float64Array.from(z))", [1, 2], [1, 2, 3], [5, 5, 5]
    )
    assert all(
        "at least three values" in answer["error"][1]
        and "sedikitnya tiga nilai" in answer["error"][0]
        for answer in refused
    )


def test_R_from_a_steady_stretch(bundle):
    program = "(z, _) => _.R_from_steady(Float64Array.from(z))"
    for seed in range(5):
        z = np.random.default_rng(seed).normal(5, 0.1, 20)
        (answer,) = javascript(bundle, program, z.tolist())
        assert answer == pytest.approx(smoother.R_from_steady(z), rel=1e-12)


# --- the page -----------------------------------------------------------------------------------


@pytest.fixture(params=["id", "en"])
def form(request, opened, site):
    yield from form_in(request.param, opened, site)


def test_the_form_starts_with_the_paper_s_table(form):
    _, element, language = form
    np.testing.assert_allclose(estimates(element), smoother.FILTERED, atol=5e-7)
    assert {"id": "tidak meninggalkan perangkat ini", "en": "Nothing leaves this device"}[
        language
    ] in element.inner_text()


def test_R_from_a_stretch_and_the_table_of_the_form(form):
    page, element, language = form
    paste(element, "1.5\n2.5\n3.25\n9")
    field = element.locator("input[id$=-entry]")
    field.fill("1-3")
    field.press("Enter")
    shown(element)
    R = float(np.var([1.5, 2.5, 3.25], ddof=1))
    assert element.evaluate("e => e.explorer.s.R") == pytest.approx(R, rel=1e-5)
    field.fill("3-3")
    field.press("Enter")
    message = {"id": "kurang dari dua nilai", "en": "fewer than two values"}[language]
    element.locator(".explorer-message").filter(has_text=message).wait_for()
    element.locator("details.explorer-numbers").evaluate("e => { e.open = true }")
    heads = element.locator(".explorer-table th[scope=col]")
    heads.nth(2).wait_for()
    measured, filtered = {"id": ("Terukur", "Hasil filter"), "en": ("Measured", "Filtered")}[
        language
    ]
    assert heads.all_inner_texts()[:3] == ["No", measured, filtered]


def test_a_pasted_column_is_filtered(form):
    _, element, language = form
    paste(element, "Waktu;Suhu\n1;25,5\n2;\n3;26,5\n")
    assert "Suhu" in element.locator(".explorer-outcome").inner_text()
    column = element.get_by_label({"id": "Kolom", "en": "Column"}[language], exact=True)
    found = {"id": "dikenali: Suhu", "en": "found: Suhu"}[language]
    assert column.locator("option").all_inner_texts() == [found, "Waktu", "Suhu"]
    np.testing.assert_allclose(
        estimates(element), from_the_first(np.array([25.5, nan, 26.5]))[0], rtol=1e-12
    )
    column.select_option("Waktu")
    shown(element)
    np.testing.assert_allclose(estimates(element), from_the_first(np.arange(1.0, 4))[0], rtol=1e-12)
    paste(element, "1,234\n2,345")
    assert (
        "1,234" in element.locator(".explorer-outcome").inner_text()
    )  # the note tells how it was read
    sign = element.get_by_label({"id": "Tanda desimal", "en": "Decimal sign"}[language], exact=True)
    sign.select_option(".")
    shown(element)
    assert element.evaluate("e => e.explorer.r.data.names") == [
        "1",
        "2",
    ]  # two columns, as read_table says
    element.locator("input[type=file]").set_input_files({
        "name": "a.csv",
        "mimeType": "text/csv",
        "buffer": b"v\n7\n8\n9\n",
    })
    element.page.wait_for_function(
        "e => e.explorer.r.z.length === 3 && e.explorer.r.z[0] === 7", arg=element.element_handle()
    )
    assert element.locator("textarea").input_value() == ""


@pytest.mark.parametrize(
    "bad, line",
    [
        ("1\n<img src=x onerror=alert(1)>\n3", 2),
        ("1\n2\n<script>alert(1)</script>", 3),
        ("1\n=cmd|' /C calc'!A0", 2),
        ("1\n1e308", 2),
        ("NaN\nNaN", None),
        ("1\n2 3 4", 2),
        ("1,234,567\n2,345,678", 1),
        ("1\n" * 200_001, None),
        ("1;2\n3;4;5", 2),
        ("x\x00\x01\x02", None),
        ("x" * 5000, None),
        ('"1\n2', None),
    ],
    ids=lambda value: repr(value)[:25],
)
def test_bad_input_is_one_sentence_and_the_figure_stays(bad, line, form):
    _, element, language = form  # an alert would be trouble on the page: see the fixture
    before = picture(element)
    paste(element, bad)
    message = element.locator(".explorer-message")
    message.wait_for(state="visible")
    text = message.inner_text()
    assert (
        len(text) < 300
        and text.endswith(".")
        and "\n" not in text
        and message.locator("*").count() == 0
    )
    if line:
        assert (
            f"{ {'id': 'baris', 'en': 'line'}[language] } {line}" in text.lower()
            and bad.split("\n")[line - 1].split(";")[0][:20].split(" ")[0] in text
            or "cells" in text
            or "sel di" in text
        )
    with pytest.raises(InputError) as refused:
        read_table(bad)
    assert text == getattr(refused.value, language)
    assert picture(element) == before
    paste(element, "1\n2\n4")  # and it goes on
    message.wait_for(state="hidden")


def test_a_binary_file_is_refused(form):
    _, element, language = form
    before = picture(element)
    for name, content in (
        ("a.csv", b"\x89PNG\r\n\x1a\n\0\0"),
        ("<b>x</b>.xlsx", b"PK\x03\x04\0"),
        ("a.exe", bytes(range(256))),
    ):
        element.locator("input[type=file]").set_input_files({
            "name": name,
            "mimeType": "text/csv",
            "buffer": content,
        })
        message = element.locator(".explorer-message")
        message.get_by_text(name).wait_for()
        assert (
            {"id": "simpanlah", "en": "save it"}[language] in message.inner_text()
            and message.locator("*").count() == 0
            and picture(element) == before
        )


def test_a_name_that_is_markup_stays_a_name(form):
    _, element, _ = form
    paste(element, "<b onclick=alert(1)>v</b>\t=1+1\n1\t2\n3\t4")
    assert (
        element.locator(".explorer-controls option b, .explorer-outcome b").count() == 0
        and "<b onclick" in element.locator(".explorer-outcome").inner_text()
    )


def test_most_likely_Q_and_R(form):
    _, element, language = form
    element.locator("select").first.select_option("nile")
    shown(element)
    element.get_by_role(
        "button", name={"id": "Q dan R paling mungkin", "en": "Most likely Q and R"}[language]
    ).click()
    shown(element)
    assert element.evaluate(
        "e => [e.explorer.s.Q, e.explorer.s.R, e.explorer.s.x0]"
    ) == pytest.approx([1469.18, 15098.5, 1120], rel=1e-4)


# --- downloads ----------------------------------------------------------------------------------


def download(page, element, name):
    with page.expect_download() as info:
        element.get_by_role("button", name=re.compile(f"(Unduh|Download) {name}")).click()
    return info.value


def test_the_csv_holds_every_digit(form, tmp_path):
    page, element, language = form
    element.locator("input[type=checkbox]").last.check()
    paste(element, "=cmd|' /C calc'!A0\n1.5\n\n2.25\n4")
    file = download(page, element, "CSV")
    assert file.suggested_filename == "kalman.csv"
    file.save_as(tmp_path / "a.csv")
    separator, sign = {"id": (";", ","), "en": (",", ".")}[language]  # as Excel there expects
    lines = (tmp_path / "a.csv").open(encoding="utf-8", newline="")
    rows = list(csv.reader(lines, delimiter=separator))
    x, P, K, smooth = from_the_first(np.array([1.5, nan, 2.25, 4]))
    assert rows[0] == [
        *{"id": ["No", "Terukur", "Hasil filter"], "en": ["No", "Measured", "Filtered"]}[language],
        "K",
        "P",
        "MA3",
        {"id": "Penghalus RTS", "en": "RTS smoother"}[language],
    ]
    assert [row[1].replace(sign, ".") for row in rows[1:]] == ["1.5", "", "2.25", "4"] and not any(
        cell[:1] in "=+@" and cell for row in rows for cell in row
    )
    for column, values in ((2, x), (3, K), (4, P), (6, smooth)):
        shown_values = [float(row[column].replace(sign, ".")) for row in rows[1:]]
        np.testing.assert_allclose(shown_values, values, rtol=1e-12)
    table = read_table(tmp_path / "a.csv")
    np.testing.assert_allclose(table.columns["K"], K, rtol=1e-12)
    element.locator("input[type=checkbox]").last.uncheck()


def test_the_result_can_be_copied(form):
    page, element, language = form
    page.evaluate(
        """() => {
          window.copied = null;
          navigator.clipboard.writeText = async text => { window.copied = text; };
        }"""
    )
    element.get_by_role(
        "button", name={"id": "Salin hasilnya", "en": "Copy the result"}[language]
    ).click()
    page.wait_for_function("window.copied")
    text = page.evaluate("window.copied")
    columns = list(read_table(text).columns.values())
    np.testing.assert_allclose(columns[2], smoother.FILTERED, atol=5e-7)
    assert ("-0,39\t" in text) == (language == "id")


def test_the_workbook_is_downloaded(form, tmp_path):
    page, element, _ = form
    paste(element, "=1+1;b\n1;2\n3;4\n5;6")
    file = download(page, element, "Excel")
    assert file.suggested_filename == "kalman.xlsx"
    file.save_as(tmp_path / "a.xlsx")
    sheet = load_workbook(tmp_path / "a.xlsx")["Filter"]
    assert (
        sheet["G4"].value == "=1+1"
        and sheet["G4"].data_type == "s"
        and sheet["G8"].value == "=IF(ISNUMBER(B8),C8+F8*E8,C8)"
    )
    assert [sheet[f"B{row}"].value for row in (7, 8, 9)] == [1, 3, 5]
