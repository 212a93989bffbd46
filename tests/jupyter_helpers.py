"""A JupyterLab of the tests' own: it touches nothing of the user's and reaches nothing outside."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import time
import urllib.request

from conftest import PATIENCE, ROOT

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
TOKEN = "book"
KERNEL = {"name": "python3", "display_name": "Python 3", "language": "python"}
OWN_FOLDERS = (
    "JUPYTER_CONFIG_DIR",
    "JUPYTER_DATA_DIR",
    "JUPYTER_RUNTIME_DIR",
    "IPYTHONDIR",
    "JUPYTERLAB_SETTINGS_DIR",
    "JUPYTERLAB_WORKSPACES_DIR",
)


def notebook(*cells):
    """A notebook of code cells; a pair (tag, text) is a cell of prose."""
    made = []
    for k, cell in enumerate(cells):
        if isinstance(cell, tuple):
            tag, text = cell
            more = {"cell_type": "markdown", "metadata": {"tags": [tag]}, "source": text}
        else:
            more = {"cell_type": "code", "metadata": {}, "source": cell, "outputs": []}
            more["execution_count"] = None
        made.append({"id": f"cell{k}", **more})
    return {
        "cells": made,
        "metadata": {"kernelspec": KERNEL},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


@contextlib.contextmanager
def running_lab(folder, notebooks):
    """The address of a JupyterLab that offers these notebooks: {name: notebook}."""
    work = folder / "work"
    work.mkdir()
    for name, content in notebooks.items():
        (work / name).write_text(json.dumps(content), encoding="utf-8")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    own = {name: str(folder / name) for name in OWN_FOLDERS}
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ip=127.0.0.1"]
    command += [f"--port={port}", "--ServerApp.port_retries=0", f"--IdentityProvider.token={TOKEN}"]
    command += [f"--ServerApp.root_dir={work}", "--LabApp.news_url=None", "--expose-app-in-browser"]
    command += ["--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    with open(folder / "log", "w") as log:
        server = subprocess.Popen(
            command,
            env={**os.environ, **own, "PYTHONPATH": str(ROOT)},
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    address = f"http://127.0.0.1:{port}"
    try:
        wait_for(f"{address}/api/status?token={TOKEN}", server, folder / "log")
        yield address
    finally:
        server.terminate()
        server.wait(30)


def wait_for(address, server, log):
    until = time.monotonic() + PATIENCE / 1000
    while True:
        try:
            urllib.request.urlopen(address, timeout=5).close()
            return
        except OSError:
            assert server.poll() is None and time.monotonic() < until, log.read_text()[-2000:]
            time.sleep(0.1)


def open_notebook(context, lab, name):
    """A page with this notebook, its kernel idle."""
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.goto(f"{lab}/lab/tree/{name}?token={TOKEN}&reset")
    page.get_by_text("| Idle").wait_for()
    return page


def run_cell(page, number):
    """Run one cell of the notebook and wait until the kernel has nothing more to do."""
    cell = page.locator(".jp-CodeCell").nth(number)
    before = cell.locator(".jp-InputArea-prompt").first.inner_text()
    cell.locator(".cm-content").click()
    page.keyboard.press("Control+Enter")
    page.wait_for_function(
        """([cell, before]) => {
          const prompt = cell.querySelector('.jp-InputArea-prompt').innerText;
          return prompt !== before && /\\[\\d+\\]/.test(prompt);
        }""",
        arg=[cell.element_handle(), before],
    )
    return cell


def write_cell(page, number, code):
    """Replace the code of a cell and run it."""
    editor = page.locator(".jp-CodeCell").nth(number).locator(".cm-content")
    editor.fill(code)
    return run_cell(page, number)


def printed(page, number, code):
    """What a cell prints when it runs this code; it must print something."""
    cell = write_cell(page, number, code)
    return cell.locator(".jp-OutputArea-output").last.inner_text().strip()


@contextlib.contextmanager
def window(chromium, lab, **options):
    """A window of the browser in which no request leaves the machine."""
    context = chromium.new_context(viewport={"width": 1200, "height": 2400}, **options)
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


def element_in(page, number):
    """The explorer below a cell, alive and in sight, also after another page was opened."""
    page.bring_to_front()
    element = page.locator(".jp-CodeCell").nth(number).locator("kalman-explorer.live")
    element.wait_for()
    element.scroll_into_view_if_needed()
    page.wait_for_function("e => e.explorer.r !== undefined", arg=element.element_handle())
    return element


def wait_until(element, condition, *values):
    """Until the condition on the explorer e holds."""
    element.page.wait_for_function(
        f"([element, ...values]) => {{ const e = element.explorer; return {condition}; }}",
        arg=[element.element_handle(), *values],
    )


def in_python(page, number, expression):
    """The value of an expression in the kernel, computed by a cell that is there for it."""
    code = f"import json\nprint(json.dumps({expression}))"
    return json.loads(printed(page, number, code))


def told(page, number, expression, value):
    """Wait until the expression has this value in Python, which hears of a move soon after it."""
    for _ in range(20):
        found = in_python(page, number, expression)
        if found == value:
            return
    assert found == value
