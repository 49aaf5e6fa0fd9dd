"""Look up where a robot's trunk and joints are in a model's qpos and qvel. No other module does this.

at = Addresses.of(model, robot.trunk, robot.joint_names)
data.qpos[at.trunk_pose] = [0, 0, 0.6, 1, 0, 0, 0]
data.qpos[at.joint_qpos] = robot.postures["neutral"]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco

Index = slice | list[int]
"""Addresses of several numbers: a slice if they are evenly spaced, so that indexing makes a view, not a copy."""


@dataclass(frozen=True)
class Addresses:
    """Holds addresses in the vectors of one model.

    Attributes:
        root_qpos: First address of the trunk's free joint in qpos.
        root_qvel: First address of the trunk's free joint in qvel.
        joint_qpos: Addresses of the joint angles in qpos, in the order of the names.
        joint_qvel: Addresses of the joint velocities in qvel, in the order of the names.
    """

    root_qpos: int
    root_qvel: int
    joint_qpos: Index
    joint_qvel: Index

    @classmethod
    def of(cls, model: mujoco.MjModel, trunk: str, joint_names: Sequence[str]) -> Addresses:
        """Look up a trunk, whose first joint is free, and hinges by name.

        Args:
            model: The model.
            trunk: Name of the trunk's body.
            joint_names: Names of the hinges.

        Raises:
            KeyError: If the model has no such body or joint.
        """
        root = model.joint(int(model.body(trunk).jntadr[0]))
        joints = [model.joint(str(name)) for name in joint_names]
        return cls(
            root_qpos=int(root.qposadr[0]),
            root_qvel=int(root.dofadr[0]),
            joint_qpos=compact([int(joint.qposadr[0]) for joint in joints]),
            joint_qvel=compact([int(joint.dofadr[0]) for joint in joints]),
        )

    @property
    def trunk_position(self) -> slice:
        """Addresses of the trunk frame's position in qpos."""
        return slice(self.root_qpos, self.root_qpos + 3)

    @property
    def trunk_quaternion(self) -> slice:
        """Addresses of the trunk frame's attitude in qpos, w-x-y-z."""
        return slice(self.root_qpos + 3, self.root_qpos + 7)

    @property
    def trunk_pose(self) -> slice:
        """Addresses of the trunk frame's position and attitude in qpos."""
        return slice(self.root_qpos, self.root_qpos + 7)

    @property
    def trunk_linear_velocity(self) -> slice:
        """Addresses of the trunk's linear velocity in qvel, in world axes."""
        return slice(self.root_qvel, self.root_qvel + 3)

    @property
    def trunk_angular_velocity(self) -> slice:
        """Addresses of the trunk's angular velocity in qvel, in trunk axes."""
        return slice(self.root_qvel + 3, self.root_qvel + 6)


def compact(indices: list[int]) -> Index:
    """Return addresses as a slice if they are evenly spaced, otherwise as an array.

    Args:
        indices: Addresses in an array of the model, such as qpos.

    Returns:
        A slice if the addresses increase evenly and there are at least two, otherwise the addresses themselves.
    """
    if len(indices) > 1:
        stride = indices[1] - indices[0]
        if stride > 0 and indices == list(range(indices[0], indices[-1] + 1, stride)):
            return slice(indices[0], indices[-1] + 1, stride)
    return indices
