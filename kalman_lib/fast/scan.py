"""x_k = A x_{k-1} + d_k for a long series at once: all that a filter does when it has settled."""

import math

import numpy as np

from . import entries

LONG = 500  # steps from which on it is worth it
STEADY = 0.995  # a filter that keeps more than this of an error from step to step loses digits here


def radius(A):
    """The largest |eigenvalue|: what a step leaves of an error in the long run."""
    return abs(A[0, 0]) if len(A) == 1 else np.abs(np.linalg.eigvals(A)).max()


def scan(A, d, x):
    """x_k = A x_{k-1} + d_k for the rows of d (T, n), from x (n,); the answer replaces d.

    The series is cut into blocks of equal length, which then run side by side, one line of NumPy
    for a step of all blocks. That needs the start of every block, and it is known: the end of a
    block is A^length times its start plus sum_j A^(length - 1 - j) d_j, and that sum is one matrix
    product for all blocks. Nothing is approximated.
    """
    T, n = d.shape
    length = max(1, math.isqrt(T) // (3 if n == 1 else 1))
    blocks = T // length
    powers = np.eye(n)[np.newaxis]  # I, A, A^2, ...: doubled until there are enough
    while len(powers) <= length:
        powers = np.concatenate([powers, powers @ (powers[-1] @ A)])
    whole = d[: blocks * length].reshape(blocks, length, n)
    weights = powers[length - 1 :: -1].transpose(0, 2, 1).reshape(length * n, n)
    start = x.tolist()
    starts = [start]
    jump = entries.sparse(powers[length].tolist())
    for end in (whole.reshape(blocks, length * n) @ weights).tolist():
        start = [entries.dot(row, start) + end_i for row, end_i in zip(jump, end)]
        starts.append(start)
    before = np.array(starts[:-1]).T
    lanes = np.ascontiguousarray(whole.transpose(1, 2, 0))  # (length, n, blocks)
    for lane in lanes:
        lane += A @ before
        before = lane
    whole[:] = lanes.transpose(2, 0, 1)
    x = np.array(start)
    for k in range(blocks * length, T):
        x = d[k] = A @ x + d[k]
