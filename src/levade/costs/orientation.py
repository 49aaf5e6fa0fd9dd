"""The distance of the trunk from a required orientation (eq. 7, first part).

The paper subtracts roll, pitch and yaw. Those angles jump where motions of interest go: at pitch = +-90 degrees, and when the
robot turns over. Here each choice of required angles has a rotation angle that is continuous there, and equals the paper's
difference to first order near the target. For several angles at once that holds if the target is level. Elsewhere roll and yaw
are not independent rotations, and their plain differences measure none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.costs.rows import At, beyond, check_target, check_tolerance, mean_over_rows, rows_at
from levade.rotations import components, roll_pitch_yaw
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Orientation:
    """Squared angle [rad^2] between the trunk's orientation and the required one. Angles that are left out are free.

    - roll, pitch and yaw: the angle of the one rotation that takes the trunk to the goal (geodesic distance on SO(3)).
    - roll and pitch: the smallest such angle over all yaws. It is the angle between the world's up in the trunk's axes now and
      at the goal. Upside down is pi away from level, in every direction.
    - pitch and yaw: the smallest angle over all rotations about the trunk's x axis, between the nose directions.
    - pitch: difference of the z-y-x pitch while the trunk's top looks up (abs(roll) <= pi/2). Beyond that the z-y-x pitch runs
      backwards: a robot that fell over backwards to -120 degrees has -60 degrees and roll 180. So there the squared difference
      blends, with the share -cos(roll), into that of the pitch counted past the vertical (-120 degrees). Upside down is not
      mistaken for the goal, and nothing jumps. Lying on the side is free, as roll is.
    - roll, yaw, or both: wrapped differences of the z-y-x angles. These are not unique at pitch = +-pi/2. For motions that pass
      there, also require pitch.

    Attributes:
        roll: Required roll [rad], intrinsic z-y-x; None is free.
        pitch: Required pitch [rad], intrinsic z-y-x; None is free. Nose up is negative. It may go beyond +-pi/2.
        yaw: Required yaw [rad], intrinsic z-y-x; None is free.
        at: When it counts; over the hold it is the mean.
        tolerance: Angle that costs nothing [rad]; the excess is squared.
    """

    unit: ClassVar[str] = "rad^2"

    roll: float | None = None
    pitch: float | None = None
    yaw: float | None = None
    at: At = "horizon"
    tolerance: float = 0.0

    def __post_init__(self) -> None:
        check_target("orientation", roll=self.roll, pitch=self.pitch, yaw=self.yaw)
        check_tolerance("orientation", self.tolerance)

    @cached_property
    def _goal(self) -> Array:
        return quaternion_from_roll_pitch_yaw(self.roll or 0.0, self.pitch or 0.0, self.yaw or 0.0)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2], shape (n,)."""
        quaternion = trajectories.trunk_quaternion[:, rows_at(trajectories, self.at)]
        return mean_over_rows(beyond(self._squared(quaternion), self.tolerance))

    def _squared(self, quaternion: Array) -> Array:
        """Compute squared angles, shape (...), of quaternions, shape (..., 4)."""
        roll, pitch, yaw = (angle is not None for angle in (self.roll, self.pitch, self.yaw))
        if roll and pitch and yaw:
            return geodesic(quaternion, self._goal) ** 2
        if roll and pitch:
            return angle_between(world_up(quaternion), world_up(self._goal)) ** 2
        if pitch and yaw:
            return angle_between(nose(quaternion), nose(self._goal)) ** 2
        if self.pitch is not None:
            up = world_up(quaternion)
            upright = _zyx_pitch(up)
            level = np.hypot(up[..., 1], up[..., 2])
            # 0 while the top looks up, 1 at roll = 180 degrees; irrelevant where the nose is vertical: both agree
            over = np.maximum(0.0, -up[..., 2]) / np.maximum(level, np.finfo(float).tiny)
            return (1.0 - over) * wrap(upright - self.pitch) ** 2 + over * wrap(math.pi - upright - self.pitch) ** 2
        angles = roll_pitch_yaw(quaternion)
        squares = np.zeros(quaternion.shape[:-1])
        for i, goal in ((0, self.roll), (2, self.yaw)):
            if goal is not None:
                squares += wrap(angles[..., i] - goal) ** 2
        return squares


def wrap(angle: Array) -> Array:
    """Wrap angles to one turn around zero.

    Args:
        angle: Angles [rad], any shape.

    Returns:
        Angles [rad], same shape, from -pi to less than pi.
    """
    return (angle + math.pi) % (2 * math.pi) - math.pi


def geodesic(a: Array, b: Array) -> Array:
    """Compute the angle of the rotation between the attitudes of two quaternions.

    It is exact near 0 and near pi: the norm of the rotation vector log(B'A). Half that angle lies between the
    quaternions as vectors, up to their sign.

    Args:
        a: Unit quaternions, w-x-y-z, shape (..., 4).
        b: Unit quaternions, w-x-y-z, shape (..., 4); leading shapes broadcast.

    Returns:
        Angles [rad], shape (...), from 0 to pi.
    """
    difference, total = np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    return 4.0 * np.arctan2(np.minimum(difference, total), np.maximum(difference, total))


def angle_between(a: Array, b: Array) -> Array:
    """Compute the angle between unit vectors. It is exact near 0 and near pi.

    Args:
        a: Unit vectors, shape (..., 3).
        b: Unit vectors, shape (..., 3); leading shapes broadcast.

    Returns:
        Angles [rad], shape (...), from 0 to pi.
    """
    return 2.0 * np.arctan2(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))


def world_up(quaternion: Array) -> Array:
    """Return the world's up in trunk axes. It is the third row of the rotation matrix.

    Args:
        quaternion: Trunk frame to world, unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Unit vectors, shape (..., 3).
    """
    w, x, y, z = components(quaternion)
    up = np.empty((*quaternion.shape[:-1], 3))
    up[..., 0] = 2 * (x * z - w * y)
    up[..., 1] = 2 * (y * z + w * x)
    up[..., 2] = 1 - 2 * (x * x + y * y)
    return up


def nose(quaternion: Array) -> Array:
    """Return the trunk's x axis in the world. It is the first column of the rotation matrix.

    Args:
        quaternion: Trunk frame to world, unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Unit vectors, shape (..., 3).
    """
    w, x, y, z = components(quaternion)
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=-1)


def pitch_past_vertical(quaternion: Array) -> Array:
    """Compute the pitch, counted past the vertical if the trunk's top looks down.

    It is the z-y-x pitch while abs(roll) <= pi/2. A robot that rears past the vertical goes continuously from -89 to
    -91 degrees. The pitch only jumps where the trunk rolls past its side. Upside down and level is +-pi.

    Args:
        quaternion: Trunk frame to world, unit quaternions, w-x-y-z, shape (..., 4).

    Returns:
        Pitch [rad], shape (...), from -pi to less than pi. Nose up is negative.
    """
    up = world_up(quaternion)
    upright = _zyx_pitch(up)
    return wrap(np.where(up[..., 2] >= 0, upright, math.pi - upright))


def _zyx_pitch(up: Array) -> Array:
    return np.arctan2(-up[..., 0], np.hypot(up[..., 1], up[..., 2]))


def quaternion_from_roll_pitch_yaw(roll: float, pitch: float, yaw: float) -> Array:
    """Return the quaternion of intrinsic z-y-x angles.

    Args:
        roll: Roll [rad].
        pitch: Pitch [rad]. Nose up is negative.
        yaw: Yaw [rad].

    Returns:
        Unit quaternion, w-x-y-z, shape (4,).
    """
    (cr, cp, cy), (sr, sp, sy) = ([f(a / 2) for a in (roll, pitch, yaw)] for f in (math.cos, math.sin))
    return np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )
