"""The widgets of the chapters in a real JupyterLab, in a real browser, used as a reader uses them."""
import csv
import io
import json
import os
import re
import socket
import subprocess
import sys
import time
import urllib.request

import numpy as np
import pytest
from openpyxl import load_workbook

from conftest import ROOT
from kalman_lib import kalman_filter
from kalman_lib.papers import smoother

CELLS = ["from kalman_lib import widgets", "widgets.theory_steps()", "widgets.smoother_form()",
         "widgets.smoother_online()", "widgets.gyro()", "widgets.beetle()",
         "widgets.ship()", "widgets.quadrotor()", "widgets.gyro_mismatch()"]
PATIENCE = 60_000           # ms; every wait ends as soon as its condition holds


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """The address of a JupyterLab of its own, which touches nothing of the user's and reaches nothing outside."""
    folder = tmp_path_factory.mktemp("lab")
    (folder / "work").mkdir()
    cells = [{"cell_type": "code", "id": f"cell{k}", "metadata": {}, "source": source, "outputs": [],
              "execution_count": None} for k, source in enumerate(CELLS)]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    (folder / "work" / "widgets.ipynb").write_text(json.dumps(notebook))
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    own = {name: str(folder / name) for name in (
        "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR", "JUPYTERLAB_SETTINGS_DIR",
        "JUPYTERLAB_WORKSPACES_DIR")}
    address = f"http://127.0.0.1:{port}"
    with open(folder / "log", "w") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ip=127.0.0.1", f"--port={port}",
             "--ServerApp.port_retries=0", "--IdentityProvider.token=book", f"--ServerApp.root_dir={folder / 'work'}",
             "--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"],
            env={**os.environ, **own, "PYTHONPATH": str(ROOT)}, stdout=log, stderr=subprocess.STDOUT)
    try:
        until = time.monotonic() + PATIENCE / 1000
        while True:
            try:
                urllib.request.urlopen(f"{address}/api/status?token=book", timeout=5).close()
                break
            except OSError:
                assert server.poll() is None and time.monotonic() < until, (folder / "log").read_text()[-2000:]
                time.sleep(0.1)
        yield address
    finally:
        server.terminate()
        server.wait(30)


@pytest.fixture(scope="module")
def page(lab, chromium):
    """The notebook, open and run; afterwards: no request left the machine, nothing failed in the console."""
    context = chromium.new_context(viewport={"width": 1200, "height": 6000}, accept_downloads=True)
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    outside, errors = [], []

    def guard(route):
        if route.request.url.startswith((lab, "data:", "blob:")):
            route.continue_()
        else:
            outside.append(route.request.url)
            route.abort()

    context.route("**/*", guard)
    page.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{lab}/lab/tree/widgets.ipynb?token=book&reset")
    page.get_by_text("| Idle").wait_for()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_text("Run All Cells", exact=True).click()
    page.get_by_text("Belum ada pengukuran").wait_for()
    yield page
    context.close()
    assert outside == [] and errors == []


@pytest.fixture
def form(page):
    """The form of chapter 2 with Q = 1e-5 and R = 7.7e-4."""
    form = page.locator(".jp-OutputArea-output").nth(1)
    type_in(form, "Q", "1e-5")
    type_in(form, "R", "7,7e-4")
    return form


def wait_for_table(form, z, **settings):
    """Wait until the Filtered column shows what the library computes."""
    x = kalman_filter(smoother.model(smoother.Params(**settings)), z).x[:, 0]
    expected = [f"{value:.6f}" for value in x]
    form.page.wait_for_function(
        "([root, expected]) => [...root.querySelectorAll('tbody tr')].map(row => row.cells[2]?.textContent)"
        ".slice(0, expected.length).join() === expected.join()", arg=[form.element_handle(), expected])


def field(form, name):
    """The text field below the label that begins with the name."""
    label = form.locator(".widget-vbox").filter(has=form.page.locator(".widget-label", has_text=re.compile(f"^{name},")))
    return label.last.get_by_role("textbox").last


def type_in(form, name, text):
    field(form, name).fill(text)
    field(form, name).press("Enter")


def test_stepping_forward_and_back(page):
    steps = page.locator(".jp-OutputArea-output").nth(0)
    sentence = "K = 0,878: 88 %"
    for _ in range(2):
        steps.get_by_role("button", name="Berikutnya").click()
    steps.get_by_text(sentence).wait_for()
    # the numbers of the typeset mathematics: its glyphs name the characters, mjx-c30 is the digit 0
    page.wait_for_function("""root => [...root.querySelectorAll('mjx-c')].map(glyph => String.fromCodePoint(
        parseInt(glyph.className.match(/mjx-c([0-9A-F]+)/)[1], 16))).join('').includes('0.878')""", arg=steps.element_handle())
    steps.get_by_role("button", name="Berikutnya").click()
    steps.get_by_text("Langkah 2 dari 5: prediksi").wait_for()
    steps.get_by_role("button", name="Sebelumnya").click()
    steps.get_by_text(sentence).wait_for()
    steps.get_by_role("button", name="English").click()
    steps.get_by_text("K = 0.878: 88 %").wait_for()
    steps.get_by_role("button", name="Previous").wait_for()


def test_Q_and_R_by_text_and_by_keyboard(form):
    wait_for_table(form, smoother.MEASURED, R=7.7e-4)
    type_in(form, "R", "1e-5")
    wait_for_table(form, smoother.MEASURED)
    type_in(form, "R", "7.7e-4")
    slider = form.locator(".noUi-handle").first
    slider.focus()
    slider.press("ArrowRight")
    wait_for_table(form, smoother.MEASURED, R=7.7e-4, Q=float(f"{10 ** -4.95:.3g}"))
    type_in(form, "Q", "banyak")
    form.get_by_text("'banyak' bukan bilangan.").wait_for()
    wait_for_table(form, smoother.MEASURED, R=7.7e-4, Q=float(f"{10 ** -4.95:.3g}"))


def test_uploading_a_file_with_decimal_commas(form):
    content = "waktu;suhu\n1;20,5\n2;21,75\n3;\n4;22,25\n".encode()
    with form.page.expect_file_chooser() as chooser:
        form.get_by_role("button", name="Unggah").click()
    chooser.value.set_files({"name": "suhu.csv", "mimeType": "text/csv", "buffer": content})
    form.get_by_text("N = 4").wait_for()
    form.get_by_label("Kolom").select_option("suhu")
    wait_for_table(form, np.array([20.5, 21.75, np.nan, 22.25]), R=7.7e-4)


def test_pasting_text_good_and_bad(form):
    paste = form.get_by_placeholder("Tempelkan")
    paste.fill("1,5\n2,5\n3,25")
    wait_for_table(form, np.array([1.5, 2.5, 3.25]), R=7.7e-4)
    paste.fill("1,5\n2,5\ntiga")
    form.get_by_text("Baris 3").wait_for()
    wait_for_table(form, np.array([1.5, 2.5, 3.25]), R=7.7e-4)
    form.get_by_role("button", name="English").click()
    form.get_by_text("Line 3").wait_for()
    form.get_by_role("columnheader", name="Measured").wait_for()
    form.get_by_role("button", name="Bahasa Indonesia").click()
    paste.fill("1,5\n2,5\n3,25")
    form.get_by_text("Baris 3").wait_for(state="detached")


def test_downloading_csv_and_xlsx(form, tmp_path):
    form.get_by_placeholder("Tempelkan").fill("1,5\n2,5\n3,25")
    wait_for_table(form, np.array([1.5, 2.5, 3.25]), R=7.7e-4)
    for button, name in (("Siapkan CSV", "kalman.csv"), ("Siapkan Excel", "kalman.xlsx")):
        form.get_by_role("button", name=button).click()
        with form.page.expect_download() as download:
            form.get_by_role("link", name=f"Simpan {name}").click()
        assert download.value.suggested_filename == name
        download.value.save_as(tmp_path / name)
    table = list(csv.reader(io.StringIO((tmp_path / "kalman.csv").read_text())))
    x = kalman_filter(smoother.model(smoother.Params(R=7.7e-4)), [1.5, 2.5, 3.25]).x[:, 0]
    assert [float(row[2]) for row in table[1:]] == pytest.approx(x, rel=1e-14)
    sheet = load_workbook(tmp_path / "kalman.xlsx").worksheets[0]
    cells = [cell for row in sheet.iter_rows(values_only=True) for cell in row]
    assert 7.7e-4 in cells and 3.25 in cells and any(str(cell).startswith("=") for cell in cells)


def test_one_measurement_at_a_time(page):
    online = page.locator(".jp-OutputArea-output").nth(2)
    for _ in range(2):                          # the same number twice
        online.get_by_role("textbox").fill("24,5")
        online.get_by_role("textbox").press("Enter")
        page.wait_for_function("root => root.querySelector('input[type=text]').value === ''", arg=online.element_handle())
    online.get_by_role("cell", name="2", exact=True).wait_for()
    online.locator(".jupyter-button").filter(has=page.locator(".fa-play")).click()
    page.wait_for_function("root => root.querySelector('tbody td').textContent >= 5", arg=online.element_handle())
    online.get_by_role("button", name="Kosongkan").click()
    online.get_by_text("Belum ada pengukuran").wait_for()


@pytest.mark.parametrize("place, says, buttons", [
    (3, "Galat pengukuran terbesar", ["Derau baru", "Kasus 7"]), (4, "Sesudah 20 s", ["Derau baru", "0.001"]),
    (5, "RMSE: pengukuran", ["Derau baru"]), (6, "RMSE terhadap", ["Derau baru"]),
    (7, "Filter percaya \u03c3_w", ["Derau baru"])])
def test_a_button_changes_the_outcome(page, place, says, buttons):
    """Chapters 3, 5, 4, 6 and 3's map: the sentence tells another outcome after "new noise", another case, another R of the paper."""
    output = page.locator(".jp-OutputArea-output").nth(place)
    for button in buttons:
        before = output.get_by_text(says).first.inner_text()
        output.get_by_role("button", name=button, exact=True).click()
        page.wait_for_function("([root, says, before]) => [...root.querySelectorAll('p')].some("
                               "p => p.innerText.includes(says) && p.innerText !== before)", arg=[output.element_handle(), says, before])
    output.get_by_role("button", name="English").click()
    output.get_by_role("button", name="New noise").wait_for()
