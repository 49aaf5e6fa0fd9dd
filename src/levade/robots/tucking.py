"""Legs drawn in: the posture in which a robot that fell has the fewest ways to lie.

    tucked(load_robot("go1"))           # knees bent nearly to their ends, feet under the hips

A robot with its legs spread lies on any of them. Tucked in, it lies on its back, a side or its belly, and what gets it up from
there once does so again.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.robot import Robot

_END = 0.05
"""Of a knee's range, left to its end."""

_DEEPER = 0.5
"""Bend of a knee at most, beyond the crouched posture [rad]: shank and thigh would overlap, whatever its range."""

_HIPS = np.linspace(-0.5, 0.5, 51)
"""Changes of a hip's angle that are looked at [rad], against the crouched posture."""


def tucked(robot: Robot) -> Array:
    """Each knee bent nearly as far as it goes, with the foot under the hip as in the crouched posture.

    Args:
        robot: The robot.

    Returns:
        Joint angles [rad], shape (joints,).

    Raises:
        LevadeError: If the robot's legs are no hips and knees, or it has no crouched posture.
    """
    if "crouched" not in robot.postures or not all({"hfe", "kfe"} <= set(leg.roles) for leg in robot.standing):
        raise LevadeError(f"robot {robot.name}: its legs have no tucked posture; name another, such as neutral")
    crouched, neutral = robot.posture("crouched"), robot.posture("neutral")
    posture = crouched.copy()
    feet = robot.foot_positions(crouched)
    for i, leg in enumerate(robot.standing):
        joints = np.arange(len(robot.joint_names))[robot.joint_indices(leg)]
        hip, knee = (int(joints[leg.roles.index(role)]) for role in ("hfe", "kfe"))
        posture[knee] = _bent(robot, knee, crouched[knee], bends=crouched[knee] - neutral[knee])
        angles = crouched[hip] + _HIPS
        angles = angles[(angles >= robot.limits.lower[hip]) & (angles <= robot.limits.upper[hip])]
        off = [abs(_foot(robot, posture, hip, float(angle), i) - feet[i, 0]) for angle in angles]
        posture[hip] = angles[int(np.argmin(off))]
    return posture


def _bent(robot: Robot, knee: int, crouched: float, *, bends: float) -> float:
    """A knee's angle, nearly at the end of its range to which it bends, but not too far beyond the crouched posture."""
    lower, upper = robot.limits.lower[knee], robot.limits.upper[knee]
    sign = 1.0 if bends > 0 else -1.0
    end, other = (upper, lower) if bends > 0 else (lower, upper)
    near = (
        end - sign * _END * (abs(end - other) if np.isfinite(other) else abs(end))
        if np.isfinite(end)
        else sign * np.inf
    )
    return float(crouched + sign * np.clip(sign * (near - crouched), 0.0, _DEEPER))


def _foot(robot: Robot, posture: Array, hip: int, angle: float, foot: int) -> float:
    """Where a foot is along x [m], in trunk axes, with another angle of its hip."""
    changed = posture.copy()
    changed[hip] = angle
    return float(robot.foot_positions(changed)[foot, 0])
