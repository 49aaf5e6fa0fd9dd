"""Loading: from a name, an MJCF, a URDF or a robot.yaml to a `Robot`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.robots.actuation import DCMotor
from levade.robots.driving import SERVO, find_actuation, find_limits
from levade.robots.findings import note, some
from levade.robots.packages import find_package_robot, package_robots
from levade.robots.preparing import (
    exclude_overlaps,
    fix_joints,
    float_freely,
    lift_joint_limits,
    lighten,
    support_servos,
)
from levade.robots.reading import Draft, Keyframe, read_model
from levade.robots.robot import Robot
from levade.robots.standing import (
    CROUCHED_EXTENSION,
    NEUTRAL_EXTENSION,
    STRETCHED_EXTENSION,
    Bare,
    neutral_from,
)
from levade.robots.understanding import Leg, NoFootError, find_legs, find_trunk, roles
from levade.robots.visuals import thin_visuals
from levade.trajectory import Array, JointLimits, TorqueCurve

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

_BUILT_IN = Path(__file__).parent / "data"
_MODELS = (".xml", ".urdf", ".mjcf")


def builtin_robots() -> list[tuple[str, str]]:
    """(name, description) of every built-in robot, by name."""
    from levade.robots.description import read_description

    return [(name, read_description(path).description) for name, path in _built_in().items()]


def load_robot(
    name_or_path: str | Path,
    *,
    actuation: str | None = None,
    variant: str | None = None,
    linkage: bool = False,
    kp: float | None = None,
    kd: float | None = None,
) -> Robot:
    """A built-in robot by name, one of an installed package by ``package:robot``, or any robot by the path of its MJCF,
    URDF or robot.yaml (or of the folder that holds one).

    What a robot.yaml leaves out is derived from the model, and for a model alone everything is; ``Robot.findings`` says
    what and how. actuation, variant: names from the description; the default actuation and the plain model if left out.
    linkage: lower the torque limits by the linkage's curves. kp [Nm/rad], kd [Nm s/rad]: for all joints, instead of the
    description's. Raises `LevadeError`.
    """
    path = _find(str(name_or_path))
    form = _describe(path)
    valid_actuations = list(form.actuations) or [SERVO]
    for value, key, valid in (
        (actuation or form.actuation, "actuation", valid_actuations),
        (variant, "variant", form.variants),
    ):
        if value is not None and value not in valid:
            hint = did_you_mean(value, valid) if valid else "it has none"
            raise LevadeError(f"{path}: {key}: no {key} {value!r}; {hint}")
    for value, key in ((kp, "kp"), (kd, "kd")):
        if value is not None and not (np.isfinite(value) and value >= 0):
            raise LevadeError(f"robot {form.name}: {key} should be a number that is not negative, is {value}")
    if linkage and not form.linkage:
        raise LevadeError(
            f"{path}: linkage: asked for, but the description has none; give the joints' torque curves there"
        )

    place = path.parent / form.model
    if not place.is_file():
        raise LevadeError(f"{path}: model: no file {place}")
    draft = read_model(
        place, trunk=form.trunk, joints=[joint for leg in form.legs.values() for joint in leg.joints]
    )
    if form.trunk is not None:
        float_freely(draft, form.trunk, path)
    if variant is not None:
        _apply_variant(draft, path, form, variant)
    bare = _understand(draft, path, form)
    torque, velocity = find_limits(draft, bare, path, form)
    postures = _postures(draft, bare, path, form, torque)
    joints = bare.joints
    ranges = np.array([bare.ranges[joint] for joint in joints])
    neutral = dict(zip(joints, postures["neutral"].tolist(), strict=True))
    limits = JointLimits(ranges[:, 0], ranges[:, 1], velocity, torque, _curves(joints, path, form) if linkage else {})
    chosen = find_actuation(actuation or form.actuation, draft, bare, path, form, neutral, limits, kp, kd)
    if isinstance(chosen, DCMotor):
        limits = replace(limits, stall_torque=chosen.stall_torque, no_load_speed=chosen.no_load_speed)
    lift_joint_limits(draft, bare, chosen)
    exclude_overlaps(draft, bare, neutral)
    if draft.urdf:
        support_servos(draft, bare, neutral, chosen)
    thin_visuals(draft, bare.model)
    lighten(draft)
    model = draft.compile()
    return Robot(
        name=form.name,
        mjcf=draft.spec.to_xml(),
        assets=draft.assets,
        trunk=model.body(bare.trunk).name,
        legs=bare.legs,
        limits=limits,
        actuation=chosen,
        postures=postures,
        description=form.description,
        variant=variant,
        linkage=linkage,
        source=str(path),
        findings=tuple(draft.findings),
        origins=draft.origins,
    )


def _built_in() -> dict[str, Path]:
    return {path.parent.name: path for path in sorted(_BUILT_IN.glob("*/robot.yaml"))}


def _find(name_or_path: str) -> Path:
    path, built_in = Path(name_or_path), _built_in()
    if name_or_path in built_in:
        return built_in[name_or_path]
    if path.is_dir():
        path = path / "robot.yaml"
    if path.is_file():
        return path
    packaged = find_package_robot(name_or_path)
    if packaged is not None:
        return packaged
    if path.suffix in (".yaml", ".yml", *_MODELS) or "/" in name_or_path or "\\" in name_or_path:
        raise LevadeError(f"{path}: no such file; give a built-in robot, or the path of an MJCF, URDF or robot.yaml")
    near = did_you_mean(name_or_path, package_robots()) if ":" in name_or_path else ""
    hint = near if near.startswith("did you mean") else did_you_mean(name_or_path, built_in)
    raise LevadeError(f"no robot {name_or_path!r}; {hint} (or the path of an MJCF, URDF or robot.yaml)")


def _describe(path: Path) -> RobotForm:
    """The description at a path; for a model, the robot.yaml beside it that describes it, or else a bare one."""
    from levade.robots.description import RobotForm, read_description

    if path.suffix.lower() not in _MODELS:
        return read_description(path)
    beside = path.with_name("robot.yaml")
    if beside.is_file():
        form = read_description(beside)
        if Path(form.model).name == path.name:
            return form
    return RobotForm(name=path.stem, model=path.name)


def _understand(draft: Draft, path: Path, form: RobotForm) -> Bare:
    """Trunk and legs, as described or found; whatever else moves is fixed."""
    from levade.robots.description import per_joint

    model = draft.compile()
    where = str(path)
    trunk = find_trunk(model, where)
    if form.trunk is not None and model.body(trunk).name != form.trunk:
        raise LevadeError(
            f"{path}: trunk: {form.trunk} is not the body that floats freely, {model.body(trunk).name} is"
        )
    free = int(model.body_jntadr[trunk])
    movable = [model.joint(j).name for j in range(model.njnt) if j != free]
    fixed = per_joint(form.fixed, movable, f"{path}: fixed", all_joints=False)
    if fixed:
        fix_joints(draft, fixed, path)
        model = draft.compile()
        trunk = find_trunk(model, where)
        draft.origins["fixed"] = f"{some(list(fixed))} (robot.yaml)"
    if form.legs:
        legs, others = _described_legs(model, trunk, path, form), []
        used = {joint for leg in legs for joint in leg.joints}
        for joint in movable:
            if joint not in used and joint not in fixed:
                raise LevadeError(
                    f"{path}: legs: joint {joint} of {form.model} is in no leg; add it to one, or: fixed: {{{joint}: 0}}"
                )
    else:
        try:
            legs, others = find_legs(model, trunk, where)
        except NoFootError as error:  # most often since its meshes are not there
            lost = next((f.what for f in draft.findings if f.what.startswith("collides with nothing")), "")
            raise LevadeError(f"{error}{lost and f' ({lost})'}") from None
    draft.origins["legs"] = "robot.yaml" if form.legs else "found in the kinematics"
    if others:
        frame = draft.keyframes[0] if draft.keyframes else None
        fix_joints(draft, {joint: _resting(model, joint, frame) for joint in others}, path)
        model = draft.compile()
        trunk = find_trunk(model, where)
        how = (
            f"as in keyframe {frame.name}".rstrip() if frame else "at zero, or at the end of the range that is nearest"
        )
        draft.findings.append(
            note(some(others), f"in no leg: held fixed {how}", "robot.yaml, fixed: {joint: angle} holds them elsewhere")
        )
        earlier = [draft.origins["fixed"]] if fixed else []
        draft.origins["fixed"] = ", ".join([*earlier, f"{some(others)} ({'keyframe' if frame else 'zero'})"])
    ranges = {}
    for joint in (joint for leg in legs for joint in leg.joints):
        handle = model.joint(joint)
        limited = bool(handle.limited[0])
        # the digits of the XML text, which is what is simulated
        ranges[joint] = (
            (float(f"{handle.range[0]:.6g}"), float(f"{handle.range[1]:.6g}")) if limited else (-np.inf, np.inf)
        )
    return Bare(model, trunk, legs, ranges)


def _resting(model: mujoco.MjModel, joint: str, frame: Keyframe | None) -> float:
    """Where a joint of no leg is held: as in the keyframe, else at zero, or as near to it as its range allows."""
    if frame is not None and joint in frame.angles:
        return frame.angles[joint]
    handle = model.joint(joint)
    return float(np.clip(0.0, *handle.range)) if handle.limited[0] else 0.0


def _described_legs(model: mujoco.MjModel, trunk: int, path: Path, form: RobotForm) -> tuple[Leg, ...]:
    """The legs that the description names, checked against the model."""
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
                raise LevadeError(f"{where}: joint {joint} is there twice")
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
        legs.append(Leg(name, ordered, leg.foot, leg.side, leg.end, roles(model, ordered)))
    return tuple(legs)


def _ancestors(model: mujoco.MjModel, body: int) -> set[int]:
    """Ids of the bodies between this one and the world, without either."""
    found = set()
    while (body := int(model.body_parentid[body])) != 0:
        found.add(body)
    return found


def _apply_variant(draft: Draft, path: Path, form: RobotForm, variant: str) -> None:
    """Replace the inertials that the variant names."""
    spec, model = draft.spec, draft.compile()
    bodies = [body.name for body in spec.bodies][1:]
    for name, inertial in form.variants[variant].inertials.items():
        if name not in bodies:
            where = f"{path}: variants.{variant}.inertials"
            raise LevadeError(f"{where}: no body {name!r} in {form.model}; {did_you_mean(name, bodies)}")
        body = spec.body(name)
        if not body.explicitinertial:  # mass and inertia come from the geoms: write them down before replacing a part
            compiled = model.body(name)
            body.explicitinertial = True
            body.mass, body.ipos = float(compiled.mass[0]), compiled.ipos
            body.iquat, body.inertia = compiled.iquat, compiled.inertia
        if inertial.mass is not None:
            body.mass = inertial.mass
        if inertial.com is not None:
            body.ipos = inertial.com
        if inertial.inertia is not None:
            body.fullinertia = inertial.inertia
            body.iquat = [1.0, 0.0, 0.0, 0.0]


def _curves(joints: tuple[str, ...], path: Path, form: RobotForm) -> dict[int, TorqueCurve]:
    from levade.robots.description import per_joint

    curves = per_joint(form.linkage, joints, f"{path}: linkage", all_joints=False)
    return {joints.index(joint): TorqueCurve(c.peak, c.rate, c.centre) for joint, c in curves.items()}


def _postures(draft: Draft, bare: Bare, path: Path, form: RobotForm, torque: Array) -> dict[str, Array]:
    """The description's postures, and those that every robot has: neutral, crouched, stretched."""
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
    understood = all({"hfe", "kfe"} <= set(leg.roles) for leg in bare.legs)
    draft.origins["neutral"] = "robot.yaml"
    if "neutral" not in postures:
        if not understood:
            raise LevadeError(f"{path}: postures: neutral is missing; give the angles of the standing robot")
        found = _neutral(draft, bare, path, torque)
        postures = {"neutral": np.array([found[joint] for joint in joints]), **postures}
    for name, extension in (("crouched", CROUCHED_EXTENSION), ("stretched", STRETCHED_EXTENSION)):
        derived = bare.posture(extension) if understood and name not in postures else None
        if derived is not None:
            postures[name] = np.array([derived[joint] for joint in joints])
    return postures


def _neutral(draft: Draft, bare: Bare, path: Path, torque: Array) -> dict[str, float]:
    keyframe = neutral_from(bare, draft.keyframes)
    if keyframe is not None:
        angles, name = keyframe
        draft.origins["neutral"] = f"keyframe {name or 'without a name'} of the model"
        draft.findings.append(note("posture neutral", f"is {draft.origins['neutral']}"))
        return angles
    reachable = None
    for extension in NEUTRAL_EXTENSION:
        angles = bare.posture(extension)
        if angles is None:
            continue
        reachable = angles, extension  # at last the straightest, which is the easiest to hold
        needed = bare.static_torque(angles)
        if all(abs(needed[joint]) <= limit for joint, limit in zip(bare.joints, torque, strict=True)):
            break
    else:
        if reachable is None:
            raise LevadeError(
                f"{path}: no standing posture within the joints' ranges has the feet under the hips; give one:"
                " robot.yaml, postures: {neutral: {joint: angle}}"
            )
        angles, extension = reachable
    draft.origins["neutral"] = f"found by search: feet under the hips, {extension:.0%} of the leg's length below"
    draft.findings.append(note("posture neutral", draft.origins["neutral"]))
    return angles
