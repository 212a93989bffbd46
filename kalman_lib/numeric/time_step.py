"""From continuous time to a step: exp(A dt) and the noise that gathers on the way."""

import numpy as np


def time_step(A, Qc, Bc, dt):
    """F, Q, B of one step: their power series for a step short enough, which is then doubled.

    The derivatives of exp(A s) Qc exp(A s)' at s = 0 are M, A M + M A', and so on: every entry is
    summed for itself, so that dt^7 beside dt keeps its digits.
    """
    size = np.abs(A).sum(axis=0).max() * dt
    doublings = max(0, int(np.ceil(np.log2(max(2 * size, 1)))))
    h = dt / 2**doublings
    F = np.zeros_like(A)
    Q = np.zeros_like(A)
    B = np.zeros_like(Bc)
    power, M, drive = np.eye(len(A)), Qc * h, Bc * h  # the next terms
    for k in range(1, 40 + 2 * len(A)):
        F = F + power
        Q = Q + M
        B = B + drive
        power = A @ power * (h / k)
        M = (A @ M + M @ A.T) * (h / (k + 1))
        drive = A @ drive * (h / (k + 1))
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(doublings):
            Q = Q + F @ Q @ F.T
            B = B + F @ B
            F = F @ F
    return F, (Q + Q.T) / 2, B
