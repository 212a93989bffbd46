"""A Kalman filter and a smoother with 150 digits: what the library's numbers are compared with.

Written down from the textbook (the smoother in the form of Bryson and Frazier, which inverts S
alone), in mpmath; it shares no line with kalman_lib. Arrays in, arrays out."""

import mpmath
import numpy as np

mpmath.mp.prec = 500


def _matrix(M):
    return mpmath.matrix(np.atleast_2d(np.asarray(M, dtype=float)).tolist())


def _at(M, k):
    return M[k] if np.ndim(M) == 3 else M


def _array(columns):
    return np.array([[float(entry) for entry in M] for M in columns])


def filter_and_smooth(model, z, u=None):
    """x, P, x_pred, P_pred of the filter, x_s, P_s of the smoother and the log-likelihood of z (T,
    m), exact."""
    n, T = len(model.x0), len(z)
    x, P = _matrix(model.x0).T, _matrix(model.P0)
    steps, likelihood = [], mpmath.mpf(0)
    for k in range(T):
        F, Q, H, R = (_matrix(_at(M, k)) for M in (model.F, model.Q, model.H, model.R))
        x_pred, P_pred = F * x, F * P * F.T + Q
        if u is not None:
            x_pred += _matrix(_at(model.B, k)) * _matrix(u[k]).T
        heard = [
            i for i in range(len(z[k])) if np.isfinite(z[k][i]) and np.isfinite(float(R[i, i]))
        ]
        x, P, told = x_pred, P_pred, None
        if heard:
            H = mpmath.matrix([[H[i, j] for j in range(n)] for i in heard])
            R = mpmath.matrix([[R[i, j] for j in heard] for i in heard])
            S = H * P_pred * H.T + R
            S_inverse = S**-1
            y = _matrix([[float(z[k][i])] for i in heard]) - H * x_pred
            K = P_pred * H.T * S_inverse
            x, P = x_pred + K * y, (mpmath.eye(n) - K * H) * P_pred
            told = H.T * S_inverse * y, H.T * S_inverse * H, mpmath.eye(n) - K * H
            square = (y.T * S_inverse * y)[0]
            likelihood -= (
                len(heard) * mpmath.log(2 * mpmath.pi) + mpmath.log(mpmath.det(S)) + square
            ) / 2
        steps.append((x_pred, P_pred, x, P, F, told))
    x_s, P_s = _backwards(steps, n)
    found = {
        name: _array(step[i] for step in steps)
        for i, name in enumerate(("x_pred", "P_pred", "x", "P"))
    }
    found |= {"x_s": _array(x_s), "P_s": _array(P_s)}
    shapes = {"P_pred": (T, n, n), "P": (T, n, n), "P_s": (T, n, n)}
    return {name: a.reshape(shapes.get(name, a.shape)) for name, a in found.items()} | {
        "likelihood": float(likelihood)
    }


def _backwards(steps, n):
    """The smoothed x and P of every step."""
    r, N = mpmath.zeros(n, 1), mpmath.zeros(n, n)
    x_s, P_s = [], []
    for _, _, x, P, F, told in reversed(steps):
        x_s.append(x + P * r)
        P_s.append(P - P * N * P)
        if told is not None:
            score, information, left = told
            r, N = score + left.T * r, information + left.T * N * left
        r, N = F.T * r, F.T * N * F
    return x_s[::-1], P_s[::-1]
