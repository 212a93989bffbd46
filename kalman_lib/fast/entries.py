"""The Kalman step entry by entry: a vector is a list, a symmetric matrix a list of rows.

An entry is a plain number (one series, in Python floats) or an array (many series side by side, one
number each), and the same lines serve both. A product of 2 x 2 matrices costs NumPy a microsecond,
these few multiplications a tenth of it; with 1,000 series side by side every multiplication is one
call for all of them. F and H are kept sparse, so that their zeros and ones, which most models have,
cost nothing.
"""

from itertools import chain

import numpy as np


def sparse(M):
    """A matrix as rows of (column, entry), without its zeros; None stands for the entry 1."""

    def is_number(entry, value):
        return not isinstance(entry, np.ndarray) and entry == value

    rows = []
    for row in M:
        entries = [(j, entry) for j, entry in enumerate(row) if not is_number(entry, 0)]
        rows.append([(j, None if is_number(entry, 1) else entry) for j, entry in entries])
    return rows


def dot(row, x):
    """A sparse row times the vector x."""
    total = None
    for j, entry in row:
        term = x[j] if entry is None else entry * x[j]
        total = term if total is None else total + term
    return 0.0 if total is None else total


def symmetric(n, entry):
    """The symmetric n x n matrix whose upper triangle is entry(i, j)."""
    M = [[None] * n for _ in range(n)]
    for i in range(n):
        for j in range(i, n):
            M[i][j] = M[j][i] = entry(i, j)
    return M


def predict(P, F, Q):
    """P_pred = F P F' + Q; F sparse, Q rows of entries, with None for 0."""
    columns = P  # P is symmetric: its rows are its columns
    FP = [[dot(row, column) for column in columns] for row in F]

    def entry(i, j):
        value = dot(F[j], FP[i])
        return value if Q[i][j] is None else value + Q[i][j]

    return symmetric(len(F), entry)


def update(P, h, R, heard=None):
    """One sensor, z = h x + v: P after it, its gain k (n entries) and S.

    h is a sparse row, R its variance; heard (None: everywhere) is an array that says which of the
    series hear the sensor; elsewhere k = 0.
    """
    n = len(P)
    Ph = [dot(h, row) for row in P]
    S = dot(h, Ph) + R
    k = [Ph_i / S for Ph_i in Ph]
    if heard is not None:
        k = [k_i * heard for k_i in k]
    if len(h) != 1:
        return symmetric(n, lambda i, j: P[i][j] - k[i] * Ph[j]), k, S
    # The sensor sees one state s only. Column s of P, times h_s, is P h' = P_pred h' R / S = k R:
    # that needs no small difference of large numbers, however small R is.
    s, h_s = h[0]
    k_R = [k_i * R if h_s is None else k_i * R / h_s for k_i in k]
    if heard is not None:
        k_R = [np.where(heard, k_R_i, P[i][s]) for i, k_R_i in enumerate(k_R)]

    def entry(i, j):
        if s in (i, j):
            return k_R[j if i == s else i]
        return P[i][j] - k[i] * Ph[j]

    return symmetric(n, entry), k, S


def floats(a):
    """The rows of an array as Python numbers, not all at once: a million would take a while."""
    if len(a) <= 500:
        return a.tolist()
    return chain.from_iterable(a[k : k + 500].tolist() for k in range(0, len(a), 500))
