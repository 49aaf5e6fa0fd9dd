"""The cross-entropy method."""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.optimizers.sampling import Sampler, checked_share
from levade.optimizers.space import SearchSpace


class CEM(Sampler):
    """Cross-entropy method with a normal distribution for each coordinate.

    The distribution takes mean and variance of the elite, smoothed by a (Rubinstein, Methodology and Computing in Applied
    Probability 1(2), 1999; Stulp and Sigaud, ICML 2012, Table 1, left):

        mu <- (1 - a) mu + a mean(elite),  sigma^2 <- (1 - a) sigma^2 + a var(elite)

    A noise floor keeps it from stopping early (Szita and Lörincz, Neural Computation 18(12), 2006).

    Args:
        space: Where to search, see `Sampler`.
        seed: Seed of this optimizer's own random numbers.
        elite: Share of the trials that are learned from; at least two are.
        smoothing: The share a above.
        floor: Least standard deviation, as a share of the first step.
        decay: Factor on the floor in each generation.

    Raises:
        LevadeError: If one of them is not a share.
    """

    SETTINGS = ("elite", "smoothing", "floor", "decay")

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        elite: float = 0.25,
        smoothing: float = 0.5,
        floor: float = 0.5,
        decay: float = 0.98,
    ) -> None:
        super().__init__(space, seed=seed)
        self._elite = max(2, round(checked_share("elite", elite) * (self.population - 1)))
        self._smoothing, self._decay = checked_share("smoothing", smoothing), checked_share("decay", decay)
        self._least = checked_share("floor", floor) * self._first_step
        self._deviation = np.full(self._centre.size, self._first_step)

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return float(np.sqrt(np.square(self._deviation).mean()))

    def scale_step(self, factor: float) -> None:
        """Multiply the step size and the noise floor, as at the start of a stage.

        Args:
            factor: Factor on all standard deviations, above 0.
        """
        self._deviation *= factor
        self._least *= factor

    def _draw(self, n: int) -> Array:
        return self._deviation * self._generator.standard_normal((n, self._centre.size))

    def _learn(self, z: Array, cost: Array) -> None:
        elite = z[np.argsort(cost, kind="stable")[: self._elite]]
        self._centre = self._centre + self._smoothing * (elite.mean(axis=0) - self._centre)
        variance = np.square(self._deviation)
        variance += self._smoothing * (elite.var(axis=0) - variance)
        self._least *= self._decay
        self._deviation = np.maximum(np.sqrt(variance), self._least)
