"""Move the mean of a search to where a regression predicts that it meets every criterion on the nominal model.

    repair = Repair(space.factor, one_sided)
    repair.tell(candidates, errors)             # of each generation
    contender = repair.repaired(mean)           # the mean itself, if it is predicted to meet every criterion

On perturbed models the mean of a search follows what helps there. On the nominal model it may then miss a criterion by a
little, such as a speed limit, and could not become the best trial. The errors of the latest candidates on the nominal model,
which are known anyway, say how the errors depend on the candidate. The mean is moved by the smallest step after which no
criterion is predicted to be missed.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.optimizers.blas import single_threaded
from levade.optimizers.regression import corrected, ridge, unwanted

_GENERATIONS, _FEWEST = 8, 3
"""Most generations to regress on, and fewest."""

_WITHIN = 0.8
"""Share of a tolerance that a criterion may be missed by after the step, where it was missed by more than all of it. For a
criterion with a bound 1 is the bound, and less is inside."""

_ROUNDS = 6
"""Most rounds in which criteria are added that a step would make the mean miss."""


class Repair:
    """Remembers the errors of the latest generations.

    Args:
        factor: Factor of the search space, shape (d, m): steps are measured in its coordinates.
        one_sided: Which of the criteria have a bound, shape (k,): their errors cannot be too small.
    """

    def __init__(self, factor: Array, one_sided: NDArray[np.bool_]) -> None:
        self._factor, self._one_sided = factor, one_sided
        self._told: list[tuple[Array, Array]] = []

    @cached_property
    def _inverse(self) -> Array:
        """Return the matrix from candidates to the factor's coordinates, shape (m, d)."""
        return np.asarray(np.linalg.pinv(self._factor, rcond=1e-8))

    def tell(self, candidates: Array, errors: Array) -> None:
        """Remember a generation.

        Args:
            candidates: Candidates, shape (n, d).
            errors: Errors on the nominal model as shares of the tolerances, shape (n, k). NaN where unknown; the whole row of
                a trial that diverged.
        """
        known = np.isfinite(errors).any(axis=1)
        self._told = [*self._told, (candidates[known], errors[known])][-_GENERATIONS:]

    def forget(self) -> None:
        """Forget all generations, because errors have another meaning from now on."""
        self._told = []

    def repaired(self, mean: Array) -> Array:
        """Move the mean, if it is predicted to miss a criterion.

        Args:
            mean: The mean, shape (d,).

        Returns:
            The moved mean, shape (d,).
        """
        if len(self._told) < _FEWEST:
            return mean
        candidates, errors = (np.concatenate(part) for part in zip(*self._told, strict=True))
        looked_at = np.isfinite(errors).all(axis=0)
        if len(candidates) <= looked_at.sum() or not looked_at.any():
            return mean
        one_sided = self._one_sided[looked_at]
        with single_threaded():
            at = (candidates - mean) @ self._inverse.T
            offset, slope, farthest = _fit(at, errors[:, looked_at])
            step = np.zeros(at.shape[1])
            missed = np.zeros(len(offset), dtype=bool)
            for _ in range(_ROUNDS):
                also = unwanted(offset + step @ slope, one_sided, _WITHIN if missed.any() else 1.0) != 0
                if not (also & ~missed).any():
                    break
                missed |= also
                origin = np.zeros((1, len(step)))
                step = corrected(origin, offset[missed], slope[:, missed], farthest, one_sided[missed], _WITHIN)[0]
            return mean + self._factor @ step if missed.any() else mean


def _fit(at: Array, errors: Array) -> tuple[Array, Array, float]:
    """Fit a linear function to errors; return its value and its slope (m, k) at the origin, and how far it may be trusted."""
    length = np.einsum("nm,nm->n", at, at)
    middle = float(np.median(length)) + np.finfo(float).tiny
    weight = 1.0 / (length / middle + 0.1)  # points near the origin count more
    place, level = (weight @ at) / weight.sum(), (weight @ errors) / weight.sum()
    root = np.sqrt(weight)[:, None]
    slope = ridge((at - place) * root, (errors - level) * root)
    return level - place @ slope, slope, 3.0 * np.sqrt(middle)
