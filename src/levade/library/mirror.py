"""Mirror a robot in its sagittal plane. If a motion works from a fall, its image works from the image of the fall.

mirror = Mirror.of(robot)                       # None if left and right differ
mirror.up(up), mirror.posture(joint_position)
mirror.decisions(policy, weights)               # weights of the mirrored motion
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError
from levade.policies import FreePolicy, JointPolicy, Policy
from levade.robots import Robot
from levade.robots.symmetry import mirror_signs

_SIDEWAYS = np.array([1.0, -1.0, 1.0])
_SAME = 1e-9
"""Largest deviation of a mirror image [rad]. Images are exact except for rounding, or wrong by as much as a joint moves."""


@dataclass(frozen=True, eq=False)
class Mirror:
    """Maps each joint to its mirror image.

    Attributes:
        joints: Index of the joint whose angle each joint of the image takes, shape (joints,).
        signs: Sign of that angle, shape (joints,).
    """

    joints: NDArray[np.intp]
    signs: Array

    @classmethod
    def of(cls, robot: Robot) -> Mirror | None:
        """Find the mirror of a robot.

        Args:
            robot: The robot.

        Returns:
            The mirror. None if the robot's left and right legs are not mirror images.
        """
        n = len(robot.joint_names)
        joints, signs = np.arange(n), np.ones(n)
        for leg in robot.legs:
            others = [one for one in robot.legs if (one.kind, one.end) == (leg.kind, leg.end) and one.side != leg.side]
            if len(others) != 1:
                return None
            try:
                signs[robot.joint_indices(leg)] = mirror_signs(robot, others[0], leg)
            except LevadeError:
                return None
            joints[robot.joint_indices(leg)] = np.arange(n)[robot.joint_indices(others[0])]
        return cls(joints, signs)

    @classmethod
    def from_json(cls, content: Any, *, where: str) -> Mirror | None:
        """Read a mirror that `to_json` wrote.

        Args:
            content: Content of the file, or None.
            where: File that messages name.

        Returns:
            The mirror. None if the content is None.

        Raises:
            LevadeError: If the content is not a mirror.
        """
        if content is None:
            return None
        try:
            joints = np.array(content["joints"], dtype=np.intp)
            signs = np.array(content["signs"], dtype=float)
            if sorted(joints.tolist()) != list(range(len(signs))) or not (np.abs(signs) == 1.0).all():
                raise ValueError
        except (ValueError, TypeError, LookupError, OverflowError):
            raise LevadeError(f"{where}: mirror: was not written by a build; the file is damaged") from None
        return cls(joints, signs)

    def to_json(self) -> dict[str, list[int]]:
        """Convert the mirror to plain lists."""
        return {"joints": self.joints.tolist(), "signs": self.signs.astype(int).tolist()}

    def up(self, up: Array) -> Array:
        """Mirror directions in trunk axes.

        Args:
            up: Directions, such as upwards, shape (..., 3).

        Returns:
            The mirrored directions, shape (..., 3).
        """
        return up * _SIDEWAYS

    def posture(self, joint_position: Array) -> Array:
        """Mirror joint angles.

        Args:
            joint_position: Joint angles [rad], shape (..., joints).

        Returns:
            Angles of the mirrored posture [rad], shape (..., joints).
        """
        return joint_position[..., self.joints] * self.signs

    def decisions(self, policy: JointPolicy, decisions: Array) -> Array | None:
        """Mirror the weights of motions.

        Args:
            policy: The policy.
            decisions: Weights of the policy, shape (n, size).

        Returns:
            Weights of the mirrored motions, shape (n, size). None if the policy cannot express them: legs that share weights
            would have to move differently, or the motion would end in another posture.
        """
        inner = policy.policy if isinstance(policy, FreePolicy) else policy
        if not isinstance(inner, Policy):
            return None
        if inner.ends is not None and not self._same(self.posture(inner.ends.goal), inner.ends.goal):
            return None
        size, kernels = inner.size, inner.kernels.kernels
        weights = decisions[:, :size].reshape(len(decisions), -1, kernels).swapaxes(1, 2)
        image = self.posture(inner.spread(weights))
        own = inner.project(image)
        if not self._same(inner.spread(own), image):
            return None
        rest = decisions[:, size:]
        if isinstance(policy, FreePolicy) and policy.goal is not None:
            return None  # the final posture is given for some joints only
        return np.concatenate([own.swapaxes(1, 2).reshape(len(decisions), size), rest], axis=1)

    @staticmethod
    def _same(one: Array, other: Array) -> bool:
        return bool(np.abs(one - other).max() < _SAME)
