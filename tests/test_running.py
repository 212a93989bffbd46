"""What a notebook that was run keeps of its live parts (book/_ext/running.py)."""

import base64

import conftest  # noqa: F401  (the build's own modules can be imported)
import nbformat
import pytest
import running
from texts import WIDGET_VIEW

CODE = [
    "from kalman_lib import plots\nline = {'a': ([1, 2], [1, 2])}\nplots.curve(line, 'x', 'y')",
    "from ipywidgets import interact\n\n@interact(top=(1.0, 9.0))\ndef show(top=5.0):\n"
    "    print(top)\n    return plots.curve({'a': ([1, 2], [1, top])}, 'x', 'y')",
    "plots.curve(line, 'x', 'y')",
    "from kalman_lib.explorer import explore\ne = explore('gyro')\ne",
    "e",
]


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """Of every cell: a list of outputs."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code) for code in CODE])
    running.run(notebook, tmp_path_factory.mktemp("run"))
    assert "widgets" not in notebook.metadata
    return [cell.outputs for cell in notebook.cells]


def test_a_slider_leaves_what_it_has_drawn(outputs):
    said, drawn = outputs[1]
    assert said.text == "5.0\n"
    assert base64.b64decode(drawn.data["image/png"]).startswith(b"\x89PNG")


def test_a_slider_changes_nothing_about_the_figures_after_it(outputs):
    before, after = outputs[0][0], outputs[2][0]
    assert before.data["image/png"] == after.data["image/png"]
    assert after.metadata["image/png"] == {"width": 600}


def test_an_explorer_leaves_its_picture_once_for_every_time_it_is_asked_for(outputs):
    for cell in outputs[3:]:
        (shown,) = cell
        assert set(shown.data) == {"text/html", "text/plain"}
        assert shown.data["text/html"].startswith(
            '<kalman-explorer paper="gyro"><img alt="" src="data:'
        )
    assert all(WIDGET_VIEW not in output.get("data", {}) for cell in outputs for output in cell)
