"""Tuck the legs in, so that a fallen robot can lie in the fewest poses.

    tucked(load_robot("go1"))           # knees bent nearly to their ends, each hip turned outward

A robot with long legs may lie on any of them. With tucked legs it lies on its back, a side or its belly, and a motion that
gets it up from there once works again. Hips that turn outward push most robots off their sides: of sixty falls each, HyQ2Max,
Go1 and Go2 end on a side in one, none and none, instead of seven, eleven and four with straight hips.
"""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.robot import Robot

_END = 0.05
"""Share of a knee's range that is left to its end."""

_DEEPER = 0.5
"""Largest bend of a knee beyond the crouched posture [rad]; beyond it, shank and thigh would overlap, whatever the range."""

_OUTWARD = 0.5
"""Share of a hip's range, from neutral to its outer end, by which it turns outward."""

_FREELY = 0.6
"""How far a hip without limits turns outward [rad]."""

_HIPS = np.linspace(-0.5, 0.5, 51)
"""Tested changes of a hip's angle against the crouched posture [rad]."""


def tucked(robot: Robot) -> Array:
    """Bend each knee nearly as far as it goes, with the foot under the hip as in the crouched posture, and turn hips outward.

    Args:
        robot: The robot.

    Returns:
        Joint angles [rad], shape (joints,).

    Raises:
        LevadeError: If the robot's legs do not consist of hips and knees, or it has no crouched posture.
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
        if "haa" in leg.roles:
            spread = int(joints[leg.roles.index("haa")])
            posture[spread] = _outward(robot, posture, spread, i)
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


def _outward(robot: Robot, posture: Array, hip: int, foot: int) -> float:
    """Return the angle of a hip that is turned outward by a share of what is left of its range."""
    turned = posture.copy()
    turned[hip] += 1e-3
    y, moved = robot.foot_positions(posture)[foot, 1], robot.foot_positions(turned)[foot, 1]
    lower, upper = robot.limits.lower[hip], robot.limits.upper[hip]
    sign = 1.0 if (moved - y) * y > 0 else -1.0
    end = upper if sign > 0 else lower
    return float(posture[hip] + (_OUTWARD * (end - posture[hip]) if np.isfinite(end) else sign * _FREELY))


def _foot(robot: Robot, posture: Array, hip: int, angle: float, foot: int) -> float:
    """Return the position of a foot along x of the trunk, with another angle of its hip [m]."""
    changed = posture.copy()
    changed[hip] = angle
    return float(robot.foot_positions(changed)[foot, 0])
