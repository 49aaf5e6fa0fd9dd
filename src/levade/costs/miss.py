"""A criterion as a cost: how far a quantity is from its target or bounds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from levade.arrays import Array
from levade.costs.quantities import Legs, Quantity
from levade.costs.rows import mean_in, mean_over_rows
from levade.costs.success import Criterion
from levade.errors import LevadeError
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Miss:
    """Squared distance of a quantity from a target, or from the nearest bound, as a multiple of ``scale`` [-].

    Attributes:
        quantity: The quantity, as in `levade.costs.Criterion`.
        target: Required value.
        minimum: Required lower bound, instead of a target.
        maximum: Required upper bound, instead of a target.
        legs: Legs of a quantity of the feet.
        tolerance: Distance from the target that costs nothing; only the excess counts.
        at: When it counts. Over the hold, and over the whole motion up to the horizon ("motion"), the cost is the mean of the
            squares. "max" and "min" use the largest and the smallest simulated value, such as the apex of a jump.
        scale: Distance that costs 1, in the quantity's unit.
    """

    unit: ClassVar[str] = "-"

    quantity: Quantity
    target: float | None = None
    tolerance: float = 0.0
    minimum: float | None = None
    maximum: float | None = None
    at: Literal["horizon", "end", "hold", "max", "min", "motion"] = "horizon"
    legs: Legs = "all"
    scale: float = 1.0

    def __post_init__(self) -> None:
        if self.at not in ("horizon", "end", "hold", "max", "min", "motion"):
            raise LevadeError(
                f"miss.{self.quantity}.at: {self.at!r} is unknown; horizon, end, max, min, hold or motion"
            )
        try:
            self._criterion  # noqa: B018
        except LevadeError as error:
            raise LevadeError(f"miss{str(error).removeprefix('success')}") from None
        if not (math.isfinite(self.scale) and self.scale > 0):
            raise LevadeError(f"miss.scale: {self.scale} should be a positive number, the distance that costs 1")

    @cached_property
    def _criterion(self) -> Criterion:
        tolerance = None if self.target is None else self.tolerance
        at = "horizon" if self.at == "motion" else self.at
        return Criterion(self.quantity, self.target, tolerance, self.minimum, self.maximum, at, self.legs)

    @property
    def clearance(self) -> float | None:
        """See `levade.costs.clearance`."""
        return self._criterion.clearance

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [-], shape (n,)."""
        rows = slice(0, trajectories.horizon_steps) if self.at == "motion" else None
        error = np.abs(self._criterion.deviations(trajectories, rows))
        squared = np.square(np.maximum(error - self.tolerance, 0.0) / self.scale)
        return mean_over_rows(squared) if rows is None else mean_in(squared, trajectories, rows)
