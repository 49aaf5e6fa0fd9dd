"""The default: CMA-ES, with candidates beside its own that are aimed at the criteria, and a least-squares finish."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.aim import WITHIN, Aim, sizes
from levade.optimizers.cmaes import CMAES
from levade.optimizers.finish import Finish

_TAG = 1_095_322_957
"""Keeps the random numbers of aimed candidates apart from those of CMA-ES."""


class Levade:
    """Covariance matrix adaptation over smooth motions, with two uses of the signed errors behind the costs.

    Each generation, some candidates are aimed (`levade.optimizers.aim`); the best of them, if it is among the best quarter of
    the others, becomes a part of the next generation. If it is the best of all so far, aimed candidates alone follow, for as
    long as they go on to be. When the best trial misses by little, and by half as much as at the last attempt, its ending is
    finished by least squares (`levade.optimizers.finish`).

    mean, factor, step, seed, step_adaptation: as in `CMAES`. population: candidates of CMA-ES in a generation.
    aimed: how many more there are beside them. finish: errors, in tolerances, from which the ending is finished; 0 for never.
    ending: (q, d), directions that change the last part of a motion only; None where there are none.
    one_sided: (k,), which of the errors are of a bound: 1 at it, less inside, the less the farther. None where none are.
    """

    def __init__(
        self,
        mean: Array,
        *,
        factor: Array | None = None,
        step: float,
        seed: int | tuple[int, ...],
        population: int | None = None,
        step_adaptation: Literal["csa", "tpa"] = "csa",
        aimed: int = 6,
        finish: float = 40.0,
        ending: Array | None = None,
        one_sided: NDArray[np.bool_] | None = None,
    ) -> None:
        if aimed < 0 or aimed != int(aimed):
            raise LevadeError(f"aimed: {aimed:g} should be a whole number, 0 or more; 6 is usual")
        if not finish >= 0:
            raise LevadeError(f"finish: {finish:g} should be 0 or more tolerances; 40 is usual")
        self._cma = CMAES(
            mean, factor=factor, step=step, seed=seed, population=population, step_adaptation=step_adaptation
        )
        self._count, self._finish_at = int(aimed), finish
        self._ending = None if ending is None or finish == 0 else ending
        self._generator = np.random.default_rng((*(seed if isinstance(seed, tuple) else (seed,)), _TAG))
        self._one_sided = one_sided if one_sided is not None and one_sided.any() else None
        own = np.eye(len(mean)) if factor is None else np.asarray(factor, dtype=np.float64)
        self._aim = Aim(own, one_sided=self._one_sided)
        self._carried: Array | None = None
        self._finish: Finish | None = None
        self._attempt_below = np.inf
        self._asked: Array | None = None
        self._own = 0
        self._none = np.empty((0, len(mean)))
        self._pursuing = False

    @property
    def population(self) -> int:
        """Candidates per generation, at most."""
        return max(self._cma.population + self._count, 0 if self._ending is None else len(self._ending))

    @property
    def step(self) -> float:
        return self._cma.step

    @property
    def mean(self) -> Array:
        """(d,), of the distribution of CMA-ES."""
        return self._cma.mean

    def ask(self) -> Array:
        """The next candidates, (n, d) with n up to `population`."""
        if self._finish is not None:
            self._own, asked = 0, self._finish.ask()
        else:
            own = self._none if self._pursuing else self._cma.ask()
            self._own = len(own)
            aimed = self._aim.around(self._count, step=self.step, generator=self._generator)
            beside = aimed if self._carried is None or not self._count else self._carried[None]
            self._carried = None
            asked = np.concatenate([own, beside])
        self._asked = asked
        return asked

    def tell(self, cost: Array, errors: Array | None = None) -> None:
        """Costs (n,) of the candidates just asked for; all finite, lower is better.

        errors: (n, k), signed, as a share of what is allowed; NaN where unknown, all of a trial that diverged.
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
        if self._finish is not None:
            # probes differ where the regression of `Aim` does not look; the cheapest of them may be the best so far
            cheapest = [int(np.argmin(cost))]
            self._aim.tell(asked[cheapest], errors[cheapest], cost[cheapest])
            self._finish.tell(errors)
            if self._finish.over:
                self._attempt_below = 0.5 * self._finish.miss
                self._cma.inject(self._finish.best)
                self._finish = None
        else:
            self._pursue(asked, errors, cost)
            self._begin_to_finish()

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage."""
        self._cma.scale_step(factor)

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """From now on costs mean something else, and so do the ``changed`` (k,) of the errors."""
        best = self._aim.best
        self._carried = None if best is None else best[0]
        self._aim.forget_costs(changed)
        self._finish, self._attempt_below, self._pursuing = None, np.inf, False

    def _pursue(self, asked: Array, errors: Array, cost: Array) -> None:
        """Tell `Aim` of a generation. If one that it aimed is the best of all, the next generation is all its own."""
        least = self._aim.least
        self._aim.tell(asked, errors, cost)
        pursued, aimed = self._pursuing, cost[self._own :]
        self._pursuing = len(aimed) > 0 and np.isfinite(least) and aimed.min() < cost[: self._own].min(initial=least)
        if pursued and not self._pursuing and self._aim.best is not None:
            self._cma.inject(self._aim.best[0])

    def _begin_to_finish(self) -> None:
        best = self._aim.best
        if self._ending is None or best is None:
            return
        base, errors = best
        miss = np.nanmax(sizes(errors, self._one_sided))
        if WITHIN < miss <= min(self._finish_at, self._attempt_below):
            count = max(self._count, 1)
            self._finish = Finish(
                base, errors, self._ending, count=count, generator=self._generator, one_sided=self._one_sided
            )
