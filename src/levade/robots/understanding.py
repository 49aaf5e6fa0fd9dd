"""Understanding: which body is the trunk, which joints make a leg, what stands on the ground; from kinematics alone.

Names are not looked at. A limb is a serial chain of joints that hangs on the trunk; legs are four limbs of the same two
or three hinges each, one in every quadrant of the trunk's frame (x forward, y left). Whatever else moves, such as an arm,
is held fixed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.shapes import reach
from levade.trajectory import Array

LEG_NAMES = {("left", "front"): "lf", ("right", "front"): "rf", ("left", "hind"): "lh", ("right", "hind"): "rh"}
"""(side, end) -> the name that levade gives a leg."""

_ALONG = 0.7
"""Least share of an axis along x or y by which a joint's role is told."""


@dataclass(frozen=True)
class Leg:
    """One leg.

    joints: names from the trunk outward. foot: name of the geom that stands on the ground. side: "left" or "right".
    end: "front" or "hind". roles: of the joints: "haa" (hip abduction), "hfe" (hip flexion), "kfe" (knee).
    """

    name: str
    joints: tuple[str, ...]
    foot: str
    side: str
    end: str
    roles: tuple[str, ...] = ()


@dataclass
class Limb:
    """A chain of joints from the trunk outward. branches: whether it forks, so that it is no serial chain."""

    joints: list[int] = field(default_factory=list)
    branches: bool = False


def find_trunk(model: mujoco.MjModel, where: str) -> int:
    """Id of the body with the one free joint. Raises LevadeError if the robot has no free base, or several parts."""
    free = [j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]
    if not free:
        raise LevadeError(
            f"{where}: no free base, the robot is bolted to the world; give its trunk a <freejoint/> (a URDF gets one)"
        )
    bodies = [int(model.jnt_bodyid[j]) for j in free]
    if len(bodies) > 1:
        names = ", ".join(model.body(body).name for body in bodies)
        raise LevadeError(f"{where}: {len(bodies)} bodies float freely ({names}); a robot has one trunk")
    return bodies[0]


def find_limbs(model: mujoco.MjModel, trunk: int) -> list[Limb]:
    """The limbs, in the model's order."""
    children: dict[int, list[int]] = {}
    for body in range(1, model.nbody):
        children.setdefault(int(model.body_parentid[body]), []).append(body)

    def moving(body: int) -> bool:
        return model.body_jntnum[body] > 0 or any(moving(child) for child in children.get(body, []))

    def follow(body: int, limb: Limb) -> None:
        first = int(model.body_jntadr[body])
        limb.joints += range(first, first + int(model.body_jntnum[body]))
        further = [child for child in children.get(body, []) if moving(child)]
        limb.branches |= len(further) > 1
        for child in further:
            follow(child, limb)

    def starts(body: int) -> list[int]:
        """The first moving bodies below, through those that are fixed."""
        found = []
        for child in children.get(body, []):
            found += [child] if model.body_jntnum[child] else starts(child)
        return found

    limbs = []
    for body in starts(trunk):
        limb = Limb()
        follow(body, limb)
        limbs.append(limb)
    return limbs


def find_legs(model: mujoco.MjModel, trunk: int, where: str) -> tuple[tuple[Leg, ...], list[str]]:
    """The four legs, and the names of the joints that belong to none.

    Raises LevadeError, with the limbs that were found, if there are not four legs.
    """
    limbs = find_limbs(model, trunk)
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    serial = [
        limb
        for limb in limbs
        if not limb.branches and len(limb.joints) in (2, 3) and all(model.jnt_type[j] == hinge for j in limb.joints)
    ]
    data = mujoco.MjData(model)
    _level(model, data, trunk)
    for count in (3, 2):
        legs = [limb for limb in serial if len(limb.joints) == count]
        if len(legs) == 4:
            break
    else:
        raise LevadeError(
            f"{where}: has no four legs of two or three hinges each, which is what levade moves; it has {_census(model, limbs)}"
        )
    centres = np.array([data.xanchor[limb.joints].mean(axis=0) for limb in legs])
    middle = centres.mean(axis=0)
    quadrants = [
        ("left" if centre[1] > middle[1] else "right", "front" if centre[0] > middle[0] else "hind")
        for centre in centres
    ]
    if sorted(quadrants) != sorted(LEG_NAMES):
        raise LevadeError(
            f"{where}: its four legs are not left, right, front and hind in the frame of {model.body(trunk).name}"
            " (x forward, y left, z up); turn that frame"
        )
    found = {}
    for limb, (side, end) in zip(legs, quadrants, strict=True):
        name = LEG_NAMES[side, end]
        joints = tuple(model.joint(j).name for j in limb.joints)
        found[name] = Leg(
            name, joints, find_foot(model, limb.joints[-1], f"{where}: leg {name}"), side, end, roles(model, joints)
        )
    ordered = tuple(found[name] for name in LEG_NAMES.values())
    for leg in ordered:
        if leg.roles.count("hfe") != 1 or leg.roles.count("kfe") != 1:
            axes = [np.round(data.xaxis[model.joint(joint).id], 2).tolist() for joint in leg.joints]
            raise LevadeError(
                f"{where}: leg {leg.name}: joints {', '.join(leg.joints)} turn about {axes} in the frame of"
                f" {model.body(trunk).name}; levade knows hip abduction (about x), hip flexion and knee (about y): is x"
                " forward there?"
            )
    used = {j for limb in legs for j in limb.joints}
    others = [
        model.joint(j).name
        for j in range(model.njnt)
        if j not in used and model.jnt_type[j] != mujoco.mjtJoint.mjJNT_FREE
    ]
    return ordered, others


def roles(model: mujoco.MjModel, joints: tuple[str, ...]) -> tuple[str, ...]:
    """Role of each joint of a leg by its axis at zero angles: about x abduction, about y hip flexion and then knee."""
    data = mujoco.MjData(model)
    _level(model, data, int(model.body_rootid[model.jnt_bodyid[model.joint(joints[0]).id]]))
    named = []
    for joint in joints:
        axis = np.abs(data.joint(joint).xaxis)
        if axis[0] > _ALONG and "haa" not in named:
            named.append("haa")
        elif axis[1] > _ALONG:
            named.append("kfe" if "hfe" in named else "hfe")
        else:
            named.append("other")
    return tuple(named)


def find_foot(model: mujoco.MjModel, joint: int, where: str) -> str:
    """Name of the colliding geom that reaches farthest from the leg's last joint; a round one of nearly the same reach wins.

    Raises LevadeError if nothing that moves with the joint collides.
    """
    body = int(model.jnt_bodyid[joint])
    below = {body}
    for other in range(body + 1, model.nbody):
        if int(model.body_parentid[other]) in below:
            below.add(other)
    geoms = [
        g
        for g in range(model.ngeom)
        if int(model.geom_bodyid[g]) in below and (model.geom_contype[g] or model.geom_conaffinity[g])
    ]
    if not geoms:
        raise LevadeError(
            f"{where}: no foot: nothing collides on {model.body(body).name}, behind {model.joint(joint).name}; give it a"
            " collision shape, best a sphere at the tip"
        )
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    reaches = {g: reach(model, data, g, data.xanchor[joint]) for g in geoms}
    farthest = max(reaches.values())
    spheres = [
        g
        for g in geoms
        if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_SPHERE and reaches[g] > farthest - 0.5 * model.geom_size[g, 0]
    ]
    best = max(spheres or geoms, key=lambda g: reaches[g])
    return model.geom(best).name


def _level(model: mujoco.MjModel, data: mujoco.MjData, trunk: int) -> None:
    """Kinematics at zero angles, the trunk frame on the world frame."""
    data.qpos[:] = 0.0
    for j in range(model.njnt):
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            data.qpos[model.jnt_qposadr[j] + 3] = 1.0
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)


def _census(model: mujoco.MjModel, limbs: list[Limb]) -> str:
    if not limbs:
        return "no joints beside the free base"

    def one(limb: Limb) -> str:
        kind = "branching " if limb.branches else ""
        hinges = sum(1 for j in limb.joints if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE)
        sliding = f", {len(limb.joints) - hinges} of them sliding" if hinges < len(limb.joints) else ""
        plural = "s" * (len(limb.joints) > 1)
        return f"a {kind}limb of {len(limb.joints)} joint{plural}{sliding} from {model.joint(limb.joints[0]).name}"

    shown = [one(limb) for limb in limbs[:6]]
    more = f" and {len(limbs) - 6} more" if len(limbs) > 6 else ""
    return ", ".join(shown) + more


def joint_positions(model: mujoco.MjModel, joints: tuple[str, ...]) -> Array:
    """(joints,) addresses of the joints' angles in qpos."""
    return np.array([int(model.joint(joint).qposadr[0]) for joint in joints])
