"""Find the limbs of any robot: which branches of its kinematics stand on the ground, which do not, and what lies between.

A limb is a path from the trunk outward to where it ends or splits into small parts, as a hand into fingers. Joints that carry
two or more limbs are a waist. Limbs that have a mirror image on the other side, and reach about as deep as any, are legs. Other
pairs are arms. Names have no effect.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.robots.shapes import lowest, reach, thickness
from levade.robots.understanding import Leg, NoFootError, Tree, find_foot, level

_HAND = 0.8
"""Parts beyond a fork that reach less than this share of the limb before it belong to a hand and are not separate limbs."""
_DEEP = 0.75
"""Least depth that a leg reaches below the first joint of the deepest limb, as a share of that limb's."""
_BELOW = 0.2
"""Least depth below the trunk that legs reach, as a share of their length."""
_ABOVE = 0.25
"""Largest height above the robot's centre of mass at which legs begin, as a share of their length."""
_SAMPLES = 200
_LEVER = 0.4
"""Share of an arm's length: joints that move its end by less, such as a wrist's, are held."""
_PAD = 0.5
"""Share of a foot's thickness: shapes on its link whose lowest point is within this of the lowest are part of the sole."""
_SAME_PLACE = 0.05
"""Largest deviation of two limbs from mirror images, as a share of the distance between them; at least 2 cm."""
_ENDS = {1: ("middle",), 2: ("front", "hind"), 3: ("front", "middle", "hind")}
_SHORT = {"front": "f", "middle": "m", "hind": "h"}


@dataclass
class Branch:
    """Describes a path from the trunk outward.

    Attributes:
        stem: Joints that it shares with other branches, from the trunk outward.
        joints: Its own joints.
        body: The last body that it moves.
        low: z of the deepest point that it reaches [m].
        length: Length along its joints [m].
        start: z of its first joint [m].
        tip: Its end at zero angles [m], shape (3,).
        wheels: Joints after its own that may turn a wheel.
    """

    stem: tuple[int, ...]
    joints: list[int]
    body: int
    low: float = 0.0
    length: float = 0.0
    start: float = 0.0
    tip: Array = field(default_factory=lambda: np.zeros(3))
    wheels: list[int] = field(default_factory=list)


@dataclass(frozen=True)
class Limbs:
    """Lists the limbs of a robot.

    Attributes:
        legs: Limbs that move, those that stand first.
        held: Names of the other joints.
        wheels: Names of those that turn wheels.
        problem: Why there are no legs, in one line. Empty if there are legs.
    """

    legs: tuple[Leg, ...]
    held: tuple[str, ...]
    wheels: tuple[str, ...] = ()
    problem: str = ""


def read_limbs(model: mujoco.MjModel, trunk: int, where: str, wanted: Mapping[str, str]) -> Limbs:
    """Find the limbs of a robot of any kind.

    Args:
        model: The robot, floating freely.
        trunk: Id of its trunk.
        where: Prefix of messages.
        wanted: "arm", "waist", "head" or "wheel" -> "free" or "held", to override the default.

    Returns:
        The limbs, or the reason why there are no legs.

    Raises:
        LevadeError: If the trunk's frame does not fit its legs, or a leg ends without a collision shape.
    """
    data = mujoco.MjData(model)
    level(model, data, trunk)
    tree = Tree(model)
    branches = [branch for start in tree.starts(trunk) for branch in _branches(tree, data, start, ())]
    if wanted.get("wheel") != "free":
        _take_wheels(model, data, tree, branches)
    axles = [branch for branch in branches if not branch.joints]
    branches = [branch for branch in branches if branch.joints]
    _measure(model, data, tree, branches)
    pairs = _pairs(model, data, branches)
    standing = _standing(model, data, branches, pairs)
    body = _colliding(model, {b for b in range(model.nbody) if model.body_weldid[b] == model.body_weldid[trunk]})
    floor = min((lowest(model, data, g) for g in body), default=0.0)
    middle = float(data.subtree_com[trunk, 2])
    solid = all(_solid(model, tree, branch) for branch in standing)
    if (
        standing
        and solid
        and all(
            branch.low > floor - _BELOW * branch.length or branch.start > middle + _ABOVE * branch.length
            for branch in standing
        )
    ):
        return Limbs((), (), (), "the limbs that may be legs are arms: they hang high, or hardly reach below the trunk")
    rest = [branch for branch in branches if all(branch is not one for one in standing)]
    for branch in rest if solid else ():
        if not _solid(model, tree, branch) and _alike(model, data, branch, standing):
            name = model.joint(branch.joints[0]).name
            raise NoFootError(
                f"{where}: nothing collides at the end of the limb from {name}, which is like the legs; give it a collision"
                " shape, preferably a sphere at the tip"
            )
    stray = _stray(data, rest, standing)
    if stray is not None:
        name = model.joint(stray.joints[0]).name
        return Limbs((), (), (), f"the limb from {name} reaches as deep as the legs, but is not one of them")
    if len(standing) < 2:
        return Limbs((), (), (), _census(model, branches))
    turned = [branch for branch in rest if branch.wheels]  # a wrist, for example
    for branch in turned:
        branch.joints += branch.wheels
    _measure(model, data, tree, turned)
    rolling = [branch for branch in axles if _lowest(model, data, tree, branch.body) < floor]
    wheels = [joint for branch in [*standing, *rolling] for joint in branch.wheels]
    legs = _named_legs(model, data, trunk, standing, where)
    legs += _others(model, data, tree, rest, pairs, standing, wanted)
    used = {joint for leg in legs for joint in leg.joints}
    free = mujoco.mjtJoint.mjJNT_FREE
    names = [model.joint(j).name for j in range(model.njnt) if model.jnt_type[j] != free]
    return Limbs(tuple(legs), tuple(n for n in names if n not in used), tuple(model.joint(j).name for j in wheels))


def stands(model: mujoco.MjModel, trunk: int) -> bool:
    """Tell whether legs of any kind hang on a body.

    Args:
        model: The model.
        trunk: Id of the body.
    """
    try:
        return not read_limbs(model, trunk, "", {}).problem
    except LevadeError:  # it has legs, but something else is wrong with them
        return True


def _branches(tree: Tree, data: mujoco.MjData, body: int, stem: tuple[int, ...]) -> list[Branch]:
    """Return the branches that start at a body with joints."""
    joints: list[int] = []
    first = data.xanchor[tree.joints(body)[0]].copy()
    place, length = first, 0.0
    while True:
        for joint in tree.joints(body):
            length += float(np.linalg.norm(data.xanchor[joint] - place))
            place = data.xanchor[joint].copy()
            joints.append(joint)
        further = tree.moving(body)
        if not further:
            return [Branch(stem, joints, body)]
        sizes = [(_size(tree, data, child, place), child) for child in further]
        large = [child for size, child in sizes if size > _HAND * length]
        largest = max(sizes)[1]
        if len(large) > 1:
            nearer = (*stem, *joints)
            return [branch for child in large for start in _starts(tree, child) for branch in
                    _branches(tree, data, start, nearer)]  # fmt: skip
        if len(further) > 1 and not large:
            return [Branch(stem, joints, body)]
        body = largest


def _starts(tree: Tree, body: int) -> list[int]:
    return [body] if tree.model.body_jntnum[body] else tree.starts(body)


def _size(tree: Tree, data: mujoco.MjData, body: int, place: Array) -> float:
    """Return how far the things that a body carries reach from a place [m]."""
    model, below = tree.model, tree.below(body)
    ends = [data.xanchor[j] for b in below for j in tree.joints(b)]
    far = [float(np.linalg.norm(end - place)) for end in ends]
    far += [reach(model, data, g, place) for g in _colliding(model, below)]
    return max(far, default=0.0)


def _colliding(model: mujoco.MjModel, bodies: set[int]) -> list[int]:
    return [
        g
        for g in range(model.ngeom)
        if int(model.geom_bodyid[g]) in bodies and (model.geom_contype[g] or model.geom_conaffinity[g])
    ]


def _take_wheels(model: mujoco.MjModel, data: mujoco.MjData, tree: Tree, branches: Sequence[Branch]) -> None:
    """Take last joints that turn without limit about the middle of what they carry out of the joints of their branches."""
    for branch in branches:
        while branch.joints and _is_wheel(model, data, tree, branch.joints[-1]):
            branch.wheels.insert(0, branch.joints.pop())


def _solid(model: mujoco.MjModel, tree: Tree, branch: Branch) -> bool:
    """Tell whether anything collides at the end of a branch."""
    return bool(_colliding(model, tree.below(int(model.jnt_bodyid[branch.joints[-1]]))))


def _lowest(model: mujoco.MjModel, data: mujoco.MjData, tree: Tree, body: int) -> float:
    """Return z of the lowest point of what a body carries [m]."""
    geoms = _colliding(model, tree.below(body))
    return min((lowest(model, data, g) for g in geoms), default=np.inf)


def _alike(model: mujoco.MjModel, data: mujoco.MjData, branch: Branch, standing: Sequence[Branch]) -> bool:
    """Tell whether the joints of a branch do the same as those of a leg."""
    own = limb_roles(model, data, [model.joint(j).name for j in branch.joints], branch.tip)
    return any(
        branch.stem == leg.stem and own == limb_roles(model, data, [model.joint(j).name for j in leg.joints], leg.tip)
        for leg in standing
    )


def _is_wheel(model: mujoco.MjModel, data: mujoco.MjData, tree: Tree, joint: int) -> bool:
    if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_HINGE:
        return False
    endless = not model.jnt_limited[joint] or float(np.ptp(model.jnt_range[joint])) > 2 * np.pi + 0.1
    geoms = _colliding(model, tree.below(int(model.jnt_bodyid[joint])))
    if not endless or not geoms:
        return False
    axis, anchor = data.xaxis[joint], data.xanchor[joint]
    for geom in geoms:
        centre = data.geom_xpos[geom] + data.geom_xmat[geom].reshape(3, 3) @ model.geom_aabb[geom, :3]
        off = float(np.linalg.norm(np.cross(axis, centre - anchor)))
        if off > 0.2 * float(model.geom_rbound[geom]):
            return False
    return True


def _measure(model: mujoco.MjModel, data: mujoco.MjData, tree: Tree, branches: Sequence[Branch]) -> None:
    """Measure, by sampling, how deep every branch reaches within its ranges, and where it ends."""
    generator = np.random.default_rng(0)
    geoms = [_colliding(model, tree.below(int(model.jnt_bodyid[branch.joints[-1]]))) for branch in branches]
    for branch, own in zip(branches, geoms, strict=True):
        anchor = data.xanchor[branch.joints[-1]]
        branch.tip = np.mean([data.geom_xpos[g] for g in own], axis=0) if own else anchor.copy()
        points = [*data.xanchor[branch.joints], branch.tip]
        branch.start = float(points[0][2])
        branch.length = float(sum(np.linalg.norm(b - a) for a, b in itertools.pairwise(points)))
        branch.low = min((lowest(model, data, g) for g in own), default=float(anchor[2]))
    moved = mujoco.MjData(model)
    hinges = [j for branch in branches for j in branch.joints if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE]
    lower, upper = _ranges(model, hinges)
    for _ in range(_SAMPLES):
        moved.qpos[:] = data.qpos
        moved.qpos[model.jnt_qposadr[hinges]] = generator.uniform(lower, upper)
        mujoco.mj_kinematics(model, moved)
        for branch, own in zip(branches, geoms, strict=True):
            for g in own:
                branch.low = min(branch.low, lowest(model, moved, g))


def _ranges(model: mujoco.MjModel, joints: Sequence[int]) -> tuple[Array, Array]:
    limited = np.array([bool(model.jnt_limited[j]) for j in joints], dtype=bool)
    bounds = np.clip(np.array([model.jnt_range[j] for j in joints]).reshape(-1, 2), -np.pi, np.pi)
    return np.where(limited, bounds[:, 0], -np.pi), np.where(limited, bounds[:, 1], np.pi)


def _pairs(model: mujoco.MjModel, data: mujoco.MjData, branches: Sequence[Branch]) -> dict[int, int]:
    """Map the index of each branch to that of its mirror image across the trunk's sagittal plane."""
    found: dict[int, int] = {}
    for i, one in enumerate(branches):
        for k in range(i + 1, len(branches)):
            other = branches[k]
            if i in found or k in found or one.stem != other.stem or len(one.joints) != len(other.joints):
                continue
            a, b = data.xanchor[one.joints[0]], data.xanchor[other.joints[0]]
            apart = float(np.linalg.norm(one.tip - other.tip))
            tolerance = max(0.02, _SAME_PLACE * apart)
            image = np.array([1.0, -1.0, 1.0])
            # the position of an anchor on its axis has no effect: the ends count, and all axes
            axes = [
                float(np.linalg.norm(np.cross(image * data.xaxis[p], data.xaxis[q])))
                for p, q in zip(one.joints, other.joints, strict=True)
            ]
            places = [(one.tip, other.tip)]  # in some files the legs are mirror images but the feet are not
            places.append(tuple(data.xanchor[branch.joints].mean(axis=0) for branch in (one, other)))
            off = min(float(np.linalg.norm(image * p - q)) for p, q in places)
            near = off <= 2 * tolerance and a[1] * b[1] <= 0
            if near and max(axes) < 0.1 and apart > 1e-3:
                found[i], found[k] = k, i
    return found


def _standing(
    model: mujoco.MjModel, data: mujoco.MjData, branches: Sequence[Branch], pairs: Mapping[int, int]
) -> list[Branch]:
    """Choose the branches that stand: they have only hinges, one of which lifts the limb, and reach about as deep as any."""
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    able = [
        i
        for i, branch in enumerate(branches)
        if all(model.jnt_type[j] == hinge for j in branch.joints)
        and 2 <= len(branch.joints) <= 8
        and "hfe" in limb_roles(model, data, [model.joint(j).name for j in branch.joints], branch.tip)
    ]
    paired = [i for i in able if i in pairs]
    if not paired:  # legs that point in all directions, like spokes
        paired = able if len(able) > 2 else []
    if not paired:
        return []
    deepest = min((branches[i] for i in able), key=lambda branch: branch.low)  # one without an image lacks its partner
    enough = deepest.start + _DEEP * (deepest.low - deepest.start) + 1e-9
    deep = [i for i in paired if branches[i].low <= enough]
    width = float(np.mean([abs(data.xanchor[branches[k].joints[0]][1]) for k in deep])) if deep else 0.0
    alike = [
        i
        for i in able  # spokes straight ahead and behind have no image, but are like the others
        if i not in deep and len(branches[i].joints) in {len(branches[k].joints) for k in deep}
        and branches[i].low <= enough and not branches[i].stem
        and (len(deep) > 2 or not _aside(data, branches[i], width))
    ]  # fmt: skip
    chosen = sorted([*deep, *alike])
    return [branches[i] for i in chosen if len(chosen) <= 8]


def _stray(data: mujoco.MjData, rest: Sequence[Branch], standing: Sequence[Branch]) -> Branch | None:
    """Find a limb that reaches as deep as legs but is not one.

    An arm or a tail in the middle, which has another number of joints than the legs, may do so.
    """
    if not standing:
        return None
    hips = float(np.mean([branch.start for branch in standing]))
    deep = hips + _DEEP * (max(branch.low for branch in standing) - hips)
    width = float(np.mean([abs(data.xanchor[branch.joints[0]][1]) for branch in standing]))
    counts = {len(branch.joints) for branch in standing}
    for branch in rest:
        if branch.low <= deep and (_aside(data, branch, width) or len(branch.joints) in counts):
            return branch
    return None


def _aside(data: mujoco.MjData, branch: Branch, width: float) -> bool:
    """Tell whether a branch starts on one side, as compared with where legs start."""
    return abs(float(data.xanchor[branch.joints[0]][1])) > 0.25 * width > 0


def _named_legs(
    model: mujoco.MjModel, data: mujoco.MjData, trunk: int, standing: list[Branch], where: str
) -> list[Leg]:
    centres = np.array([data.xanchor[branch.joints].mean(axis=0) for branch in standing])
    middle = centres.mean(axis=0)
    tips = np.array([branch.tip for branch in standing])
    across, along = np.ptp(centres[:, 1]) + np.ptp(tips[:, 1]), np.ptp(centres[:, 0]) + np.ptp(tips[:, 0])
    name = model.body(trunk).name
    if len(standing) == 2 and along > across:
        raise LevadeError(
            f"{where}: its two legs are not left and right in the frame of {name} (x forward, y left, z up); it seems that y"
            " is forward there: rotate that frame"
        )
    sides = {side: [i for i in range(len(standing)) if (centres[i, 1] >= middle[1]) == (side == "left")]
             for side in ("left", "right")}  # fmt: skip
    legs: list[Leg] = []
    for side, members in sides.items():
        members.sort(key=lambda i: -(centres[i, 0] + tips[i, 0]))
        even = len(sides["left"]) == len(sides["right"]) and len(members) in _ENDS
        for rank, i in enumerate(members):
            end = _ENDS[len(members)][rank] if even else f"row{rank + 1}"
            letter = "" if len(members) == 1 and even else _SHORT.get(end, str(rank + 1))
            joints = tuple(model.joint(j).name for j in standing[i].joints)
            short = f"{side[0]}{letter}"
            foot = find_foot(model, standing[i].joints[-1], f"{where}: leg {short}")
            away = standing[i].tip - data.xanchor[standing[i].joints[0]]
            pads = _pads(model, data, foot) if abs(away[2]) > np.linalg.norm(away[:2]) else ()
            legs.append(
                Leg(short, joints, foot, side, end, limb_roles(model, data, joints, standing[i].tip), pads=pads)
            )
    rank = {leg.name: (_order(leg.end), leg.side == "right") for leg in legs}
    return sorted(legs, key=lambda leg: rank[leg.name])


def _order(end: str) -> int:
    return {"front": 0, "middle": 1, "hind": 2}.get(end, int(end[3:]) if end[3:].isdigit() else 0)


def _pads(model: mujoco.MjModel, data: mujoco.MjData, foot: str) -> tuple[str, ...]:
    """Name the shapes that stand on the ground with the foot: those of its link that reach as deep when it hangs down.

    The result is empty if only the foot does.
    """
    geom = model.geom(foot).id
    own = _colliding(model, {int(model.geom_bodyid[geom])})
    low = {g: lowest(model, data, g) for g in own}
    pads = [g for g in own if low[g] <= min(low.values()) + _PAD * thickness(model, geom)]
    return tuple(model.geom(g).name for g in pads) if len(pads) > 1 and geom in pads else ()


def _others(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    tree: Tree,
    rest: Sequence[Branch],
    pairs: Mapping[int, int],
    standing: Sequence[Branch],
    wanted: Mapping[str, str],
) -> list[Leg]:
    """Return arms that move, and waist and head if they are asked for."""
    usual = {"arm": "free" if len(standing) == 2 else "held", "waist": "held", "head": "held"}
    kinds = {**usual, **wanted}
    found: list[Leg] = []
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    counts: dict[str, int] = {}
    arms = _arms(model, data, rest)
    for branch in rest:
        kind = "arm" if any(branch is arm for arm in arms) else "head"
        if kinds[kind] != "free" or any(model.jnt_type[j] != hinge for j in branch.joints):
            continue
        joints = branch.joints if wanted.get(kind) == "free" else _levers(model, data, tree, branch)
        geoms = _colliding(model, tree.below(int(model.jnt_bodyid[branch.joints[0]])))
        if joints and geoms:
            side = "left" if branch.tip[1] > 0.02 else "right" if branch.tip[1] < -0.02 else "middle"
            found.append(_limb(model, data, kind, side, joints, branch.tip, geoms, counts))
    found.sort(key=lambda limb: (limb.kind, limb.end, {"left": 0, "right": 1}.get(limb.side, 2)))
    stems = sorted({branch.stem for branch in [*rest, *standing] if branch.stem}, key=len)
    if kinds["waist"] == "free" and stems:
        joints = [j for j in stems[-1] if model.jnt_type[j] == hinge]
        geoms = _colliding(model, tree.below(int(model.jnt_bodyid[stems[-1][-1]])))
        if joints and geoms and not any(branch.stem for branch in standing):
            found.append(_limb(model, data, "waist", "middle", joints, data.xanchor[joints[-1]], geoms, counts))
    return found


def _limb(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    kind: str,
    side: str,
    joints: Sequence[int],
    tip: Array,
    geoms: Sequence[int],
    counts: dict[str, int],
) -> Leg:
    """Make a limb that does not stand; its foot is the shape that reaches farthest."""
    short = f"{side[0]}a" if kind == "arm" and side != "middle" else kind
    counts[short] = counts.get(short, 0) + 1
    name = short if counts[short] == 1 else f"{short}{counts[short]}"
    anchor = data.xanchor[joints[0]]
    end = max(geoms, key=lambda g: reach(model, data, g, anchor))
    names = tuple(model.joint(j).name for j in joints)
    place = "middle" if counts[short] == 1 else f"row{counts[short]}"
    return Leg(name, names, model.geom(end).name, side, place, limb_roles(model, data, names, tip), kind=kind)


def _arms(model: mujoco.MjModel, data: mujoco.MjData, rest: Sequence[Branch]) -> list[Branch]:
    """Choose the arms: limbs of three hinges or more that do not stand and have an image, otherwise the longest one."""
    long = [branch for branch in rest if len(branch.joints) >= 3]
    mirrored = [rest[i] for i in _pairs(model, data, rest)]
    return [branch for branch in long if any(branch is one for one in mirrored)] or long


def _levers(model: mujoco.MjModel, data: mujoco.MjData, tree: Tree, branch: Branch) -> list[int]:
    """Return the joints of an arm that move its end far: all except those of the wrist."""
    moved = mujoco.MjData(model)
    generator = np.random.default_rng(0)
    lower, upper = _ranges(model, branch.joints)
    lever = np.zeros(len(branch.joints))
    last = branch.joints[-1]
    geoms = _colliding(model, tree.below(int(model.jnt_bodyid[last])))
    beyond = max((reach(model, data, g, data.xanchor[last]) for g in geoms), default=0.0)
    for _ in range(64):
        moved.qpos[:] = data.qpos
        moved.qpos[model.jnt_qposadr[branch.joints]] = generator.uniform(lower, upper)
        mujoco.mj_kinematics(model, moved)
        mujoco.mj_comPos(model, moved)
        away = np.mean([moved.geom_xpos[g] for g in geoms] or [moved.xanchor[last]], axis=0) - moved.xanchor[last]
        end = moved.xanchor[last] + beyond * away / max(float(np.linalg.norm(away)), 1e-9)
        arms = np.cross(moved.xaxis[branch.joints], end - moved.xanchor[branch.joints])
        lever = np.maximum(lever, np.linalg.norm(arms, axis=1))
    links = np.diff(data.xanchor[branch.joints], axis=0)
    length = beyond + float(np.linalg.norm(links, axis=1).sum())
    return branch.joints[: int(np.flatnonzero(lever >= _LEVER * length).max(initial=-1)) + 1]


def limb_roles(model: mujoco.MjModel, data: mujoco.MjData, joints: Sequence[str], tip: Array) -> tuple[str, ...]:
    """Find the role of each joint by its effect at zero angles, in the plane in which the limb points outward.

    "haa" spreads the limb, "hfe" lifts it, "kfe" folds it, and "pitch" and "roll" turn what lies beyond. "yaw" turns about the
    vertical; for a limb that points outward this is called "swing".

    Args:
        model: The model.
        data: Kinematics at zero angles, with the trunk frame at the world frame.
        joints: Names of the limb's joints.
        tip: End of the limb [m], shape (3,).

    Returns:
        One role per joint.
    """
    away = tip - data.joint(joints[0]).xanchor
    flat = np.array([away[0], away[1], 0.0])
    sprawled = np.linalg.norm(flat) > abs(away[2])
    outward = flat / max(float(np.linalg.norm(flat)), 1e-9) if sprawled else np.array([1.0, 0.0, 0.0])
    across = np.cross([0.0, 0.0, 1.0], outward)
    named: list[str] = []
    for joint in joints:
        axis = data.joint(joint).xaxis
        shares = {"yaw": abs(axis[2]), "pitch": abs(float(axis @ across)), "roll": abs(float(axis @ outward))}
        kind = max(shares, key=lambda key: shares[key])
        if kind == "pitch":
            named.append("hfe" if "hfe" not in named else "kfe" if "kfe" not in named else "pitch")
        elif kind == "roll":
            named.append("haa" if "haa" not in named and "kfe" not in named else "roll")
        else:
            named.append("swing" if sprawled else "yaw")
    return tuple(named)


def _census(model: mujoco.MjModel, branches: Sequence[Branch]) -> str:
    if not branches:
        return "none of its limbs can stand" if model.njnt > 1 else "this model has no joints besides its free base"
    if len(branches) == 1:
        return "one limb alone does not stand"
    return "no two of its limbs that can stand are mirror images left and right of the trunk"
