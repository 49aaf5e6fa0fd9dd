"""Loading: make a `Robot` from a name, an MJCF, a URDF or a robot.yaml.

A process reads a built-in robot only once: commands load a robot more than once, and reading its meshes takes seconds.
"""

from __future__ import annotations

import copy
import os
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from levade.arrays import Array
from levade.document import hides
from levade.embodiment import JointLimits, TorqueCurve
from levade.errors import LevadeError, MissingPackage, did_you_mean
from levade.robots.actuation import DCMotor
from levade.robots.anatomy import understand
from levade.robots.driving import SERVO, find_actuation, find_limits
from levade.robots.files import is_model, is_other_text
from levade.robots.inertias import survive_text
from levade.robots.packages import find_package_robot, package_robots
from levade.robots.posing import pose
from levade.robots.preparing import (
    add_rotors,
    exclude_overlaps,
    float_freely,
    lift_joint_limits,
    lighten,
    set_armature,
    support_servos,
)
from levade.robots.reading import Draft, read_model
from levade.robots.robot import Robot
from levade.robots.standing import Bare
from levade.robots.visuals import thin_visuals

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

_BUILT_IN = Path(__file__).parent / "data"
_MODELS = (".xml", ".urdf", ".mjcf")

_READ: dict[tuple[object, ...], Robot] = {}
"""What distinguishes built-in robots -> the robot. Callers get a copy, whose arrays they may change."""


def builtin_robots() -> list[tuple[str, str]]:
    """List the built-in robots.

    Returns:
        Name and description of each robot, sorted by name.
    """
    from levade.robots.description import read_description

    return [(name, read_description(path).description) for name, path in _built_in().items()]


def missing_package(name_or_path: str | Path) -> str | None:
    """Tell which package a robot needs that is not installed. Its model is not read.

    Args:
        name_or_path: Name or path, as in `load_robot`.

    Returns:
        What is missing, and how to get it, in one line; None if no package is missing.

    Raises:
        LevadeError: If the robot is unknown, or its description cannot be read.
    """
    try:
        find_package_robot(_describe(_find(str(name_or_path))).model)
    except MissingPackage as missing:
        return str(missing)
    return None


def load_robot(
    name_or_path: str | Path,
    *,
    actuation: str | None = None,
    variant: str | None = None,
    linkage: bool = False,
    kp: float | None = None,
    kd: float | None = None,
) -> Robot:
    """Load a robot.

    What a robot.yaml leaves out is derived from the model. Without a robot.yaml, everything is. ``Robot.findings`` says what
    was derived, and how.

    Args:
        name_or_path: Name of a built-in robot; ``package:robot`` for a robot of an installed package; or the path of an MJCF,
            URDF or robot.yaml, or of a folder that holds one.
        actuation: Name of an actuation in the description. Defaults to its default actuation.
        variant: Name of a variant in the description. Defaults to the plain model.
        linkage: Whether to lower the torque limits by the linkage's curves.
        kp: Stiffness for all joints [Nm/rad]. Defaults to the description's.
        kd: Damping for all joints [Nm s/rad]. Defaults to the description's.

    Raises:
        LevadeError: If the robot is unknown, or its files cannot be read or understood.
    """
    path = _find(str(name_or_path))
    form = _describe(path)
    if hides(form.name):
        raise LevadeError(f"{path}: its name holds control characters, which no terminal can show; rename it")
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

    place = find_package_robot(form.model) or path.parent / form.model
    if not place.is_file():
        raise LevadeError(f"{path}: model: no file {place}")
    if not path.is_relative_to(_BUILT_IN):
        return _read(path, form, place, actuation, variant, linkage, kp, kd)
    key = path, place, actuation, variant, linkage, kp, kd
    if key not in _READ:
        _READ[key] = _read(path, form, place, actuation, variant, linkage, kp, kd)
    return copy.deepcopy(_READ[key])


def _read(
    path: Path,
    form: RobotForm,
    place: Path,
    actuation: str | None,
    variant: str | None,
    linkage: bool,
    kp: float | None,
    kd: float | None,
) -> Robot:
    """Make the robot of a description from the model in the file ``place``. The arguments are those of `load_robot`."""
    draft = read_model(place, trunk=form.trunk, joints=[joint for leg in form.legs.values() for joint in leg.joints])
    if form.trunk is not None:
        float_freely(draft, form.trunk, path)
    if variant is not None:
        _apply_variant(draft, path, form, variant)
    bare, followers = understand(draft, path, form)
    drives = find_limits(draft, bare, path, form, actuation or form.actuation)
    _set_rotors(draft, bare, path, form, drives.torque)
    bare, postures = pose(draft, bare, followers, path, form, drives.torque)
    joints = bare.joints
    ranges = np.array([bare.ranges[joint] for joint in joints])
    neutral = dict(zip(joints, postures["neutral"].tolist(), strict=True))
    curves = _curves(joints, path, form)
    limits = JointLimits(
        lower=ranges[:, 0],
        upper=ranges[:, 1],
        velocity=drives.velocity,
        torque=drives.torque,
        torque_curves=curves if linkage else {},
        assumed_velocity=drives.assumed_velocity,
        assumed_torque=drives.assumed_torque,
    )
    chosen = find_actuation(actuation or form.actuation, draft, bare, path, form, neutral, limits, kp, kd)
    if isinstance(chosen, DCMotor):
        limits = replace(limits, stall_torque=chosen.stall_torque, no_load_speed=chosen.no_load_speed)
    lift_joint_limits(draft, bare, chosen)
    exclude_overlaps(draft, bare, neutral)
    if draft.urdf:
        support_servos(draft, bare, neutral, chosen)
    thin_visuals(draft, bare.model)
    lighten(draft)
    mjcf, model = survive_text(draft)
    return Robot(
        name=form.name,
        mjcf=mjcf,
        assets=draft.assets,
        trunk=model.body(bare.trunk).name,
        legs=bare.legs,
        limits=limits,
        actuation=chosen,
        postures=postures,
        description=form.description,
        variant=variant,
        linkage=linkage,
        curves=curves,
        source=str(path),
        findings=tuple(draft.findings),
        origins=draft.origins,
        held={joint: draft.held[joint] for joint in [*draft.joints, *draft.held] if joint in draft.held},
        model_joints=tuple(draft.joints),
    )


def _built_in() -> dict[str, Path]:
    return {path.parent.name: path for path in sorted(_BUILT_IN.glob("*/robot.yaml"))}


def _find(name_or_path: str) -> Path:
    path, built_in = Path(name_or_path), _built_in()
    if name_or_path in built_in:
        return built_in[name_or_path]
    if os.path.isdir(path):
        path = path / "robot.yaml"
    if os.path.isfile(path):
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
    """Read the description at a path. For a model, use the robot.yaml next to it that describes it, or a bare description."""
    from levade.robots.description import RobotForm, read_description

    if path.is_relative_to(_BUILT_IN) and path.name == "robot.yaml":
        return _describe_built_in(path)
    if path.suffix.lower() not in _MODELS and not is_model(path):
        try:
            return read_description(path)
        except LevadeError:
            if path.suffix.lower() in (".yaml", ".yml") or not is_other_text(path):
                raise
            raise LevadeError(f"{path}: is no URDF, MJCF or robot.yaml; give one of them") from None
    beside = path.with_name("robot.yaml")
    if beside.is_file() and not is_model(beside):
        form = read_description(beside)
        if Path(form.model).name == path.name:
            return form
    return RobotForm(name=path.stem, model=path.name)


@cache
def _describe_built_in(path: Path) -> RobotForm:
    from levade.robots.description import read_description

    return read_description(path)


def _apply_variant(draft: Draft, path: Path, form: RobotForm, variant: str) -> None:
    """Replace the inertials that the variant names."""
    spec, model = draft.spec, draft.compile()
    bodies = [body.name for body in spec.bodies][1:]
    for name, inertial in form.variants[variant].inertials.items():
        if name not in bodies:
            where = f"{path}: variants.{variant}.inertials"
            raise LevadeError(f"{where}: no body {name!r} in {form.model}; {did_you_mean(name, bodies)}")
        body = spec.body(name)
        # where mass and inertia come from the geoms, make them explicit before replacing a part
        if not body.explicitinertial:
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


def _set_rotors(draft: Draft, bare: Bare, path: Path, form: RobotForm, torque: Array) -> None:
    """Set the rotor inertia that the description gives. Where it leaves the drives to levade, assume what the model lacks."""
    from levade.robots.description import per_joint

    if form.armature:
        set_armature(draft, bare, per_joint(form.armature, bare.joints, f"{path}: armature", all_joints=False))
    if not form.actuations:
        add_rotors(draft, bare, torque)


def _curves(joints: tuple[str, ...], path: Path, form: RobotForm) -> dict[int, TorqueCurve]:
    from levade.robots.description import per_joint

    curves = per_joint(form.linkage, joints, f"{path}: linkage", all_joints=False)
    return {joints.index(joint): TorqueCurve(c.peak, c.rate, c.centre) for joint, c in curves.items()}
