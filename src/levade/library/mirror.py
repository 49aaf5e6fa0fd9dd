"""The mirror image of a robot in its sagittal plane: what works from a fall, its image does from the fall's image.

mirror = Mirror.of(robot)                       # None if left and right differ
mirror.up(up), mirror.posture(joint_position)
mirror.decisions(policy, weights)               # of the motion that is the image
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
"""[rad], up to which an image counts as one: it is exact but for rounding, or wrong by what a joint moves."""


@dataclass(frozen=True, eq=False)
class Mirror:
    """Which joint is which one's image, and whether it turns the other way.

    Attributes:
        joints: Of which joint each joint of the image takes the angle, shape (joints,).
        signs: With which sign, shape (joints,).
    """

    joints: NDArray[np.intp]
    signs: Array

    @classmethod
    def of(cls, robot: Robot) -> Mirror | None:
        """The mirror of a robot; None if its left and right legs are not images of each other."""
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
        """The mirror that `to_json` wrote; None of None.

        Raises:
            LevadeError: If it is none.
        """
        if content is None:
            return None
        try:
            joints = np.array(content["joints"], dtype=np.intp)
            signs = np.array(content["signs"], dtype=float)
            if sorted(joints.tolist()) != list(range(len(signs))) or not (np.abs(signs) == 1.0).all():
                raise ValueError
        except (ValueError, TypeError, LookupError, OverflowError):
            raise LevadeError(f"{where}: mirror: is none that a build wrote; the file is damaged") from None
        return cls(joints, signs)

    def to_json(self) -> dict[str, list[int]]:
        """Plain lists."""
        return {"joints": self.joints.tolist(), "signs": self.signs.astype(int).tolist()}

    def up(self, up: Array) -> Array:
        """Directions in trunk axes, shape (..., 3)."""
        return up * _SIDEWAYS

    def posture(self, joint_position: Array) -> Array:
        """Joint angles [rad], shape (..., joints)."""
        return joint_position[..., self.joints] * self.signs

    def decisions(self, policy: JointPolicy, decisions: Array) -> Array | None:
        """What a policy has to be told for the image of a motion, shape (n, size).

        None if it cannot be told so: legs that share weights are torn apart by it, or it ends in another posture.
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
            return None  # a final posture is told for some joints only
        return np.concatenate([own.swapaxes(1, 2).reshape(len(decisions), size), rest], axis=1)

    @staticmethod
    def _same(one: Array, other: Array) -> bool:
        return bool(np.abs(one - other).max() < _SAME)
