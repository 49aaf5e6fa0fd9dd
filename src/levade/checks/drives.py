"""Margins of the drives that the robot's description knows and a motion file does not: linkages, windings, hydraulics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from levade.checks.slack import Margin, least_margin, most_margin, share_left
from levade.embodiment import TorqueCurve
from levade.errors import LevadeError
from levade.motions import RecordedSimulation
from levade.robots import PID, Robot
from levade.robots.winding import Winding
from levade.tasks import Demands

_LITRES_PER_MINUTE = 60e3
"""One cubic metre per second, in litres per minute."""


def present_robot(simulation: RecordedSimulation) -> Robot | str:
    """Load the robot from its present description, or say why that is not possible.

    Args:
        simulation: The motion.
    """
    try:
        robot = replace(simulation.task.robot, linkage=False).load()
    except LevadeError as error:
        return f"the robot's description cannot be read: {error}"
    if robot.joint_names != simulation.embodiment.joint_names:
        return "the robot's description has other joints than the motion"
    return robot


def linkage_margin(simulation: RecordedSimulation, robot: Robot | str, required: float | None) -> Margin:
    """Compute the slack to the torque that linkages transmit at their angle.

    Args:
        simulation: The motion.
        robot: The robot, or why its description cannot be read.
        required: Demanded slack. None if nothing is demanded.
    """
    motion, names = simulation.motion, simulation.embodiment.joint_names
    curves = _curves(simulation, robot)
    if isinstance(curves, str):
        return Margin("share of limit", required=required, reason=curves)
    limits = replace(simulation.embodiment.limits, torque_curves=curves)
    left = limits.linkage_left(motion["joint_position"], motion["joint_torque"]).min(axis=0)
    linked = sorted(curves)
    margin = least_margin("share of limit", tuple(names[joint] for joint in linked), left[linked], required)
    if simulation.task.robot.linkage:
        return margin
    return replace(margin, passed=None, reason="the task does not ask for the linkage (robot: {linkage: true})")


def find_winding(robot: Robot | str) -> Winding | str:
    """Return the windings that the robot's description gives, or say why there are none.

    Args:
        robot: The robot, or why its description cannot be read.
    """
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


def current_margin(simulation: RecordedSimulation, winding: Winding | str, required: float | None) -> Margin:
    """Compute the slack to the windings' current limits.

    Args:
        simulation: The motion.
        winding: The windings, or why they are not known.
        required: Demanded slack. None if nothing is demanded.
    """
    if isinstance(winding, str):
        return _without(simulation, winding, required)
    joints = simulation.embodiment.joint_names
    current = winding.currents(simulation.motion["joint_torque"])
    peak, rms = current.max(axis=0), np.sqrt(np.square(current).mean(axis=0))
    margin = least_margin(
        "share of limit",
        joints,
        share_left(peak, winding.current),
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


def temperature_margin(simulation: RecordedSimulation, winding: Winding | str, required: float | None) -> Margin:
    """Compute the slack to the highest temperature of windings, as a share of the rise from the ambient temperature.

    Args:
        simulation: The motion.
        winding: The windings, or why they are not known.
        required: Demanded slack. None if nothing is demanded.
    """
    if isinstance(winding, Winding) and winding.thermal is None:
        winding = "the robot's description does not say how its windings warm up; torque rms stands in for it"
    if isinstance(winding, str):
        return replace(_without(simulation, winding, required), unit="share of rise")
    joints, thermal, torque = simulation.embodiment.joint_names, winding.thermal, simulation.motion["joint_torque"]
    assert thermal is not None
    hottest = winding.temperatures(torque, simulation.timestep).max(axis=0)
    repeated = winding.repeated(torque)
    margin = least_margin(
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


def flow_margins(simulation: RecordedSimulation, robot: Robot | str, demands: Demands) -> dict[str, Margin]:
    """Compute the oil flow of each hydraulic joint, and of all of them together.

    A drive displaces at least the ratio of its torque limit to the supply's pressure per radian; with losses, more.

    Args:
        simulation: The motion.
        robot: The robot, or why its description cannot be read.
        demands: Thresholds that the flows are compared with.

    Returns:
        "flow" of the joints and "pump_flow" of all together [l/min].
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
        "flow": most_margin("l/min", peaks, demands.flow),
        "pump_flow": most_margin(
            "l/min", {"pump": float(whole.max())}, demands.pump_flow, more={"mean": float(whole.mean())}
        ),
    }


def _curves(simulation: RecordedSimulation, robot: Robot | str) -> Mapping[int, TorqueCurve] | str:
    """Return the linkage's curves of the motion's file, otherwise of the robot's description, or say why there are none."""
    own = simulation.embodiment.limits.torque_curves
    if own:
        return own
    return robot if isinstance(robot, str) else robot.curves or "the robot has no linkage"
