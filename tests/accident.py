"""What the tests of montecarlo share: small studies, and a paper with an accident in one block.

The paper is the gyroscope of chapter 3. The accident happens only while the file `flag` exists, and
it does not depend on who computes the block, or when. Without the file the numbers are those of any
other study.
"""

import os
import signal
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from kalman_lib import mismatch_map, monte_carlo, montecarlo
from kalman_lib.papers import gyro

PARAMS = gyro.Params(duration=5)
ASSUMED = {"sigma_w": [5, 10], "sigma_v": [1, 10, 100]}
RUNS = 1200  # three blocks, the last of 200
MANY = 8 * montecarlo.BLOCK
THIS = sys.modules[__name__]


def study(executor=None, **options):
    return monte_carlo(gyro, PARAMS, RUNS, np.random.default_rng(1), executor, **options)


def chart(runs=RUNS, rng=None, **options):
    return mismatch_map(gyro, PARAMS, ASSUMED, runs, rng, **options)


def same(a, b):
    """Do two studies, or two maps, have the same bits?"""
    names = ["rmse", "nees"]
    if isinstance(a, montecarlo.MonteCarlo):
        names += ["error", "P"]
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)


def both_languages(error):
    """Is the text one sentence in English, and one in Indonesian?"""
    english, indonesian = str(error.value).split(" / ")
    return all(text.endswith(".") and "\n" not in text for text in (english, indonesian))


def with_accident(happens, flag, executor=None, block=2, **options):
    """A study of eight blocks, in one of which something happens."""
    params = Params(happens=happens, flag=str(flag), block=block)
    rng = np.random.default_rng(1)
    return monte_carlo(THIS, params, MANY, rng, executor, **options)


def quiet():
    """The numbers of with_accident where nothing happens."""
    return monte_carlo(THIS, Params(), MANY, np.random.default_rng(1))


def press():
    signal.raise_signal(signal.SIGINT)


def wait(flag):
    """Keep a worker busy: tell with a file that it has begun, and wait as long as flag exists."""
    Path(f"{flag}.begun").touch()
    while Path(flag).exists():
        time.sleep(0.01)


# --- the paper -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Params:
    sigma_w: float = 10
    sigma_v: float = 10
    happens: str = "nothing"  # a name of ACCIDENTS
    block: int = 0  # in the block of this number, or in all if it is negative
    flag: str = ""


def model(p):
    return gyro.model(_gyro(p))


def simulate(p, rng, runs=None):
    number = rng.bit_generator.seed_seq.spawn_key[-1]
    if p.block in (number, -1) and p.flag and Path(p.flag).exists():
        ACCIDENTS[p.happens](p)
    return gyro.simulate(_gyro(p), rng, runs=runs)


def _gyro(p):
    return gyro.Params(duration=5, sigma_w=p.sigma_w, sigma_v=p.sigma_v)


def _die(p):
    """The process kills itself and leaves its number in a file; only the first that comes here."""
    Path(p.flag).rename(p.flag + ".died")
    Path(p.flag + ".died").write_text(str(os.getpid()))
    os.kill(os.getpid(), signal.SIGKILL)


def _fail(p):
    raise MemoryError("no room")


def _fail_once(p):
    Path(p.flag).unlink()
    raise OSError("the worker died")


def _press(p):
    signal.raise_signal(signal.SIGINT)


def _press_in_a_worker(p):
    raise KeyboardInterrupt


ACCIDENTS = {
    "nothing": lambda p: None,
    "die": _die,
    "fail": _fail,
    "fail once": _fail_once,
    "Ctrl+C": _press,
    "Ctrl+C in a worker": _press_in_a_worker,
}
