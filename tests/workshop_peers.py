"""Chapter 7: its own code cells, and the same filters by filterpy and statsmodels."""

import contextlib
import json
import os
from types import SimpleNamespace

import numpy as np
from conftest import ROOT
from filterpy.kalman import ExtendedKalmanFilter, KalmanFilter
from statsmodels.tsa.statespace.mlemodel import MLEModel

CHAPTER = ROOT / "notebooks" / "07_workshop.ipynb"
ALWAYS = ("imports", "discretise", "judge")
CASES = {
    "bus": ("bus-model", "bus-run"),
    "room": ("room-run", "room-judged"),
    "battery": ("battery-model", "battery-run"),
    "gps": ("gps-model", "gps-run"),
    "lift": ("lift-read", "lift-models", "lift-fit", "lift-truth"),
}


def sources():
    """{id: code} of the chapter."""
    cells = json.loads(CHAPTER.read_text(encoding="utf-8"))["cells"]
    return {cell["id"]: "".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"}


def run_case(name):
    """All names that the cells of a case leave behind, run where a reader runs them."""
    code, names = sources(), {}
    with contextlib.chdir(CHAPTER.parent), open(os.devnull, "w") as silence:
        with contextlib.redirect_stdout(silence):
            for cell in (*ALWAYS, *CASES[name]):
                exec(code[cell], names)
    return SimpleNamespace(**names)


def each_step(M, steps):
    """(T, ., .) of a matrix that is the same at every step, or that is not."""
    return np.broadcast_to(M, (steps, *M.shape[-2:]))


def by_filterpy(model, z, u=None, limit=np.inf):
    """x (T, n) and P (T, n, n); a reading with y^2/S above the limit counts as missing."""
    T, n = len(z), len(model.x0)
    F, H, Q, R = (each_step(M, T) for M in (model.F, model.H, model.Q, model.R))
    peer = KalmanFilter(dim_x=n, dim_z=1)
    peer.x, peer.P = model.x0.reshape(n, 1), np.array(model.P0)
    found = []
    for k in range(T):
        B_u = None if u is None else model.B * u[k]
        peer.predict(F=F[k], Q=Q[k], B=None if u is None else np.eye(n), u=B_u)
        y = z[k] - H[k] @ peer.x[:, 0]
        S = np.diag(H[k] @ peer.P @ H[k].T + R[k])
        heard = y**2 <= limit * S  # no for NaN
        if heard.any():
            column = z[k][heard].reshape(-1, 1)
            peer.update(column, R=R[k][np.ix_(heard, heard)], H=H[k][heard])
        found.append((peer.x[:, 0].copy(), peer.P.copy()))
    return tuple(np.array(column) for column in zip(*found))


def extended_by_filterpy(model, f, h, H, F, z, u):
    """x (T, 1) and P (T, 1, 1), and the H (T, 1, 1), h (T, 1) and x_pred (T, 1) on the way."""
    peer = ExtendedKalmanFilter(dim_x=1, dim_z=1)
    peer.x, peer.P = model.x0.reshape(1, 1), np.array(model.P0)
    peer.Q, peer.R = np.array(model.Q), np.array(model.R)
    found = []
    for k, z_k in enumerate(z):
        peer.F = np.array(F(peer.x[:, 0], u[k]))
        after = f(peer.x[:, 0], u[k])
        peer.predict_x = lambda u, after=after: setattr(peer, "x", after.reshape(1, 1))
        peer.predict()
        x_pred = peer.x[:, 0].copy()
        tangent = np.atleast_2d(H(x_pred, u[k]))
        curve = h(x_pred, u[k])
        peer.update(
            z_k.reshape(1, 1),
            HJacobian=lambda x, tangent=tangent: tangent,
            Hx=lambda x, curve=curve: curve.reshape(1, 1),
        )
        found.append((peer.x[:, 0].copy(), peer.P.copy(), tangent, curve, x_pred))
    return tuple(np.array(column) for column in zip(*found))


def statsmodels_of(model, z, u=None, H=None, offset=None):
    """Their representation of a LinearModel, or of the tangents H (T, m, n) with an offset (T, m)
    at every step."""
    T, n = len(z), len(model.x0)
    peer = MLEModel(z, k_states=n, k_posdef=n, tolerance=0)
    F = each_step(getattr(model, "F", np.eye(n)), T)
    Q, R = each_step(model.Q, T), each_step(model.R, T)
    H = each_step(model.H if H is None else H, T)
    moved = np.zeros((T, n)) if u is None else (model.B @ np.reshape(u, (1, T))).T
    after = [*range(1, T), T - 1]  # theirs leads from a step to the next
    peer["transition"], peer["state_cov"] = (M[after].transpose(1, 2, 0) for M in (F, Q))
    peer["design"], peer["obs_cov"] = H.transpose(1, 2, 0), R.transpose(1, 2, 0)
    peer["state_intercept"] = moved[after].T
    if offset is not None:
        peer["obs_intercept"] = offset.T
    peer["selection"] = np.eye(n)
    first = F[0] @ model.x0 + moved[0]
    peer.initialize_known(first, F[0] @ model.P0 @ F[0].T + Q[0])
    return peer


def by_statsmodels(*arguments, **names):
    """x (T, n) and P (T, n, n)."""
    theirs = statsmodels_of(*arguments, **names).ssm.filter()
    return theirs.filtered_state.T, theirs.filtered_state_cov.transpose(2, 0, 1)
