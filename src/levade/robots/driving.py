"""Driving: find the limits of a robot's joints and the servos that move them, from its description, its file, or its size."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.embodiment import JointLimits
from levade.robots import gains
from levade.robots.actuation import PID, Actuation, DCMotor
from levade.robots.findings import named_joints, note, warning
from levade.robots.preparing import TIMESTEP
from levade.robots.reading import Draft
from levade.robots.servos import windings
from levade.robots.standing import Bare

if TYPE_CHECKING:
    from levade.robots.description import RobotForm

SERVO = "servo"
"""Name of the actuation of a robot whose description names none."""

_FASTEST = 100.0
"""Largest plausible speed limit [rad/s]. The fastest joints of legs reach about half of it; more stands for "no limit"."""
_NO_LIMIT = 4
"""Largest plausible torque limit, as a multiple of the torque that could carry the robot; more stands for "no limit"."""
_RUN_UP = 0.1
"""Time in which a plausible torque brings a joint's own rotor to its speed limit [s], where that takes more."""


@dataclass(frozen=True)
class Drives:
    """Holds the limits of the joints' drives.

    Attributes:
        torque: Torque limits [Nm], shape (joints,); infinite for no limit.
        velocity: Speed limits [rad/s], shape (joints,); infinite for no limit.
        assumed_torque: Indices of the joints whose torque limit is assumed.
        assumed_velocity: Indices of the joints whose speed limit is assumed.
    """

    torque: Array
    velocity: Array
    assumed_torque: tuple[int, ...] = ()
    assumed_velocity: tuple[int, ...] = ()


def find_limits(draft: Draft, bare: Bare, path: Path, form: RobotForm, actuation: str | None) -> Drives:
    """Find the joints' limits: the description's, otherwise the model's, otherwise the actuators', otherwise assumed ones.

    Args:
        draft: The model as read. Assumed limits are added to its findings.
        bare: The bare robot.
        path: Path of the description.
        form: The description.
        actuation: Name of the chosen actuation.

    Returns:
        The limits, in joint order.
    """
    velocity, assumed_velocity = _velocity(draft, bare, path, form, actuation)
    torque, assumed_torque = _torque(draft, bare, path, form)
    return Drives(torque, velocity, _indices(assumed_torque), _indices(assumed_velocity))


def _velocity(
    draft: Draft, bare: Bare, path: Path, form: RobotForm, actuation: str | None
) -> tuple[Array, NDArray[np.bool_]]:
    """Return speed limits [rad/s], shape (joints,), and which of them are assumed."""
    from levade.robots.description import DCMotorForm, joint_array

    joints = bare.joints
    if form.limits.velocity:
        draft.origins["velocity"] = "robot.yaml"
        return joint_array(form.limits.velocity, joints, f"{path}: limits.velocity"), np.zeros(len(joints), bool)
    file = _file(draft)
    velocity = np.array([draft.velocity.get(joint, np.inf) for joint in joints])
    fast = np.isfinite(velocity) & (velocity > _FASTEST)
    name = actuation or next(iter(form.actuations), SERVO)
    chosen = form.actuations.get(name)
    if isinstance(chosen, DCMotorForm):
        file = f"robot.yaml, no-load speed of {name}"
        own = joint_array(chosen.no_load_speed, joints, f"{path}: actuations.{name}.no_load_speed")
        velocity = np.where(velocity <= _FASTEST, velocity, own)
    missing = np.zeros(len(joints), bool) if isinstance(chosen, DCMotorForm) else ~(velocity <= _FASTEST)
    draft.origins["velocity"] = file
    if missing.any():
        assumed = gains.assumed_speed(_leg_length(bare))
        remedy = "robot.yaml, limits: {velocity: ...} gives the real one"
        most = velocity[fast].max(initial=0.0)
        high = f"speed limits of up to {most:.3g} rad/s are not plausible; {assumed:.3g} rad/s is assumed"
        for some, what in (
            (missing & fast, high),
            (missing & ~fast, f"no speed limit; {assumed:.3g} rad/s is assumed"),
        ):
            if some.any():
                draft.findings.append(warning(_where(bare, some), what, remedy))
        draft.origins["velocity"] = "assumed" if missing.all() else f"{file}, or assumed"
        velocity = np.where(missing, assumed, velocity)
    return velocity, missing


def _torque(draft: Draft, bare: Bare, path: Path, form: RobotForm) -> tuple[Array, NDArray[np.bool_]]:
    """Return torque limits [Nm], shape (joints,), and which are assumed.

    A limit is infinite if a description with its own actuations gives none.
    """
    from levade.robots.description import joint_array

    joints, none = bare.joints, np.zeros(len(bare.joints), bool)
    if form.limits.torque:
        draft.origins["torque"] = "robot.yaml"
        return joint_array(form.limits.torque, joints, f"{path}: limits.torque"), none
    torque = np.array([draft.effort.get(joint, np.inf) for joint in joints])
    draft.origins["torque"] = _file(draft) if np.isfinite(torque).any() else "no limit"
    if form.actuations:
        return torque, none
    assumed = gains.assumed_torque(float(bare.model.body_mass.sum()), _leg_length(bare))
    standing = np.array([leg.stands for leg in bare.legs for _ in leg.joints])
    rotor = bare.armature * gains.assumed_speed(_leg_length(bare)) / _RUN_UP
    missing = ~(torque <= _NO_LIMIT * np.maximum(assumed, rotor))
    for legs, values in ((True, np.full(len(joints), assumed)), (False, _arm_torque(bare, assumed))):
        chosen = missing & (standing == legs)
        if chosen.any():
            _say_assumed(draft, bare, torque, chosen, float(values[chosen].max()))
            torque = np.where(chosen, values, torque)
    if missing.any():
        draft.origins["torque"] = "assumed" if missing.all() else f"{_file(draft)}, or assumed"
    return torque, missing


def _arm_torque(bare: Bare, most: float) -> Array:
    """Assume torque limits of arms [Nm], shape (joints,): a multiple of what carries them when held out straight."""
    data = bare.data_at({joint: bare.resting(joint) for joint in bare.joints})
    model = bare.model
    torque = np.full(len(bare.joints), most)
    for k, joint in enumerate(bare.joints):
        body = int(model.jnt_bodyid[model.joint(joint).id])
        mass = float(model.body_subtreemass[body])
        away = float(np.linalg.norm(data.subtree_com[body] - data.joint(joint).xanchor))
        torque[k] = min(most, max(gains.ARM_RESERVE * mass * gains.GRAVITY * away, 0.05 * most))
    for arm in ([bare.joints.index(joint) for joint in leg.joints] for leg in bare.legs):
        torque[arm] = np.maximum(torque[arm], gains.ARM_EVEN * torque[arm].max())
    return torque


def _say_assumed(draft: Draft, bare: Bare, torque: Array, missing: NDArray[np.bool_], assumed: float) -> None:
    """Warn of assumed torque limits, grouped by reason."""
    remedy = "robot.yaml, limits: {torque: ...} gives the real one"
    undriven = np.array([bool(draft.driven) and joint not in draft.driven for joint in bare.joints])
    limited = np.isfinite(torque)
    most = torque[missing & ~undriven & limited].max(initial=0.0)
    for chosen, what in (
        (missing & undriven, f"without an actuator in the model: servos of {assumed:.3g} Nm are added"),
        (
            missing & ~undriven & limited,
            f"torque limits of up to {most:.3g} Nm are not plausible for its weight; {assumed:.3g} Nm is assumed",
        ),
        (missing & ~undriven & ~limited, f"no torque limit; {assumed:.3g} Nm is assumed"),
    ):
        if chosen.any():
            draft.findings.append(warning(_where(bare, chosen), what, remedy))


def _file(draft: Draft) -> str:
    return "the URDF" if draft.urdf else "the model"


def _leg_length(bare: Bare) -> float:
    return max(bare.leg_length(leg) for leg in bare.standing)


def _indices(chosen: NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(int(i) for i in np.flatnonzero(chosen))


def _where(bare: Bare, chosen: NDArray[np.bool_]) -> str:
    return named_joints([joint for joint, taken in zip(bare.joints, chosen, strict=True) if taken], len(bare.joints))


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
    """Choose the actuators: the description's, otherwise the model's own servos, otherwise servos with derived gains.

    Args:
        name: Name of the actuation. None for the default.
        draft: The model as read.
        bare: The bare robot.
        path: Path of the description.
        form: The description.
        neutral: Joint -> angle in the neutral posture [rad].
        limits: The joints' limits.
        kp: Stiffness for all joints [Nm/rad]. None for the actuation's own.
        kd: Damping for all joints [Nm s/rad]. None for the actuation's own.

    Returns:
        The actuation, in joint order.
    """
    from levade.robots.description import DCMotorForm, PIDForm, joint_array, read_winding

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
        own_kp, own_kd, draft.origins["gains"] = _gains(draft, bare, neutral, limits.torque, kps, keep=chosen is None)
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
        return DCMotor(name, kps, kds, torques, stall, no_load, 0.0, winding=windings(draft.windings, joints))
    stall, no_load = values("stall_torque"), values("no_load_speed")
    assert stall is not None
    assert no_load is not None
    assert isinstance(chosen, DCMotorForm)
    winding = windings(draft.windings, joints)
    if chosen.winding is not None:
        winding = read_winding(chosen.winding, joints, f"{path}: actuations.{name}.winding")
    return DCMotor(name, kps, kds, torques, stall, no_load, chosen.time_constant, chosen.supply_pressure, winding)


def _gains(
    draft: Draft, bare: Bare, neutral: Mapping[str, float], torque: Array, kps: Array | None, *, keep: bool
) -> tuple[Array, Array, str]:
    """Return kp and kd, shape (joints,) each, and where they come from: the model's own servos, or derived.

    Args:
        draft: The model as read.
        bare: The bare robot.
        neutral: Joint -> angle in the neutral posture [rad].
        torque: Torque limits [Nm], shape (joints,).
        kps: Given stiffness [Nm/rad], for which to find the damping. None to derive both.
        keep: Whether to use the gains of the model's own servos.
    """
    joints = bare.joints
    servos = {joint: draft.servos[joint] for joint in joints if keep and joint in draft.servos}
    if bare.shares_gains:
        stiffness, damping = _same_gains(bare, neutral, kps)
    else:
        stiffness, damping = _own_gains(bare, neutral, torque, kps)
    kp = np.array([servos[j].kp if j in servos else k for j, k in zip(joints, stiffness, strict=True)], dtype=float)
    kd = np.array([servos[j].kd if j in servos else k for j, k in zip(joints, damping, strict=True)], dtype=float)
    if not servos:
        return kp, kd, "derived from mass and inertia"
    if len(servos) == len(joints):
        return kp, kd, "the model's servos"
    return kp, kd, "the model's servos, or derived from mass and inertia"


def _same_gains(bare: Bare, neutral: Mapping[str, float], kps: Array | None) -> tuple[list[float], list[float]]:
    """Return stiffness and damping of each joint, for legs whose joints share one gain."""
    mass = float(bare.model.body_mass.sum())
    stiffness = gains.stiffness(mass, _leg_length(bare))
    inertia = max(bare.joint_inertia(neutral).values())
    damping = gains.damping(float((np.array([stiffness]) if kps is None else kps).max()), inertia)
    return [stiffness] * len(bare.joints), [damping] * len(bare.joints)


def _own_gains(
    bare: Bare, neutral: Mapping[str, float], torque: Array, kps: Array | None
) -> tuple[list[float], list[float]]:
    """Return each joint's own stiffness and damping, stable at the time step."""
    load = np.abs(list(bare.static_torque(neutral).values()))
    most = np.maximum(
        gains.stiffness(float(bare.model.body_mass.sum()), _leg_length(bare)), load / gains.GIVE_UNDER_LOAD
    )
    most = np.maximum(most, bare.armature * (2 * np.pi * gains.BANDWIDTH) ** 2)
    standing = np.array([leg.stands for leg in bare.legs for _ in leg.joints])
    kp = np.minimum(most, torque / np.where(standing, gains.GIVE_STANDING, gains.GIVE_FREE)) if kps is None else kps
    inertia = np.array(list(bare.joint_inertia(neutral).values()))
    kd = np.array([gains.damping(float(k), float(i)) for k, i in zip(kp, inertia, strict=True)])
    return kp.tolist(), np.minimum(kd, inertia / TIMESTEP).tolist()


def _range(values: Array, unit: str) -> str:
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g} {unit}" if low == high else f"{low:.3g} to {high:.3g} {unit}"
