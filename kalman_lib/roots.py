"""Covariances as products P = L L' of their roots: rounding never makes a variance negative.

The square-root filters of Bierman (1977). A root L (n, n) is to P what a standard deviation is to a
variance: it has twice as many digits to spare, and its square is never negative. Nothing but R is
ever inverted.
"""

from typing import NamedTuple

import numpy as np

EPSILON = np.finfo(float).eps


class Covariance(np.ndarray):
    """A covariance P = L L' that remembers its root L: handed from step to step, P loses no digits.

    It is an array like any other; what is computed from it is a plain array.
    """

    root = None

    @classmethod
    def of(cls, P, root=None):
        """P (n, n), read-only, with its root L; without one it is computed."""
        covariance = np.array(P, dtype=float).view(cls)
        covariance.root = root_of(P) if root is None else root
        covariance.setflags(write=False)
        return covariance

    @classmethod
    def nearest(cls, P):
        """P (n, n) without what rounding has left in it: symmetric, and no variance below 0."""
        P = (P + P.T) / 2
        eigenvalues = np.linalg.eigvalsh(P)
        if eigenvalues[0] < -1e-13 * eigenvalues[-1]:
            return cls.from_root(root_of(P))
        return cls.of(P)

    @classmethod
    def from_root(cls, L):
        """L L', with its root L (n, n)."""
        P = L @ L.T
        return cls.of((P + P.T) / 2, L)

    def __array_wrap__(self, array, context=None, return_scalar=False):
        array = np.asarray(array)
        return array[()] if return_scalar else array

    def __getitem__(self, index):
        return np.asarray(self)[index]

    def __repr__(self):
        return repr(np.asarray(self))


def root_of(P):
    """L (n, n) with L L' = P, for a P that may be singular: what is rounding alone counts as 0."""
    if isinstance(P, Covariance) and P.root is not None:
        return P.root
    P = np.asarray(P, dtype=float)
    sigma = np.sqrt(np.maximum(np.diag(P), 0))
    scale = np.where(sigma == 0, 1, sigma)
    eigenvalues, vectors = np.linalg.eigh(P / np.outer(scale, scale))
    rounding = 4 * len(P) * EPSILON
    lengths = np.sqrt(np.where(eigenvalues > rounding, eigenvalues, 0))
    return sigma[:, np.newaxis] * vectors * lengths


def add_up(*parts):
    """The covariance A A' + B B' + ... of the parts A (n, .), B (n, .), ..."""
    L, _ = rotated(np.hstack(parts))
    return Covariance.from_root(L)


def rotated(columns):
    """For columns C (n, p): L (n, n), lower triangular, and a rotation T (p, p) with C T = [L 0].

    So L L' = C C', and no square is computed on the way. The reflections are Householder's (1958);
    each time the row with the largest entry comes first, which keeps the digits of small rows (Cox
    and Higham, 1998), and what is exactly 0 stays 0.
    """
    n, p = columns.shape
    rows = np.hstack([columns.T, np.eye(p)])
    for j in range(n):
        first = j + np.argmax(np.abs(rows[j:, j]))
        rows[[j, first]] = rows[[first, j]]
        if rows[j, j] != 0:
            # the length of v does not matter, and its square must not vanish
            v = rows[j:, j] / rows[j, j]
            v[0] += np.sqrt(v @ v)
            rows[j:] -= np.outer(v, (2 / (v @ v)) * (v @ rows[j:]))
            rows[j + 1 :, j] = 0
    return rows[:n, :n].T, rows[:, n:].T


def innovation_covariance(H, P_pred, R):
    """S = H P_pred H' + R (m, m)."""
    HL = H @ root_of(P_pred)
    S = HL @ HL.T + R
    return (S + S.T) / 2


def gain(P_pred, H, R):
    """The gain K (n, m) = P_pred H' S^-1, and P (n, n) = (I - K H) P_pred after the measurement.

    The sensors come one after the other, each in units in which its noise has the variance 1 and
    disturbs no other one. So nothing is subtracted that could become negative, and nothing but R is
    inverted.
    """
    L = root_of(P_pred)
    W = noise_units(R)
    K = np.zeros((len(L), len(H)))
    for i, h in enumerate(W @ H):
        a, S, A = one_sensor(L, h)
        k = L @ a / S
        K -= np.outer(k, h @ K)  # what the sensors before have already told
        K[:, i] += k
        L = L @ A
    return K @ W, Covariance.from_root(L)


def noise_units(R):
    """W (m, m) with W R W' = I: the sensors W z have noise of variance 1, independent of others."""
    if R.size == 1:
        return 1 / np.sqrt(R)
    return np.linalg.inv(np.linalg.cholesky(R))


def one_sensor(L, h):
    """A sensor z = h x + v, v ~ N(0, 1), and P_pred = L L' -> a = L' h (n,), S and A (n, n).

    S = h P_pred h' + 1; A is triangular, and L A the root of P = P_pred - P_pred h' h P_pred / S
    (Carlson, 1973).
    """
    a = L.T @ h
    S = 1 + np.cumsum(a * a)  # as it grows, column by column of L
    S_before = np.append(1.0, S[:-1])
    told = np.triu(np.outer(a, a / S_before), 1)
    A = (np.eye(len(L)) - told) * np.sqrt(S_before / S)
    return a, S[-1], A


def one_after_another(L, y, H, R):
    """For each sensor that was heard (y (m,) not NaN): a, S, A of `one_sensor`, and its own y.

    That is its y once the sensors before it are known. L (n, n) is the root of P_pred; y and S are
    in the units of `noise_units`.
    """
    heard = np.isfinite(y)
    if not heard.any():
        return
    W = noise_units(R[np.ix_(heard, heard)])
    change = np.zeros(len(L))  # of x, by the sensors before
    for h, y_i in zip(W @ H[heard], W @ y[heard]):
        a, S, A = one_sensor(L, h)
        y_i = y_i - h @ change
        yield a, S, A, y_i
        change = change + L @ a * (y_i / S)
        L = L @ A


class StepAgain(NamedTuple):
    """What one step did to the root of P, and what it heard.

    rotation (n, n + n) turned [F L, root of Q] when it predicted; x = x_pred + L_pred g,
    P = L_pred A A' L_pred' and its root L = L_pred A came with the measurement, whose sensors one
    after the other had the innovations [(S, y), ...], in the units of `noise_units`.
    """

    rotation: np.ndarray
    g: np.ndarray
    A: np.ndarray
    L: np.ndarray
    innovations: list


def steps_again(result):
    """Run over a FilterResult once more, by the roots -> a StepAgain for each of its steps."""
    L, Q_before, Q_root = result.start, None, None
    for F, Q, H, R, y in zip(result.F, result.Q, result.H, result.R, result.y):
        if Q_before is None or not np.array_equal(Q, Q_before):  # most often Q stays
            Q_before, Q_root = Q, root_of(Q)
        L_pred, rotation = rotated(np.hstack([F @ L, Q_root]))
        g, A = np.zeros(len(L)), np.eye(len(L))
        innovations = []
        for a, S, A_i, y_i in one_after_another(L_pred, y, H, R):
            g = g + A @ a * (y_i / S)
            A = A @ A_i
            innovations.append((S, y_i))
        L = L_pred @ A
        yield StepAgain(rotation[: len(L)], g, A, L, innovations)
