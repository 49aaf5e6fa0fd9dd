"""What the sampling optimizers share: a centre, a spread round it, and candidates drawn from the two.

As in `levade.optimizers.cmaes`, a candidate is ``mean + factor @ z``, and the search is over z, where the initial covariance
is ``step**2`` times the identity. The first candidate of a generation is the centre itself: what the search would answer
with now, without the noise it explores with. It is a trial like the others, but nothing is learned from it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.blas import single_threaded

_FAR = 10.0
"""Costs beyond so many times the median's distance from the best count as that: a trial that broke down costs 1e12, and
on that scale all others are the same."""


class Sampler(ABC):
    """A normal distribution that candidates are drawn from.

    mean: (d,), the first centre. factor: (d, m), square root of the initial covariance; the identity if None.
    step: initial standard deviation. seed: of this optimizer's own random numbers.
    population: candidates per generation; 4 + 3 log(m), as in CMA-ES, if None.
    Raises LevadeError for shapes that do not fit, a step that is not positive or a population below 4.
    """

    def __init__(
        self,
        mean: Array,
        *,
        factor: Array | None = None,
        step: float,
        seed: int | tuple[int, ...],
        population: int | None = None,
    ) -> None:
        self._mean = np.asarray(mean, dtype=np.float64)
        self._factor = np.eye(self._mean.size) if factor is None else np.asarray(factor, dtype=np.float64)
        name = type(self).__name__
        if self._mean.ndim != 1 or self._factor.ndim != 2 or self._factor.shape[0] != self._mean.size:
            shapes = f"{self._mean.shape} and {self._factor.shape}"
            raise LevadeError(f"{name}: mean (d,) and factor (d, m) do not fit: {shapes}")
        if population is not None and population < 4:
            raise LevadeError(f"population: {population} is too small for {name}; at least 4")
        size = self._factor.shape[1]
        self._population = 4 + int(3 * np.log(size)) if population is None else int(population)
        self._first_step = checked_step(step)
        self._generator = np.random.default_rng(seed)
        self._centre = np.zeros(size)
        self._asked: Array | None = None

    @property
    def population(self) -> int:
        return self._population

    @property
    def mean(self) -> Array:
        """(d,), of the distribution that candidates are drawn from."""
        with single_threaded():
            return self._mean + self._factor @ self._centre

    @property
    @abstractmethod
    def step(self) -> float:
        """Root mean square of the standard deviations in the coordinates z."""

    @abstractmethod
    def scale_step(self, factor: float) -> None:
        """Multiply the spread, as at the start of a stage."""

    def ask(self) -> Array:
        """The next candidates, (population, d): the centre, and samples round it."""
        with single_threaded():
            self._asked = np.concatenate([self._centre[None], self._centre + self._draw(self._population - 1)])
            return self._mean + self._asked @ self._factor.T

    def tell(self, cost: Array) -> None:
        """Costs (population,) of the candidates just asked for; all finite, lower is better."""
        if self._asked is None:
            raise RuntimeError("tell: there are no candidates to tell about; ask first")
        cost = np.asarray(cost, dtype=np.float64)
        if cost.shape != (self._population,) or not np.isfinite(cost).all():
            raise ValueError(f"cost: expected {self._population} finite numbers, got {cost}")
        with single_threaded():
            self._learn(self._asked[1:], bounded(cost[1:]))
        self._asked = None

    @abstractmethod
    def _draw(self, n: int) -> Array:
        """(n, m), deviations from the centre."""

    @abstractmethod
    def _learn(self, z: Array, cost: Array) -> None:
        """Move the centre, and change the spread. z: (n, m), cost: (n,)."""


def bounded(cost: Array) -> Array:
    """Costs (n,) with what lies far beyond the others brought back to where they can still be told apart."""
    best = cost.min()
    reach = _FAR * (np.median(cost) - best)
    return np.minimum(cost, best + reach) if reach > 0 else cost


def softmax(value: Array) -> Array:
    """(n,), exp(value) over its sum."""
    weight = np.exp(value - value.max())
    return weight / weight.sum()


def checked_share(name: str, value: float) -> float:
    """A share, more than 0 and at most 1. Raises LevadeError."""
    if not (np.isfinite(value) and 0 < value <= 1):
        raise LevadeError(f"{name}: {value} should be a share, more than 0 and at most 1")
    return float(value)


def checked_step(step: float) -> float:
    """A step size. Raises LevadeError."""
    if not (np.isfinite(step) and step > 0):
        raise LevadeError(f"step: {step} is not a step size; a positive number of rad, 0.05 to 0.3 is usual")
    return float(step)


def checked_positive(name: str, value: float) -> float:
    """A positive number. Raises LevadeError."""
    if not (np.isfinite(value) and value > 0):
        raise LevadeError(f"{name}: {value} should be a positive number")
    return float(value)
