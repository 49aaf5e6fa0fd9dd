"""Driving: the limits of a robot's joints and the servos that move them, from its description, its file, or its size."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.embodiment import JointLimits
from levade.robots import gains
from levade.robots.actuation import PID, Actuation, DCMotor
from levade.robots.findings import named, note, warning
from levade.robots.reading import Draft
from levade.robots.standing import Bare

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

SERVO = "servo"
"""Name of the actuation of a robot whose description names none."""

_FASTEST = 100.0
"""[rad/s]; above it, a number stands for "no limit": the fastest joints of legs reach about half of it."""
_NO_LIMIT = 4
"""Times the torque that could carry the robot; above it, a number in a file stands for "no limit"."""


def find_limits(draft: Draft, bare: Bare, path: Path, form: RobotForm) -> tuple[Array, Array]:
    """Torque [Nm] and velocity [rad/s] limits, (joints,): the description's, else the model's, else assumed (torque) or
    infinite (velocity)."""
    from levade.robots.description import joint_array

    joints, file = bare.joints, "the URDF" if draft.urdf else "the model"
    if form.limits.velocity:
        velocity = joint_array(form.limits.velocity, joints, f"{path}: limits.velocity")
        draft.origins["velocity"] = "robot.yaml"
    else:
        velocity = np.array([draft.velocity.get(joint, np.inf) for joint in joints])
        draft.origins["velocity"] = file if np.isfinite(velocity).any() else "no limit"
    fast = np.isfinite(velocity) & (velocity > _FASTEST)
    if fast.any():
        what = f"speed limits of up to {velocity[fast].max():.3g} rad/s are none: not believed"
        names = [joint for joint, gone in zip(joints, fast, strict=True) if gone]
        where = "all joints" if fast.all() else named("joint", names)
        draft.findings.append(warning(where, what, "robot.yaml, limits: {velocity: ...} gives the real one"))
        velocity = np.where(fast, np.inf, velocity)
        draft.origins["velocity"] = "no limit" if fast.all() else draft.origins["velocity"]
    if form.limits.torque:
        draft.origins["torque"] = "robot.yaml"
        return joint_array(form.limits.torque, joints, f"{path}: limits.torque"), velocity
    torque = np.array([draft.effort.get(joint, np.inf) for joint in joints])
    draft.origins["torque"] = file if np.isfinite(torque).any() else "no limit"
    if form.actuations:
        return torque, velocity
    mass = float(bare.model.body_mass.sum())
    assumed = gains.assumed_torque(mass, max(bare.leg_length(leg) for leg in bare.legs))
    missing = ~(torque <= _NO_LIMIT * assumed)
    if missing.any():
        passive = [
            j for j, gone in zip(joints, missing, strict=True) if gone and draft.driven and j not in draft.driven
        ]
        _say_assumed(draft, bare, torque, missing, passive, assumed)
        draft.origins["torque"] = "assumed" if missing.all() else f"{file}, or assumed"
        torque = np.where(missing, assumed, torque)
    return torque, velocity


def _say_assumed(
    draft: Draft, bare: Bare, torque: Array, missing: NDArray[np.bool_], passive: list[str], assumed: float
) -> None:
    """Warn of limits that are made up, by reason."""

    def where(names: list[str]) -> str:
        return "all joints" if len(names) == len(bare.joints) else named("joint", names)

    remedy = "robot.yaml, limits: {torque: ...} gives the real one"
    if passive:
        draft.findings.append(
            warning(where(passive), f"without an actuator in the model: servos of {assumed:.3g} Nm are added", remedy)
        )
    limited = [(j, t) for j, t, gone in zip(bare.joints, torque, missing, strict=True) if gone and j not in passive]
    high = [joint for joint, limit in limited if np.isfinite(limit)]
    if high:
        most = max(limit for _, limit in limited if np.isfinite(limit))
        what = f"torque limits of up to {most:.3g} Nm are none for its weight; {assumed:.3g} Nm is assumed"
        draft.findings.append(warning(where(high), what, remedy))
    none = [joint for joint, limit in limited if not np.isfinite(limit)]
    if none:
        draft.findings.append(warning(where(none), f"no torque limit; {assumed:.3g} Nm is assumed", remedy))


def find_actuation(
    name: str | None,
    draft: Draft,
    bare: Bare,
    path: Path,
    form: RobotForm,
    neutral: Mapping[str, float],
    limits: JointLimits,
    kp: float | None,
    kd: float | None,
) -> Actuation:
    """The actuators: the description's, else the model's own servos, else servos with derived gains."""
    from levade.robots.description import PIDForm, joint_array

    joints = bare.joints
    name = name or next(iter(form.actuations), SERVO)
    chosen = form.actuations.get(name)

    def values(key: str) -> Array | None:
        table = getattr(chosen, key, None)
        return None if table is None else joint_array(table, joints, f"{path}: actuations.{name}.{key}")

    kps = values("kp") if kp is None else np.full(len(joints), float(kp))
    kds = values("kd") if kd is None else np.full(len(joints), float(kd))
    draft.origins["gains"] = "as asked for" if kp is not None or kd is not None else f"robot.yaml, actuation {name}"
    if kps is None or kds is None:
        own_kp, own_kd, draft.origins["gains"] = _gains(draft, bare, neutral, kps, keep=chosen is None)
        kps = own_kp if kps is None else kps
        kds = own_kd if kds is None else kds
        own = draft.origins["gains"] == "the model's servos"
        remedy = "" if own else "robot.yaml, actuations: {servo: {kind: pid, kp: ..., kd: ...}} gives others"
        ranges = f"{_range(kps, 'Nm/rad')}, {_range(kds, 'Nm s/rad')}"
        draft.findings.append(note("gains", f"{draft.origins['gains']}: {ranges}", remedy))
    torques = values("torque")
    torques = limits.torque if torques is None else torques
    velocity = limits.velocity
    if isinstance(chosen, PIDForm) or (chosen is None and not np.isfinite(velocity).all()):
        return PID(name, kps, kds, torques)
    if chosen is None:
        lines = [gains.speed_line(float(t), float(v)) for t, v in zip(torques, velocity, strict=True)]
        stall, no_load = np.array(lines).T
        return DCMotor(name, kps, kds, torques, stall, no_load, 0.0)
    stall, no_load = values("stall_torque"), values("no_load_speed")
    assert stall is not None
    assert no_load is not None
    return DCMotor(name, kps, kds, torques, stall, no_load, chosen.time_constant)


def _gains(
    draft: Draft, bare: Bare, neutral: Mapping[str, float], kps: Array | None, *, keep: bool
) -> tuple[Array, Array, str]:
    """(joints,) kp and kd: those of the model's own servos, where it has them, else derived; and which it was.

    kps: stiffness that is given already, for which the damping is to be found. keep: whether the model's own count.
    """
    joints = bare.joints
    servos = {joint: draft.servos[joint] for joint in joints if keep and joint in draft.servos}
    mass = float(bare.model.body_mass.sum())
    stiffness = gains.stiffness(mass, max(bare.leg_length(leg) for leg in bare.legs))
    inertia = max(bare.joint_inertia(neutral).values())
    damping = gains.damping(float((np.array([stiffness]) if kps is None else kps).max()), inertia)
    kp = np.array([servos[joint].kp if joint in servos else stiffness for joint in joints], dtype=float)
    kd = np.array([servos[joint].kd if joint in servos else damping for joint in joints], dtype=float)
    if not servos:
        return kp, kd, "derived from mass and inertia"
    if len(servos) == len(joints):
        return kp, kd, "the model's servos"
    return kp, kd, "the model's servos, or derived from mass and inertia"


def _range(values: Array, unit: str) -> str:
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g} {unit}" if low == high else f"{low:.3g} to {high:.3g} {unit}"
