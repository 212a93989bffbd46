"""The explorers in a real JupyterLab, in a real browser, used as a reader uses them."""

import io
import json

import numpy as np
import pytest
from openpyxl import Workbook, load_workbook

import explorers as explorers_to_bundle
from conftest import listen
from jupyter_helpers import notebook, open_notebook, printed, run_cell, running_lab, write_cell
from kalman_lib import kalman_filter
from kalman_lib.papers import describe, gyro, quadrotor, ship, smoother

IMPORTS = "from kalman_lib.explorer import Explorer, explore\nfrom kalman_lib.papers import gyro"
VIEWS = {  # cell -> paper, view; a control that is a field of Params
    1: ("gyro", None, "sigma_w"),
    2: ("gyro", "mismatch", "sigma_v"),
    3: ("theory", None, "R"),
    4: ("smoother", None, "R"),
    5: ("smoother", "online", "Q"),
    6: ("ship", None, "Q"),
    7: ("beetle", None, "R"),
    8: ("quadrotor", None, "m"),
}
SCRATCH = 9  # a cell for whatever a test wants to know from Python
CODE = [f"e{k} = explore({paper!r}, view={view!r})" for k, (paper, view, _) in VIEWS.items()]
PROSE = {"id": ("lang-id", "Halo."), "en": ("lang-en", "Hello.")}
WATCH = """
  // what the module of the explorer (a blob) has opened in the page and not closed again
  window.opened = new Set();
  const isOurs = () => /blob:/.test(new Error().stack);
  for (const name of ['MutationObserver', 'ResizeObserver', 'IntersectionObserver']) {
    window[name] = class extends window[name] {
      observe(...given) { if (isOurs()) opened.add(this); super.observe(...given); }
      disconnect() { opened.delete(this); super.disconnect(); }
    };
  }
  const { addEventListener: add, removeEventListener: remove } = EventTarget.prototype;
  EventTarget.prototype.addEventListener = function (type, call, options) {
    if ((this === window || this === document) && isOurs()) {
      opened.add(call);
      options?.signal?.addEventListener('abort', () => opened.delete(call));
    }
    return add.call(this, type, call, options);
  };
  EventTarget.prototype.removeEventListener = function (type, call, options) {
    opened.delete(call);
    return remove.call(this, type, call, options);
  };"""
SAME_PICTURE = """canvas => {
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width,
      height: canvas.height }).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, value, i) =>
      (sum * 31 + value * (i & 3)) | 0, 7);
  }"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    explorers_to_bundle.for_notebooks()
    code = [IMPORTS, *CODE, ""]
    first = [IMPORTS, "e = explore('gyro', gyro.Params(sigma_w=5))", ""]
    notebooks = {
        "all.ipynb": notebook(PROSE["id"], PROSE["en"], *code),
        "id.ipynb": notebook(PROSE["id"], *first),
        "en.ipynb": notebook(PROSE["en"], *first),
    }
    with running_lab(tmp_path_factory.mktemp("lab"), notebooks) as address:
        yield address


@pytest.fixture(scope="module")
def context(lab, chromium):
    """A window in which no request leaves the machine."""
    context = chromium.new_context(viewport={"width": 1200, "height": 2400}, accept_downloads=True)
    context.add_init_script(WATCH)
    outside = []

    def guard(route):
        if route.request.url.startswith((lab, "data:", "blob:")):
            route.continue_()
        else:
            outside.append(route.request.url)
            route.abort()

    context.route("**/*", guard)
    yield context
    context.close()
    assert outside == []


@pytest.fixture(scope="module")
def page(lab, context):
    """The notebook with all views, run from the top; afterwards nothing has failed."""
    page = open_notebook(context, lab, "all.ipynb")
    trouble = listen(page)
    for number in range(len(VIEWS) + 1):
        run_cell(page, number)
    yield page
    assert trouble == []


@pytest.fixture(scope="module")
def notebook_in(lab, context):
    """A function that opens the notebook of one language and runs it."""

    def opened(language):
        page = open_notebook(context, lab, f"{language}.ipynb")
        run_cell(page, 0)
        run_cell(page, 1)
        element_in(page, 1)
        return page

    return opened


def element_in(page, number):
    """The explorer below a cell, alive and in sight."""
    element = page.locator(".jp-CodeCell").nth(number).locator("kalman-explorer.live")
    element.wait_for()
    element.scroll_into_view_if_needed()
    page.wait_for_function("e => e.explorer.r !== undefined", arg=element.element_handle())
    return element


def wait_for(element, condition, *values):
    """Until the condition on the explorer e holds."""
    element.page.wait_for_function(
        f"([element, ...values]) => {{ const e = element.explorer; return {condition}; }}",
        arg=[element.element_handle(), *values],
    )


def in_python(page, expression):
    """The value of an expression in the kernel."""
    code = f"import json\nprint(json.dumps({expression}))"
    return json.loads(printed(page, SCRATCH, code))


def told(page, expression, value):
    """Wait until the expression has this value in Python, which hears of a move soon after it."""
    for _ in range(20):
        found = in_python(page, expression)
        if found == value:
            return
    assert found == value


# --- alive ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", VIEWS)
def test_every_view_is_the_element_of_the_page_and_live(page, number):
    paper, view, _ = VIEWS[number]
    element = element_in(page, number)
    assert element.get_attribute("paper") == paper
    assert view is None or element.get_attribute("view") == view
    element.locator(".explorer-outcome").filter(has_text="a").wait_for()
    canvas = element.locator("canvas").first
    page.wait_for_function("canvas => canvas.width > 200", arg=canvas.element_handle())
    wait_for(element, "e.plots.every(plot => plot.sheet)")
    assert element.locator(".explorer-message:visible").count() == 0
    assert element.evaluate("e => e.explorer.host.link") is None


@pytest.mark.parametrize("number", VIEWS)
def test_a_slider_moves_drawing_and_params(page, number):
    element = element_in(page, number)
    name = VIEWS[number][2]
    slider = element.locator(f"input[type=range][id$='-{name}']")
    canvas = element.locator("canvas").first
    seen = canvas.evaluate(SAME_PICTURE)
    slider.focus()
    for _ in range(3):
        slider.press("ArrowRight")
    value = element.evaluate("(e, name) => e.explorer.s[name]", name)
    assert value != element.evaluate("(e, name) => e.explorer.defaults[name]", name)
    wait_for(element, "e.shown[values[0]] === values[1]", name, value)
    told(page, f"e{number}.params.{name}", value)
    assert in_python(page, f"type(e{number}.params).__module__").endswith(VIEWS[number][0])
    if number != 2:  # the maps of a wrong sigma move along with the axes
        page.wait_for_function(
            f"([canvas, seen]) => ({SAME_PICTURE})(canvas) !== seen",
            arg=[canvas.element_handle(), seen],
        )


@pytest.mark.parametrize("number", VIEWS)
def test_python_moves_the_element(page, number):
    element = element_in(page, number)
    name = VIEWS[number][2]
    code = f"from dataclasses import replace\ne = e{number}\n"
    write_cell(page, SCRATCH, f"{code}e.params = replace(e.params, {name}=0.5)")
    wait_for(element, "e.shown[values[0]] === 0.5", name)
    write_cell(page, SCRATCH, "e.state = {'seed': 11}")
    wait_for(element, "e.shown.seed === 11 && e.shown[values[0]] === 0.5", name)
    assert in_python(page, f"[e.state['seed'], e.params.{name}]") == [11, 0.5]
    element.get_by_role("button", name="Ulang dari awal").click()
    told(page, "e.state == e.start", True)


def test_python_is_told_what_makes_no_sense(page):
    code = "try:\n    e1.state = {}\nexcept ValueError as error:\n    print(error)"
    assert "yang diterima" in printed(page, SCRATCH, code.format("{'sigma_v': -1}"))
    assert "tidak dikenal" in printed(page, SCRATCH, code.format("{'sigma': 1}"))


def test_the_address_is_left_alone(page, lab):
    element = element_in(page, 1)
    address, length = page.evaluate("[location.href, history.length]")
    element.get_by_role("button", name="Derau baru").click()
    wait_for(element, "e.shown.seed === e.s.seed")
    assert page.evaluate("[location.href, history.length]") == [address, length]
    assert "#" not in address and element.get_by_role("button", name="tautan").count() == 0


def test_five_more_runs_leave_nothing_behind(page):
    element_in(page, 1)
    count = "sum(isinstance(widget, Explorer) for widget in _instances.values())"
    write_cell(page, SCRATCH, "from ipywidgets.widgets.widget import _instances")
    instances = in_python(page, count)
    before = len(page.workers), page.evaluate("opened.size")
    assert before[0] == len(VIEWS)  # a painter each
    for _ in range(5):
        run_cell(page, 1)
        element = element_in(page, 1)
        wait_for(element, "e.plots.every(plot => plot.sheet)")
    page.wait_for_function("n => opened.size === n", arg=before[1])
    assert len(page.workers) == before[0]
    assert in_python(page, count) == instances
    assert page.locator("kalman-explorer").count() == len(VIEWS)


def test_shown_twice_both_follow(page):
    write_cell(page, SCRATCH, "e1")
    both = [element_in(page, 1), element_in(page, SCRATCH)]
    both[0].get_by_role("button", name="Kasus 5").click()
    values = both[0].evaluate("e => [e.explorer.s.sigma_w, e.explorer.s.sigma_v]")
    condition = "e.s.sigma_w === values[0][0] && e.s.sigma_v === values[0][1]"
    wait_for(both[1], condition, values)
    assert tuple(values) == gyro.CASES[5]
    write_cell(page, SCRATCH, "e1.state = e1.start")


# --- the notebook around --------------------------------------------------------------------------


def test_dark_as_the_notebook(page):
    element = element_in(page, 1)
    canvas = element.locator("canvas").first
    light = canvas.evaluate(SAME_PICTURE)
    colour = "getComputedStyle(e.element).getPropertyValue('--explorer-estimate').trim()"
    for theme, name, estimate in (
        ("JupyterLab Dark", "dark", "#66aee8"),
        ("JupyterLab Light", "light", "#1f6fb4"),
    ):
        change = "theme => jupyterapp.commands.execute('apputils:change-theme', { theme })"
        page.evaluate(change, theme)
        wait_for(
            element,
            f"e.host.themed.dataset.theme === values[0] && {colour} === values[1]",
            name,
            estimate,
        )
        if name == "dark":
            page.wait_for_function(
                f"([canvas, light]) => ({SAME_PICTURE})(canvas) !== light",
                arg=[canvas.element_handle(), light],
            )
            ink = element.locator(".explorer-outcome").evaluate("e => getComputedStyle(e).color")
            assert min(int(part) for part in ink[4:-1].split(",")[:3]) > 150, ink


def test_the_language_of_the_notebook(notebook_in):
    for language, noise in (("en", "New noise"), ("id", "Derau baru")):
        page = notebook_in(language)
        element = element_in(page, 1)
        element.get_by_role("button", name=noise).wait_for()
        assert page.locator(".explorer-languages button:visible").count() == 0
        assert printed(page, 2, "print(e.language, e.params.sigma_w)") == f"{language} 5"
        page.close()


def test_a_notebook_in_both_languages_has_buttons(page):
    element = element_in(page, 1)
    cell = page.locator(".jp-CodeCell").nth(1)
    element.get_by_role("button", name="Kasus 6").click()
    cell.get_by_role("button", name="English").click()
    element.get_by_role("button", name="New noise").wait_for()
    assert element.evaluate("e => [e.explorer.s.sigma_w, e.explorer.s.sigma_v]") == list(
        gyro.CASES[6]
    )
    assert len(page.workers) == len(VIEWS)
    cell.get_by_role("button", name="Bahasa Indonesia").click()
    element.get_by_role("button", name="Derau baru").wait_for()


# --- what the reader brings -----------------------------------------------------------------------


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
    element = element_in(page, 4)
    z = np.array([20.5, 21.75, np.nan, 22.25])
    rows = [["waktu", "suhu"], *([k, None if np.isnan(v) else v] for k, v in enumerate(z))]
    choose_file(element, ("suhu.xlsx", xlsx(rows)))
    element.get_by_label("Kolom", exact=True).select_option("suhu")
    wait_for(element, "e.r.z.length === 4 && e.r.z[0] === 20.5 && Number.isNaN(e.r.z[2])")
    p = element.evaluate("e => [e.explorer.s.Q, e.explorer.s.R, e.explorer.s.x0, e.explorer.s.P0]")
    x = kalman_filter(smoother.model(smoother.Params(*p)), z).x[:, 0]
    assert element.evaluate("e => Array.from(e.explorer.r.result.x)") == pytest.approx(x, rel=1e-12)
    choose_file(element, ("gambar.xlsx", b"\x89PNG\0"))
    element.locator(".explorer-message").filter(has_text="gambar.xlsx").wait_for()
    assert element.evaluate("e => e.explorer.r.z.length") == 4


def test_the_workbook_comes_with_its_chart_and_notes(page, tmp_path):
    element = element_in(page, 4)
    element.locator("textarea").fill("1,5\n2,5\n3,25")
    wait_for(element, "e.r.z.length === 3")
    with page.expect_download() as download:
        element.get_by_role("button", name="Unduh Excel").click()
    assert download.value.suggested_filename == "kalman.xlsx"
    download.value.save_as(tmp_path / "kalman.xlsx")
    sheet = load_workbook(tmp_path / "kalman.xlsx").worksheets[0]
    cells = [cell for row in sheet.iter_rows(values_only=True) for cell in row]
    assert 3.25 in cells and any(str(cell).startswith("=") for cell in cells)
    assert sheet._charts


def test_R_from_a_stretch_and_the_table_of_the_form(page):
    element = element_in(page, 4)
    element.locator("textarea").fill("1,5\n2,5\n3,25\n9")
    wait_for(element, "e.r.z.length === 4")
    field = element.locator("input[id$=-entry]")
    field.fill("1-3")
    field.press("Enter")
    wait_for(element, "Math.abs(e.s.R - values[0]) < 1e-6", float(np.var([1.5, 2.5, 3.25], ddof=1)))
    for text, said in (("3-3", "kurang dari dua"), ("tiga", "nomor pertama")):
        field.fill(text)
        field.press("Enter")
        element.locator(".explorer-message").filter(has_text=said).wait_for()
    element.locator("summary").click()
    heads = element.locator(".explorer-table th[scope=col]")
    heads.nth(2).wait_for()
    assert heads.all_inner_texts()[:3] == ["No", "Terukur", "Hasil filter"]


def test_a_towing_run_in_a_workbook_with_three_columns(page):
    element = element_in(page, 6)
    t, run = ship.towing_run(np.random.default_rng(3))
    rows = [["run", "t", "v"], *([7, a, b] for a, b in zip(t, run.z[:, 0]))]
    choose_file(element, ("uji.xlsx", xlsx(rows)))
    element.locator(".explorer-message").filter(has_text="tidak bertambah").wait_for()
    element.get_by_label("Kolom kecepatan").select_option("v")
    element.get_by_label("Kolom waktu").select_option("t")
    wait_for(element, "e.r.data.truth === null")
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
    element = element_in(page, 8)
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
    from kalman_lib.recording import read_recording, rest_seconds

    r = read_recording({"phone.csv": phone_file(12)})
    expected = quadrotor.attitude(
        r.t, r.gyr, r.acc, r.mag, rest_seconds(r), quadrotor.METHODS["paper"]
    )
    apart = quadrotor.wrap(np.reshape(angles, (-1, 3)) - expected.angles)
    assert np.abs(apart).max() < 1e-9
    choose_file(element, ("moving.csv", phone_file(12, rest=0)))
    message.filter(has_text="tidak diawali keadaan diam").wait_for()
    assert element.evaluate("e => e.explorer.r.flight.T") == 240
    element.get_by_role("button", name="Kembali ke penerbangan sintetis").click()
    outcome.filter(has_text="Penerbangan sintetis").wait_for()


def test_ranges_of_python_are_those_of_the_element(page):
    table = element_in(page, 1).evaluate("e => e.explorer.controls.find(c => c.name === 'T')")
    meta = describe(gyro.Params)["T"]
    assert {name: table[name] for name in meta} == meta
