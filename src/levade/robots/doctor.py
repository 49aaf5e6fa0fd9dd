"""The doctor: what is suspicious about a robot, and what to do about it."""

from __future__ import annotations

from levade.robots.robot import Robot
from levade.robots.standing import Bare


def bare(robot: Robot) -> Bare:
    """The robot as `levade.robots.standing` takes it, for kinematics and static torques."""
    ranges = {
        joint: (float(lower), float(upper))
        for joint, lower, upper in zip(robot.joint_names, robot.limits.lower, robot.limits.upper, strict=True)
    }
    return Bare(robot.model, robot.model.body(robot.trunk).id, robot.legs, ranges)
