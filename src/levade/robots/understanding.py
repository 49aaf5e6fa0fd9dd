"""Understanding: find the trunk, the joints of each leg, and what stands on the ground, from kinematics alone.

Names have no effect. A limb is a chain of joints that hangs on the trunk. Legs are four serial limbs of two or three hinges
each, about the axes of a leg, one in every quadrant of the trunk's frame (x forward, y left). Everything else that moves,
such as an arm, is held fixed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.findings import some
from levade.robots.shapes import reach

LEG_NAMES = {("left", "front"): "lf", ("right", "front"): "rf", ("left", "hind"): "lh", ("right", "hind"): "rh"}
"""(side, end) -> the name that levade gives a leg."""

_ALONG = 0.7
"""Least component of an axis along x or y that determines a joint's role."""
_CLEARLY = 0.9
"""One of two branches of a limb is the leg if the other reaches less than this share of its length."""


class NoFootError(LevadeError):
    """Reports that nothing collides where a leg ends."""


class FrameError(LevadeError):
    """Reports that the trunk's frame does not have x forward, y left and z up."""


@dataclass(frozen=True)
class Leg:
    """Describes a leg, or another limb that moves.

    Attributes:
        name: Name of the leg.
        joints: Names of the joints, from the trunk outward.
        foot: Name of the geom that stands on the ground.
        side: "left" or "right".
        end: "front" or "hind". With another number of legs than four also "middle", or "row1", "row2" and so on.
        roles: Roles of the joints, such as "haa" (hip abduction), "hfe" (hip flexion) and "kfe" (knee); see
            `levade.robots.limbs.limb_roles`.
        kind: "leg"; or "arm", "waist", "head" for limbs that move but do not stand. Their foot is the geom at their end.
        pads: Names of all geoms that stand on the ground, including the foot, if there are several.
    """

    name: str
    joints: tuple[str, ...]
    foot: str
    side: str
    end: str
    roles: tuple[str, ...] = ()
    kind: str = "leg"
    pads: tuple[str, ...] = ()

    @property
    def stands(self) -> bool:
        """Whether the robot stands on it."""
        return self.kind == "leg"

    @property
    def soles(self) -> tuple[str, ...]:
        """Names of the geoms that stand on the ground."""
        return self.pads or (self.foot,)


@dataclass
class Limb:
    """Describes a chain of joints from the trunk outward.

    Attributes:
        joints: Ids of the joints.
        branches: Whether it forks, so that it is not a serial chain.
    """

    joints: list[int] = field(default_factory=list)
    branches: bool = False


def find_trunk(model: mujoco.MjModel, where: str) -> int:
    """Find the body with the one free joint.

    Args:
        model: The model.
        where: Prefix of messages.

    Returns:
        Id of the body.

    Raises:
        LevadeError: If the robot has no free base, or several bodies float freely.
    """
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


class Tree:
    """Finds the moving bodies below a body.

    Args:
        model: The model.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.children: dict[int, list[int]] = {}
        for body in range(1, model.nbody):
            self.children.setdefault(int(model.body_parentid[body]), []).append(body)

    def moves(self, body: int) -> bool:
        """Tell whether a body, or one below it, has a joint.

        Args:
            body: Id of the body.

        Returns:
            True if there is a joint.
        """
        return self.model.body_jntnum[body] > 0 or any(self.moves(child) for child in self.children.get(body, []))

    def moving(self, body: int) -> list[int]:
        """Return the children of a body that move.

        Args:
            body: Id of the body.

        Returns:
            Ids of the children that have a joint, or that carry a body with one.
        """
        return [child for child in self.children.get(body, []) if self.moves(child)]

    def starts(self, body: int) -> list[int]:
        """Return the first bodies with joints below a body, passing through those that are fixed to it.

        Args:
            body: Id of the body.

        Returns:
            Ids of these bodies, one for each branch with joints.
        """
        found = []
        for child in self.children.get(body, []):
            found += [child] if self.model.body_jntnum[child] else self.starts(child)
        return found

    def joints(self, body: int) -> list[int]:
        """Return the ids of a body's own joints.

        Args:
            body: Id of the body.

        Returns:
            Ids of the joints, in the order of the model.
        """
        first = int(self.model.body_jntadr[body])
        return list(range(first, first + int(self.model.body_jntnum[body])))

    def chains(self, body: int) -> list[list[int]]:
        """Return the joints of every path from a body outward to an end.

        Args:
            body: Id of the body.

        Returns:
            Ids of the joints along each path, with the body's own joints first.
        """
        further = [chain for child in self.moving(body) for chain in self.chains(child)]
        return [self.joints(body) + chain for chain in further or [[]]]

    def below(self, body: int) -> set[int]:
        """Return a body and everything that it carries.

        Args:
            body: Id of the body.

        Returns:
            Ids of the bodies, including this one.
        """
        return {body}.union(*(self.below(child) for child in self.children.get(body, [])))


def find_limbs(model: mujoco.MjModel, trunk: int) -> list[Limb]:
    """Find the limbs.

    Args:
        model: The model.
        trunk: Id of the trunk.

    Returns:
        The limbs, in the model's order.
    """
    tree = Tree(model)

    def follow(body: int, limb: Limb) -> None:
        limb.joints += tree.joints(body)
        further = tree.moving(body)
        limb.branches |= len(further) > 1
        for child in further:
            follow(child, limb)

    limbs = []
    for body in tree.starts(trunk):
        limb = Limb()
        follow(body, limb)
        limbs.append(limb)
    return limbs


def find_legs(model: mujoco.MjModel, trunk: int, where: str) -> tuple[tuple[Leg, ...], list[str]]:
    """Find four legs.

    Args:
        model: The model.
        trunk: Id of the trunk.
        where: Prefix of messages.

    Returns:
        The legs, and the names of the joints that belong to none.

    Raises:
        LevadeError: If there are not four legs; the message lists the limbs that were found.
    """
    limbs = find_limbs(model, trunk)
    data = mujoco.MjData(model)
    level(model, data, trunk)
    legs = _four_alike(model, limbs) or _four_within(model, trunk)
    if legs is None:
        raise LevadeError(
            f"{where}: levade moves two and more legs of two to eight hinges each; {_census(model, limbs)}"
        )
    for limb in legs:
        _check_roles(model, data, trunk, limb, legs, where)
    centres = np.array([data.xanchor[limb.joints].mean(axis=0) for limb in legs])
    middle = centres.mean(axis=0)
    quadrants = [
        ("left" if centre[1] > middle[1] else "right", "front" if centre[0] > middle[0] else "hind")
        for centre in centres
    ]
    if sorted(quadrants) != sorted(LEG_NAMES):
        turned = _turned(model, data, legs[0], legs)
        kind = FrameError if turned else LevadeError
        raise kind(
            f"{where}: its four legs are not left, right, front and hind in the frame of {model.body(trunk).name}"
            f" (x forward, y left, z up); {f'it seems that {turned} there: ' if turned else ''}rotate that frame"
        )
    found = {}
    for limb, (side, end) in zip(legs, quadrants, strict=True):
        name = LEG_NAMES[side, end]
        joints = tuple(model.joint(j).name for j in limb.joints)
        foot = find_foot(model, limb.joints[-1], f"{where}: leg {name}")
        found[name] = Leg(name, joints, foot, side, end, roles(model, joints))
    used = {j for limb in legs for j in limb.joints}
    others = [
        model.joint(j).name
        for j in range(model.njnt)
        if j not in used and model.jnt_type[j] != mujoco.mjtJoint.mjJNT_FREE
    ]
    return tuple(found[name] for name in LEG_NAMES.values()), others


def has_legs(model: mujoco.MjModel, trunk: int) -> bool:
    """Tell whether four legs hang on a body.

    Args:
        model: The model.
        trunk: Id of the body.
    """
    return (_four_alike(model, find_limbs(model, trunk)) or _four_within(model, trunk)) is not None


def _four_alike(model: mujoco.MjModel, limbs: list[Limb]) -> list[Limb] | None:
    """Choose the four serial limbs of three hinges, or of two. Of more than four, choose those with the hinges of a leg."""
    for count in (3, 2):
        serial = [limb for limb in limbs if _is_serial(model, limb) and len(limb.joints) == count]
        if len(serial) == 4:
            return serial
        legs = [
            limb
            for limb in serial
            if {"hfe", "kfe"} <= set(roles(model, tuple(model.joint(j).name for j in limb.joints)))
            and "other" not in roles(model, tuple(model.joint(j).name for j in limb.joints))
        ]
        if len(legs) == 4:
            return legs
    return None


def _four_within(model: mujoco.MjModel, trunk: int) -> list[Limb] | None:
    """Find four legs with equal numbers of hinges that have branches, such as rods, or hang on a spine that can be held."""
    tree = Tree(model)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)

    def legs_below(body: int, count: int) -> list[Limb]:
        leg = _branching_leg(tree, data, body, count)
        if leg is not None:
            return [leg]
        while len(further := tree.moving(body)) == 1:
            body = further[0]
        return [limb for child in further for limb in legs_below(child, count)]

    for count in (3, 2):
        found = [limb for start in tree.starts(trunk) for limb in legs_below(start, count)]
        if len(found) == 4:
            return found
    return None


def _branching_leg(tree: Tree, data: mujoco.MjData, body: int, count: int) -> Limb | None:
    """Find the chain of this many hinges from a body outward that reaches farthest; None if the choice is not clear."""
    model = tree.model
    reaches: list[tuple[float, list[int]]] = []
    for chain in tree.chains(body):
        if len(chain) != count or not _is_serial(model, Limb(chain)):
            continue
        named = roles(model, tuple(model.joint(j).name for j in chain))
        end = tree.below(int(model.jnt_bodyid[chain[-1]]))
        colliding = [g for g in range(model.ngeom) if int(model.geom_bodyid[g]) in end and _collides(model, g)]
        if named.count("hfe") == named.count("kfe") == 1 and "other" not in named and colliding:
            anchor = data.xanchor[chain[0]]
            reaches.append((max(reach(model, data, g, anchor) for g in colliding), chain))
    reaches.sort(reverse=True)
    if not reaches or (len(reaches) > 1 and reaches[1][0] > _CLEARLY * reaches[0][0]):
        return None
    return Limb(reaches[0][1])


def _collides(model: mujoco.MjModel, geom: int) -> bool:
    return bool(model.geom_contype[geom] or model.geom_conaffinity[geom])


def _is_serial(model: mujoco.MjModel, limb: Limb) -> bool:
    return not limb.branches and all(model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE for j in limb.joints)


def _check_roles(
    model: mujoco.MjModel, data: mujoco.MjData, trunk: int, limb: Limb, legs: list[Limb], where: str
) -> None:
    """Raise LevadeError if a limb's hinges are not those of a leg."""
    names = tuple(model.joint(j).name for j in limb.joints)
    named = roles(model, names)
    if named.count("hfe") == named.count("kfe") == 1:
        return
    axes = np.array([data.xaxis[j] for j in limb.joints])
    turned = _turned(model, data, limb, legs)
    remedy = f"it seems that {turned} there: turn the model" if turned else "this limb is not such a leg"
    kind = FrameError if turned else LevadeError
    raise kind(
        f"{where}: joints {', '.join(names)} turn about {', '.join(map(_axis_name, axes))} of {model.body(trunk).name};"
        f" levade knows legs of hip abduction (about x), hip flexion and knee (about y), x forward; {remedy}"
    )


def _turned(model: mujoco.MjModel, data: mujoco.MjData, limb: Limb, legs: list[Limb]) -> str:
    """Describe which axes point forward and up if the limb is a leg in another frame; empty if it is not a leg."""
    along = _role_axes(np.array([data.xaxis[j] for j in limb.joints]))
    left = along[-1]
    if along[-2] != left or (len(along) > 2 and along[0] == left):
        return ""
    hangs = [_hang(model, data, leg) for leg in (limb, *legs)]
    hang = hangs[0]
    if hang is None or int(np.argmax(np.abs(hang))) == left:
        return ""
    # three hinges determine which way is up; a leg of two hangs down more than it reaches forward
    up = 3 - left - along[0] if len(along) > 2 else int(np.argmax(np.abs(hang)))
    forward = 3 - left - up
    if (forward, left, up) == (0, 1, 2):
        return ""
    if any(other is not None and other[up] * hang[up] < 0 for other in hangs):  # legs that point outward, as an ant's
        return ""
    if up == 2:
        return f"{'xyz'[forward]} is forward"
    return f"{'-' if hang[up] > 0 else ''}{'xyz'[up]} is up and {'xyz'[forward]} along the robot"


def _hang(model: mujoco.MjModel, data: mujoco.MjData, limb: Limb) -> Array | None:
    """Return the vector from a limb's first joint to what it carries [m], shape (3,); None if nothing collides there."""
    body = int(model.jnt_bodyid[limb.joints[-1]])
    tips = [data.geom_xpos[g] for g in range(model.ngeom) if int(model.geom_bodyid[g]) == body and _collides(model, g)]
    return tips[0] - data.xanchor[limb.joints[0]] if tips else None


def _role_axes(axes: Array) -> list[int]:
    """Return the index of each vector's largest component, for vectors of shape (n, 3)."""
    return [int(k) for k in np.argmax(np.abs(axes), axis=1)]


def _axis_name(axis: Array) -> str:
    k = int(np.argmax(np.abs(axis)))
    if abs(axis[k]) < 0.99:
        return f"({', '.join(f'{value:.2f}' for value in axis)})"
    return f"{'-' if axis[k] < 0 else ''}{'xyz'[k]}"


def roles(model: mujoco.MjModel, joints: tuple[str, ...]) -> tuple[str, ...]:
    """Find the role of each joint of a leg by its axis at zero angles: abduction about x, hip flexion and then knee about y.

    Args:
        model: The model.
        joints: Names of the leg's joints.

    Returns:
        One role per joint.
    """
    data = mujoco.MjData(model)
    level(model, data, int(model.body_rootid[model.jnt_bodyid[model.joint(joints[0]).id]]))
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
    """Find the colliding geom that reaches farthest from a leg's last joint; a round one of nearly the same reach wins.

    Args:
        model: The model.
        joint: Id of the leg's last joint.
        where: Prefix of messages.

    Returns:
        Name of the geom.

    Raises:
        NoFootError: If nothing that moves with the joint collides.
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
        raise NoFootError(
            f"{where}: no foot: nothing collides on {model.body(body).name}, behind {model.joint(joint).name}; give it a"
            " collision shape, preferably a sphere at the tip"
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


def moved_bodies(model: mujoco.MjModel, leg: Leg) -> list[int]:
    """Return the ids of the bodies that a leg moves, from the trunk outward.

    Args:
        model: The model.
        leg: The leg.
    """
    bodies = [int(model.jnt_bodyid[model.joint(leg.joints[0]).id])]
    for body in range(bodies[0] + 1, model.nbody):
        if int(model.body_parentid[body]) in bodies:
            bodies.append(body)
    return bodies


def level(model: mujoco.MjModel, data: mujoco.MjData, trunk: int) -> None:
    """Compute kinematics at zero angles, with the trunk frame at the world frame.

    Args:
        model: The model.
        data: Its data; they are changed.
        trunk: Id of the trunk.
    """
    data.qpos[:] = 0.0
    for j in range(model.njnt):
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            data.qpos[model.jnt_qposadr[j] + 3] = 1.0
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)


def _census(model: mujoco.MjModel, limbs: list[Limb]) -> str:
    """Describe what there is instead of four legs, and what may help."""
    if not limbs:
        return "this model has no joints besides its free base"
    kinds: dict[str, list[str]] = {}
    for limb in limbs:
        hinges = sum(1 for j in limb.joints if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE)
        sliding = f" ({len(limb.joints) - hinges} of them sliding)" if hinges < len(limb.joints) else ""
        joints = f"{len(limb.joints)} joint{'s' * (len(limb.joints) > 1)}{sliding}"
        kinds.setdefault(f"{'branching ' * limb.branches}limb/ of {joints}", []).append(
            model.joint(limb.joints[0]).name
        )
    counted = []
    for kind, first in kinds.items():
        count = f"{len(first)} {kind.replace('/', 's')}" if len(first) > 1 else f"a {kind.replace('/', '')}"
        counted.append(f"{count} (from {some(first)})")
    text = f"this robot has {' and '.join([', '.join(counted[:-1]), counted[-1]] if counted[1:] else counted)}"
    sizes = [len(limb.joints) for limb in limbs if _is_serial(model, limb)]
    if any(sizes.count(count) > 4 for count in (2, 3)):
        return f"{text}; if four of them are its legs, name those in a robot.yaml (legs: ...)"
    return text


def joint_positions(model: mujoco.MjModel, joints: tuple[str, ...]) -> Array:
    """Return the addresses of joint angles in qpos, shape (joints,).

    Args:
        model: The model.
        joints: Names of the joints.
    """
    return np.array([int(model.joint(joint).qposadr[0]) for joint in joints])
