"""How quickly a widget answers in Jupyter: python tests/bench_widgets.py (part of make bench).

A real kernel is started, every chapter's widget is made in it, and the browser's message "this slider has moved" is sent
to it; the time runs until the kernel has sent its last output. Beside them in the same rounds: ipywidgets' own `interact`
with a fresh figure of pyplot, the usual way. Medians in ms.
"""
import json
import statistics
import time
from pathlib import Path

from jupyter_client.manager import start_new_kernel

MOVES = 15
PEER = """
import numpy as np, matplotlib.pyplot as plt
%matplotlib inline
from ipywidgets import FloatSlider, interactive
from kalman_lib import kalman_filter
from kalman_lib.papers import gyro
from dataclasses import replace
def show(sigma):
    p = gyro.Params(sigma_v=sigma)
    flight = gyro.simulate(p, np.random.default_rng(2))
    result = kalman_filter(gyro.model(p), flight.z, flight.u)
    fig, ax = plt.subplots(figsize=(4.8, 2.2))
    ax.plot(flight.z, "."); ax.plot(flight.x); ax.plot(result.x); plt.show()
board = interactive(show, sigma=FloatSlider(5, min=1, max=9)); display(board); part = board.children[0]
"""
WIDGETS = {     # chapter -> what makes the board, the part that is moved, its values
    "1 theory": ("widgets.TheorySteps()", "board.moment", [1, 2, 3, 4]),
    "2 smoother": ("widgets.SmootherForm()", "board.R", ["1e-5", "1e-4", "1e-3"]),
    "3 gyro": ("widgets.GyroFlight()", "board.sigma_v", ["2", "3", "5", "7"]),
    "3 its map": ("widgets.GyroMismatch()", "board.sigma_w", ["2", "5", "20", "50"]),
    "4 ship": ("widgets.ShipRun()", "board.R", ["0.01", "0.02", "0.1"]),
    "5 beetle": ("widgets.Beetle()", "board.R", ["0.05", "0.08", "0.1"]),
    "6 quadrotor": ("widgets.Quadrotor()", "board.m", ["0.16", "1", "10"]),
    "6 its craft": ("widgets.Quadrotor()", "board.moment", [20.0, 40.0, 60.0]),
    "interact": (None, "part", [2.0, 4.0, 6.0, 8.0]),
}


def run(client, code):
    """Run code in the kernel and return what it printed."""
    said = []
    reply = client.execute_interactive(code, timeout=120, output_hook=lambda message: said.append(message["content"].get("text", "")))
    assert reply["content"]["status"] == "ok", reply["content"]
    return "".join(said)


def move(client, comm, value):
    """Seconds from the message of the slider to the kernel's word that all is done."""
    content = {"comm_id": comm, "data": {"method": "update", "state": {"value": value}, "buffer_paths": []}}
    message = client.session.msg("comm_msg", content)
    started = time.perf_counter()
    client.shell_channel.send(message)
    while True:
        answer = client.get_iopub_msg(timeout=60)
        if answer["parent_header"].get("msg_id") == message["header"]["msg_id"] and answer["msg_type"] == "status" \
                and answer["content"]["execution_state"] == "idle":
            return time.perf_counter() - started


def main():
    manager, client = start_new_kernel(kernel_name="python3")
    try:
        run(client, "from kalman_lib import widgets\nboards = []")
        comms = {}
        for name, (make, part, _) in WIDGETS.items():
            code = PEER if make is None else f"board = {make}\ndisplay(board.view)"
            comms[name] = run(client, f"{code}\nboards.append(board)\nprint('comm', {part}.model_id)").split("comm ")[-1].strip()
        times = {name: [] for name in WIDGETS}
        for k in range(MOVES + 3):
            for name, (_, _, values) in WIDGETS.items():
                seconds = move(client, comms[name], values[k % len(values)])
                if k >= 3:
                    times[name].append(1000 * seconds)
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    medians = {name: statistics.median(values) for name, values in times.items()}
    print(f"{'widget in Jupyter':20}{'ms per move':>12}{'interact takes':>16}")
    for name, value in medians.items():
        print(f"{name:20}{value:12.1f}{medians['interact'] / value:15.1f}x")
    target = Path(__file__).resolve().parent.parent / "_build"
    target.mkdir(exist_ok=True)
    (target / "bench-widgets.json").write_text(json.dumps(medians, indent=1))


if __name__ == "__main__":
    main()
