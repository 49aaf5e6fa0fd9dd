"""Pure random search: what a search has to be better than."""

from __future__ import annotations

from levade.arrays import Array
from levade.optimizers.sampling import Sampler


class RandomSearch(Sampler):
    """Samples around the start, always from the same distribution (Brooks, Operations Research 6(2), 1958).

    Nothing is learned. The arguments are those of `Sampler`.
    """

    @property
    def step(self) -> float:
        """Step size: standard deviation in the coordinates z of the space."""
        return self._first_step

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage.

        Args:
            factor: Factor on the step size, above 0.
        """
        self._first_step *= factor

    def _draw(self, n: int) -> Array:
        return self._first_step * self._generator.standard_normal((n, self._centre.size))

    def _learn(self, z: Array, cost: Array) -> None:
        pass
