"""Aimed candidates: a Gauss-Newton step on what misses the target, from trials that were made anyway.

Costs say how good a trial is; the signed errors behind them say which way it missed. From the trials nearest to the best one,
a ridge regression gives the errors as a linear function of the candidate; the smallest step that takes the predicted errors
to zero gives a candidate that the optimizer tries in its next generation beside its own. It costs no trials of its own, and
where the regression is wrong, one candidate of a generation.

    J = argmin |D J - E|^2 + ridge |J|^2          D (trials, d): candidates, E (trials, k): errors, both less the best one's
    step = -J (J' J)^-1 e                         e (k,): errors of the best trial

`Aim.around` makes several: points drawn at some distances from the best trial, each moved by the smallest step after which the
same regression predicts no error. Contacts make the errors rough on the scale of a tight tolerance, whatever is predicted:
candidates that differ from each other, but are all predicted to be right, find one that is.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from levade.optimizers.blas import single_threaded
from levade.trajectory import Array

RIDGE = 1e-3
"""Of the mean squared length of the differences: damps directions in which the trials hardly differ."""
SPREADS = (0.3, 0.1, 0.03)
"""How far from the best trial `Aim.around` starts, in turns, in steps of the optimizer; once it starts at the best itself."""
WITHIN = 0.3
"""Share of the tolerance that predicted errors of `Aim.around` may have."""


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

    def around(self, count: int, *, factor: Array, step: float, generator: np.random.Generator) -> Array:
        """Candidates (count, d) to try next; none, (0, d), while too few trials are known.

        factor: (d, m), the optimizer's: distances are measured, and points drawn, in its coordinates. step: its step size.
        """
        none = np.empty((0, len(factor)))
        if self._seen is None or len(self._seen[1]) < 3 * (self._seen[1].shape[1] + 1) or count < 1:
            return none
        candidates, errors, cost = self._seen
        best, k = int(np.argmin(cost)), errors.shape[1]
        with single_threaded():
            coordinates = np.linalg.lstsq(factor, (candidates - candidates[best]).T, rcond=1e-8)[0].T
            length = np.einsum("nm,nm->n", coordinates, coordinates)
            nearest = self._nearest(length)
            if k == 0 or nearest.size < 2 * k:
                return none
            weight = np.sqrt(1.0 / (length[nearest] / np.median(length[nearest]) + 0.1))[:, None]
            slope = _ridge(coordinates[nearest] * weight, (errors[nearest] - errors[best]) * weight)  # (m, k)
            # where the best has nothing to make up for, it need not be tried again
            first = SPREADS[-1] if (np.abs(errors[best]) <= WITHIN).all() else 0.0
            spread = np.array([first, *itertools.islice(itertools.cycle(SPREADS), count - 1)])
            drawn = step * spread[:, None] * generator.standard_normal((count, factor.shape[1]))
            predicted = errors[best] + drawn @ slope
            normal = _normal(slope)
            drawn -= np.linalg.solve(normal, (predicted - np.clip(predicted, -WITHIN, WITHIN)).T).T @ slope.T
            reach = np.linalg.norm(drawn, axis=1, keepdims=True)
            farthest = 3.0 * np.sqrt(length[nearest].max())
            drawn *= farthest / np.maximum(reach, farthest)
            return candidates[best] + drawn @ factor.T

    def _nearest(self, length: Array) -> NDArray[np.intp]:
        """Of trials at squared distances (n,) from the best one: those to regress on, without it and what equals it."""
        nearest = np.argsort(length, kind="stable")[1 : self._neighbours + 1]
        return nearest[length[nearest] > 0]

    def _step(self, candidates: Array, errors: Array, best: int) -> Array | None:
        difference = candidates - candidates[best]
        length = np.einsum("nd,nd->n", difference, difference)
        nearest = self._nearest(length)
        if nearest.size < 2 * errors.shape[1]:
            return None
        change = errors[nearest] - errors[best]
        scale = np.sqrt(np.maximum(length[nearest].mean(), np.finfo(float).tiny))
        slope = _ridge(difference[nearest] / scale, change, length=1.0)  # (d, k)
        # what is well within its bounds stays; the rest is to vanish
        wanted = np.where(np.abs(errors[best]) > 0.5, errors[best], 0.0)
        if not wanted.any():
            return None
        normal = _normal(slope)
        step = -slope @ np.linalg.solve(normal, wanted)
        reach = np.sqrt(np.einsum("d,d->", step, step))
        farthest = 3.0 * np.sqrt(length[nearest].max()) / scale
        if reach > farthest:  # the regression knows nothing that far away
            step *= farthest / reach
        return candidates[best] + scale * step


def _ridge(difference: Array, change: Array, *, length: float | None = None) -> Array:
    """(d, k), the slope J of errors. difference: (n, d). change: (n, k). length: mean squared one of the differences."""
    gram = difference @ difference.T
    gram[np.diag_indices_from(gram)] += RIDGE * (np.trace(gram) / len(gram) if length is None else length)
    return np.asarray(difference.T @ np.linalg.solve(gram, change))


def _normal(slope: Array) -> Array:
    """(k, k), J' J, made safe to solve with. slope: J, (d, k)."""
    normal = slope.T @ slope
    normal[np.diag_indices_from(normal)] += 1e-9 * np.trace(normal) + np.finfo(float).tiny
    return normal
