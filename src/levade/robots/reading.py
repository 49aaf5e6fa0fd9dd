"""Reading: convert an MJCF or URDF file to a spec of the bare robot, and collect what the file says about its joints.

A bare robot has one free joint on the trunk, no actuators and no ground. Every body, joint and colliding geom has a name, and
every file that it needs is in memory.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.document import hides
from levade.errors import LevadeError
from levade.robots.assets import compile_readable, read_assets
from levade.robots.files import parts, read_xml
from levade.robots.findings import Finding, named, warning
from levade.robots.inertias import lift_explicit
from levade.robots.loops import Coupling, Loop, take_couplings, take_loops
from levade.robots.magnitudes import check_magnitudes
from levade.robots.quiet import quiet
from levade.robots.ranges import check_ranges, doubt_ranges
from levade.robots.servos import Servo, read_servos
from levade.robots.urdf import read_urdf
from levade.robots.winding import Winding
from levade.robots.world import collide_as_paired, float_alone, leave_only, robot_root

_UNITS = "kg and kg m2"
_OF_ACTUATORS = (
    *(
        "ctrllimited",
        "ctrlrange",
        "forcelimited",
        "forcerange",
        "actlimited",
        "actrange",
        "gear",
        "inheritrange",
        "lengthrange",
    ),
    *("dyntype", "dynprm", "gaintype", "gainprm", "biastype", "biasprm", "actdim", "actearly", "armature", "damping"),
    *("delay", "nsample", "interp", "cranklength"),
)
"""Properties of actuators for which a file may give defaults."""
_FUSED = " The static bodies of the spec were fused before this error, and remain so."


@dataclass(frozen=True)
class Keyframe:
    """Holds a pose that an MJCF defines.

    Attributes:
        name: Name of the keyframe.
        quaternion: Attitude of the trunk, shape (4,).
        angles: Joint -> angle of a hinge [rad], or position of a slide [m].
        balls: Ball joint -> quaternion, shape (4,).
    """

    name: str
    quaternion: Array
    angles: dict[str, float]
    balls: dict[str, Array] = field(default_factory=dict)


@dataclass
class Draft:
    """Holds the content of a robot's file.

    Attributes:
        path: Path of the file.
        spec: The model.
        assets: File name in the model -> content.
        urdf: Whether the file is a URDF.
        effort: Joint -> torque limit [Nm], for joints that have one.
        velocity: Joint -> speed limit [rad/s], for joints that have one.
        servos: Joint -> what drives it.
        windings: Joint -> winding of the DC motor that drives it.
        driven: Joints of an MJCF that an actuator drives.
        keyframes: Poses that an MJCF defines.
        couplings: Joints that follow others.
        loops: Bodies that were held together by a constraint.
        held: Removed joint -> angle at which it is held [rad], or [m] of a slide.
        held_bodies: Removed joint -> its body, for joints that the description or another joint holds.
        findings: What was noticed.
        origins: Where properties of the robot come from (see `Robot`).
        joints: Joints of the file except the free one, in its order.
    """

    path: Path
    spec: mujoco.MjSpec
    assets: dict[str, bytes]
    urdf: bool
    effort: dict[str, float] = field(default_factory=dict)
    velocity: dict[str, float] = field(default_factory=dict)
    servos: dict[str, Servo] = field(default_factory=dict)
    windings: dict[str, Winding] = field(default_factory=dict)
    driven: set[str] = field(default_factory=set)
    keyframes: list[Keyframe] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)
    loops: list[Loop] = field(default_factory=list)
    held: dict[str, float] = field(default_factory=dict)
    held_bodies: dict[str, str] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    origins: dict[str, str] = field(default_factory=dict)
    joints: list[str] = field(default_factory=list)

    def compile(self) -> mujoco.MjModel:
        """Compile the model.

        Raises:
            LevadeError: If MuJoCo does not accept it; the message has one line.
        """
        try:
            return self.spec.compile()
        except ValueError as error:
            raise LevadeError(f"{self.path}: {_explain(error)}") from None


def read_model(path: Path, *, trunk: str | None = None, joints: Iterable[str] = ()) -> Draft:
    """Read an MJCF or URDF file.

    Args:
        path: Path of the file.
        trunk: Name of a body of the robot, if a description gives one. The rest of the world is left out.
        joints: Names of joints of the robot, if a description gives some. They identify the robot in the same way.

    Returns:
        The content of the file.

    Raises:
        LevadeError: If the file cannot be read or simulated.
    """
    with quiet():
        return _read(path, trunk, joints)


def _read(path: Path, trunk: str | None, joints: Iterable[str]) -> Draft:
    content = read_xml(path)
    element = _parse(path, content)
    urdf = element if element is not None and element.tag == "robot" else None
    draft = _read_mjcf(path, content) if urdf is None else _read_urdf(path, urdf)
    _name_everything(draft.spec)
    check_ranges(draft.spec, str(path))
    if not draft.urdf:
        lift_explicit(draft.spec)
    model = compile_readable(draft)
    check_magnitudes(path, model)
    if hides(model.names.decode(errors="replace").replace("\0", " ")):
        raise LevadeError(
            f"{path}: names contain control characters, which no terminal can show; rename those elements"
        )
    doubts = doubt_ranges(draft.spec, model)
    if doubts:
        draft.findings += doubts
        model = draft.compile()
    root = robot_root(draft.spec, model, trunk=trunk, joints=joints, where=str(path))
    if not draft.urdf:
        _say_what_is_mended(draft)
        servos = read_servos(model)
        draft.driven = {name for name, servo in servos.items() if servo.driven}
        draft.servos = {name: servo for name, servo in servos.items() if servo.kp is not None}
        draft.windings = {name: servo.winding for name, servo in servos.items() if servo.winding is not None}
        draft.effort = {name: servo.torque for name, servo in servos.items() if np.isfinite(servo.torque)}
        draft.keyframes = _keyframes(model, root)
    _keep_massless(draft, model)
    _strip(draft, model, root)
    if not draft.urdf:
        draft.couplings, draft.loops = take_couplings(draft.spec, model), take_loops(draft.spec)
    return draft


def _parse(path: Path, content: str) -> ET.Element | None:
    """Parse an XML file and return its root; None for an MJCF that MuJoCo's more lenient parser may still accept."""
    if not content.strip():
        raise LevadeError(f"{path}: is empty; give an MJCF or URDF")
    try:
        root = ET.fromstring(content)
    except ET.ParseError as error:
        if "<mujoco" in content:
            with suppress(ValueError):
                mujoco.MjSpec.from_string(re.sub(r"<include\b[^>]*>", "", content))
                return None
        raise LevadeError(f"{path}: broken XML ({error}); fix it there") from None
    if root.tag not in ("robot", "mujoco"):
        tag = root.tag.rpartition("}")[2][:40]
        raise LevadeError(f"{path}: starts with <{tag}>; a URDF starts with <robot>, an MJCF with <mujoco>")
    return root


def _read_urdf(path: Path, root: ET.Element) -> Draft:
    source = read_urdf(path, root)
    try:
        spec = mujoco.MjSpec.from_string(source.text, assets=source.assets)
    except ValueError as error:
        raise LevadeError(f"{path}: {_explain(error)}") from None
    spec.assets = source.assets
    for mesh in spec.meshes:
        mesh.inertia = (
            mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        )  # flat meshes have no volume; links have their own inertia
    for body in spec.bodies:
        if any(not (geom.contype or geom.conaffinity) for geom in body.geoms):
            for geom in body.geoms:
                if geom.contype or geom.conaffinity:
                    geom.group = 3  # collision shapes need not be drawn if there are visual ones
    return Draft(
        path,
        spec,
        source.assets,
        True,
        source.effort,
        source.velocity,
        couplings=source.couplings,
        findings=source.findings,
    )


def _read_mjcf(path: Path, content: str) -> Draft:
    pieces = {name: (place, text) for name, place, text in parts(path, content)}
    try:
        spec = _mjcf_spec(path, content, pieces)
    except ValueError as error:
        raise LevadeError(f"{path}: {_explain(error)}") from None
    draft = Draft(path, spec, {}, False)
    for skin in list(spec.skins):  # visual only
        spec.delete(skin)
    folders = [path.parent, *dict.fromkeys(place.parent for place, _ in pieces.values())]
    read_assets(draft, folders)
    return draft


def _mjcf_spec(path: Path, content: str, pieces: Mapping[str, tuple[Path, str]]) -> mujoco.MjSpec:
    """Parse an MJCF with MuJoCo from text, since its own file reader judges by file names and assumes UTF-8."""
    if path.suffix == ".xml" and all(map(_is_utf8, (path, *(place for place, _ in pieces.values())))):
        return mujoco.MjSpec.from_file(str(path))
    return mujoco.MjSpec.from_string(content, include={name: text.encode() for name, (_, text) in pieces.items()})


def _is_utf8(path: Path) -> bool:
    try:
        path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _name_everything(spec: mujoco.MjSpec) -> None:
    """Name the bodies, joints and colliding geoms that have no name."""
    bodies, joints, geoms = ({e.name for e in kind if e.name} for kind in (spec.bodies, spec.joints, spec.geoms))
    for i, body in enumerate(spec.bodies[1:], start=1):
        body.name = body.name or _free_name(f"body{i}", bodies)
        for joint in body.joints:
            joint.name = joint.name or _free_name(f"{body.name}_joint", joints)
        for k, geom in enumerate(body.geoms):
            if not geom.name and (geom.contype or geom.conaffinity):
                geom.name = _free_name(f"{body.name}_{k}", geoms)


def _free_name(name: str, taken: set[str]) -> str:
    """Return the name, with a number appended if it is taken, and mark it as taken."""
    free = name if name not in taken else next(n for i in count(1) if (n := f"{name}_{i}") not in taken)
    taken.add(free)
    return free


def _say_what_is_mended(draft: Draft) -> None:
    """Warn of inertias that MuJoCo's compiler replaces silently."""
    broken = []
    for body in draft.spec.bodies[1:]:
        if body.explicitinertial and body.compiler.balanceinertia:
            xx, yy, zz, xy, xz, yz = body.fullinertia
            full = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            least, middle, most = np.linalg.eigvalsh(np.diag(body.inertia) if np.isnan(full).any() else full)
            if least + middle < most * (1 - 1e-6):
                broken.append(body.name)
    if broken:
        what = (
            "the inertia breaks the triangle inequality; balanceinertia takes the mean of its moments about every axis"
        )
        draft.findings.append(warning(named("body", broken), what, "fix it in the file"))
    compiler = draft.spec.compiler
    for name, least, unit in (
        ("boundmass", compiler.boundmass, "kg"),
        ("boundinertia", compiler.boundinertia, "kg m2"),
    ):
        if least > 0:
            what = f"raises smaller and missing values to {least:g} {unit}"
            draft.findings.append(
                warning(f"compiler {name}", what, "give every body its own value, and remove this setting")
            )


def _keep_massless(draft: Draft, model: mujoco.MjModel) -> None:
    """Write down zero masses of fixed bodies explicitly, since ``to_xml`` gives geoms of mass zero a density again."""
    for body in draft.spec.bodies[1:]:
        if not body.explicitinertial and body.geoms and model.body(body.name).mass[0] == 0 and not body.joints:
            body.explicitinertial, body.mass = True, 1e-9
            body.ipos, body.inertia = [0.0, 0.0, 0.0], [1e-12, 1e-12, 1e-12]


def _keyframes(model: mujoco.MjModel, root: str | None) -> list[Keyframe]:
    free = -1 if root is None else int(model.body(root).jntadr[0])
    if free < 0 or model.jnt_type[free] != mujoco.mjtJoint.mjJNT_FREE:
        return []
    first = model.jnt_qposadr[free] + 3
    places = {model.joint(j).name: int(model.jnt_qposadr[j]) for j in range(model.njnt)}
    kinds = {model.joint(j).name: mujoco.mjtJoint(int(model.jnt_type[j])) for j in range(model.njnt)}
    scalars = [name for name, kind in kinds.items() if kind.name in ("mjJNT_HINGE", "mjJNT_SLIDE")]
    balls = [name for name, kind in kinds.items() if kind.name == "mjJNT_BALL"]
    return [
        Keyframe(
            model.key(k).name,
            pose[first : first + 4].copy(),
            {name: float(pose[places[name]]) for name in scalars},
            {name: pose[places[name] : places[name] + 4].copy() for name in balls},
        )
        for k, pose in enumerate(model.key_qpos)
    ]


def _strip(draft: Draft, model: mujoco.MjModel, root: str | None) -> None:
    """Reduce the model to the bare robot: remove actuators, sensors, keyframes, and the rest of the world."""
    spec = draft.spec
    for element in [*spec.sensors, *spec.actuators, *spec.keys]:
        spec.delete(element)
    usual, plain = spec.default.actuator, mujoco.MjSpec().default.actuator
    for name in _OF_ACTUATORS:  # otherwise added servos would inherit the file's defaults
        setattr(usual, name, getattr(plain, name))
    if not draft.urdf:
        collide_as_paired(spec, model, root, draft.findings)
    leave_only(spec, root, draft.findings)
    float_alone(spec, draft.findings)


def _explain(error: Exception) -> str:
    """Write MuJoCo's message in one line, with a remedy for common errors."""
    text = " ".join(str(error).split())
    text = text.removeprefix("Error: ").removeprefix("XML Error: ").removesuffix(_FUSED)
    element = re.search(r"Element name '([^']+)'", text)
    body = f"body {element[1]}" if element else "a body"
    if "mjMINVAL" in text:
        return f"{body} moves but has no mass or no inertia; give it both, in {_UNITS}"
    if "A + B >= C" in text:
        return (
            f"{body}: its inertia breaks the triangle inequality (two of its moments are below the third); fix it, or set"
            ' <compiler balanceinertia="true"/>'
        )
    if "positive eigenvalues" in text:
        return f"{body}: its inertia is not positive; fix it"
    return text
