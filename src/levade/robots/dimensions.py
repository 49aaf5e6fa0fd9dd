"""How large a robot is: the lengths and the time that tasks are stated in, so that they mean the same on every robot.

Two robots that differ in size alone, driven by shares of their own limits, do the same in lengths of `height` and times of
`fall` (Froude similarity: gravity is the same for both).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.robots.robot import Leg, Robot

GRAVITY = 9.81
"""[m/s^2]"""


@dataclass(frozen=True)
class Dimensions:
    """A robot's own units.

    height: [m], the trunk's centre of mass over the ground, standing level in the neutral posture, joints unloaded.
    leg: [m], the longest leg: sum of the distances from each joint's axis to the next one's, and to the foot's centre.
    trunk: [m], from the front hips to the hind hips along x; 0 where there are no such.
    """

    height: float
    leg: float
    trunk: float

    @property
    def fall(self) -> float:
        """[s], the time to fall from the neutral height: sqrt(2 height / g)."""
        return math.sqrt(2.0 * self.height / GRAVITY)


def dimensions(robot: Robot) -> Dimensions:
    """The robot's own units, from its kinematics alone: they depend neither on gains nor on time steps."""
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
    """Shortest distance [m] between two lines; where on its axis a joint is anchored does not count."""
    normal, between = np.cross(axis, other_axis), other_anchor - anchor
    length = float(np.linalg.norm(normal))
    if length < 1e-6:
        return float(np.linalg.norm(np.cross(axis, between)))
    return float(abs(between @ normal)) / length


def _hip(axes: dict[str, tuple[Array, Array]], leg: Leg) -> float:
    """x [m] of the leg's first joint that does not turn about x: along such an axis an anchor may be anywhere."""
    across = [axes[joint] for joint in leg.joints if abs(axes[joint][1][0]) < 0.5]
    return float((across or [axes[leg.joints[0]]])[0][0][0])
