"""Where the covariance of a filter settles (the Riccati equation), and whether it does."""

import numpy as np


def settle(F, H, Q, R, P_pred):
    """P_pred (n, n), refined by Newton's method and verified; LinAlgError where it does not hold.

    The filter with the gain K of P_pred settles at P_pred = A P_pred A' + W, which is summed by
    doubling: 1, 2, 4, ... steps at once (Hewer, 1971).
    """
    for _ in range(3):
        before = P_pred
        K = np.linalg.solve(H @ before @ H.T + R, H @ before).T
        A = F - F @ K @ H
        if not np.abs(np.linalg.eigvals(A)).max() < 1 - 1e-12:
            raise np.linalg.LinAlgError
        P_pred = F @ K @ R @ K.T @ F.T + Q
        for _ in range(45):
            P_pred = P_pred + A @ P_pred @ A.T
            A = A @ A
        P_pred = (P_pred + P_pred.T) / 2
    sigma = np.sqrt(np.diagonal(P_pred))
    if not (np.abs(P_pred - before) <= 1e-8 * np.outer(sigma, sigma)).all():
        raise np.linalg.LinAlgError
    return P_pred


def check_settles(F, H, Q):
    """ValueError if a mode that does not decay is not seen, or one that stays is not moved."""
    from scipy.linalg import matrix_balance

    F, (scale, _) = matrix_balance(F, permute=False, separate=True)  # whatever the units
    modes = np.linalg.eigvals(F)
    lasting = modes[np.abs(modes) > 1 - 1e-9]
    if _has_idle(F, H * scale, lasting):
        raise ValueError(
            "Not detectable: a state that does not decay is not seen. / "
            "Tidak terdeteksi: suatu keadaan yang tidak meluruh tidak terlihat."
        )
    constant = modes[np.abs(np.abs(modes) - 1) < 1e-7]
    if _has_idle(F.T, Q / np.outer(scale, scale), constant):
        raise ValueError(
            "A constant has no process noise (Q = 0): its gain falls for ever. / "
            "Suatu tetapan tanpa derau proses (Q = 0): penguatannya turun terus."
        )


def _has_idle(F, H, modes):
    """Is one of the modes of F (n, n) without effect on H x? (Popov, Belevitch, Hautus.)"""
    H = H / (np.abs(H).max() or 1)
    tests = [np.vstack([mode * np.eye(len(F)) - F, H]) for mode in modes]
    return any(np.linalg.svd(M, compute_uv=False)[-1] < 1e-9 for M in tests)
