"""Loading: from the name of a built-in robot, or the path of a robot.yaml, to a `Robot`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from levade.errors import LevadeError, did_you_mean
from levade.robots.actuation import PID, Actuation, DCMotor
from levade.robots.robot import Leg, Robot
from levade.trajectory import Array, JointLimits, TorqueCurve

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

_BUILT_IN = Path(__file__).parent / "data"


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
    """A built-in robot by name, or any robot by the path of its robot.yaml (or of the folder that holds one).

    actuation, variant: names from the description; the default actuation and the plain model if left out.
    linkage: lower the torque limits by the linkage's curves. kp [Nm/rad], kd [Nm s/rad]: for all joints, instead of the
    description's. Raises `LevadeError`.
    """
    from levade.robots.description import read_description

    path = _find(str(name_or_path))
    form = read_description(path)
    for value, key, valid in (
        (actuation or form.actuation, "actuation", form.actuations),
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

    legs = tuple(Leg(name, tuple(leg.joints), leg.foot, leg.side, leg.end) for name, leg in form.legs.items())
    spec, assets = _read_model(path, form.model)
    _check(spec, path, form, legs)
    _strip(spec, form)
    if variant is not None:
        _apply_variant(spec, path, form, variant)
    _compiled(spec, path, form)
    mjcf = spec.to_xml()
    model = mujoco.MjModel.from_xml_string(mjcf, assets)

    joints = [joint for leg in legs for joint in leg.joints]
    limits = _limits(model, joints, path, form, linkage)
    return Robot(
        name=form.name,
        mjcf=mjcf,
        assets=assets,
        trunk=form.trunk,
        legs=legs,
        limits=limits,
        actuation=_actuation(actuation or form.actuation, joints, path, form, limits.torque, kp, kd),
        postures=_postures(joints, path, form, limits),
        description=form.description,
        variant=variant,
        linkage=linkage,
        source=str(path),
    )


def _built_in() -> dict[str, Path]:
    return {path.parent.name: path for path in sorted(_BUILT_IN.glob("*/robot.yaml"))}


def _find(name_or_path: str) -> Path:
    path, built_in = Path(name_or_path), _built_in()
    if name_or_path in built_in:
        return built_in[name_or_path]
    if path.is_dir():
        path = path / "robot.yaml"
    if path.suffix in (".xml", ".urdf", ".mjcf"):
        raise LevadeError(
            f"{path}: a model alone does not say which joints make a leg; give the robot.yaml that names it"
        )
    if path.is_file():
        return path
    if path.suffix in (".yaml", ".yml") or "/" in name_or_path or "\\" in name_or_path:
        raise LevadeError(f"{path}: no such file; give a built-in robot or the path of a robot.yaml")
    raise LevadeError(
        f"no robot {name_or_path!r}; {did_you_mean(name_or_path, built_in)} (or the path of a robot.yaml)"
    )


def _read_model(description: Path, name: str) -> tuple[mujoco.MjSpec, dict[str, bytes]]:
    """The model's spec and the files it needs, which it then names by their bare, unique names."""
    path = description.parent / name
    if not path.is_file():
        raise LevadeError(f"{description}: model: no file {path}")
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise LevadeError(f"{path}: {_one_line(error)}") from None
    assets: dict[str, bytes] = {}
    places = {}
    for kind, folder in (("meshes", spec.meshdir), ("hfields", spec.meshdir), ("textures", spec.texturedir)):
        for element in getattr(spec, kind):
            if not element.file:
                continue
            place = path.parent / folder / element.file
            if not place.is_file():
                raise LevadeError(f"{path}: {kind}: no file {place}")
            element.name = element.name or Path(element.file).stem
            if place not in places:
                places[place] = place.name if place.name not in assets else f"{len(assets)}-{place.name}"
                assets[places[place]] = place.read_bytes()
            element.file = places[place]
    spec.meshdir = spec.texturedir = ""
    spec.assets = assets
    return spec, assets


def _check(spec: mujoco.MjSpec, path: Path, form: RobotForm, legs: tuple[Leg, ...]) -> None:
    """Check that the model has what the description names, where it should be, and no joint beside."""
    bodies = [body.name for body in spec.bodies]
    joints = {joint.name: joint for joint in spec.joints}
    geoms = [geom.name for geom in spec.geoms]
    if form.trunk not in bodies[1:]:
        raise LevadeError(
            f"{path}: trunk: no body {form.trunk!r} in {form.model}; {did_you_mean(form.trunk, bodies[1:])}"
        )
    used: set[str] = set()
    for leg in legs:
        for joint in leg.joints:
            where = f"{path}: legs.{leg.name}.joints"
            if joint not in joints:
                raise LevadeError(
                    f"{where}: no joint {joint!r} in {form.model}; {did_you_mean(joint, filter(None, joints))}"
                )
            if joints[joint].type != mujoco.mjtJoint.mjJNT_HINGE:
                raise LevadeError(f"{where}: joint {joint} should be a hinge")
            if joint in used:
                raise LevadeError(f"{where}: joint {joint} is there twice")
            used.add(joint)
        for inner, outer in zip(leg.joints, leg.joints[1:], strict=False):
            if joints[inner].parent.name not in _ancestors(joints[outer].parent):
                raise LevadeError(f"{path}: legs.{leg.name}.joints: {inner} should be nearer to the trunk than {outer}")
        if form.trunk not in _ancestors(joints[leg.joints[0]].parent):
            raise LevadeError(
                f"{path}: legs.{leg.name}.joints: {leg.joints[0]} does not hang on the trunk {form.trunk}"
            )
        if leg.foot not in geoms:
            hint = did_you_mean(leg.foot, filter(None, geoms))
            raise LevadeError(f"{path}: legs.{leg.name}.foot: no geom {leg.foot!r} in {form.model}; {hint}")

    trunk = spec.body(form.trunk)
    free = [joint.type for joint in trunk.joints] == [mujoco.mjtJoint.mjJNT_FREE]
    if not free and (trunk.joints or trunk.parent.name != "world"):
        raise LevadeError(f"{path}: trunk: body {form.trunk} should have one free joint and no other")
    for name, joint in joints.items():
        if name not in used and joint.type != mujoco.mjtJoint.mjJNT_FREE:
            raise LevadeError(
                f"{path}: legs: joint {name} of {form.model} is in no leg; add it to one or fix it in the model"
            )


def _strip(spec: mujoco.MjSpec, form: RobotForm) -> None:
    """Make the model the bare robot: no actuators, no keyframes, a free joint on the trunk (URDF has none)."""
    for element in [*spec.actuators, *spec.keys]:
        spec.delete(element)
    trunk = spec.body(form.trunk)
    if not trunk.joints:
        trunk.add_freejoint(name="root")


def _apply_variant(spec: mujoco.MjSpec, path: Path, form: RobotForm, variant: str) -> None:
    """Replace the inertials that the variant names."""
    bodies = [body.name for body in spec.bodies][1:]
    model = _compiled(spec, path, form)
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


def _ancestors(body) -> set[str]:
    """Names of the bodies between this one and the world, without either."""
    names = set()
    while (body := body.parent) is not None and body.name != "world":
        names.add(body.name)
    return names


def _compiled(spec: mujoco.MjSpec, path: Path, form: RobotForm) -> mujoco.MjModel:
    try:
        return spec.compile()
    except ValueError as error:
        raise LevadeError(f"{path.parent / form.model}: {_one_line(error)}") from None


def _limits(model: mujoco.MjModel, joints: list[str], path: Path, form: RobotForm, linkage: bool) -> JointLimits:
    from levade.robots.description import joint_array, per_joint

    limited = np.array([bool(model.joint(joint).limited[0]) for joint in joints])
    lower, upper = np.array([model.joint(joint).range for joint in joints]).T
    infinite = np.full(len(joints), np.inf)
    curves = per_joint(form.linkage, joints, f"{path}: linkage", all_joints=False)
    return JointLimits(
        lower=np.where(limited, lower, -np.inf),
        upper=np.where(limited, upper, np.inf),
        velocity=joint_array(form.limits.velocity, joints, f"{path}: limits.velocity")
        if form.limits.velocity
        else infinite,
        torque=joint_array(form.limits.torque, joints, f"{path}: limits.torque") if form.limits.torque else infinite,
        torque_curves={joints.index(j): TorqueCurve(c.peak, c.rate, c.centre) for j, c in curves.items()}
        if linkage
        else {},
    )


def _actuation(
    name: str, joints: list[str], path: Path, form: RobotForm, torque: Array, kp: float | None, kd: float | None
) -> Actuation:
    from levade.robots.description import PIDForm, joint_array

    chosen = form.actuations[name]

    def values(key: str) -> Array:
        return joint_array(getattr(chosen, key), joints, f"{path}: actuations.{name}.{key}")

    kps = values("kp") if kp is None else np.full(len(joints), float(kp))
    kds = values("kd") if kd is None else np.full(len(joints), float(kd))
    torques = values("torque") if chosen.torque else torque
    if isinstance(chosen, PIDForm):
        return PID(name, kps, kds, torques)
    return DCMotor(name, kps, kds, torques, values("stall_torque"), values("no_load_speed"), chosen.time_constant)


def _postures(joints: list[str], path: Path, form: RobotForm, limits: JointLimits) -> dict[str, Array]:
    from levade.robots.description import joint_array

    if "neutral" not in form.postures:
        raise LevadeError(f"{path}: postures: neutral is missing; give the angles of the standing robot")
    postures = {}
    for name, table in form.postures.items():
        angles = postures[name] = joint_array(table, joints, f"{path}: postures.{name}")
        for joint, angle, lower, upper in zip(joints, angles, limits.lower, limits.upper, strict=True):
            if not lower <= angle <= upper:
                where = f"{path}: postures.{name}: {joint} = {angle:g} rad"
                raise LevadeError(f"{where} is outside its range {lower:.4g} .. {upper:.4g} rad")
    return postures


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
