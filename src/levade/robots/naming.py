"""Name limbs and joints by what they are, so that one posture means the same on many robots.

A word names limbs: a limb's own name ("lf"); an end, "front", "middle" or "hind", of the legs that stand; a side, "left" or
"right"; or a kind, "leg", "arm", "waist" or "head". A joint's role may follow: "hind knee", or "hind kfe", names the knees of
the hind legs. `levade robots inspect` lists the limbs of a robot and their roles.
"""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from levade.errors import LevadeError, did_you_mean, located
from levade.robots.understanding import Leg

if TYPE_CHECKING:
    from levade.robots.robot import Robot

_WORDS = ("front", "middle", "hind", "left", "right", "leg", "arm", "waist", "head")
"""Words that some robot has limbs for."""


def limb_words(robot: Robot) -> tuple[str, ...]:
    """Return the words that name limbs of a robot, each once.

    Args:
        robot: The robot.
    """
    return tuple(dict.fromkeys(word for leg in robot.legs for word in (leg.kind, *_words(leg))))


def limbs_of(robot: Robot, word: str) -> tuple[Leg, ...]:
    """Find the limbs that a word names.

    Args:
        robot: The robot.
        word: The word.

    Returns:
        The limbs, in the robot's order. Empty if the word names none.
    """
    return tuple(leg for leg in robot.legs if word == leg.kind or word in _words(leg))


def joints_of(robot: Robot, key: str) -> dict[int, float]:
    """Find the joints that a word, or a word and a role, name.

    Args:
        robot: The robot.
        key: The words, such as "hind" or "hind kfe".

    Returns:
        Index of a joint -> the sign with which its angle mirrors that of the same joint of the first limb. The signs are 1
        without a role. Empty if the word names no limb.

    Raises:
        LevadeError: If the limbs have no joint of this role, or are no mirror images of each other.
    """
    word, _, role = key.partition(" ")
    limbs, role = limbs_of(robot, word), role.strip()
    if not limbs:
        return {}
    if not role:
        return {i: 1.0 for leg in limbs for i in _indices(robot, leg)}
    from levade.robots.symmetry import mirror_signs

    found: dict[int, float] = {}
    first: dict[str, Leg] = {}
    for leg in limbs:
        leader = first.setdefault(leg.kind, leg)
        named = [role in pair for pair in zip(leg.roles, robot.role_words(leg), strict=False)]
        if not any(named):
            continue
        signs = [1.0] * len(leg.joints) if leg is leader else mirror_signs(robot, leader, leg).tolist()
        found |= {i: sign for i, sign, own in zip(_indices(robot, leg), signs, named, strict=True) if own}
    if not found:
        roles = {own for leg in limbs for own in (*leg.roles, *robot.role_words(leg))}
        raise LevadeError(f"{word} of {robot.name} has no joint with the role {role!r}; {did_you_mean(role, roles)}")
    return found


def require_joints(robot: Robot, key: str, where: str) -> dict[int, float]:
    """Find the joints that a key of a posture names, if it is made of words for limbs and joints.

    Args:
        robot: The robot.
        key: The key; or a joint, or a pattern of joints.
        where: Start of messages.

    Returns:
        As `joints_of`. Empty for a joint or a pattern.

    Raises:
        LevadeError: If the robot lacks these limbs, or the role.
    """
    with located(f"{where}: {key}: "):
        named = joints_of(robot, key)
        word = key.partition(" ")[0]
        if named or word not in _WORDS or any(fnmatchcase(joint, key) for joint in robot.joint_names):
            return named
        kinds = dict.fromkeys(leg.kind for leg in robot.legs)
        has = ", ".join(f"{kind} ({', '.join(leg.name for leg in limbs_of(robot, kind))})" for kind in kinds)
        raise LevadeError(f"{robot.name} has no such limb, only {has}; valid names: {', '.join(limb_words(robot))}")


def by_joint(robot: Robot, angles: Mapping[str, float], where: str) -> dict[str, float]:
    """Replace words and roles by the joints that they name.

    Args:
        robot: The robot.
        angles: Joint, pattern of joints, or words with a role -> angle [rad].
        where: Start of messages.

    Returns:
        Joint, or pattern of joints -> angle [rad].

    Raises:
        LevadeError: If words have no role, or a joint fits words and another key.
    """
    plain: dict[str, float] = {}
    found: dict[str, tuple[str, float]] = {}
    for key, angle in angles.items():
        named = joints_of(robot, key)
        if not named:
            plain[key] = angle
        elif " " not in key:
            role = robot.role_words(limbs_of(robot, key)[0])[-1]
            raise LevadeError(f"{where}: {key}: a number is for joints; add their role, such as '{key} {role}'")
        for i, sign in named.items():
            joint = robot.joint_names[i]
            if joint in found:
                raise LevadeError(
                    f"{where}: joint {joint} fits {found[joint][0]!r} and {key!r}; it should fit one of them"
                )
            found[joint] = key, sign * angle
    for joint, (key, _) in found.items():
        for other in plain:
            if fnmatchcase(joint, other):
                raise LevadeError(f"{where}: joint {joint} fits {key!r} and {other!r}; it should fit one of them")
    return plain | {joint: angle for joint, (_, angle) in found.items()}


def _words(leg: Leg) -> tuple[str, ...]:
    """Words for a limb except its kind."""
    sides = (leg.side,) if leg.side in ("left", "right") else ()
    return (*((leg.end,) if leg.stands else ()), *sides, leg.name)


def _indices(robot: Robot, leg: Leg) -> range:
    joints = robot.joint_indices(leg)
    return range(joints.start, joints.stop)
