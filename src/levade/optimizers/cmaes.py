"""CMA-ES, by the library `cma` (N. Hansen), over the coordinates z of a `SearchSpace`.

There the initial covariance is the identity times ``step**2``; that of the candidates is ``step**2 * factor @ factor.T``.
"""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from levade.arrays import Array
from levade.evolution import cma
from levade.optimizers.blas import single_threaded
from levade.optimizers.space import SearchSpace

# cma's stop rules answer a flat or noisy cost; when to stop is for the search to say
_NEVER = {"tolfun": 0, "tolfunhist": 0, "tolfunrel": 0, "tolx": 0, "tolstagnation": 10**9, "tolflatfitness": 10**9}

_MOST = 1e3
"""Largest standard deviation, in first steps: beyond it CMA-ES has diverged, as by cma's own stop rule ``tolfacupx``."""
_LEAST = np.finfo(float).eps
"""Least standard deviation, in first steps or as a share of the mean: below it candidates differ by rounding errors."""
_CONDITION = 1e12
"""Largest condition number of the covariance: beyond it cma goes over to other coordinates, which its mean is then in."""


class _TwoPoint(cma.sigma_adaptation.CMAAdaptSigmaTPA):
    """Two-point adaptation without its self-check.

    The check draws from numpy's global generator, and warns near the optimum.
    """

    def check_consistency(self, es: object) -> None:
        pass


class CMAES:
    """Covariance matrix adaptation (Hansen and Ostermeier, Evolutionary Computation 9(2), 2001).

    Where costs are flat or fall without end, the covariance leaves every bound. CMA-ES then begins again around its mean, with
    the first covariance and step.

    Args:
        space: Where to search. Its population defaults to 4 + 3 log(m), the library's (17 for m = 96, 19 for 192).
        seed: Seed of this optimizer's own random numbers.
        step_adaptation: How the step size follows the search. "csa": cumulative path length, the library's default.
            "tpa": two-point adaptation (Hansen, arXiv 0805.0231), which tests a longer and a shorter step in each
            generation; it keeps its pace where most directions matter little, as with smooth motions of many kernels.
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ("step_adaptation",)

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        step_adaptation: Literal["csa", "tpa"] = "csa",
    ) -> None:
        self._space, self._first_step = space, float(space.step)
        generator = np.random.default_rng(seed)
        self._options = {
            # cma's own seeding goes through numpy's global generator, which two optimizers would share
            "seed": np.nan,
            "randn": lambda *shape: generator.standard_normal(shape),
            "verbose": -9,
            **_NEVER,
        }
        if space.population is not None:
            self._options["popsize"] = space.population
        if step_adaptation == "tpa":
            self._options["AdaptSigma"] = _TwoPoint
        self._search = self._around(np.zeros(space.dimensions))
        self._asked: list | None = None

    def _around(self, mean: Array) -> cma.CMAEvolutionStrategy:
        """A search from the first covariance on, around a mean (m,)."""
        with single_threaded():
            return cma.CMAEvolutionStrategy(mean, self._first_step, self._options)

    @cached_property
    def _inverse(self) -> Array:
        """Return the matrix from candidates less the first mean to the coordinates of the search, shape (m, d)."""
        return np.asarray(np.linalg.pinv(self._space.factor, rcond=1e-8))

    @property
    def population(self) -> int:
        """Candidates per generation."""
        return int(self._search.popsize)

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return float(self._search.sigma)

    @property
    def mean(self) -> Array:
        """Mean of the distribution that candidates are drawn from, shape (d,)."""
        with single_threaded():
            return self._space.mean + self._space.factor @ np.asarray(self._search.mean)

    def ask(self) -> Array:
        """The next candidates, (population, d)."""
        with single_threaded():
            self._asked = self._search.ask()
            return self._space.candidates(np.asarray(self._asked))

    def tell(self, cost: Array) -> None:
        """Learn from the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (population,); all finite, lower is better.

        Raises:
            RuntimeError: If no candidates were asked for since the last call.
            ValueError: If there is not one finite cost for each candidate.
        """
        if self._asked is None:
            raise RuntimeError("tell: there are no candidates to tell about; ask first")
        cost = np.asarray(cost, dtype=np.float64)
        if cost.shape != (self.population,) or not np.isfinite(cost).all():
            raise ValueError(f"cost: expected {self.population} finite numbers, got {cost}")
        with single_threaded():
            self._search.tell(self._asked, cost.tolist())
        self._asked = None
        mean, spread = np.asarray(self._search.mean), float(np.max(self._search.stds))
        least = _LEAST * max(self._first_step, float(np.abs(mean).max()))
        if not least <= spread <= _MOST * self._first_step or self._search.condition_number >= _CONDITION:
            self._search = self._around(mean)

    def inject(self, candidate: Array) -> None:
        """Make a candidate part of the next generation, in place of one of its own.

        Args:
            candidate: The candidate, shape (d,).
        """
        with single_threaded():
            self._search.inject([self._inverse @ (candidate - self._space.mean)], force=True)

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage.

        Args:
            factor: Factor on the step size, above 0.
        """
        self._search.sigma *= factor
        self._first_step *= factor
