"""How long a motion takes, which the paper leaves to future work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from levade.arrays import Array
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Duration:
    """The horizon T [s]. It makes a difference where the task leaves the horizon to the search."""

    unit: ClassVar[str] = "s"

    def __call__(self, trajectories: Trajectories) -> Array:
        """(n,) [s]."""
        return trajectories.horizon
