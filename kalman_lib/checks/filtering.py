"""What predict, update and kalman_filter take, and when a filter has gone astray."""

from numbers import Real

import numpy as np

from ..roots import Covariance
from .arrays import check_finite, numbers, shape_message
from .covariances import check_covariance


def check_filter(model, adapt_R):
    """ValueError unless there is a model to filter with, and adapt_R is None or a function."""
    if not hasattr(model, "transition"):
        kind = type(model).__name__
        raise ValueError(
            f"model must be a LinearModel or a NonlinearModel, not {kind}. / "
            f"model harus LinearModel atau NonlinearModel, bukan {kind}."
        )
    if adapt_R is not None and not callable(adapt_R):
        raise ValueError(
            "adapt_R must be a function (k, y, HPH, R). / "
            "adapt_R harus berupa fungsi (k, y, HPH, R)."
        )


def checked_estimate(name_x, x, name_P, P, n):
    """x (n,) and P (n, n) as the filter left them.

    If somebody wrote them down, then they are checked.
    """
    if isinstance(P, Covariance):
        return x, P
    x = check_finite(name_x, numbers(name_x, x))
    P = check_finite(name_P, numbers(name_P, P))
    if x.shape != (n,):
        raise ValueError(shape_message(name_x, x.shape, (n,)))
    if P.shape != (n, n):
        raise ValueError(shape_message(name_P, P.shape, (n, n)))
    check_covariance(name_P, P)
    return x, P


def measurement(z, shape):
    """z (m,) of one step as floats, NaN where a sensor is silent."""
    z = numbers("z", z)
    if z.shape != shape:
        raise ValueError(shape_message("z", z.shape, shape))
    if np.isinf(z).any():
        raise ValueError(
            f"z is {z}; expected finite numbers, or NaN where a sensor is silent. / "
            f"z berisi {z}; seharusnya bilangan berhingga, atau NaN bila sensornya diam."
        )
    return z


def check_noise(name, R, shape, id=None):
    """R (m, m) as somebody wrote it down, or adapt_R returned it; id: its name in Indonesian."""
    R = numbers(name, R)
    id = id or name
    if R.shape != shape:
        raise ValueError(
            f"{name} has shape {R.shape}, expected {shape}. / "
            f"{id} berukuran {R.shape}, seharusnya {shape}."
        )
    check_covariance(name, R, definite=True, id=id)
    return R


def check_probability(name, p):
    """ValueError unless p lies between 0 and 1."""
    if not isinstance(p, Real) or not 0 < p < 1:
        raise ValueError(
            f"{name} = {p!r}: expected a probability between 0 and 1, such as 0.999. / "
            f"{name} = {p!r}: seharusnya peluang antara 0 dan 1, misalnya 0.999."
        )


def check_still_finite(model, k, x, P):
    """ValueError at the first step k whose numbers are not finite: the filter has gone astray."""
    if np.isfinite(x).all() and np.isfinite(P).all():
        return
    en = id = "F"
    if not isinstance(getattr(model, "F", None), np.ndarray):
        en = "the Jacobians F and H (check_jacobians)"
        id = "Jacobian F dan H (check_jacobians)"
    raise ValueError(
        f"x or P is no longer finite at step {k} (counted from 0): the filter diverges; look at "
        f"{en}. / x atau P tidak lagi berhingga pada langkah {k} (dihitung dari 0): filternya "
        f"divergen; periksalah {id}."
    )
