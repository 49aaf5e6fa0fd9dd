"""MPPI: model predictive path integral control as a search, its noise shrinking from generation to generation."""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.optimizers.sampling import Sampler, checked_positive, checked_share, softmax
from levade.optimizers.space import SearchSpace


class MPPI(Sampler):
    """Annealed MPPI: the information-theoretic average of the trials, with noise that shrinks.

        u <- sum_k w_k u_k,  w_k = exp(-(S_k - min S) / lambda) / sum

    (Williams et al., ICRA 2017, Algorithm 2.) The noise shrinks from wide to narrow, as in the outer loop of DIAL-MPC (Xue et
    al., arXiv 2409.15610). As there, the temperature lambda is a share of the standard deviation of the costs, so that
    their unit does not matter.

    Args:
        space: Where to search, see `Sampler`.
        seed: Seed of this optimizer's own random numbers.
        temperature: That share.
        decay: Factor on the noise in each generation.
        floor: What the noise shrinks to, as a share of the first.

    Raises:
        LevadeError: If the temperature is not positive, or decay or floor is not a share.
    """

    SETTINGS = ("temperature", "decay", "floor")

    def __init__(
        self,
        space: SearchSpace,
        *,
        seed: int | tuple[int, ...],
        temperature: float = 0.1,
        decay: float = 0.97,
        floor: float = 0.01,
    ) -> None:
        super().__init__(space, seed=seed)
        self._temperature = checked_positive("temperature", temperature)
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
        self._centre = weights(cost, self._temperature) @ z
        self._step = max(self._step * self._decay, min(self._step, self._floor * self._first_step))


def weights(cost: Array, temperature: float) -> Array:
    """Compute the weight w of each trial. All are the same where the costs are.

    Args:
        cost: Costs, shape (n,).
        temperature: The temperature, as a share of the standard deviation of the costs.

    Returns:
        Weights, shape (n,); their sum is 1.
    """
    deviation = cost.std()
    return (
        softmax(-(cost - cost.min()) / (temperature * deviation))
        if deviation > 0
        else np.full(cost.size, 1 / cost.size)
    )
