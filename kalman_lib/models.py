"""What the system does and what the sensors see: a linear model and a nonlinear one.

Both answer the same two questions, so one filter loop serves both: ``transition(x, u, k)`` gives
f(x, u) and its matrix F; ``measure(x, u, k)`` gives h(x, u) and its matrix H, each at step k,
counted from 0.

Letters (n states, m measurements, l inputs, T steps):
x state (n,), F transition (n, n), B control (n, l), u input (l,), Q process-noise covariance
(n, n), H measurement matrix (m, n), z measurement (m,), R measurement-noise covariance (m, m),
P covariance of x (n, n).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .checks import (
    check_callable,
    check_finite,
    check_shape,
    checked_covariances,
    matrix,
    of_x_and_u,
    returned,
    shape_message,
    shaped,
    state,
    steps_of,
)
from .frozen import freeze


def subtract(z, z_pred):
    """The usual residual, z - z_pred. An angle needs another one, which wraps the difference."""
    return z - z_pred


@dataclass(frozen=True, eq=False)
class LinearModel:
    """x = F x + B u + w, z = H x + v, with w ~ N(0, Q) and v ~ N(0, R).

    F (n, n), H (m, n), Q (n, n), R (m, m), B (n, l) or None: each fixed, or one per step,
    (T, ., .), where the sampling is uneven or sensors come and go. x0 (n,), P0 (n, n) describe the
    moment before the first prediction. residual(z, z_pred) -> (m,). A plain number stands for a
    1 x 1 matrix, and (T,) for T of them. An infinite variance in R says that the sensor tells
    nothing (at that step). Units are yours: if x is in metres and seconds, Q and P0 hold their
    squares.

    ValueError: a matrix whose shape does not fit the others, that holds NaN or infinity, or that is
    no covariance.
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
        x0 = state("x0", self.x0)
        n = len(x0)
        check_callable("residual", self.residual)
        H = check_finite("H", matrix("H", self.H, columns=n))
        m = H.shape[-2]
        F = check_finite("F", matrix("F", self.F, rows=n, columns=n))
        B = None if self.B is None else check_finite("B", matrix("B", self.B))
        check_shape("F", F, (n, n))
        if H.shape[-1] != n or m == 0:
            raise ValueError(shape_message("H", H.shape, f"(m, {n})"))
        if B is not None and B.shape[-2] != n:
            raise ValueError(shape_message("B", B.shape, f"({n}, l)"))
        Q, R, P0 = checked_covariances(self, n, m)
        freeze(self, F=F, H=H, Q=Q, R=R, x0=x0, P0=P0, B=B)
        steps_of(self)

    def transition(self, x, u=None, k=0):
        """The next state F x + B u (n,) and F (n, n) of step k. Without u there is no B u."""
        F = at(self.F, k)
        if u is None:
            return F @ x, F
        if self.B is None:
            raise ValueError(
                "u is given, but the model has no B. / u diberikan, tetapi model tidak punya B."
            )
        B = at(self.B, k)
        if np.shape(u) != (B.shape[1],):
            raise ValueError(shape_message("u", np.shape(u), (B.shape[1],)))
        return F @ x + B @ u, F

    def measure(self, x, u=None, k=0):
        """What the sensors show without noise, H x (m,), and H (m, n) of step k, with any u."""
        H = at(self.H, k)
        return H @ x, H


@dataclass(frozen=True, eq=False)
class NonlinearModel:
    """x = f(x, u) + w, z = h(x, u) + v, with w ~ N(0, Q), v ~ N(0, R): for the extended filter.

    f(x, u) -> (n,), F(x, u) -> (n, n) its matrix of partial derivatives (Jacobian) by x;
    h(x, u) -> (m,), H(x, u) -> (m, n) its Jacobian by x; for m = 1 also (n,). u is None where there
    is no input; a function that needs none may take x alone. Q, R, x0, P0 and residual as in
    LinearModel. `check_jacobians` compares F and H with f and h.
    many_runs=True says that the functions also take many runs at once, x (n, runs): f and h then
    return (n, runs) and (m, runs), and F and H rows of entries, each a number or (runs,).

    ValueError: as LinearModel. The shapes that f, F, h and H return are checked at every call, and
    so is that all numbers are finite: the message names the function and the step.
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
        x0 = state("x0", self.x0)
        check_callable("residual", self.residual)
        m = matrix("R", self.R).shape[-1] if np.ndim(self.R) > 1 else 1
        Q, R, P0 = checked_covariances(self, len(x0), m)
        freeze(self, Q=Q, R=R, x0=x0, P0=P0)
        steps_of(self)
        for name in ("f", "F", "h", "H"):
            object.__setattr__(self, name, of_x_and_u(name, getattr(self, name)))
        self._try_measure()

    def transition(self, x, u=None, k=0):
        """The next state f(x, u) (n,) and the Jacobian F (n, n) at x; errors name the step k."""
        n = len(self.x0)
        f = returned("f(x, u)", self.f(np.array(x), u), (n,), k)  # copies: f may work in place
        F = returned("F(x, u)", self.F(np.array(x), u), (n, n), k)
        return f, F

    def measure(self, x, u=None, k=0):
        """What the sensors would show without noise, h(x, u) (m,), and the Jacobian H (m, n)."""
        n, m = len(self.x0), self.R.shape[-1]
        h = returned("h(x, u)", self.h(np.array(x), u), (m,), k)
        H = returned("H(x, u)", self.H(np.array(x), u), (m, n), k)
        return h, H

    def _try_measure(self):
        """What h and H return is looked at early, if they can do without an input."""
        try:
            h = self.h(np.array(self.x0), None)
            H = self.H(np.array(self.x0), None)
        except Exception:  # they need u, or do not like x0: checked at the first step
            return
        n, m = len(self.x0), self.R.shape[-1]
        shaped("h(x, u)", h, (m,))
        shaped("H(x, u)", H, (m, n))


def at(M, k):
    """The matrix of step k: M (., .) is the same at every step, M (T, ., .) has one for each."""
    if M.ndim == 2:
        return M
    T = len(M)
    if not 0 <= k < T:
        raise ValueError(
            f"step {k}: the model has matrices for {T} steps only, 0 to {T - 1}. / "
            f"langkah {k}: model hanya punya matriks untuk {T} langkah, 0 sampai {T - 1}."
        )
    return M[k]
