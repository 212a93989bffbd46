"""Results that keep x and P, and make their other fields when they are read."""
import functools
from dataclasses import fields

import numpy as np

from ..filters import FilterResult, SmootherResult
from ..roots import root_of


def _lazy(Result):
    """A subclass of the dataclass whose fields may be functions: such a field is computed when it is first read."""
    def reader(name):
        def read(self):
            value = self.__dict__[name]
            if callable(value):
                value = value()
            if value is not None and value.flags.writeable:
                value = value.view()
                value.setflags(write=False)
            self.__dict__[name] = value
            return value
        return property(read)

    def __init__(self, **values):
        self.__dict__.update(values)

    def __reduce__(self):                       # pickled, copied: with all fields, as the plain dataclass
        return Result, tuple(getattr(self, field.name) for field in fields(Result))

    names = {field.name: reader(field.name) for field in fields(Result)}
    members = {"__init__": __init__, "__reduce__": __reduce__, "__doc__": Result.__doc__}
    return type("Lazy" + Result.__name__, (Result,), members | names)


LazyFilterResult, LazySmootherResult = _lazy(FilterResult), _lazy(SmootherResult)


def repeat_last(a, T):
    """a (k, ...) as (T, ...): what has settled stays."""
    if len(a) == T:
        return a
    whole = np.empty((T, *a.shape[1:]))
    whole[:len(a)] = a
    whole[len(a):] = a[-1]
    return whole


class Gains:
    """P (k, n, n) of the first steps of a Series, and its P_pred, S and K: later ones are as the last."""

    def __init__(self, s, P):
        self.s = s
        self.P = P

    @functools.cached_property
    def P_pred(self):
        F, Q, T = self.s.F, self.s.Q, len(self.s.z)
        steps = T if self.s.varies else min(len(self.P) + 1, T)         # P_pred settles one step after P
        before = np.concatenate([self.s.P0[np.newaxis], repeat_last(self.P, max(steps, len(self.P)))])[:steps]
        P_pred = F @ before @ F.T + Q
        return (P_pred + P_pred.swapaxes(1, 2)) / 2

    @functools.cached_property
    def S(self):
        return self.s.H @ self.P_pred @ self.s.H.T + self.s.R

    @functools.cached_property
    def K(self):
        HP = self.s.H @ self.P_pred
        if self.s.silent is None:
            return np.linalg.solve(self.S, HP).swapaxes(1, 2)
        K = np.zeros((len(HP), *self.s.H.T.shape))
        for pattern in np.unique(self.s.silent, axis=0):
            rows, heard = np.flatnonzero((self.s.silent == pattern).all(axis=1)), np.flatnonzero(~pattern)
            S = self.S[np.ix_(rows, heard, heard)]
            K[np.ix_(rows, range(K.shape[1]), heard)] = np.linalg.solve(S, HP[np.ix_(rows, heard)]).swapaxes(1, 2)
        return K


def result_of(gains, x):
    """The FilterResult of x (T, n) or (T, n, N) with these gains."""
    s, T = gains.s, len(x)

    def innovations():
        return s.z - apply(s.H, predictions(s, x))

    def whole(name):
        return lambda: repeat_last(getattr(gains, name), T)

    fixed = {name: np.broadcast_to(M, (T, *M.shape[-2:])) for name, M in zip("FHQR", (s.F, s.H, s.Q, s.R))}
    result = LazyFilterResult(
        x=x, x_pred=lambda: predictions(s, x), y=innovations, P=whole("P"), P_pred=whole("P_pred"), S=whole("S"),
        K=whole("K"), start=root_of(s.P0), gated=lambda: np.zeros(s.z.shape, dtype=bool), **fixed)
    result.__dict__["gains"] = gains
    return result


def predictions(s, x):
    """x_pred = F x + B u of all steps at once: x (T, n) or (T, n, N) -> the same shape."""
    x_pred = np.empty_like(x)
    first = s.F @ s.x0
    x_pred[0] = first if x.ndim == 2 else first[:, np.newaxis]
    x_pred[1:] = apply(s.F, x[:-1])
    if s.drive is not None:
        x_pred += s.drive if x.ndim == 2 else s.drive[:, :, np.newaxis]
    return x_pred


def apply(A, x):
    """A x for every step: x (T, n) or (T, n, N)."""
    return x @ A.T if x.ndim == 2 else A @ x
