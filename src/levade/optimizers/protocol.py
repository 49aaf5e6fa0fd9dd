"""What a search needs of an optimizer, and what an optimizer of one's own must provide.

The least is two methods:

    class Halving:
        def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...]) -> None: ...
        def ask(self) -> Array: ...              # (n, d): the next candidates
        def tell(self, cost: Array) -> None: ... # (n,): their costs, finite, lower is better

Give the class, a function that makes one, or a ready object wherever the name of an optimizer is accepted.
`levade.optimizers.make_optimizer` checks what it asks for, and supplies the rest of `Optimizer` where it is missing:

    population    the candidates that ``ask`` returns next (it is called early, and its answer kept)
    step          NaN: reported as unknown
    mean          None: robust searches then validate the best candidate instead of the mean
    scale_step    does nothing: a stage's ``step`` has no effect

An optimizer with a method ``forget_costs`` is a `UsesErrors`: its ``tell`` gets the errors behind the costs as well.
To make resumed searches repeat to the bit, draw random numbers from ``numpy.random.default_rng(seed)`` only.
"""

from __future__ import annotations

from typing import Protocol, TypeGuard

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array


class Optimizer(Protocol):
    """Ask and tell. The same space, seed and costs give the same candidates, to the bit."""

    @property
    def population(self) -> int:
        """The most candidates that `ask` returns next."""
        ...

    @property
    def step(self) -> float:
        """Current step size: standard deviation of the candidates in the coordinates of the space; NaN if unknown."""
        ...

    @property
    def mean(self) -> Array | None:
        """Mean of the distribution that candidates are drawn from, shape (d,); None if there is none."""
        ...

    def ask(self) -> Array:
        """The next candidates, shape (n, d) with n from 1 to `population`; all finite."""
        ...

    def tell(self, cost: Array) -> None:
        """Learn from the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (n,); all finite, lower is better.
        """
        ...

    def scale_step(self, factor: float) -> None:
        """Multiply the step size, as at the start of a stage.

        Args:
            factor: Factor on the step size, above 0.
        """
        ...


class UsesErrors(Optimizer, Protocol):
    """An optimizer that also uses the signed errors behind the costs: by how much candidates miss each criterion."""

    def tell(self, cost: Array, errors: Array | None = None) -> None:
        """Learn from the candidates that `ask` returned last.

        Args:
            cost: Cost of each candidate, shape (n,); all finite, lower is better.
            errors: Signed error of each criterion as a share of its tolerance, shape (n, k). NaN where it is unknown; the
                whole row of a trial that diverged.
        """
        ...

    def forget_costs(self, changed: NDArray[np.bool_]) -> None:
        """From now on costs have another meaning, such as other weights.

        Args:
            changed: Which of the errors have another meaning, too, shape (k,).
        """
        ...


def uses_errors(optimizer: Optimizer) -> TypeGuard[UsesErrors]:
    """Tell whether an optimizer is a `UsesErrors`, by its method ``forget_costs``.

    ``isinstance`` would read its properties on Python 3.11, and to read `population` can be a reason to ask.

    Args:
        optimizer: The optimizer.

    Returns:
        True if its ``tell`` gets the errors, too.
    """
    return callable(getattr(optimizer, "forget_costs", None))
