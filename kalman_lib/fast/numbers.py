"""One state and one sensor in plain Python numbers, which for single numbers beat NumPy by far.

Serves the rows "gyro" and "scalar series" of the bench, and every filter of chapters 2 and 3.
"""

from itertools import repeat

import numpy as np

from .entries import floats
from .scan import LONG, STEADY


def filter_number(s):
    """x (k, 1) and P (k, 1, 1): all steps, or in a long series those that it takes P to settle."""
    F, H, Q, x, P = (float(M.flat[0]) for M in (s.F, s.H, s.Q, s.x0, s.P0))
    drive = repeat(0.0) if s.drive is None else floats(s.drive[:, 0])
    R = repeat(float(s.R[0, 0])) if s.R.ndim == 2 else floats(s.R[:, 0, 0])
    states, variances = [], []
    may_end = not s.varies and len(s.z) >= LONG
    for z_k, drive_k, R_k in zip(floats(s.z[:, 0]), drive, R):
        before = P
        x = F * x + drive_k
        P = F * P * F + Q
        if z_k == z_k:  # not NaN
            S = H * P * H + R_k
            x += P * H / S * (z_k - H * x)
            P *= R_k / S  # (1 - K H) P, without a difference that cancels
        states.append(x)
        variances.append(P)
        if may_end and P == before and abs(F * (1 - P * H * H / R_k)) <= STEADY:
            break  # P depends on the P before it only: from here on it stays
    return np.array(states)[:, np.newaxis], np.array(variances)[:, np.newaxis, np.newaxis]
