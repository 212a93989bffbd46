"""What may come in, and what is refused: one sentence in English, the same in Indonesian.

arrays.py       numbers from anywhere become float arrays of the right shape
over_time.py    what has a row or a matrix for each step: z, u, and a model's matrices
covariances.py  what a covariance must be
functions.py    the functions that a reader writes: what they take and return
filtering.py    what predict, update and kalman_filter take, and when a filter has gone astray
"""

from .arrays import (
    check_finite,
    check_shape,
    finite_array,
    matrix,
    numbers,
    shape_message,
    state,
)
from .covariances import check_covariance, checked_covariances, correlations
from .filtering import (
    check_filter,
    check_noise,
    check_probability,
    check_still_finite,
    checked_estimate,
    measurement,
)
from .functions import check_callable, innovation, of_x_and_u, returned, shaped
from .over_time import check_series, series, shaped_series, steps_of

__all__ = [
    "check_callable",
    "check_covariance",
    "check_filter",
    "check_finite",
    "check_noise",
    "check_probability",
    "check_series",
    "check_shape",
    "check_still_finite",
    "correlations",
    "checked_estimate",
    "finite_array",
    "innovation",
    "matrix",
    "measurement",
    "checked_covariances",
    "numbers",
    "of_x_and_u",
    "returned",
    "series",
    "shape_message",
    "shaped",
    "shaped_series",
    "state",
    "steps_of",
]
