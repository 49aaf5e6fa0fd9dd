"""Margins: how much slack a motion leaves to each limit of the hardware, computed from the motion's arrays."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.checks.contacts import landings, poses, scene_forces
from levade.checks.drives import (
    current_margin,
    find_winding,
    flow_margins,
    linkage_margin,
    present_robot,
    temperature_margin,
)
from levade.checks.impacts import SCENE, replay_contacts
from levade.checks.slack import Margin, least_margin, most_margin, share_left
from levade.motions import RecordedSimulation
from levade.robots.winding import Winding
from levade.tasks import Demands

GRAVITY = 9.81
"""[m/s2], for forces in weights of the robot."""


def margins(simulation: RecordedSimulation, demands: Demands) -> dict[str, Margin]:
    """Compute the slack of a motion to every kind of limit.

    Args:
        simulation: The motion.
        demands: Thresholds that the margins are compared with.

    Returns:
        Kind of limit -> margin.
    """
    motion, limits = simulation.motion, simulation.embodiment.limits
    joints, robot = simulation.embodiment.joint_names, present_robot(simulation)
    winding = find_winding(robot)
    angle, speed, torque = (motion[f"joint_{name}"] for name in ("position", "velocity", "torque"))
    power, energy = np.abs(torque * speed), _energy(torque * speed, simulation.timestep)
    heated = {}
    if isinstance(winding, Winding) and winding.resistance is not None:
        electrical = np.maximum(torque * speed, 0.0) + winding.heat(torque)
        heated = {"with_winding_heat": float(electrical.sum(axis=1).max())}
    at_limit = (np.abs(torque) >= limits.torque * (1 - 1e-9)).mean(axis=0)
    found = {
        "position": least_margin("rad", joints, limits.angle_left(angle).min(axis=0), demands.position),
        "speed": least_margin(
            "share of limit",
            joints,
            share_left(np.abs(speed).max(axis=0), limits.velocity),
            demands.speed,
            assumed=limits.assumed_velocity,
        ),
        "torque": least_margin(
            "share of limit",
            joints,
            share_left(np.abs(torque).max(axis=0), limits.torque),
            demands.torque,
            assumed=limits.assumed_torque,
            more={"time_at_limit": dict(zip(joints, at_limit.tolist(), strict=True))},
        ),
        "torque_speed": _torque_speed(simulation, demands.torque_speed),
        "linkage": linkage_margin(simulation, robot, demands.linkage),
        "power": most_margin(
            "W",
            dict(zip(joints, power.max(axis=0).tolist(), strict=True)),
            demands.power,
            more=energy,
        ),
        "robot_power": most_margin("W", {"robot": energy["robot_peak"]}, demands.robot_power, more=heated),
        "torque_rms": least_margin(
            "share of limit",
            joints,
            share_left(np.sqrt(np.square(torque).mean(axis=0)), limits.torque),
            demands.torque_rms,
            assumed=limits.assumed_torque,
        ),
        "current": current_margin(simulation, winding, demands.current),
        "winding_temperature": temperature_margin(simulation, winding, demands.winding_temperature),
    }
    return (
        found
        | flow_margins(simulation, robot, demands)
        | _contacts(simulation, demands)
        | _impacts(simulation, demands)
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
    return least_margin(
        "share of stall torque",
        joints,
        left,
        required,
        assumed=sorted({*limits.assumed_velocity, *limits.assumed_torque}),
        reason="the actuators have no torque-speed line",
    )


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
    foot_force = most_margin(
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
    impact = most_margin(
        "m/s",
        {foot: speed for foot, speed in hardest.items() if speed is not None},
        demands.impact_speed,
        more={"landings": [asdict(one) for one in landed]},
    )
    touching = most_margin(
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
        part = most_margin(
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
        "trunk_acceleration": most_margin("g", trunk, demands.trunk_acceleration),
    }


def _collisions(simulation: RecordedSimulation, weight: float, demands: Demands) -> dict[str, Margin]:
    """Measure how fast parts meet the scene and each other, and the forces of parts on each other."""
    contacts = replay_contacts(simulation)
    hardest = contacts.hardest()

    def impacts(scene: bool) -> dict[str, Any]:
        return {"impacts": [asdict(one) for one in contacts.impacts if (one.bodies[1] == SCENE) == scene]}

    return {
        "part_impact_speed": most_margin(
            "m/s",
            {one: speed for (one, other), speed in hardest.items() if other == SCENE},
            demands.part_impact_speed,
            more=impacts(scene=True),
        ),
        "self_force": most_margin(
            "robot weights",
            {" and ".join(pair): force / weight for pair, force in contacts.forces.items()},
            demands.self_force,
            more={"peak_N": {" and ".join(pair): force for pair, force in contacts.forces.items()}},
        ),
        "self_impact_speed": most_margin(
            "m/s",
            {" and ".join(pair): speed for pair, speed in hardest.items() if pair[1] != SCENE},
            demands.self_impact_speed,
            more=impacts(scene=False),
        ),
    }
