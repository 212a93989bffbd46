"""How quickly an explorer answers in JupyterLab: python tests/bench_jupyter.py (in make bench).

A real JupyterLab is started, every view is opened in a real browser, and one of its sliders is
moved: the time runs from the input event until the figure has been painted. No message goes to the
kernel for that. Beside them: how long it takes from Run to the first drawing, and ipywidgets' own
`interact` with a figure of pyplot, the usual way, whose every move goes to the kernel and back.
Medians in ms.
"""

import json
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "book" / "_ext")]

import conftest  # noqa: E402  (they lie in folders of their own)
import explorers  # noqa: E402
from jupyter_helpers import notebook, open_notebook, run_cell, running_lab  # noqa: E402

MOVES = 15
GOAL = 30  # ms from slider to drawing
VIEWS = [
    ("theory", None, "R"),
    ("smoother", None, "R"),
    ("smoother", "online", "Q"),
    ("gyro", None, "sigma_v"),
    ("gyro", "mismatch", "times_w"),
    ("ship", None, "R"),
    ("beetle", None, "R"),
    ("quadrotor", None, "m"),
]
PEER = """
import numpy as np, matplotlib.pyplot as plt
%matplotlib inline
from ipywidgets import interact
from kalman_lib import kalman_filter
from kalman_lib.papers import gyro
@interact(sigma=(1.0, 9.0))
def show(sigma=5.0):
    p = gyro.Params(sigma_v=sigma)
    flight = gyro.simulate(p, np.random.default_rng(2))
    result = kalman_filter(gyro.model(p), flight.z, flight.u)
    plt.figure(figsize=(4.8, 2.2))
    plt.plot(flight.z, "."); plt.plot(flight.x); plt.plot(result.x); plt.show()
"""
MOVE = """async ([element, name, moves]) => {
  const slider = element.querySelector(`input[type=range][id$='-${name}']`);
  const { explorer } = element;
  const times = [];
  for (let i = 0; i < moves; i++) {
    const before = explorer.r;
    slider.value = Number(slider.min) + (slider.max - slider.min) * (0.4 + 0.02 * i);
    const start = performance.now();
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    while (explorer.r === before) {
      await new Promise(requestAnimationFrame);
    }
    await explorer.painted();
    times.push(performance.now() - start);
    await new Promise(done => setTimeout(done, 150));
  }
  return times;
}"""
MOVE_PEER = """async ([cell, moves]) => {
  const handle = cell.querySelector('.noUi-handle');
  const times = [];
  for (let i = 0; i < moves; i++) {
    const image = () => cell.querySelector('.jp-OutputArea-output img')?.src;
    const before = image();
    const start = performance.now();
    const key = i < 8 ? 'Right' : 'Left';
    handle.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
    while (!image() || image() === before) {
      await new Promise(requestAnimationFrame);
    }
    times.push(performance.now() - start);
    await new Promise(done => setTimeout(done, 150));
  }
  return times;
}"""


def measure(page):
    """{what: (ms from Run to the first drawing, median ms per move)}."""
    found = {}
    run_cell(page, 0)
    for number, (paper, view, name) in enumerate(VIEWS, start=1):
        started = time.perf_counter()
        run_cell(page, number)
        element = page.locator(".jp-CodeCell").nth(number).locator("kalman-explorer.live")
        element.scroll_into_view_if_needed()
        element.evaluate("e => e.explorer.painted()")
        opened = 1000 * (time.perf_counter() - started)
        page.wait_for_timeout(1500)  # the long work of the first drawing is done
        times = page.evaluate(MOVE, [element.element_handle(), name, MOVES])
        found[" ".join(filter(None, (paper, view)))] = opened, statistics.median(times)
    last = len(VIEWS) + 1
    started = time.perf_counter()
    cell = run_cell(page, last)
    cell.locator("img").first.wait_for()
    opened = 1000 * (time.perf_counter() - started)
    times = page.evaluate(MOVE_PEER, [cell.element_handle(), MOVES])
    found["interact, pyplot"] = opened, statistics.median(times)
    return found


def main():
    explorers.for_notebooks()
    cells = ["from kalman_lib.explorer import explore"]
    cells += [f"e = explore({paper!r}, view={view!r})" for paper, view, _ in VIEWS]
    content = {"bench.ipynb": notebook(*cells, PEER)}
    with tempfile.TemporaryDirectory() as folder, running_lab(Path(folder), content) as lab:
        with conftest.browser() as chromium:
            context = chromium.new_context(viewport={"width": 1200, "height": 1600})
            found = measure(open_notebook(context, lab, "bench.ipynb"))
    print(f"{'in JupyterLab':20}{'ms to open':>12}{'ms per move':>13}")
    for name, (opened, move) in found.items():
        goal = "" if move <= GOAL or name.startswith("interact") else f"  more than {GOAL}"
        print(f"{name:20}{opened:12.0f}{move:13.1f}{goal}")
    target = ROOT / "_build"
    target.mkdir(exist_ok=True)
    (target / "bench-jupyter.json").write_text(json.dumps(found, indent=1))


if __name__ == "__main__":
    main()
