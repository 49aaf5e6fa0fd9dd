"""Symmetry between legs: derive from the kinematics the signs that turn one leg's joint angles into its mirror image's.

A mirror S (a diagonal matrix of +-1) maps a rotation about the axis a to one about det(S) S a: about -S a for one
plane, about S a for both together. If a leader's joint turns about a and its follower's about b = s det(S) S a, then
the follower moves as the leader's mirror image when its angle is s times the leader's.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.robot import Robot
from levade.robots.understanding import Leg

_ANGLE_TOLERANCE = np.radians(1.0)
_DISTANCE_TOLERANCE = 0.02  # m
_SHARE = 0.05
"""Tolerance as a share of the distance between two legs, since measured robots are not symmetric to the millimetre."""


def mirror_signs(robot: Robot, leader: Leg, follower: Leg) -> Array:
    """Find the signs with which follower angle = sign * leader angle makes the follower the leader's mirror image.

    Legs on different sides are reflected across the trunk's sagittal plane y = 0. Front and hind legs are reflected across
    the transverse plane halfway between their first joints, or shifted along x if all knees bend the same way. The choice is
    the one that maps the leader's neutral posture to the follower's. An insect's legs that are not mirror images are turned
    about the vertical. Axes and positions are those at zero angles.

    Args:
        robot: The robot.
        leader: The leg whose angles are given.
        follower: The leg that mirrors it.

    Returns:
        Signs of +-1, shape (joints per leg,).

    Raises:
        LevadeError: If the legs are not mirror images to 2 cm (or 5 % of the distance between them) and 1 degree.
    """
    where = f"robot {robot.name}: legs {leader.name} and {follower.name} are not mirror images"
    if len(leader.joints) != len(follower.joints):
        raise LevadeError(f"{where}: {len(leader.joints)} and {len(follower.joints)} joints")
    side = -1.0 if leader.side != follower.side else 1.0
    mirrors = [np.array([x, side, 1.0]) for x in ((-1.0, 1.0) if leader.end != follower.end else (1.0,))]
    neutral = robot.postures["neutral"]
    lead, follow = neutral[robot.joint_indices(leader)], neutral[robot.joint_indices(follower)]
    found: list[tuple[float, Array]] = []
    problems: list[str] = []
    for mirror in mirrors:
        try:
            signs = _signs(robot, leader, follower, mirror)
        except LevadeError as error:
            problems.append(str(error))
        else:
            found.append((float(np.abs(signs * lead - follow).sum()), signs))
    if not found and robot.stance == "sprawled":
        turned = _turned_signs(robot, leader, follower)
        if turned is not None:
            return turned
    if not found:
        raise LevadeError(f"{where}: {problems[0]}")
    return min(found, key=lambda candidate: candidate[0])[1]


def _turned_signs(robot: Robot, leader: Leg, follower: Leg) -> Array | None:
    """Find the signs for legs that point outward and differ only in their direction; None if they differ in more.

    Each leg is described in its own frame: outward, across and up; across is reversed for legs on different sides.
    """
    data = robot.zero_data
    shapes = []
    for leg in (leader, follower):
        joints = [data.joint(joint) for joint in leg.joints]
        first = joints[0].xanchor
        away = (data.geom(leg.foot).xpos - first) * [1.0, 1.0, 0.0]
        outward = away / max(float(np.linalg.norm(away)), 1e-9)
        hand = -1.0 if leader.side != follower.side and leg is follower else 1.0
        frame = np.array([outward, hand * np.cross([0.0, 0.0, 1.0], outward), [0.0, 0.0, 1.0]])
        points = np.array([*(joint.xanchor - first for joint in joints), data.geom(leg.foot).xpos - first])
        # a mirror maps the axis of a rotation to the opposite of its image
        shapes.append((hand * np.array([joint.xaxis for joint in joints]) @ frame.T, points @ frame.T))
    (axes, points), (other_axes, other_points) = shapes
    reach = float(np.linalg.norm(points[-1]))
    askew = np.linalg.norm(np.cross(axes, other_axes), axis=1).max()
    if askew > np.sin(_ANGLE_TOLERANCE) or np.abs(points - other_points).max() > max(
        _DISTANCE_TOLERANCE, _SHARE * reach
    ):
        return None
    return np.where(np.sum(axes * other_axes, axis=1) < 0, -1.0, 1.0)


def _signs(robot: Robot, leader: Leg, follower: Leg, mirror: Array) -> Array:
    """Find the signs for one mirror of +-1, shape (3,). A LevadeError says how far the legs are from mirror images."""
    data = robot.zero_data
    both = [[data.joint(joint) for joint in leg.joints] for leg in (leader, follower)]
    axes = np.array([[joint.xaxis for joint in leg] for leg in both])  # (2, joints, 3)
    anchors = np.array([[joint.xanchor for joint in leg] for leg in both])
    shift = np.zeros(3)
    if leader.end != follower.end:
        shift[0] = anchors[1, 0, 0] - mirror[0] * anchors[0, 0, 0]

    image_axes = mirror.prod() * mirror * axes[0]
    image_anchors = shift + mirror * anchors[0]
    signs = np.where(np.sum(image_axes * axes[1], axis=-1) < 0, -1.0, 1.0)
    tolerance = max(_DISTANCE_TOLERANCE, _SHARE * float(np.linalg.norm(anchors[0, 0] - anchors[1, 0])))
    for k, (one, other) in enumerate(zip(leader.joints, follower.joints, strict=True)):
        angle = np.arcsin(min(1.0, float(np.linalg.norm(np.cross(image_axes[k], axes[1, k])))))
        if angle > _ANGLE_TOLERANCE:
            raise LevadeError(f"axes of {one} and {other} differ by {np.degrees(angle):.3g} deg after reflection")
        # only the distance between the two axes counts; the position of an anchor on its axis has no effect
        distance = float(np.linalg.norm(np.cross(axes[1, k], anchors[1, k] - image_anchors[k])))
        if distance > tolerance:
            raise LevadeError(f"joints {one} and {other} are {distance:.3g} m apart after reflection")
    feet = [data.geom(leg.foot).xpos for leg in (leader, follower)]
    distance = float(np.linalg.norm(shift + mirror * feet[0] - feet[1]))
    if distance > tolerance:
        raise LevadeError(f"feet {leader.foot} and {follower.foot} are {distance:.3g} m apart after reflection")
    return signs
