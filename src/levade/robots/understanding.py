"""Understanding: which body is the trunk, which joints make a leg, what stands on the ground; from kinematics alone.

Names are not looked at. A limb is a chain of joints that hangs on the trunk; legs are four serial limbs of two or three
hinges each, about the axes of a leg, one in every quadrant of the trunk's frame (x forward, y left). Whatever else moves,
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
"""Least share of an axis along x or y by which a joint's role is told."""
_CLEARLY = 0.9
"""Of two branches of a limb, one is the leg where the other reaches less than this share of its length."""


class NoFootError(LevadeError):
    """Nothing collides where a leg ends."""


class FrameError(LevadeError):
    """The trunk's frame does not have x forward, y left and z up."""


@dataclass(frozen=True)
class Leg:
    """One leg.

    joints: names from the trunk outward. foot: name of the geom that stands on the ground. side: "left" or "right".
    end: "front" or "hind"; "middle", or "row1", "row2" and so on, of other numbers of legs than four. roles: of the joints:
    "haa" (hip abduction), "hfe" (hip flexion), "kfe" (knee); see `levade.robots.limbs.limb_roles`.
    kind: "leg"; or "arm", "waist", "head", which move and do not stand: their foot is the geom at their end.
    pads: names of all geoms that stand on the ground, where these are several, the foot among them.
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
        """Whether it is there to stand on."""
        return self.kind == "leg"

    @property
    def soles(self) -> tuple[str, ...]:
        """Names of the geoms that stand on the ground."""
        return self.pads or (self.foot,)


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


class Tree:
    """Bodies and the moving ones below them."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.children: dict[int, list[int]] = {}
        for body in range(1, model.nbody):
            self.children.setdefault(int(model.body_parentid[body]), []).append(body)

    def moves(self, body: int) -> bool:
        """Whether the body, or one below it, has a joint."""
        return self.model.body_jntnum[body] > 0 or any(self.moves(child) for child in self.children.get(body, []))

    def moving(self, body: int) -> list[int]:
        """The children that move."""
        return [child for child in self.children.get(body, []) if self.moves(child)]

    def starts(self, body: int) -> list[int]:
        """The first bodies with joints below a body, through those that are fixed to it."""
        found = []
        for child in self.children.get(body, []):
            found += [child] if self.model.body_jntnum[child] else self.starts(child)
        return found

    def joints(self, body: int) -> list[int]:
        """Ids of the body's own joints."""
        first = int(self.model.body_jntadr[body])
        return list(range(first, first + int(self.model.body_jntnum[body])))

    def chains(self, body: int) -> list[list[int]]:
        """The joints of every way from a body outward to an end."""
        further = [chain for child in self.moving(body) for chain in self.chains(child)]
        return [self.joints(body) + chain for chain in further or [[]]]

    def below(self, body: int) -> set[int]:
        """The body and everything that it carries."""
        return {body}.union(*(self.below(child) for child in self.children.get(body, [])))


def find_limbs(model: mujoco.MjModel, trunk: int) -> list[Limb]:
    """The limbs, in the model's order."""
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
    """The four legs, and the names of the joints that belong to none.

    Raises LevadeError, with the limbs that were found, if there are not four legs.
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
        _check_roles(model, data, trunk, limb, where)
    centres = np.array([data.xanchor[limb.joints].mean(axis=0) for limb in legs])
    middle = centres.mean(axis=0)
    quadrants = [
        ("left" if centre[1] > middle[1] else "right", "front" if centre[0] > middle[0] else "hind")
        for centre in centres
    ]
    if sorted(quadrants) != sorted(LEG_NAMES):
        turned = _turned(model, data, legs[0], np.array([data.xaxis[j] for j in legs[0].joints]))
        kind = FrameError if turned else LevadeError
        raise kind(
            f"{where}: its four legs are not left, right, front and hind in the frame of {model.body(trunk).name}"
            f" (x forward, y left, z up); {f'it seems that {turned} there: ' if turned else ''}turn that frame"
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
    """Whether four legs hang on the body of that id."""
    return (_four_alike(model, find_limbs(model, trunk)) or _four_within(model, trunk)) is not None


def _four_alike(model: mujoco.MjModel, limbs: list[Limb]) -> list[Limb] | None:
    """The four serial limbs of three hinges, or of two; where there are more, the four whose hinges are those of a leg."""
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
    """Four legs of the same number of hinges that have branches, such as rods, or hang on a spine that can be held."""
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
    """The chain of so many hinges from a body outward that is a leg: the one that reaches farthest, if it is clear."""
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


def _check_roles(model: mujoco.MjModel, data: mujoco.MjData, trunk: int, limb: Limb, where: str) -> None:
    """Raise LevadeError if a limb's hinges are not those of a leg."""
    names = tuple(model.joint(j).name for j in limb.joints)
    named = roles(model, names)
    if named.count("hfe") == named.count("kfe") == 1:
        return
    axes = np.array([data.xaxis[j] for j in limb.joints])
    turned = _turned(model, data, limb, axes)
    remedy = f"it seems that {turned} there: turn the model" if turned else "this limb is no such leg"
    kind = FrameError if turned else LevadeError
    raise kind(
        f"{where}: joints {', '.join(names)} turn about {', '.join(map(_axis_name, axes))} of {model.body(trunk).name};"
        f" levade knows legs of hip abduction (about x), hip flexion and knee (about y), x forward; {remedy}"
    )


def _turned(model: mujoco.MjModel, data: mujoco.MjData, limb: Limb, axes: Array) -> str:
    """Which axes point forward and up, if the limb is a leg in another frame; empty if it is none."""
    along = _role_axes(axes)
    left = along[-1]
    if along[-2] != left or (len(along) > 2 and along[0] == left):
        return ""
    body = int(model.jnt_bodyid[limb.joints[-1]])
    tips = [data.geom_xpos[g] for g in range(model.ngeom) if int(model.geom_bodyid[g]) == body and _collides(model, g)]
    if not tips:
        return ""
    hang = tips[0] - data.xanchor[limb.joints[0]]
    if int(np.argmax(np.abs(hang))) == left:
        return ""
    # three hinges say which way is up; of two, the leg hangs down more than it reaches forward
    up = 3 - left - along[0] if len(along) > 2 else int(np.argmax(np.abs(hang)))
    forward = 3 - left - up
    if (forward, left, up) == (0, 1, 2):
        return ""
    if up == 2:
        return f"{'xyz'[forward]} is forward"
    return f"{'-' if hang[up] > 0 else ''}{'xyz'[up]} is up and {'xyz'[forward]} along the robot"


def _role_axes(axes: Array) -> list[int]:
    """Along which axis each of (n, 3) is for the most part."""
    return [int(k) for k in np.argmax(np.abs(axes), axis=1)]


def _axis_name(axis: Array) -> str:
    k = int(np.argmax(np.abs(axis)))
    if abs(axis[k]) < 0.99:
        return f"({', '.join(f'{value:.2f}' for value in axis)})"
    return f"{'-' if axis[k] < 0 else ''}{'xyz'[k]}"


def roles(model: mujoco.MjModel, joints: tuple[str, ...]) -> tuple[str, ...]:
    """Role of each joint of a leg by its axis at zero angles: about x abduction, about y hip flexion and then knee."""
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
    """Name of the colliding geom that reaches farthest from the leg's last joint; a round one of nearly the same reach wins.

    Raises NoFootError if nothing that moves with the joint collides.
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


def moved_bodies(model: mujoco.MjModel, leg: Leg) -> list[int]:
    """Ids of the bodies that a leg moves, from the trunk outward."""
    bodies = [int(model.jnt_bodyid[model.joint(leg.joints[0]).id])]
    for body in range(bodies[0] + 1, model.nbody):
        if int(model.body_parentid[body]) in bodies:
            bodies.append(body)
    return bodies


def level(model: mujoco.MjModel, data: mujoco.MjData, trunk: int) -> None:
    """Compute kinematics at zero angles, the trunk frame on the world frame."""
    data.qpos[:] = 0.0
    for j in range(model.njnt):
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            data.qpos[model.jnt_qposadr[j] + 3] = 1.0
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)


def _census(model: mujoco.MjModel, limbs: list[Limb]) -> str:
    """What there is instead of four legs, and what may help."""
    if not limbs:
        return "this model has no joints beside its free base"
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
    if len([size for size in sizes if size > 3]) == 4:
        return (
            f"{text}; if these are legs, hold the joints beyond three fixed in a robot.yaml (fixed: {{joint: angle}})"
        )
    return text


def joint_positions(model: mujoco.MjModel, joints: tuple[str, ...]) -> Array:
    """(joints,) addresses of the joints' angles in qpos."""
    return np.array([int(model.joint(joint).qposadr[0]) for joint in joints])
