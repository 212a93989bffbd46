"""What may come in: numbers from anywhere become float arrays, or one clear sentence says why not."""
import datetime

import numpy as np


# --- numbers ---------------------------------------------------------------------------------------------------------

def numbers(name, value, dimensions=0):
    """A float copy of the value with at least that many dimensions; None, pandas' NA and masked entries become NaN.

    Taken are numbers, (nested) lists, arrays of any precision and order, masked arrays, pandas Series and DataFrame.
    ValueError: text, dates, complex numbers, ragged rows.
    """
    mask = None
    if isinstance(value, (list, tuple)) and any(np.ma.isMaskedArray(row) and row.ndim for row in value):
        value = [numbers(name, row) for row in value]
    if np.ma.isMaskedArray(value):
        mask = np.ma.getmaskarray(value)
        value = value.data
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must hold numbers only, in rows of equal length. / "
                         f"{name} hanya boleh berisi bilangan, dalam baris yang sama panjang.") from None
    if array.dtype.kind == "O":
        array = np.array([_number(name, entry) for entry in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "biuf":
        _refuse(name, _KINDS.get(array.dtype.kind, ("something else", "hal lain")))
    array = np.array(array, dtype=float, order="C", ndmin=dimensions)
    if mask is not None:
        array[mask.reshape(array.shape)] = np.nan
    return array


_TEXT = ("text", "teks")
_DATES = ("dates or times (write them in seconds)", "tanggal atau waktu (tulislah dalam detik)")
_COMPLEX = ("complex numbers", "bilangan kompleks")
_KINDS = {"U": _TEXT, "S": _TEXT, "T": _TEXT, "M": _DATES, "m": _DATES, "c": _COMPLEX}


def _number(name, entry):
    """One entry of a mixed array as a float."""
    if entry is None or entry is np.ma.masked or type(entry).__name__ == "NAType":       # pandas.NA
        return np.nan
    if isinstance(entry, (str, bytes)):
        _refuse(name, _TEXT)
    if isinstance(entry, (datetime.date, datetime.time, datetime.timedelta, np.datetime64, np.timedelta64)):
        _refuse(name, _DATES)
    if isinstance(entry, (complex, np.complexfloating)):
        _refuse(name, _COMPLEX)
    try:
        return float(entry)
    except OverflowError:
        raise ValueError(f"{name} holds a number that is too large. / "
                         f"{name} memuat bilangan yang terlalu besar.") from None
    except (TypeError, ValueError):
        kind = type(entry).__name__
        raise ValueError(f"{name} must hold numbers only; it holds an object of type {kind}. / "
                         f"{name} hanya boleh berisi bilangan, tetapi memuat objek berjenis {kind}.") from None


def _refuse(name, found):
    raise ValueError(f"{name} must hold numbers only; it holds {found[0]}. / "
                     f"{name} hanya boleh berisi bilangan, tetapi memuat {found[1]}.")


def matrix(name, value, rows=None, columns=None, per_step=True):
    """The value as (rows, columns) or, one matrix per step, as (T, rows, columns).

    A number is a 1 x 1 matrix, a flat list one row; where one number is expected, a flat list of T holds one per step.
    """
    array = numbers(name, value)
    if array.ndim == 1 and per_step and (rows, columns) in ((1, 1), (None, 1)) and len(array) > 1:
        return array.reshape(-1, 1, 1)
    if array.ndim < 2:
        return array.reshape(1, -1)
    if array.ndim > (3 if per_step else 2):
        wanted = f"({rows or 'm'}, {columns or 'n'})"
        raise ValueError(shape_message(name, array.shape, wanted))
    return array


def check_finite(name, array):
    """The array itself; ValueError if it holds NaN or infinity."""
    if not np.isfinite(array).all():
        raise ValueError(f"{name}, shape {array.shape}, holds NaN or infinity; every entry must be finite. / "
                         f"{name}, ukuran {array.shape}, memuat NaN atau takhingga; setiap isinya harus berhingga.")
    return array


def shape_message(name, shape, expected):
    """The sentence about a wrong shape."""
    return (f"{name} has shape {tuple(shape)}, expected {expected}. / "
            f"{name} berukuran {tuple(shape)}, seharusnya {expected}.")


def check_shape(name, array, expected):
    """ValueError unless the array has the expected shape, or one such matrix per step."""
    if array.shape != expected and not (array.ndim == 3 and array.shape[1:] == expected):
        raise ValueError(shape_message(name, array.shape, expected))


def series(name, values, width=None, steps=None, runs=False):
    """z or u as a new float array (T, width), with runs=True also (T, width, N); a row that is None is all NaN.

    ValueError: another shape, an infinite number, or NaN in u.
    """
    return check_series(name, shaped_series(name, values, width, steps, runs))


def shaped_series(name, values, width=None, steps=None, runs=False):
    """`series` without a look at the numbers."""
    if isinstance(values, (list, tuple)) and any(row is None for row in values):
        rows = [row for row in values if np.ndim(row)]
        if rows:
            values = [[np.nan] * len(rows[0]) if row is None else row for row in values]
    array = numbers(name, values)
    if array.ndim == 1 and width in (1, None):
        array = array[:, np.newaxis]
    fits = array.ndim in ((2, 3) if runs else (2,)) and array.size > 0
    if not fits or (width and array.shape[1] != width) or (steps and len(array) != steps):
        wanted = f"({steps or 'T'}, {width or 'l'})"
        many = f"({steps or 'T'}, {width or 'l'}, N)"
        en, id = (f"{wanted} or {many}", f"{wanted} atau {many}") if runs else (wanted, wanted)
        raise ValueError(f"{name} has shape {array.shape}, expected {en}. / "
                         f"{name} berukuran {array.shape}, seharusnya {id}.")
    return array


def check_series(name, array):
    """The array itself; ValueError if a number is infinite, or NaN in u."""
    with np.errstate(over="ignore", invalid="ignore"):
        if np.isfinite(np.add.reduce(array, axis=None)):        # one look at each number
            return array
    wrong = np.isinf(array) if name == "z" else ~np.isfinite(array)
    if wrong.any():
        k = int(np.argwhere(wrong)[0, 0])
        raise ValueError(f"{name}[{k}] is {array[k]}; expected finite numbers. / "
                         f"{name}[{k}] berisi {array[k]}; seharusnya bilangan berhingga.")
    return array


# --- covariances -----------------------------------------------------------------------------------------------------

def check_covariance(name, P, definite=False, id=None):
    """ValueError unless P (n, n) is symmetric and positive semi-definite (definite=True: positive definite).

    P (T, n, n): every one of them. With definite=True a variance may be infinite, if its covariances are 0.
    id: the name in the Indonesian half of the sentence, if it is another one.
    """
    id = id or name
    shape = P.shape[-2:]
    variances = np.diagonal(P, axis1=-2, axis2=-1)
    if definite:
        P = _without_infinite(name, P, variances)
    check_finite(name, P)
    scale = np.sqrt(np.abs(np.diagonal(P, axis1=-2, axis2=-1)))
    scale = np.where(scale == 0, 1, scale)
    C = P / scale[..., :, np.newaxis] / scale[..., np.newaxis, :]       # correlations: mixed units do no harm
    if np.abs(C - C.swapaxes(-1, -2)).max(initial=0) > 1e-9:
        raise ValueError(f"{name}, shape {shape}, is not symmetric; expected a symmetric {shape} covariance. / "
                         f"{id}, ukuran {shape}, tidak simetris; seharusnya kovarians simetris {shape}.")
    smallest = np.linalg.eigvalsh(C)[..., 0]
    if definite and not (smallest > 8 * shape[0] * np.finfo(float).eps).all():
        raise ValueError(f"{name}, shape {shape}, is not positive definite (every variance in it must be > 0, and none "
                         f"may follow from others); expected a positive definite {shape} matrix. / {id}, ukuran "
                         f"{shape}, tidak definit positif (setiap varians harus > 0, dan tidak boleh ditentukan oleh "
                         f"yang lain); seharusnya matriks {shape} definit positif.")
    if (smallest < -1e-9 * shape[0]).any():
        raise ValueError(f"{name}, shape {shape}, is not positive semi-definite (no variance may be negative); "
                         f"expected a covariance of shape {shape}. / {id}, ukuran {shape}, tidak semidefinit "
                         f"positif (varians tidak boleh negatif); seharusnya kovarians berukuran {shape}.")


def _without_infinite(name, R, variances):
    """R with 1 in place of every infinite variance; ValueError if such a sensor is linked to another one."""
    infinite = np.isposinf(variances)
    if not infinite.any():
        return R
    linked = (R != 0) & ~np.eye(R.shape[-1], dtype=bool)
    if (linked & (infinite[..., np.newaxis] | infinite[..., np.newaxis, :])).any():
        raise ValueError(f"{name}: a sensor with infinite variance must have covariance 0 with the others. / "
                         f"{name}: sensor dengan varians takhingga harus berkovarians 0 dengan yang lain.")
    R = R.copy()
    diagonal = np.einsum("...ii->...i", R)
    diagonal[infinite] = 1
    return R
