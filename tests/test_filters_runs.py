"""Many runs at once against the same runs one by one."""

import numpy as np
import pytest
from filters_helpers import close, random_model

from kalman_lib import (
    LinearModel,
    NonlinearModel,
    kalman_filter,
    rts_smooth,
    smooth_runs,
)
from kalman_lib.simulate import simulate

# --- many runs at once ----------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(20))
def test_many_runs_at_once_equal_the_loop_run_by_run(seed):
    rng = np.random.default_rng(seed)
    l = seed % 3  # without an input, with one, with two
    model, T, runs = random_model(rng, l=l), 25, 4
    u = rng.normal(size=(T, l)) if l else None
    z = np.stack([simulate(model, T, rng, u).z for _ in range(runs)], axis=-1)
    together = kalman_filter(model, z, u)
    n, m = len(model.x0), z.shape[1]
    assert together.x.shape == together.x_pred.shape == (T, n, runs)
    assert together.y.shape == (T, m, runs)
    for run in range(runs):
        alone = kalman_filter(model, z[:, :, run], u)
        for name in ("x_pred", "x", "y"):
            close(getattr(together, name)[:, :, run], getattr(alone, name), 1e-12)
        for name in ("P_pred", "P", "S", "K", "F", "R"):  # common to all runs: no axis of the runs
            assert np.array_equal(getattr(together, name), getattr(alone, name))


def test_many_runs_that_have_no_common_form_are_refused():
    rng = np.random.default_rng(4)
    model = random_model(rng, n=2, m=1, l=1)
    parts = {name: getattr(model, name) for name in ("F", "H", "Q", "R", "x0", "P0", "B")}
    z = rng.normal(size=(6, 1, 3))
    nonlinear = NonlinearModel(
        f=lambda x, u: x,
        F=lambda x, u: np.eye(2),
        h=lambda x, u: x[:1],
        H=lambda x, u: np.eye(1, 2),
        Q=model.Q,
        R=model.R,
        x0=model.x0,
        P0=model.P0,
    )
    wrapped = LinearModel(**parts, residual=lambda z, z_pred: z - z_pred)
    for other in (nonlinear, wrapped):
        with pytest.raises(
            ValueError,
            match="needs a LinearModel with the usual residual.* / .*memerlukan LinearModel",
        ):
            kalman_filter(other, z)
    for options in (dict(adapt_R=lambda k, y, HPH, R: R), dict(gate=0.99)):
        with pytest.raises(ValueError, match="neither adapt_R nor gate"):
            kalman_filter(model, z, **options)
    with pytest.raises(ValueError, match=r"u has shape \(6, 1, 3\), expected \(6, l\)"):
        kalman_filter(model, z, u=z)
    with pytest.raises(ValueError, match="model has no B"):
        kalman_filter(LinearModel(**{**parts, "B": None}), z, u=np.ones(6))
    for wrong in (np.zeros((6, 2, 3)), np.zeros((6, 1, 0)), np.zeros((6, 1, 3, 1))):
        with pytest.raises(ValueError, match=r"z has shape .*, expected \(T, 1\)"):
            kalman_filter(model, wrong)
    z[2, 0, 1] = np.inf
    with pytest.raises(ValueError, match="finite"):
        kalman_filter(model, z)


@pytest.mark.parametrize("together", [True, False])
def test_many_runs_with_gaps_and_matrices_of_each_step(together):
    """Sensors that are silent in all runs, or in one only."""
    rng = np.random.default_rng(9)
    model, T = random_model(rng, n=3, m=2, l=1), 30
    model = LinearModel(
        F=model.F * rng.uniform(0.9, 1, size=(T, 1, 1)),
        H=model.H,
        Q=model.Q,
        B=model.B,
        R=model.R * rng.uniform(0.5, 2, size=(T, 1, 1)),
        x0=model.x0,
        P0=model.P0,
    )
    u, z = rng.normal(size=(T, 1)), rng.normal(size=(T, 2, 3))
    z[4] = z[6, 1] = np.nan
    if not together:
        z[8, 0, 1] = np.nan
    result = kalman_filter(model, z, u)
    smooth = smooth_runs(result)
    for run in range(3):
        alone = kalman_filter(model, z[:, :, run], u)
        back = rts_smooth(alone)
        for name in ("x_pred", "x", "y"):
            ours, loop = getattr(result, name)[..., run], getattr(alone, name)
            close(np.nan_to_num(ours), np.nan_to_num(loop), 1e-12)
        for name in ("P_pred", "P", "S", "K"):
            ours = getattr(result, name)
            close(ours if together else ours[..., run], getattr(alone, name), 1e-12)
        close(smooth.x[..., run], back.x, 1e-12)
        close(smooth.P if together else smooth.P[..., run], back.P, 1e-12)


def test_many_runs_are_smoothed_run_by_run():
    result = kalman_filter(random_model(np.random.default_rng(0), n=2, m=1), np.zeros((5, 1, 3)))
    with pytest.raises(ValueError, match="rts_smooth takes one run"):
        rts_smooth(result)
