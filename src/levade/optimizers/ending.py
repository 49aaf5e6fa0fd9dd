"""Ending refinement: a few Gauss-Newton steps on the last part of a motion that misses by little.

All that comes before stays as it is, with every contact that is made and broken: the errors, rough in the whole motion, are
smooth in its ending. One probe along each direction of the ending gives the slopes of the errors. Candidates that the slopes
predict to be right follow. The trials of one round also serve the regression of the next, and the slopes of one motion are
those of the next to begin with, which then needs no probes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.optimizers.blas import single_threaded
from levade.optimizers.regression import WITHIN, corrected, ridge, sizes

PROBE = 0.01
"""[rad], length of the probe along each direction of the ending."""
FARTHEST = 0.3
"""[rad], largest step: larger corrections cannot be made by the ending alone."""
SPREAD = 0.2
"""Standard deviation of the points drawn next to the step, as a share of its length."""
SHARES = (1.0, 0.5)
"""Shares of the step that are tried, in turns: the whole step overshoots where contacts change on the way."""
ROUNDS = 3
"""Most rounds of steps."""
KEPT = 0.7
"""Largest share of the tolerance that is left of an error that is within it already. Long after the ending, in the hold, errors
hardly follow it, so that only large steps would correct them further."""


class EndingRefinement:
    """One attempt, round by round: `ask`, `tell`, until it is `over`.

    Args:
        base: The candidate to refine, shape (d,).
        errors: Its errors as shares of the tolerances, shape (k,); NaN where unknown.
        ending: Directions whose largest weight is 1, shape (q, d).
        count: Candidates of each round after the probes.
        generator: Source of the random numbers.
        one_sided: See `levade.optimizers.regression.ErrorRegression`.
        slope: Slope of the errors to begin with, shape (q, k), from an earlier refinement. None makes probes first.
    """

    def __init__(
        self,
        base: Array,
        errors: Array,
        ending: Array,
        *,
        count: int,
        generator: np.random.Generator,
        one_sided: NDArray[np.bool_] | None = None,
        slope: Array | None = None,
    ) -> None:
        self._ending, self._count, self._generator = ending, count, generator
        self._known = np.isfinite(errors)
        self._one_sided = None if one_sided is None else one_sided[self._known]
        self._base = base
        # steps and errors of all trials, the base first
        self._steps, self._missed = np.zeros((1, len(ending))), errors[self._known][None]
        self._at = 0  # index of the best
        self._slope = None if slope is None else slope[:, self._known]
        self._rounds = 0
        self.over = False
        if self._slope is None:
            self._asked = PROBE * np.eye(len(ending))
        else:
            self._step()

    @property
    def best(self) -> Array:
        """The best candidate of all rounds, shape (d,)."""
        return self._base + self._steps[self._at] @ self._ending

    @property
    def miss(self) -> float:
        """The largest error of the best, as a share of its tolerance."""
        return float(sizes(self._missed[self._at], self._one_sided).max())

    @property
    def slope(self) -> Array | None:
        """Slope of the errors, shape (q, k); NaN where unknown. None if no trial told of any."""
        if self._slope is None:
            return None
        slope = np.full((len(self._ending), len(self._known)), np.nan)
        slope[:, self._known] = self._slope
        return slope

    def ask(self) -> Array:
        """The next candidates, shape (n, d)."""
        return self._base + self._asked @ self._ending

    def tell(self, errors: Array) -> None:
        """Learn from the candidates that `ask` returned last.

        Args:
            errors: Signed errors as shares of the tolerances, shape (n, k). NaN where unknown; the whole row of a trial
                that diverged.
        """
        errors = errors[:, self._known]
        usable = np.isfinite(errors).all(axis=1)
        self._steps = np.concatenate([self._steps, self._asked[usable]])
        self._missed = np.concatenate([self._missed, errors[usable]])
        before = self.miss
        self._at = int(np.argmin(sizes(self._missed, self._one_sided).max(axis=1)))
        self.over = self._rounds >= ROUNDS or (self._rounds > 0 and self.miss > 0.7 * before)
        self._learn()
        if not self.over:
            self._step()

    def _learn(self) -> None:
        """Improve the slope by all trials so far."""
        place, errors = self._steps[self._at], self._missed[self._at]
        difference = np.delete(self._steps - place, self._at, axis=0)
        change = np.delete(self._missed - errors, self._at, axis=0)
        if not change.any():  # no probe survived, or none made a difference: the ending cannot help
            self.over = True
            return
        with single_threaded():
            length = np.linalg.norm(difference, axis=1, keepdims=True)
            weight = 1.0 / np.maximum(length, PROBE)  # the nearer, the more to be believed
            before = np.zeros((len(self._ending), len(errors))) if self._slope is None else self._slope
            self._slope = before + ridge(difference * weight, (change - difference @ before) * weight)

    def _step(self) -> None:
        """Plan the next round: candidates that the slope predicts to be right."""
        assert self._slope is not None
        q, place, errors = len(self._ending), self._steps[self._at], self._missed[self._at]
        within = left(errors, self._one_sided)
        with single_threaded():
            step = corrected(np.zeros((1, q)), errors, self._slope, np.inf, self._one_sided, within)
            reach = float(np.abs(step).max())
            self.over = not np.isfinite(reach) or reach > FARTHEST
            spread = SPREAD * np.linalg.norm(step) / np.sqrt(q)
            drawn = step + spread * self._generator.standard_normal((self._count, q))
            drawn[0] = step[0]
            shares = np.resize(SHARES, self._count)[:, None]
            self._asked = place + shares * corrected(drawn, errors, self._slope, np.inf, self._one_sided, within)
        self._rounds += 1


def left(errors: Array, one_sided: NDArray[np.bool_] | None) -> Array:
    """Compute what may be left of errors after a refinement.

    Args:
        errors: Signed errors as shares of the tolerances, shape (..., k).
        one_sided: See `levade.optimizers.regression.ErrorRegression`.

    Returns:
        Sizes as shares of the tolerances, shape (..., k).
    """
    size = sizes(errors, one_sided)
    return np.where(size <= 1.0, np.clip(size, WITHIN, KEPT), WITHIN)


def lengths(errors: Array, slope: Array, one_sided: NDArray[np.bool_] | None) -> Array:
    """Compute the steps of the ending that would correct motions.

    Args:
        errors: Signed errors of the motions as shares of the tolerances, shape (n, k).
        slope: Slope of the errors, shape (q, k).
        one_sided: See `levade.optimizers.regression.ErrorRegression`.

    Returns:
        Largest component of each step [rad], shape (n,); infinite if no step corrects all of them.
    """
    within = left(errors, one_sided)
    step = corrected(np.zeros((len(errors), len(slope))), errors, slope, np.inf, one_sided, within)
    corrects = (sizes(errors + step @ slope, one_sided) <= 1.0).all(axis=1)
    return np.where(corrects, np.abs(step).max(axis=1, initial=0.0), np.inf)
