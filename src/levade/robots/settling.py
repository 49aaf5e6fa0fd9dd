"""Settling: check whether a robot that is put down in its neutral posture stands, and how deep its feet sink in.

Most tasks start this way: the robot is put down and holds the posture with its own gains. The resulting state is where every
trial begins.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from levade.errors import LevadeError
from levade.robots import contact
from levade.robots.dimensions import dimensions
from levade.robots.findings import Finding, named, warning
from levade.robots.preparing import TIMESTEP
from levade.robots.quiet import quiet
from levade.robots.robot import Robot
from levade.robots.shapes import thickness

TIME = 1.0
"""Settling time of the built-in tasks [s]."""
BALANCE_TIME, PUSH_TIME = 3.0, 0.2
"""Time for which a robot on two legs has to balance [s], and duration of a push in the middle of it [s]."""
_PUSH = 0.05
"""Force of the push, as a share of the robot's weight."""
_GROUND = "levade-ground"
_SAG, _TILT, _SINK = 0.15, math.radians(15), 0.25
"""Thresholds of warnings: sag as a share of the height, tilt [rad], and sink as a share of a foot's radius."""


@dataclass(frozen=True)
class Settled:
    """Describes a robot that was put down and held its neutral posture for `TIME`.

    Attributes:
        sag: How much lower the trunk is than in the posture [m].
        tilt: Angle between the trunk's up and the world's [rad].
        sink: Geom name of a foot -> how far it is below the ground's surface [m].
        broken: Whether the simulation diverged.
    """

    sag: float
    tilt: float
    sink: dict[str, float]
    broken: bool


def settle(robot: Robot, *, stiff: bool = False, time: float = TIME, push: tuple[float, float] = (0.0, 0.0)) -> Settled:
    """Put a robot down on flat ground, level and in its neutral posture, with its lowest foot touching.

    Args:
        robot: The robot.
        stiff: Whether contact is as in a scene with ``contact: stiff``, instead of the robot's own.
        time: Time for which it stands [s].
        push: Force on its trunk along x and y, as shares of its weight, for `PUSH_TIME` in the middle of that time.

    Returns:
        The state at the end.
    """
    model = _on_ground(robot, stiff=stiff)
    data = mujoco.MjData(model)
    trunk = model.body(robot.trunk).id
    neutral, height = robot.postures["neutral"], robot.neutral_height
    first = int(model.jnt_qposadr[model.body_jntadr[trunk]])
    data.qpos[first : first + 7] = [0.0, 0.0, height, 1.0, 0.0, 0.0, 0.0]
    for i, (name, angle) in enumerate(zip(robot.joint_names, neutral, strict=True)):
        data.joint(name).qpos[0] = angle
        data.ctrl[2 * i] = angle
    with quiet():
        steps, pushed = round(time / TIMESTEP), round(PUSH_TIME / TIMESTEP) if any(push) else 0
        first = (steps - pushed) // 2
        mujoco.mj_step(model, data, nstep=first)
        data.xfrc_applied[trunk, :2] = np.array(push) * 9.81 * float(model.body_mass.sum())
        if pushed:
            mujoco.mj_step(model, data, nstep=pushed)
        data.xfrc_applied[trunk] = 0.0
        mujoco.mj_step(model, data, nstep=steps - first - pushed)
        mujoco.mj_forward(model, data)
    depth = {
        foot: -min((float(c.dist) for c in data.contact if model.geom(foot).id in c.geom), default=0.0)
        for leg in robot.standing
        for foot in leg.soles
    }
    up = data.xmat[trunk].reshape(3, 3)[2, 2]
    com = float(robot.trunk_com_offset @ data.xmat[trunk].reshape(3, 3)[2]) + float(data.xpos[trunk, 2])
    sag = height + float(robot.trunk_com_offset[2]) - com
    broken = bool(data.warning.number.any()) or not np.isfinite(data.qpos).all()
    return Settled(sag, math.acos(float(np.clip(up, -1.0, 1.0))) if not broken else math.pi, depth, broken)


def doubt_standing(robot: Robot) -> Iterator[Finding]:
    """Warn of robots that do not stand in their neutral posture, and of feet that sink into the ground.

    Args:
        robot: The robot.

    Yields:
        Findings.
    """
    try:
        balances = robot.stance == "upright"
        settled = settle(robot, time=BALANCE_TIME if balances else TIME)
    except (ValueError, LevadeError):  # another check reports what MuJoCo does not accept
        return
    height = dimensions(robot).height
    if settled.broken or settled.tilt > _TILT or abs(settled.sag) > _SAG * height:
        tilt = (
            f", tilted by {math.degrees(settled.tilt):.0f} deg" if settled.tilt > _TILT and not settled.broken else ""
        )
        what = (
            "its simulation diverges"
            if settled.broken
            else f"its trunk is {abs(settled.sag):.2g} m {'lower' if settled.sag > 0 else 'higher'} after"
            f" {BALANCE_TIME if balances else TIME:g} s{tilt}"
        )
        what = f"does not stand in its neutral posture: {what}, and tasks start from there"
        yield warning("robot", what, _remedy(robot))
        return
    if balances:
        yield from _doubt_balance(robot, height)
    yield from _sunk(robot, settled)


def _doubt_balance(robot: Robot, height: float) -> Iterator[Finding]:
    """Warn of robots on two legs that a slight push fells."""
    ahead = _PUSH * robot.ahead
    ways = {"forward": (ahead, 0.0), "backward": (-ahead, 0.0), "sideways": (0.0, _PUSH)}
    felled = []
    for way, push in ways.items():
        pushed = settle(robot, time=BALANCE_TIME, push=push)
        if pushed.broken or pushed.tilt > _TILT or abs(pushed.sag) > _SAG * height:
            felled.append(way)
    if felled:
        joints = robot.standing[0].joints
        ankle = joints[-1] if felled == ["sideways"] else next(
            (j for j, role in zip(reversed(joints), reversed(robot.standing[0].roles), strict=True)
             if role in ("pitch", "kfe", "hfe")), joints[-1])  # fmt: skip
        what = f"stands, but {_PUSH:.0%} of its weight for {PUSH_TIME:g} s, {' and '.join(felled)}, fells it"
        yield warning(
            "robot", what, f"stiffer servos, of {ankle} and its image first: robot.yaml, actuations, or a lower posture"
        )


def _remedy(robot: Robot) -> str:
    """Suggest gains that hold the robot, since gains are the most common cause."""
    from levade.robots import gains

    model = robot.model
    weight = float(model.body_mass.sum())
    kp = gains.stiffness(weight, dimensions(robot).leg)
    if float(robot.actuation.kp.min()) < 0.5 * kp:
        servo = f"{{servo: {{kind: pid, kp: {float(f'{kp:.2g}'):g}}}}}"
        return f"stiffer servos: robot.yaml, actuations: {servo}, or a standing posture"
    return "check masses, torque limits, and robot.yaml, postures: {neutral: ...}"


def _sunk(robot: Robot, settled: Settled) -> Iterator[Finding]:
    deep = sunk_feet(robot.model, settled.sink)
    if not deep:
        return
    worst = max(deep, key=lambda foot: settled.sink[foot] / deep[foot])
    what = (
        f"sink {_millimetres(settled.sink[worst])} into the ground in standing ({_millimetres(deep[worst])} is their"
        " radius), and more in landing: contact is too soft"
    )
    hard = settle(robot, stiff=True)
    less = _millimetres(max(0.0, *(hard.sink[foot] for foot in deep)))
    remedy = f"scene: {{contact: stiff}} in the task ({less} in standing), or {contact.as_mjcf()} on the feet's geoms"
    yield warning(named("foot", list(deep)), what, remedy)


def sunk_feet(model: mujoco.MjModel, depth: Mapping[str, float]) -> dict[str, float]:
    """Find feet that are deep in the ground for their size.

    Args:
        model: The robot, alone or in a scene.
        depth: Geom name of a foot -> how far it is below the ground's surface [m].

    Returns:
        Foot -> its radius [m], of each that is deeper than a quarter of it.
    """
    radius = {foot: thickness(model, model.geom(foot).id) for foot in depth}
    return {foot: radius[foot] for foot in depth if depth[foot] > _SINK * radius[foot]}


def _millimetres(length: float) -> str:
    return f"{1000 * length:.2g} mm"


def _on_ground(robot: Robot, *, stiff: bool) -> mujoco.MjModel:
    """Compile the robot with its actuators on flat ground, without visual parts, with the options of the tasks."""
    spec = robot.spec()
    for geom in list(spec.geoms):
        if not (geom.contype or geom.conaffinity) and geom.parent.explicitinertial:
            spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in [mesh for mesh in spec.meshes if mesh.name not in used]:
        spec.delete(mesh)
    ground = spec.worldbody.add_geom(name=_GROUND, type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0.0, 0.0, 0.05])
    ground.contype = ground.conaffinity = 0x7FFFFFFF
    if stiff:
        contact.stiffen(spec)
    spec.option.timestep = TIMESTEP
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone, spec.option.impratio = mujoco.mjtCone.mjCONE_ELLIPTIC, 10.0
    return spec.compile()
