"""What the staged loop needs of an optimizer."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from levade.trajectory import Array


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
class Injectable(Optimizer, Protocol):
    """An optimizer that can also try candidates of others, as `levade.optimizers.Aim` makes them."""

    def inject(self, candidate: Array) -> None:
        """Make a candidate (d,) part of the next generation, in place of one of its own."""
        ...
