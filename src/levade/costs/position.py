"""The distance of the trunk from a required position (eq. 7, second part)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from levade.arrays import Array
from levade.costs.rows import At, check_target, check_tolerance, rows_at, squared_distance
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Position:
    """Squared distance [m^2] of the trunk's centre of mass from a required position. Coordinates that are left out are free.

    Attributes:
        x: Required coordinate [m], world axes; None is free.
        y: Required coordinate [m], world axes; None is free.
        z: Required coordinate [m], world axes; None is free.
        at: When it counts; over the hold it is the mean.
        tolerance: Distance that costs nothing [m]; the excess is squared.
    """

    unit: ClassVar[str] = "m^2"

    x: float | None = None
    y: float | None = None
    z: float | None = None
    at: At = "horizon"
    tolerance: float = 0.0

    def __post_init__(self) -> None:
        check_target("position", x=self.x, y=self.y, z=self.z)
        check_tolerance("position", self.tolerance)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [m^2], shape (n,)."""
        position = trajectories.trunk_com_position(rows_at(trajectories, self.at))
        return squared_distance(position, (self.x, self.y, self.z), self.tolerance)
