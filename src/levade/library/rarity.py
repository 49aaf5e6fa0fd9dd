"""Find rare falls: those after which the robot lies in a way that a library hardly knows.

With each fall of a library, a few further ones are dropped, but not solved. Most end like a fall that is known. The library
also solves those that do not, because its answers fail mostly where it has no fall nearby.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.exports.asker import distances
from levade.library.mirror import Mirror

FURTHER = 5
"""Number of further falls that are dropped with each fall."""

RARE = 1_000_000
"""Number of the first further fall. Falls that are asked for have smaller numbers."""

_APART = 0.05
"""Distance from every known fall, beyond which a further fall is rare [rad]."""

_SHARE = 4
"""There is at most one rare fall for this many others, so that a small library stays small."""


@dataclass(frozen=True, eq=False)
class Lying:
    """Describes how the robot lies after a fall.

    Attributes:
        fall: Number of the fall.
        up: Upward direction in trunk axes, shape (3,).
        joint_position: Joint angles [rad], shape (joints,).
    """

    fall: int
    up: Array
    joint_position: Array


def further(fall: int) -> range:
    """Return the numbers of the further falls that are dropped with a fall.

    Args:
        fall: Number of the fall. With a rare fall, none are dropped.
    """
    first = RARE + FURTHER * fall
    return range(first, first + (FURTHER if fall < RARE else 0))


def rare(dropped: Sequence[Lying], known: Sequence[Lying], mirror: Mirror | None) -> tuple[int, ...]:
    """Choose rare falls. Each is the one that is farthest from all known falls and those chosen before it.

    Args:
        dropped: Further falls.
        known: Falls that the library knows, rare ones included.
        mirror: Mirror of the robot, if a fall also makes its mirror image known. None if it is not symmetric.

    Returns:
        Numbers of the falls.
    """
    falls = [one for one in known if one.fall < RARE]
    most = len(falls) // _SHARE - (len(known) - len(falls))
    if not dropped:
        return ()
    apart = _from(known, dropped, mirror)
    chosen: list[int] = []
    while len(chosen) < most and apart.max() > _APART:
        one = dropped[int(np.argmax(apart))]
        chosen.append(one.fall)
        apart = np.minimum(apart, _from([one], dropped, mirror))
    return tuple(chosen)


def _from(known: Iterable[Lying], dropped: Sequence[Lying], mirror: Mirror | None) -> Array:
    """Return the distance of each dropped fall from the nearest known one, or the image of one [rad]."""
    ups, joints = (np.array([getattr(one, name) for one in dropped]) for name in ("up", "joint_position"))
    apart = np.full(len(dropped), np.inf)
    for one in known:
        apart = np.minimum(apart, distances(ups, joints, one.up, one.joint_position))
        if mirror is not None:
            image = distances(ups, joints, mirror.up(one.up), mirror.posture(one.joint_position))
            apart = np.minimum(apart, image)
    return apart
