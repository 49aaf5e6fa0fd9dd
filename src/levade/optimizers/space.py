"""Where an optimizer searches: the one argument that every optimizer takes.

    space = SearchSpace(mean=np.zeros(24), step=0.1)
    optimizer = CEM(space, seed=0, elite=0.25)

A candidate is ``mean + factor @ z``. Optimizers search over z, where the initial covariance is ``step**2`` times the identity.
There are no bounds: weights are commanded joint angles, which the costs and the robot's controller limit.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError

LEAST_POPULATION = 4
"""Candidates per generation: with fewer, there is hardly anything to compare."""


@dataclass(frozen=True, eq=False)
class SearchSpace:
    """The initial search distribution, and what is known of the candidates.

    Sequences are taken as arrays; the arrays of a space are read-only views.

    Attributes:
        mean: First mean of the search distribution [rad], shape (d,).
        factor: Square root of the initial covariance up to ``step``, shape (d, m). Defaults to the identity.
        step: Initial step size, the standard deviation in the coordinates z.
        population: Candidates per generation, at least 4. Defaults to the optimizer's own number.
        ending: Directions that change only the last part of a motion, shape (q, d). None if there are none.
        rough: Coordinates z in which errors jump, shape (m,), such as a duration of whole time steps: slopes along them say
            nothing about small changes. None if there are none.
        one_sided: Which of the k errors that an optimizer gets belong to a bound, shape (k,): 1 at the bound, less inside.
            None if none do.
        span: Least and largest value of each number of a candidate, shape (d, 2), from which sketches are drawn. None if the
            space has no bounds.

    Raises:
        LevadeError: If a shape does not fit, a number is not finite, the step is not positive or the population too small.
    """

    mean: Array
    factor: Array = None  # type: ignore[assignment]  # an array once __post_init__ has run
    _: KW_ONLY
    step: float
    population: int | None = None
    ending: Array | None = None
    rough: NDArray[np.bool_] | None = None
    one_sided: NDArray[np.bool_] | None = None
    span: Array | None = None

    def __post_init__(self) -> None:
        mean = _array("mean", self.mean)
        if mean.ndim != 1 or not mean.size:
            raise LevadeError(f"mean: expected shape (d,), got {mean.shape}")
        factor = np.eye(mean.size) if self.factor is None else _array("factor", self.factor)
        if factor.ndim != 2 or len(factor) != mean.size or not factor.shape[1]:
            raise LevadeError(
                f"factor: expected shape ({mean.size}, m) for a mean of shape {mean.shape}, got {factor.shape}"
            )
        if not (np.isfinite(self.step) and self.step > 0):
            raise LevadeError(f"step: {self.step} is not a step size; a positive number of rad, 0.05 to 0.3 is usual")
        if self.population is not None and self.population < LEAST_POPULATION:
            raise LevadeError(f"population: {self.population} is too small; at least {LEAST_POPULATION}")
        ending = None if self.ending is None else _array("ending", self.ending)
        if ending is not None and (ending.ndim != 2 or ending.shape[1] != mean.size):
            raise LevadeError(f"ending: expected shape (q, {mean.size}), got {ending.shape}")
        one_sided = None if self.one_sided is None else _read_only(np.asarray(self.one_sided, dtype=np.bool_))
        if one_sided is not None and one_sided.ndim != 1:
            raise LevadeError(f"one_sided: expected shape (k,), got {one_sided.shape}")
        rough = None if self.rough is None else _read_only(np.asarray(self.rough, dtype=np.bool_))
        if rough is not None and rough.shape != factor.shape[1:]:
            raise LevadeError(f"rough: expected shape ({factor.shape[1]},), got {rough.shape}")
        span = None if self.span is None else _array("span", self.span)
        if span is not None and (span.shape != (mean.size, 2) or (span[:, 0] > span[:, 1]).any()):
            raise LevadeError(f"span: expected shape ({mean.size}, 2), the least value first, got {span.shape}")
        arrays = {"mean": mean, "factor": _read_only(factor), "ending": ending, "rough": rough, "one_sided": one_sided}
        arrays["span"] = span
        for name, value in arrays.items():
            object.__setattr__(
                self, name, value
            )  # once, here: a frozen class has no other way to convert what it is given

    @property
    def size(self) -> int:
        """Weights of a candidate, d."""
        return self.mean.size

    @property
    def dimensions(self) -> int:
        """Coordinates that an optimizer searches over, m."""
        return self.factor.shape[1]

    def sketches(self, n: int, generator: np.random.Generator) -> Array:
        """Draw candidates from all of the span.

        Args:
            n: Number of candidates.
            generator: Source of random numbers.

        Returns:
            Candidates, shape (n, d).

        Raises:
            LevadeError: If the space has no span.
        """
        if self.span is None:
            raise LevadeError("search.sketches: the policy has no ranges to draw them from; leave sketches out")
        lower, upper = self.span.T
        return generator.uniform(lower, upper, (n, self.size))

    def candidates(self, z: Array) -> Array:
        """Candidates from coordinates: ``mean + factor @ z`` for each row.

        Args:
            z: Coordinates, shape (n, m).

        Returns:
            Candidates, shape (n, d).
        """
        return self.mean + z @ self.factor.T


def _array(name: str, values: Array) -> Array:
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise LevadeError(f"{name}: expected an array of numbers, got {type(values).__name__}") from None
    if not np.isfinite(array).all():
        raise LevadeError(f"{name}: {np.count_nonzero(~np.isfinite(array))} of {array.size} numbers are not finite")
    return _read_only(array)


def _read_only(array: np.ndarray) -> np.ndarray:
    view = array.view()
    view.flags.writeable = False
    return view
