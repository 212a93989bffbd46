"""What a covariance must be: symmetric, and no variance negative, in whatever direction."""

import numpy as np

from ..roots import Covariance
from .arrays import check_finite, check_shape, matrix


def correlations(P, sigma):
    """P (..., n, n) in units of the standard deviations sigma (..., n): mixed units do no harm."""
    return P / sigma[..., :, np.newaxis] / sigma[..., np.newaxis, :]


def check_covariance(name, P, definite=False, id=None):
    """ValueError unless P (n, n) is symmetric and positive semi-definite.

    P (T, n, n): every one of them. definite=True: positive definite; then a variance may be
    infinite, if its covariances are 0. id: the name in the Indonesian half of the sentence, if it
    is another one.
    """
    id = id or name
    shape = P.shape[-2:]
    if definite:
        P = _without_infinite(name, P)
    check_finite(name, P)
    sigma = np.sqrt(np.abs(np.diagonal(P, axis1=-2, axis2=-1)))
    C = correlations(P, np.where(sigma == 0, 1, sigma))
    if np.abs(C - C.swapaxes(-1, -2)).max(initial=0) > 1e-9:
        raise ValueError(
            f"{name}, shape {shape}, is not symmetric; expected a symmetric {shape} covariance. / "
            f"{id}, ukuran {shape}, tidak simetris; seharusnya kovarians simetris {shape}."
        )
    smallest = np.linalg.eigvalsh(C)[..., 0]
    if definite and not (smallest > 8 * shape[0] * np.finfo(float).eps).all():
        raise ValueError(
            f"{name}, shape {shape}, is not positive definite (every variance in it must be > 0, "
            f"and none may follow from others); expected a positive definite {shape} matrix. / "
            f"{id}, ukuran {shape}, tidak definit positif (setiap varians harus > 0, dan tidak "
            f"boleh ditentukan oleh yang lain); seharusnya matriks {shape} definit positif."
        )
    if (smallest < -1e-9 * shape[0]).any():
        raise ValueError(
            f"{name}, shape {shape}, is not positive semi-definite (no variance may be negative); "
            f"expected a covariance of shape {shape}. / {id}, ukuran {shape}, tidak semidefinit "
            f"positif (varians tidak boleh negatif); seharusnya kovarians berukuran {shape}."
        )


def _without_infinite(name, R):
    """R with 1 in place of every infinite variance.

    ValueError if the sensor of such a variance is linked to another one.
    """
    infinite = np.isposinf(np.diagonal(R, axis1=-2, axis2=-1))
    if not infinite.any():
        return R
    linked = (R != 0) & ~np.eye(R.shape[-1], dtype=bool)
    if (linked & (infinite[..., np.newaxis] | infinite[..., np.newaxis, :])).any():
        raise ValueError(
            f"{name}: a sensor with infinite variance must have covariance 0 with the others. / "
            f"{name}: sensor dengan varians takhingga harus berkovarians 0 dengan yang lain."
        )
    R = R.copy()
    diagonal = np.einsum("...ii->...i", R)
    diagonal[infinite] = 1
    return R


def checked_covariances(model, n, m):
    """Q, R and P0 of the model, checked: Q, P0 (n, n) covariances, R (m, m) positive definite."""
    Q = check_finite("Q", matrix("Q", model.Q, rows=n, columns=n))
    R = matrix("R", model.R, rows=m, columns=m)
    P0 = check_finite("P0", matrix("P0", model.P0, rows=n, columns=n, per_step=False))
    for name, M, size in (("Q", Q, n), ("P0", P0, n), ("R", R, m)):
        check_shape(name, M, (size, size))
        check_covariance(name, M, definite=name == "R")
    R = (R + R.swapaxes(-1, -2)) / 2
    if Q.ndim == 3:
        return np.array([Covariance.nearest(Q_k) for Q_k in Q]), R, Covariance.nearest(P0)
    return Covariance.nearest(Q), R, Covariance.nearest(P0)
