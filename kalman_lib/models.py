"""What the system does and what the sensor sees: a linear model and a nonlinear one.

Both answer the same two questions, so one filter loop serves both:
``transition(x, u)`` gives f(x, u) and its matrix F; ``measure(x)`` gives h(x) and its matrix H.

Letters (n states, m measurements, l inputs):
x state (n,), F transition (n, n), B control (n, l), u input (l,), Q process-noise covariance (n, n),
H measurement matrix (m, n), z measurement (m,), R measurement-noise covariance (m, m), P covariance of x (n, n).
"""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


def subtract(z, z_pred):
    """The usual residual, z - z_pred. An angle needs another one, which wraps the difference."""
    return z - z_pred


@dataclass(frozen=True, eq=False)
class LinearModel:
    """x = F x + B u + w, z = H x + v, with w ~ N(0, Q) and v ~ N(0, R).

    F (n, n), H (m, n), Q (n, n), R (m, m) or, where it changes in time, (T, m, m); x0 (n,), P0 (n, n), B (n, l) or
    None; residual(z, z_pred) -> (m,). A plain number stands for a 1 x 1 matrix. Units are yours: if x is in metres
    and seconds, Q and P0 hold their squares. x0 and P0 describe the moment before the first prediction.

    ValueError: a matrix whose shape does not fit the others, that holds NaN or infinity, or that is no covariance.
    """
    F: np.ndarray
    H: np.ndarray
    Q: np.ndarray
    R: np.ndarray
    x0: np.ndarray
    P0: np.ndarray
    B: np.ndarray | None = None
    residual: Callable = subtract

    def __post_init__(self):
        x0 = _numbers("x0", self.x0, 1)
        F, H, Q, R, P0 = (_numbers(name, getattr(self, name), 2) for name in ("F", "H", "Q", "R", "P0"))
        n, m = len(x0), H.shape[0]
        B = None if self.B is None else _numbers("B", self.B, 2)
        _check_shape("F", F, (n, n))
        if H.ndim != 2 or H.shape[1] != n:
            raise ValueError(_shape_message("H", H.shape, f"(m, {n})"))
        if B is not None and (B.ndim != 2 or len(B) != n):
            raise ValueError(_shape_message("B", B.shape, f"({n}, l)"))
        _check_noise(Q, R, x0, P0, n, m)
        _freeze(self, F=F, H=H, Q=Q, R=R, x0=x0, P0=P0, B=B)

    def transition(self, x, u=None, k=0):
        """The next state F x + B u (n,) and F (n, n). Without u there is no B u."""
        if u is None:
            return self.F @ x, self.F
        if self.B is None:
            raise ValueError("u is given, but the model has no B. / u diberikan, tetapi model tidak punya B.")
        if np.shape(u) != (self.B.shape[1],):
            raise ValueError(_shape_message("u", np.shape(u), (self.B.shape[1],)))
        return self.F @ x + self.B @ u, self.F

    def measure(self, x, u=None, k=0):
        """What the sensor would show without noise, H x (m,), and H (m, n)."""
        return self.H @ x, self.H


@dataclass(frozen=True, eq=False)
class NonlinearModel:
    """x = f(x, u) + w, z = h(x) + v, with w ~ N(0, Q) and v ~ N(0, R): the model of the extended Kalman filter.

    f(x, u) -> (n,), F(x, u) -> (n, n) its matrix of partial derivatives (Jacobian) by x, h(x) -> (m,),
    H(x) -> (m, n) its Jacobian; Q, R, x0, P0 and residual as in LinearModel. u is None where there is no input.
    many_runs=True says that the functions also take many runs at once, x (n, runs): f and h then return (n, runs) and
    (m, runs), and F and H rows of entries, each a number or (runs,). Such a model of one sensor filters z (T, 1, runs).

    ValueError: as LinearModel; the shapes that f, F, h and H return are checked whenever they are called.
    """
    f: Callable
    F: Callable
    h: Callable
    H: Callable
    Q: np.ndarray
    R: np.ndarray
    x0: np.ndarray
    P0: np.ndarray
    residual: Callable = subtract
    many_runs: bool = False

    def __post_init__(self):
        x0 = _numbers("x0", self.x0, 1)
        Q, R, P0 = (_numbers(name, getattr(self, name), 2) for name in ("Q", "R", "P0"))
        _check_noise(Q, R, x0, P0, len(x0), R.shape[-1])
        _freeze(self, Q=Q, R=R, x0=x0, P0=P0)
        self.measure(x0)

    def transition(self, x, u=None, k=0):
        """The next state f(x, u) (n,) and the Jacobian F (n, n) at x."""
        n = len(self.x0)
        return _result("f(x, u)", self.f(x, u), (n,)), _result("F(x, u)", self.F(x, u), (n, n))

    def measure(self, x, u=None, k=0):
        """What the sensor would show without noise, h(x) (m,), and the Jacobian H (m, n) at x."""
        n, m = len(self.x0), self.R.shape[-1]
        return _result("h(x)", self.h(x), (m,)), _result("H(x)", self.H(x), (m, n))


# --- checks: one clear sentence, in English and Indonesian, that names the matrix -------------------------------

def _numbers(name, value, dimensions):
    """A read-only float copy of the value with at least that many dimensions."""
    try:
        array = np.array(value, dtype=float, ndmin=dimensions)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must hold numbers only. / {name} hanya boleh berisi bilangan.") from None
    if not np.isfinite(array).all():
        raise ValueError(f"{name}, shape {array.shape}, holds NaN or infinity; every entry must be finite. / "
                         f"{name}, ukuran {array.shape}, memuat NaN atau takhingga; setiap isinya harus berhingga.")
    array.setflags(write=False)
    return array


def _result(name, value, expected):
    """What a function of the nonlinear model returned, as an array of the expected shape."""
    array = np.asarray(value, dtype=float)
    _check_shape(name, array, expected)
    return array


def _shape_message(name, shape, expected):
    return (f"{name} has shape {shape}, expected {expected}. / "
            f"{name} berukuran {shape}, seharusnya {expected}.")


def _check_shape(name, array, expected):
    if array.shape != expected:
        raise ValueError(_shape_message(name, array.shape, expected))


def _check_noise(Q, R, x0, P0, n, m):
    """x0 must be (n,); Q and P0 (n, n) must be covariances; R (m, m) or (T, m, m) must also be invertible."""
    _check_shape("x0", x0, (n,))
    _check_shape("Q", Q, (n, n))
    _check_shape("P0", P0, (n, n))
    _check_shape("R", R, (m, m) if R.ndim < 3 else (len(R), m, m))
    check_covariance("Q", Q)
    check_covariance("P0", P0)
    check_covariance("R", R, definite=True)


def check_covariance(name, P, definite=False):
    """ValueError unless P (n, n) is symmetric and positive semi-definite (definite=True: positive definite).

    P (T, n, n): every one of them.
    """
    scale = np.sqrt(np.abs(np.diagonal(P, axis1=-2, axis2=-1)))
    scale = np.where(scale == 0, 1, scale)
    C = P / (scale[..., :, np.newaxis] * scale[..., np.newaxis, :])     # unit diagonal, so that mixed units (1e-9 beside
    shape = P.shape[-2:]                                                # 1e9) do no harm
    if np.abs(C - C.swapaxes(-1, -2)).max() > 1e-9:
        raise ValueError(f"{name}, shape {shape}, is not symmetric; expected a symmetric {shape} covariance. / "
                         f"{name}, ukuran {shape}, tidak simetris; seharusnya kovarians simetris {shape}.")
    eigenvalues = np.linalg.eigvalsh(C)
    if definite and not (eigenvalues[..., 0] > 0).all():
        raise ValueError(f"{name}, shape {shape}, is not positive definite (every variance in it must be > 0); "
                         f"expected a positive definite {shape} matrix. / {name}, ukuran {shape}, tidak definit "
                         f"positif (setiap varians harus > 0); seharusnya matriks {shape} definit positif.")
    if (eigenvalues[..., 0] < -1e-9 * np.abs(eigenvalues[..., -1])).any():
        raise ValueError(f"{name}, shape {shape}, is not positive semi-definite (no variance may be negative); "
                         f"expected a covariance of shape {shape}. / {name}, ukuran {shape}, tidak semidefinit "
                         f"positif (varians tidak boleh negatif); seharusnya kovarians berukuran {shape}.")


def _freeze(model, **arrays):
    """Put the checked arrays into the frozen dataclass."""
    for name, array in arrays.items():
        object.__setattr__(model, name, array)
