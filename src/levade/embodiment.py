"""A robot as simulations, costs and motion files describe it: names, limits and geometry. It needs only numpy.

    robot.embodiment.joint_names        # of a `levade.robots.Robot`
    motion.embodiment.limits.torque     # (joints,) [Nm], of a motion file

A `Robot` has one, and so has a motion file. So simulating and judging a motion needs no robot description.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from levade.arrays import Array
from levade.rotations import rotate

LEAST_SHARE = 1e-9
"""Share of a linkage's largest torque that stands for the torque of zero, where shares of it are computed."""


@dataclass(frozen=True)
class TorqueCurve:
    """Torque that a joint's linkage transmits, over its angle: ``peak * cos(rate * (|angle| - centre))``.

    Attributes:
        peak: Largest torque [Nm].
        rate: Factor on the angle [-].
        centre: Angle of the best lever arm [rad].
    """

    peak: float
    rate: float
    centre: float

    def __call__(self, angle: Array) -> Array:
        """Torque limit [Nm] at each angle [rad], same shape, never negative."""
        return np.maximum(0.0, self.peak * np.cos(self.rate * (np.abs(angle) - self.centre)))


@dataclass(frozen=True)
class JointLimits:
    """Limits of the joints, infinite where the robot's description gives none.

    Attributes:
        lower: Lower ends of the ranges [rad], shape (joints,).
        upper: Upper ends of the ranges [rad], shape (joints,).
        velocity: Speed limits [rad/s], shape (joints,).
        torque: Torque limits [Nm], shape (joints,).
        torque_curves: Joint index -> limit over the joint's angle, in addition to ``torque``.
        stall_torque: Torque at rest of the line that limits a driving joint [Nm], shape (joints,). None if the actuators have
            no such line.
        no_load_speed: Speed without torque of that line [rad/s], shape (joints,).
        assumed_velocity: Indices of the joints whose speed limit is assumed (`levade.robots.gains`).
        assumed_torque: Indices of the joints whose torque limit is assumed (`levade.robots.gains`).
    """

    lower: Array
    upper: Array
    velocity: Array
    torque: Array
    torque_curves: Mapping[int, TorqueCurve] = field(default_factory=dict)
    stall_torque: Array | None = None
    no_load_speed: Array | None = None
    assumed_velocity: tuple[int, ...] = ()
    assumed_torque: tuple[int, ...] = ()

    def torque_at(self, joint_position: Array) -> Array:
        """Compute the torque limit at joint angles: the constant limit lowered by the linkage curves.

        Args:
            joint_position: Joint angles [rad], shape (..., joints).

        Returns:
            Torque limits [Nm], shape (..., joints).
        """
        limit = np.broadcast_to(self.torque, joint_position.shape).copy()
        for joint, curve in self.torque_curves.items():
            np.minimum(limit[..., joint], curve(joint_position[..., joint]), out=limit[..., joint])
        return limit

    def angle_left(self, joint_position: Array) -> Array:
        """Compute the slack to the nearer end of the range.

        Args:
            joint_position: Joint angles [rad], shape (..., joints).

        Returns:
            Slack [rad], shape (..., joints). It is negative beyond the range, and infinite without one.
        """
        return np.minimum(joint_position - self.lower, self.upper - joint_position)

    def speed_left(self, joint_velocity: Array) -> Array:
        """Compute the slack to the speed limit, as a share of the limit.

        Args:
            joint_velocity: Joint velocities [rad/s], shape (..., joints).

        Returns:
            Shares, shape (..., joints). A share is negative beyond the limit, and 1 without one.
        """
        return 1 - np.abs(joint_velocity) / self.velocity

    def torque_speed_left(self, joint_torque: Array, joint_velocity: Array) -> Array:
        """Compute ``1 - |torque| / stall_torque - |speed| / no_load_speed`` of driving joints.

        It is 1 for a joint that does not drive, and without such a line. If the torque lags behind the speed, a drive
        can be beyond its line, and this is negative.

        Args:
            joint_torque: Joint torques [Nm], shape (..., joints).
            joint_velocity: Joint velocities [rad/s], shape (..., joints).

        Returns:
            Shares of the line that are left, shape (..., joints).
        """
        if self.stall_torque is None or self.no_load_speed is None:
            return np.ones_like(joint_torque)
        used = np.abs(joint_torque) / self.stall_torque + np.abs(joint_velocity) / self.no_load_speed
        return 1 - np.where(joint_torque * joint_velocity > 0, used, 0.0)

    def linkage_left(self, joint_position: Array, joint_torque: Array) -> Array:
        """Compute the slack to the torque that linkages transmit at the joints' angles, as a share of it.

        Args:
            joint_position: Joint angles [rad], shape (..., joints).
            joint_torque: Joint torques [Nm], shape (..., joints).

        Returns:
            Shares, shape (..., joints). A share is negative beyond the curve, and 1 for a joint without a linkage.
        """
        left = np.ones_like(joint_torque)
        for joint, curve in self.torque_curves.items():
            transmitted = np.maximum(curve(joint_position[..., joint]), LEAST_SHARE * curve.peak)
            left[..., joint] = 1 - np.abs(joint_torque[..., joint]) / transmitted
        return left


@dataclass(frozen=True, eq=False)
class LegGeometry:
    """Geometry of a leg in the trunk frame, with every joint at zero.

    Attributes:
        side: "left" or "right".
        end: "front" or "hind", or as in `levade.robots.Leg`.
        joints: Indices in the robot's joint order, from the trunk outward.
        anchors: A point on each joint's axis [m], shape (k, 3).
        axes: Unit vectors of the axes, shape (k, 3).
        foot: Centre of the foot [m], shape (3,).
        sole: How far the foot reaches below its centre in the neutral posture [m].
        stands: Whether it is a leg to stand on, or a limb that only moves, such as an arm.
    """

    name: str
    side: str
    end: str
    joints: tuple[int, ...]
    anchors: Array
    axes: Array
    foot: Array
    sole: float
    stands: bool = True

    def foot_position(self, joint_position: Array) -> Array:
        """Compute the foot's centre in the trunk frame.

        Args:
            joint_position: Angles of all joints of the robot [rad], shape (..., joints).

        Returns:
            Positions [m], shape (..., 3).
        """
        place = np.broadcast_to(self.foot, (*joint_position.shape[:-1], 3))
        for joint, anchor, axis in zip(self.joints[::-1], self.anchors[::-1], self.axes[::-1], strict=True):
            half = 0.5 * joint_position[..., joint, None]
            turn = np.concatenate([np.cos(half), np.sin(half) * axis], axis=-1)
            place = anchor + rotate(turn, place - anchor)
        return place


@dataclass(frozen=True, eq=False)
class Embodiment:
    """Describes a robot for simulations.

    Attributes:
        trunk: Name of the trunk's body.
        joint_names: The robot's joint order.
        feet: Geom names of the feet, in leg order.
        limits: Joint limits, in joint order.
        trunk_com_offset: Centre of mass of the trunk, including parts fixed to it, without the legs, in the trunk frame [m],
            shape (3,).
        legs: The legs' geometry, in leg order. Empty if it is not known (files of early versions).
        trunk_balls: Balls whose lowest point is the trunk's in any attitude: centre in the trunk frame and radius [m], shape
            (k, 4). Empty if the trunk has no shapes, or they are not known (files of early versions).
    """

    trunk: str
    joint_names: tuple[str, ...]
    feet: tuple[str, ...]
    limits: JointLimits
    trunk_com_offset: Array
    legs: tuple[LegGeometry, ...] = ()
    trunk_balls: Array = field(default_factory=lambda: np.zeros((0, 4)))

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.joint_names)
