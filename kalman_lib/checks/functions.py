"""The functions that a reader writes (f, F, h, H, residual): what they take and return."""

import inspect

import numpy as np

from .arrays import numbers, shape_message


def check_callable(name, function):
    """ValueError unless the function can be called."""
    if not callable(function):
        raise ValueError(f"{name} must be a function. / {name} harus berupa fungsi.")


def of_x_and_u(name, function):
    """The function itself, to be called with (x, u).

    One that takes x alone, for it needs no input, is wrapped.
    """
    if not callable(function):
        raise ValueError(
            f"{name} must be a function of (x, u). / {name} harus berupa fungsi dari (x, u)."
        )
    try:
        signature = inspect.signature(function)
    except ValueError:  # some built-in functions do not tell theirs
        return function
    u = signature.parameters.get("u")
    if u is not None and u.kind is inspect.Parameter.KEYWORD_ONLY:
        return lambda x, u=None: function(x, u=u)
    if _takes(signature, 2) and not _second_is_no_input(signature):
        return function
    if _takes(signature, 1):
        return lambda x, u=None: function(x)
    raise ValueError(
        f"{name} must take two arguments, {name}(x, u); it takes {signature}. / "
        f"{name} harus menerima dua argumen, {name}(x, u), tetapi menerima {signature}."
    )


def _takes(signature, count):
    """Can the function be called with so many arguments?"""
    try:
        signature.bind(*range(count))
    except TypeError:
        return False
    return True


def _second_is_no_input(signature):
    """Has a second parameter another name than u, and a value of its own?"""
    if len(signature.parameters) < 2:
        return False
    _, second, *_ = signature.parameters.values()
    return second.name != "u" and second.default is not inspect.Parameter.empty


def returned(name, value, expected, k):
    """What a function of the model returned at step k, as a finite array of the expected shape."""
    array = shaped(name, value, expected)
    if not np.isfinite(array).all():
        entry = np.argwhere(~np.isfinite(array))[0].tolist()
        where, value = f"{name}{entry}", array[tuple(entry)]
        raise ValueError(
            f"{where} is {value} at step {k} (counted from 0); expected a finite number. / "
            f"{where} bernilai {value} pada langkah {k} (dihitung dari 0); seharusnya bilangan "
            "berhingga."
        )
    return array


def shaped(name, value, expected):
    """The value as an array of the expected shape; a row or a number alone, where there is one."""
    array = numbers(name, value)
    if array.ndim < 2 and array.size == np.prod(expected) and 1 in expected:
        array = array.reshape(expected)
    if array.shape != expected:
        raise ValueError(shape_message(name, array.shape, expected))
    return array


def innovation(residual, z, z_pred, k):
    """residual(z, z_pred) (m,), NaN where z is.

    ValueError where it is not finite at step k, or has another shape.
    """
    name = "residual(z, z_pred)"
    y = numbers(name, residual(z, z_pred))
    if y.shape != z_pred.shape:
        raise ValueError(shape_message(name, y.shape, z_pred.shape))
    silent = np.isnan(z)
    if not np.isfinite(y[~silent]).all() and np.isfinite(z_pred).all():
        i = int(np.argmax(~silent & ~np.isfinite(y)))
        raise ValueError(
            f"{name}[{i}] is {y[i]} at step {k} (counted from 0); expected a finite number. / "
            f"{name}[{i}] bernilai {y[i]} pada langkah {k} (dihitung dari 0); seharusnya bilangan "
            "berhingga."
        )
    y[silent] = np.nan
    return y
