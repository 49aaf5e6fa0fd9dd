"""Anatomy: assign joints to legs, as the description names them or as the kinematics show. Hold everything else that moves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.robots.findings import named, note, some
from levade.robots.holding import Angle, Held, fix_joints
from levade.robots.limbs import limb_roles, read_limbs
from levade.robots.loops import Coupling, follower_angles, open_loops, open_tendons, why_no_legs
from levade.robots.reading import Draft, Keyframe
from levade.robots.standing import Bare
from levade.robots.understanding import FrameError, Leg, NoFootError, find_legs, find_trunk, level, roles
from levade.robots.visuals import thin_visuals

if TYPE_CHECKING:
    from levade.robots.description import RobotForm


@dataclass(frozen=True)
class Followers:
    """Describes the joints that follow others and are held.

    Attributes:
        couplings: Which joints they follow, and how.
        held: Joint -> pose of its body without the joint.
        first: Joint -> angle at which it is held at first [rad].
        still: Leader -> angle [rad], for leaders that are held, too.
        fuse: Whether the compiler should fuse fixed bodies once the followers are in place.
    """

    couplings: tuple[Coupling, ...]
    held: Mapping[str, Held]
    first: Mapping[str, float]
    still: Mapping[str, float]
    fuse: bool

    def angles(self, neutral: Mapping[str, float]) -> dict[str, float]:
        """Compute the followers' angles.

        Args:
            neutral: Joint -> angle in the neutral posture [rad], for the joints of the legs.

        Returns:
            Follower -> angle [rad].
        """
        return follower_angles(self.couplings, {**self.still, **neutral})


def understand(draft: Draft, path: Path, form: RobotForm) -> tuple[Bare, Followers]:
    """Find trunk and legs, as described or by the kinematics, and hold everything else that moves.

    Args:
        draft: The model; it is changed.
        path: Path of the description, for messages.
        form: The description.

    Returns:
        The bare robot, and its joints that follow others.

    Raises:
        LevadeError: If levade cannot move this robot.
    """
    from levade.robots.description import per_joint

    model = draft.compile()
    if not draft.urdf:  # of which the text is read again, with all meshes
        thin_visuals(draft, model)
    where = str(path)
    trunk = find_trunk(model, where)
    if form.trunk is not None and model.body(trunk).name != form.trunk:
        raise LevadeError(
            f"{path}: trunk: {form.trunk} does not float freely, {model.body(trunk).name} does; name that body"
        )
    free = int(model.body_jntadr[trunk])
    movable = [model.joint(j).name for j in range(model.njnt) if j != free]
    draft.joints = movable
    fixed = per_joint(form.fixed, movable, f"{path}: fixed", all_joints=False)
    draft.couplings = [c for c in draft.couplings if c.follower not in fixed]
    _check_followers(draft.couplings, path, form)
    still = {**_resting_leaders(draft, model), **fixed}
    followers = follower_angles(draft.couplings, still)
    fuse = bool(draft.spec.compiler.fusestatic)
    if followers:  # their bodies will be moved again
        draft.spec.compiler.fusestatic = False
    held = fix_joints(draft, {**fixed, **followers}, path) if fixed or followers else {}
    if held:
        draft.held_bodies = {joint: one.body for joint, one in held.items()}
        model = draft.compile()
        trunk = find_trunk(model, where)
    if fixed:
        draft.origins["fixed"] = f"{some(list(fixed))} (robot.yaml)"
    if form.legs:
        legs, others = _described_legs(model, trunk, path, form), []
        used = {joint for leg in legs for joint in leg.joints}
        for joint in movable:
            if joint not in used and joint not in held:
                raise LevadeError(
                    f"{path}: legs: joint {joint} of {form.model} is in no leg; add it to one, or give fixed: {{{joint}: 0}}"
                )
    else:
        legs, others = _found_legs(draft, model, trunk, where, {str(kind): how for kind, how in form.limbs.items()})
    draft.origins["legs"] = "robot.yaml" if form.legs else "found in the kinematics"
    joints = [joint for leg in legs for joint in leg.joints]
    draft.findings += open_loops(draft.loops, joints, {*held, *others}, draft.driven, where)
    draft.findings += open_tendons(draft.spec, joints, where)
    if others:
        frame = draft.keyframes[0] if draft.keyframes else None
        fix_joints(draft, {joint: _resting(model, joint, frame) for joint in others}, path)
        how = (
            f"as in keyframe {frame.name}".rstrip() if frame else "at zero, or at the end of the range that is nearest"
        )
        draft.findings.append(
            note(some(others), f"in no leg: held fixed {how}", "robot.yaml, fixed: {joint: angle} holds them elsewhere")
        )
        earlier = [draft.origins["fixed"]] if fixed else []
        draft.origins["fixed"] = ", ".join([*earlier, f"{some(others)} ({'keyframe' if frame else 'zero'})"])
    bare = bare_robot(draft, legs, where)
    return bare, Followers(tuple(draft.couplings), {joint: held[joint] for joint in followers}, followers, still, fuse)


def bare_robot(draft: Draft, legs: tuple[Leg, ...], where: str) -> Bare:
    """Compile the bare robot of a draft, in which everything outside the legs is already held.

    Args:
        draft: The model.
        legs: The legs.
        where: Prefix of messages.

    Returns:
        The bare robot.
    """
    model = draft.compile()
    ranges = {}
    for joint in (joint for leg in legs for joint in leg.joints):
        handle = model.joint(joint)
        limited = bool(handle.limited[0])
        # the digits of the XML text, which is what is simulated
        ranges[joint] = (
            (float(f"{handle.range[0]:.6g}"), float(f"{handle.range[1]:.6g}")) if limited else (-np.inf, np.inf)
        )
    return Bare(model, find_trunk(model, where), legs, ranges)


def _check_followers(couplings: Sequence[Coupling], path: Path, form: RobotForm) -> None:
    """Raise LevadeError if the description names a follower as a joint of a leg."""
    for coupling in couplings:
        if any(coupling.follower in leg.joints for leg in form.legs.values()):
            why = why_no_legs([], [coupling])
            raise LevadeError(f"{path}: legs: {why}; remove that from {form.model} if the joint has its own motor")


def _resting_leaders(draft: Draft, model: mujoco.MjModel) -> dict[str, float]:
    """Return the angles of joints that lead others, for use until the standing posture is known."""
    frame = draft.keyframes[0] if draft.keyframes else None
    followers = {coupling.follower for coupling in draft.couplings}
    leaders = {coupling.leader for coupling in draft.couplings} - followers - {""}
    angles = {joint: _resting(model, joint, frame) for joint in sorted(leaders)}
    return {joint: float(angle) for joint, angle in angles.items() if np.ndim(angle) == 0}


def _found_legs(
    draft: Draft, model: mujoco.MjModel, trunk: int, where: str, wanted: Mapping[str, str]
) -> tuple[tuple[Leg, ...], list[str]]:
    """Find the limbs by the kinematics, and the joints that belong to none.

    The four legs of a mammal are tried first, then limbs of any kind. A LevadeError names the likely reason.
    """
    try:
        legs, others = find_legs(model, trunk, where)
        if "free" in wanted.values():
            added = [
                limb
                for limb in read_limbs(model, trunk, where, wanted).legs
                if not limb.stands and set(limb.joints) <= set(others)
            ]
            if not added:
                draft.findings.append(
                    note("limbs", "none is freed: it has no such limb, or one that reaches as deep as a leg")
                )
            legs = (*legs, *added)
            others = [joint for joint in others if all(joint not in limb.joints for limb in added)]
        return legs, others
    except FrameError as error:
        raise LevadeError(str(error)) from None
    except LevadeError as error:
        problem = error
    lost = next((f.what for f in draft.findings if f.what.startswith("collides with nothing")), "")
    try:
        limbs = read_limbs(model, trunk, where, wanted)
    except NoFootError as error:  # usually because meshes are missing
        raise LevadeError(f"{error}{lost and f' ({lost})'}") from None
    bound = [coupling for coupling in draft.couplings if _in_leg(draft, limbs.legs, coupling)]
    if limbs.problem or bound:
        if isinstance(problem, NoFootError):
            raise LevadeError(f"{problem}{lost and f' ({lost})'}") from None
        reasons = [limbs.problem, why_no_legs(draft.loops, bound or draft.couplings)]
        more = [reason for reason in reasons if reason and reason not in str(problem)]
        raise LevadeError("; ".join([str(problem), *more])) from None
    if limbs.wheels:
        draft.findings.append(
            note(named("joint", limbs.wheels), "turns a wheel: locked" if len(limbs.wheels) == 1 else "turn wheels: locked",
                 "robot.yaml, limbs: {wheel: free} lets them turn")
        )  # fmt: skip
    return limbs.legs, list(limbs.held)


def _in_leg(draft: Draft, limbs: Sequence[Leg], coupling: Coupling) -> bool:
    """Tell whether the body of a held follower lies between the trunk and the end of a limb that moves."""
    body = draft.held_bodies.get(coupling.follower, "")
    for limb in limbs:
        inside = draft.spec.geom(limb.foot).parent if limb.stands else draft.spec.joint(limb.joints[-1]).parent
        while inside is not None and inside.name != "world":
            if inside.name == body:
                return True
            inside = inside.parent
    return False


def _resting(model: mujoco.MjModel, joint: str, frame: Keyframe | None) -> Angle:
    """Return the angle at which to hold a joint outside the legs: the keyframe's, otherwise the nearest to zero in range."""
    if frame is not None and joint in frame.angles:
        return frame.angles[joint]
    if frame is not None and joint in frame.balls:
        return frame.balls[joint]
    handle = model.joint(joint)
    scalar = int(handle.type[0]) != int(mujoco.mjtJoint.mjJNT_BALL)
    return float(np.clip(0.0, *handle.range)) if handle.limited[0] and scalar else 0.0


def _described_legs(model: mujoco.MjModel, trunk: int, path: Path, form: RobotForm) -> tuple[Leg, ...]:
    """Read the legs that the description names, and check them against the model."""
    joints = {model.joint(j).name: j for j in range(model.njnt)}
    geoms = [model.geom(g).name for g in range(model.ngeom)]
    used: set[str] = set()
    legs = []
    for name, leg in form.legs.items():
        where = f"{path}: legs.{name}.joints"
        for joint in leg.joints:
            if joint not in joints:
                raise LevadeError(f"{where}: no joint {joint!r} in {form.model}; {did_you_mean(joint, joints)}")
            if model.jnt_type[joints[joint]] != mujoco.mjtJoint.mjJNT_HINGE:
                raise LevadeError(f"{where}: joint {joint} should be a hinge")
            if joint in used:
                raise LevadeError(f"{where}: joint {joint} is listed twice; remove one")
            used.add(joint)
        bodies = [int(model.jnt_bodyid[joints[joint]]) for joint in leg.joints]
        for inner, outer, body, further in zip(leg.joints, leg.joints[1:], bodies, bodies[1:], strict=False):
            if body not in _ancestors(model, further):
                raise LevadeError(f"{where}: {inner} should be nearer to the trunk than {outer}")
        if trunk not in _ancestors(model, bodies[0]):
            raise LevadeError(f"{where}: {leg.joints[0]} does not hang on the trunk {model.body(trunk).name}")
        if leg.foot not in geoms:
            hint = did_you_mean(leg.foot, filter(None, geoms))
            raise LevadeError(f"{path}: legs.{name}.foot: no geom {leg.foot!r} in {form.model}; {hint}")
        ordered = tuple(leg.joints)
        named_roles = roles(model, ordered)
        if len(ordered) > 3 or not {"hfe", "kfe"} <= set(named_roles):
            data = mujoco.MjData(model)
            level(model, data, trunk)
            named_roles = limb_roles(model, data, ordered, data.geom(leg.foot).xpos)
        legs.append(Leg(name, ordered, leg.foot, leg.side, leg.end, named_roles))
    return tuple(legs)


def _ancestors(model: mujoco.MjModel, body: int) -> set[int]:
    """Return the ids of the bodies between this one and the world, excluding both."""
    found = set()
    while (body := int(model.body_parentid[body])) != 0:
        found.add(body)
    return found
