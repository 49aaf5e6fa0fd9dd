"""What the staged loop needs of an optimizer."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array


class Optimizer(Protocol):
    """Ask / tell. The same arguments and the same costs give the same candidates, to the bit."""

    @property
    def population(self) -> int:
        """Candidates per generation."""
        ...

    @property
    def step(self) -> float:
        """Current step size: standard deviation of the candidates along the widest direction at the start, scaled."""
        ...

    @property
    def mean(self) -> Array:
        """(d,), of the distribution that candidates are drawn from; it moves when their costs are told."""
        ...

    def ask(self) -> Array:
        """The next candidates, (population, d)."""
        ...

    def tell(self, cost: Array) -> None:
        """Costs (population,) of the candidates just asked for; all finite, lower is better."""
        ...

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage."""
        ...


@runtime_checkable
class Informed(Optimizer, Protocol):
    """An optimizer that also looks at how far candidates miss the criteria. ``population`` is the most that it asks for."""

    def tell(self, cost: Array, errors: Array | None = None) -> None:
        """Costs (n,) of the candidates just asked for.

        errors: (n, k), signed, as a share of what is allowed; NaN where unknown, all of a trial that diverged.
        """
        ...

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """From now on costs mean something else, and so do the ``changed`` (k,) of the errors."""
        ...
