"""Symmetry between legs: which sign takes one leg's joint angles to its mirror image's, derived from the kinematics.

A mirror S (a diagonal matrix of +-1) takes a rotation about the axis a to one about det(S) S a: about -S a for one
plane, about S a for both together. If a leader's joint turns about a and its follower's about b = s det(S) S a, then
the follower moves as the leader's mirror image when its angle is s times the leader's. The same holds without a mirror,
S the identity, for legs that are copies of each other at another place.
"""

from __future__ import annotations

import numpy as np

from levade.errors import LevadeError
from levade.robots.robot import Leg, Robot
from levade.trajectory import Array

_ANGLE_TOLERANCE = 1e-3  # rad
_DISTANCE_TOLERANCE = 1e-3  # m


def mirror_signs(robot: Robot, leader: Leg, follower: Leg) -> Array:
    """(joints per leg,) of +-1: follower angle = sign * leader angle makes the follower the leader's mirror image.

    Legs on different sides are reflected across the trunk's sagittal plane y = 0. Front and hind legs are reflected
    across the transverse plane halfway between their first joints, or moved along x, whichever takes the leader's neutral
    posture nearer to the follower's: knees "><" mirror, knees ">>" repeat. Axes and positions are those at zero angles.
    Raises `LevadeError` if the legs are not images of each other to 1 mm and 1 mrad.
    """
    where = f"robot {robot.name}: legs {leader.name} and {follower.name} are not mirror images"
    if len(leader.joints) != len(follower.joints):
        raise LevadeError(f"{where}: {len(leader.joints)} and {len(follower.joints)} joints")
    side = 1.0 if leader.side == follower.side else -1.0
    if leader.end == follower.end:
        return _signs(robot, leader, follower, np.array([1.0, side, 1.0]), where)
    found: list[Array] = []
    refused: list[LevadeError] = []
    for end in (-1.0, 1.0):
        try:
            found.append(_signs(robot, leader, follower, np.array([end, side, 1.0]), where))
        except LevadeError as error:
            refused.append(error)
    if not found:
        raise refused[0]
    neutral = robot.postures["neutral"]
    one, other = neutral[robot.joint_indices(leader)], neutral[robot.joint_indices(follower)]
    return min(found, key=lambda signs: float(np.abs(signs * one - other).max()))


def _signs(robot: Robot, leader: Leg, follower: Leg, mirror: Array, where: str) -> Array:
    """The signs for one mirror, (3,) of +-1; LevadeError if it does not take one leg to the other."""
    data = robot.data_at(np.zeros(len(robot.joint_names)))
    both = [[data.joint(joint) for joint in leg.joints] for leg in (leader, follower)]
    axes = np.array([[joint.xaxis for joint in leg] for leg in both])  # (2, joints, 3)
    anchors = np.array([[joint.xanchor for joint in leg] for leg in both])
    shift = np.zeros(3)
    if leader.end != follower.end:
        shift[0] = anchors[1, 0, 0] - mirror[0] * anchors[0, 0, 0]

    image_axes = mirror.prod() * mirror * axes[0]
    image_anchors = mirror * anchors[0] + shift
    signs = np.where(np.sum(image_axes * axes[1], axis=-1) < 0, -1.0, 1.0)
    for k, (one, other) in enumerate(zip(leader.joints, follower.joints, strict=True)):
        angle = np.arcsin(min(1.0, float(np.linalg.norm(np.cross(image_axes[k], axes[1, k])))))
        if angle > _ANGLE_TOLERANCE:
            raise LevadeError(
                f"{where}: axes of {one} and {other} differ by {np.degrees(angle):.3g} deg after reflection"
            )
        # only the distance between the two axes counts: where on its axis a joint is anchored does not
        offset = np.cross(axes[1, k], anchors[1, k] - image_anchors[k])
        distance = float(np.linalg.norm(offset))
        if distance > _DISTANCE_TOLERANCE:
            raise LevadeError(f"{where}: joints {one} and {other} are {distance:.3g} m apart after reflection")
    feet = [data.geom(leg.foot).xpos for leg in (leader, follower)]
    distance = float(np.linalg.norm(mirror * feet[0] + shift - feet[1]))
    if distance > _DISTANCE_TOLERANCE:
        raise LevadeError(
            f"{where}: feet {leader.foot} and {follower.foot} are {distance:.3g} m apart after reflection"
        )
    return signs
