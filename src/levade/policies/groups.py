"""Groups of joints that share a policy, as "the same policy for the front and hind leg pairs" of the paper's rearing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError


@dataclass(frozen=True)
class Follower:
    """A leg that copies the leader of its group.

    Attributes:
        joints: Indices in the robot's joint order, one for each of the leader's joints.
        signs: +1 or -1 for each joint: angle of the follower = sign * angle of the leader.
    """

    joints: tuple[int, ...]
    signs: tuple[float, ...]


@dataclass(frozen=True)
class Group:
    """Legs that move together: the leader's joints have kernels and weights of their own, and the followers mirror them.

    Attributes:
        leader: Joint indices in the robot's joint order.
        followers: Legs that copy the leader.
    """

    leader: tuple[int, ...]
    followers: tuple[Follower, ...] = ()


def independent_joints(joints: int) -> tuple[Group, ...]:
    """Give every joint a policy of its own, as in the paper's posture recovery.

    Args:
        joints: Number of joints.

    Returns:
        One group of all joints, in the robot's joint order.
    """
    return (Group(leader=tuple(range(joints))),)


def expansion(groups: Sequence[Group]) -> tuple[NDArray[np.intp], Array]:
    """Find how the independent joints spread over all joints: ``all = sign * independent[index]``.

    Args:
        groups: Groups of joints. Independent joints are numbered group by group, in the order of each leader's joints.

    Returns:
        Index and sign, shape (joints,) each.

    Raises:
        LevadeError: If a joint does not belong to exactly one leg, or a sign is not 1 or -1.
    """
    owner: dict[int, tuple[int, float]] = {}
    first = 0
    for number, group in enumerate(groups):
        legs = [(group.leader, (1.0,) * len(group.leader)), *((f.joints, f.signs) for f in group.followers)]
        for leg, signs in legs:
            if not len(leg) == len(signs) == len(group.leader):
                raise LevadeError(
                    f"group {number}: a leg has {len(leg)} joints and {len(signs)} signs, but its leader has"
                    f" {len(group.leader)} joints; give one joint and one sign for each of the leader's"
                )
            for offset, (joint, sign) in enumerate(zip(leg, signs, strict=True)):
                if sign not in (1, -1):
                    raise LevadeError(f"group {number}: the sign of joint {joint} is {sign}; give 1 or -1")
                if joint in owner:
                    raise LevadeError(f"group {number}: joint {joint} is already in a group; put each joint in one")
                owner[joint] = (first + offset, float(sign))
        first += len(group.leader)
    if not owner or sorted(owner) != list(range(len(owner))):
        missing = sorted(set(range(max(owner, default=0) + 1)) - set(owner))
        raise LevadeError(f"groups: joints {missing} are in no group; put every joint in one, from 0 on")
    index = np.array([owner[joint][0] for joint in range(len(owner))], dtype=np.intp)
    return index, np.array([owner[joint][1] for joint in range(len(owner))])
