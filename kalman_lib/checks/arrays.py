"""Numbers from anywhere become float arrays, or one clear sentence says why not."""

import datetime

import numpy as np

# What an array may hold instead of numbers, in English and Indonesian
TEXT = ("text", "teks")
DATES = ("dates or times (write them in seconds)", "tanggal atau waktu (tulislah dalam detik)")
COMPLEX = ("complex numbers", "bilangan kompleks")
OTHER = ("something else", "hal lain")
KINDS = {"U": TEXT, "S": TEXT, "T": TEXT, "M": DATES, "m": DATES, "c": COMPLEX}

DATE_TYPES = (
    datetime.date,
    datetime.time,
    datetime.timedelta,
    np.datetime64,
    np.timedelta64,
)


def numbers(name, value, dimensions=0, copy=True):
    """A float copy of the value with at least that many dimensions.

    None, pandas' NA and masked entries become NaN. copy=False: the array itself, if it is one of
    floats. Taken are numbers, (nested) lists, arrays of any precision and order, masked arrays,
    pandas Series and DataFrame. ValueError: text, dates, complex numbers, ragged rows.
    """
    mask = None
    if isinstance(value, (list, tuple)) and any(map(_is_masked_row, value)):
        value = [numbers(name, row) for row in value]
    if np.ma.isMaskedArray(value):
        mask = np.ma.getmaskarray(value)
        value = value.data
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        raise ValueError(
            f"{name} must hold numbers only, in rows of equal length. / "
            f"{name} hanya boleh berisi bilangan, dalam baris yang sama panjang."
        ) from None
    if array.dtype.kind == "O":
        array = np.array([_number(name, entry) for entry in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "biuf":
        _refuse(name, KINDS.get(array.dtype.kind, OTHER))
    copy = copy or mask is not None or None  # None: where it is needed
    array = np.array(array, dtype=float, order="C", ndmin=dimensions, copy=copy)
    if mask is not None:
        array[mask.reshape(array.shape)] = np.nan
    return array


def _is_masked_row(row):
    return np.ma.isMaskedArray(row) and row.ndim > 0


def _number(name, entry):
    """One entry of a mixed array as a float."""
    is_missing = entry is None or entry is np.ma.masked
    if is_missing or type(entry).__name__ == "NAType":  # pandas.NA
        return np.nan
    if isinstance(entry, (str, bytes)):
        _refuse(name, TEXT)
    if isinstance(entry, DATE_TYPES):
        _refuse(name, DATES)
    if isinstance(entry, (complex, np.complexfloating)):
        _refuse(name, COMPLEX)
    try:
        return float(entry)
    except OverflowError:
        raise ValueError(
            f"{name} holds a number that is too large. / {name} memuat bilangan yang terlalu besar."
        ) from None
    except (TypeError, ValueError):
        kind = type(entry).__name__
        raise ValueError(
            f"{name} must hold numbers only; it holds an object of type {kind}. / "
            f"{name} hanya boleh berisi bilangan, tetapi memuat objek berjenis {kind}."
        ) from None


def _refuse(name, found):
    en, id = found
    raise ValueError(
        f"{name} must hold numbers only; it holds {en}. / "
        f"{name} hanya boleh berisi bilangan, tetapi memuat {id}."
    )


def matrix(name, value, rows=None, columns=None, per_step=True):
    """The value as (rows, columns) or, one matrix per step, as (T, rows, columns).

    A number is a 1 x 1 matrix, a flat list one row; where one number is expected, a flat list of T
    holds one per step.
    """
    array = numbers(name, value)
    one_number = (rows, columns) in ((1, 1), (None, 1))
    if array.ndim == 1 and per_step and one_number and len(array) > 1:
        return array.reshape(-1, 1, 1)
    if array.ndim < 2:
        return array.reshape(1, -1)
    if array.ndim > (3 if per_step else 2):
        wanted = f"({rows or 'm'}, {columns or 'n'})"
        raise ValueError(shape_message(name, array.shape, wanted))
    return array


def state(name, value):
    """The value as a state (n,), n at least 1."""
    array = check_finite(name, numbers(name, value, 1))
    if array.ndim != 1 or len(array) == 0:
        raise ValueError(shape_message(name, array.shape, f"({max(len(array), 1)},)"))
    return array


def finite_array(name, value, shape=None, gaps=False):
    """The value as a float array of that shape (None: any); with gaps it may hold NaN."""
    array = numbers(name, value, 0 if shape is None else len(shape))
    if np.isinf(array).any() or (np.isnan(array).any() and not gaps):
        raise ValueError(
            f"{name} must hold finite numbers only. / {name} hanya boleh berisi bilangan berhingga."
        )
    if shape is not None and array.shape != shape:
        raise ValueError(shape_message(name, array.shape, shape))
    return array


def check_finite(name, array):
    """The array itself; ValueError if it holds NaN or infinity."""
    if not np.isfinite(array).all():
        shape = array.shape
        raise ValueError(
            f"{name}, shape {shape}, holds NaN or infinity; every entry must be finite. / "
            f"{name}, ukuran {shape}, memuat NaN atau takhingga; setiap isinya harus berhingga."
        )
    return array


def shape_message(name, shape, expected):
    """The sentence about a wrong shape."""
    return (
        f"{name} has shape {tuple(shape)}, expected {expected}. / "
        f"{name} berukuran {tuple(shape)}, seharusnya {expected}."
    )


def check_shape(name, array, expected):
    """ValueError unless the array has the expected shape, or one such matrix per step."""
    if array.shape != expected and not (array.ndim == 3 and array.shape[1:] == expected):
        raise ValueError(shape_message(name, array.shape, expected))
