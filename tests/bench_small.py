"""What the bench measures beside speed: import time, memory, size; and the versions of it all."""

import importlib.metadata
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np
from bench_peers import PEERS

ROOT = Path(__file__).resolve().parent.parent

IMPORT = """
import numpy, time
t = time.perf_counter()
import kalman_lib
print(time.perf_counter() - t)
"""

MEMORY = """
import tracemalloc, numpy as np
from kalman_lib import LinearModel, kalman_filter, rts_smooth
model = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1)
z = np.random.default_rng(0).normal(size=1_000_000)
rts_smooth(kalman_filter(model, z[:5000])).x
tracemalloc.start()
smooth = rts_smooth(kalman_filter(model, z))
x, P = smooth.x, smooth.P
print(tracemalloc.get_traced_memory()[1] / 1e6)
"""


def number_from(code):
    """The number that a fresh interpreter prints."""
    env = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": ""}
    command = [sys.executable, "-c", code]
    run = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT, env=env)
    return float(run.stdout)


def kilobytes(paths):
    return sum(path.stat().st_size for path in paths) / 1000


def small_things():
    """Import time beyond NumPy's (ms), memory of a million steps (MB), size of the package (kB)."""
    imports = [number_from(IMPORT) for _ in range(8)][1:]  # the first one compiles
    package = list((ROOT / "kalman_lib").rglob("*.py"))
    numerics = [
        path
        for path in package
        if path.name not in ("plots.py", "widgets.py") and path.parent.name != "data"
    ]
    return {
        "import_ms_beyond_numpy": 1000 * statistics.median(imports),
        "million_steps_MB": number_from(MEMORY),
        "numerics_kB": kilobytes(numerics),
        "package_kB": kilobytes(package),
    }


def versions():
    found = {"python": platform.python_version(), "numpy": np.__version__}
    for name in [*PEERS, "jax"]:
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = None
    return found
