"""Final velocities, which the paper leaves to future work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, get_args

import numpy as np

from levade.arrays import Array
from levade.costs.rows import (
    At,
    beyond,
    check_target,
    check_tolerance,
    mean_over_rows,
    rows_at,
    squared_distance,
)
from levade.errors import LevadeError, did_you_mean
from levade.rotations import conjugate, roll_pitch_yaw, rotate
from levade.trajectory import Trajectories

Frame = Literal["world", "trunk", "heading"]
"""Axes of a velocity: the world's; the trunk's; or the world's turned about z until x is the trunk's heading (yaw)."""

_FRAMES: tuple[str, ...] = get_args(Frame)


@dataclass(frozen=True)
class LinearVelocity:
    """Squared difference [m^2/s^2] from a required velocity of the trunk's centre of mass.

    Attributes:
        x: Required component [m/s]; None is free.
        y: Required component [m/s]; None is free.
        z: Required component [m/s]; None is free.
        frame: Axes of x, y and z, see `Frame`; "heading" means forward, left and up.
        tolerance: Difference that costs nothing [m/s].
        at: When it counts; over the hold it is the mean.
    """

    unit: ClassVar[str] = "m^2/s^2"

    x: float | None = None
    y: float | None = None
    z: float | None = None
    at: At = "horizon"
    frame: Frame = "world"
    tolerance: float = 0.0

    def __post_init__(self) -> None:
        check_target("linear_velocity", x=self.x, y=self.y, z=self.z)
        check_tolerance("linear_velocity", self.tolerance)
        _check_frame("linear_velocity", self.frame)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [m^2/s^2], shape (n,)."""
        rows = rows_at(trajectories, self.at)
        velocity = trajectories.trunk_com_velocity(rows)
        if self.frame != "world":
            velocity = from_world(velocity, trajectories.trunk_quaternion[:, rows], self.frame)
        return squared_distance(velocity, (self.x, self.y, self.z), self.tolerance)


@dataclass(frozen=True)
class AngularVelocity:
    """Squared difference [rad^2/s^2] from a required angular velocity of the trunk, in trunk axes what a gyroscope measures.

    Attributes:
        x: Required component [rad/s]; None is free.
        y: Required component [rad/s]; None is free.
        z: Required component [rad/s]; None is free.
        frame: Axes of x, y and z, see `Frame`.
        tolerance: Difference that costs nothing [rad/s].
        at: When it counts; over the hold it is the mean.
    """

    unit: ClassVar[str] = "rad^2/s^2"

    x: float | None = None
    y: float | None = None
    z: float | None = None
    at: At = "horizon"
    frame: Frame = "trunk"
    tolerance: float = 0.0

    def __post_init__(self) -> None:
        check_target("angular_velocity", x=self.x, y=self.y, z=self.z)
        check_tolerance("angular_velocity", self.tolerance)
        _check_frame("angular_velocity", self.frame)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2/s^2], shape (n,)."""
        rows = rows_at(trajectories, self.at)
        velocity = trajectories.trunk_angular_velocity[:, rows]
        if self.frame != "trunk":
            quaternion = trajectories.trunk_quaternion[:, rows]
            velocity = from_world(rotate(quaternion, velocity), quaternion, self.frame)
        return squared_distance(velocity, (self.x, self.y, self.z), self.tolerance)


@dataclass(frozen=True)
class JointVelocity:
    """Sum over the joints of the squared difference [rad^2/s^2] from a required joint velocity, by default rest.

    Attributes:
        velocity: One velocity per joint [rad/s], in the robot's joint order; None is free. All at rest if left out.
        tolerance: Difference of each joint that costs nothing [rad/s].
        at: When it counts; over the hold it is the mean.

    Raises:
        LevadeError: If the robot has another number of joints.
    """

    unit: ClassVar[str] = "rad^2/s^2"

    at: At = "horizon"
    velocity: tuple[float | None, ...] | None = None
    tolerance: float = 0.0

    def __post_init__(self) -> None:
        if self.velocity is not None:
            check_target("joint_velocity", **{f"velocity[{i}]": one for i, one in enumerate(self.velocity)})
        check_tolerance("joint_velocity", self.tolerance)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2/s^2], shape (n,)."""
        velocity = trajectories.joint_velocity[:, rows_at(trajectories, self.at)]
        if self.velocity is not None:
            joints = velocity.shape[2]
            if len(self.velocity) != joints:
                raise LevadeError(
                    f"joint_velocity.velocity: {len(self.velocity)} speeds for a robot of {joints} joints; one a joint"
                )
            wanted = [i for i, one in enumerate(self.velocity) if one is not None]
            velocity = velocity[:, :, wanted] - np.array([self.velocity[i] for i in wanted])
        return mean_over_rows(beyond(np.square(velocity), self.tolerance).sum(axis=2))


def from_world(velocity: Array, quaternion: Array, frame: Frame) -> Array:
    """Turn a velocity in world axes into the axes of another frame.

    Args:
        velocity: Velocity, shape (n, rows, 3).
        quaternion: The trunk's attitude, shape (n, rows, 4).
        frame: The frame.

    Returns:
        The same velocity in its axes, shape (n, rows, 3).
    """
    if frame == "world":
        return velocity
    if frame == "trunk":
        return rotate(conjugate(quaternion), velocity)
    yaw = roll_pitch_yaw(quaternion)[..., 2]
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x, y, z = (velocity[..., i] for i in range(3))
    return np.stack([cosine * x + sine * y, cosine * y - sine * x, z], axis=-1)


def _check_frame(term: str, frame: str) -> None:
    if frame not in _FRAMES:
        raise LevadeError(f"{term}.frame: {frame!r} is unknown; {did_you_mean(frame, _FRAMES)}")
