"""Aimed candidates: a Gauss-Newton step on what misses the target, from trials that were made anyway.

Costs say how good a trial is; the signed errors behind them say which way it missed. From the trials nearest to the best one,
a ridge regression gives the errors as a linear function of the candidate; the smallest step that takes the predicted errors
to zero gives a candidate that the optimizer tries in its next generation beside its own. It costs no trials of its own, and
where the regression is wrong, one candidate of a generation.

    J = argmin |D J - E|^2 + ridge |J|^2          D (trials, d): candidates, E (trials, k): errors, both less the best one's
    step = -J (J' J)^-1 e                         e (k,): errors of the best trial
"""

from __future__ import annotations

import numpy as np

from levade.optimizers.blas import single_threaded
from levade.trajectory import Array

RIDGE = 1e-3
"""Of the mean squared length of the differences: damps directions in which the trials hardly differ."""


class Aim:
    """Remembers trials and proposes candidates.

    memory: how many of the latest trials to choose from. neighbours: how many of them, nearest to the best, to regress on.
    """

    def __init__(self, *, memory: int = 400, neighbours: int = 120) -> None:
        self._memory, self._neighbours = memory, neighbours
        self._seen: tuple[Array, Array, Array] | None = None

    def tell(self, candidates: Array, errors: Array, cost: Array) -> None:
        """What came of a generation.

        candidates: (n, d). errors: (n, k), signed, as a share of what is allowed; NaN where unknown. cost: (n,).
        A change of k, as when more is looked at from now on, starts anew.
        """
        known = np.isfinite(errors).all(axis=1)
        new = (candidates[known], errors[known], cost[known])
        if self._seen is None or self._seen[1].shape[1] != errors.shape[1]:
            self._seen = new
        else:
            one, two, three = (np.concatenate(both)[-self._memory :] for both in zip(self._seen, new, strict=True))
            self._seen = (one, two, three)

    def forget(self) -> None:
        """Start anew: costs and errors mean something else from now on."""
        self._seen = None

    def propose(self) -> Array | None:
        """The candidate (d,) to try next; None while too few trials are known, or if the best one misses nothing by much."""
        if self._seen is None:
            return None
        candidates, errors, cost = self._seen
        n, k = errors.shape
        if k == 0 or n < 3 * (k + 1):
            return None
        with single_threaded():
            return self._step(candidates, errors, int(np.argmin(cost)))

    def _step(self, candidates: Array, errors: Array, best: int) -> Array | None:
        difference = candidates - candidates[best]
        length = np.einsum("nd,nd->n", difference, difference)
        nearest = np.argsort(length, kind="stable")[1 : self._neighbours + 1]
        nearest = nearest[length[nearest] > 0]
        if nearest.size < 2 * errors.shape[1]:
            return None
        change = errors[nearest] - errors[best]
        scale = np.sqrt(np.maximum(length[nearest].mean(), np.finfo(float).tiny))
        unit = difference[nearest] / scale
        gram = unit @ unit.T
        gram[np.diag_indices_from(gram)] += RIDGE
        slope = unit.T @ np.linalg.solve(gram, change)  # (d, k)
        # what is well within its bounds stays; the rest is to vanish
        wanted = np.where(np.abs(errors[best]) > 0.5, errors[best], 0.0)
        if not wanted.any():
            return None
        normal = slope.T @ slope
        normal[np.diag_indices_from(normal)] += 1e-9 * np.trace(normal) + np.finfo(float).tiny
        step = -slope @ np.linalg.solve(normal, wanted)
        reach = np.sqrt(np.einsum("d,d->", step, step))
        farthest = 3.0 * np.sqrt(length[nearest].max()) / scale
        if reach > farthest:  # the regression knows nothing that far away
            step *= farthest / reach
        return candidates[best] + scale * step
