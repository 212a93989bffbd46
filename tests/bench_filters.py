"""`make bench`: how fast the filters are, beside other libraries and a C loop; _build/bench.json holds the numbers.

Every contender's result is compared with the readable loop of filters.py before it is timed. Then all of them take
turns, round after round, and the median counts. What would take minutes (filterpy on a million steps) is timed on a
part, and scaled. One move of a slider counts as one call, whatever it costs to make the call.

    tests/bench-requirements.txt    the other libraries; those that are missing are left out
    python tests/bench_filters.py [seconds per row] [words that the rows must hold]
    BENCH_CLOCK=cpu python ...  counts processor time instead of wall time, for a machine that others use, too
"""
import ctypes
import importlib
import importlib.metadata
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")      # one thread for everybody, so that ratios mean something
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1")
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

import numpy as np                                      # noqa: E402

from kalman_lib import LinearModel, fast, filters      # noqa: E402
from kalman_lib.papers import beetle, gyro             # noqa: E402

CLOCK = time.process_time if os.environ.get("BENCH_CLOCK") == "cpu" else time.perf_counter
GOAL = 1.3              # ahead of the quickest peer on every row
PEERS = ["filterpy", "pykalman", "simdkalman", "statsmodels", "dynamax"]


def load(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


LIBRARIES = {name: load(name) for name in PEERS}


@dataclass
class Contender:
    run: Callable                       # () -> x, the estimates, (T, n) or (T, n, runs)
    share: float = 1                    # the part of the work that it does


@dataclass
class Work:
    name: str
    steps: int                          # steps in all, over all runs
    reference: Callable                 # () -> x of the first steps (and runs) by the readable loop
    ours: Callable
    c: Callable
    peers: dict = field(default_factory=dict)


# --- the contenders --------------------------------------------------------------------------------------------------

def with_filterpy(model, z, share=1.0, smooth=False):
    from filterpy.kalman import KalmanFilter
    n, m = len(model.x0), len(model.H)
    rows = z[:max(3, round(share * len(z)))]
    R = model.R if model.R.ndim == 3 else [model.R] * len(rows)

    def run():
        peer = KalmanFilter(dim_x=n, dim_z=m)
        peer.F, peer.H, peer.Q, peer.R = model.F, model.H, model.Q, R[0]
        peer.x, peer.P = model.x0.copy(), model.P0.copy()
        x, P, _, _ = peer.batch_filter(rows, Rs=R[:len(rows)])
        return peer.rts_smoother(x, P)[0] if smooth else x
    return Contender(run, len(rows) / len(z))


def first_prediction(model):
    return model.F @ model.x0, model.F @ model.P0 @ model.F.T + model.Q


def with_pykalman(model, z, share=1.0, smooth=False):
    import pykalman
    mean, covariance = first_prediction(model)
    rows = z[:max(3, round(share * len(z)))]
    peer = pykalman.KalmanFilter(model.F, model.H, model.Q, model.R, initial_state_mean=mean,
                                 initial_state_covariance=covariance)
    return Contender(lambda: np.asarray((peer.smooth if smooth else peer.filter)(rows)[0]), len(rows) / len(z))


def with_simdkalman(model, z, share=1.0, smooth=False):
    import simdkalman
    mean, covariance = first_prediction(model)
    peer = simdkalman.KalmanFilter(model.F, model.Q, model.H, model.R)
    rows = z[:max(3, round(share * len(z)))]
    data = rows[:, 0].T.copy() if z.ndim == 3 else rows.T

    def run():
        answer = peer.compute(data, 0, initial_value=mean, initial_covariance=covariance, filtered=not smooth,
                              smoothed=smooth)
        x = (answer.smoothed if smooth else answer.filtered).states.mean
        return x.transpose(1, 2, 0) if z.ndim == 3 else x[0]
    return Contender(run, len(rows) / len(z))


def with_statsmodels(model, z, smooth=False):
    from statsmodels.tsa.statespace.mlemodel import MLEModel
    mean, covariance = first_prediction(model)
    n = len(mean)
    peer = MLEModel(z, k_states=n, k_posdef=n)
    peer["transition"], peer["design"], peer["selection"], peer["state_cov"] = model.F, model.H, np.eye(n), model.Q
    peer["obs_cov"] = model.R if model.R.ndim == 2 else model.R.transpose(1, 2, 0)
    peer.initialize_known(mean, covariance)
    return Contender(lambda: (peer.ssm.smooth().smoothed_state if smooth else peer.ssm.filter().filtered_state).T)


def with_dynamax(model, z, share=1.0, smooth=False):
    import jax
    import jax.numpy as jnp
    jax.config.update("jax_enable_x64", True)
    from dynamax.linear_gaussian_ssm import LinearGaussianSSM, lgssm_filter, lgssm_smoother
    mean, covariance = first_prediction(model)
    n, m = len(mean), len(model.H)
    params, _ = LinearGaussianSSM(n, m).initialize(
        jax.random.PRNGKey(0), initial_mean=jnp.array(mean), initial_covariance=jnp.array(covariance),
        dynamics_weights=jnp.array(model.F), dynamics_covariance=jnp.array(model.Q), emission_weights=jnp.array(model.H),
        emission_covariance=jnp.eye(m))
    params = params._replace(emissions=params.emissions._replace(cov=jnp.array(model.R), bias=jnp.zeros(m)),
                             dynamics=params.dynamics._replace(bias=jnp.zeros(n)))

    def one(rows):
        return lgssm_smoother(params, rows).smoothed_means if smooth else lgssm_filter(params, rows).filtered_means
    rows = z[:max(3, round(share * len(z)))]
    data = jnp.array(rows.transpose(2, 0, 1)) if z.ndim == 3 else jnp.array(rows)
    compiled = jax.jit(jax.vmap(one) if z.ndim == 3 else one)

    def run():
        x = np.asarray(compiled(data).block_until_ready())
        return x.transpose(1, 2, 0) if z.ndim == 3 else x
    return Contender(run, len(rows) / len(z))


def one_by_one(contender, model, z, runs, **options):
    """A library that takes one run: on a few of the runs, scaled."""
    parts = [contender(model, z[:, :, r], **options) for r in range(runs)]
    return Contender(lambda: np.stack([part.run() for part in parts], axis=-1), parts[0].share * runs / z.shape[2])


def beetle_filterpy(model, p, z, runs):
    from filterpy.kalman import ExtendedKalmanFilter

    class Peer(ExtendedKalmanFilter):
        def predict_x(self, u=0):
            self.F, self.x = beetle.F(self.x, p.dt), beetle.f(self.x, p.dt)

    H = np.array([[1.0, 0, 0]])

    def run():
        out = np.empty((len(z), 3, runs))
        for r in range(runs):
            peer = Peer(dim_x=3, dim_z=1)
            peer.x, peer.P, peer.Q, peer.R = model.x0, model.P0, model.Q, model.R
            for k in range(len(z)):
                peer.predict()
                peer.update(z[k, :, r], lambda x: H, lambda x: x[:1])
                out[k, :, r] = peer.x
        return out
    return Contender(run, runs / z.shape[2])


def beetle_dynamax(model, p, z):
    import jax
    import jax.numpy as jnp
    jax.config.update("jax_enable_x64", True)
    from dynamax.nonlinear_gaussian_ssm import ParamsNLGSSM, extended_kalman_filter

    def f(x):
        return jnp.array([x[0] + p.dt * x[2] * jnp.cos(x[1]), x[1], x[2]])
    x, F = model.f(model.x0, None), model.F(model.x0, None)
    params = ParamsNLGSSM(initial_mean=jnp.array(x), initial_covariance=jnp.array(F @ model.P0 @ F.T + model.Q),
                          dynamics_function=f, dynamics_covariance=jnp.array(model.Q),
                          emission_function=lambda x: x[:1], emission_covariance=jnp.array(model.R))
    data = jnp.array(z.transpose(2, 0, 1))
    compiled = jax.jit(jax.vmap(lambda rows: extended_kalman_filter(params, rows).filtered_means))
    return Contender(lambda: np.asarray(compiled(data).block_until_ready()).transpose(1, 2, 0))


# --- the C loop ------------------------------------------------------------------------------------------------------

def compile_c(folder):
    library = Path(folder) / "loop.so"
    subprocess.run([os.environ.get("CC", "cc"), "-O3", "-march=native", "-shared", "-fPIC", "-o", library,
                    ROOT / "tests" / "bench_loop.c", "-lm"], check=True)
    return ctypes.CDLL(str(library))


def address(a):
    return ctypes.c_void_p(a.ctypes.data)


def d(value):
    return ctypes.c_double(float(value))


# --- the work --------------------------------------------------------------------------------------------------------

def works(C):
    """The rows of the table, one after the other (each makes its data only when its turn comes)."""
    rng = np.random.default_rng(0)
    have = {name for name, library in LIBRARIES.items() if library}

    def peers(**makers):
        return {name: make() for name, make in makers.items() if name in have}

    def read(result, *names):
        values = [getattr(result, name) for name in names]
        return values[0]

    # one move of a slider; the peers get the series without its known drift, for not all of them take an input
    p = gyro.Params()
    flight, drift = gyro.simulate(p, rng), p.T * p.u * np.arange(1, 201)[:, np.newaxis]
    model, z0 = gyro.model(p), flight.z - drift
    x, P = np.empty((200, 1)), np.empty(200)
    Q, R = model.Q[0, 0], model.R[0, 0]

    def c():
        C.number(200, address(flight.z), d(p.T * p.u), d(Q), d(R), d(0), d(0), address(x), address(P))
        return x - drift
    c_arguments = (200, address(flight.z), d(p.T * p.u), d(Q), d(R), d(0), d(0), address(x), address(P))
    assert np.abs(c() - filters.kalman_filter(model, z0).x).max() < 1e-9
    yield Work("gyro, 1 run x 200 steps", 200, lambda: filters.kalman_filter(model, flight.z, flight.u).x,
               lambda: read(fast.kalman_filter(model, flight.z, flight.u), "x", "P"),
               lambda: (C.number(*c_arguments), x)[1],
               {name: Contender(lambda run=peer.run: run() + drift, peer.share) for name, peer in peers(
                   filterpy=lambda: with_filterpy(model, z0), pykalman=lambda: with_pykalman(model, z0),
                   simdkalman=lambda: with_simdkalman(model, z0), statsmodels=lambda: with_statsmodels(model, z0),
                   dynamax=lambda: with_dynamax(model, z0)).items()})

    number = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1)
    z = np.cumsum(0.1 * rng.normal(size=(1_000_000, 1)), axis=0) + rng.normal(size=(1_000_000, 1))
    for smooth in (False, True):
        def ours():
            result = fast.kalman_filter(number, z)
            return read(fast.rts_smooth(result) if smooth else result, "x", "P")

        def c():
            x, P = np.empty((len(z), 1)), np.empty(len(z))
            C.number(len(z), address(z), d(0), d(0.01), d(1), d(0), d(1), address(x), address(P))
            if smooth:
                C.number_rts(len(z), d(0), d(0.01), address(x), address(P))
            return x

        def reference():
            x = filters.kalman_filter(number, z[:3000])
            return filters.rts_smooth(x).x[:2000] if smooth else x.x
        yield Work("scalar series, 1,000,000 steps, " + ("filter + RTS" if smooth else "filter"), len(z),
                   reference, ours, c, peers(
                       filterpy=lambda: with_filterpy(number, z, 0.003, smooth),
                       pykalman=lambda: with_pykalman(number, z, 0.003, smooth),
                       simdkalman=lambda: with_simdkalman(number, z, 0.003, smooth),
                       statsmodels=lambda: with_statsmodels(number, z, smooth),
                       dynamax=lambda: with_dynamax(number, z, 0.2, smooth)))

    z = gyro.simulate(p, rng, runs=10_000).z
    u, drift = np.full((200, 1), p.u), drift[:, :, np.newaxis]
    z0 = np.ascontiguousarray(z - drift)

    def c():
        x = np.empty(z.shape)
        C.number_runs(200, 10_000, address(z), d(p.T * p.u), d(Q), d(R), d(0), address(x))
        return x
    yield Work("gyro Monte Carlo, 10,000 x 200", z.size,
               lambda: np.stack([filters.kalman_filter(model, z[:, :, r], u).x for r in range(5)], axis=-1),
               lambda: fast.kalman_filter(model, z, u).x, c,
               {name: Contender(lambda run=peer.run: run() + drift, peer.share) for name, peer in peers(
                   filterpy=lambda: one_by_one(with_filterpy, model, z0, 10),
                   pykalman=lambda: one_by_one(with_pykalman, model, z0, 10),
                   simdkalman=lambda: with_simdkalman(model, z0),
                   statsmodels=lambda: one_by_one(with_statsmodels, model, z0, 50),
                   dynamax=lambda: with_dynamax(model, z0)).items()})

    a, Q0, Q1 = 0.1, 1e-3, 1e-2
    two = LinearModel(F=[[1, a], [0, 1]], H=[[1, 0]], Q=np.diag([Q0, Q1]), R=1, x0=[0, 0], P0=np.eye(2))
    one = np.ones(1)
    for smooth in (False, True):
        z = rng.normal(size=(100_000, 1))

        def ours():
            result = fast.kalman_filter(two, z)
            return read(fast.rts_smooth(result) if smooth else result, "x", "P")

        def c():
            x, P = np.empty((len(z), 2)), np.empty((len(z), 3))
            C.two(len(z), 1, address(z), address(one), 0, None, d(a), d(Q0), d(Q1), d(1), d(1), address(x), address(P))
            if smooth:
                C.two_rts(len(z), 1, d(a), d(Q0), d(Q1), address(x), address(P))
            return x

        def reference():
            x = filters.kalman_filter(two, z[:3000])
            return filters.rts_smooth(x).x[:2000] if smooth else x.x
        yield Work("2-state RTS, 100,000 steps" if smooth else "2-state, 100,000 steps", len(z),
                   reference, ours, c, peers(
                       filterpy=lambda: with_filterpy(two, z, 0.03, smooth),
                       pykalman=lambda: with_pykalman(two, z, 0.03, smooth),
                       simdkalman=lambda: with_simdkalman(two, z, 0.03, smooth),
                       statsmodels=lambda: with_statsmodels(two, z, smooth),
                       dynamax=lambda: with_dynamax(two, z, 1, smooth)))

        many = rng.normal(size=(1000, 1, 1000))

        def ours_many():
            result = fast.kalman_filter(two, many)
            return (fast.smooth_runs(result) if smooth else result).x

        def c_many():
            x, P = np.empty((1000, 2, 1000)), np.empty((1000, 3))
            C.two_runs(1000, 1000, address(many), d(1), d(a), d(Q0), d(Q1), d(1), d(1), address(x), address(P))
            if smooth:
                C.two_rts(1000, 1000, d(a), d(Q0), d(Q1), address(x), address(P))
            return x

        def reference_many():
            results = [filters.kalman_filter(two, many[:, :, r]) for r in range(3)]
            return np.stack([(filters.rts_smooth(result) if smooth else result).x for result in results], axis=-1)
        yield Work("2-state RTS, 1,000 x 1,000" if smooth else "2-state, 1,000 x 1,000", many.size,
                   reference_many, ours_many, c_many, peers(
                       filterpy=lambda: one_by_one(with_filterpy, two, many, 3, smooth=smooth),
                       pykalman=lambda: one_by_one(with_pykalman, two, many, 3, smooth=smooth),
                       simdkalman=lambda: with_simdkalman(two, many, 1, smooth),
                       statsmodels=lambda: one_by_one(with_statsmodels, two, many, 20, smooth=smooth),
                       dynamax=lambda: with_dynamax(two, many, 1, smooth)))

    T, dt = 60_000, 0.01
    R = np.ascontiguousarray(1e-2 * rng.uniform(0.5, 5, size=T))
    attitude = LinearModel(F=np.kron(np.eye(3), [[1, -dt], [0, 1]]), H=np.kron(np.eye(3), [[1, 0]]),
                           Q=np.diag([1e-5, 1e-8] * 3), R=R[:, np.newaxis, np.newaxis] * np.eye(3), x0=np.zeros(6),
                           P0=0.01 * np.eye(6))
    z_a = np.cumsum(3e-3 * rng.normal(size=(T, 3)), axis=0) + 0.1 * rng.normal(size=(T, 3))

    def c():
        x, P = np.empty((T, 6)), np.empty((T, 9))
        for axis in range(3):
            C.two(T, 3, address(z_a[:, axis:]), address(R), 1, None, d(-dt), d(1e-5), d(1e-8), d(0.01), d(0.01),
                  address(x[:, 2 * axis:]), address(P[:, 3 * axis:]))
        return x
    start = attitude if T <= 500 else LinearModel(**{name: getattr(attitude, name) for name in ("F", "H", "Q", "x0", "P0")},
                                                  R=attitude.R[:2000])
    yield Work("6-state attitude, 60,000, R in time", T, lambda: filters.kalman_filter(start, z_a[:2000]).x,
               lambda: fast.kalman_filter(attitude, z_a).x, c, peers(
                   filterpy=lambda: with_filterpy(attitude, z_a, 0.05), statsmodels=lambda: with_statsmodels(attitude, z_a),
                   dynamax=lambda: with_dynamax(attitude, z_a)))

    q = beetle.Params(Q_theta=1e-3, Q_v=1e-3)
    walker = beetle.model(q)
    z_b = np.stack([beetle.simulate(q, rng, steps=500).z for _ in range(10)] * 100, axis=-1)
    z_b += 0.1 * rng.normal(size=z_b.shape)
    start_x, start_P, noise = walker.x0.copy(), np.diag(walker.P0).copy(), np.diag(walker.Q).copy()

    def c():
        x = np.empty((500, 3, 1000))
        C.beetle(500, 1000, address(z_b), d(q.dt), address(start_x), address(start_P), address(noise), d(q.R), address(x))
        return x
    yield Work("beetle EKF, 1,000 x 500", z_b.size,
               lambda: np.stack([filters.kalman_filter(walker, z_b[:, :, r]).x for r in range(3)], axis=-1),
               lambda: fast.kalman_filter(walker, z_b).x, c, peers(
                   filterpy=lambda: beetle_filterpy(walker, q, z_b, 5), dynamax=lambda: beetle_dynamax(walker, q, z_b)))


# --- measuring -------------------------------------------------------------------------------------------------------

def same(x, reference):
    """Does a result (or the part of it that was computed) agree with the readable loop? Smoothers on a part: not at its end."""
    size = tuple(min(a, b) for a, b in zip(x.shape, reference.shape))
    part = tuple(map(slice, size))
    return np.abs(x[part] - reference[part]).max() <= 1e-7 * np.abs(reference).max()


def measure(work, seconds):
    """Name -> median seconds for the whole work."""
    contenders = {"kalman_lib": Contender(work.ours), "C loop": Contender(work.c), **work.peers}
    reference = work.reference()
    for name, contender in contenders.items():
        x = contender.run()
        if "RTS" in work.name and contender.share < 1 and x.ndim == 2:
            x = x[:len(x) // 2]                 # what lies behind the part would have told its end something
        if not same(x, reference):
            raise SystemExit(f"{work.name}: {name} computes something else")
    times, end = {name: [] for name in contenders}, time.perf_counter() + seconds
    while len(times["C loop"]) < 5 or time.perf_counter() < end:
        for name, contender in contenders.items():
            if name not in ("kalman_lib", "C loop") and len(times[name]) >= 3 and sum(times[name]) > seconds / 4:
                continue                        # the slow ones have had their three turns
            begin = CLOCK()
            contender.run()
            times[name].append(CLOCK() - begin)
    return {name: statistics.median(times[name]) / contenders[name].share for name in contenders}


def python(code):
    """What a fresh interpreter prints."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT,
                          env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": ""}).stdout


def small_things():
    """Import time beyond NumPy's (ms), memory of a million steps (MB), size of the package (kB)."""
    imports = [float(python("import numpy, time; t = time.perf_counter(); import kalman_lib; print(time.perf_counter() - t)"))
               for _ in range(8)][1:]           # the first one compiles
    memory = python("""
import tracemalloc, numpy as np
from kalman_lib import LinearModel, kalman_filter, rts_smooth
model, z = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1), np.random.default_rng(0).normal(size=1_000_000)
rts_smooth(kalman_filter(model, z[:5000])).x
tracemalloc.start()
smooth = rts_smooth(kalman_filter(model, z))
x, P = smooth.x, smooth.P
print(tracemalloc.get_traced_memory()[1] / 1e6)""")
    rest = ("data", "live", "plots", "explorer.py")
    sources = [path for path in (ROOT / "kalman_lib").rglob("*.py")]
    numerics = [path for path in sources if path.relative_to(ROOT / "kalman_lib").parts[0] not in rest]
    return {"import_ms_beyond_numpy": 1000 * statistics.median(imports), "million_steps_MB": float(memory),
            "numerics_kB": sum(path.stat().st_size for path in numerics) / 1000,
            "package_kB": sum(path.stat().st_size for path in (ROOT / "kalman_lib").rglob("*.py")) / 1000}


def versions():
    found = {"python": platform.python_version(), "numpy": np.__version__}
    for name in [*PEERS, "jax"]:
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            found[name] = None
    return found


def main(seconds=3.0, *words):
    missing = [name for name, library in LIBRARIES.items() if library is None]
    print(f"{date.today()}  " + "  ".join(f"{name} {version}" for name, version in versions().items() if version))
    if missing:
        print("not installed (pip install -r tests/bench-requirements.txt):", ", ".join(missing))
    print(f"{'work':42}{'ns/step':>9}{'x best peer':>24}{'x filterpy':>14}{'x C loop':>12}   (goal: {GOAL} times the best peer)")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for work in works(compile_c(folder)):
            if words and not any(word in work.name for word in words):
                continue
            times = measure(work, float(seconds))
            ours, others = times["kalman_lib"], {name: t for name, t in times.items() if name in PEERS}
            best = min(others, key=others.get, default=None)
            ratios = (others[best] / ours if best else None, times.get("filterpy", 0) / ours or None, ours / times["C loop"])
            text = ["-" if ratio is None else f"{ratio:.4g}" for ratio in ratios]
            missed = "" if ratios[0] is None or ratios[0] >= GOAL else "  missed"
            print(f"{work.name:42}{1e9 * ours / work.steps:9.1f}{(best or '') + ' ' + text[0]:>24}{text[1]:>14}"
                  f"{text[2]:>12}{missed}", flush=True)
            rows.append({"work": work.name, "steps": work.steps, "seconds": times, "best_peer": best,
                         "ratios": dict(zip(("best_peer", "filterpy", "c"), ratios))})
    small = small_things()
    print("\n".join(f"{name:26}{value:8.1f}" for name, value in small.items()))
    target = ROOT / "_build" / "bench.json"
    target.parent.mkdir(exist_ok=True)
    target.write_text(json.dumps({"date": str(date.today()), "versions": versions(), "machine": platform.machine(),
                                  "clock": "wall" if CLOCK is time.perf_counter else "cpu",
                                  "rows": rows, **small}, indent=1) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
