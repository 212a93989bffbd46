"""Results that keep x and P, and make their other fields when they are read."""

import functools
from dataclasses import fields

import numpy as np

from ..filters import FilterResult, SmootherResult
from ..roots import root_of


def _compute(self, name):
    """Called for a field that is not there yet."""
    make = self.__dict__.get("later", {}).get(name)
    if make is None:
        raise AttributeError(name)
    value = make()
    value.setflags(write=False)
    self.__dict__[name] = value
    return value


def _reduce(self):
    """Pickled and copied: with all fields, as the plain dataclass."""
    Result = type(self).__base__
    return Result, tuple(getattr(self, field.name) for field in fields(Result))


def _of(cls, later, **known):
    """The result of what is known, and of functions for the rest, `later`: name -> function."""
    result = cls.__new__(cls)
    result.__dict__.update(known, later=later)
    for array in known.values():
        if isinstance(array, np.ndarray):
            array.setflags(write=False)
    return result


MEMBERS = {"__getattr__": _compute, "__reduce__": _reduce, "of": classmethod(_of)}
LazyFilterResult = type("LazyFilterResult", (FilterResult,), MEMBERS)
LazySmootherResult = type("LazySmootherResult", (SmootherResult,), MEMBERS)


def repeat_last(a, T):
    """a (k, ...) as (T, ...): what has settled stays."""
    if len(a) == T:
        return a
    whole = np.empty((T, *a.shape[1:]))
    whole[: len(a)] = a
    whole[len(a) :] = a[-1]
    return whole


class Gains:
    """P (k, n, n) of the first steps of a Series, P_pred, S and K: later ones are as the last."""

    def __init__(self, s, P):
        self.s = s
        self.P = P

    @functools.cached_property
    def P_pred(self):
        F, Q, T = self.s.F, self.s.Q, len(self.s.z)
        steps = T if self.s.varies else min(len(self.P) + 1, T)  # P_pred settles one step after P
        P = repeat_last(self.P, max(steps, len(self.P)))
        before = np.concatenate([self.s.P0[np.newaxis], P])[:steps]
        P_pred = F @ before @ F.T + Q
        return (P_pred + P_pred.swapaxes(1, 2)) / 2

    @functools.cached_property
    def S(self):
        S = self.s.H @ self.P_pred @ self.s.H.T + self.s.R
        return (S + S.swapaxes(1, 2)) / 2

    @functools.cached_property
    def K(self):
        HP = self.s.H @ self.P_pred
        if self.s.silent is None:
            return np.linalg.solve(self.S, HP).swapaxes(1, 2)
        K = np.zeros((len(HP), *self.s.H.T.shape))
        for pattern in np.unique(self.s.silent, axis=0):
            rows = np.flatnonzero((self.s.silent == pattern).all(axis=1))
            heard = np.flatnonzero(~pattern)
            S = self.S[np.ix_(rows, heard, heard)]
            solved = np.linalg.solve(S, HP[np.ix_(rows, heard)])
            K[np.ix_(rows, range(K.shape[1]), heard)] = solved.swapaxes(1, 2)
        return K


def result_of(gains, x):
    """The FilterResult of x (T, n) or (T, n, N) with these gains."""
    s, T = gains.s, len(x)

    def innovations():
        return s.z - apply(s.H, predictions(s, x))

    def whole(name):
        return lambda: repeat_last(getattr(gains, name), T)

    def fixed(name):
        M = getattr(s, name)
        return lambda: np.broadcast_to(M, (T, *M.shape[-2:]))

    later = {name: whole(name) for name in ("P", "P_pred", "S", "K")}
    later |= {name: fixed(name) for name in ("F", "H", "Q", "R")}
    later |= {
        "x_pred": lambda: predictions(s, x),
        "y": innovations,
        "start": lambda: root_of(s.P0),
        "gated": lambda: np.broadcast_to(False, s.z.shape),
    }
    return LazyFilterResult.of(later, x=x, gains=gains)


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
