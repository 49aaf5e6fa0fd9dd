"""The arrays that pass between the rooms: what is asked of the joints, and what the robot then did.

Everything is batched over ``n`` trials and sampled once per physics step. Row ``k`` of every array belongs to physics
step ``k``, which starts at ``k * timestep`` and ends at ``time[k] = (k + 1) * timestep``: references and torques are
those in force *during* the step, positions and velocities those reached at its *end*. Rows ``[:horizon_steps]`` are the
motion proper, up to the horizon T; the rows after them, if any, are the hold.

SI units; quaternions w-x-y-z; joint order is the robot's.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]


@dataclass(frozen=True)
class JointReference:
    """Desired joint motion of n trials.

    position: (n, steps, joints) [rad], desired angle during each step.
    velocity: (n, steps, joints) [rad/s], its analytic time derivative.
    timestep: [s].
    horizon_steps: number of rows up to the horizon T; later rows are the hold.
    before: (joints,) [rad], what the joints were told until the first row came, at rest; None where it is not known.
    """

    position: Array
    velocity: Array
    timestep: float
    horizon_steps: int
    before: Array | None = None

    @property
    def steps(self) -> int:
        return self.position.shape[1]

    def __getitem__(self, trials: slice | NDArray[np.integer | np.bool_] | list[int]) -> JointReference:
        """The same reference for a subset of the trials."""
        return replace(self, position=self.position[trials], velocity=self.velocity[trials])


@dataclass(frozen=True)
class TorqueCurve:
    """Torque that a joint's linkage can transmit, over its angle: ``peak * cos(rate * (|angle| - centre))``.

    peak: [Nm]; rate: [-]; centre: [rad], the angle of the best lever arm.
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

    lower, upper: (joints,) [rad]. velocity: (joints,) [rad/s]. torque: (joints,) [Nm].
    torque_curves: joint index -> limit over the joint's angle, in addition to ``torque``.
    stall_torque: (joints,) [Nm] and no_load_speed: (joints,) [rad/s], the ends of the line that limits the torque while
    driving; None where the actuators have none.
    """

    lower: Array
    upper: Array
    velocity: Array
    torque: Array
    torque_curves: Mapping[int, TorqueCurve] = field(default_factory=dict)
    stall_torque: Array | None = None
    no_load_speed: Array | None = None

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

    side: "left" or "right". end: "front" or "hind". joints: indices in the robot's joint order, from the trunk outward.
    anchors: (k, 3) [m], a point on each joint's axis. axes: (k, 3), unit. foot: (3,) [m], centre of the foot.
    sole: [m], how far the foot reaches below its centre, standing in the neutral posture.
    """

    name: str
    side: str
    end: str
    joints: tuple[int, ...]
    anchors: Array
    axes: Array
    foot: Array
    sole: float

    def foot_position(self, joint_position: Array) -> Array:
        """(..., joints) [rad], all of the robot's, to (..., 3) [m]: the foot's centre in the trunk frame."""
        place = np.broadcast_to(self.foot, (*joint_position.shape[:-1], 3))
        for joint, anchor, axis in zip(self.joints[::-1], self.anchors[::-1], self.axes[::-1], strict=True):
            half = 0.5 * joint_position[..., joint, None]
            turn = np.concatenate([np.cos(half), np.sin(half) * axis], axis=-1)
            place = anchor + rotate(turn, place - anchor)
        return place


@dataclass(frozen=True)
class Trajectories:
    """What n trials did, and everything a cost may look at.

    joint_position: (n, steps, joints) [rad] at the end of each step.
    joint_velocity: (n, steps, joints) [rad/s].
    joint_torque: (n, steps, joints) [Nm], delivered by the actuators during each step.
    trunk_position: (n, steps, 3) [m], origin of the trunk frame, in the world.
    trunk_quaternion: (n, steps, 4), trunk frame to world, w-x-y-z, unit length.
    trunk_linear_velocity: (n, steps, 3) [m/s], of the frame origin, in world axes.
    trunk_angular_velocity: (n, steps, 3) [rad/s], in trunk axes: what a gyroscope on the trunk reads.
    trunk_com_offset: (3,) [m], centre of mass of the trunk in the trunk frame.
    reference: what was asked of the joints, same n and steps.
    limits: the robot's joint limits. legs: its legs.
    timestep: [s]. horizon_steps: rows up to the horizon T.
    diverged: (n,) bool, trials whose simulation broke down; their later rows repeat the last sound one.
    foot_contact_force: (n, steps, feet, 3) [N], net contact force on each foot in world axes, in the robot's leg order;
        None unless asked for.
    body_contact_force: body name -> (n, steps) [N], magnitude of the net force that the ground and the obstacles put on
        the body; holds the bodies that were asked for.
    """

    joint_position: Array
    joint_velocity: Array
    joint_torque: Array
    trunk_position: Array
    trunk_quaternion: Array
    trunk_linear_velocity: Array
    trunk_angular_velocity: Array
    trunk_com_offset: Array
    reference: JointReference
    limits: JointLimits
    timestep: float
    horizon_steps: int
    diverged: NDArray[np.bool_]
    foot_contact_force: Array | None = None
    body_contact_force: Mapping[str, Array] = field(default_factory=dict)
    legs: tuple[LegGeometry, ...] = ()

    @property
    def n(self) -> int:
        return self.joint_position.shape[0]

    @property
    def steps(self) -> int:
        return self.joint_position.shape[1]

    @cached_property
    def time(self) -> Array:
        """(steps,) [s], end of each step."""
        return np.arange(1, self.steps + 1) * self.timestep

    def trunk_com_position(self, rows: slice | int = slice(None)) -> Array:
        """(n, rows, 3) [m], the trunk's centre of mass in the world (the paper's x_B), for the given rows only."""
        return self.trunk_position[:, rows] + rotate(self.trunk_quaternion[:, rows], self.trunk_com_offset)

    def trunk_com_velocity(self, rows: slice | int = slice(None)) -> Array:
        """(n, rows, 3) [m/s], velocity of the trunk's centre of mass in world axes, for the given rows only."""
        lever = cross(self.trunk_angular_velocity[:, rows], self.trunk_com_offset)
        return self.trunk_linear_velocity[:, rows] + rotate(self.trunk_quaternion[:, rows], lever)

    def sole_height(self, leg: LegGeometry, rows: slice | int = slice(None)) -> Array:
        """(n, rows) [m], the lowest point of a leg's foot over z = 0, for the given rows only."""
        foot = rotate(self.trunk_quaternion[:, rows], leg.foot_position(self.joint_position[:, rows]))
        return self.trunk_position[:, rows][..., 2] + foot[..., 2] - leg.sole


def rotate(quaternion: Array, vector: Array) -> Array:
    """Rotate vectors (..., 3) by unit quaternions (..., 4), w-x-y-z; leading shapes broadcast."""
    w, u = quaternion[..., :1], quaternion[..., 1:]
    t = 2.0 * cross(u, vector)
    return vector + w * t + cross(u, t)


def cross(a: Array, b: Array) -> Array:
    """Cross product of (..., 3) and (..., 3); leading shapes broadcast.

    The bits of numpy's own, whose care for axes takes several times as long as the products of a generation.
    """
    (a0, a1, a2), (b0, b1, b2) = components(a), components(b)
    first = np.asarray(a1 * b2 - a2 * b1)
    out = np.empty((*first.shape, 3))
    out[..., 0] = first
    out[..., 1] = a2 * b0 - a0 * b2
    out[..., 2] = a0 * b1 - a1 * b0
    return out


def components(values: Array) -> tuple[Array, ...]:
    """(..., k) to k views (...)."""
    return tuple(values[..., i] for i in range(values.shape[-1]))


def rotation_matrix(quaternion: Array) -> Array:
    """(..., 4) unit quaternions, w-x-y-z, to (..., 3, 3) matrices that take trunk axes to world axes."""
    w, x, y, z = components(quaternion)
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1),
            np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], axis=-1),
            np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1),
        ],
        axis=-2,
    )


def roll_pitch_yaw(quaternion: Array) -> Array:
    """(..., 4) quaternions, w-x-y-z, to (..., 3) intrinsic z-y-x angles [rad]: roll, pitch, yaw.

    Pitch is in [-pi/2, pi/2], roll and yaw in (-pi, pi]. At pitch = +-pi/2 roll and yaw are not unique; costs and
    success criteria therefore measure orientation as `levade.costs.orientation` says, not by subtracting these angles.
    """
    w, x, y, z = components(quaternion)
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.stack([roll, pitch, yaw], axis=-1)
