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


def test_a_lost_message_does_not_lose_the_notebook(tmp_path, monkeypatch):
    """The first kernel never answers the second cell; the next one runs all of them."""
    true_client = running.client_of
    made = []

    def client_of(notebook, folder):
        client = true_client(notebook, folder)
        if not made:
            client.timeout = 2  # s; its second cell takes longer
        made.append(client)
        return client

    monkeypatch.setattr(running, "client_of", client_of)
    mark = tmp_path / "ran"
    slow = f"import pathlib, time\nran = pathlib.Path({str(mark)!r})\n"
    slow += "time.sleep(0 if ran.exists() else 60 * bool(ran.write_text('once')))\nprint(n)"
    cells = [nbformat.v4.new_code_cell(code) for code in ("n = 7", slow)]
    notebook = nbformat.v4.new_notebook(cells=cells)
    running.run(notebook, tmp_path)
    assert len(made) == 2 and notebook.cells[1].outputs[0].text == "7\n"


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
