"""The explorers in a real JupyterLab, in a real browser, used as a reader uses them."""

import explorers as explorers_to_bundle
import pytest
from conftest import listen
from jupyter_helpers import (
    SAME_PICTURE,
    element_in,
    in_python,
    notebook,
    open_notebook,
    printed,
    run_cell,
    running_lab,
    told,
    wait_until,
    window,
    write_cell,
)

from kalman_lib.papers import describe, gyro

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
    9: ("quadrotor", "tilt", "bias"),
    10: ("ship", "poles", "a1"),
    11: ("ship", "noise", "sigma"),
    12: ("beetle", "banana", "theta0"),
    13: ("workshop", None, "R"),
}
SCRATCH = len(VIEWS) + 1  # a cell for whatever a test wants to know from Python
CODE = [f"e{k} = explore({paper!r}, view={view!r})" for k, (paper, view, _) in VIEWS.items()]
PROSE = {"id": ("lang-id", "Halo."), "en": ("lang-en", "Hello.")}


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
    with window(chromium, lab) as context:
        yield context


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
    wait_until(element, "e.plots.every(plot => plot.sheet)")
    assert element.locator(".explorer-message:visible").count() == 0
    assert element.evaluate("e => e.explorer.host.link") is None


def test_figure_and_sliders_stand_beside_each_other_where_the_cell_is_wide(page):
    element = element_in(page, 1)
    places = """e => [e.explorer.first, e.explorer.side].map(part => {
      const { left, right, top, bottom } = part.getBoundingClientRect();
      return { left, right, top, bottom };
    })"""
    figures, side = element.evaluate(places)
    assert side["left"] >= figures["right"]
    element.evaluate("e => { e.style.width = '400px' }")  # the cell gets narrow, not the window
    page.wait_for_function(
        "e => e.explorer.side.getBoundingClientRect().left < 200 + e.getBoundingClientRect().left",
        arg=element.element_handle(),
    )
    figures, side = element.evaluate(places)
    assert side["top"] >= figures["bottom"]
    element.evaluate("e => { e.style.width = '' }")


@pytest.mark.parametrize("number", VIEWS)
def test_a_slider_moves_drawing_and_params(page, number):
    element = element_in(page, number)
    name = VIEWS[number][2]
    slider = element.locator(f"input[type=range][id$='-{name}']")
    canvases = [canvas.element_handle() for canvas in element.locator("canvas").all()]
    seen = [canvas.evaluate(SAME_PICTURE) for canvas in canvases]
    slider.focus()
    for _ in range(3):
        slider.press("ArrowRight")
    value = element.evaluate("(e, name) => e.explorer.s[name]", name)
    assert value != element.evaluate("(e, name) => e.explorer.defaults[name]", name)
    wait_until(element, "e.shown[values[0]] === values[1]", name, value)
    told(page, SCRATCH, f"e{number}.params.{name}", value)
    module = in_python(page, SCRATCH, f"type(e{number}.params).__module__")
    assert module.startswith(f"kalman_lib.papers.{VIEWS[number][0]}")
    if number != 2:  # the maps of a wrong sigma move along with the axes
        page.wait_for_function(
            f"([canvases, seen]) => canvases.some((c, i) => ({SAME_PICTURE})(c) !== seen[i])",
            arg=[canvases, seen],
        )


@pytest.mark.parametrize("number", VIEWS)
def test_python_moves_the_element(page, number):
    element = element_in(page, number)
    name = VIEWS[number][2]
    code = f"from dataclasses import replace\ne = e{number}\n"
    write_cell(page, SCRATCH, f"{code}e.params = replace(e.params, {name}=0.5)")
    wait_until(element, "e.shown[values[0]] === 0.5", name)
    write_cell(page, SCRATCH, "e.state = {'seed': 11}")
    wait_until(element, "e.shown.seed === 11 && e.shown[values[0]] === 0.5", name)
    assert in_python(page, SCRATCH, f"[e.state['seed'], e.params.{name}]") == [11, 0.5]
    element.get_by_role("button", name="Ulang dari awal").click()
    told(page, SCRATCH, "e.state == e.start", True)


def test_python_is_told_what_makes_no_sense(page):
    code = "try:\n    e1.state = {}\nexcept ValueError as error:\n    print(error)"
    assert "yang diterima" in printed(page, SCRATCH, code.format("{'sigma_v': -1}"))
    assert "tidak dikenal" in printed(page, SCRATCH, code.format("{'sigma': 1}"))


def test_the_address_is_left_alone(page, lab):
    element = element_in(page, 1)
    address, length = page.evaluate("[location.href, history.length]")
    element.get_by_role("button", name="Derau baru").click()
    wait_until(element, "e.shown.seed === e.s.seed")
    assert page.evaluate("[location.href, history.length]") == [address, length]
    assert "#" not in address and element.get_by_role("button", name="tautan").count() == 0


def test_five_more_runs_leave_nothing_behind(page):
    element_in(page, 1)
    count = "sum(isinstance(widget, Explorer) for widget in _instances.values())"
    write_cell(page, SCRATCH, "from ipywidgets.widgets.widget import _instances")
    instances = in_python(page, SCRATCH, count)
    before = len(page.workers), page.evaluate("opened.size")
    assert before[0] == len(VIEWS)  # a painter each
    for _ in range(5):
        run_cell(page, 1)
        element = element_in(page, 1)
        wait_until(element, "e.plots.every(plot => plot.sheet)")
    page.wait_for_function("n => opened.size === n", arg=before[1])
    assert len(page.workers) == before[0]
    assert in_python(page, SCRATCH, count) == instances
    assert page.locator("kalman-explorer").count() == len(VIEWS)


def test_shown_twice_both_follow(page):
    write_cell(page, SCRATCH, "e1")
    both = [element_in(page, 1), element_in(page, SCRATCH)]
    both[0].get_by_role("button", name="Kasus 5").click()
    values = both[0].evaluate("e => [e.explorer.s.sigma_w, e.explorer.s.sigma_v]")
    condition = "e.s.sigma_w === values[0][0] && e.s.sigma_v === values[0][1]"
    wait_until(both[1], condition, values)
    assert tuple(values) == gyro.CASES[5]
    write_cell(page, SCRATCH, "e1.state = e1.start")


# --- the notebook around --------------------------------------------------------------------------


def test_the_arrows_belong_to_the_slider_also_in_notebook_7(page):
    """Notebook 7 hears every key first; it is JupyterLab's own method that listens there."""
    element = element_in(page, 1)
    listening = "jupyterapp.commands.processKeydownEvent(event)"
    page.evaluate(f"""() => {{
      window.asNotebook7 = event => {listening};
      document.addEventListener('keydown', asNotebook7, true);
    }}""")
    slider = element.locator("input[type=range]").first
    value = slider.input_value()
    slider.press("ArrowRight")
    page.evaluate("document.removeEventListener('keydown', asNotebook7, true)")
    assert float(slider.input_value()) > float(value)
    write_cell(page, SCRATCH, "e1.state = e1.start")


def test_dark_as_the_notebook(page):
    run_cell(page, 1)  # the explorer that stood here first is gone; the others follow all the same
    element_in(page, 1)
    element = element_in(page, 4)
    canvas = element.locator("canvas").first
    light = canvas.evaluate(SAME_PICTURE)
    colour = "getComputedStyle(e.element).getPropertyValue('--explorer-estimate').trim()"
    for theme, name, estimate in (
        ("JupyterLab Dark", "dark", "#66aee8"),
        ("JupyterLab Light", "light", "#1f6fb4"),
    ):
        change = "theme => jupyterapp.commands.execute('apputils:change-theme', { theme })"
        page.evaluate(change, theme)
        wait_until(
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


def test_ranges_of_python_are_those_of_the_element(page):
    table = element_in(page, 1).evaluate("e => e.explorer.controls.find(c => c.name === 'T')")
    meta = describe(gyro.Params)["T"]
    assert {name: table[name] for name in meta} == meta
