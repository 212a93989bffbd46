"""kalman_filter and rts_smooth as fast as NumPy allows; equal to the readable ones in filters.py to 1e-12 (tests).

Five ideas, each of which leaves the result as it is:
1. The equations of P, S and K hold no data. So they run first, and only until they no longer change.
2. Many runs of one model share their gains: the state of all runs is one array, and several steps of all of them are
   one product of matrices: see `_steps`.
3. A long series is many short ones side by side: see `scan` and `sweep`.
4. States that have nothing to do with each other (the axes of an attitude) are small filters of their own.
5. What nobody asks for is not computed: the result keeps x and P, and makes the other fields when they are read.

Whatever none of this fits (adapt_R, a residual of your own, a nonlinear model of one run, fewer than SHORT steps) goes
through the loop in filters.py.
"""
import functools
import math
from dataclasses import fields
from itertools import chain, repeat
from typing import NamedTuple

import numpy as np

from . import filters, rows
from .filters import FilterResult, SmootherResult, _is_complete, _series, _solve, _symmetric
from .models import LinearModel, NonlinearModel, subtract

SHORT = 50              # steps: the loop itself is quick enough
LONG = 2000             # steps: from here on in blocks side by side
CHUNK = 64              # steps whose covariances are found at once
MANY = 8                # steps of many runs that one product of matrices does
SLOW = 0.99             # a filter that keeps more of an error changes little from step to step
RUNS = 16_384           # so many of them at once: they fit into the processor's cache
STEADY = 0.9995         # a filter that keeps more than this of an error from step to step is not cut into blocks


@functools.wraps(filters.kalman_filter)
def kalman_filter(model, z, u=None, adapt_R=None):
    z, many = _series("z", z, width=model.R.shape[-1], runs=True), np.ndim(z) == 3
    complete = many or _is_complete("z", z)     # of many runs: later
    if u is not None:
        u = _series("u", u, steps=len(z))
        _is_complete("u", u)
    if many and adapt_R is None and model.R.ndim == 2:
        fits = _plain(model, u)
        if fits or (isinstance(model, NonlinearModel) and model.many_runs and z.shape[1] == 1):
            result = (_filter_runs if fits else _extended_runs)(model, z, u)
            if np.isfinite(result.x[-1]).all():         # what is not finite in z would still be there: the loop names it
                return result
    if adapt_R is None and z.ndim == 2 and len(z) >= SHORT and _plain(model, u) \
            and (model.R.ndim == 2 or len(model.R) == len(z)):
        return _filter_one(_Series.of(model, z, u, complete))
    return filters.kalman_filter(model, z, u, adapt_R)


def _plain(model, u):
    """A linear model with the usual residual, and an input that fits it."""
    return isinstance(model, LinearModel) and model.residual is subtract and \
        (u is None or (model.B is not None and u.shape[1] == model.B.shape[1]))


class _Series(NamedTuple):
    """A linear model and its data: drive (T, n) = B u or None; missing (T,) or None; R (m, m) or (T, m, m)."""
    F: np.ndarray
    H: np.ndarray
    Q: np.ndarray
    R: np.ndarray
    x0: np.ndarray
    P0: np.ndarray
    z: np.ndarray
    drive: np.ndarray | None
    missing: np.ndarray | None

    @classmethod
    def of(cls, model, z, u, complete):
        drive = None if u is None or not u.any() else u @ model.B.T
        missing = None
        if not complete:
            missing = np.isnan(z).any(axis=1)
            z = np.where(missing[:, np.newaxis], np.nan, z)     # one NaN, and no sensor has measured
        return cls(model.F, model.H, model.Q, model.R, model.x0, model.P0, z, drive, missing)

    def part(self, states, sensors):
        """The series of some states and sensors alone."""
        def indices(numbers):                   # a slice, where it can be, for it copies nothing
            neighbours = numbers == list(range(numbers[0], numbers[0] + len(numbers))) if numbers else False
            return slice(numbers[0], numbers[-1] + 1) if neighbours else np.array(numbers, dtype=int)

        def cut(M, rows, columns):
            return M[..., rows, :][..., columns]
        i, j = indices(states), indices(sensors)
        return self._replace(F=cut(self.F, i, i), H=cut(self.H, j, i), Q=cut(self.Q, i, i), R=cut(self.R, j, j),
                             x0=self.x0[i], P0=cut(self.P0, i, i), z=self.z[:, j],
                             drive=None if self.drive is None else self.drive[:, i])


# --- results that compute their fields when they are read ------------------------------------------------------------

def _lazy(Result):
    """A subclass of the dataclass whose fields may be given as functions: such a field is computed when first read."""
    def reader(name):
        def read(self):
            value = self.__dict__[name]
            if callable(value):
                value = self.__dict__[name] = value()
            return value
        return property(read)

    def __init__(self, **values):
        self.__dict__.update(values)

    def __reduce__(self):                       # pickled, copied: with all fields, as the plain dataclass
        return Result, tuple(getattr(self, field.name) for field in fields(Result))

    names = {field.name: reader(field.name) for field in fields(Result)}
    return type("Lazy" + Result.__name__, (Result,), {"__init__": __init__, "__reduce__": __reduce__,
                                                      "__doc__": Result.__doc__, **names})


LazyFilterResult, LazySmootherResult = _lazy(FilterResult), _lazy(SmootherResult)


def _repeat_last(a, T):
    """a (k, ...) as (T, ...): what has settled stays. A read-only view where that costs no memory."""
    if len(a) == T:
        return a
    if len(a) == 1:
        return np.broadcast_to(a, (T, *a.shape[1:]))
    whole = np.empty((T, *a.shape[1:]))
    whole[:len(a)], whole[len(a):] = a, a[-1]
    return whole


class _Gains:
    """P_pred, P, S and K of the first steps of a _Series, each (k, ...): at later steps they are the last one."""

    def __init__(self, s, steps, P):
        """P (steps, n, n), or a function that gives it."""
        self.s, self._P = s, P
        settled = s.missing is None and s.R.ndim == 2
        self.steps = min(steps + 1, len(s.z)) if settled else len(s.z)      # P_pred settles one step after P

    @functools.cached_property
    def P(self):
        return self._P() if callable(self._P) else self._P

    @functools.cached_property
    def P_pred(self):
        P = _repeat_last(self.P, max(self.steps, len(self.P)))[:self.steps - 1]
        P_pred = self.s.F @ np.concatenate([self.s.P0[np.newaxis], P]) @ self.s.F.T + self.s.Q
        return (P_pred + P_pred.swapaxes(1, 2)) / 2

    @functools.cached_property
    def S(self):
        return self.s.H @ self.P_pred @ self.s.H.T + self.s.R

    @functools.cached_property
    def K(self):
        K = np.linalg.solve(self.S, self.s.H @ self.P_pred).swapaxes(1, 2)
        if self.s.missing is not None:
            K[self.s.missing] = 0
        return K

    def stacked(self):
        """The fields of a FilterResult, each a function that gives all T steps."""
        T = len(self.s.z)
        whole = {name: lambda name=name: _repeat_last(getattr(self, name), T) for name in ("P_pred", "P", "S", "K")}
        return whole | {name: lambda M=M: np.broadcast_to(M, (T, *M.shape[-2:])) for name, M in
                        (("F", self.s.F), ("R", self.s.R))}


def _result(s, x, gains):
    """The FilterResult of x (T, n) or (T, n, runs) and the gains; innovations and predictions when they are read."""
    def y():
        innovation = s.z - _apply(s.H, predictions(s, x))
        if s.missing is not None:
            innovation[s.missing] = np.nan
        return innovation
    result = LazyFilterResult(x=x, x_pred=lambda: predictions(s, x), y=y, **gains.stacked())
    result.__dict__["gains"] = gains
    return result


def predictions(s, x, first=0, out=None):
    """x_pred = F x + B u of the steps from `first` on, all at once: x (T, n) or (T, n, runs) -> the same shape."""
    x_pred = np.empty_like(x[first:]) if out is None else out
    if first == 0:
        x_pred[0] = s.F @ s.x0 if x.ndim == 2 else (s.F @ s.x0)[:, np.newaxis]
    _apply(s.F, x[max(first, 1) - 1:-1], out=x_pred[first == 0:])
    if s.drive is not None:
        x_pred += s.drive[first:] if x.ndim == 2 else s.drive[first:, :, np.newaxis]
    return x_pred


def _apply(A, x, out=None):
    """A x for every step: x (T, n) or (T, n, runs)."""
    if A.size == 1:
        return np.multiply(x, A[0, 0], out=out)
    return np.matmul(x, A.T, out=out) if x.ndim == 2 else np.matmul(A, x, out=out)


# --- one run ---------------------------------------------------------------------------------------------------------

def _filter_one(s):
    """The FilterResult of one run."""
    parts = independent(s)
    varies = s.missing is not None or s.R.ndim == 3
    found = in_blocks(s, parts) if varies and len(s.z) >= LONG else None
    if found is None:
        found = [_filter_number(part) if part.F.shape == part.H.shape == (1, 1) else
                 _step_by_step(part) if varies else _filter_states(part) for _, part in parts]
    steps = len(s.z) if varies else max(len(P) for _, P in found)
    x = found[0][0] if len(parts) == 1 else np.empty((len(s.z), len(s.x0)))
    if len(parts) > 1:
        for (states, _), (x_part, _) in zip(parts, found):
            x[:, states] = x_part
    return _result(s, x, _Gains(s, steps, lambda: _together(s, parts, [P for _, P in found])))


def _together(s, parts, covariances):
    """P (steps, n, n) from those of the parts, each (k, ...) or a function that gives it."""
    covariances = [P() if callable(P) else P for P in covariances]
    if len(parts) == 1:
        return covariances[0]
    steps = max(map(len, covariances))
    whole = np.zeros((steps, *s.F.shape))
    for (states, _), P in zip(parts, covariances):
        whole[(slice(None), *np.ix_(states, states))] = _repeat_last(P, steps)
    return whole


def independent(s):
    """The filters into which s falls apart: [(states, their series), ...]; F, Q, P0, H and R never link two of them."""
    n = len(s.x0)
    if n == 1:
        return [([0], s)]
    R = s.R if s.R.ndim == 2 else s.R.any(axis=0)
    linked = np.block([[(s.F != 0) | (s.F.T != 0) | (s.Q != 0) | (s.P0 != 0), s.H.T != 0], [s.H != 0, R != 0]])
    parts, free = [], set(range(n))
    while free:
        group, new = set(), {min(free)}
        while new:                              # whatever is linked to the group belongs to it
            group |= new
            new = set(np.flatnonzero(linked[sorted(new)].any(axis=0)).tolist()) - group
        free -= group
        states, sensors = sorted(i for i in group if i < n), sorted(i - n for i in group if i >= n)
        parts.append((states, s.part(states, sensors)))
    return parts if len(parts) > 1 else [(list(range(n)), s)]


def _filter_number(s):
    """One state, one sensor: the equations in Python floats, which for single numbers beat NumPy by far -> x, P."""
    F, H, Q, x, P = (float(M.flat[0]) for M in (s.F, s.H, s.Q, s.x0, s.P0))
    T = len(s.z)
    if s.missing is not None or s.R.ndim == 3:
        states, variances, z = [], [], _floats(s.z[:, 0])
        drive = repeat(0.0) if s.drive is None else _floats(s.drive[:, 0])
        for z_k, drive_k, R_k in zip(z, drive, _floats(np.broadcast_to(s.R, (T, 1, 1))[:, 0, 0])):
            x, P = F * x + drive_k, F * P * F + Q
            if z_k == z_k:                      # not NaN
                S = H * P * H + R_k
                x += P * H / S * (z_k - H * x)
                P *= R_k / S                    # (1 - K H) P, without a difference that cancels
            states.append(x)
            variances.append(P)
        return np.array(states)[:, np.newaxis], np.array(variances)[:, np.newaxis, np.newaxis]
    P = _variances(s)
    K = P[:, 0, 0] * (H / float(s.R[0, 0]))     # K = P H / R
    k = T if T - len(K) < LONG or abs(F * (1 - K[-1] * H)) > STEADY else len(K)
    drive = repeat(0.0) if s.drive is None else _floats(s.drive[:k, 0])
    states = [x := (x_pred := F * x + drive_k) + K_k * (z_k - H * x_pred)
              for z_k, drive_k, K_k in zip(_floats(s.z[:k, 0]), drive, _floats(_repeat_last(K, k)))]
    states = np.array(states)[:, np.newaxis]
    return states if k == T else _settled(s, states, K[-1:, np.newaxis]), P


def _variances(s):
    """P (k, 1, 1) of one state and one sensor, until it no longer changes."""
    F, H, Q, R, P = (float(M.flat[0]) for M in (s.F, s.H, s.Q, s.R, s.P0))
    T, FF, HH, variances = len(s.z), F * F, H * H, []
    while len(variances) < T:                   # (1 - K H) P_pred = P_pred R / S, without a difference that cancels
        variances += [P := (P_pred := FF * P + Q) * (R / (HH * P_pred + R)) for _ in range(min(64, T - len(variances)))]
        if P == variances[-2]:                  # P depends on the P before it only: from here on it stays
            break
    return np.array(variances)[:, np.newaxis, np.newaxis]


def _filter_states(s):
    """A few states with a constant R and without gaps: P by `_covariances`, then x with the gains -> x, P."""
    P = _covariances(s)
    if P is None:
        return _step_by_step(s)
    T, gains = len(s.z), _Gains(s, len(P), P)
    k = T if T - gains.steps < LONG else gains.steps
    x = np.empty((k, len(s.x0)))
    _filter_steps(s, gains.K, s.z[:k, :, np.newaxis], x[:, :, np.newaxis])
    return x if k == T else _settled(s, x, gains.K[-1]), P


def _covariances(s):
    """P (k, n, n), until it no longer changes; None where rounding is in the way.

    Whatever P was, j steps later it is A (I + P J)^-1 P A' + C, with A, J and C of these j steps alone. Those of one
    step give those of two, these of three and four, and so on: after a few rounds they are known for CHUNK steps, and
    so is every P. (Sarkka and Garcia-Fernandez, 2021, Lemma 8.) A last exact step from each P to the next one takes the
    rounding of all this away, or shows that it was too much.
    """
    T, I = len(s.z), np.eye(len(s.x0))
    S = s.H @ s.Q @ s.H.T + s.R
    K, HF = np.linalg.solve(S, s.H @ s.Q).T, s.H @ s.F
    A, C = ((I - K @ s.H) @ s.F)[np.newaxis], ((I - K @ s.H) @ s.Q @ (I - K @ s.H).T + K @ s.R @ K.T)[np.newaxis]
    J = _symmetric(HF.T @ np.linalg.solve(S, HF))[np.newaxis]
    while len(A) < min(T, CHUNK):               # first all steps so far, then 1, 2, ... more
        n, more = len(I), slice(min(T, CHUNK) - len(A))
        X = np.linalg.solve(I + C[-1] @ J[more], np.concatenate([A[-1], C[-1]], axis=1))
        A, C, J = (np.concatenate(pair) for pair in (
            (A, A[more] @ X[:, :, :n]),
            (C, _symmetric(A[more] @ X[:, :, n:] @ A[more].swapaxes(1, 2)) + C[more]),
            (J, _symmetric(A[-1].T @ J[more] @ X[:, :, :n]) + J[-1])))
    found, done = [s.P0[np.newaxis]], 0
    while done < T:
        P = found[-1][-1]
        found.append(_symmetric(A @ np.linalg.solve(I + P @ J, P) @ A.swapaxes(1, 2)) + C)
        done += len(A)
        if len(A) > 1 and _close(s, found[-1][-1], found[-1][-2]):
            break
    P = np.concatenate(found)[:T + 1]
    P_pred = _symmetric(s.F @ P[:-1] @ s.F.T) + s.Q
    HP = s.H @ P_pred
    K = np.linalg.solve(HP @ s.H.T + s.R, HP).swapaxes(1, 2)
    I_KH = I - K @ s.H
    exact = _symmetric(I_KH @ P_pred @ I_KH.swapaxes(1, 2) + K @ s.R @ K.swapaxes(1, 2))
    sigma = np.sqrt(np.abs(np.diagonal(P_pred, axis1=1, axis2=2)))
    good = np.abs(exact - P[1:]) <= 1e-13 * sigma[:, :, np.newaxis] * sigma[:, np.newaxis]
    return exact if good.all() else None        # NaN is not good either


def _step_by_step(s):
    """A few states in the quicker of the two forms of a step, until the gain has settled -> x, P."""
    T, varies, one_sensor = len(s.z), s.missing is not None or s.R.ndim == 3, len(s.H) == 1
    step = _Entries([s]) if one_sensor else _Matrices(s)
    rows_of = _floats if one_sensor else iter
    z, R = rows_of(s.z), repeat(s.R.tolist() if one_sensor else s.R) if s.R.ndim == 2 else rows_of(s.R)
    drive = repeat(None) if s.drive is None else rows_of(s.drive)
    missing = repeat(False) if s.missing is None else _floats(s.missing)
    x, P, states, covariances = (s.x0.tolist(), s.P0.tolist(), [], []) if one_sensor else (s.x0, s.P0, [], [])
    for k, z_k, R_k, drive_k, missing_k in zip(range(T), z, R, drive, missing):
        before = P
        x, P = step.predict(x, P, drive_k)
        if not missing_k:
            x, P = step.update(x, P, z_k, R_k)
        states.append(x)
        covariances.append(P)
        if not varies and k % 8 == 7 and abs(P[0][0] - before[0][0]) <= 1e-13 * P[0][0] and _close(s, P, before):
            break
    states, covariances = np.array(states), np.array(covariances)
    return states if len(states) == T else _settled(s, states, _gain(s, P)), covariances


def _floats(a):
    """The rows of an array as Python numbers, not all at once: a million of them would take a while."""
    if len(a) <= 500:
        return a.tolist()
    return chain.from_iterable(a[k:k + 500].tolist() for k in range(0, len(a), 500))


class _Matrices:
    """One step of one series in matrices, as in filters.py. Joseph's form is needed here: with several sensors of a tiny R
    every other one leaves P to rounding."""

    def __init__(self, s):
        self.s, self.I = s, np.eye(len(s.x0))

    def predict(self, x, P, drive=None):
        F = self.s.F
        return F @ x if drive is None else F @ x + drive, _symmetric(F @ P @ F.T + self.s.Q)

    def update(self, x, P, z, R):
        H = self.s.H
        HP = H @ P
        K = np.linalg.solve(HP @ H.T + R, HP).T
        I_KH = self.I - K @ H
        return x + K @ (z - H @ x), _symmetric(I_KH @ P @ I_KH.T + K @ R @ K.T)


class _Entries:
    """One step entry by entry (rows.py), for one sensor at most: of one series in Python floats, or of several parts of
    the same shape, each cut into so many blocks, all side by side."""

    def __init__(self, parts, blocks=None):
        def entries(matrices):                  # a number where all parts have the same, else an array
            def entry(values):
                return float(values[0]) if (values == values[0]).all() else np.repeat(values, blocks)
            stack = np.array(matrices)
            return [[entry(stack[:, i, j]) for j in range(stack.shape[2])] for i in range(stack.shape[1])]

        self.F, self.H = (rows.sparse(entries(M)) for M in ([s.F for s in parts], [s.H for s in parts]))
        self.Q = [[None if np.ndim(q) == 0 and q == 0 else q for q in row] for row in entries([s.Q for s in parts])]

    def predict(self, x, P, drive=None):
        x = [rows.dot(row, x) for row in self.F]
        if drive is not None:
            x = [x_i + drive_i for x_i, drive_i in zip(x, drive)]
        return x, rows.predict(P, self.F, self.Q)

    def update(self, x, P, z, R, seen=None):
        P, K, _ = rows.update(P, self.H[0], R[0][0], seen)
        y = z[0] - rows.dot(self.H[0], x)
        return [x_i + K_i * y for x_i, K_i in zip(x, K)], P


def _gain(s, P):
    """The gain K of the step after P."""
    P_pred = s.F @ np.array(P) @ s.F.T + s.Q
    return np.linalg.solve(s.H @ P_pred @ s.H.T + s.R, s.H @ P_pred).T


def _close(s, P, before):
    """Are all changes of P that are still to come, together, below 1e-13 of P?

    The changes shrink by rho^2 from step to step, rho being what a step leaves of an error: their sum is the next one
    times 1 / (1 - rho^2).
    """
    P, before = np.array(P), np.array(before)
    sigma = np.sqrt(np.abs(np.diag(P)))
    change, limit = np.abs(P - before), 1e-13 * np.outer(sigma, sigma)
    if (change > limit).any():
        return False
    K = _gain(s, P)
    return bool((change <= limit * (1 - _radius(s.F - K @ s.H @ s.F) ** 2)).all())


def _radius(A):
    """The largest |eigenvalue|: what a step leaves of an error in the long run."""
    return abs(A[0, 0]) if len(A) == 1 else np.abs(np.linalg.eigvals(A)).max()


# --- a long series as many short ones --------------------------------------------------------------------------------

def _settled(s, head, K):
    """x (T, n), of which the first steps are known, head (k, n); from there on the gain is K."""
    k, T, n = len(head), len(s.z), len(s.x0)
    x = np.empty((T, n))
    x[:k] = head
    if K.size == 1:
        np.multiply(s.z[k:], K[0, 0], out=x[k:])
    else:
        np.matmul(s.z[k:], K.T, out=x[k:])
    I_KH = np.eye(n) - K @ s.H
    if s.drive is not None:
        x[k:] += s.drive[k:] @ I_KH.T
    scan(I_KH @ s.F, x[k:], head[-1])
    return x


def scan(A, d, x):
    """x_k = A x_{k-1} + d_k for the rows of d (T, n), from x (n,); the answer replaces d.

    The series is cut into blocks of equal length, which then run side by side, one line of NumPy for a step of all
    blocks. That needs the start of every block, and it is known: the end of a block is A^length times its start plus
    sum_j A^(length - 1 - j) d_j, and that sum is one matrix product for all blocks. Nothing is approximated.
    """
    T, n = d.shape
    length = max(1, math.isqrt(T) // (3 if n == 1 else 1))
    blocks = T // length
    if blocks < 4 or not _radius(A) <= 1:
        for k in range(T):
            x = d[k] = A @ x + d[k]
        return
    powers = np.eye(n)[np.newaxis]              # I, A, A^2, ...: doubled until there are enough
    while len(powers) <= length:
        powers = np.concatenate([powers, powers @ (powers[-1] @ A)])
    whole = d[:blocks * length].reshape(blocks, length, n)
    weights = powers[length - 1::-1].transpose(0, 2, 1).reshape(length * n, n)
    start, jump = x.tolist(), rows.sparse(powers[length].tolist())
    starts = [start]
    for end in (whole.reshape(blocks, length * n) @ weights).tolist():
        start = [rows.dot(row, start) + end_i for row, end_i in zip(jump, end)]
        starts.append(start)
    lanes = np.ascontiguousarray(whole.transpose(1, 2, 0))              # (length, n, blocks)
    before, work = np.array(starts[:-1]).T.copy(), np.empty((n, blocks))
    times = np.multiply if n == 1 else np.dot
    for lane in lanes:
        times(A, before, out=work)
        lane += work
        before = lane
    whole[:] = lanes.transpose(2, 0, 1)
    x = np.array(start)
    for k in range(blocks * length, T):
        x = d[k] = A @ x + d[k]


def in_blocks(s, parts):
    """Where R changes in time or measurements are missing: [(x (T, n), a function that gives P (T, n, n)) of each part],
    or None: not exact.

    As in `scan` the blocks run side by side as soon as their starts are known. A first round finds these: it filters
    every block as if its start were known exactly (x = 0, P = 0), which ends at b with covariance C, and carries along
    what the end owes to the start, x_end = A x_start + b, and what the measurements say about the start, an
    information J with J x_start = g. Then, from block to block: the start, combined with what its own block says about
    it, gives the end, which is the start of the next block.
    """
    parts = [part for _, part in parts]
    if len({part.F.shape for part in parts}) > 1 or {len(part.H) for part in parts} != {1}:
        return None
    T, n = len(s.z), len(parts[0].x0)
    length = max(64, 2 * math.isqrt(T) // 3)
    blocks = -(-T // length)

    def lanes(arrays):                          # of each part (T, w) -> (length, w, parts * blocks)
        both = [np.concatenate([a, np.repeat(a[-1:], blocks * length - T, axis=0)]).reshape(blocks, length, -1)
                for a in arrays]
        return np.ascontiguousarray(np.concatenate(both).transpose(1, 2, 0))

    step, width = _Entries(parts, blocks), len(parts) * blocks
    R = lanes(np.broadcast_to(part.R, (T, 1, 1))[:, 0] for part in parts)[:, np.newaxis]
    z, drive, seen = lanes(part.z for part in parts), repeat(None), repeat(None)
    if s.drive is not None:
        drive = lanes(part.drive for part in parts)
    if s.missing is not None:
        z = np.nan_to_num(z, nan=0.0)
        seen = [None if row.all() else row for row in lanes([~s.missing[:, np.newaxis]] * len(parts))[:, 0] > 0]

    zero, one = np.zeros(width), np.ones(width)
    x, P = [zero] * n, [[zero] * n for _ in range(n)]
    A = [[one if i == j else zero for i in range(n)] for j in range(n)]         # its columns
    g, J = [zero] * n, [[zero] * n for _ in range(n)]
    for z_k, R_k, drive_k, seen_k in zip(z, R, drive, seen):
        x, P = step.predict(x, P, drive_k)
        A = [[rows.dot(row, column) for row in step.F] for column in A]
        H = step.H[0]
        P, K, S = rows.update(P, H, R_k[0][0], seen_k)
        y, HA = z_k[0] - rows.dot(H, x), [rows.dot(H, column) for column in A]
        HA_S = [a / S if seen_k is None else a / S * seen_k for a in HA]
        g = [g_i + a * y for g_i, a in zip(g, HA_S)]
        J = rows.symmetric(n, lambda i, j: J[i][j] + HA_S[i] * HA[j])
        x = [x_j + K_j * y for x_j, K_j in zip(x, K)]
        A = [[a - K_j * HA_j for a, K_j in zip(column, K)] for column, HA_j in zip(A, HA)]

    def stack(nested, *shape):                  # entries -> (blocks, parts, ...)
        return np.array(nested).reshape(*shape, len(parts), blocks).transpose(-1, -2, *range(len(shape)))
    A, J, C = stack(A, n, n).swapaxes(-1, -2), stack(J, n, n), stack(P, n, n)
    b, g = stack(x, n)[..., np.newaxis], stack(g, n)[..., np.newaxis]
    x, P, I = np.array([p.x0 for p in parts])[..., np.newaxis], np.array([p.P0 for p in parts]), np.eye(n)
    starts = []
    for A_b, J_b, C_b, b_b, g_b in zip(A, J, C, b, g):
        starts.append((x, P))
        P = np.linalg.solve(I + P @ J_b, P)     # (P^-1 + J)^-1
        x = A_b @ (x + P @ (g_b - J_b @ x)) + b_b
        P = A_b @ P @ A_b.swapaxes(1, 2) + C_b
        P = (P + P.swapaxes(1, 2)) / 2

    x_start = np.array([x for x, _ in starts])[..., 0].transpose(2, 1, 0).reshape(n, width)
    P_start = np.array([P for _, P in starts]).transpose(2, 3, 1, 0).reshape(n, n, width)
    upper = [(i, j) for i in range(n) for j in range(i, n)]
    x_all, P_all = np.empty((length, n, width)), np.empty((length, len(upper), width))
    x, P = list(x_start), [list(row) for row in P_start]
    for k, z_k, R_k, drive_k, seen_k in zip(range(length), z, R, drive, seen):
        x, P = step.predict(x, P, drive_k)
        x, P = step.update(x, P, z_k, R_k, seen_k)
        for row, x_i in zip(x_all[k], x):
            row[:] = x_i
        for row, (i, j) in zip(P_all[k], upper):
            row[:] = P[i][j]

    first = np.arange(width) % blocks == 0      # of each part: the block that no other one precedes
    ends = np.roll(x_all[-1], 1, axis=1), np.roll(P_all[-1], 1, axis=1)
    for end, start in zip(ends, (x_start, np.array([P_start[i, j] for i, j in upper]))):
        if not (np.abs(end - start) <= 1e-13 * np.abs(start).max(axis=1, keepdims=True))[:, ~first].all():
            return None                         # rounding (a huge J beside a huge P): then one step after the other

    def dense(part):                            # P (T, n, n) of a part, when it is asked for
        flat, P = P_all[:, :, part].transpose(2, 0, 1).reshape(blocks * length, -1)[:T], np.empty((T, n, n))
        for q, (i, j) in enumerate(upper):
            P[:, i, j] = P[:, j, i] = flat[:, q]
        return P
    found = []
    for p in range(len(parts)):
        part = slice(p * blocks, (p + 1) * blocks)
        x = x_all[:, :, part].transpose(2, 0, 1).reshape(blocks * length, n)[:T]
        found.append((x, functools.partial(dense, part)))
    return found


# --- many runs -------------------------------------------------------------------------------------------------------

def _filter_runs(model, z, u):
    """z (T, m, runs) of a linear model: the gains once, then every run with the same numbers.

    x = x_pred + K (z - H x_pred) with x_pred = F x + B u is, sorted by what changes,
    (I - K H) F x + K z + (I - K H) B u.
    """
    s = _Series.of(model, z, u, True)
    (T, m, runs), nothing = z.shape, np.zeros(z.shape[:2])
    if T < SHORT:
        P = filters.kalman_filter(model, nothing).P
    else:
        parts, found = independent(s._replace(z=nothing)), []
        for _, part in parts:
            P = (_variances if part.F.shape == part.H.shape == (1, 1) else _covariances)(part)
            found.append(_step_by_step(part)[1] if P is None else P)
        P = _together(s, parts, found)
    gains, x = _Gains(s, len(P), P), np.empty((T, len(s.x0), runs))
    _filter_steps(s, gains.K, z, x)
    return _result(s, x, gains)


def _filter_steps(s, K, z, x):
    """With known gains x = x_pred + K (z - H x_pred), for all runs z (T, m, runs), into x (T, n, runs).

    With x_pred = F x + B u that is, sorted by what changes, (I - K H) F x + K z + (I - K H) B u.
    """
    I_KH, drive = np.eye(len(s.x0)) - K @ s.H, None
    if s.drive is not None:
        drive = (_repeat_last(I_KH, len(x)) @ s.drive[:len(x), :, np.newaxis])[:, :, 0]
    A = I_KH @ s.F
    if _radius(A[-1]) > SLOW:                   # what a step changes, without the digits that 1 - K loses of a small K
        A = s.F - np.eye(len(s.x0)) - K @ (s.H @ s.F)
        _steps(A, K, z, drive, s.x0[:, np.newaxis], x, changes=True)
    else:
        _steps(A, K, z, drive, s.x0[:, np.newaxis], x)


@np.errstate(over="ignore", invalid="ignore")   # kalman_filter looks at the end
def _steps(A, K, z, drive, start, x, backwards=False, changes=False):
    """x_k = A_k x_{k-1} + K_k z_k + drive_k for all runs, into x (T, n, runs); z (T, m, runs), drive (T, n) or None,
    start (n, runs) or (n, 1). A (k, n, n) and K (k, n, m): at later steps they are the last one. Backwards:
    x_k = A_k x_{k+1} + K_k z_k + drive_k, from the last step to the first. With changes=True A is what a step adds,
    x_k = x_{k-1} + A_k x_{k-1} + ...

    Many multiplications by a number read and write all runs again and again. One product of matrices does it for MANY
    steps: the states after each of them are M [x; z of the first; z of the second; ...; 1].
    """
    (T, n, runs), m, many = x.shape, z.shape[1], min(MANY, len(x))
    blocks = -(-T // many)
    distinct = min(blocks, -(-len(A) // many) + 1)
    A, K = (M[np.minimum(np.arange(distinct * many), len(M) - 1)].reshape(distinct, many, *M.shape[1:]) for M in (A, K))
    last = T - (blocks - 1) * many              # steps of the last block
    whole, rest = _products(A, K, backwards, changes), _products(A[-1:, :last], K[-1:, :last], backwards, changes)[0]
    if drive is not None:
        padded = np.concatenate([drive, np.zeros((blocks * many - T, n))]).reshape(blocks, many, n)
        owed = _owed(A + np.eye(n) if changes else A, padded, backwards)
    for part in (slice(first, first + RUNS) for first in range(0, runs, RUNS)):
        before = np.broadcast_to(start, (n, runs))[:, part]
        W = np.empty((n + many * m + 1, before.shape[1]))
        for i in reversed(range(blocks)) if backwards else range(blocks):
            steps, M = (last, rest) if i == blocks - 1 else (many, whole[min(i, distinct - 1)])
            W_i, k = W[:n + steps * m + 1], slice(i * many, i * many + steps)
            W_i[:n], W_i[n:-1] = before, z[k, :, part].reshape(-1, before.shape[1])
            if drive is None:
                M, W_i = M[:, :-1], W_i[:-1]
            else:
                M[:, -1], W_i[-1] = owed[i, :steps].ravel(), 1
            block = np.dot(M, W_i, out=x[k].reshape(-1, runs) if runs <= RUNS else None)
            if changes:
                block.reshape(steps, n, -1)[:] += before
            if runs > RUNS:
                x[k, :, part] = block.reshape(steps, n, -1)
            before = block[:n] if backwards else block[-n:]


def _products(A, K, backwards, changes):
    """M of `_steps` for every block: A (blocks, many, n, n), K (blocks, many, n, m) -> (blocks, many n, n + many m + 1)."""
    (blocks, many, n, m), order = K.shape, range(K.shape[1])
    M, row = np.empty((blocks, many, n, n + many * m + 1)), np.zeros((blocks, n, n + many * m + 1))
    if not changes:
        row[:, :, :n] = np.eye(n)
    for j in reversed(order) if backwards else order:
        if changes:
            row += A[:, j] @ row
            row[:, :, :n] += A[:, j]
        else:
            row = A[:, j] @ row
        row[:, :, n + j * m:n + (j + 1) * m] = K[:, j]
        M[:, j] = row
    return M.reshape(blocks, many * n, -1)


def _owed(A, drive, backwards):
    """What the states after each step of a block owe to its drive (blocks, many, n) -> the same shape."""
    owed, x, order = np.empty_like(drive), np.zeros((*drive[:, 0].shape, 1)), range(drive.shape[1])
    settled = np.minimum(np.arange(len(drive)), len(A) - 1)
    for j in reversed(order) if backwards else order:
        x = A[settled, j] @ x + drive[:, j, :, np.newaxis]
        owed[:, j] = x[..., 0]
    return owed


def _extended_runs(model, z, u):
    """The extended Kalman filter of many runs, z (T, 1, runs), entry by entry: every run has its own P, S, K and F.

    These have the axis of the runs, too, as their last one: P (T, n, n, runs) and so on.
    """
    T, m, runs = z.shape
    n, R, Q = len(model.x0), float(model.R[0, 0]), [[q or None for q in row] for row in model.Q.tolist()]
    u = repeat(None) if u is None else u
    x, P = np.empty((T, n, runs)), []
    x_k, P_k = np.repeat(model.x0[:, np.newaxis], runs, axis=1), model.P0.tolist()
    for k, u_k in zip(range(T), u):
        F = rows.sparse(model.F(x_k, u_k))
        x_pred = model.f(x_k, u_k)
        P_k = rows.predict(P_k, F, Q)
        y = model.residual(z[k], model.h(x_pred))[0]
        P_k, K, _ = rows.update(P_k, rows.sparse(model.H(x_pred))[0], R)
        x_k = x[k]
        for i, K_i in enumerate(K):
            np.add(x_pred[i], K_i * y, out=x_k[i])
        P.append(P_k)

    def dense(M, *shape):
        """Rows of entries, numbers or (runs,), as an array (..., runs)."""
        return np.array([[np.broadcast_to(entry, runs) for entry in row] for row in M]).reshape(*shape, runs)

    @functools.cache
    def everything():                           # what is rarely read is computed again rather than kept
        columns, x_k, P_k = [], np.repeat(model.x0[:, np.newaxis], runs, axis=1), model.P0.tolist()
        for k, u_k in zip(range(T), u):
            F, x_pred = model.F(x_k, u_k), model.f(x_k, u_k)
            P_pred = dense(rows.predict(P_k, rows.sparse(F), Q), n, n)
            H = dense(model.H(x_pred), m, n)
            HP = np.einsum("ijr,jkr->rik", H, P_pred)
            S = np.einsum("rij,kjr->rik", HP, H) + model.R
            K = np.linalg.solve(S, HP)
            columns.append((x_pred, P_pred, model.residual(z[k], model.h(x_pred)), S.transpose(1, 2, 0),
                            K.transpose(2, 1, 0), dense(F, n, n)))
            x_k, P_k = x[k], P[k]
        return [np.array(column) for column in zip(*columns)]

    later = {name: lambda i=i: everything()[i] for i, name in enumerate(("x_pred", "P_pred", "y", "S", "K", "F"))}
    return LazyFilterResult(x=x, P=lambda: np.array([dense(P_k, n, n) for P_k in P]),
                            R=np.broadcast_to(model.R, (T, m, m)), **later)


# --- the smoother ----------------------------------------------------------------------------------------------------

@functools.wraps(filters.rts_smooth)
def rts_smooth(result):
    gains = result.__dict__.get("gains")
    if gains is None or result.x.ndim != 2:
        return filters.rts_smooth(result)
    T, n = result.x.shape
    G = _smoother_gains(gains)
    if T - len(G) >= LONG and _radius(G[-1]) <= STEADY:
        x = _smooth_settled(gains.s, result.x, G)
    elif n == 1:
        x = _smooth_numbers(result.x, predictions(gains.s, result.x), G)
    else:
        return filters.rts_smooth(result)
    return LazySmootherResult(x=x, P=lambda: _smoother_P(gains, G, T), G=lambda: _repeat_last(G, T - 1))


def smooth_runs(result):
    """rts_smooth of many runs at once: a FilterResult with x (T, n, runs) -> SmootherResult with x (T, n, runs).

    P (T, n, n) and G (T - 1, n, n) are the same for all runs.
    """
    gains = result.__dict__.get("gains")
    if gains is None or result.x.ndim != 3:
        raise ValueError("smooth_runs takes the result of kalman_filter for many runs of a LinearModel, "
                         "x of shape (T, n, runs). / smooth_runs menerima hasil kalman_filter untuk banyak percobaan "
                         "suatu LinearModel, x berukuran (T, n, runs).")
    s, x, G = gains.s, result.x, _smoother_gains(gains)
    smooth = np.empty_like(x)
    smooth[-1] = x[-1]
    if len(x) > 1:                              # x + G (x_next - F x - B u), sorted by what changes
        drive = None if s.drive is None else -(_repeat_last(G, len(x) - 1) @ s.drive[1:, :, np.newaxis])[:, :, 0]
        _steps(G, np.eye(len(s.x0)) - G @ s.F, x[:-1], drive, x[-1], smooth[:-1], backwards=True)
    return LazySmootherResult(x=smooth, P=lambda: _smoother_P(gains, G, len(x)), G=lambda: _repeat_last(G, len(x) - 1))


def _smoother_gains(gains):
    """G = P F' P_pred^-1 of the first steps; at later ones it is the last one."""
    P, P_next = _repeat_last(gains.P, max(gains.steps, len(gains.P)))[:gains.steps - 1], gains.P_pred[1:]
    FP = gains.s.F @ P
    try:
        return np.linalg.solve(P_next, FP).swapaxes(1, 2)
    except np.linalg.LinAlgError:               # a state known exactly
        return np.array([_solve(A, b).T for A, b in zip(P_next, FP)])


def _smooth_numbers(x, x_pred, G):
    """One state, in Python floats from the last step back."""
    smooth = x_next = float(x[-1, 0])
    backwards = zip(x[-2::-1, 0].tolist(), x_pred[:0:-1, 0].tolist(), _repeat_last(G, len(x) - 1)[::-1, 0, 0].tolist())
    return np.array([x_next] + [smooth := x_k + G_k * (smooth - x_pred_next) for x_k, x_pred_next, G_k in backwards]
                    )[::-1, np.newaxis]


def _smooth_settled(s, x, G):
    """Where G has settled, x_k + G (x_{k+1} - x_pred_{k+1}) is a scan that starts at the last step; then the others."""
    k, smooth = len(G) - 1, np.empty_like(x)
    smooth[-1] = x[-1]
    d = predictions(s, x, first=k + 1, out=smooth[k:-1])
    d = np.subtract(x[k:-1], _apply(G[-1], d, out=d if d.shape[1] == 1 else None), out=d)
    scan(G[-1], d[::-1], x[-1])                 # which leaves its answer in smooth
    x_pred = predictions(s._replace(drive=None if s.drive is None else s.drive[:k + 1]), x[:k + 1])
    for i in reversed(range(k)):
        smooth[i] = x[i] + G[i] @ (smooth[i + 1] - x_pred[i + 1])
    return smooth


def _smoother_P(gains, G, T):
    """P (T, n, n) of the smoother: it settles backwards, too, and changes again where the filter had not yet settled."""
    P, P_pred, k = gains.P, gains.P_pred, len(G) - 1
    smooth, rest = np.empty((T, *G.shape[1:])), T - 1
    limit = 1e-13 * max(1 - _radius(G[-1]) ** 2, 0)
    smooth[rest] = P[-1]

    def back(i, P_next):
        j = min(i, k)
        return _symmetric(P[min(i, len(P) - 1)] + G[j] @ (P_next - P_pred[min(i + 1, len(P_pred) - 1)]) @ G[j].T)

    while rest > k:
        rest -= 1
        smooth[rest] = back(rest, smooth[rest + 1])
        sigma = np.sqrt(np.diag(smooth[rest])) if rest % 8 == 0 else 0
        if rest % 8 == 0 and (np.abs(smooth[rest] - smooth[rest + 1]) <= limit * np.outer(sigma, sigma)).all():
            smooth[k:rest] = smooth[rest]
            rest = k
    while rest > 0:
        rest -= 1
        smooth[rest] = back(rest, smooth[rest + 1])
    return smooth
