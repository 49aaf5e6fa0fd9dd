"""CMA-ES, by the library `cma` (N. Hansen), in coordinates where the initial covariance is the identity.

A candidate is ``mean + factor @ z``, and CMA-ES searches over z with step size ``step``: ``factor @ factor.T`` is then
the initial covariance of the candidates, up to ``step**2``.
"""

from __future__ import annotations

from functools import cached_property
from typing import Literal

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.blas import single_threaded
from levade.optimizers.library import cma

# cma's stop rules answer a flat or noisy cost; when to stop is for the staged loop to say
_NEVER = {"tolfun": 0, "tolfunhist": 0, "tolfunrel": 0, "tolx": 0, "tolstagnation": 10**9, "tolflatfitness": 10**9}


class _TwoPoint(cma.sigma_adaptation.CMAAdaptSigmaTPA):
    """Two-point adaptation without its self-check, which draws from numpy's global generator and warns near the
    optimum.
    """

    def check_consistency(self, es: object) -> None:
        pass


class CMAES:
    """Covariance matrix adaptation (Hansen and Ostermeier, Evolutionary Computation 9(2), 2001).

    mean: (d,), the first mean. factor: (d, m), square root of the initial covariance; the identity if None.
    step: initial step size. seed: of this optimizer's own random numbers.
    population: candidates per generation; 4 + 3 log(m) if None, the library's default (17 for m = 96, 19 for 192).
    step_adaptation: how the step size follows the search. "csa": cumulative path length, the library's default.
        "tpa": two-point adaptation (Hansen, arXiv 0805.0231), which tests a longer and a shorter step in each
        generation; it keeps its pace where most directions matter little, as with smooth motions of many kernels.
    Raises LevadeError for shapes that do not fit or a step that is not positive.
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
    ) -> None:
        mean = np.asarray(mean, dtype=np.float64)
        self._mean = mean
        self._factor = np.eye(mean.size) if factor is None else np.asarray(factor, dtype=np.float64)
        if mean.ndim != 1 or self._factor.ndim != 2 or self._factor.shape[0] != mean.size:
            raise LevadeError(f"CMA-ES: mean (d,) and factor (d, m) do not fit: {mean.shape} and {self._factor.shape}")
        if not (np.isfinite(step) and step > 0):
            raise LevadeError(f"step: {step} is not a step size; a positive number of rad, 0.05 to 0.3 is usual")
        if population is not None and population < 4:
            raise LevadeError(f"population: {population} is too small for CMA-ES; at least 4")
        generator = np.random.default_rng(seed)
        options = {
            # cma's own seeding goes through numpy's global generator, which two optimizers would share
            "seed": np.nan,
            "randn": lambda *shape: generator.standard_normal(shape),
            "verbose": -9,
            **_NEVER,
        }
        if population is not None:
            options["popsize"] = population
        if step_adaptation == "tpa":
            options["AdaptSigma"] = _TwoPoint
        with single_threaded():
            self._search = cma.CMAEvolutionStrategy(np.zeros(self._factor.shape[1]), step, options)
        self._asked: list | None = None

    @cached_property
    def _inverse(self) -> Array:
        """(m, d), from candidates less the first mean to the coordinates of the search."""
        return np.asarray(np.linalg.pinv(self._factor, rcond=1e-8))

    @property
    def population(self) -> int:
        return int(self._search.popsize)

    @property
    def step(self) -> float:
        return float(self._search.sigma)

    @property
    def mean(self) -> Array:
        """(d,), of the distribution that candidates are drawn from."""
        with single_threaded():
            return self._mean + self._factor @ np.asarray(self._search.mean)

    def ask(self) -> Array:
        """The next candidates, (population, d)."""
        with single_threaded():
            self._asked = self._search.ask()
            return self._mean + np.asarray(self._asked) @ self._factor.T

    def tell(self, cost: Array) -> None:
        """Costs (population,) of the candidates just asked for; all finite, lower is better."""
        if self._asked is None:
            raise RuntimeError("tell: there are no candidates to tell about; ask first")
        cost = np.asarray(cost, dtype=np.float64)
        if cost.shape != (self.population,) or not np.isfinite(cost).all():
            raise ValueError(f"cost: expected {self.population} finite numbers, got {cost}")
        with single_threaded():
            self._search.tell(self._asked, cost.tolist())
        self._asked = None

    def inject(self, candidate: Array) -> None:
        """Make a candidate (d,) part of the next generation, in place of one of its own."""
        with single_threaded():
            self._search.inject([self._inverse @ (candidate - self._mean)], force=True)

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage."""
        self._search.sigma *= factor
