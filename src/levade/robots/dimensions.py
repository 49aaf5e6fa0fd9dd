"""Dimensions of a robot: the lengths and the time in which tasks are stated, so that they mean the same on every robot.

Two robots that differ only in size, and are driven by equal shares of their own limits, move alike when measured in lengths of
`height` and times of `fall` (Froude similarity: gravity is the same for both).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.robots.robot import Leg, Robot

GRAVITY = 9.81
"""Gravitational acceleration [m/s^2]."""


@dataclass(frozen=True)
class Dimensions:
    """Holds a robot's own units.

    Attributes:
        height: Height of the trunk's centre of mass above the ground [m], standing level in the neutral posture with unloaded
            joints.
        leg: Length of the longest leg [m]: sum of the distances between successive joint axes, and to the foot's centre.
        trunk: Distance from the front hips to the hind hips along x [m]; 0 if the robot has no such pairs.
    """

    height: float
    leg: float
    trunk: float

    @property
    def fall(self) -> float:
        """Time to fall from the neutral height: sqrt(2 height / g) [s]."""
        return math.sqrt(2.0 * self.height / GRAVITY)


def dimensions(robot: Robot) -> Dimensions:
    """Measure a robot's own units. They follow from its kinematics and depend neither on gains nor on time steps.

    Args:
        robot: The robot.
    """
    data = robot.data_at(robot.posture("neutral"))
    axes = {joint: (data.joint(joint).xanchor.copy(), data.joint(joint).xaxis.copy()) for joint in robot.joint_names}
    hips = {end: [_hip(axes, leg) for leg in robot.standing if leg.end == end] for end in ("front", "hind")}
    trunk = float(np.mean(hips["front"]) - np.mean(hips["hind"])) if all(hips.values()) else 0.0
    return Dimensions(
        height=robot.neutral_height + float(robot.trunk_com_offset[2]),
        leg=max(_length(axes, leg, data.geom(leg.foot).xpos) for leg in robot.standing),
        trunk=abs(trunk),
    )


def _length(axes: dict[str, tuple[Array, Array]], leg: Leg, foot: Array) -> float:
    lines = [axes[joint] for joint in leg.joints]
    links = [_distance(*one, *other) for one, other in itertools.pairwise(lines)]
    anchor, axis = lines[-1]
    return sum(links) + float(np.linalg.norm(np.cross(axis, foot - anchor)))


def _distance(anchor: Array, axis: Array, other_anchor: Array, other_axis: Array) -> float:
    """Return the shortest distance between two lines [m]; the position of an anchor on its axis has no effect."""
    normal, between = np.cross(axis, other_axis), other_anchor - anchor
    length = float(np.linalg.norm(normal))
    if length < 1e-6:
        return float(np.linalg.norm(np.cross(axis, between)))
    return float(abs(between @ normal)) / length


def _hip(axes: dict[str, tuple[Array, Array]], leg: Leg) -> float:
    """Return x of the leg's first joint that does not turn about x [m]: along an x axis the anchor's position is arbitrary."""
    across = [axes[joint] for joint in leg.joints if abs(axes[joint][1][0]) < 0.5]
    return float((across or [axes[leg.joints[0]]])[0][0][0])
