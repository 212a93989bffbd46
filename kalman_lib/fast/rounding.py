"""Where rounding is in the way: there the readable loop works, which keeps its digits.

A fast form multiplies covariances where the loop multiplies their roots. It loses as many digits as
a step takes from a variance (with a vague start, P0 / R = 1e9, nine of sixteen), and a filter with
a long memory adds up what is lost.
"""

import numpy as np

from ..checks import correlations
from .scan import radius

LOST = 100  # rounding errors that may add up: two digits
FAR = 1000  # times that z may be larger than the innovations, and x0 than x: three digits
ALIKE = 0.02  # the smallest eigenvalue of correlations whose inverse keeps its digits


def too_much(s, P):
    """Does a step lose too many digits? P (k, n, n) -> (k,) of True and False."""
    before = np.concatenate([s.P0[np.newaxis], P[:-1]])
    flat = before.reshape(len(P), -1).T
    variance = _squares(s.F) @ flat + np.diag(s.Q)[:, np.newaxis]  # of P_pred, (n, k)
    R = np.einsum("kii->ik", s.R[np.newaxis] if s.R.ndim == 2 else s.R[: len(P)])
    S = _squares(s.H @ s.F) @ flat + np.diag(s.H @ s.Q @ s.H.T)[:, np.newaxis] + R
    sigma = np.sqrt(np.abs(np.einsum("kii->ik", before)))
    terms_predict = (np.abs(s.F) @ sigma) ** 2  # of F P F'
    terms_S = (np.abs(s.H) @ np.sqrt(np.abs(variance))) ** 2  # of H P_pred H'
    pairs = [(terms_predict, variance), (terms_S, S), (variance, np.einsum("kii->ik", P))]
    lost = np.ones(len(P))
    for terms, result in pairs:
        for a, b in zip(terms, result):
            ratio = np.divide(a, b, out=np.where(a > 0, np.inf, 1.0), where=b > 0)
            np.maximum(lost, ratio, out=lost)
    return lost * np.sqrt(memory(s, P[-1]) / smallest_eigenvalue(P[-1:])) > LOST


def memory(s, P):
    """How many steps an error lives in a filter that has come to P."""
    return steps_alive(s.F - gain_after(s, P) @ s.H @ s.F, len(s.z))


def gain_after(s, P):
    """The gain K of the step after P."""
    P_pred = s.F @ P @ s.F.T + s.Q
    S = s.H @ P_pred @ s.H.T + (s.R if s.R.ndim == 2 else s.R[-1])
    return np.linalg.solve(S, s.H @ P_pred).T


def steps_alive(A, T):
    """1 / (1 - rho) of the matrix A that an error is multiplied with in every step; at most T."""
    return 1 / max(1 - radius(A), 1 / T)


def well_conditioned(P):
    """Can the covariances P (k, n, n) be inverted without losing digits?"""
    return smallest_eigenvalue(P) > ALIKE


def smallest_eigenvalue(P):
    """Of the correlations of P (k, n, n).

    1 where no two components tell the same, 0 where one is known or a copy.
    """
    variance = np.einsum("kii->ki", P)
    if not (variance > 0).all():
        return 1e-300
    if P.shape[1] == 1:
        return 1.0
    C = correlations(P, np.sqrt(variance))
    return max(np.linalg.eigvalsh(C)[:, 0].min(), 1e-300)


def _squares(A):
    """M (rows, n n) with M P.ravel() = diag(A P A') for every P (n, n)."""
    return (A[:, :, np.newaxis] * A[:, np.newaxis, :]).reshape(len(A), A.shape[1] ** 2)


def usual(a):
    """The middle value of each column of a (T, .): the median, but quicker."""
    return np.partition(a, len(a) // 2, axis=0)[len(a) // 2]


def near(s, largest, usual, y, P):
    """Are the data near enough to zero?

    largest and usual (n,): |x| of the states; y (m,): usual |innovations|; P: the last.
    z = 1e6 + a little has lost six digits before the filter begins, and every form of it loses
    others.
    """
    size = np.abs(s.H) @ np.maximum(largest, np.abs(s.x0))
    K = gain_after(s, P)
    alive = steps_alive(s.F - K @ s.H @ s.F, len(s.z))
    told = np.abs(K) @ size * np.sqrt(alive)  # to the states, by rounding z
    started = np.abs(s.F) @ np.abs(s.x0)  # by x0, and by the input
    if s.drive is not None:
        started = started + np.abs(s.drive).max(axis=0)
    if not (size <= FAR * y).all():
        return False
    return bool((told <= FAR * usual).all() and (started <= FAR * usual).all())
