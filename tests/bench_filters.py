"""`make bench`: how fast the filters are, beside other libraries and a C loop.

_build/bench.json holds the numbers. Every contender's result is compared with the readable loop of
filters.py before it is timed. Then all of them take turns, round after round, and the median
counts. What would take minutes (filterpy on a million steps) is timed on a part, and scaled. One
move of a slider counts as one call, whatever it costs to make the call.

    tests/bench-requirements.txt    the other libraries; those that are missing are left out
    python tests/bench_filters.py [seconds per row] [words that the rows must hold]
    BENCH_CLOCK=cpu python ...      counts processor time instead of wall time, for a machine that
                                    others use, too
"""

import json
import os
import platform
import statistics
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

# one thread for everybody, so that ratios mean something
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
ONE_THREAD = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ.setdefault("XLA_FLAGS", ONE_THREAD)
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

import numpy as np  # noqa: E402
from bench_c import CLoop  # noqa: E402
from bench_peers import LIBRARIES, PEERS, Contender  # noqa: E402
from bench_rows import works  # noqa: E402
from bench_small import small_things, versions  # noqa: E402

CLOCK = time.process_time if os.environ.get("BENCH_CLOCK") == "cpu" else time.perf_counter
GOAL = 1.3  # ahead of the quickest peer on every row


def same(x, reference):
    """Does a result (or the part of it that was computed) agree with the readable loop?

    Smoothers on a part: not at its end.
    """
    size = tuple(min(a, b) for a, b in zip(x.shape, reference.shape))
    part = tuple(map(slice, size))
    return np.abs(x[part] - reference[part]).max() <= 1e-7 * np.abs(reference).max()


def check(work, contenders):
    """SystemExit unless all of them compute what the readable loop does."""
    reference = work.reference()
    for name, contender in contenders.items():
        x = contender.run()
        if "RTS" in work.name and contender.share < 1 and x.ndim == 2:
            x = x[: len(x) // 2]  # what lies behind the part would have told its end something
        if not same(x, reference):
            raise SystemExit(f"{work.name}: {name} computes something else")


def measure(work, seconds):
    """Name -> median seconds for the whole work."""
    ours = {"kalman_lib": Contender(work.ours), "C loop": Contender(work.c)}
    contenders = {**ours, **work.peers}
    check(work, contenders)
    times = {name: [] for name in contenders}
    end = time.perf_counter() + seconds
    while len(times["C loop"]) < 5 or time.perf_counter() < end:
        for name, contender in contenders.items():
            had_three_turns = len(times[name]) >= 3 and sum(times[name]) > seconds / 4
            if name not in ours and had_three_turns:
                continue  # one of the slow ones
            begin = CLOCK()
            contender.run()
            times[name].append(CLOCK() - begin)
    return {name: statistics.median(times[name]) / contenders[name].share for name in contenders}


def row_of(work, times):
    """What bench.json holds of a row, and its line in the table."""
    ours = times["kalman_lib"]
    others = {name: seconds for name, seconds in times.items() if name in PEERS}
    best = min(others, key=others.get, default=None)
    ratios = {
        "best_peer": others[best] / ours if best else None,
        "filterpy": times.get("filterpy", 0) / ours or None,
        "c": ours / times["C loop"],
    }
    ahead, filterpy, c = ["-" if r is None else f"{r:.4g}" for r in ratios.values()]
    missed = "" if best is None or ratios["best_peer"] >= GOAL else "  missed"
    line = f"{work.name:42}{1e9 * ours / work.steps:9.1f}{(best or '') + ' ' + ahead:>24}"
    line += f"{filterpy:>14}{c:>12}{missed}"
    facts = {"work": work.name, "steps": work.steps, "seconds": times, "best_peer": best}
    return facts | {"ratios": ratios}, line


def print_head():
    there = [f"{name} {version}" for name, version in versions().items() if version]
    print(f"{date.today()}  " + "  ".join(there))
    missing = [name for name, library in LIBRARIES.items() if library is None]
    if missing:
        print("not installed (pip install -r tests/bench-requirements.txt):", ", ".join(missing))
    columns = f"{'work':42}{'ns/step':>9}{'x best peer':>24}{'x filterpy':>14}{'x C loop':>12}"
    print(f"{columns}   (goal: {GOAL} times the best peer)")


def main(seconds=3.0, *words):
    print_head()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for work in works(CLoop(folder)):
            if words and not any(word in work.name for word in words):
                continue
            row, line = row_of(work, measure(work, float(seconds)))
            print(line, flush=True)
            rows.append(row)
    small = small_things()
    print("\n".join(f"{name:26}{value:8.1f}" for name, value in small.items()))
    facts = {
        "date": str(date.today()),
        "versions": versions(),
        "machine": platform.machine(),
        "clock": "wall" if CLOCK is time.perf_counter else "cpu",
        "rows": rows,
        **small,
    }
    target = ROOT / "_build" / "bench.json"
    target.parent.mkdir(exist_ok=True)
    target.write_text(json.dumps(facts, indent=1) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
