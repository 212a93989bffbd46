"""Models on which ordinary filters lose their digits, against one with 150 digits and against statsmodels.

Families: states that decay without noise, constants, known states, exact copies, a bias, undriven oscillators, a vague
start, tiny R, redundant sensors, gaps at either end. Readable and fast forms, filter and smoother.
"""
import math
from dataclasses import replace

import numpy as np
import pytest
from high_precision import filter_and_smooth
from statsmodels.tsa.statespace.mlemodel import MLEModel

from kalman_lib import LinearModel, NonlinearModel, fast, filters, kalman_filter, nis, rts_smooth, smooth_runs
from kalman_lib.tuning import log_likelihood

I2, ZERO2 = np.eye(2), np.zeros((2, 2))


def oscillator(angle, damping=1.0):
    c, s = np.cos(angle), np.sin(angle)
    return damping * np.array([[c, s], [-s, c]])


def block(*parts):
    """The block-diagonal matrix of the parts."""
    n = sum(len(part) for part in parts)
    M, i = np.zeros((n, n)), 0
    for part in parts:
        M[i:i + len(part), i:i + len(part)] = part
        i += len(part)
    return M


COPY = np.outer([1, 1, 0], [1, 1, 0])
SMOOTH = {      # name -> model; T steps
    "decays slowly": (LinearModel(np.diag([0.9, 1]), [1, 1], np.diag([0, 0.01]), 1, [0, 0], I2), 600),
    "decays fast": (LinearModel(np.diag([0.2, 1]), [1, 1], np.diag([0, 0.01]), 1, [0, 0], I2), 500),
    "decays, coupled": (LinearModel([[0.5, 0.3], [0, 1]], [1, 0], np.diag([0, 0.1]), 1, [1, 0], I2), 400),
    "a constant": (LinearModel(1, 1, 0, 1, 0, 1e6), 800),
    "two constants": (LinearModel(I2, [[1, 0], [1, 1]], ZERO2, I2, [0, 0], 100 * I2), 300),
    "a known state": (LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1, [0, 1], ZERO2), 100),
    "one known, one not": (LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1, [0, 1], np.diag([4, 0])), 100),
    "exact copies": (LinearModel(np.eye(3), [[1, 0, 0], [0, 0, 1]], 0.01 * COPY, I2, [0, 0, 0],
                                 COPY + np.diag([0, 0, 9])), 150),
    "a bias": (LinearModel([[1, -0.1], [0, 1]], [1, 0], np.diag([1e-3, 0]), 1, [0, 0], np.diag([1, 0.1])), 500),
    "an undriven oscillator": (LinearModel(oscillator(0.3), [1, 0], ZERO2, 1, [0, 0], 10 * I2), 600),
    "two oscillators and a walk": (LinearModel(block(oscillator(0.1), oscillator(0.8, 0.95), [[1.0]]), [1, 0, 1, 0, 1],
                                               np.diag([0, 0, 0, 0, 0.1]), 1, np.zeros(5), np.eye(5)), 200),
    "eight states": (LinearModel(block(*(oscillator(a, 0.97) for a in (0.1, 0.4, 0.9, 1.7))),
                                 np.ones((2, 8)) + np.eye(2, 8), np.diag([0, 0, 0, 0, 0, 0, 1.0, 1]), I2, np.zeros(8),
                                 np.eye(8)), 80),
}


def data(model, T, gaps):
    rng = np.random.default_rng(T)
    z = rng.normal(size=(T, len(model.H)))
    if gaps:
        z[:7] = z[-9:] = z[T // 2:T // 2 + 12] = np.nan
        z[rng.random(z.shape) < 0.1] = np.nan
    return z


def relative(ours, exact):
    """The largest error of each column relative to its largest value."""
    size = np.abs(exact).max(axis=0)
    return (np.abs(ours - exact).max(axis=0) / np.where(size > 0, size, 1)).max()


def in_sigmas(ours, exact):
    """The largest error of a covariance, every entry relative to its two standard deviations at that step."""
    sigma = np.sqrt(np.maximum(np.einsum("kii->ki", exact), 0))
    size = sigma[:, :, np.newaxis] * sigma[:, np.newaxis]
    error = np.abs(ours - exact)
    return (error[size > 1e-300] / size[size > 1e-300]).max(initial=0)


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize("name", SMOOTH)
def test_filter_and_smoother_have_all_their_digits(name, gaps):
    model, T = SMOOTH[name]
    z = data(model, T, gaps)
    exact = filter_and_smooth(model, z)
    for package in (filters, fast):
        result = package.kalman_filter(model, z)
        smooth = package.rts_smooth(result)
        for ours, key in ((result.x, "x"), (result.x_pred, "x_pred"), (smooth.x, "x_s")):
            assert relative(ours, exact[key]) < 1e-9, (package, key)
        for ours, key in ((result.P, "P"), (result.P_pred, "P_pred"), (smooth.P, "P_s")):
            assert in_sigmas(ours, exact[key]) < 1e-9, (package, key)
    assert log_likelihood(result) == pytest.approx(exact["likelihood"], rel=1e-9)
    many = kalman_filter(model, np.stack([z, -z], axis=-1))
    assert relative(smooth_runs(many).x[..., 0], exact["x_s"]) < 1e-9


@pytest.mark.parametrize("a, T, largest", [(0.9, 1000, 0.414), (0.9, 3000, 0.535), (0.2, 500, 0.378), (0.9, 8000, 0.535)])
def test_a_state_that_decays_without_noise_is_smoothed(a, T, largest):
    """Largest values by statsmodels with tolerance 0."""
    z = np.random.default_rng(0).normal(size=8000)[:T]
    model = LinearModel(F=np.diag([a, 1]), H=[[1, 1]], Q=np.diag([0, .01]), R=1, x0=[0, 0], P0=np.eye(2))
    smooth = rts_smooth(kalman_filter(model, z))
    assert abs(smooth.x).max() == pytest.approx(largest, abs=5e-4)
    assert relative(smooth.x, with_statsmodels(model, z[:, np.newaxis]).smoothed_state.T) < 1e-9


def with_statsmodels(model, z):
    n = len(model.x0)
    peer = MLEModel(z, k_states=n, k_posdef=n, tolerance=0)
    for name, M in (("transition", model.F), ("design", model.H), ("state_cov", model.Q), ("obs_cov", model.R)):
        peer[name] = M if M.ndim == 2 else M.transpose(1, 2, 0)
    peer["selection"] = np.eye(n)
    F, Q = (M if M.ndim == 2 else M[0] for M in (model.F, model.Q))
    peer.initialize_known(F @ model.x0, F @ model.P0 @ F.T + Q)
    peer.ssm.tolerance = 0
    return peer.smooth([], return_ssm=True)


@pytest.mark.parametrize("name", ["a constant", "a bias", "an undriven oscillator", "decays slowly"])
def test_ten_thousand_steps_against_statsmodels(name):
    model = replace(SMOOTH[name][0], P0=np.eye(len(SMOOTH[name][0].x0)))        # a vaguer start costs statsmodels digits
    z = data(model, 10_000, False)
    result = kalman_filter(model, z)
    theirs = with_statsmodels(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9


def test_a_constant_that_is_measured_ten_thousand_times_is_the_mean():
    z = data(SMOOTH["a constant"][0], 10_000, False)[:, 0]
    smooth = rts_smooth(kalman_filter(LinearModel(1, 1, 0, 1, 0, 1e6), z))
    assert smooth.x[:, 0] == pytest.approx(math.fsum(z) / (len(z) + 1e-6), rel=1e-12)
    assert smooth.P[:, 0, 0] == pytest.approx(1 / (len(z) + 1e-6), rel=1e-12)


# --- covariances stay covariances ------------------------------------------------------------------------------------

def is_covariance(P):
    P = np.asarray(P)
    eigenvalues = np.linalg.eigvalsh(P)
    assert np.array_equal(P, P.swapaxes(-1, -2))
    assert (np.einsum("...ii->...i", P) >= 0).all()
    assert (eigenvalues[..., 0] >= -1e-15 * eigenvalues[..., -1]).all()


def adversaries(count=150):
    """Models with Q = 0 or singular, R down to 1e-18, a singular or vague P0, redundant sensors."""
    rng = np.random.default_rng(18)
    for i in range(count):
        n, m = int(rng.integers(1, 6)), int(rng.integers(1, 4))
        F = rng.normal(size=(n, n))
        F = F / np.abs(np.linalg.eigvals(F)).max() if i % 3 else np.eye(n)
        a = rng.normal(size=(n, 1))
        P0 = (a @ a.T, np.eye(n), np.diag(10.0 ** rng.uniform(-9, 9, n)), np.ones((n, n)))[i % 4]
        R = np.diag(10.0 ** rng.uniform(-18, 0, m))
        H = rng.normal(size=(1 if i % 5 == 0 else m, n))
        if len(H) < m:
            H = np.repeat(H, m, axis=0)
        Q = np.zeros((n, n)) if i % 2 else 0.1 * a @ a.T
        yield LinearModel(F, H, Q, R, np.zeros(n), P0 * (1e18 * R.min() if i % 7 == 0 else 1))


def test_covariances_of_adversaries():
    for model in adversaries():
        z = np.random.default_rng(1).normal(size=(60, len(model.H)))
        z[5] = np.nan
        for package in (filters, fast):
            result = package.kalman_filter(model, z)
            smooth = package.rts_smooth(result)
            for P in (result.P, result.P_pred, result.S, smooth.P):
                is_covariance(P)


def test_one_update_with_a_tiny_R():
    """P0 = v v' and R -> 0: only rounding could make P[1, 1] negative."""
    v = np.array([0.3, 0.7])
    P = kalman_filter(LinearModel(I2, [1, 0], ZERO2, 1e-18, [0, 0], np.outer(v, v)), [1.0]).P[0]
    is_covariance(P)
    assert P[1, 1] == pytest.approx((0.7 / 0.3) ** 2 * 1e-18, rel=1e-6)
    z = np.ones(60)
    z[5] = np.nan
    is_covariance(kalman_filter(LinearModel(I2, [1, 0], ZERO2, 1e-16, [0, 0], np.ones((2, 2))), z).P)


@pytest.mark.parametrize("p", [1e12, 1e15, 1e16, 1e18])
def test_redundant_sensors_with_a_vague_start_give_their_mean(p):
    model = LinearModel(F=1, H=[[1], [1]], Q=1, R=I2, x0=0, P0=p)
    result = kalman_filter(model, [[5.0, 7.0]])
    assert result.x[0, 0] == pytest.approx(6, rel=1e-11) and result.P[0, 0, 0] == pytest.approx(0.5, rel=1e-11)
    exact = filter_and_smooth(model, [[5.0, 7.0]])["likelihood"]
    assert log_likelihood(result) == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("P0", [1e6, 1e9, 1e10, 1e12, 1e16])
@pytest.mark.parametrize("gaps", [False, True])
def test_a_vague_start_costs_no_digits(P0, gaps):
    model = LinearModel([[1, 1], [0, 1]], [1, 0], np.diag([1e-3, 1e-3]), 1, [0, 0], P0 * I2)
    for T in (49, 50, 300):
        z = data(model, T, gaps)
        exact = filter_and_smooth(model, z)
        result = kalman_filter(model, z)
        assert relative(result.x, exact["x"]) < 1e-11 and in_sigmas(result.P, exact["P"]) < 1e-11
        smooth = rts_smooth(result)
        assert relative(smooth.x, exact["x_s"]) < 1e-10 and in_sigmas(smooth.P, exact["P_s"]) < 1e-10


def test_vague_starts_that_once_broke_the_fast_forms():
    model = LinearModel([[1, 1], [0, 1]], [1, 0], ZERO2, 1e-6, [0, 0], 1e10 * I2)
    for z in (np.zeros(50), np.zeros((50, 1, 3))):
        assert np.array_equal(kalman_filter(model, z).x, np.zeros((50, 2, *z.shape[2:])))
    z = np.zeros(2500)
    z[::50] = np.nan
    flat = LinearModel(I2, [1, 1], ZERO2, 1, [0, 0], 1e15 * I2)
    is_covariance(kalman_filter(flat, z).P)


# --- silent sensors, matrices of each step ---------------------------------------------------------------------------

def two_rates(T=400):
    """A position at 10 Hz and a speed at 100 Hz."""
    dt = 0.01
    model = LinearModel([[1, dt], [0, 1]], I2, np.diag([0, 0.01]), np.diag([4, 0.09]), [0, 0], np.diag([100, 4]))
    z = np.random.default_rng(3).normal(size=(T, 2))
    z[np.arange(T) % 10 > 0, 0] = np.nan
    return model, z


def test_two_sensors_at_two_rates_are_those_of_statsmodels():
    model, z = two_rates()
    theirs = with_statsmodels(model, z)
    for package in (filters, fast):
        result = package.kalman_filter(model, z)
        smooth = package.rts_smooth(result)
        assert relative(result.x, theirs.filtered_state.T) < 1e-9
        assert in_sigmas(result.P, theirs.filtered_state_cov.transpose(2, 0, 1)) < 1e-9
        assert relative(smooth.x, theirs.smoothed_state.T) < 1e-9
        assert log_likelihood(result) == pytest.approx(theirs.llf_obs.sum(), rel=1e-9)
    many = kalman_filter(model, np.stack([z, 2 * z], axis=-1))
    assert relative(many.x[..., 0], result.x) < 1e-12 and relative(many.x[..., 1], 2 * result.x) < 1e-12


def test_two_sensors_that_take_turns():
    z = np.full((100, 2), np.nan)
    z[::2, 0] = z[1::2, 1] = 1.0
    model = LinearModel(F=1, H=[[1], [1]], Q=1e-4, R=I2, x0=0, P0=100)
    alone = LinearModel(F=1, H=1, Q=1e-4, R=1, x0=0, P0=100)
    result = kalman_filter(model, z)
    assert result.x[-1, 0] == pytest.approx(kalman_filter(alone, np.ones(100)).x[-1, 0], rel=1e-12)
    assert np.array_equal(np.isnan(result.y), np.isnan(z)) and (result.K[::2, 0, 1] == 0).all()
    assert np.isfinite(nis(result.y, result.S)).all()


def test_correlated_sensors_of_which_one_is_silent():
    """The rest of the row counts with its own part of R."""
    R = np.array([[1, 0.9, 0.2], [0.9, 1, 0.1], [0.2, 0.1, 2]])
    model = LinearModel(I2, [[1, 0], [1, 1], [0, 1]], 0.1 * I2, R, [0, 0], I2)
    z = np.random.default_rng(5).normal(size=(80, 3))
    z[np.random.default_rng(6).random(z.shape) < 0.4] = np.nan
    theirs = with_statsmodels(model, z)
    result = kalman_filter(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9


def test_an_infinite_R_is_a_silent_sensor():
    model, z = two_rates(60)
    R = np.repeat(model.R[np.newaxis], 60, axis=0)
    R[np.isnan(z[:, 0]), 0, 0] = np.inf
    noisy = replace(model, R=R)
    ours, theirs = kalman_filter(noisy, np.nan_to_num(z)), kalman_filter(model, z)
    assert np.array_equal(ours.x, theirs.x) and np.array_equal(ours.P, theirs.P)
    assert np.array_equal(rts_smooth(ours).x, rts_smooth(theirs).x)
    assert log_likelihood(ours) == pytest.approx(log_likelihood(theirs), rel=1e-14)
    blind = replace(model, R=np.diag([4, np.inf]))
    assert np.isnan(kalman_filter(blind, np.zeros((5, 2))).y[:, 1]).all()


def test_matrices_that_change_from_step_to_step_are_those_of_statsmodels():
    rng, T = np.random.default_rng(11), 120
    dt = rng.uniform(0.1, 2, T)
    F = np.array([[[1, h], [0, 1]] for h in dt])
    Q = np.array([0.1 * np.array([[h ** 3 / 3, h ** 2 / 2], [h ** 2 / 2, h]]) for h in dt])
    H = rng.normal(size=(T, 1, 2))
    R = rng.uniform(0.5, 2, T)
    model = LinearModel(F, H, Q, R, [0, 1], I2)
    z = rng.normal(size=(T, 1))
    theirs = with_statsmodels_shifted(model, z)
    result = kalman_filter(model, z)
    assert relative(result.x, theirs.filtered_state.T) < 1e-9
    assert relative(rts_smooth(result).x, theirs.smoothed_state.T) < 1e-9
    exact = filter_and_smooth(model, z)
    assert relative(rts_smooth(result).x, exact["x_s"]) < 1e-12


def with_statsmodels_shifted(model, z):
    """statsmodels predicts after the update: its transition of step k leads to step k + 1."""
    shifted = replace(model, F=np.concatenate([model.F[1:], model.F[:1]]), Q=np.concatenate([model.Q[1:], model.Q[:1]]))
    n = len(model.x0)
    peer = MLEModel(z, k_states=n, k_posdef=n, tolerance=0)
    for name, M in (("transition", shifted.F), ("design", model.H), ("state_cov", shifted.Q), ("obs_cov", model.R)):
        peer[name] = M.transpose(1, 2, 0)
    peer["selection"] = np.eye(n)
    peer.initialize_known(model.F[0] @ model.x0, model.F[0] @ model.P0 @ model.F[0].T + model.Q[0])
    peer.ssm.tolerance = 0
    return peer.smooth([], return_ssm=True)


def test_an_input_matrix_of_each_step():
    B = np.arange(1.0, 4)[:, np.newaxis, np.newaxis]
    result = kalman_filter(LinearModel(1, 1, 0, 1, 0, 0, B=B), np.zeros(3), u=[1, 1, 1])
    assert np.array_equal(result.x[:, 0], [1, 3, 6])


@pytest.mark.parametrize("name, M", [("F", np.ones((4, 1, 1))), ("H", np.ones((4, 1, 1))), ("Q", np.ones(4)),
                                     ("R", np.ones(4)), ("B", np.ones((4, 1, 1)))])
def test_a_wrong_number_of_matrices_is_named(name, M):
    model = replace(LinearModel(1, 1, 1, 1, 0, 1, B=1), **{name: M})
    for z in (np.zeros(5), np.zeros(60), np.zeros((60, 1, 2))):
        with pytest.raises(ValueError, match=rf"{name} has shape \(4, 1, 1\), expected \({len(z)}, 1, 1\)"):
            kalman_filter(model, z, np.ones(len(z)))
    with pytest.raises(ValueError, match=r"has shape \(4, 1, 1\), expected \(3, 1, 1\)|has shape \(3, 1, 1\), expected"):
        replace(model, **{("Q" if name != "Q" else "R"): np.ones(3)})


# --- many runs of a nonlinear model, likelihoods -----------------------------------------------------------------------

@pytest.mark.parametrize("F, H, Q, R, P0", [
    ([[1, 1], [0, 1]], [1, 0], 0, 1e-6, 1e10 * I2), ([[1, 1], [0, 1]], [1, 0], 1e-3, 1, 1e14 * I2),
    ([[1, 0], [0, 1]], [1, 1], 0, 1e-16, np.ones((2, 2))), ([[1, 0], [0, 1]], [1, 0], 0, 1e-18, np.outer([.3, .7], [.3, .7])),
    ([[1, 0.1], [0, 0.9]], [1, 0], 0.01, 1, I2)])
def test_many_extended_runs_are_the_loop(F, H, Q, R, P0):
    F = np.array(F)
    def h(x, u):
        return np.dot(H, x)[np.newaxis]
    model = NonlinearModel(lambda x, u: F @ x, lambda x, u: F, h, lambda x, u: H, Q * I2, R, [0, 0], P0, many_runs=True)
    z = np.random.default_rng(2).normal(size=(60, 1, 3))
    z[7, 0, 1] = np.nan
    together = kalman_filter(model, z)
    for run in range(3):
        exact = filter_and_smooth(LinearModel(F, H, Q * I2, R, [0, 0], P0), z[:, :, run])
        assert relative(together.x[..., run], exact["x"]) < 1e-9
        is_covariance(together.P[..., run])


def test_the_likelihood_of_redundant_sensors():
    """Many runs, a third sensor that tells nothing, a vague state beside a well known one."""
    z = np.array([[5.0, 7], [4, 5], [6, 7]])
    for p in (1e10, 1e12, 1e16):
        model = LinearModel(1, [[1], [1]], 1, I2, 0, p)
        exact = filter_and_smooth(model, z)["likelihood"]
        many = kalman_filter(model, np.stack([z, z], axis=-1))
        assert log_likelihood(many) == pytest.approx([exact, exact], rel=1e-10)
        three = LinearModel(1, [[1], [1], [1]], 1, np.diag([1, 1, np.inf]), 0, p)
        assert log_likelihood(kalman_filter(three, np.c_[z, z[:, 0]])) == pytest.approx(exact, rel=1e-10)
        mixed = LinearModel([[1, 0], [1, 1]], [[1, -1], [1, 0], [1, 0]], ZERO2, np.eye(3), [0, 0], np.diag([p, 1]))
        exact = filter_and_smooth(mixed, [[0.0, 3, 4]])["likelihood"]
        assert log_likelihood(kalman_filter(mixed, [[0.0, 3, 4]])) == pytest.approx(exact, rel=1e-10)


def test_an_input_that_the_data_contradict_keeps_its_digits():
    model = LinearModel(1, 1, 1, 1e-12, 0, 1, B=1)
    rng = np.random.default_rng(0)
    u, z = 1e9 * rng.choice([-1, 1], size=600), rng.normal(size=600)
    assert relative(kalman_filter(model, z, u).x, filters.kalman_filter(model, z, u).x) < 1e-12
