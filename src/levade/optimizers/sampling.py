"""What the sampling optimizers share: a centre, a spread around it, and candidates drawn from the two.

The search is over the coordinates z of a `SearchSpace`, where the initial covariance is ``step**2`` times the identity. The
first candidate of a generation is the centre itself: the search's answer so far, without the noise it explores with. It is a
trial like the others, except that nothing is learned from it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.optimizers.blas import single_threaded
from levade.optimizers.space import SearchSpace

_FAR = 10.0
"""Costs beyond this many times the median's distance from the best count as that: a trial that broke down costs 1e12, and
on that scale all others are the same."""


class Sampler(ABC):
    """A normal distribution that candidates are drawn from.

    Args:
        space: Where to search. Its population defaults to 4 + 3 log(m), as in CMA-ES.
        seed: Seed of this optimizer's own random numbers.
    """

    SETTINGS: ClassVar[tuple[str, ...]] = ()
    """Names of the keyword arguments besides ``seed``."""

    def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...]) -> None:
        self._space, size = space, space.dimensions
        self._population = 4 + int(3 * np.log(size)) if space.population is None else int(space.population)
        self._first_step = float(space.step)
        self._generator = np.random.default_rng(seed)
        self._centre = np.zeros(size)
        self._asked: Array | None = None

    @property
    def population(self) -> int:
        """Candidates per generation."""
        return self._population

    @property
    def mean(self) -> Array:
        """Mean of the distribution that candidates are drawn from, shape (d,)."""
        with single_threaded():
            return self._space.mean + self._space.factor @ self._centre

    @property
    @abstractmethod
    def step(self) -> float:
        """Root mean square of the standard deviations in the coordinates z."""

    @abstractmethod
    def scale_step(self, factor: float) -> None:
        """Multiply the spread, as at the start of a stage.

        Args:
            factor: Factor on all standard deviations, above 0.
        """

    def ask(self) -> Array:
        """The next candidates, (population, d): the centre, and samples around it."""
        with single_threaded():
            self._asked = np.concatenate([self._centre[None], self._centre + self._draw(self._population - 1)])
            return self._space.candidates(self._asked)

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
        """Move the centre, and change the spread.

        Args:
            z: (n, m), cost: (n,).
            cost: Costs of the candidates, shape (n,).
        """


def bounded(cost: Array) -> Array:
    """Bring costs far beyond the others back to where they can still be distinguished.

    Args:
        cost: Costs, shape (n,).

    Returns:
        Costs, shape (n,).
    """
    best = cost.min()
    reach = _FAR * (np.median(cost) - best)
    return np.minimum(cost, best + reach) if reach > 0 else cost


def softmax(value: Array) -> Array:
    """Compute exp(value) over its sum.

    Args:
        value: Values, shape (n,).

    Returns:
        Shares, shape (n,); their sum is 1.
    """
    weight = np.exp(value - value.max())
    return weight / weight.sum()


def checked_share(name: str, value: float) -> float:
    """Return a setting that is a share, more than 0 and at most 1.

    Args:
        name: Name of the setting, for the message.
        value: Its value.

    Returns:
        The value.

    Raises:
        LevadeError: If it is not such a share.
    """
    if not (np.isfinite(value) and 0 < value <= 1):
        raise LevadeError(f"{name}: {value} should be a share, more than 0 and at most 1")
    return float(value)


def checked_positive(name: str, value: float) -> float:
    """Return a setting that is a positive number.

    Args:
        name: Name of the setting, for the message.
        value: Its value.

    Returns:
        The value.

    Raises:
        LevadeError: If it is not positive, or not finite.
    """
    if not (np.isfinite(value) and value > 0):
        raise LevadeError(f"{name}: {value} should be a positive number")
    return float(value)
