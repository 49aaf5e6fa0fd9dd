"""World: find the bodies of an MJCF that are the robot, and remove the rest and what ties the robot to it.

The robot is the tree under its free joint. Furniture (doors, carts, balls), equalities, tendons and forces that hold the
floating base from outside are left out: the hardware has none of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.findings import Finding, counted, named, note, some, warning
from levade.robots.limbs import stands
from levade.robots.understanding import has_legs

_FREE = mujoco.mjtJoint.mjJNT_FREE
_OF_BODIES = (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD)
_RESISTANCES = ("damping", "armature", "stiffness", "frictionloss")
_DEFAULTS_REMEDY = "a <freejoint/> takes no defaults of joints"


def robot_root(
    spec: mujoco.MjSpec, model: mujoco.MjModel, *, trunk: str | None, joints: Iterable[str], where: str
) -> str | None:
    """Choose the body of the world whose tree is the robot.

    Args:
        spec: A model with names for all bodies.
        model: The same, compiled.
        trunk: Name of a body of the robot, if a description gives one.
        joints: Joints of the robot, if a description gives some.
        where: Prefix of messages.

    Returns:
        Name of the body. None if nothing floats freely and the description does not identify it.

    Raises:
        LevadeError: If several bodies float freely, and neither the description nor their legs identify the robot.
    """
    roots = list(spec.worldbody.bodies)
    told = {trunk} if trunk is not None else set()
    told |= {joint.parent.name for joint in spec.joints if joint.name in set(joints)}
    chosen = [root.name for root in roots if told & {body.name for body in _tree(root)}]
    if len(chosen) == 1:
        return chosen[0]
    free = [root.name for root in roots if _floats(root)]
    if len(free) == 1 and (_articulated(spec.body(free[0])) or not any(_articulated(root) for root in roots)):
        return free[0]
    jointed = [name for name in free if _articulated(spec.body(name))]
    mammals = [name for name in jointed if has_legs(model, model.body(name).id)]
    legged = mammals or [name for name in jointed if stands(model, model.body(name).id)]
    for candidates in (legged, jointed):
        if len(candidates) == 1:
            return candidates[0]
    if len(legged or jointed or free) > 1 and not (free and not jointed and any(_articulated(r) for r in roots)):
        raise LevadeError(
            f"{where}: {len(free)} bodies float freely ({some(free)}); name the robot's in a robot.yaml (trunk: NAME)"
        )
    return None


def leave_only(spec: mujoco.MjSpec, root: str | None, findings: list[Finding]) -> None:
    """Delete everything in the world except the robot, and whatever ties the robot to it.

    Args:
        spec: A model with names for all bodies; it is changed.
        root: Name of the robot's outermost body; None to keep every tree that has joints.
        findings: Notes about what is left out, and warnings about ties, are added here.
    """
    world = spec.worldbody
    trees = [body for body in world.bodies if any(_moves(child) for child in body.bodies)]
    kept = {root} if root is not None else {body.name for body in trees or filter(_moves, world.bodies)}
    gone = [body for body in world.bodies if body.name not in kept]
    outside = {"world", *(body.name for top in gone for body in _tree(top))}
    _cut_ties(spec, outside, findings)
    if world.geoms:
        geoms = counted(len(world.geoms), "geom")
        what = f"{geoms} of the world (floor, obstacles) {'is' if len(world.geoms) == 1 else 'are'} left out"
        findings.append(note("worldbody", what, "a task's scene says what the robot stands on"))
    for element in [*world.geoms, *world.sites, *spec.lights, *spec.cameras]:
        spec.delete(element)
    if gone:
        findings.append(
            note(named("body", [body.name for body in gone]), "of the world, left out: not part of the robot")
        )
    for body in gone:
        spec.delete(body)


def float_alone(spec: mujoco.MjSpec, findings: list[Finding]) -> None:
    """Remove what resists or carries a floating base from outside: resistances of its free joint, wind, gravcomp.

    Args:
        spec: The model; it is changed.
        findings: Warnings are added here.
    """
    for joint in spec.joints:
        if joint.type != _FREE:
            continue
        resisting = [name for name in _RESISTANCES if np.any(np.asarray(getattr(joint, name)))]
        for name in resisting:
            setattr(joint, name, np.zeros_like(np.asarray(getattr(joint, name))))
        if resisting:
            what = f"{', '.join(resisting)} would tie the floating base to the world: left out"
            findings.append(warning(f"joint {joint.name}", what, _DEFAULTS_REMEDY))
    option = spec.option
    medium = [name for name in ("density", "viscosity", "wind") if np.any(np.asarray(getattr(option, name)))]
    for name in medium:
        setattr(option, name, np.zeros(3) if name == "wind" else 0.0)
    if medium:
        what = "the drag of a medium is left out: levade simulates robots in still air"
        findings.append(warning(f"option {', '.join(medium)}", what, "remove it from the file"))
    floating = [body for body in spec.bodies[1:] if body.gravcomp]
    for body in floating:
        body.gravcomp = 0.0
    if floating:
        what = "gravity is compensated there, which no hardware does: the compensation is left out"
        remedy = 'remove gravcomp="..." from the file'
        findings.append(warning(named("body", [body.name for body in floating]), what, remedy))


def collide_as_paired(spec: mujoco.MjSpec, model: mujoco.MjModel, root: str | None, findings: list[Finding]) -> None:
    """Let shapes collide that touch the world only by a <pair>, since a scene's ground is not the one that the pair names.

    Args:
        spec: The model; it is changed.
        model: The same, compiled.
        root: Name of the robot's outermost body.
        findings: Notes are added here.
    """
    own = {body.name for body in (_tree(spec.body(root)) if root is not None else spec.bodies[1:])}
    of_world = {geom.name for geom in spec.geoms if geom.name and geom.parent.name not in own}
    paired: dict[str, int] = {}
    for i in range(model.npair):
        names = [model.geom(int(g)).name for g in (model.pair_geom1[i], model.pair_geom2[i])]
        for geom, other in (names, names[::-1]):
            if geom and other in of_world and geom not in of_world:
                paired.setdefault(geom, i)
    changed = []
    for name, i in paired.items():
        geom = spec.geom(name)
        if geom.contype or geom.conaffinity:
            continue
        geom.conaffinity = 1  # collides with the scene, whose contype has every bit, but not with the robot
        geom.condim = int(model.pair_dim[i])
        geom.friction = model.pair_friction[i][[0, 2, 3]]
        geom.solref, geom.solimp = model.pair_solref[i].copy(), model.pair_solimp[i].copy()
        geom.margin, geom.gap = float(model.pair_margin[i]), float(model.pair_gap[i])
        changed.append(name)
    if changed:
        what = "touches the world only by a <pair>: collides with the ground of every scene, with the pair's settings"
        findings.append(note(named("geom", changed), what))


def sides(spec: mujoco.MjSpec, equality: mujoco.MjsEquality) -> tuple[str, str]:
    """Name the bodies that a connect or weld holds together; "world" if it names none.

    Args:
        spec: The model.
        equality: The connect or weld.
    """
    names = []
    for name in (equality.name1, equality.name2):
        if name and equality.objtype == mujoco.mjtObj.mjOBJ_SITE:
            site = spec.site(name)
            names.append("world" if site is None else site.parent.name)
        else:
            names.append(name or "world")
    return names[0], names[1]


def tendon_bodies(tendon: mujoco.MjsTendon) -> set[str]:
    """Name the bodies over whose joints, sites or shapes a tendon runs.

    Args:
        tendon: The tendon.
    """
    found = set()
    for wrap in tendon.path:
        if wrap.type != mujoco.mjtWrap.mjWRAP_PULLEY and wrap.target is not None:
            found.add(wrap.target.parent.name)
    return found


def delete_tendons(spec: mujoco.MjSpec, tendons: list[mujoco.MjsTendon]) -> None:
    """Delete tendons, and the equalities that bind them.

    Args:
        spec: The model; it is changed.
        tendons: The tendons.
    """
    names = {tendon.name for tendon in tendons if tendon.name}
    of_tendons = mujoco.mjtEq.mjEQ_TENDON
    for equality in [e for e in spec.equalities if e.type == of_tendons and names & {e.name1, e.name2}]:
        spec.delete(equality)
    for tendon in tendons:
        spec.delete(tendon)


def label(equality: mujoco.MjsEquality, one: str, other: str) -> str:
    """Name a connect or weld between two bodies for messages.

    Args:
        equality: The connect or weld.
        one: Name of the first body.
        other: Name of the second body.
    """
    kind = mujoco.mjtEq(equality.type).name.removeprefix("mjEQ_").lower()
    return f"<{kind}> {f'{equality.name} ' if equality.name else ''}between {one} and {other}"


def _cut_ties(spec: mujoco.MjSpec, outside: set[str], findings: list[Finding]) -> None:
    """Delete elements with an end outside the robot; warn if the other end is the robot."""
    ties: list[str] = []
    joints = {joint.name for joint in spec.joints if joint.parent.name in outside}
    for equality in list(spec.equalities):
        if equality.type in _OF_BODIES:
            one, other = sides(spec, equality)
            out = {one, other} & outside
            if out and not {one, other} <= outside:
                ties.append(label(equality, one, other))
        else:
            out = equality.type == mujoco.mjtEq.mjEQ_JOINT and joints & {equality.name1, equality.name2}
        if out:
            spec.delete(equality)
    loose = []
    for tendon in spec.tendons:
        bodies = tendon_bodies(tendon)
        if bodies & outside:
            loose.append(tendon)
            if not bodies <= outside:
                ties.append(f"<tendon> {tendon.name}".rstrip())
    delete_tendons(spec, loose)
    if ties:
        what = f"{'tie' if len(ties) > 1 else 'ties'} the robot to the world: left out"
        findings.append(warning(some(ties), what, "levade moves robots that float freely; remove it from the file"))
    _delete_all(spec, spec.excludes, lambda e: {e.bodyname1, e.bodyname2} & (outside - {"world"}))
    geoms = {geom.name for geom in spec.geoms if geom.name and geom.parent.name in outside}
    _delete_all(spec, spec.pairs, lambda p: {p.geomname1, p.geomname2} & geoms)


def _delete_all(spec: mujoco.MjSpec, elements: Iterable, chosen: Callable) -> None:
    for element in [element for element in elements if chosen(element)]:
        spec.delete(element)


def _floats(body: mujoco.MjsBody) -> bool:
    return any(joint.type == _FREE for joint in body.joints)


def _articulated(body: mujoco.MjsBody) -> bool:
    """Tell whether anything below the body moves against it."""
    return any(_moves(child) for child in body.bodies)


def _moves(body: mujoco.MjsBody) -> bool:
    return bool(body.joints) or _articulated(body)


def _tree(body: mujoco.MjsBody) -> list[mujoco.MjsBody]:
    return [body, *body.find_all("body")]
