"""Chapter 4: a ship whose coefficients are known, and the source's own listing."""

import numpy as np

from kalman_lib import kalman_filter
from kalman_lib.papers import ship

TRUE = ship.Params(
    c=0.03, a1=1.7, a2=-0.72, Q=0.0025, Q_copy=0, R=0.01, x0=1.5
)  # poles 0.9 and 0.8, mean 1.5 m/s


def towing_run(seed=2018, **changes):
    t, run = ship.towing_run(np.random.default_rng(seed), **changes)
    return t, run.z[:, 0], run.x[:, 0]


def filtered(z, p):
    return kalman_filter(ship.model(p), z, u=np.ones(len(z)))


def listing(y):
    """The arithmetic of the source's listing, step by step with its own letters: invented rows,
    inv, predict, update."""
    x1, x2 = np.zeros(len(y)), np.zeros(len(y))
    x1[1] = y[0]
    for k in range(2, len(y)):
        x1[k], x2[k] = y[k - 1], y[k - 2]
    X = np.column_stack([np.ones(len(y)), x1, x2])
    pi = np.linalg.inv(X.T @ X) @ X.T @ y
    Q, R = np.eye(2) * 0.0001, np.eye(1) * 0.01
    A, F, H = np.array([[pi[1], pi[2]], [1, 0]]), np.array([[pi[0]], [0]]), np.array([[1, 0]])
    xmin, Pmin, zest = np.zeros((2, 1)), 0.01 * np.eye(2), []
    for value in y:
        x = A @ xmin + F
        P = A @ Pmin @ A.T + Q
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        x = x + K @ (value - H @ x)
        P = (np.eye(2) - K @ H) @ P
        zest.append((H @ x).item())
        xmin, Pmin = x, P
    return pi, np.array(zest)
