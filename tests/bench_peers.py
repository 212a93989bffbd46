"""The other libraries of the bench: each does the work of kalman_filter, or of rts_smooth, too."""

import importlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kalman_lib.papers import beetle

PEERS = ["filterpy", "pykalman", "simdkalman", "statsmodels", "dynamax"]


def load(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


LIBRARIES = {name: load(name) for name in PEERS}


@dataclass
class Contender:
    run: Callable  # () -> x, the estimates, (T, n) or (T, n, runs)
    share: float = 1  # the part of the work that it does


def peers(**makers):
    """The contenders whose library is there: name -> Contender."""
    return {name: make() for name, make in makers.items() if LIBRARIES[name]}


def first_part(z, share):
    """The first rows of z, at least 3."""
    return z[: max(3, round(share * len(z)))]


def first_prediction(model):
    return model.F @ model.x0, model.F @ model.P0 @ model.F.T + model.Q


def with_filterpy(model, z, share=1.0, smooth=False):
    from filterpy.kalman import KalmanFilter

    n, m = len(model.x0), len(model.H)
    rows = first_part(z, share)
    R = model.R if model.R.ndim == 3 else [model.R] * len(rows)

    def run():
        peer = KalmanFilter(dim_x=n, dim_z=m)
        peer.F, peer.H, peer.Q, peer.R = model.F, model.H, model.Q, R[0]
        peer.x, peer.P = model.x0.copy(), model.P0.copy()
        x, P, _, _ = peer.batch_filter(rows, Rs=R[: len(rows)])
        return peer.rts_smoother(x, P)[0] if smooth else x

    return Contender(run, len(rows) / len(z))


def with_pykalman(model, z, share=1.0, smooth=False):
    import pykalman

    mean, covariance = first_prediction(model)
    rows = first_part(z, share)
    start = dict(initial_state_mean=mean, initial_state_covariance=covariance)
    peer = pykalman.KalmanFilter(model.F, model.H, model.Q, model.R, **start)
    form = peer.smooth if smooth else peer.filter
    return Contender(lambda: np.asarray(form(rows)[0]), len(rows) / len(z))


def with_simdkalman(model, z, share=1.0, smooth=False):
    import simdkalman

    mean, covariance = first_prediction(model)
    peer = simdkalman.KalmanFilter(model.F, model.Q, model.H, model.R)
    rows = first_part(z, share)
    data = rows[:, 0].T.copy() if z.ndim == 3 else rows.T
    start = dict(initial_value=mean, initial_covariance=covariance)

    def run():
        answer = peer.compute(data, 0, **start, filtered=not smooth, smoothed=smooth)
        x = (answer.smoothed if smooth else answer.filtered).states.mean
        return x.transpose(1, 2, 0) if z.ndim == 3 else x[0]

    return Contender(run, len(rows) / len(z))


def with_statsmodels(model, z, smooth=False):
    from statsmodels.tsa.statespace.mlemodel import MLEModel

    mean, covariance = first_prediction(model)
    n = len(mean)
    peer = MLEModel(z, k_states=n, k_posdef=n)
    peer["transition"] = model.F
    peer["design"] = model.H
    peer["selection"] = np.eye(n)
    peer["state_cov"] = model.Q
    peer["obs_cov"] = model.R if model.R.ndim == 2 else model.R.transpose(1, 2, 0)
    peer.initialize_known(mean, covariance)
    if smooth:
        return Contender(lambda: peer.ssm.smooth().smoothed_state.T)
    return Contender(lambda: peer.ssm.filter().filtered_state.T)


def with_dynamax(model, z, share=1.0, smooth=False):
    import jax
    import jax.numpy as jnp
    from dynamax.linear_gaussian_ssm import lgssm_filter, lgssm_smoother

    jax.config.update("jax_enable_x64", True)
    params = _dynamax_params(model)

    def one(rows):
        if smooth:
            return lgssm_smoother(params, rows).smoothed_means
        return lgssm_filter(params, rows).filtered_means

    rows = first_part(z, share)
    data = jnp.array(rows.transpose(2, 0, 1)) if z.ndim == 3 else jnp.array(rows)
    compiled = jax.jit(jax.vmap(one) if z.ndim == 3 else one)

    def run():
        x = np.asarray(compiled(data).block_until_ready())
        return x.transpose(1, 2, 0) if z.ndim == 3 else x

    return Contender(run, len(rows) / len(z))


def _dynamax_params(model):
    import jax
    import jax.numpy as jnp
    from dynamax.linear_gaussian_ssm import LinearGaussianSSM

    mean, covariance = first_prediction(model)
    n, m = len(mean), len(model.H)
    params, _ = LinearGaussianSSM(n, m).initialize(
        jax.random.PRNGKey(0),
        initial_mean=jnp.array(mean),
        initial_covariance=jnp.array(covariance),
        dynamics_weights=jnp.array(model.F),
        dynamics_covariance=jnp.array(model.Q),
        emission_weights=jnp.array(model.H),
        emission_covariance=jnp.eye(m),
    )
    return params._replace(
        emissions=params.emissions._replace(cov=jnp.array(model.R), bias=jnp.zeros(m)),
        dynamics=params.dynamics._replace(bias=jnp.zeros(n)),
    )


def one_by_one(contender, model, z, runs, **options):
    """A library that takes one run: on a few of the runs, scaled."""
    parts = [contender(model, z[:, :, r], **options) for r in range(runs)]

    def run():
        return np.stack([part.run() for part in parts], axis=-1)

    return Contender(run, parts[0].share * runs / z.shape[2])


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
    from dynamax.nonlinear_gaussian_ssm import ParamsNLGSSM, extended_kalman_filter

    jax.config.update("jax_enable_x64", True)

    def f(x):
        return jnp.array([x[0] + p.dt * x[2] * jnp.cos(x[1]), x[1], x[2]])

    x, F = model.f(model.x0, None), model.F(model.x0, None)
    params = ParamsNLGSSM(
        initial_mean=jnp.array(x),
        initial_covariance=jnp.array(F @ model.P0 @ F.T + model.Q),
        dynamics_function=f,
        dynamics_covariance=jnp.array(model.Q),
        emission_function=lambda x: x[:1],
        emission_covariance=jnp.array(model.R),
    )
    data = jnp.array(z.transpose(2, 0, 1))
    compiled = jax.jit(jax.vmap(lambda rows: extended_kalman_filter(params, rows).filtered_means))
    return Contender(lambda: np.asarray(compiled(data).block_until_ready()).transpose(1, 2, 0))
