"""Preparing: change a robot's spec so that the robot can be put down and moved."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.robots import gains
from levade.robots.actuation import Actuation
from levade.robots.findings import named_joints, note, some, warning
from levade.robots.reading import Draft
from levade.robots.standing import Bare
from levade.robots.understanding import moved_bodies

TIMESTEP = 0.002
"""Time step at which servos have to be stable [s]: the default of `levade.engines.Physics`."""
_OVERLAP = 1e-4
"""Smallest overlap that counts [m]."""


def float_freely(draft: Draft, trunk: str, path: Path) -> None:
    """Add a free joint to the trunk that a description names, if the model has none.

    Args:
        draft: The model; it is changed.
        trunk: Name of the trunk's body.
        path: Path of the description, for messages.

    Raises:
        LevadeError: If there is no such body, or it has other joints.
    """
    spec = draft.spec
    bodies = [body.name for body in spec.bodies[1:]]
    if trunk not in bodies:
        raise LevadeError(f"{path}: trunk: no body {trunk!r} in {draft.path.name}; {did_you_mean(trunk, bodies)}")
    body = spec.body(trunk)
    free = [joint.type for joint in body.joints] == [mujoco.mjtJoint.mjJNT_FREE]
    if not free and (body.joints or body.parent.name != "world"):
        raise LevadeError(f"{path}: trunk: body {trunk} should have one free joint and no other")
    if not free:
        body.add_freejoint(name="root")


def exclude_overlaps(draft: Draft, bare: Bare, neutral: Mapping[str, float]) -> None:
    """Let bodies that overlap in the neutral posture pass through each other, since their shapes are larger than the parts.

    Args:
        draft: The model; it is changed.
        bare: The bare robot.
        neutral: Joint -> angle in the neutral posture [rad].
    """
    data = bare.data_at(neutral)
    mujoco.mj_collision(bare.model, data)
    pairs: dict[tuple[int, int], float] = {}
    for contact in data.contact:
        one, other = sorted(int(bare.model.geom_bodyid[geom]) for geom in contact.geom)
        if contact.dist < -_OVERLAP and one != other:
            pairs[one, other] = min(pairs.get((one, other), 0.0), float(contact.dist))
    if not pairs:
        return
    legs = {body: leg.name for leg in bare.legs for body in moved_bodies(bare.model, leg)}
    within: list[tuple[int, int]] = []
    across: list[tuple[int, int]] = []
    for one, other in pairs:
        names = [bare.model.body(body).name for body in (one, other)]
        draft.spec.add_exclude(name=f"{names[0]}-{names[1]}-at-rest", bodyname1=names[0], bodyname2=names[1])
        apart = one in legs and other in legs and legs[one] != legs[other]
        (across if apart else within).append((one, other))
    for couples, add in ((within, note), (across, warning)):
        if not couples:
            continue
        names = [" - ".join(bare.model.body(body).name for body in couple) for couple in couples]
        depth = -min(pairs[couple] for couple in couples) * 1000
        what = f"overlap by up to {depth:.0f} mm in the neutral posture: contact between them is left out"
        remedy = "legs should stand apart: fix the shapes, or give robot.yaml, postures: {neutral: ...}"
        draft.findings.append(add(f"bodies {some(names)}", what, remedy if couples is across else ""))


def set_armature(draft: Draft, bare: Bare, armature: Mapping[str, float]) -> None:
    """Set the reflected rotor inertia of joints.

    Args:
        draft: The model; it is changed.
        bare: The bare robot; its model is changed, too.
        armature: Joint -> reflected rotor inertia [kg m2].
    """
    for joint, inertia in armature.items():
        draft.spec.joint(joint).armature = inertia
        bare.model.joint(joint).armature = inertia


def add_rotors(draft: Draft, bare: Bare, torque: Array) -> None:
    """Give joints without armature the reflected rotor inertia that a geared drive of their torque has.

    Without it, an ankle turns nothing but its foot, and a servo that is stiff enough to stand on is unstable in the air.
    Quadrupeds whose joints share one gain stay as they are, and so do joints with servos of their own.

    Args:
        draft: The model; it is changed.
        bare: The bare robot; its model is changed, too.
        torque: Torque limits [Nm], shape (joints,).
    """
    if bare.shares_gains:
        return
    added = {
        joint: gains.rotor_inertia(most)
        for joint, most, own in zip(bare.joints, torque.tolist(), bare.armature, strict=True)
        if joint not in draft.servos and own == 0 and np.isfinite(most)
    }
    set_armature(draft, bare, added)
    if added:
        low, high = min(added.values()), max(added.values())
        size = f"{low:.2g}" if low == high else f"{low:.2g} to {high:.2g}"
        what = f"no armature; {size} kg m2 of reflected rotor inertia is assumed, in proportion to the torque limit"
        draft.findings.append(note(named_joints(list(added), len(bare.joints)), what))


def support_servos(draft: Draft, bare: Bare, neutral: Mapping[str, float], actuation: Actuation) -> None:
    """Add armature to links that are too light for their servo's damping at the time step once its torque saturates.

    Args:
        draft: The model; it is changed.
        bare: The bare robot.
        neutral: Joint -> angle in the neutral posture [rad].
        actuation: The actuation.
    """
    inertia = bare.joint_inertia(neutral)
    raised = {}
    for joint, kd in zip(bare.joints, actuation.kd, strict=True):
        least = float(kd) * TIMESTEP
        if inertia[joint] < least:
            raised[joint] = least - inertia[joint]
            element = draft.spec.joint(joint)
            element.armature = float(np.asarray(element.armature).ravel()[0]) + raised[joint]
    if raised:
        largest = max(raised.values())
        draft.findings.append(
            note(
                named_joints(list(raised), len(bare.joints)),
                f"get up to {largest:.2g} kg m2 of reflected rotor inertia (armature), without which servos of this damping"
                " are unstable",
            )
        )


def lift_joint_limits(draft: Draft, bare: Bare, actuation: Actuation) -> None:
    """Raise the joint limits of the file where a description gives an actuator more torque.

    Args:
        draft: The model; it is changed.
        bare: The bare robot.
        actuation: The actuation.
    """
    for joint, torque in zip(bare.joints, actuation.torque.tolist(), strict=True):
        index = bare.model.joint(joint).id
        if bare.model.jnt_actfrclimited[index] and torque > float(abs(bare.model.jnt_actfrcrange[index]).min()):
            draft.spec.joint(joint).actfrcrange = [-torque, torque] if np.isfinite(torque) else [0.0, 0.0]
            if not np.isfinite(torque):
                draft.spec.joint(joint).actfrclimited = mujoco.mjtLimited.mjLIMITED_FALSE


def lighten(draft: Draft) -> None:
    """Remove assets that no geom uses.

    Args:
        draft: The model; it is changed.
    """
    spec = draft.spec
    used = {geom.meshname for geom in spec.geoms if geom.meshname} | {g.hfieldname for g in spec.geoms if g.hfieldname}
    for element in [*spec.meshes, *spec.hfields]:
        if element.name not in used:
            spec.delete(element)
    files = {e.file for kind in ("meshes", "hfields", "textures") for e in getattr(spec, kind) if e.file}
    for name in [name for name in draft.assets if name not in files]:
        del draft.assets[name]
