"""Posing: find the postures that every robot has, in its description, in a keyframe of its model, or by search.

A process searches only once for the same model: commands load a robot more than once.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.patience import Patience
from levade.robots.anatomy import Followers, bare_robot
from levade.robots.findings import named, note
from levade.robots.holding import hold_elsewhere
from levade.robots.loops import say_followers
from levade.robots.neutral import CROUCHED, PostureSearch
from levade.robots.reading import Draft
from levade.robots.standing import CROUCHED_EXTENSION, NEUTRAL_EXTENSION, STRETCHED_EXTENSION, Bare, neutral_from

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

_ROUNDS = 20
"""Most iterations that bring followers and neutral posture into agreement; each depends on the other."""
_SETTLED = 1e-6  # rad

_FOUND: dict[str, tuple[Array, str]] = {}
"""Checksum of what a search depends on -> the angles that it found, and why the robot cannot stand there, if it cannot."""


def pose(
    draft: Draft, bare: Bare, followers: Followers, path: Path, form: RobotForm, torque: Array
) -> tuple[Bare, dict[str, Array]]:
    """Find the postures, and hold followers where the neutral one puts them.

    Args:
        draft: The model; bodies of followers are moved.
        bare: The bare robot of the same model.
        followers: The joints that follow others.
        path: Path of the description, for messages.
        form: The description.
        torque: Torque limits [Nm], shape (joints,).

    Returns:
        The bare robot with its followers in place, and name -> angles [rad], shape (joints,).

    Raises:
        LevadeError: If a posture is out of range, or no neutral posture is found.
    """
    findings, origins = list(draft.findings), dict(draft.origins)
    angles = dict(followers.first)
    for _ in range(_ROUNDS):
        draft.findings, draft.origins = list(findings), dict(origins)
        postures = _postures(draft, bare, path, form, torque)
        neutral = dict(zip(bare.joints, postures["neutral"].tolist(), strict=True))
        before, angles = angles, followers.angles(neutral)
        if all(abs(angle - before[joint]) < _SETTLED for joint, angle in angles.items()):
            draft.spec.compiler.fusestatic = followers.fuse
            draft.findings += say_followers(followers.couplings, angles, bare.joints)
            return bare, postures
        for joint, angle in angles.items():
            hold_elsewhere(draft, joint, followers.held[joint], angle)
        bare = bare_robot(draft, bare.legs, str(path))
    names = named("joint", sorted(angles))
    raise LevadeError(f"{path}: {names} follow others, and no standing posture agrees with that; fix them: robot.yaml,"
                      " fixed: {joint: angle}")  # fmt: skip


def _postures(draft: Draft, bare: Bare, path: Path, form: RobotForm, torque: Array) -> dict[str, Array]:
    """Return the description's postures, and those that every robot has: neutral, crouched, stretched."""
    from levade.robots.description import joint_array

    joints = bare.joints
    postures: dict[str, Array] = {}
    for name, table in form.postures.items():
        angles = postures[name] = joint_array(table, joints, f"{path}: postures.{name}")
        for joint, angle in zip(joints, angles, strict=True):
            lower, upper = bare.ranges[joint]
            if not lower <= angle <= upper:
                where = f"{path}: postures.{name}: {joint} = {angle:g} rad"
                raise LevadeError(f"{where} is outside its range {lower:.4g} .. {upper:.4g} rad")
    draft.origins["neutral"] = "robot.yaml"
    if "neutral" not in postures:
        found = _neutral(draft, bare, path, form.name, torque)
        postures = {"neutral": np.array([found[joint] for joint in joints]), **postures}
    for name, angles in _derived(bare, form.name, torque, postures).items():
        postures[name] = np.array([angles[joint] for joint in joints])
    return postures


def _derived(bare: Bare, robot: str, torque: Array, postures: Mapping[str, Array]) -> dict[str, dict[str, float]]:
    """Derive the crouched and the stretched posture, if they exist and the description does not give them."""
    wanted = {"crouched": CROUCHED_EXTENSION, "stretched": STRETCHED_EXTENSION}
    missing = {name: extension for name, extension in wanted.items() if name not in postures}
    if bare.columnar:
        found = {name: bare.posture(extension) for name, extension in missing.items()}
        neutral = dict(zip(bare.joints, postures["neutral"].tolist(), strict=True))
        return {name: {**neutral, **angles} for name, angles in found.items() if angles is not None}
    patience = Patience(
        f"searching for the postures {' and '.join(missing)} of {robot}; its robot.yaml can give them, which spares this"
    )
    search, neutral = PostureSearch(bare, torque, during=patience.check), postures["neutral"]
    derived: dict[str, Array] = {}
    if "crouched" in missing:
        crouched, fault = _once(
            search, torque, ("crouched", neutral), lambda: search.standing(neutral, CROUCHED * search.extension())
        )
        derived |= {} if fault else {"crouched": crouched}
    if "stretched" in missing and len(bare.standing) == 2:
        derived["stretched"], _ = _once(search, torque, ("stretched", neutral), lambda: search.tiptoe(neutral))
    return {name: dict(zip(bare.joints, angles.tolist(), strict=True)) for name, angles in derived.items()}


def _neutral(draft: Draft, bare: Bare, path: Path, robot: str, torque: Array) -> dict[str, float]:
    keyframe = neutral_from(bare, draft.keyframes)
    if keyframe is not None:
        angles, name = keyframe
        draft.origins["neutral"] = f"keyframe {name or 'without a name'} of the model"
        draft.findings.append(note("posture neutral", f"is {draft.origins['neutral']}"))
        return angles
    if not bare.columnar:
        return _searched(draft, bare, path, robot, torque)
    reachable = None
    for extension in NEUTRAL_EXTENSION:
        angles = bare.posture(extension)
        if angles is None:
            continue
        angles |= {joint: bare.resting(joint) for joint in bare.joints if joint not in angles}
        reachable = angles, extension  # finally the straightest, which is the easiest to hold
        needed = bare.static_torque(angles)
        if all(abs(needed[joint]) <= limit for joint, limit in zip(bare.joints, torque, strict=True)):
            break
    else:
        if reachable is None and _upside_down(bare):
            raise LevadeError(f"{path}: its feet are above its hips: it seems that -z is up there; turn the model")
        if reachable is None:
            raise LevadeError(
                f"{path}: no standing posture within the joints' ranges has the feet under the hips; give one:"
                " robot.yaml, postures: {neutral: {joint: angle}}"
            )
        angles, extension = reachable
    draft.origins["neutral"] = f"found by search: feet under the hips, {extension:.0%} of the leg's length below"
    draft.findings.append(note("posture neutral", draft.origins["neutral"]))
    return angles


def _searched(draft: Draft, bare: Bare, path: Path, robot: str, torque: Array) -> dict[str, float]:
    patience = Patience(
        f"searching for a posture in which {robot} stands; a keyframe of its model, or postures: neutral in its robot.yaml,"
        " spares this"
    )
    search = PostureSearch(bare, torque, during=patience.check)
    angles, fault = _once(search, torque, ("neutral",), search.neutral)
    if fault:
        raise LevadeError(
            f"{path}: no standing posture was found: {fault}; give one: robot.yaml, postures: {{neutral: {{joint: angle}}}}"
        )
    draft.origins["neutral"] = "found by search: balanced, soles level, clear of the ends of the ranges"
    draft.findings.append(note("posture neutral", draft.origins["neutral"]))
    return dict(zip(bare.joints, angles.tolist(), strict=True))


def _once(
    search: PostureSearch, torque: Array, what: tuple[str | Array, ...], find: Callable[[], Array]
) -> tuple[Array, str]:
    """Search for a posture, unless this was done before in this process.

    Args:
        search: The search, which knows the robot.
        torque: Torque limits [Nm], shape (joints,).
        what: What distinguishes this posture from others of the robot.
        find: Makes the search.

    Returns:
        Its angles [rad], shape (joints,), and why the robot cannot stand there; "" if it can.
    """
    bare = search.bare
    model = np.empty(mujoco.mj_sizeModel(bare.model), dtype=np.uint8)
    mujoco.mj_saveModel(bare.model, None, model)
    named = [one if isinstance(one, str) else one.tolist() for one in what]
    of = repr((bare.trunk, bare.legs, dict(bare.ranges), torque.tolist(), named))
    key = hashlib.sha256(model.tobytes() + of.encode()).hexdigest()
    if key not in _FOUND:
        angles = find()
        _FOUND[key] = angles.copy(), next(iter(search.faults(angles)), "")
    angles, fault = _FOUND[key]
    return angles.copy(), fault


def _upside_down(bare: Bare) -> bool:
    """Tell whether every foot is above its hip when the joints are in the middle of their ranges."""
    middle = {joint: float(np.mean(limits)) for joint, limits in bare.ranges.items() if np.isfinite(limits).all()}
    data = bare.data_at(middle)
    return all(bare.tip(data, leg)[2] > data.joint(leg.joints[0]).xanchor[2] for leg in bare.standing)
