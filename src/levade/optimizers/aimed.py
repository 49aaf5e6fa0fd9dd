"""The default: CMA-ES with aimed candidates next to its own, and a refinement of the ending by least squares."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.blas import single_threaded
from levade.optimizers.cmaes import CMAES
from levade.optimizers.ending import KEPT, EndingRefinement, lengths
from levade.optimizers.regression import ErrorRegression, sizes
from levade.optimizers.space import SearchSpace

_TAG = 1_095_322_957
"""Keeps the random numbers of aimed candidates apart from those of CMA-ES."""
NEAR = 0.1
"""[rad], largest change of the ending that is tried with the slopes of another motion."""


class AimedCMAES:
    """Covariance matrix adaptation over smooth motions, with two uses of the signed errors behind the costs.

    Each generation, some candidates are aimed (`levade.optimizers.regression`). The best of them becomes a part of the next
    generation if it is among the best quarter of the others. If it is the best of all so far, only aimed candidates follow,
    for as long as they go on to be. When the best trial misses by little, its ending is refined (`levade.optimizers.ending`).
    From then on the ending of any trial is refined that a small change of its ending should correct.

    Args:
        space: Where to search. Its population counts the candidates of CMA-ES; the aimed ones come on top.
        seed: Seed of this optimizer's own random numbers.
        step_adaptation: See `CMAES`.
        aimed: Aimed candidates in each generation.
        finish: Largest error, in tolerances, from which the ending is refined; 0 for never.

    Raises:
        LevadeError: If ``aimed`` is not a whole number, or one of the two is negative.
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("step_adaptation", "aimed", "finish")

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        step_adaptation: Literal["csa", "tpa"] = "csa",
        aimed: int = 6,
        finish: float = 40.0,
    ) -> None:
        if aimed < 0 or aimed != int(aimed):
            raise LevadeError(f"aimed: {aimed:g} should be a whole number, 0 or more; 6 is usual")
        if not finish >= 0:
            raise LevadeError(f"finish: {finish:g} should be 0 or more tolerances; 40 is usual")
        self._cma = CMAES(space, seed=seed, step_adaptation=step_adaptation)
        self._count, self._finish_at = int(aimed), finish
        self._ending = None if finish == 0 else space.ending
        self._generator = np.random.default_rng((*(seed if isinstance(seed, tuple) else (seed,)), _TAG))
        self._one_sided = space.one_sided if space.one_sided is not None and space.one_sided.any() else None
        self._regression = ErrorRegression(space.factor, rough=space.rough, one_sided=self._one_sided)
        self._carried: Array | None = None
        self._refinement: EndingRefinement | None = None
        self._attempt_below = np.inf
        self._slope: Array | None = None  # of the errors, along the ending
        self._refined: set[bytes] = set()
        self._reached = False
        self._asked: Array | None = None
        self._own = 0
        self._none = np.empty((0, space.size))
        self._pursuing = False

    @property
    def population(self) -> int:
        """The most candidates of a generation."""
        return max(self._cma.population + self._count, 0 if self._ending is None else len(self._ending))

    @property
    def step(self) -> float:
        """Step size of CMA-ES."""
        return self._cma.step

    @property
    def mean(self) -> Array:
        """Mean of the distribution of CMA-ES, shape (d,)."""
        return self._cma.mean

    def ask(self) -> Array:
        """The next candidates, shape (n, d) with n up to `population`."""
        if self._refinement is not None:
            self._own, asked = 0, self._refinement.ask()
        else:
            own = self._none if self._pursuing else self._cma.ask()
            self._own = len(own)
            aimed = self._regression.around(self._count, step=self.step, generator=self._generator)
            beside = aimed if self._carried is None or not self._count else self._carried[None]
            self._carried = None
            asked = np.concatenate([own, beside])
        self._asked = asked
        return asked

    def tell(self, cost: Array, errors: Array | None = None) -> None:
        """Learn from the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (n,); all finite, lower is better.
            errors: Signed errors as shares of the tolerances, shape (n, k). NaN where unknown; the whole row of a trial that
                diverged.
        """
        asked = self._asked
        if asked is None:
            raise RuntimeError("tell: there are no candidates to tell about; ask first")
        cost = np.asarray(cost, dtype=np.float64)
        if cost.shape != (len(asked),) or not np.isfinite(cost).all():
            raise ValueError(f"cost: expected {len(asked)} finite numbers, got {cost}")
        self._asked = None
        if self._own:
            self._cma.tell(cost[: self._own])
            # the best of the aimed, if it is among the best quarter of the others
            if len(cost) > self._own and cost[self._own :].min() < np.sort(cost[: self._own])[max(1, self._own // 4)]:
                self._cma.inject(asked[self._own + int(np.argmin(cost[self._own :]))])
        if errors is None:
            return
        known = np.isfinite(errors)
        within = sizes(np.where(known, errors, 0.0), self._one_sided) <= 1.0
        self._reached |= bool((within.all(axis=1) & known.any(axis=1)).any())
        if self._refinement is not None:
            # probes differ where the regression does not look; the cheapest of them may be the best so far
            cheapest = [int(np.argmin(cost))]
            self._regression.tell(asked[cheapest], errors[cheapest], cost[cheapest])
            self._refinement.tell(errors)
            if self._refinement.over or self._reached:
                self._attempt_below = 0.5 * self._refinement.miss
                self._slope = self._refinement.slope
                self._cma.inject(self._refinement.best)
                self._refinement = None
        else:
            self._pursue(asked, errors, cost)
            self._begin_refinement()

    def scale_step(self, factor: float) -> None:
        """Multiply the step size of CMA-ES, as at the start of a stage.

        Args:
            factor: Factor on the step size, above 0.
        """
        self._cma.scale_step(factor)

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """Forget costs, because they have another meaning from now on.

        Args:
            changed: Which of the errors have another meaning, too, and are forgotten, shape (k,).
        """
        best = self._regression.best
        self._carried = None if best is None else best[0]
        self._regression.forget_costs(changed)
        self._refinement, self._attempt_below, self._slope, self._pursuing = None, np.inf, None, False
        self._reached = False

    def _pursue(self, asked: Array, errors: Array, cost: Array) -> None:
        """Tell the regression of a generation. If an aimed candidate is the best of all, the next generation is all aimed."""
        least = self._regression.least
        self._regression.tell(asked, errors, cost)
        pursued, aimed = self._pursuing, cost[self._own :]
        self._pursuing = len(aimed) > 0 and np.isfinite(least) and aimed.min() < cost[: self._own].min(initial=least)
        if pursued and not self._pursuing and self._regression.best is not None:
            self._cma.inject(self._regression.best[0])

    def _begin_refinement(self) -> None:
        """Refine the ending of the cheapest trial; or, once slopes of the errors are known, of the one next to the goal.

        When a trial has reached the goal, only costs count.
        """
        if self._ending is None or self._reached:
            return
        base = self._cheapest() if self._slope is None else self._nearest(self._slope)
        if base is None:
            return
        candidate, errors = base
        self._refined.add(candidate.tobytes())
        self._refinement = EndingRefinement(
            candidate,
            errors,
            self._ending,
            count=max(self._count, 1),
            generator=self._generator,
            one_sided=self._one_sided,
            slope=self._slope,
        )

    def _cheapest(self) -> tuple[Array, Array] | None:
        """Return the cheapest trial and its errors, if it misses by little, and by half as much as at the last attempt."""
        best = self._regression.best
        if best is None:
            return None
        miss = np.nanmax(sizes(best[1], self._one_sided))
        return best if KEPT < miss <= min(self._finish_at, self._attempt_below) else None

    def _nearest(self, slope: Array) -> tuple[Array, Array] | None:
        """Return the trial that the smallest change of its ending would correct, and its errors.

        None if that change is larger than `NEAR`, or the trial was refined before.
        """
        candidates, errors = self._regression.trials
        known = np.isfinite(slope).all(axis=0)
        alike = (np.isfinite(errors) == known).all(axis=1)
        one_sided = None if self._one_sided is None else self._one_sided[known]
        size = sizes(errors[np.ix_(alike, known)], one_sided).max(axis=1)
        usable = np.flatnonzero(alike)[(size > KEPT) & (size <= self._finish_at)]
        with single_threaded():
            length = lengths(errors[np.ix_(usable, known)], slope[:, known], one_sided)
        for n in np.argsort(length, kind="stable"):
            if not length[n] <= NEAR:
                return None
            if candidates[usable[n]].tobytes() not in self._refined:
                return candidates[usable[n]], errors[usable[n]]
        return None
