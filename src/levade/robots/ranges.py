"""Ranges: correct implausible joint limits, which are degrees or stand for "no limit", since no joint turns that far."""

from __future__ import annotations

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.findings import Finding, named, warning

BELIEVED = 4 * np.pi
"""Largest plausible limit of a leg's joint [rad]: two turns from zero."""
_DEGREES = 720.0
"""Largest number that is interpreted as degrees."""


def check_ranges(spec: mujoco.MjSpec, where: str) -> None:
    """Check joint ranges.

    Args:
        spec: The model.
        where: Prefix of messages.

    Raises:
        LevadeError: If limits are inverted, which MuJoCo would treat as no limits, or are not numbers.
    """
    for joint in spec.joints:
        lower, upper = joint.range
        if joint.limited == mujoco.mjtLimited.mjLIMITED_FALSE:
            continue
        if np.isnan([lower, upper]).any():
            raise LevadeError(
                f"{where}: joint {joint.name}: its range ({lower:g} to {upper:g}) is not a pair of finite numbers; fix it"
            )
        if lower > upper:
            raise LevadeError(
                f"{where}: joint {joint.name}: limits are inverted, lower {lower:g} is above upper {upper:g};"
                " exchange them"
            )


def doubt_ranges(spec: mujoco.MjSpec, model: mujoco.MjModel) -> list[Finding]:
    """Convert ranges that look like degrees to radians, and remove other implausible ranges.

    Args:
        spec: The model; it is changed.
        model: The compiled model.

    Returns:
        Warnings about what was changed.
    """
    limits = {
        joint.name: model.joint(joint.name).range.copy()
        for joint in spec.joints
        if joint.type == mujoco.mjtJoint.mjJNT_HINGE and model.joint(joint.name).limited[0]
    }
    far = [name for name, limit in limits.items() if np.abs(limit).max() > BELIEVED]
    if not far:
        return []
    most = max(float(np.abs(limits[name]).max()) for name in far)
    if most <= _DEGREES and 2 * len(far) >= len(limits):
        for name, limit in limits.items():
            _set_range(spec.joint(name), np.radians(limit))
        what = f"ranges of up to {most:.4g} rad look like degrees: read as degrees, {np.radians(most):.3g} rad"
        where = "all joints with a range" if len(far) == len(limits) else named("joint", far)
        return [warning(where, what, "write them in radians (a URDF never has degrees; an MJCF may declare its unit)")]
    for name in far:
        spec.joint(name).limited = mujoco.mjtLimited.mjLIMITED_FALSE
    what = f"limits of up to {most:.4g} rad are not plausible: ignored"
    return [warning(named("joint", far), what, "the file's range should be that of the hardware, in rad")]


def _set_range(joint: mujoco.MjsJoint, limits: np.ndarray) -> None:
    """Set the range of a joint.

    Args:
        joint: The joint; it is changed.
        limits: Lower and upper limit [rad], shape (2,).
    """
    joint.range = np.degrees(limits) if joint.compiler.degree else limits
