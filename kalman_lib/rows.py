"""The Kalman step entry by entry: a vector is a list of entries, a symmetric matrix a list of rows of entries.

An entry is a plain number (one series, in Python floats) or an array (many series side by side, one number each), and
the same lines serve both: x[0] + K[0] * y means either. That is fast where NumPy is not. A product of 2 x 2 matrices
costs NumPy a microsecond, these few multiplications a tenth of it; with 1,000 series side by side every multiplication
is one call for all of them. F and H are kept sparse, so that their zeros and ones, which most models have, cost
nothing.
"""
import numpy as np


def sparse(M):
    """A matrix as rows of (column, entry), without its zeros; None stands for the entry 1."""
    def is_number(entry, value):
        return not isinstance(entry, np.ndarray) and entry == value
    return [[(j, None if is_number(entry, 1) else entry) for j, entry in enumerate(row) if not is_number(entry, 0)]
            for row in M]


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
    FP = [[dot(row, column) for column in P] for row in F]      # P is symmetric: its rows are its columns

    def entry(i, j):
        value = dot(F[j], FP[i])
        return value if Q[i][j] is None else value + Q[i][j]
    return symmetric(len(F), entry)


def update(P, H, R, seen=None):
    """One sensor, z = H x + v: P after the measurement, the gain K (n entries) and S; H is one sparse row, R an entry.

    seen (None: everywhere) is an array that says in which of the series there is a measurement; elsewhere K = 0.
    """
    n = len(P)
    PH = [dot(H, row) for row in P]
    S = dot(H, PH) + R
    K = [PH_i / S for PH_i in PH]
    if seen is not None:
        K = [K_i * seen for K_i in K]
    if len(H) != 1:
        return joseph(P, H, R, K), K, S
    # The sensor sees one state s only. The column s of P, times H_s, is P H' = P_pred H' R / S = K R: that needs no
    # small difference of large numbers, however small R is. The other entries are those of P_pred - K H P_pred.
    s, H_s = H[0]

    def entry(i, j):
        if s not in (i, j):
            return P[i][j] - K[i] * PH[j]
        value = K[j if i == s else i] * (R if H_s is None else R / H_s)
        return value if seen is None else np.where(seen, value, P[i][j])
    return symmetric(n, entry), K, S


def joseph(P, H, R, K):
    """(I - K H) P (I - K H)' + K R K', which stays a covariance however small R is."""
    n = len(P)
    I_KH = [{i: 1.0} for i in range(n)]
    for i in range(n):
        for j, H_j in H:
            I_KH[i][j] = I_KH[i].get(j, 0.0) - (K[i] if H_j is None else K[i] * H_j)
    I_KH = [list(row.items()) for row in I_KH]
    AP = [[dot(row, column) for column in P] for row in I_KH]
    KR = [K_i * R for K_i in K]
    return symmetric(n, lambda i, j: dot(I_KH[j], AP[i]) + KR[i] * K[j])
