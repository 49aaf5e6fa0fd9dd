"""Margins: how much slack a motion leaves to each limit of the hardware, computed from the motion's arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.checks.contacts import landings, poses, scene_forces
from levade.checks.impacts import SCENE, replay_contacts
from levade.embodiment import TorqueCurve
from levade.errors import LevadeError
from levade.motions import RecordedSimulation
from levade.robots import PID, Robot
from levade.robots.winding import Winding
from levade.tasks import Demands

_ROUNDING = 1e-6
"""Tolerance of a limit: a torque that the engine clamps at its limit is at it, not beyond."""
GRAVITY = 9.81
"""[m/s2], for forces in weights of the robot."""
_LITRES_PER_MINUTE = 60e3
"""One cubic metre per second, in litres per minute."""


@dataclass(frozen=True)
class Margin:
    """Slack to one kind of limit.

    Attributes:
        unit: Unit of the numbers.
        values: Joint, foot or pair of bodies -> slack, or the measured value if this kind has no limit of its own. None if the
            robot gives no limit.
        least: Name with the least slack, or with the largest measured value.
        value: Its number.
        required: Demanded number; None if nothing is demanded.
        failed: Names that do not meet the demand.
        unknown: Names whose limit is not known, or only assumed; they never fail.
        passed: Whether the demand is met; None if nothing is demanded, or if nothing fails but something is unknown.
        reason: Why the margin is not judged or not available.
        said: The least slack in words, in the unit of the limit itself.
        more: Further numbers.
    """

    unit: str
    values: Mapping[str, float | None] = field(default_factory=dict)
    least: str = ""
    value: float | None = None
    required: float | None = None
    failed: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    passed: bool | None = None
    reason: str = ""
    said: str = ""
    more: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Write the margin as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        content = asdict(self)
        more = content.pop("more")
        return {**content, "failed": list(self.failed), "unknown": list(self.unknown), **more}


def margins(simulation: RecordedSimulation, demands: Demands) -> dict[str, Margin]:
    """Compute the slack of a motion to every kind of limit.

    Args:
        simulation: The motion.
        demands: Thresholds that the margins are compared with.

    Returns:
        Kind of limit -> margin.
    """
    motion, limits = simulation.motion, simulation.embodiment.limits
    joints, robot = simulation.embodiment.joint_names, _description(simulation)
    winding = _winding(robot)
    angle, speed, torque = (motion[f"joint_{name}"] for name in ("position", "velocity", "torque"))
    power, energy = np.abs(torque * speed), _energy(torque * speed, simulation.timestep)
    heated = {}
    if isinstance(winding, Winding) and winding.resistance is not None:
        electrical = np.maximum(torque * speed, 0.0) + winding.heat(torque)
        heated = {"with_winding_heat": float(electrical.sum(axis=1).max())}
    at_limit = (np.abs(torque) >= limits.torque * (1 - 1e-9)).mean(axis=0)
    found = {
        "position": _least("rad", joints, limits.angle_left(angle).min(axis=0), demands.position),
        "speed": _least(
            "share of limit",
            joints,
            _left(np.abs(speed).max(axis=0), limits.velocity),
            demands.speed,
            assumed=limits.assumed_velocity,
        ),
        "torque": _least(
            "share of limit",
            joints,
            _left(np.abs(torque).max(axis=0), limits.torque),
            demands.torque,
            assumed=limits.assumed_torque,
            more={"time_at_limit": dict(zip(joints, at_limit.tolist(), strict=True))},
        ),
        "torque_speed": _torque_speed(simulation, demands.torque_speed),
        "linkage": _linkage(simulation, robot, demands.linkage),
        "power": _most(
            "W",
            dict(zip(joints, power.max(axis=0).tolist(), strict=True)),
            demands.power,
            more=energy,
        ),
        "robot_power": _most("W", {"robot": energy["robot_peak"]}, demands.robot_power, more=heated),
        "torque_rms": _least(
            "share of limit",
            joints,
            _left(np.sqrt(np.square(torque).mean(axis=0)), limits.torque),
            demands.torque_rms,
            assumed=limits.assumed_torque,
        ),
        "current": _current(simulation, winding, demands.current),
        "winding_temperature": _temperature(simulation, winding, demands.winding_temperature),
    }
    return found | _flow(simulation, robot, demands) | _contacts(simulation, demands) | _impacts(simulation, demands)


def _left(most: Array, limit: Array) -> Array:
    """Compute the slack as a share of the limit, shape (joints,); NaN for a joint without a limit."""
    return np.where(np.isfinite(limit), 1 - most / limit, np.nan)


def _least(
    unit: str,
    names: tuple[str, ...],
    left: Array,
    required: float | None,
    *,
    assumed: Sequence[int] = (),
    reason: str = "",
    more: Mapping[str, Any] | None = None,
) -> Margin:
    """Make a margin with a lower bound on the slack, shape (names,), which is not finite for a name without a limit.

    ``assumed`` has the indices of names whose limit no file gives; ``reason`` says why there is no limit.
    """
    there = np.isfinite(left)
    values = {name: float(value) if finite else None for name, value, finite in zip(names, left, there, strict=True)}
    least = int(np.argmin(np.where(there, left, np.inf))) if there.any() else None
    made_up = [names[i] for i in assumed if there[i]]
    none = [name for name, finite in zip(names, there, strict=True) if not finite]
    beyond = [] if required is None else [n for n, v in values.items() if v is not None and v < required - _ROUNDING]
    failed = tuple(name for name in beyond if name not in made_up)
    unknown = () if required is None else tuple(name for name in names if name in {*made_up, *none})
    said = [
        reason or f"the robot gives no limit{_of(none, names)}" if none else "",
        f"the limit is assumed{_of(made_up, names)}" if made_up else "",
        f"beyond what is assumed: {', '.join(name for name in beyond if name in made_up)}",
    ]
    return Margin(
        unit,
        values,
        "" if least is None else names[least],
        None if least is None else float(left[least]),
        required,
        failed,
        unknown,
        passed=None if required is None or (unknown and not failed) else not failed,
        reason="; ".join(text for text in said if text and not text.endswith(": ")),
        more=more or {},
    )


def _of(some: Sequence[str], names: Sequence[str]) -> str:
    """List the names, unless they are all of them."""
    return "" if len(some) == len(names) else f" of {', '.join(some)}"


def _most(
    unit: str,
    values: Mapping[str, float],
    allowed: float | None,
    *,
    reason: str = "",
    more: Mapping[str, Any] | None = None,
) -> Margin:
    """Make a margin with an upper bound on what is measured."""
    if not values:
        return Margin(unit, required=allowed, passed=None if allowed is None else True, more=more or {})
    most = max(values, key=lambda name: values[name])
    failed: tuple[str, ...] = ()
    if allowed is not None:
        failed = tuple(name for name, value in values.items() if value > allowed + _ROUNDING)
    passed = None if allowed is None else not failed
    reason = reason or ("" if allowed is not None else "no limit is known, and none demanded")
    return Margin(
        unit, dict(values), most, values[most], allowed, failed, passed=passed, reason=reason, more=more or {}
    )


def _torque_speed(simulation: RecordedSimulation, required: float | None) -> Margin:
    """Compute the slack to the line from stall torque to no-load speed; a braking joint has the constant limit alone."""
    limits, joints = simulation.embodiment.limits, simulation.embodiment.joint_names
    torque, speed = simulation.motion["joint_torque"], simulation.motion["joint_velocity"]
    left = np.full(len(joints), np.nan)
    if limits.stall_torque is not None:
        # a share of the stall torque: near the no-load speed, a share of the torque on the line would mean nothing
        there = np.isfinite(limits.stall_torque)
        left[there] = limits.torque_speed_left(torque, speed).min(axis=0)[there]
    return _least(
        "share of stall torque",
        joints,
        left,
        required,
        assumed=sorted({*limits.assumed_velocity, *limits.assumed_torque}),
        reason="the actuators have no torque-speed line",
    )


def _linkage(simulation: RecordedSimulation, robot: Robot | str, required: float | None) -> Margin:
    """Compute the slack to the torque that linkages transmit at their angle."""
    motion, names = simulation.motion, simulation.embodiment.joint_names
    curves = _curves(simulation, robot)
    if isinstance(curves, str):
        return Margin("share of limit", required=required, reason=curves)
    limits = replace(simulation.embodiment.limits, torque_curves=curves)
    left = limits.linkage_left(motion["joint_position"], motion["joint_torque"]).min(axis=0)
    linked = sorted(curves)
    margin = _least("share of limit", tuple(names[joint] for joint in linked), left[linked], required)
    if simulation.task.robot.linkage:
        return margin
    return replace(margin, passed=None, reason="the task does not ask for the linkage (robot: {linkage: true})")


def _winding(robot: Robot | str) -> Winding | str:
    """Return the windings that the robot's description gives, or say why there are none."""
    if isinstance(robot, str):
        return robot
    if isinstance(robot.actuation, PID) or robot.actuation.winding is None:
        hydraulic = not isinstance(robot.actuation, PID) and robot.actuation.supply_pressure is not None
        return (
            "the drives are hydraulic"
            if hydraulic
            else "the robot's description has no windings; torque rms and robot power stand in for it"
        )
    return robot.actuation.winding


def _without(simulation: RecordedSimulation, reason: str, required: float | None) -> Margin:
    """Make the margin of windings that are not known. It is unknown only if the user demands some slack."""
    unknown = simulation.embodiment.joint_names if required else ()
    return Margin("share of limit", required=required, unknown=unknown, reason=reason)


def _current(simulation: RecordedSimulation, winding: Winding | str, required: float | None) -> Margin:
    """Compute the slack to the windings' current limits."""
    if isinstance(winding, str):
        return _without(simulation, winding, required)
    joints = simulation.embodiment.joint_names
    current = winding.currents(simulation.motion["joint_torque"])
    peak, rms = current.max(axis=0), np.sqrt(np.square(current).mean(axis=0))
    margin = _least(
        "share of limit",
        joints,
        _left(peak, winding.current),
        required,
        reason="the robot's description gives no current limit",
        more={
            "peak_A": dict(zip(joints, peak.tolist(), strict=True)),
            "rms_A": dict(zip(joints, rms.tolist(), strict=True)),
        },
    )
    least = joints.index(margin.least) if margin.least else int(np.argmax(peak))
    limit = f" of {winding.current[least]:.3g} A" if margin.least else f", {joints[least]}"
    return replace(margin, said=f"{peak[least]:.3g} A{limit}")


def _temperature(simulation: RecordedSimulation, winding: Winding | str, required: float | None) -> Margin:
    """Compute the slack to the highest temperature of windings, as a share of the rise from the ambient temperature."""
    if isinstance(winding, Winding) and winding.thermal is None:
        winding = "the robot's description does not say how its windings warm up; torque rms stands in for it"
    if isinstance(winding, str):
        return replace(_without(simulation, winding, required), unit="share of rise")
    joints, thermal, torque = simulation.embodiment.joint_names, winding.thermal, simulation.motion["joint_torque"]
    assert thermal is not None
    hottest = winding.temperatures(torque, simulation.timestep).max(axis=0)
    repeated = winding.repeated(torque)
    margin = _least(
        "share of rise",
        joints,
        (thermal.limit - hottest) / (thermal.limit - thermal.ambient),
        required,
        assumed=range(len(joints)) if thermal.assumed else (),
        more={
            "hottest_C": dict(zip(joints, hottest.tolist(), strict=True)),
            "ambient_C": dict(zip(joints, thermal.ambient.tolist(), strict=True)),
            "if_repeated_C": {
                joint: float(value) if np.isfinite(value) else None
                for joint, value in zip(joints, repeated, strict=True)
            },
        },
    )
    least = joints.index(margin.least)
    known = "assumed " * thermal.assumed
    return replace(margin, said=f"{hottest[least]:.1f} °C of {known}{thermal.limit[least]:.0f} °C")


def _flow(simulation: RecordedSimulation, robot: Robot | str, demands: Demands) -> dict[str, Margin]:
    """Compute the oil flow of each hydraulic joint, and of all of them together.

    A drive displaces at least the ratio of its torque limit to the supply's pressure per radian; with losses, more.
    """
    motion, limits = simulation.motion, simulation.embodiment.limits
    actuation = robot if isinstance(robot, str) else robot.actuation
    pressure = None if isinstance(actuation, str | PID) else actuation.supply_pressure
    if pressure is None:
        reason = (
            robot if isinstance(robot, str) else "the robot's description gives no supply pressure to compute it from"
        )
        return {
            name: Margin("l/min", required=asked, unknown=() if asked is None else names, reason=reason)
            for name, asked, names in (
                ("flow", demands.flow, simulation.embodiment.joint_names),
                ("pump_flow", demands.pump_flow, ("pump",)),
            )
        }
    flow = _LITRES_PER_MINUTE * np.abs(motion["joint_velocity"]) * limits.torque / pressure
    whole = flow.sum(axis=1)
    peaks = dict(zip(simulation.embodiment.joint_names, flow.max(axis=0).tolist(), strict=True))
    return {
        "flow": _most("l/min", peaks, demands.flow),
        "pump_flow": _most(
            "l/min", {"pump": float(whole.max())}, demands.pump_flow, more={"mean": float(whole.mean())}
        ),
    }


def _curves(simulation: RecordedSimulation, robot: Robot | str) -> Mapping[int, TorqueCurve] | str:
    """Return the linkage's curves of the motion's file, otherwise of the robot's description, or say why there are none."""
    own = simulation.embodiment.limits.torque_curves
    if own:
        return own
    return robot if isinstance(robot, str) else robot.curves or "the robot has no linkage"


def _description(simulation: RecordedSimulation) -> Robot | str:
    """Load the robot from its present description, or say why that is not possible."""
    try:
        robot = replace(simulation.task.robot, linkage=False).load()
    except LevadeError as error:
        return f"the robot's description cannot be read: {error}"
    if robot.joint_names != simulation.embodiment.joint_names:
        return "the robot's description has other joints than the motion"
    return robot


def _energy(power: Array, timestep: float) -> dict[str, float]:
    """Sum power [W], shape (steps, joints), over the robot and time [W, J]; braking joints recover nothing."""
    whole = np.maximum(power, 0.0).sum(axis=1)
    return {
        "robot_peak": float(whole.max()),
        "robot_mean": float(whole.mean()),
        "energy": float(whole.sum() * timestep),
    }


def _contacts(simulation: RecordedSimulation, demands: Demands) -> dict[str, Margin]:
    """Measure forces on the feet, their impacts, and self-collisions."""
    feet = simulation.embodiment.feet
    weight = float(simulation.model.body_mass.sum()) * GRAVITY
    centres, collisions, normals = poses(simulation)
    force = scene_forces(simulation, normals)
    bearing = force > 0
    mean = force.sum(axis=0) / np.maximum(bearing.sum(axis=0), 1)
    foot_force = _most(
        "robot weights",
        dict(zip(feet, (force.max(axis=0) / weight).tolist(), strict=True)),
        demands.foot_force,
        more={
            "peak_N": dict(zip(feet, force.max(axis=0).tolist(), strict=True)),
            "mean_N": dict(zip(feet, mean.tolist(), strict=True)),
            "robot_weight_N": weight,
        },
    )
    landed = landings(simulation, centres, normals, force)
    hardest = {foot: max((one.speed for one in landed if one.foot == foot), default=None) for foot in feet}
    impact = _most(
        "m/s",
        {foot: speed for foot, speed in hardest.items() if speed is not None},
        demands.impact_speed,
        more={"landings": [asdict(one) for one in landed]},
    )
    touching = _most(
        "m",
        {" and ".join(one.bodies): one.depth for one in collisions},
        demands.self_collision,
        more={"collisions": [asdict(one) for one in collisions]},
    )
    return {"foot_force": foot_force, "impact_speed": impact, "self_collision": touching}


def _impacts(simulation: RecordedSimulation, demands: Demands) -> dict[str, Margin]:
    """Measure forces and impacts of any part of the robot, by a replay in MuJoCo, and the trunk's recorded acceleration."""
    weight = float(simulation.model.body_mass.sum()) * GRAVITY
    bodies = simulation.engine.bodies
    forces = simulation.rollout(record=bodies).body_contact_force
    if set(forces) == set(bodies):
        part = _most(
            "robot weights",
            {body: float(force.max() / weight) for body, force in forces.items()},
            demands.part_force,
            more={"robot_weight_N": weight},
        )
    else:
        part = Margin("robot weights", required=demands.part_force, reason="the motion's model does not measure it")
    velocity = simulation.motion["trunk_linear_velocity"]
    change = np.linalg.norm(np.diff(velocity, axis=0), axis=-1).max(initial=0.0) / simulation.timestep
    trunk = {simulation.embodiment.trunk: float(change / GRAVITY)}
    return {
        "part_force": part,
        **_collisions(simulation, weight, demands),
        "trunk_acceleration": _most("g", trunk, demands.trunk_acceleration),
    }


def _collisions(simulation: RecordedSimulation, weight: float, demands: Demands) -> dict[str, Margin]:
    """Measure how fast parts meet the scene and each other, and the forces of parts on each other."""
    contacts = replay_contacts(simulation)
    hardest = contacts.hardest()

    def impacts(scene: bool) -> dict[str, Any]:
        return {"impacts": [asdict(one) for one in contacts.impacts if (one.bodies[1] == SCENE) == scene]}

    return {
        "part_impact_speed": _most(
            "m/s",
            {one: speed for (one, other), speed in hardest.items() if other == SCENE},
            demands.part_impact_speed,
            more=impacts(scene=True),
        ),
        "self_force": _most(
            "robot weights",
            {" and ".join(pair): force / weight for pair, force in contacts.forces.items()},
            demands.self_force,
            more={"peak_N": {" and ".join(pair): force for pair, force in contacts.forces.items()}},
        ),
        "self_impact_speed": _most(
            "m/s",
            {" and ".join(pair): speed for pair, speed in hardest.items() if pair[1] != SCENE},
            demands.self_impact_speed,
            more=impacts(scene=False),
        ),
    }
