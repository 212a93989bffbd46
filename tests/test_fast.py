"""The fast forms against the readable loop of filters.py: equal to 1e-12, whatever the model, the data and the ratio Q / R."""
import pickle
import subprocess
import sys
from dataclasses import fields, replace
from fractions import Fraction

import numpy as np
import pytest

from kalman_lib import LinearModel, NonlinearModel, fast, filters
from kalman_lib.fast.lazy import LazyFilterResult, LazySmootherResult
from kalman_lib.papers import beetle, gyro
from kalman_lib.simulate import simulate

FIELDS = [field.name for field in fields(filters.FilterResult)]


def covariance(rng, size):
    A = rng.normal(size=(size, size))
    return A @ A.T + 0.1 * np.eye(size)


def random_model(rng, n, m, l=0, Q=1.0, R=1.0, P0=1.0, radius=0.98, R_in_time=None):
    F = rng.normal(size=(n, n))
    F *= rng.uniform(0.3, 1) * radius / np.abs(np.linalg.eigvals(F)).max()
    H = np.eye(m, n) if rng.random() < 0.5 else rng.normal(size=(m, n))
    R = R * covariance(rng, m)
    if R_in_time:
        R = R * rng.uniform(0.2, 5, size=(R_in_time, 1, 1))
    return LinearModel(F=F, H=H, Q=Q * covariance(rng, n), R=R, x0=rng.normal(size=n), P0=P0 * covariance(rng, n),
                       B=rng.normal(size=(n, l)) if l else None)


def close(ours, loop, tolerance=1e-12):
    """Equal relative to the largest value of each column (state, sensor, entry) over time; NaN at the same places."""
    ours, loop = np.asarray(ours, dtype=float), np.asarray(loop, dtype=float)
    assert ours.shape == loop.shape and np.array_equal(np.isnan(ours), np.isnan(loop))
    error, scale = np.nanmax(np.abs(ours - loop), axis=0), np.nanmax(np.abs(loop), axis=0)
    assert (error <= tolerance * np.maximum(scale, 1e-6 * scale.max())).all()


def same_filter(model, z, u=None):
    """Compare all fields of the fast and the readable filter -> both results."""
    ours, loop = fast.kalman_filter(model, z, u), filters.kalman_filter(model, z, u)
    for name in ("x_pred", "x", "y"):
        close(getattr(ours, name), getattr(loop, name))
    for name in ("F", "H", "Q", "R", "start", "gated"):
        assert np.array_equal(getattr(ours, name), getattr(loop, name))
    # a gain is at most sigma / sqrt(S)
    largest = np.sqrt(np.einsum("kii->ki", loop.P_pred)[:, :, np.newaxis] / np.einsum("kii->ki", loop.S)[:, np.newaxis])
    assert (np.abs(ours.K - loop.K) <= 1e-12 * largest + 1e-300).all()
    # P is what is left of P_pred, also in rounding; of a huge ratio Q / R the loop itself keeps no more digits
    for name, scale in (("P_pred", loop.P_pred), ("S", loop.S), ("P", loop.P_pred)):
        sigma = np.sqrt(np.einsum("kii->ki", scale))
        error = np.abs(getattr(ours, name) - getattr(loop, name))
        assert (error <= 1e-12 * sigma[:, :, np.newaxis] * sigma[:, np.newaxis] + 1e-300).all()
    assert np.array_equal(ours.P, ours.P.swapaxes(1, 2))
    return ours, loop


def same_smoother(ours, loop):
    ours, loop = fast.rts_smooth(ours), filters.rts_smooth(loop)
    close(ours.x, loop.x)
    sigma = np.sqrt(np.einsum("kii->ki", loop.P))
    assert (np.abs(ours.P - loop.P) <= 1e-12 * sigma[:, :, np.newaxis] * sigma[:, np.newaxis] + 1e-300).all()


# --- one run ---------------------------------------------------------------------------------------------------------

CASES = [(seed, steps) for steps, seeds in ((49, 3), (50, 12), (300, 12), (2600, 4)) for seed in range(seeds)]


@pytest.mark.parametrize("seed, steps", CASES)
def test_random_models(seed, steps):
    rng = np.random.default_rng(seed)
    n, m, l = (1, 1, seed % 3) if seed % 4 == 0 else (rng.integers(1, 5), rng.integers(1, 4), rng.integers(0, 3))
    model = random_model(rng, n, m, l)
    u = rng.normal(size=(steps, l)) if l else None
    same_smoother(*same_filter(model, simulate(model, steps, rng, u).z, u))


@pytest.mark.parametrize("seed, steps", [(seed, steps) for steps, seeds in ((60, 12), (2600, 5)) for seed in range(seeds)])
def test_missing_measurements_and_R_that_changes_in_time(seed, steps):
    rng = np.random.default_rng(100 + seed)
    n, m, l = (1, 1, 0) if seed % 4 == 0 else (rng.integers(1, 4), rng.integers(1, 3), rng.integers(0, 3))
    model = random_model(rng, n, m, l, R_in_time=steps if seed % 3 else None)
    u = rng.normal(size=(steps, l)) if l else None
    z = simulate(model, steps, rng, u).z
    if seed % 3 != 1:
        z[rng.random(z.shape) < 0.1] = np.nan
        z[20:30] = z[-3:] = np.nan
    same_smoother(*same_filter(model, z, u))


@pytest.mark.parametrize("exponent", [-30, -20, -10, -3, 3, 10, 20, 30])
@pytest.mark.parametrize("seed", range(6))
def test_extreme_ratios_of_Q_and_R(seed, exponent):
    rng = np.random.default_rng(seed)
    n, steps = 1 + seed // 2, 600 if seed % 2 else 200
    model = random_model(rng, n, int(rng.integers(1, n + 1)), Q=10.0 ** (exponent / 2), R=10.0 ** (-exponent / 2),
                         P0=rng.choice([0, 1, 10.0 ** (exponent / 2)]))
    z = 10 * rng.normal(size=(steps, len(model.H)))
    ours, loop = same_filter(model, z)
    if n == 1 and exponent < 10:                # beyond, the loop's own P has less than 12 digits (see the fractions)
        same_smoother(ours, loop)
    z[::7] = np.nan
    same_filter(model, z)


@pytest.mark.parametrize("Q, R", [(1e-30, 1), (1, 1e-30), (1e-18, 1), (1, 1e-18), (1e30, 1), (0, 1), (1e-3, 1)])
@pytest.mark.parametrize("F, H", [(1, 1), (0.9, 3.7), (1.1, 0.3)])
def test_the_variance_of_one_number_against_exact_fractions(F, H, Q, R):
    """Where R is tiny even Joseph's form has few digits; P_pred R / S has them all."""
    model, steps = LinearModel(F=F, H=H, Q=Q, R=R, x0=0, P0=1), 60
    result = fast.kalman_filter(model, np.ones(steps))
    F, H, Q, R, P = (Fraction(float(value)) for value in (F, H, Q, R, 1))
    for k in range(steps):
        P_pred = F * P * F + Q
        K = P_pred * H / (H * P_pred * H + R)
        P = (1 - K * H) * P_pred
        assert result.P[k, 0, 0] == pytest.approx(float(P), rel=1e-12)
        assert result.K[k, 0, 0] == pytest.approx(float(K), rel=1e-12)
        P = Fraction(round(P * 2**400), 2**400)             # 100 digits are enough


@pytest.mark.parametrize("Q", [0, 1e-12, 1e-6])
@pytest.mark.parametrize("gaps", [False, True])
def test_a_memory_longer_than_any_block(Q, gaps):
    rng = np.random.default_rng(3)
    z = np.cumsum(rng.normal(size=9000)) * 1e-3 + rng.normal(size=9000)
    if gaps:
        z[rng.random(9000) < 0.2] = np.nan
    same_filter(LinearModel(F=1, H=1, Q=Q, R=1, x0=0, P0=1e6), z)
    same_filter(LinearModel(F=[[1, 0.1], [0, 1]], H=[[1, 0]], Q=Q * np.eye(2), R=1, x0=[0, 0], P0=np.eye(2)), z)


@pytest.mark.parametrize("F", [1.5, -1, [[0.999, 0.04], [-0.04, 0.999]], [[1, 1], [0, 1.01]], [[0, 1], [0, 0]]])
@pytest.mark.parametrize("P0", [0, 1])
def test_unstable_marginal_and_dead_beat_models(F, P0):
    n = np.size(F[0]) if np.ndim(F) else 1
    rng = np.random.default_rng(4)
    for Q in (0, 1e-2):
        model = LinearModel(F=F, H=np.eye(1, n), Q=Q * np.eye(n), R=1, x0=np.ones(n), P0=P0 * np.eye(n))
        same_filter(model, rng.normal(size=300))
        if n > 1 or F == -1:
            same_filter(model, rng.normal(size=2500))
    blind = LinearModel(F=F, H=np.zeros((1, n)), Q=np.eye(n), R=1, x0=np.ones(n), P0=P0 * np.eye(n))
    same_filter(blind, rng.normal(size=200))


def attitude(rng, steps, R_in_time=True, same=True):
    """Three axes of angle and gyroscope bias, which nothing links."""
    dt, scale = 0.01, np.ones(3) if same else np.array([1, 3, 0.2])
    R = 1e-2 * rng.uniform(0.5, 5, size=(steps, 1, 1)) * np.eye(3) if R_in_time else 1e-2 * np.eye(3)
    return LinearModel(F=np.kron(np.eye(3), [[1, -dt], [0, 1]]), B=np.kron(np.eye(3), [[dt], [0]]),
                       H=np.kron(np.eye(3), [[1, 0]]), Q=np.kron(np.diag(scale), np.diag([1e-5, 1e-8])), R=R,
                       x0=np.zeros(6), P0=0.01 * np.eye(6))


@pytest.mark.parametrize("R_in_time", [True, False])
@pytest.mark.parametrize("same", [True, False])
@pytest.mark.parametrize("gaps", [True, False])
def test_independent_axes(R_in_time, same, gaps):
    rng = np.random.default_rng(5)
    model = attitude(rng, 3000, R_in_time, same)
    z, u = 0.1 * rng.normal(size=(2, 3000, 3))
    if gaps:
        z[rng.random(3000) < 0.1, 1] = np.nan           # one NaN and no axis has a measurement
    ours, loop = same_filter(model, z, u)
    assert (ours.P[:, :2, 2:] == 0).all()


def test_axes_of_different_size_and_a_state_without_a_sensor():
    rng = np.random.default_rng(6)
    A, B = random_model(rng, 2, 1), random_model(rng, 1, 1)
    F, Q, P0 = (np.zeros((4, 4)) for _ in range(3))
    for name, M in (("F", F), ("Q", Q), ("P0", P0)):
        M[np.ix_([0, 2], [0, 2])], M[1, 1], M[3, 3] = getattr(A, name), getattr(B, name)[0, 0], 0.5
    H = np.zeros((2, 4))
    H[0, [0, 2]], H[1, 1] = A.H[0], B.H[0, 0]
    model = LinearModel(F=F, H=H, Q=Q, R=np.diag([A.R[0, 0], B.R[0, 0]]), x0=np.ones(4), P0=P0)
    for steps in (100, 2500):
        z = rng.normal(size=(steps, 2))
        same_smoother(*same_filter(model, z))
        z[5:9, 0] = np.nan
        same_filter(model, z)


# --- adversaries -----------------------------------------------------------------------------------------------------

FAMILIES = ["plain", "vague start", "offset data", "slow modes", "Q = 0", "tiny R", "singular P0", "constant velocity"]


def adversary(family, rng):
    """A model that costs digits, and how far its data lie from zero."""
    n, m = int(rng.integers(1, 5)), int(rng.integers(1, 3))
    model = random_model(rng, n, min(n, m), radius=1)
    changes, offset = {}, 0.0
    if rng.random() < 0.7:
        changes["R"] = np.diag(np.diag(model.R))
    if family == "vague start":
        changes["P0"] = model.P0 * 10 ** rng.uniform(4, 18)
    elif family == "offset data":
        offset = 10 ** rng.uniform(2, 8)
    elif family == "slow modes":
        changes["F"] = np.eye(n) + 0.01 * np.triu(rng.normal(size=(n, n)), 1)
        changes["Q"] = model.Q * 10 ** rng.uniform(-14, -2)
    elif family == "Q = 0":
        changes["Q"] = np.zeros((n, n))
    elif family == "tiny R":
        changes["R"] = model.R * 10 ** rng.uniform(-18, -4)
    elif family == "singular P0":
        a = rng.normal(size=(n, 1))
        changes["P0"] = a @ a.T
    elif family == "constant velocity":
        dt, q = 10 ** rng.uniform(-2, 0.5), 10 ** rng.uniform(-8, 0)
        Q = q * np.array([[dt ** 3 / 3, dt ** 2 / 2], [dt ** 2 / 2, dt]])
        offset = 10 ** rng.uniform(0, 6)
        return LinearModel([[1, dt], [0, 1]], [1, 0], Q, 1, [0, 0], 10 ** rng.uniform(-2, 8) * np.eye(2)), offset
    return replace(model, **changes), offset


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", range(8))
def test_adversaries(family, seed):
    """Wherever a fast form is chosen it is the loop to 1e-12; elsewhere it is not chosen."""
    rng = np.random.default_rng(1000 * FAMILIES.index(family) + seed)
    model, offset = adversary(family, rng)
    steps = int(rng.choice([50, 200, 600, 2600], p=[0.3, 0.3, 0.3, 0.1]))
    z = offset + rng.normal(size=(steps, len(model.H))) * np.sqrt(np.diag(model.R))
    if seed % 2:
        z += 0.1 * np.cumsum(rng.normal(size=z.shape), axis=0)
    if seed % 4 > 1:
        z[rng.random(z.shape) < 0.1] = np.nan
        z[:rng.integers(5)] = np.nan
    same_smoother(*same_filter(model, z))


def test_fast_forms_are_chosen_where_they_are_right():
    """A test that compares the loop with itself would say nothing."""
    def is_fast(model, z):
        result = fast.kalman_filter(model, z)
        return isinstance(result, LazyFilterResult) and isinstance(fast.rts_smooth(result), LazySmootherResult)
    two = LinearModel([[1, 0.1], [0, 1]], [1, 0], np.diag([1e-3, 1e-2]), 1, [0, 0], np.eye(2))
    z = np.random.default_rng(0).normal(size=3000)
    assert is_fast(LinearModel(1, 1, 0.01, 1, 0, 1e9), z[:60]) and is_fast(two, z)
    assert is_fast(two, np.where(np.arange(3000) % 7 == 0, np.nan, z))
    vague = fast.kalman_filter(replace(two, P0=1e6 * np.eye(2)), z)
    assert isinstance(vague, LazyFilterResult)                                  # the loop has done the first steps
    assert not is_fast(two, 1e7 + z) and not is_fast(replace(two, Q=np.zeros((2, 2))), z)


# --- many runs -------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("steps", [20, 400])
@pytest.mark.parametrize("seed", range(8))
def test_many_runs(seed, steps):
    rng = np.random.default_rng(seed)
    n, m, l = (1, 1, seed // 3 % 2) if seed % 3 == 0 else (rng.integers(1, 4), rng.integers(1, 3), seed % 2)
    model = random_model(rng, n, m, l)
    u = rng.normal(size=(steps, l)) if l else None
    z = np.stack([simulate(model, steps, rng, u).z for _ in range(3)], axis=-1)
    together = fast.kalman_filter(model, z, u)
    smooth = fast.smooth_runs(together)
    for run in range(3):
        alone = filters.kalman_filter(model, z[..., run], u)
        for name in ("x", "x_pred", "y"):
            close(getattr(together, name)[..., run], getattr(alone, name))
        for name in ("P_pred", "P", "S", "K", "F", "R"):
            close(getattr(together, name), getattr(alone, name))
        alone = filters.rts_smooth(alone)
        close(smooth.x[..., run], alone.x)
        close(smooth.P, alone.P)
    with pytest.raises(ValueError, match="smooth_runs takes the result .*smooth_runs menerima"):
        fast.smooth_runs(fast.kalman_filter(model, z[..., 0], u))


def test_extended_filter_of_many_runs():
    p = beetle.Params(Q_theta=1e-3, Q_v=1e-3, theta0=0.5)
    model = beetle.model(p)
    z = np.stack([beetle.simulate(p, np.random.default_rng(seed)).z for seed in range(5)], axis=-1)
    together = fast.kalman_filter(model, z)
    for run in range(5):
        alone = filters.kalman_filter(model, z[..., run])
        for name in FIELDS:
            ours = getattr(together, name)
            close(ours if name in ("Q", "R", "start") else ours[..., run], getattr(alone, name))


def test_extended_filter_of_many_runs_with_gaps():
    p = beetle.Params(Q_theta=1e-3, Q_v=1e-3, theta0=0.5)
    model = beetle.model(p)
    z = np.stack([beetle.simulate(p, np.random.default_rng(seed)).z for seed in range(4)], axis=-1)
    z[3, 0, 2] = z[5] = np.nan
    together = fast.kalman_filter(model, z)
    for run in range(4):
        alone = filters.kalman_filter(model, z[..., run])
        for name in FIELDS:
            ours = getattr(together, name)
            close(ours if name in ("Q", "R", "start") else ours[..., run], getattr(alone, name))


def test_many_runs_are_checked_for_their_shapes():
    model = beetle.model(beetle.Params())
    z = np.zeros((60, 1, 5))
    wrong = {"h": lambda x, u: np.array([x.sum()]), "f": lambda x, u: x[:2], "H": lambda x, u: [[1, 0]],
             "F": lambda x, u: [[1, 0, np.zeros(4)], [0, 1, 0], [0, 0, 1]]}
    for name, function in wrong.items():
        with pytest.raises(ValueError, match=rf"{name}\(x, u\).* has shape .* berukuran"):
            fast.kalman_filter(replace(model, **{name: function}), z)


@pytest.mark.parametrize("K", [3e-7, 1e-6, 3e-6])
def test_a_slow_filter_far_from_zero_keeps_all_digits(K):
    """1 - K has lost digits of so small a K, and many steps would add up what is missing."""
    rng, Q = np.random.default_rng(8), K ** 2 / (1 - K)
    model = LinearModel(F=1, H=1, Q=Q, R=1, x0=1e6, P0=K, B=1)
    z, u = 1e6 + rng.normal(size=(5000, 1, 2)), 1e-6 * rng.normal(size=5000)
    together = fast.kalman_filter(model, z, u)
    for run in range(2):
        x = 1e6
        for k in range(5000):                   # K is the same in every step
            x += u[k]
            x += K * (z[k, 0, run] - x)
        assert together.K[-1, 0, 0] == pytest.approx(K, rel=1e-9) and abs(together.x[-1, 0, run] - x) < 1e-12 * x
        assert abs(fast.kalman_filter(model, z[..., run], u).x[-1, 0] - x) < 1e-12 * x


# --- the same contract -----------------------------------------------------------------------------------------------

def test_the_same_errors_as_the_loop():
    model = LinearModel(F=np.eye(2), H=[[1, 0]], Q=np.eye(2), R=1, x0=[0, 0], P0=np.eye(2), B=[[1], [0]])
    no_input = replace(model, B=None)
    in_time = replace(model, R=np.ones((60, 1, 1)))
    z, u = np.zeros(80), np.ones((80, 1))
    wrong = [(model, np.zeros((80, 2)), None), (model, np.full(80, np.inf), None), (model, ["a"] * 80, None),
             (model, z, u[1:]), (model, z, np.full(80, np.nan)), (model, z, np.ones((80, 2))), (no_input, z, u),
             (in_time, z, None), (no_input, np.zeros((80, 1, 2)), u), (model, np.zeros((80, 1, 2)), np.ones((80, 2)))]
    for case in wrong:
        with pytest.raises(ValueError) as ours:
            fast.kalman_filter(*case)
        with pytest.raises(ValueError) as loop:
            filters.kalman_filter(*case)
        assert str(ours.value) == str(loop.value)


def test_what_has_no_fast_form_is_the_loop():
    rng = np.random.default_rng(7)
    z = 0.1 * rng.normal(size=100)
    model = LinearModel(F=1, H=1, Q=1, R=1, x0=0, P0=1)
    wrapped = replace(model, residual=lambda z, z_pred: (z - z_pred + np.pi) % (2 * np.pi) - np.pi)
    twin = NonlinearModel(f=lambda x, u: x, F=lambda x, u: np.eye(1), h=lambda x, u: x, H=lambda x, u: np.eye(1),
                          Q=model.Q, R=model.R, x0=model.x0, P0=model.P0)
    for case in ((wrapped, z), (twin, z), (model, z, None, lambda k, y, HPH, R: R * (1 + k)), (model, z[:49])):
        ours, loop = fast.kalman_filter(*case), filters.kalman_filter(*case)
        assert all(np.array_equal(getattr(ours, name), getattr(loop, name)) for name in FIELDS)


def test_a_result_can_be_copied_replaced_and_shown():
    flight = gyro.simulate(gyro.Params(), np.random.default_rng(0))
    result = fast.kalman_filter(gyro.model(gyro.Params()), flight.z, flight.u)
    assert isinstance(result, filters.FilterResult)
    copy, other = pickle.loads(pickle.dumps(result)), replace(result, x=result.x + 1)
    assert all(np.array_equal(getattr(copy, name), getattr(result, name)) for name in FIELDS)
    assert np.array_equal(other.x, result.x + 1) and np.array_equal(other.K, result.K)
    assert np.array_equal(filters.rts_smooth(other).P, filters.rts_smooth(result).P)
    with pytest.raises(AttributeError):
        result.x = 0
    smooth = fast.rts_smooth(result)
    assert np.array_equal(pickle.loads(pickle.dumps(smooth)).P, smooth.P)


def test_a_million_steps_add_at_most_60_MB():
    code = """
import tracemalloc, numpy as np
from kalman_lib import LinearModel, kalman_filter, rts_smooth
model, z = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1), np.random.default_rng(0).normal(size=1_000_000)
rts_smooth(kalman_filter(model, z[:5000])).x
tracemalloc.start()
result = kalman_filter(model, z)
smooth = rts_smooth(result)
x, P = smooth.x, smooth.P
print(tracemalloc.get_traced_memory()[1] / 1e6)
"""
    added = float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
    assert added <= 60
