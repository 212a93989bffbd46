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
CORE = ("models.py", "filters.py", "simulate.py", "metrics.py", "tuning.py")

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


def lines(paths):
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)


def small_things():
    """Import time beyond NumPy's (ms), memory of a million steps (MB), lines of the package."""
    imports = [number_from(IMPORT) for _ in range(8)][1:]  # the first one compiles
    package = ROOT / "kalman_lib"
    core = [package / name for name in CORE]
    return {
        "import_ms_beyond_numpy": 1000 * statistics.median(imports),
        "million_steps_MB": number_from(MEMORY),
        "core_lines": lines(core),
        "package_lines": lines(package.rglob("*.py")),
    }


def versions():
    found = {"python": platform.python_version(), "numpy": np.__version__}
    for name in [*PEERS, "jax"]:
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = None
    return found
