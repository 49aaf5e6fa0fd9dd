"""Tuck the legs in, so that a fallen robot can lie in the fewest poses.

    tucked(load_robot("go1"))           # knees bent nearly to their ends, feet under the hips

A robot with spread legs may lie on any of them. With tucked legs it lies on its back, a side or its belly, and a motion that
gets it up from there once works again.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.robot import Robot

_END = 0.05
"""Share of a knee's range that is left to its end."""

_DEEPER = 0.5
"""Largest bend of a knee beyond the crouched posture [rad]; beyond it, shank and thigh would overlap, whatever the range."""

_HIPS = np.linspace(-0.5, 0.5, 51)
"""Tested changes of a hip's angle against the crouched posture [rad]."""


def tucked(robot: Robot) -> Array:
    """Bend each knee nearly as far as it goes, with the foot under the hip as in the crouched posture.

    Args:
        robot: The robot.

    Returns:
        Joint angles [rad], shape (joints,).

    Raises:
        LevadeError: If the robot's legs do not consist of hips and knees, or it has no crouched posture.
    """
    return _tucked(robot).copy()


@lru_cache(maxsize=8)  # each of a thousand falls asks
def _tucked(robot: Robot) -> Array:
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
    """Return a knee's angle near the bent end of its range, but not too far beyond the crouched posture."""
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
    """Return the position of a foot along x of the trunk, with another angle of its hip [m]."""
    changed = posture.copy()
    changed[hip] = angle
    return float(robot.foot_positions(changed)[foot, 0])
