"""Ranges: limits of joints that cannot be what they say, since no joint turns that far: degrees, or numbers for "none"."""

from __future__ import annotations

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.findings import Finding, named, warning

BELIEVED = 4 * np.pi
"""[rad], two turns from zero: beyond it, a limit is no range of a leg's joint."""
_DEGREES = 720.0
"""The most that is taken for degrees."""


def check_ranges(spec: mujoco.MjSpec, where: str) -> None:
    """Raise LevadeError for joints whose limits are inverted, which MuJoCo takes for none, or no numbers."""
    for joint in spec.joints:
        lower, upper = joint.range
        if joint.limited == mujoco.mjtLimited.mjLIMITED_FALSE:
            continue
        if np.isnan([lower, upper]).any():
            raise LevadeError(f"{where}: joint {joint.name}: its range ({lower:g} to {upper:g}) is no pair of numbers")
        if lower > upper:
            raise LevadeError(
                f"{where}: joint {joint.name}: limits are inverted, lower {lower:g} is above upper {upper:g};"
                " exchange them"
            )


def doubt_ranges(spec: mujoco.MjSpec, model: mujoco.MjModel) -> list[Finding]:
    """Take ranges that look like degrees for such, and others that no joint has for none.

    Args:
        spec: It is changed.
        model: Compiled from it.

    Returns:
        Warnings of what was changed.
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
        what = f"ranges of up to {most:.4g} rad look like degrees: taken as such, {np.radians(most):.3g} rad"
        where = "all joints with a range" if len(far) == len(limits) else named("joint", far)
        return [warning(where, what, "write them in radians (a URDF has no degrees; an MJCF may say which it has)")]
    for name in far:
        spec.joint(name).limited = mujoco.mjtLimited.mjLIMITED_FALSE
    what = f"limits of up to {most:.4g} rad are no range: not believed"
    return [warning(named("joint", far), what, "the file's range should be that of the hardware, in rad")]


def _set_range(joint: mujoco.MjsJoint, limits: np.ndarray) -> None:
    """limits: (2,) [rad]."""
    joint.range = np.degrees(limits) if joint.compiler.degree else limits
