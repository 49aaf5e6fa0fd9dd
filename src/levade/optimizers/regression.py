"""Aimed candidates: a Gauss-Newton step on the errors, by a regression on trials that were made anyway.

A cost says how good a trial is; the signed errors behind it say which way it missed. A ridge regression on the trials nearest
to the best one gives the errors as a linear function of the candidate. Points are drawn at some distances from the best trial,
and each is moved by the smallest step after which the regression predicts no error. These candidates differ from each other,
and all are predicted to be right. Contacts make the errors rough on the scale of a tight tolerance, so only some of them are.
The regression costs no trials of its own.

    J = argmin |D J - E|^2 + ridge |J|^2          D (trials, m): candidates, E (trials, k): errors, both less the best one's
    step = -J (J' J)^-1 e                         e (k,): predicted errors of the point
"""

from __future__ import annotations

import itertools
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.optimizers.blas import single_threaded

RIDGE = 1e-3
"""Share of the mean squared length of the differences: damps directions in which the trials hardly differ."""
SPREADS = (0.3, 0.1, 0.03)
"""How far from the best trial `ErrorRegression.around` starts, in turns, in steps of the optimizer; once at the best itself."""
WITHIN = 0.3
"""Share of the tolerance that predicted errors may have."""


class ErrorRegression:
    """Remembers trials and proposes candidates.

    Args:
        factor: Factor of the search space, shape (d, m): distances are measured, and points drawn, in its coordinates.
        rough: Coordinates in which candidates keep what the best trial has, shape (m,): see `levade.optimizers.SearchSpace`.
            None if there are none.
        one_sided: Which of the errors belong to a bound, shape (k,): 1 at it and less inside, so that they cannot be too
            small. None if none do.
        memory: Latest trials to choose from.
        neighbours: Trials, the nearest to the best, to regress on.
    """

    def __init__(
        self,
        factor: Array,
        *,
        rough: NDArray[np.bool_] | None = None,
        one_sided: NDArray[np.bool_] | None = None,
        memory: int = 400,
        neighbours: int = 120,
    ) -> None:
        self._rough = None if rough is None or not rough.any() else rough
        self._factor, self._one_sided, self._memory, self._neighbours = factor, one_sided, memory, neighbours
        self._candidates = np.empty((0, len(factor)))
        self._errors = np.empty((0, 0))
        self._cost = np.empty(0)

    @cached_property
    def _inverse(self) -> Array:
        """Return the matrix from candidates to the factor's coordinates, shape (m, d)."""
        return np.asarray(np.linalg.pinv(self._factor, rcond=1e-8))

    def tell(self, candidates: Array, errors: Array, cost: Array) -> None:
        """Remember a generation.

        Args:
            candidates: Candidates, shape (n, d).
            errors: Signed errors as shares of the tolerances, shape (n, k). NaN where unknown; the whole row of a trial that
                diverged.
            cost: Costs, shape (n,).
        """
        known = np.isfinite(errors).any(axis=1)
        if not known.any():
            return
        if not len(self._cost):
            self._errors = self._errors.reshape(0, errors.shape[1])
        kept = slice(-self._memory, None)
        self._candidates = np.concatenate([self._candidates, candidates[known]])[kept]
        self._errors = np.concatenate([self._errors, errors[known]])[kept]
        self._cost = np.concatenate([self._cost, cost[known]])[kept]

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """Forget the costs of all trials, because costs have another meaning from now on.

        Args:
            changed: Which of the errors have another meaning, too, and are forgotten, shape (k,).
        """
        self._cost = np.full_like(self._cost, np.inf)
        if len(self._cost):
            self._errors = np.where(changed, np.nan, self._errors)

    @property
    def least(self) -> float:
        """The cost of the best trial; infinite before there is one."""
        return float(self._cost.min(initial=np.inf))

    @property
    def trials(self) -> tuple[Array, Array]:
        """The candidates (n, d) that are remembered, and their errors (n, k)."""
        return self._candidates, self._errors

    @property
    def best(self) -> tuple[Array, Array] | None:
        """The trial of least cost, shape (d,), and its errors (k,); None before there is one."""
        if not np.isfinite(self.least):
            return None
        best = int(np.argmin(self._cost))
        return self._candidates[best], self._errors[best]

    def around(self, count: int, *, step: float, generator: np.random.Generator) -> Array:
        """Candidates to try next.

        Args:
            count: Candidates wanted.
            step: Step size of the optimizer.
            generator: Source of the random numbers.

        Returns:
            Candidates, shape (count, d), all finite; (0, d) while too few trials are known.
        """
        none = np.empty((0, len(self._factor)))
        if count < 1 or not np.isfinite(self.least):
            return none
        best = int(np.argmin(self._cost))
        looked_at = np.flatnonzero(np.isfinite(self._errors[best]))
        errors = self._errors[:, looked_at]
        if not looked_at.size:
            return none
        with single_threaded():
            coordinates = (self._candidates - self._candidates[best]) @ self._inverse.T
            fitted = self._slope(coordinates, errors, best)
            if fitted is None:
                return none
            slope, farthest = fitted
            if self._rough is not None:
                slope[self._rough] = 0.0
            # where the best has nothing to make up for, it need not be tried again
            one_sided = None if self._one_sided is None else self._one_sided[looked_at]
            first = SPREADS[-1] if not unwanted(errors[best], one_sided).any() else 0.0
            spread = np.array([first, *itertools.islice(itertools.cycle(SPREADS), count - 1)])
            drawn = step * spread[:, None] * generator.standard_normal((count, coordinates.shape[1]))
            if self._rough is not None:
                drawn[:, self._rough] = 0.0
            return self._candidates[best] + corrected(drawn, errors[best], slope, farthest, one_sided) @ self._factor.T

    def _slope(self, coordinates: Array, errors: Array, best: int) -> tuple[Array, float] | None:
        """The slope of the errors near the best trial (m, k), and how far it may be trusted; None with too few trials.

        Errors that have been known for only a short time, such as those of the hold, have fewer trials to regress on.
        """
        length = np.einsum("nm,nm->n", coordinates, coordinates)
        known = np.isfinite(errors)
        slope, farthest = np.zeros((coordinates.shape[1], errors.shape[1])), 0.0
        alike: dict[bytes, list[int]] = {}
        for column in range(errors.shape[1]):
            alike.setdefault(known[:, column].tobytes(), []).append(column)
        for group in alike.values():
            columns = np.array(group)
            usable = np.flatnonzero(known[:, columns[0]] & (length > 0))
            if usable.size < 2 * errors.shape[1]:
                continue
            nearest = usable[np.argsort(length[usable], kind="stable")[: self._neighbours]]
            middle = length[nearest[nearest.size // 2]]  # they are sorted
            weight = np.sqrt(1.0 / (length[nearest] / middle + 0.1))[:, None]
            change = errors[np.ix_(nearest, columns)] - errors[best, columns]
            slope[:, columns] = ridge(coordinates[nearest] * weight, change * weight)
            farthest = max(farthest, 3.0 * np.sqrt(length[nearest].max()))
        return (slope, farthest) if farthest > 0 else None


def sizes(errors: Array, one_sided: NDArray[np.bool_] | None) -> Array:
    """Compute how large errors are.

    Args:
        errors: Signed errors as shares of the tolerances, shape (..., k).
        one_sided: Errors of which only the part above 0 counts, shape (k,). None if there are none.

    Returns:
        Sizes as shares of the tolerances, shape (..., k), never negative.
    """
    size = np.abs(errors)
    return size if one_sided is None else np.where(one_sided, np.maximum(errors, 0.0), size)


def unwanted(errors: Array, one_sided: NDArray[np.bool_] | None, within: Array | float = WITHIN) -> Array:
    """Compute the part of errors beyond what is wanted.

    Args:
        errors: Signed errors as shares of the tolerances, shape (..., k).
        one_sided: Errors of which only the part above ``within`` counts, shape (k,). None if there are none.
        within: Share of the tolerance that each error may have, of a shape that broadcasts to that of the errors.

    Returns:
        Signed excesses as shares of the tolerances, shape (..., k); 0 within.
    """
    low = np.negative(within) if one_sided is None else np.where(one_sided, -np.inf, np.negative(within))
    return errors - np.clip(errors, low, within)


def corrected(
    drawn: Array,
    errors: Array,
    slope: Array,
    farthest: float,
    one_sided: NDArray[np.bool_] | None = None,
    within: Array | float = WITHIN,
) -> Array:
    """Move points by the smallest step after which no unwanted errors are predicted.

    Args:
        drawn: Points, shape (n, m).
        errors: Errors at the origin, shape (k,), or at an origin of each point, (n, k).
        slope: Slope of the errors, shape (m, k).
        farthest: Largest distance from the origin.
        one_sided: See `ErrorRegression`.
        within: See `unwanted`.

    Returns:
        Moved points, shape (n, m), all finite. A point stays as drawn where no finite step is predicted to help: where trials
        all missed by the same, the slope is zero.
    """
    excess = unwanted(errors + drawn @ slope, one_sided, within)
    normal = slope.T @ slope
    normal[np.diag_indices_from(normal)] += 1e-9 * np.trace(normal) + np.finfo(float).tiny  # safe to solve with
    with np.errstate(over="ignore", invalid="ignore"):
        moved = drawn - np.linalg.solve(normal, excess.T).T @ slope.T
        moved = np.where(np.isfinite(np.linalg.norm(moved, axis=1, keepdims=True)), moved, drawn)
        reach = np.linalg.norm(moved, axis=1, keepdims=True)
        share = np.minimum(farthest / np.maximum(reach, np.finfo(float).tiny), 1.0)
    return np.asarray(moved * share)


def ridge(difference: Array, change: Array) -> Array:
    """The slope J of the errors by ridge regression.

    Args:
        difference: Candidates less the best one, shape (n, m).
        change: Their errors less those of the best one, shape (n, k).

    Returns:
        J, shape (m, k).
    """
    n, m = difference.shape
    damping = RIDGE * np.vdot(difference, difference) / n + np.finfo(float).tiny  # safe to solve with
    if m < n:  # the same in whichever space is smaller
        normal = difference.T @ difference
        normal[np.diag_indices_from(normal)] += damping
        return np.asarray(np.linalg.solve(normal, difference.T @ change))
    gram = difference @ difference.T
    gram[np.diag_indices_from(gram)] += damping
    return np.asarray(difference.T @ np.linalg.solve(gram, change))
