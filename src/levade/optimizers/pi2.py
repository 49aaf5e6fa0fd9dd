"""PI², policy improvement with path integrals, and PI²-CMA, which adapts its exploration.

In the general form each time step has probabilities of its own, from the cost that is still to go. Where, as here, one cost
is known per trial, the cost to go is the same at all times, so are the probabilities, and the average over time is that
probability: the black-box form, PI^BB (Stulp and Sigaud, Policy improvement: between black-box optimization and episodic
reinforcement learning, 2012).
"""

from __future__ import annotations

import math

import numpy as np

from levade.arrays import Array
from levade.optimizers.sampling import Sampler, checked_positive, checked_share, softmax
from levade.optimizers.space import SearchSpace


def probabilities(cost: Array, eliteness: float) -> Array:
    """Compute the probability P of each trial. All are the same where the costs are.

    P_k = exp(-h S_k) / sum exp(-h S),  S = (J - min J) / (max J - min J)

    Args:
        cost: Costs J, shape (n,).
        eliteness: h, 10 in Theodorou, Buchli and Schaal, JMLR 11, 2010.

    Returns:
        Probabilities, shape (n,); their sum is 1.
    """
    span = cost.max() - cost.min()
    return softmax(-eliteness * (cost - cost.min()) / span) if span > 0 else np.full(cost.size, 1 / cost.size)


class PI2(Sampler):
    """PI² in its black-box form: the probability-weighted mean of the trials (Theodorou, Buchli and Schaal, JMLR 11, 2010).

        theta <- sum_k P_k theta_k

    Exploration is not learned. It shrinks by ``decay`` in each generation, down to ``floor`` of the first.

    Args:
        space: Where to search, see `Sampler`.
        seed: Seed of this optimizer's own random numbers.
        eliteness: h of the probabilities.
        decay: Factor on the exploration in each generation.
        floor: What the exploration shrinks to, as a share of the first.

    Raises:
        LevadeError: If the eliteness is not positive, or decay or floor is not a share.
    """

    SETTINGS = ("eliteness", "decay", "floor")

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        eliteness: float = 10.0,
        decay: float = 0.98,
        floor: float = 0.01,
    ) -> None:
        super().__init__(space, seed=seed)
        self._eliteness = checked_positive("eliteness", eliteness)
        self._decay, self._floor = checked_share("decay", decay), checked_share("floor", floor)
        self._step = self._first_step

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return self._step

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage.

        Args:
            factor: Factor on the step size, above 0.
        """
        self._step *= factor

    def _draw(self, n: int) -> Array:
        return self._step * self._generator.standard_normal((n, self._centre.size))

    def _learn(self, z: Array, cost: Array) -> None:
        self._centre = probabilities(cost, self._eliteness) @ z
        self._step = max(self._step * self._decay, min(self._step, self._floor * self._first_step))


class PI2CMA(Sampler):
    """PI²-CMA: the probabilities of PI² also adapt the covariance (Stulp and Sigaud, ICML 2012, arXiv 1206.4621, Table 1).

        Sigma <- sum_k P_k (theta_k - theta)(theta_k - theta)'        (their eq. 17; theta is the mean before the update)

    Args:
        space: Where to search, see `Sampler`.
        seed: Seed of this optimizer's own random numbers.
        eliteness: h of the probabilities.
        rate: Share of the new covariance in the next one. Defaults to 0.5 / sqrt(m): the paper's 1 is too much where a full
            covariance has far more entries than a generation has trials.
        floor: Standard deviation that is always added, as a share of the first step.

    Raises:
        LevadeError: If the eliteness is not positive, or rate or floor is not a share.
    """

    SETTINGS = ("eliteness", "rate", "floor")

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        eliteness: float = 10.0,
        rate: float | None = None,
        floor: float = 0.0001,
    ) -> None:
        super().__init__(space, seed=seed)
        self._eliteness = checked_positive("eliteness", eliteness)
        self._rate = checked_share("rate", 0.5 / math.sqrt(self._centre.size) if rate is None else rate)
        self._floor = checked_share("floor", floor)
        self._covariance = self._first_step**2 * np.eye(self._centre.size)

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return float(np.sqrt(np.diagonal(self._covariance).mean()))

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage.

        Args:
            factor: Factor on all standard deviations, above 0.
        """
        self._covariance *= factor**2

    def _draw(self, n: int) -> Array:
        least = (self._floor * self._first_step) ** 2  # also what keeps the root from failing
        root = np.linalg.cholesky(self._covariance + least * np.eye(self._centre.size))
        return self._generator.standard_normal((n, self._centre.size)) @ root.T

    def _learn(self, z: Array, cost: Array) -> None:
        probability = probabilities(cost, self._eliteness)
        deviation = z - self._centre
        learned = (deviation.T * probability) @ deviation
        self._covariance += self._rate * (learned - self._covariance)
        self._centre = probability @ z
