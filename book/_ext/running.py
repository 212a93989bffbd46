"""Runs a notebook and leaves in it nothing that only a running kernel can show.

A live explorer has a picture of its own (text/html). What a plain slider of ipywidgets has drawn
last takes the place of the slider: a figure for the book, for the printed page and for whoever
reads the notebook before running it.
"""

import copy

from nbclient import NotebookClient
from nbclient.exceptions import CellTimeoutError
from nbclient.output_widget import OutputWidget
from texts import WIDGET_VIEW


def run(notebook, folder):
    """Execute the notebook (nbformat 4) in its own folder, in place.

    Seldom a message between the kernel and us is lost, on a busy machine: the kernel has nothing to
    do, and we wait. Then it runs once more from the top, with a new kernel.
    """
    before = copy.deepcopy(notebook.cells)
    client = client_of(notebook, folder)
    try:
        client.execute()
    except CellTimeoutError:
        notebook.cells = before
        client = client_of(notebook, folder)
        client.execute()
    notebook.metadata.pop("widgets", None)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = [part for output in cell.outputs for part in still(output, client)]


def client_of(notebook, folder):
    return NotebookClient(
        notebook,
        timeout=300,
        record_timing=False,  # the cache finds a notebook by its cells and their metadata
        store_widget_state=True,
        coalesce_streams=True,
        resources={"metadata": {"path": str(folder)}},
    )


def still(output, client):
    """The outputs that stay in the place of one of them."""
    view = output.get("data", {}).pop(WIDGET_VIEW, None)
    drawn = (
        []
        if view is None or "text/html" in output["data"]
        else outputs_in(view["model_id"], client)
    )
    return drawn or [output]


def outputs_in(model, client):
    """What a widget and the widgets inside it have displayed."""
    found = client.comm_objects.get(model)
    inside = client.widget_state.get(model, {}).get("children", [])
    outputs = list(found.outputs) if isinstance(found, OutputWidget) else []
    return outputs + [
        output
        for child in inside
        for output in outputs_in(child.removeprefix("IPY_MODEL_"), client)
    ]
