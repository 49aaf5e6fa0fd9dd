"""Reading: from an MJCF or URDF file to a spec of the bare robot, and what the file says of its joints.

Bare: one free joint on the trunk, no actuators, no ground, every body, joint and colliding geom named, every file that
it needs in memory.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots.findings import Finding, note, warning
from levade.robots.meshes import find_mesh, read_mesh
from levade.robots.servos import Servo, read_servos
from levade.robots.urdf import read_urdf
from levade.trajectory import Array

_UNITS = "kg, m and rad"


@dataclass(frozen=True)
class Keyframe:
    """A pose that an MJCF comes with. quaternion: of the trunk. angles: joint -> [rad]."""

    name: str
    quaternion: Array
    angles: dict[str, float]


@dataclass
class Draft:
    """A robot's file, read.

    effort [Nm], velocity [rad/s]: joint -> limit, of those that have one. servos: joint -> position servo.
    """

    path: Path
    spec: mujoco.MjSpec
    assets: dict[str, bytes]
    urdf: bool
    effort: dict[str, float] = field(default_factory=dict)
    velocity: dict[str, float] = field(default_factory=dict)
    servos: dict[str, Servo] = field(default_factory=dict)
    keyframes: list[Keyframe] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)

    def compile(self) -> mujoco.MjModel:
        """The model. Raises LevadeError in one line."""
        try:
            return self.spec.compile()
        except ValueError as error:
            raise LevadeError(f"{self.path}: {_explain(error)}") from None


def read_model(path: Path) -> Draft:
    """Read an MJCF or URDF file. Raises LevadeError."""
    try:
        content = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise LevadeError(f"{path}: not a text file; give an MJCF or URDF") from None
    except OSError as error:
        raise LevadeError(f"{path}: cannot be read ({error.strerror})") from None
    is_urdf = path.suffix.lower() == ".urdf" or "<robot" in content[:4000]
    draft = _read_urdf(path, content) if is_urdf else _read_mjcf(path)
    _name_everything(draft.spec)
    model = draft.compile()
    if not is_urdf:
        servos = read_servos(model)
        draft.servos = {name: servo for name, servo in servos.items() if servo.kp is not None}
        draft.effort = {name: servo.torque for name, servo in servos.items() if np.isfinite(servo.torque)}
        draft.keyframes = _keyframes(model)
    _keep_massless(draft, model)
    _strip(draft)
    return draft


def _read_urdf(path: Path, content: str) -> Draft:
    source = read_urdf(path, content)
    try:
        spec = mujoco.MjSpec.from_string(source.text, assets=source.assets)
    except ValueError as error:
        raise LevadeError(f"{path}: {_explain(error)}") from None
    spec.assets = source.assets
    return Draft(path, spec, source.assets, True, source.effort, source.velocity, findings=source.findings)


def _read_mjcf(path: Path) -> Draft:
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise LevadeError(f"{path}: {_explain(error)}") from None
    draft = Draft(path, spec, {}, False)
    names: dict[Path, str] = {}
    for kind, folder in (("meshes", spec.meshdir), ("hfields", spec.meshdir), ("textures", spec.texturedir)):
        for element in getattr(spec, kind):
            files = [file for file in (element.file, *getattr(element, "cubefiles", ())) if file]
            if not files:
                continue
            place = find_mesh(str(Path(folder) / element.file), path.parent) if element.file else None
            element.name = element.name or Path(files[0]).stem
            problem = None if place is not None else f"missing: {files[0]}"
            if place is not None and place not in names:
                try:
                    suffix, content = read_mesh(place) if kind == "meshes" else (place.suffix, place.read_bytes())
                    stem = f"{place.stem}{suffix}"
                    names[place] = stem if stem not in draft.assets else f"{len(draft.assets)}-{stem}"
                    draft.assets[names[place]] = content
                except (LevadeError, OSError) as error:
                    problem = str(error)
            if problem is None and place is not None:
                element.file = names[place]
            else:
                _do_without(draft, kind, element, problem or "")
    spec.meshdir = spec.texturedir = ""
    spec.assets = draft.assets
    return draft


def _do_without(draft: Draft, kind: str, element, problem: str) -> None:
    """Take a mesh whose file cannot be had out of the model, if the physics does not need it."""
    spec, name = draft.spec, element.name
    if kind == "textures":
        draft.findings.append(note(f"texture {name}", f"not shown, {problem}"))
        for material in spec.materials:
            material.textures = ["" if texture == name else texture for texture in material.textures]
        spec.delete(element)
        return
    users = [geom for geom in spec.geoms if (geom.meshname if kind == "meshes" else geom.hfieldname) == name]
    for geom in users:
        body = geom.parent
        others = [g for g in body.geoms if g not in users]
        colliding = bool(geom.contype or geom.conaffinity)
        if not body.explicitinertial and not _massless(geom) and body.name != "world":
            raise LevadeError(
                f"{draft.path}: the inertia of body {body.name} comes from the mesh {name}, {problem};"
                " put the file where it says, or give the body an <inertial>"
            )
        if colliding and not any(g.contype or g.conaffinity for g in others):
            draft.findings.append(
                warning(
                    f"body {body.name}",
                    f"collides with nothing, {problem}",
                    "put the file where it says, or give the body a collision primitive",
                )
            )
        elif colliding:
            draft.findings.append(
                warning(
                    f"body {body.name}", f"collides as its other geoms only, {problem}", "put the file where it says"
                )
            )
        else:
            draft.findings.append(note(f"body {body.name}", f"not shown as its mesh, {problem}"))
        spec.delete(geom)
    spec.delete(element)


def _massless(geom) -> bool:
    return geom.mass == 0 or (np.isnan(geom.mass) and geom.density == 0)


def _name_everything(spec: mujoco.MjSpec) -> None:
    """Names for bodies, joints and colliding geoms that have none."""
    taken = {geom.name for geom in spec.geoms if geom.name}
    for i, body in enumerate(spec.bodies[1:], start=1):
        body.name = body.name or f"body{i}"
        joints = body.joints
        for k, joint in enumerate(joints):
            joint.name = joint.name or (f"{body.name}_joint" if len(joints) == 1 else f"{body.name}_joint{k}")
        for k, geom in enumerate(body.geoms):
            if not geom.name and (geom.contype or geom.conaffinity):
                geom.name = next(name for name in (f"{body.name}_{k}", f"{body.name}_geom{k}") if name not in taken)
                taken.add(geom.name)


def _keep_massless(draft: Draft, model: mujoco.MjModel) -> None:
    """Write down the mass of fixed bodies that have none: geoms of mass zero get their density back from ``to_xml``."""
    for body in draft.spec.bodies[1:]:
        if not body.explicitinertial and body.geoms and model.body(body.name).mass[0] == 0 and not body.joints:
            body.explicitinertial, body.mass = True, 1e-9
            body.ipos, body.inertia = [0.0, 0.0, 0.0], [1e-12, 1e-12, 1e-12]


def _keyframes(model: mujoco.MjModel) -> list[Keyframe]:
    free = [j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]
    if len(free) != 1:
        return []
    first = model.jnt_qposadr[free[0]] + 3
    hinges = [j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE]
    return [
        Keyframe(
            model.key(k).name,
            model.key_qpos[k, first : first + 4].copy(),
            {model.joint(j).name: float(model.key_qpos[k, model.jnt_qposadr[j]]) for j in hinges},
        )
        for k in range(model.nkey)
    ]


def _strip(draft: Draft) -> None:
    """Leave the bare robot: without actuators, sensors, keyframes, and what stands in the world beside it."""
    spec = draft.spec
    for element in [*spec.sensors, *spec.actuators, *spec.keys]:
        spec.delete(element)
    world = spec.worldbody
    if world.geoms and not draft.urdf:
        draft.findings.append(
            note(
                "worldbody",
                f"{len(world.geoms)} geoms of the world (floor, obstacles) are left out",
                "a task's scene says what the robot stands on",
            )
        )
    for element in [*world.geoms, *world.sites, *spec.lights, *spec.cameras]:
        spec.delete(element)
    for body in [body for body in world.bodies if not _moves(body)]:
        draft.findings.append(note(f"body {body.name}", "of the world, is left out"))
        spec.delete(body)


def _moves(body) -> bool:
    return bool(body.joints) or any(_moves(child) for child in body.bodies)


def _explain(error: Exception) -> str:
    """MuJoCo's message in one line, with a remedy where it is a usual one."""
    text = " ".join(str(error).split())
    text = text.removeprefix("Error: ").removeprefix("XML Error: ")
    if "mjMINVAL" in text:
        return f"a moving body has no mass or inertia ({text}); give it both, in {_UNITS}"
    if "inertia must" in text or "positive eigenvalues" in text:
        return f'{text}; mend the inertia, or set <compiler balanceinertia="true"/>'
    return text
