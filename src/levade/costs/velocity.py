"""How fast the robot still is: final velocities, which the paper leaves to future work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.costs.rows import At, check_target, mean_over_rows, rows_at, squared_distance
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class LinearVelocity:
    """Squared difference [m^2/s^2] from a required velocity of the trunk's centre of mass, components left out are
    free.

    x, y, z: [m/s], world axes. at: when; over the hold it is the mean.
    """

    unit: ClassVar[str] = "m^2/s^2"

    x: float | None = None
    y: float | None = None
    z: float | None = None
    at: At = "horizon"

    def __post_init__(self) -> None:
        check_target("linear_velocity", x=self.x, y=self.y, z=self.z)

    def __call__(self, trajectories: Trajectories) -> Array:
        """(n,) [m^2/s^2]."""
        velocity = trajectories.trunk_com_velocity(rows_at(trajectories, self.at))
        return squared_distance(velocity, (self.x, self.y, self.z))


@dataclass(frozen=True)
class AngularVelocity:
    """Squared difference [rad^2/s^2] from a required angular velocity of the trunk, components left out are free.

    x, y, z: [rad/s], trunk axes, so roll, pitch and yaw rate of the gyroscope. at: when; over the hold it is the mean.
    """

    unit: ClassVar[str] = "rad^2/s^2"

    x: float | None = None
    y: float | None = None
    z: float | None = None
    at: At = "horizon"

    def __post_init__(self) -> None:
        check_target("angular_velocity", x=self.x, y=self.y, z=self.z)

    def __call__(self, trajectories: Trajectories) -> Array:
        """(n,) [rad^2/s^2]."""
        velocity = trajectories.trunk_angular_velocity[:, rows_at(trajectories, self.at)]
        return squared_distance(velocity, (self.x, self.y, self.z))


@dataclass(frozen=True)
class JointVelocity:
    """Sum over the joints of the squared joint velocity [rad^2/s^2]: how far the joints are from rest.

    at: when; over the hold it is the mean.
    """

    unit: ClassVar[str] = "rad^2/s^2"

    at: At = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """(n,) [rad^2/s^2]."""
        velocity = trajectories.joint_velocity[:, rows_at(trajectories, self.at)]
        return mean_over_rows(np.square(velocity).sum(axis=2))
