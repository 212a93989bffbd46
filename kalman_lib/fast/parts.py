"""A linear model and its data, in the form that the fast filters take."""

from typing import NamedTuple

import numpy as np


class Series(NamedTuple):
    """F, H, Q, R (R also (T, m, m)), x0, P0 of a model that is fixed but for R, and its data.

    z (T, m) or, of many runs, (T, m, N); drive (T, n) = B u, or None; silent (T, m) where z of one
    run is NaN, or None.
    """

    F: np.ndarray
    H: np.ndarray
    Q: np.ndarray
    R: np.ndarray
    x0: np.ndarray
    P0: np.ndarray
    z: np.ndarray
    drive: np.ndarray | None
    silent: np.ndarray | None

    @classmethod
    def of(cls, model, z, u):
        """The series of a LinearModel, z (T, m) or (T, m, N) and u (T, l) or None."""
        drive = None if u is None or not u.any() else u @ model.B.T
        silent = np.isnan(z) if z.ndim == 2 else None
        if silent is not None and not silent.any():
            silent = None
        Q, P0 = np.asarray(model.Q), np.asarray(model.P0)
        return cls(model.F, model.H, Q, model.R, model.x0, P0, z, drive, silent)

    @property
    def varies(self):
        """Do the equations of P change from step to step?"""
        return self.silent is not None or self.R.ndim == 3

    def after(self, k, x, P):
        """What is left after the first k steps, which have led to x and P."""
        return self._replace(
            x0=x,
            P0=np.asarray(P),
            z=self.z[k:],
            R=self.R if self.R.ndim == 2 else self.R[k:],
            drive=None if self.drive is None else self.drive[k:],
            silent=None if self.silent is None else self.silent[k:],
        )

    def part(self, i, j):
        """The series of the states i and the sensors j alone (lists of their numbers)."""
        i, j = np.array(i, dtype=int), np.array(j, dtype=int)
        return self._replace(
            F=self.F[np.ix_(i, i)],
            Q=self.Q[np.ix_(i, i)],
            P0=self.P0[np.ix_(i, i)],
            x0=self.x0[i],
            H=self.H[np.ix_(j, i)],
            R=self.R[..., j, :][..., j],
            z=self.z[:, j],
            drive=None if self.drive is None else self.drive[:, i],
            silent=None if self.silent is None else self.silent[:, j],
        )

    def parts(self):
        """The filters into which it falls apart: [(states, series)].

        F, Q, P0, H and R link no two of them.
        """
        n = len(self.x0)
        if n == 1:
            return [([0], self)]
        R = self.R if self.R.ndim == 2 else self.R.any(axis=0)
        state_links = (self.F != 0) | (self.F.T != 0) | (self.Q != 0) | (self.P0 != 0)
        linked = np.block([
            [state_links, self.H.T != 0],
            [self.H != 0, R != 0],
        ])
        found, free = [], set(range(n))
        while free:
            group, new = set(), {min(free)}
            while new:  # whatever is linked to the group belongs to it
                group |= new
                new = set(np.flatnonzero(linked[sorted(new)].any(axis=0)).tolist()) - group
            free -= group
            states = sorted(i for i in group if i < n)
            sensors = sorted(i - n for i in group if i >= n)
            found.append((states, self.part(states, sensors)))
        return found if len(found) > 1 else [(list(range(n)), self)]
