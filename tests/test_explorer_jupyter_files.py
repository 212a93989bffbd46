"""What a reader brings to the explorers in JupyterLab: the kernel reads workbooks, recordings."""

import io

import explorers as explorers_to_bundle
import numpy as np
import pytest
from conftest import listen
from jupyter_helpers import (
    element_in,
    notebook,
    open_notebook,
    run_cell,
    running_lab,
    wait_until,
    window,
)
from openpyxl import Workbook, load_workbook

from kalman_lib import kalman_filter
from kalman_lib.data import read_recording, rest_seconds
from kalman_lib.papers import quadrotor, ship, smoother

CODE = [
    "from kalman_lib.explorer import explore",
    "explore('smoother')",
    "explore('ship')",
    "explore('quadrotor')",
]


@pytest.fixture(scope="module")
def page(tmp_path_factory, chromium):
    explorers_to_bundle.for_notebooks()
    notebooks = {"files.ipynb": notebook(("lang-id", "Halo."), *CODE)}
    with running_lab(tmp_path_factory.mktemp("lab"), notebooks) as lab:
        with window(chromium, lab, accept_downloads=True) as context:
            page = open_notebook(context, lab, "files.ipynb")
            trouble = listen(page)
            for number in range(len(CODE)):
                run_cell(page, number)
            yield page
            assert trouble == []


def xlsx(rows):
    book, content = Workbook(), io.BytesIO()
    for row in rows:
        book.active.append(row)
    book.save(content)
    return content.getvalue()


def choose_file(element, *files):
    chosen = [{"name": name, "mimeType": "", "buffer": content} for name, content in files]
    element.locator("input[type=file]").set_input_files(chosen)


def test_a_workbook_for_the_smoother(page):
    element = element_in(page, 1)
    z = np.array([20.5, 21.75, np.nan, 22.25])
    rows = [["waktu", "suhu"], *([k, None if np.isnan(v) else v] for k, v in enumerate(z))]
    choose_file(element, ("suhu.xlsx", xlsx(rows)))
    wait_until(element, "e.r.z.length === 4 && e.r.z[0] === 20.5 && Number.isNaN(e.r.z[2])")
    p = element.evaluate("({ explorer: { r } }) => [r.p.Q, r.p.R, r.p.x0, r.p.P0]")
    assert p[2] == 20.5  # it starts at the first measurement
    x = kalman_filter(smoother.model(smoother.Params(*p)), z).x[:, 0]
    assert element.evaluate("e => Array.from(e.explorer.r.result.x)") == pytest.approx(x, rel=1e-12)
    choose_file(element, ("gambar.xlsx", b"\x89PNG\0"))
    element.locator(".explorer-message").filter(has_text="gambar.xlsx").wait_for()
    assert element.evaluate("e => e.explorer.r.z.length") == 4


def test_the_workbook_comes_with_its_chart_and_notes(page, tmp_path):
    element = element_in(page, 1)
    element.locator("textarea").fill("1,5\n2,5\n3,25")
    wait_until(element, "e.r.z.length === 3")
    with page.expect_download() as download:
        element.get_by_role("button", name="Unduh Excel").click()
    assert download.value.suggested_filename == "kalman.xlsx"
    download.value.save_as(tmp_path / "kalman.xlsx")
    sheet = load_workbook(tmp_path / "kalman.xlsx").worksheets[0]
    cells = [cell for row in sheet.iter_rows(values_only=True) for cell in row]
    assert 3.25 in cells and any(str(cell).startswith("=") for cell in cells)
    assert sheet._charts


def test_R_from_a_stretch_and_the_table_of_the_form(page):
    element = element_in(page, 1)
    element.locator("textarea").fill("1,5\n2,5\n3,25\n9")
    wait_until(element, "e.r.z.length === 4")
    field = element.locator("input[id$=-entry]")
    field.fill("1-3")
    field.press("Enter")
    wait_until(
        element, "Math.abs(e.s.R - values[0]) < 1e-6", float(np.var([1.5, 2.5, 3.25], ddof=1))
    )
    for text, said in (("3-3", "kurang dari dua"), ("tiga", "bukan ruas")):
        field.fill(text)
        field.press("Enter")
        element.locator(".explorer-message").filter(has_text=said).wait_for()
    element.locator("summary").click()
    heads = element.locator(".explorer-table th[scope=col]")
    heads.nth(2).wait_for()
    assert heads.all_inner_texts()[:3] == ["No", "Terukur", "Hasil filter"]


def test_a_towing_run_in_a_workbook_with_three_columns(page):
    element = element_in(page, 2)
    t, run = ship.towing_run(np.random.default_rng(3))
    rows = [["run", "t", "v"], *([7, a, b] for a, b in zip(t, run.z[:, 0]))]
    choose_file(element, ("uji.xlsx", xlsx(rows)))
    wait_until(element, "e.r.data.truth === null")
    shown = element.evaluate("e => Array.from(e.explorer.r.data.z)")
    assert shown == pytest.approx(run.z[:, 0], abs=1e-12)
    element.get_by_label("Kolom waktu").select_option("v")
    element.locator(".explorer-message").filter(has_text="berbeda").wait_for()


def phone_file(seconds, rest=4.0):
    """A made-up phone export, one file: the phone lies still and then turns about its z axis."""
    t = np.arange(0, seconds, 0.05)
    turn = np.where(t < rest, 0, 0.5)
    noise = np.random.default_rng(0).normal(size=(2, len(t))) * 1e-3
    rows = [
        f"{a:.2f},0,0,{b:.4f},0,0,{c:.4f},20,0,-30"
        for a, b, c in zip(t, turn + noise[0], 9.81 + noise[1])
    ]
    sensors = (("Gyroscope", "rad/s"), ("Acceleration", "m/s^2"), ("Magnetic Field", "µT"))
    names = [f"{sensor} {axis} ({unit})" for sensor, unit in sensors for axis in "xyz"]
    return "\n".join([",".join(["Time (s)", *names]), *rows]).encode()


def test_a_phone_recording_and_what_it_lacks(page):
    element = element_in(page, 3)
    outcome = element.locator(".explorer-outcome")
    message = element.locator(".explorer-message")
    choose_file(element, ("phone.csv", b"Time (s);Gyroscope x (rad/s)\n0;1\n"))
    message.filter(has_text="a").wait_for()
    choose_file(element, ("phone.csv", phone_file(12)))
    outcome.filter(has_text="tidak memuat sudut pembanding").wait_for()
    assert message.is_hidden()
    T, last, angles = element.evaluate(
        """({explorer: {r}}) => [r.flight.T, r.flight.t.at(-1), Array.from(r.result.angles)]"""
    )
    assert (T, last) == (240, pytest.approx(11.95))
    slider = element.locator("input[type=range][id$='-moment']")
    assert float(slider.get_attribute("max")) == pytest.approx(11.95)
    r = read_recording({"phone.csv": phone_file(12)})
    expected = quadrotor.attitude(
        r.t, r.gyr, r.acc, r.mag, rest_seconds(r), quadrotor.METHODS["paper"]
    )
    apart = quadrotor.wrap(np.reshape(angles, (-1, 3)) - expected.angles)
    assert np.abs(apart).max() < 1e-9
    element.get_by_label("Sumbu alat").select_option("flu")
    outcome.filter(has_text="depan-kiri-atas").wait_for()
    acc = read_recording({"phone.csv": phone_file(12)}, axes="flu").acc
    wait_until(element, "Math.abs(e.r.flight.acc[1] - values[0]) < 1e-12", acc[0, 1])
    choose_file(element, ("moving.csv", phone_file(11, rest=0)))
    outcome.filter(has_text="tidak dimulai dalam keadaan diam").wait_for()
    assert element.evaluate("e => [e.explorer.r.flight.T, e.explorer.r.flight.rest_s]") == [220, 0]
    element.get_by_role("button", name="Kembali ke penerbangan sintetis").click()
    outcome.filter(has_text="Penerbangan sintetis").wait_for()
