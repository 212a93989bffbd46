"""What has a row or a matrix for each step: measurements, inputs, a model's matrices."""

import numpy as np

from .arrays import numbers, shape_message


def series(name, values, width=None, steps=None, runs=False):
    """z or u as a new float array (T, width), with runs=True also (T, width, N).

    A row that is None is all NaN. ValueError: another shape, an infinite number, or NaN in u.
    """
    return check_series(name, shaped_series(name, values, width, steps, runs))


def shaped_series(name, values, width=None, steps=None, runs=False, copy=True):
    """`series` without a look at the numbers; copy as in `numbers`."""
    if isinstance(values, (list, tuple)) and any(row is None for row in values):
        rows = [row for row in values if np.ndim(row)]
        if rows:
            silent = [np.nan] * len(rows[0])
            values = [silent if row is None else row for row in values]
    array = numbers(name, values, copy=copy)
    if array.ndim == 1 and width in (1, None):
        array = array[:, np.newaxis]
    dimensions = (2, 3) if runs else (2,)
    fits = array.ndim in dimensions and array.size > 0
    if not fits or (width and array.shape[1] != width) or (steps and len(array) != steps):
        _refuse_shape(name, array.shape, steps or "T", width or "l", runs)
    return array


def _refuse_shape(name, shape, steps, width, runs):
    en = id = f"({steps}, {width})"
    if runs:
        many = f"({steps}, {width}, N)"
        en, id = f"{en} or {many}", f"{id} atau {many}"
    raise ValueError(
        f"{name} has shape {shape}, expected {en}. / {name} berukuran {shape}, seharusnya {id}."
    )


def check_series(name, array):
    """The array itself; ValueError if a number is infinite, or NaN in u."""
    with np.errstate(over="ignore", invalid="ignore"):
        if np.isfinite(np.add.reduce(array, axis=None)):  # one look at each number
            return array
    wrong = np.isinf(array) if name == "z" else ~np.isfinite(array)
    if wrong.any():
        k = int(np.argwhere(wrong)[0, 0])
        raise ValueError(
            f"{name}[{k}] is {array[k]}; expected finite numbers. / "
            f"{name}[{k}] berisi {array[k]}; seharusnya bilangan berhingga."
        )
    return array


def steps_of(model, T=None):
    """For how many steps the model has matrices, None if all are fixed.

    ValueError unless they agree (and are T).
    """
    for name in ("F", "H", "Q", "R", "B"):
        M = getattr(model, name, None)
        if isinstance(M, np.ndarray) and M.ndim == 3:
            if T is not None and len(M) != T:
                raise ValueError(shape_message(name, M.shape, (T, *M.shape[1:])))
            T = len(M)
    return T
