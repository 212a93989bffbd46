"""The C loop of the bench: bench_loop.c, compiled, and called with arrays and numbers of Python."""

import ctypes
import functools
import os
import subprocess
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).with_name("bench_loop.c")
FLAGS = ["-O3", "-march=native", "-shared", "-fPIC"]


class CLoop:
    """The functions of bench_loop.c; a float is a double, an array its address, an int an int."""

    def __init__(self, folder):
        library = Path(folder) / "loop.so"
        compiler = os.environ.get("CC", "cc")
        subprocess.run([compiler, *FLAGS, "-o", library, SOURCE, "-lm"], check=True)
        self.library = ctypes.CDLL(str(library))

    def prepared(self, name, *arguments):
        """The function with its arguments, to be called without any."""
        return functools.partial(getattr(self.library, name), *map(_in_c, arguments))

    def call(self, name, *arguments):
        self.prepared(name, *arguments)()


def _in_c(value):
    if isinstance(value, np.ndarray):
        return value.ctypes.data_as(ctypes.c_void_p)  # which keeps the array alive
    return ctypes.c_double(value) if isinstance(value, float) else value
