"""A robot as a simulation, a cost or a motion file knows it: names, limits and geometry; numpy only.

    robot.embodiment.joint_names        # of a `levade.robots.Robot`
    motion.embodiment.limits.torque     # (joints,) [Nm], of a motion file

A `Robot` has one, and a motion file yields one, so that whatever simulates or judges a motion needs no robot description.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from levade.arrays import Array
from levade.rotations import rotate


@dataclass(frozen=True)
class TorqueCurve:
    """Torque that a joint's linkage can transmit, over its angle: ``peak * cos(rate * (|angle| - centre))``.

    Attributes:
        peak: [Nm].
        rate: [-].
        centre: [rad], the angle of the best lever arm.
    """

    peak: float
    rate: float
    centre: float

    def __call__(self, angle: Array) -> Array:
        """Torque limit [Nm] at each angle [rad], same shape, never negative."""
        return np.maximum(0.0, self.peak * np.cos(self.rate * (np.abs(angle) - self.centre)))


@dataclass(frozen=True)
class JointLimits:
    """What the joints may do; infinite where the robot's description gives no limit.

    Attributes:
        lower: (joints,) [rad].
        upper: (joints,) [rad].
        velocity: (joints,) [rad/s].
        torque: (joints,) [Nm].
        torque_curves: Joint index -> limit over the joint's angle, in addition to ``torque``.
        stall_torque: Torque at rest [Nm], shape (joints,): one end of the line that limits the torque while driving.
            None where the actuators have no such line.
        no_load_speed: Speed without torque [rad/s], shape (joints,): the other end of the line.
        assumed_velocity: Indices of the joints whose limit no file gives: `levade.robots.gains` makes it up.
        assumed_torque: Indices of the joints whose limit no file gives: `levade.robots.gains` makes it up.
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
        """Torque limit [Nm] at (..., joints) [rad], same shape: the constant limit lowered by the linkage curves."""
        limit = np.broadcast_to(self.torque, joint_position.shape).copy()
        for joint, curve in self.torque_curves.items():
            np.minimum(limit[..., joint], curve(joint_position[..., joint]), out=limit[..., joint])
        return limit

    def angle_left(self, joint_position: Array) -> Array:
        """[rad] to the nearer end of the range, negative beyond it; infinite without a range. (..., joints), as given."""
        return np.minimum(joint_position - self.lower, self.upper - joint_position)

    def speed_left(self, joint_velocity: Array) -> Array:
        """What is left of the speed limit, as a share of it, negative beyond it; 1 without a limit. (..., joints)."""
        return 1 - np.abs(joint_velocity) / self.velocity

    def torque_speed_left(self, joint_torque: Array, joint_velocity: Array) -> Array:
        """``1 - |torque| / stall_torque - |speed| / no_load_speed`` while driving; else 1, and without such a line.

        A drive is beyond its line, and this negative, where its torque lags behind its speed. (..., joints), as given.
        """
        if self.stall_torque is None or self.no_load_speed is None:
            return np.ones_like(joint_torque)
        used = np.abs(joint_torque) / self.stall_torque + np.abs(joint_velocity) / self.no_load_speed
        return 1 - np.where(joint_torque * joint_velocity > 0, used, 0.0)


@dataclass(frozen=True, eq=False)
class LegGeometry:
    """Where a leg's joints and foot are in the trunk frame with every joint at zero.

    Attributes:
        side: "left" or "right".
        end: "front" or "hind", or as `levade.robots.Leg` says.
        joints: Indices in the robot's joint order, from the trunk outward.
        anchors: (k, 3) [m], a point on each joint's axis.
        axes: (k, 3), unit.
        foot: (3,) [m], centre of the foot.
        sole: [m], how far the foot reaches below its centre, standing in the neutral posture.
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
        """(..., joints) [rad], all of the robot's, to (..., 3) [m]: the foot's centre in the trunk frame."""
        place = np.broadcast_to(self.foot, (*joint_position.shape[:-1], 3))
        for joint, anchor, axis in zip(self.joints[::-1], self.anchors[::-1], self.axes[::-1], strict=True):
            half = 0.5 * joint_position[..., joint, None]
            turn = np.concatenate([np.cos(half), np.sin(half) * axis], axis=-1)
            place = anchor + rotate(turn, place - anchor)
        return place


@dataclass(frozen=True, eq=False)
class Embodiment:
    """What a simulation knows of a robot.

    Attributes:
        trunk: Name of the trunk's body.
        joint_names: The robot's joint order.
        feet: Geom names of the feet, in leg order.
        limits: Joint limits, in joint order.
        trunk_com_offset: Centre of mass of the trunk, with what is fixed to it and without the legs, in the trunk frame [m],
            shape (3,).
        legs: The legs' geometry, in leg order. Empty if it is not known (files of early versions).
        trunk_balls: Balls whose lowest point is the trunk's, whichever way it is turned: centre in the trunk frame and radius
            [m], shape (k, 4). Empty if it touches nothing, or it is not known (files of earlier versions).
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
