"""From the data to the model: how likely is it, which numbers fit it best, and is the filter right?

Sources: the likelihood through the innovations, Schweppe (1965); whiteness, Ljung and Box (1978);
the step of a continuous model, Van Loan (1978).
"""
import inspect
import warnings
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from .checks import check_covariance, numbers, shape_message
from .fast import kalman_filter
from .filters import update
from .many import run_of
from .models import LinearModel, subtract
from .numeric import check_start, differences, maximise, settle
from .roots import one_after_another, root_of, rotated


# --- how likely are the measurements? -----------------------------------------------------------

def log_likelihood(result):
    """ln of the density of all measurements under the filter that made the FilterResult.

    The innovations are independent, y ~ N(0, S), so their log-densities add up. Only what was
    measured counts: NaN in y (a silent sensor) and an infinite variance in S (R = inf) leave the
    rest of the row. An innovation that a gate left out does not count either (its y is NaN).

    y (T, m), S (T, m, m) -> a number; y (T, m, runs), S (T, m, m) or (T, m, m, runs) -> (runs,).
    ValueError: an S that is no covariance.
    """
    y, S = np.asarray(result.y), np.asarray(result.S)
    many = y.ndim == 3
    if getattr(result, "start", None) is not None and _almost_singular(S):
        runs = [run_of(result, run) for run in range(y.shape[2])] if many else [result]
        each = [_sensor_by_sensor(run) for run in runs]
        return np.array(each) if many else each[0]
    y = np.moveaxis(y, 2, 1) if many else y[:, np.newaxis]                   # (T, runs, m)
    S = np.moveaxis(S, 3, 1) if S.ndim == 4 else S[:, np.newaxis]
    variance = np.diagonal(S, axis1=2, axis2=3)
    seen = ~(np.isnan(y) | np.isinf(variance))
    e = np.where(seen, y, 0)
    if (seen == seen[:, :1]).all():         # the runs share their gaps, and so their S
        seen = seen[:, :1]
    with np.errstate(all="ignore"):
        sigma = np.where(seen, np.sqrt(variance), 1)
        both = seen[..., :, np.newaxis] & seen[..., np.newaxis, :]
        scaled = S / (sigma[..., :, np.newaxis] * sigma[..., np.newaxis, :])
        L = _cholesky(np.where(both, scaled, np.eye(y.shape[2])))
        white = (np.linalg.inv(L) @ (e / sigma)[..., np.newaxis])[..., 0]
        log_S = 2 * np.log(sigma * np.diagonal(L, axis1=2, axis2=3))
        total = -np.sum(seen * np.log(2 * np.pi) + log_S + white ** 2, axis=(0, 2)) / 2
    total = np.where(np.isnan(total), -np.inf, total)
    return total if many else float(total[0])


def _almost_singular(S):
    """Do sensors say nearly the same, so that S (T, m, m) has lost the digits that tell them apart?"""
    if S.shape[1] == 1:
        return False
    if S.ndim == 4:
        S = np.moveaxis(S, 3, 1).reshape(-1, *S.shape[1:3])
    variance = np.diagonal(S, axis1=1, axis2=2)
    sigma = np.sqrt(np.where(np.isfinite(variance), variance, 1))
    told = np.where(np.isfinite(S), S, 0) / sigma[:, :, np.newaxis] / sigma[:, np.newaxis]
    silent = ~np.isfinite(variance)
    told[silent] = told.swapaxes(1, 2)[silent] = 0
    told = told + silent[:, np.newaxis] * np.eye(S.shape[1])
    return bool(np.linalg.eigvalsh(told)[:, 0].min() < 1e-5)


def _sensor_by_sensor(result):
    """The same of one run, by the roots of P_pred: one sensor after the other, and no S of several."""
    total, L = 0.0, result.start
    for F, Q, H, R, y in zip(result.F, result.Q, result.H, result.R, result.y):
        L, _ = rotated(np.hstack([F @ L, root_of(Q)]))
        heard = np.isfinite(y)
        total -= np.linalg.slogdet(2 * np.pi * R[np.ix_(heard, heard)])[1] / 2
        for _, S, A, y_i in one_after_another(L, y, H, R):
            total -= (np.log(S) + y_i ** 2 / S) / 2
            L = L @ A
    return float(total)


def _cholesky(C):
    """The lower Cholesky factors of C (T, runs, m, m), which is S with a unit diagonal."""
    C = np.where(np.isfinite(C).all(axis=(1, 2, 3), keepdims=True), C, 0)
    try:
        return np.linalg.cholesky(C)
    except np.linalg.LinAlgError:
        k = int(np.argmax(np.linalg.eigvalsh(C).min(axis=(1, 2)) < 1e-15))
        raise ValueError(f"S[{k}] is not a covariance (positive definite). / "
                         f"S[{k}] bukan kovarians (definit positif).") from None


# --- which model makes them most likely? --------------------------------------------------------

def fit(build, start, z, u=None, free=()):
    """Maximum likelihood: the named parameters under which the measurements are most likely.

    build(**parameters) -> model; start {name: positive value}, in the units of the model; z, u as
    for kalman_filter (many runs: their log-likelihoods add up). A parameter named in `free` may be
    zero or negative. All are sought from 1e-12 to 1e12 times their start: see `numeric.maximise`.

    Returns a Fit. ValueError: a start that is not positive, names that build does not take; what is
    wrong with the model or the data at the start.
    """
    check_start(start, free)
    try:
        inspect.signature(build).bind(**start)
    except TypeError:
        raise ValueError(f"build does not take exactly the names of start: {list(start)}. / "
                         f"build tidak menerima tepat nama-nama di start: {list(start)}.") from None

    def likelihood(**values):
        result = kalman_filter(build(**values), z, u)
        if not np.isfinite(result.x).all():
            return -np.inf                  # a model that overflows explains nothing
        return np.sum(log_likelihood(result))

    found = maximise(likelihood, start, free)
    return replace(found, model=build(**found.values))


# --- are the innovations white? -----------------------------------------------------------------

class Whiteness(NamedTuple):
    """lags (L,), the correlation (L,) there, its 95 % band, and p of the test of all lags together.

    Of several sensors: correlation (L, m), band (m,), p (m,), each sensor for itself.
    """
    lags: np.ndarray
    correlation: np.ndarray
    band: Any
    p: Any


def whiteness(y, lags=None):
    """Autocorrelation of the innovations y (T,) or (T, m), and the test of Ljung and Box.

    The innovations of a right filter are white: 95 % of the correlations lie within +-band, and p
    falls below 0.05 in one case of 20 only. While a filter settles, the variance of y changes:
    divide y by the root of S, or leave its first steps out. A pair with a gap (NaN) adds nothing; a
    lag without any pair is NaN and not tested.

    lags: how many; by default 10, or a fifth of T. ValueError: too few values, or all equal.
    """
    y = _array("y", y, gaps=True)
    columns = y.reshape(len(y), -1).T if y.ndim in (1, 2) and y.size else []
    lags = min(10, max(y.shape[0] // 5, 1)) if lags is None and y.ndim else lags
    if not isinstance(lags, (int, np.integer)):
        lags = 0                                # refused below
    varies = [len(set(c[np.isfinite(c)])) > 1 for c in columns]
    if not varies or not 0 < lags < len(y) or not all(varies):
        raise ValueError("y must be (T,) or (T, m), T above lags, and vary in each column. / "
                         "y harus berukuran (T,) atau (T, m), T di atas lags, dan berubah di "
                         "setiap kolom.")
    found = zip(*(_ljung_box(column, lags) for column in columns))
    found = [values[0] if y.ndim == 1 else np.array(values).T for values in found]
    return Whiteness(np.arange(1, lags + 1), *found)


def _ljung_box(y, lags):
    """correlation (lags,), band and p of one column y (T,)."""
    from scipy.special import gammaincc
    seen = np.isfinite(y)
    e = np.where(seen, y - y[seen].mean(), 0)
    N = seen.sum()
    pairs = np.array([(seen[k:] & seen[:-k]).sum() for k in range(1, lags + 1)])
    products = np.array([e[k:] @ e[:-k] for k in range(1, lags + 1)])
    tested = pairs > 0
    correlation = np.where(tested, products / (e @ e), np.nan)
    chi2 = N * (N + 2) * np.sum(correlation[tested] ** 2 / pairs[tested])
    return correlation, 1.959963984540054 / np.sqrt(N), gammaincc(tested.sum() / 2, chi2 / 2)


# --- the filter that has settled ----------------------------------------------------------------

class Steady(NamedTuple):
    """P_pred (n, n), P (n, n), S (m, m) and K (n, m) where they no longer change."""
    P_pred: np.ndarray
    P: np.ndarray
    S: np.ndarray
    K: np.ndarray


def steady(model):
    """Where the filter of a LinearModel settles: the solution of the Riccati equation -> Steady.

    ValueError: a NonlinearModel, or one that changes in time; a state that no sensor ever sees; a
    constant without process noise, which is known ever better.
    """
    from scipy.linalg import solve_discrete_are
    if not isinstance(model, LinearModel):
        raise ValueError("steady needs a LinearModel, whose F and H do not change with x. / "
                         "steady memerlukan LinearModel, yang F dan H-nya tidak berubah bersama x.")
    F, H, Q, R = model.F, model.H, model.Q, model.R
    if max(M.ndim for M in (F, H, Q, R)) > 2 or not np.isfinite(R).all():
        raise ValueError("F, H, Q or R changes in time or is infinite: no filter settles. / "
                         "F, H, Q, atau R berubah-ubah atau takhingga: filternya tidak menetap.")
    _check_settles(F, H, Q)
    try:
        P_pred = settle(F, H, Q, R, solve_discrete_are(F.T, H.T, Q, R))
    except np.linalg.LinAlgError:
        raise ValueError("No steady state: some state is hardly seen or hardly moved. / Tidak ada "
                         "keadaan tunak: ada yang hampir tak terlihat atau tak bergerak.") from None
    _, P, _, S, K = update(model, model.x0, P_pred, H @ model.x0)
    return Steady(P_pred, P, S, K)


def _check_settles(F, H, Q):
    """ValueError if a mode that does not decay is not seen, or one that stays is not moved."""
    from scipy.linalg import matrix_balance
    F, (scale, _) = matrix_balance(F, permute=False, separate=True)     # whatever the units
    modes = np.linalg.eigvals(F)
    if _has_idle(F, H * scale, modes[np.abs(modes) > 1 - 1e-9]):
        raise ValueError("Not detectable: a state that does not decay is not seen. / "
                         "Tidak terdeteksi: suatu keadaan yang tidak meluruh tidak terlihat.")
    if _has_idle(F.T, Q / np.outer(scale, scale), modes[np.abs(np.abs(modes) - 1) < 1e-7]):
        raise ValueError("A constant has no process noise (Q = 0): its gain falls for ever. / "
                         "Suatu tetapan tanpa derau proses (Q = 0): penguatannya turun terus.")


def _has_idle(F, H, modes):
    """Is one of the modes of F (n, n) without effect on H x? (Popov, Belevitch, Hautus.)"""
    H = H / (np.abs(H).max() or 1)
    tests = [np.vstack([mode * np.eye(len(F)) - F, H]) for mode in modes]
    return any(np.linalg.svd(M, compute_uv=False)[-1] < 1e-9 for M in tests)


# --- from continuous time to a step -------------------------------------------------------------

def discretise(A, Qc, dt, Bc=None):
    """F and Q of a step dt of dx/dt = A x + Bc u + noise; with Bc also B, for u held over the step.

    A (n, n) per second; Qc (n, n) spectral density of the noise, unit of x squared per second;
    dt s, a number, or (T,) for uneven steps; Bc (n, l) per second.
    F = exp(A dt), Q = integral of exp(A s) Qc exp(A s)' over the step (Van Loan, 1978).

    -> F, Q or F, Q, B; for dt (T,) each (T, ., .). ValueError: shapes, Qc no covariance, dt <= 0.
    """
    n = len(np.atleast_1d(A))
    A = _array("A", A, (n, n))
    Qc = _array("Qc", Qc, (n, n))
    check_covariance("Qc", Qc)
    l = 0 if Bc is None else np.atleast_2d(Bc).shape[-1]
    drive = _array("Bc", np.zeros((n, 0)) if Bc is None else Bc, (n, l))
    seconds = _array("dt", dt)
    if seconds.ndim > 1 or not (seconds > 0).all():
        raise ValueError("dt must be a number of seconds above 0, or (T,) of them. / "
                         "dt harus bilangan detik di atas 0, atau (T,) bilangan semacam itu.")
    different, which = np.unique(seconds, return_inverse=True)
    steps = [_step_of(A, Qc, drive, h) for h in different]
    F, Q, B = (np.array(column)[which.reshape(seconds.shape)] for column in zip(*steps))
    if not np.isfinite(F).all():
        raise ValueError("dt is too long: F = exp(A dt) overflows. / "
                         "dt terlalu panjang: F = exp(A dt) melampaui batas bilangan.")
    return (F, Q) if Bc is None else (F, Q, B)


def _step_of(A, Qc, Bc, dt):
    """F, Q, B of one step: their power series for a step short enough, which is then doubled.

    The derivatives of exp(A s) Qc exp(A s)' at s = 0 are M, A M + M A', and so on: every entry is
    summed for itself, so that dt^7 beside dt keeps its digits.
    """
    size = np.abs(A).sum(axis=0).max() * dt
    doublings = max(0, int(np.ceil(np.log2(max(2 * size, 1)))))
    h = dt / 2 ** doublings
    F, Q, B = np.zeros_like(A), np.zeros_like(A), np.zeros_like(Bc)
    power, M, drive = np.eye(len(A)), Qc * h, Bc * h            # the next terms
    for k in range(1, 40 + 2 * len(A)):
        F, Q, B = F + power, Q + M, B + drive
        power = A @ power * (h / k)
        M = (A @ M + M @ A.T) * (h / (k + 1))
        drive = A @ drive * (h / (k + 1))
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(doublings):
            Q = Q + F @ Q @ F.T
            B = B + F @ B
            F = F @ F
    return F, (Q + Q.T) / 2, B


# --- are the Jacobians right? -------------------------------------------------------------------

class Jacobians(NamedTuple):
    """F (n, n) and H (m, n) by central differences, and how far the model's own are from them."""
    F: np.ndarray
    H: np.ndarray
    F_error: np.ndarray
    H_error: np.ndarray


def check_jacobians(model, x, u=None):
    """Compare F and H of a model at x (n,) with central differences of f and h -> Jacobians.

    h is compared through the model's residual, so an angle may wrap. ValueError: names the entry
    that is off by more than 1e-5 of its value and what rounding allows, and what it should be.
    """
    x = _array("x", x, model.x0.shape)
    F, F_error = _compare("F", "f(x, u)", lambda x: model.transition(x, u), x, subtract)
    H, H_error = _compare("H", "h(x, u)", lambda x: model.measure(x, u), x, model.residual)
    return Jacobians(F, H, F_error, H_error)


def _compare(name, function, values, x, residual):
    """The numerical Jacobian (m, n) of values(x)[0], and its distance from values(x)[1]."""
    value, given = values(x)
    numeric, doubt = differences(lambda x: values(x)[0], x, value, residual)
    if not np.isfinite(numeric).all():
        raise ValueError(f"{function} is not finite at x or beside it. / "
                         f"{function} tidak berhingga di x atau di sebelahnya.")
    error = np.abs(given - numeric)
    excess = error / (1e-5 * np.abs(numeric) + 10 * doubt + 1e-300)
    excess = np.where(np.isnan(excess), np.inf, excess)
    i, j = map(int, np.unravel_index(np.argmax(excess), excess.shape))
    if excess[i, j] > 1:
        entry, is_, be = f"{name}[{i}, {j}]", f"{given[i, j]:.6g}", f"{numeric[i, j]:.6g}"
        raise ValueError(f"{entry} is {is_}, but central differences of {function} give {be}. / "
                         f"{entry} bernilai {is_}, tetapi selisih pusat {function} memberi {be}.")
    return numeric, error


# --- checks -------------------------------------------------------------------------------------

def _array(name, value, shape=None, gaps=False):
    """The value as a float array of that shape (None: any); with gaps it may hold NaN."""
    array = numbers(name, value, 0 if shape is None else len(shape))
    if np.isinf(array).any() or (np.isnan(array).any() and not gaps):
        raise ValueError(f"{name} must hold finite numbers only. / "
                         f"{name} hanya boleh berisi bilangan berhingga.")
    if shape is not None and array.shape != shape:
        raise ValueError(shape_message(name, array.shape, shape))
    return array
