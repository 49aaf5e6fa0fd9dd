"""The finish: a few Gauss-Newton steps on the last part of a motion that misses by little.

Whatever comes before stays as it is, and with it every contact that was made and broken: the errors, rough in the motion as a
whole, are smooth in its end. One probe along each direction of the ending gives their slopes, and candidates that the slopes
predict to be right follow; the trials of one round serve the regression of the next.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.optimizers.aim import corrected, ridge, sizes
from levade.optimizers.blas import single_threaded

PROBE = 0.01
"""[rad], along each direction of the ending."""
FARTHEST = 0.3
"""[rad], of a step: who needs more has no way to mend it at the end."""
SPREAD = 0.2
"""Standard deviation of what is drawn beside the step, as a share of its length."""
SHARES = (1.0, 0.5)
"""Of the step that are tried, in turns: all of it overshoots where contacts change on the way."""
ROUNDS = 3
"""Of steps."""


class Finish:
    """One attempt, round by round: `ask`, `tell`, until it is `over`.

    base: (d,). errors: its own, (k,), as a share of what is allowed; NaN where unknown. ending: (q, d), directions whose
    largest weight is 1. count: candidates of each round after the probes. one_sided: (k,), as in `Aim`.
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
    ) -> None:
        self._ending, self._count, self._generator = ending, count, generator
        self._known = np.isfinite(errors)
        self._one_sided = None if one_sided is None else one_sided[self._known]
        self._base = base
        self._steps, self._missed = (
            np.zeros((1, len(ending))),
            errors[self._known][None],
        )  # of all trials, the base first
        self._at = 0  # which of them is the best
        self._asked = PROBE * np.eye(len(ending))
        self._rounds = 0
        self.over = False

    @property
    def best(self) -> Array:
        """(d,), of all rounds."""
        return self._base + self._steps[self._at] @ self._ending

    @property
    def miss(self) -> float:
        """The largest error of the best, as a share of what is allowed."""
        return float(sizes(self._missed[self._at], self._one_sided).max())

    def ask(self) -> Array:
        """The next candidates, (n, d)."""
        return self._base + self._asked @ self._ending

    def tell(self, errors: Array) -> None:
        """Errors (n, k) of the candidates just asked for."""
        errors = errors[:, self._known]
        usable = np.isfinite(errors).all(axis=1)
        self._steps = np.concatenate([self._steps, self._asked[usable]])
        self._missed = np.concatenate([self._missed, errors[usable]])
        before = self.miss
        self._at = int(np.argmin(sizes(self._missed, self._one_sided).max(axis=1)))
        self.over = self._rounds >= ROUNDS or (self._rounds > 0 and self.miss > 0.7 * before)
        if not self.over:
            self._plan()

    def _plan(self) -> None:
        """The next round, from all that is known."""
        q, place, errors = len(self._ending), self._steps[self._at], self._missed[self._at]
        difference = np.delete(self._steps - place, self._at, axis=0)
        change = np.delete(self._missed - errors, self._at, axis=0)
        with single_threaded():
            length = np.linalg.norm(difference, axis=1, keepdims=True)
            weight = 1.0 / np.maximum(length, PROBE)  # the nearer, the more to be believed
            slope = ridge(difference * weight, change * weight)
            step = corrected(np.zeros((1, q)), errors, slope, np.inf, self._one_sided)
            reach = float(np.abs(step).max())
            self.over = not np.isfinite(reach) or reach > FARTHEST
            spread = SPREAD * np.linalg.norm(step) / np.sqrt(q)
            drawn = step + spread * self._generator.standard_normal((self._count, q))
            drawn[0] = step[0]
            shares = np.resize(SHARES, self._count)[:, None]
            self._asked = place + shares * corrected(drawn, errors, slope, np.inf, self._one_sided)
        self._rounds += 1
