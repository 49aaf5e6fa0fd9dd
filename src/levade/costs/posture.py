"""The distance of the joints from a required final posture, which the paper leaves to future work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from levade.arrays import Array
from levade.costs.rows import At, check_target, rows_at, squared_distance
from levade.errors import LevadeError
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Posture:
    """Sum over the joints of the squared distance [rad^2] from a required posture. Joints set to None are free.

    Attributes:
        position: One angle per joint [rad], in the robot's joint order.
        at: When it counts; over the hold it is the mean.

    Raises:
        LevadeError: If the robot has another number of joints.
    """

    unit: ClassVar[str] = "rad^2"

    position: tuple[float | None, ...]
    at: At = "horizon"

    def __post_init__(self) -> None:
        check_target("posture", **{f"position[{i}]": angle for i, angle in enumerate(self.position)})

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2], shape (n,)."""
        joints = trajectories.joint_position.shape[2]
        if len(self.position) != joints:
            raise LevadeError(
                f"posture.position: {len(self.position)} angles for a robot of {joints} joints; one a joint"
            )
        return squared_distance(trajectories.joint_position[:, rows_at(trajectories, self.at)], self.position)
