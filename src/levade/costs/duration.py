"""The duration of a motion, which the paper leaves to future work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from levade.arrays import Array
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Duration:
    """The horizon T [s]. It matters if the search chooses the horizon."""

    unit: ClassVar[str] = "s"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], shape (n,)."""
        return trajectories.horizon
