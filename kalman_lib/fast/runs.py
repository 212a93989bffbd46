"""Many runs of one linear model: P, S and K hold no data, so all runs share them.

Serves the rows "gyro Monte Carlo" and "1,000 x 1,000" of the bench, and every study of
montecarlo.py.
"""

import numpy as np

from . import rounding, states
from .lazy import Gains, repeat_last, result_of
from .scan import STEADY, radius

MANY = 8  # steps of all runs that one product of matrices does


def filter_runs(s):
    """The FilterResult of z (T, m, N), or None: rounding, or runs that hear different sensors."""
    if s.R.ndim == 3:
        return None
    nothing = s._replace(z=np.zeros(s.z.shape[:2]), drive=None, x0=np.zeros(len(s.x0)))
    parts = nothing.parts()
    found = [states.filter_part(part) for _, part in parts]
    if any(answer is None for answer in found):
        return None
    gains = Gains(s, states.together(s, parts, [P for _, P in found]))
    if not rounding.well_conditioned(gains.S):
        return None
    I_KH = np.eye(len(s.x0)) - gains.K @ s.H
    if radius(I_KH[-1] @ s.F) > STEADY:
        return None  # 1 - K has lost the digits of a small K
    drive = None
    if s.drive is not None:
        drive = np.einsum("kij,kj->ki", repeat_last(I_KH, len(s.z)), s.drive)
    x = np.empty((len(s.z), len(s.x0), s.z.shape[2]))
    z = s.z
    gains.s = s = s._replace(z=np.empty_like(z))  # the result keeps numbers of its own
    steps(I_KH @ s.F, gains.K, z, drive, s.x0[:, np.newaxis], x, copy=s.z)
    if not np.isfinite(x[-1]).all():
        return None  # a NaN in z would still be there
    largest = np.abs(x[::MANY]).max(axis=(0, 2))
    y = np.sqrt(np.diag(gains.S[-1]))
    near = rounding.near(s, largest, np.abs(x[-1]).mean(axis=1), y, gains.P[-1])
    return result_of(gains, x) if near else None


@np.errstate(over="ignore", invalid="ignore")  # who calls looks at the end
def steps(A, K, z, drive, start, x, backwards=False, copy=None):
    """x_k = A_k x_{k-1} + K_k z_k + drive_k for all runs, into x (T, n, N).

    z (T, m, N), drive (T, n) or None, start (n, N) or (n, 1). A (k, n, n) and K (k, n, m): at later
    steps they are the last one. Backwards: x_k = A_k x_{k+1} + K_k z_k + drive_k, from the last
    step to the first. copy: an array that z is copied into.

    Many multiplications by a number read and write all runs again and again. One product of
    matrices does it for MANY steps: the states after each of them are M [x; z of the first; z of
    the second; ...; 1].
    """
    (T, n, runs), m = x.shape, z.shape[1]
    W = np.empty((n + MANY * m + 1, runs))
    before = np.broadcast_to(start, (n, runs))
    blocks = [range(first, min(first + MANY, T)) for first in range(0, T, MANY)]
    known, M = None, None
    for block in reversed(blocks) if backwards else blocks:
        at = np.minimum(block, len(A) - 1)
        if (at[0], at[-1], len(block)) != known or drive is not None:
            pushes = None if drive is None else drive[block.start : block.stop]
            M = _product(A[at], K[at], pushes, backwards)
            known = at[0], at[-1], len(block)
        W_block = W[: M.shape[1]]
        W_block[:n] = before
        part = z[block.start : block.stop]
        if copy is not None:
            copy[block.start : block.stop] = part
            part = copy[block.start : block.stop]
        W_block[n : n + len(block) * m] = part.reshape(-1, runs)
        if drive is not None:
            W_block[-1] = 1
        x_block = x[block.start : block.stop].reshape(-1, runs)
        np.dot(M, W_block, out=x_block)
        before = x_block[:n] if backwards else x_block[-n:]


def _product(A, K, drive, backwards):
    """M (steps n, n + steps m [+ 1]) of one block; the last column is what is owed to the drive."""
    count, n, m = K.shape
    row = np.zeros((n, n + count * m + (drive is not None)))
    row[:, :n] = np.eye(n)
    M = np.empty((count, *row.shape))
    for j in reversed(range(count)) if backwards else range(count):
        row = A[j] @ row
        row[:, n + j * m : n + (j + 1) * m] += K[j]
        if drive is not None:
            row[:, -1] += drive[j]
        M[j] = row
    return M.reshape(count * n, -1)
