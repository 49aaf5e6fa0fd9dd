"""Check that a robot's legs are long enough, and its parts far enough apart, for a task."""

from __future__ import annotations

import itertools
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import Position
from levade.engines import Settled
from levade.engines.clearance import clearance_in, self_contacts
from levade.errors import LevadeError
from levade.robots import Leg, Robot
from levade.tasks.task import Task

_ROOM = 0.01
"""[m]: soft joint limits and contacts yield by less."""


def check_reach(task: Task, robot: Robot, model: Any) -> None:
    """Check that the trunk can be as high as the task asks while a foot is on the ground.

    The highest place of the trunk's centre of mass is above the highest place of the scene, by the longest leg plus the
    distance from its hip to the centre of mass. A jump goes higher: criteria with ``at: max`` are exempt, and so are costs of
    tasks that have one. Slopes have no highest place and are not checked.

    Args:
        task: The task.
        robot: The robot.
        model: Compiled MuJoCo model of the robot and the scene.

    Raises:
        LevadeError: If a criterion on the height, or a weighted cost on the position's z, asks for more.
    """
    if task.scene.slope:
        return
    leg, hip = max((_reaches(robot, leg) for leg in robot.standing), key=sum)
    ground = _highest(model)
    highest = ground + leg + hip
    heights = {name: criterion for name, criterion in task.success.items() if criterion.quantity == "height"}
    asked: list[tuple[str, float]] = []
    for name, criterion in heights.items():
        least = criterion.minimum if criterion.target is None else criterion.target - (criterion.tolerance or 0.0)
        if criterion.at != "max" and least is not None:
            key = "minimum" if criterion.target is None else "target"
            asked.append((f"success.{name}.{key}", least))
    if not any(criterion.at == "max" for criterion in heights.values()):
        for name, cost in task.costs.items():
            weighed = cost.weight or any(stage.weights.get(name) for stage in task.stages)
            if isinstance(cost.term, Position) and cost.term.z is not None and weighed:
                asked.append((f"costs.{name}.z", cost.term.z - cost.term.tolerance))
    for where, height in asked:
        if height > highest + _ROOM:
            scene = f", {ground:.2f} m of the scene" if ground else ""
            raise LevadeError(
                f"{where}: asks for {height:.2f} m, but the trunk's centre of mass of {robot.name} is at {highest:.2f} m at"
                f" most with a foot on the ground (leg {leg:.2f} m, hip to centre of mass {hip:.2f} m{scene}); ask for less,"
                " such as 1.3 heights, or for a jump, by a criterion with at: max"
            )


def check_clearance(task: Task, robot: Robot, model: Any) -> None:
    """Check that the robot's parts are as far apart as the task asks, in the neutral posture and in the one at the start.

    Args:
        task: The task.
        robot: The robot.
        model: Compiled MuJoCo model of the robot and the scene.

    Raises:
        LevadeError: If a criterion asks for more distance than a posture leaves.
    """
    if clearance_in(model) is None:
        return
    start = task.start.choice
    postures = {"neutral": "neutral"} | ({"start": start.posture} if isinstance(start, Settled) else {})
    for name, criterion in task.success.items():
        if criterion.quantity != "self_distance":
            continue
        least = criterion.minimum if criterion.target is None else criterion.target - (criterion.tolerance or 0.0)
        for what, posture in postures.items():
            nearest, bodies = _nearest(robot, model, robot.posture(posture))
            if least is not None and nearest < least:
                key = "minimum" if criterion.target is None else "target"
                raise LevadeError(
                    f"success.{name}.{key}: asks for {1e3 * least:.3g} mm between the parts of {robot.name}, but"
                    f" {' and '.join(bodies)} are {1e3 * nearest:.3g} mm apart in the {what} posture; ask for less"
                )


def _nearest(robot: Robot, model: Any, posture: Array) -> tuple[float, tuple[str, ...]]:
    """Find the least distance [m] between parts of the robot in a posture, and their names; infinite if none is near."""
    data = mujoco.MjData(model)
    for joint, angle in zip(robot.joint_names, posture, strict=True):
        data.joint(joint).qpos[0] = angle
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    near = ((distance, (one, other)) for one, other, distance in self_contacts(model, data))
    distance, pair = min(near, default=(np.inf, ()))
    return distance, tuple(model.body(body).name for body in pair)


def _reaches(robot: Robot, leg: Leg) -> tuple[float, float]:
    """Measure a leg from hip to sole [m], and the distance from its hip to the trunk's centre of mass [m]."""
    geometry = next(shape for shape in robot.leg_geometry if shape.name == leg.name)
    chain = [*geometry.anchors, geometry.foot]
    links = sum(float(np.linalg.norm(far - near)) for near, far in itertools.pairwise(chain))
    return links + geometry.sole, float(np.linalg.norm(geometry.anchors[0] - robot.trunk_com_offset))


def _highest(model: Any) -> float:
    """Find the height of the scene's highest point [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    fixed = (model.geom_bodyid == 0) & (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE)
    up: Array = data.geom_xmat.reshape(-1, 3, 3)[fixed, 2]
    centre, half = model.geom_aabb[fixed, :3], model.geom_aabb[fixed, 3:]
    tops = data.geom_xpos[fixed, 2] + (up * centre).sum(axis=1) + (np.abs(up) * half).sum(axis=1)
    return max(0.0, float(tops.max())) if len(tops) else 0.0
