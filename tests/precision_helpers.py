"""How far results lie from exact ones, and what statsmodels says."""

import numpy as np
from statsmodels.tsa.statespace.mlemodel import MLEModel

I2, ZERO2 = np.eye(2), np.zeros((2, 2))


def data(model, T, gaps):
    rng = np.random.default_rng(T)
    z = rng.normal(size=(T, len(model.H)))
    if gaps:
        z[:7] = z[-9:] = z[T // 2 : T // 2 + 12] = np.nan
        z[rng.random(z.shape) < 0.1] = np.nan
    return z


def relative(ours, exact):
    """The largest error of each column relative to its largest value."""
    size = np.abs(exact).max(axis=0)
    return (np.abs(ours - exact).max(axis=0) / np.where(size > 0, size, 1)).max()


def in_sigmas(ours, exact):
    """The largest error of a covariance, its entries relative to their two standard deviations."""
    sigma = np.sqrt(np.maximum(np.einsum("kii->ki", exact), 0))
    size = sigma[:, :, np.newaxis] * sigma[:, np.newaxis]
    error = np.abs(ours - exact)
    return (error[size > 1e-300] / size[size > 1e-300]).max(initial=0)


def with_statsmodels(model, z, first=None):
    """Their smoother; first is a model whose F and Q lead to the first step (None: the model)."""
    n = len(model.x0)
    peer = MLEModel(z, k_states=n, k_posdef=n, tolerance=0)
    for name, M in (
        ("transition", model.F),
        ("design", model.H),
        ("state_cov", model.Q),
        ("obs_cov", model.R),
    ):
        peer[name] = M if M.ndim == 2 else M.transpose(1, 2, 0)
    peer["selection"] = np.eye(n)
    first = first or model
    F, Q = (M if M.ndim == 2 else M[0] for M in (first.F, first.Q))
    peer.initialize_known(F @ model.x0, F @ model.P0 @ F.T + Q)
    peer.ssm.tolerance = 0
    return peer.smooth([], return_ssm=True)


def is_covariance(P):
    P = np.asarray(P)
    eigenvalues = np.linalg.eigvalsh(P)
    assert np.array_equal(P, P.swapaxes(-1, -2))
    assert (np.einsum("...ii->...i", P) >= 0).all()
    assert (eigenvalues[..., 0] >= -1e-15 * eigenvalues[..., -1]).all()
