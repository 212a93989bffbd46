"""A long series whose R changes or whose sensors fall silent: many short series side by side.

Serves the row "6-state attitude, R in time" of the bench (without it that row would be 5 times as
slow, behind dynamax).

As in scan.py the blocks run side by side as soon as their starts are known. A first round finds
these: it filters every block as if its start were known exactly (x = 0, P = 0), which ends at b
with covariance C, and carries along what the end owes to the start, x_end = A x_start + b, and what
the measurements say about the start, an information J with J x_start = g. Then, from block to
block: the start, combined with what its own block says about it, gives the end, which is the start
of the next block.
"""

import math

import numpy as np

from . import entries

LONG = 2000  # steps from which on it is worth it


def filter_blocks(s):
    """x (T, n) and P (T, n, n) of a series with one sensor, or None: not exact, or more sensors."""
    if len(s.H) != 1:
        return None
    lanes = _Lanes(s)
    starts = _starts(s, *_first_round(lanes))
    x, P = _second_round(lanes, *starts)
    if not _joined(x, P, *starts):
        return None  # rounding: then one step after the other
    T, n = len(s.z), len(s.x0)
    x = x.transpose(2, 0, 1).reshape(-1, n)
    P = P.transpose(3, 0, 1, 2).reshape(-1, n, n)
    return x[:T], P[:T]


class _Lanes:
    """The data of a series as (length, blocks): one row for a step of all blocks."""

    def __init__(self, s):
        self.T, self.n = len(s.z), len(s.x0)
        self.length = max(64, 2 * math.isqrt(self.T) // 3)
        self.blocks = -(-self.T // self.length)
        self.F = entries.sparse(s.F.tolist())
        self.h = entries.sparse(s.H.tolist())[0]
        self.Q = [[q or None for q in row] for row in s.Q.tolist()]
        self.z = self.side_by_side(np.nan_to_num(s.z[:, 0]))
        self.R = self.side_by_side(np.broadcast_to(s.R, (self.T, 1, 1))[:, 0, 0])
        self.drive = None
        if s.drive is not None:
            self.drive = [self.side_by_side(column) for column in s.drive.T]
        self.heard = None if s.silent is None else self.side_by_side(~s.silent[:, 0])

    def side_by_side(self, column):
        """(T,) -> (length, blocks); what the last block lacks is its last value."""
        padding = np.repeat(column[-1:], self.blocks * self.length - self.T)
        rows = np.concatenate([column, padding]).reshape(self.blocks, self.length)
        return np.ascontiguousarray(rows.T)

    def predict(self, k, x):
        """F x + B u at step k of every block."""
        x = [entries.dot(row, x) for row in self.F]
        if self.drive is not None:
            x = [x_i + drive[k] for x_i, drive in zip(x, self.drive)]
        return x

    def update(self, k, x, P):
        """The measurement of step k -> P, K, S, y, and where it was heard (None: everywhere)."""
        heard = None if self.heard is None or self.heard[k].all() else self.heard[k]
        P, K, S = entries.update(P, self.h, self.R[k], heard)
        return P, K, S, self.z[k] - entries.dot(self.h, x), heard


def _first_round(lanes):
    """A, b, C, g and J of every block: (blocks, n, n), (blocks, n, 1), ..."""
    n, zero, one = lanes.n, np.zeros(lanes.blocks), np.ones(lanes.blocks)
    x, g = [zero] * n, [zero] * n
    P, J = ([[zero] * n for _ in range(n)] for _ in range(2))
    A = [[one if i == j else zero for i in range(n)] for j in range(n)]  # its columns
    for k in range(lanes.length):
        x = lanes.predict(k, x)
        P = entries.predict(P, lanes.F, lanes.Q)
        A = [[entries.dot(row, column) for row in lanes.F] for column in A]
        P, K, S, y, heard = lanes.update(k, x, P)
        hA = [entries.dot(lanes.h, column) for column in A]
        hA_S = [a / S if heard is None else a / S * heard for a in hA]
        g = [g_i + a * y for g_i, a in zip(g, hA_S)]
        J = _learn(J, hA_S, hA)
        x = [x_j + K_j * y for x_j, K_j in zip(x, K)]
        A = [[a - K_j * hA_j for a, K_j in zip(column, K)] for column, hA_j in zip(A, hA)]
    A, C, J = (np.array(M).transpose(2, 0, 1) for M in (A, P, J))
    b, g = (np.array(v).T[..., np.newaxis] for v in (x, g))
    return A.swapaxes(1, 2), b, C, g, J


def _learn(J, hA_S, hA):
    """J + (h A)' h A / S, symmetric."""
    return entries.symmetric(len(J), lambda i, j: J[i][j] + hA_S[i] * hA[j])


def _starts(s, A, b, C, g, J):
    """x (n, blocks) and P (n, n, blocks) at the start of every block."""
    x, P, I = s.x0[:, np.newaxis], s.P0, np.eye(len(s.x0))
    starts = []
    for A_k, b_k, C_k, g_k, J_k in zip(A, b, C, g, J):
        starts.append((x[:, 0], P))
        P = np.linalg.solve(I + P @ J_k, P)  # (P^-1 + J)^-1
        x = A_k @ (x + P @ (g_k - J_k @ x)) + b_k
        P = A_k @ P @ A_k.T + C_k
        P = (P + P.T) / 2
    all_x, all_P = (np.array(column) for column in zip(*starts))
    return all_x.T, all_P.transpose(1, 2, 0)


def _second_round(lanes, x, P):
    """The filter, all blocks side by side -> x (length, n, blocks), P (length, n, n, blocks)."""
    n = lanes.n
    all_x = np.empty((lanes.length, n, lanes.blocks))
    all_P = np.empty((lanes.length, n, n, lanes.blocks))
    x, P = list(x), [list(row) for row in P]
    for k in range(lanes.length):
        x = lanes.predict(k, x)
        P, K, _, y, _ = lanes.update(k, x, entries.predict(P, lanes.F, lanes.Q))
        x = [x_i + K_i * y for x_i, K_i in zip(x, K)]
        for i in range(n):
            all_x[k, i] = x[i]
            for j in range(n):
                all_P[k, i, j] = P[i][j]
    return all_x, all_P


def _joined(all_x, all_P, x, P):
    """Does every block end where the next one starts?"""
    sigma = np.sqrt(np.abs(np.einsum("iib->ib", P[:, :, 1:])))
    wrong_P = np.abs(all_P[-1, :, :, :-1] - P[:, :, 1:]) > 1e-13 * sigma[:, np.newaxis] * sigma
    size = np.abs(all_x).max(axis=(0, 2))[:, np.newaxis]
    wrong_x = np.abs(all_x[-1, :, :-1] - x[:, 1:]) > 1e-13 * size
    return not (wrong_P.any() or wrong_x.any())
