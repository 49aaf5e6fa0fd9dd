"""Robots and tasks as a page shows them: a scene that stands still, what is known about it, and for a robot its joints.

    robot_data(load_robot("hyq2max"))       # JSON: web/src/view.js draws it
    task_data(make_objective(load_task("rearing")))

The scene is that of `levade.report.scene` with one pose. ``tree``: how bodies hang together, so that the page can pose the
robot by itself: of each body its parent, place in the scene's bodies (-1 if it has no shape), pos [m] and quat x-y-z-w in
the parent, and its hinges: joint (place in the robot's order), anchor [m] and axis in the body, angle [rad] that the model
has at zero.
"""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import Posture
from levade.costs.quantities import unit_of
from levade.errors import LevadeError
from levade.report.packing import pack, pack_unit
from levade.report.scene import body_poses, goal_box, goal_text, put_together
from levade.report.shapes import moving_bodies, shapes_of
from levade.report.style import leg_places
from levade.report.summary import WHEN
from levade.robots import Leg, Robot, builtin_robots, dimensions, mirror_signs
from levade.robots.addresses import Addresses
from levade.rotations import rotate
from levade.scenes import Scene, compose
from levade.search import Objective
from levade.tasks import is_unchanged, task_to_dict, task_to_yaml
from levade.tasks.policy import goal_posture
from levade.version import __version__

_GROUPS = {
    "pairs": "a policy for each pair of legs",
    "sides": "a policy for each side",
    "all": "one policy for all legs",
    "independent": "a policy for each leg",
}

_ROOM = 1.4
"""Room around a robot, as a factor, because its legs can reach further than when it stands."""


def robot_data(robot: Robot) -> dict[str, Any]:
    """Describe a robot for its page, in its neutral posture on level ground.

    Args:
        robot: The robot.

    Returns:
        The description, as JSON.
    """
    model = mujoco.MjModel.from_xml_string(compose(robot, Scene()).to_xml(), dict(robot.assets))
    qpos = _configuration(
        model, robot, [0.0, 0.0, robot.neutral_height], [1.0, 0.0, 0.0, 0.0], robot.postures["neutral"]
    )
    shapes = shapes_of(model)
    layers = [("robot", "robot", True)]
    scene = put_together(robot.name, robot.legs, shapes, _moving(model, qpos), _with_collision(layers, shapes))
    scene["motion"]["feet"] = _feet(model, robot)
    scene["camera"]["margin"] = _ROOM
    return {
        "what": "robot",
        "name": robot.name,
        "description": robot.description,
        "scene": scene,
        "joints": _joints(robot),
        "together": _together(robot),
        "tree": _tree(model, robot),
        "trunk": {"position": qpos[Addresses.of(model, robot.trunk, robot.joint_names).trunk_position].tolist()},
        "postures": {name: np.round(angles, 6).tolist() for name, angles in robot.postures.items()},
        "facts": [
            ["Mass", f"{robot.mass:.4g} kg"],
            ["Trunk", f"{robot.trunk}, {robot.model.body_mass[list(robot.trunk_parts)].sum():.4g} kg"],
            ["Legs", f"{len(robot.legs)}, {len(robot.joint_names)} joints"],
            ["Trunk's centre of mass, standing", f"{dimensions(robot).height:.3f} m high"],
            ["Actuation", robot.actuation.name],
            *([] if robot.name in dict(builtin_robots()) else [["Described in", robot.source]]),
        ],
        "written_by": f"levade {__version__}",
    }


def task_data(objective: Objective) -> dict[str, Any]:
    """Describe a task for its page: the start, the scene, and the goal of robot and trunk.

    Args:
        objective: The task's objective, with its robot, engine and start.

    Returns:
        The description, as JSON.
    """
    task, robot, model = objective.task, objective.robot, objective.engine.model
    qpos = objective.state.qpos[0]
    shapes = shapes_of(model)
    moving = _moving(model, qpos)
    at = objective.engine.layout
    position, quaternion = qpos[at.trunk_position], qpos[at.trunk_quaternion]
    com = position + rotate(quaternion, robot.trunk_com_offset)
    criteria = task_to_dict(task, code=True)["success"]
    moving["goal"] = goal_box(model, robot.trunk, robot.trunk_com_offset, task.success, com, quaternion)
    layers = [("robot", "robot at the start", True)]
    ghost = _ghost(objective, model, moving["goal"], qpos)
    if ghost is not None:
        moving["reference"], label = ghost
        layers.append(("reference", label, True))
    if moving["goal"]:
        layers.append(("goal", f"goal ({goal_text(moving['goal']['quantities'])})", True))
    scene = put_together(robot.name, robot.legs, shapes, moving, _with_collision(layers, shapes))
    if task.scene.boxes and np.mean([box.position[1] for box in task.scene.boxes]) > position[1]:
        scene["camera"]["azimuth"] = -scene["camera"]["azimuth"]  # from the left: what is there is not behind the robot
    known = is_unchanged(task)
    return {
        "what": "task",
        "name": task.name,
        "description": task.description,
        "scene": scene,
        "criteria": [{"name": name, **_goal_row(criterion)} for name, criterion in criteria.items()],
        "costs": [
            {
                "name": name,
                "weight": cost.weight,
                "stages": [stage.weights.get(name, cost.weight) for stage in task.stages],
            }
            for name, cost in task.costs.items()
        ],
        "stages": [
            {"name": stage.name, "trials": stage.trials, "promote": dict(stage.promote)} for stage in task.stages
        ],
        "facts": _task_facts(objective),
        "command": shlex.join(["levade", "solve", task.name if known else "task.yaml", "--watch"]),
        "yaml": task_to_yaml(task),
        "written_by": f"levade {__version__}",
    }


def _configuration(model: Any, robot: Robot, position: Any, quaternion: Any, angles: Array) -> Array:
    """Return qpos, shape (nq,), of a trunk frame at a position [m] and quaternion w-x-y-z, with joint angles [rad]."""
    qpos = model.qpos0.copy()
    at = Addresses.of(model, robot.trunk, robot.joint_names)
    qpos[at.trunk_pose] = [*position, *quaternion]
    qpos[at.joint_qpos] = angles
    return qpos


def _moving(model: Any, qpos: Array) -> dict[str, Any]:
    position, quaternion = body_poses(model, qpos[None])
    still = {"time": pack([0.0]), "horizon": 0.0, "position": pack(position), "quaternion": pack_unit(quaternion)}
    return {**still, "reference": None, "path": None, "forces": None, "goal": None}


def _with_collision(layers: list[tuple[str, str, bool]], shapes: Mapping[str, Any]) -> list[dict[str, Any]]:
    if any(geom["layer"] == "collision" for geom in shapes["geoms"]):
        layers = [*layers, ("collision", "collision shapes", False)]
    return [{"name": name, "label": label, "shown": shown} for name, label, shown in layers]


def _joints(robot: Robot) -> list[dict[str, Any]]:
    limits, places = robot.limits, leg_places(robot.legs)

    def bound(value: float) -> float | None:
        return float(value) if math.isfinite(value) else None

    return [
        {
            "name": joint,
            "leg": leg.name,
            "colour": places[leg.name],
            "lower": bound(limits.lower[i]),
            "upper": bound(limits.upper[i]),
            "velocity": bound(limits.velocity[i]),
            "torque": bound(limits.torque[i]),
        }
        for leg in robot.legs
        for i, joint in zip(
            range(robot.joint_indices(leg).start, robot.joint_indices(leg).stop), leg.joints, strict=True
        )
    ]


def _together(robot: Robot) -> list[dict[str, Any]]:
    """List ways to move several legs together, as mirror images: a label, and the group and sign of each joint."""
    ways: list[dict[str, Any]] = []
    for label, key in (("left and right", lambda leg: leg.kind + leg.end), ("all legs", lambda leg: leg.kind)):
        leaders: dict[str, Leg] = {}
        joints: list[list[Any]] = []
        try:
            for leg in robot.legs:
                leader = leaders.setdefault(key(leg), leg)
                signs = mirror_signs(robot, leader, leg)
                joints += [[f"{leader.name} {depth}", float(sign)] for depth, sign in enumerate(signs)]
        except LevadeError:  # legs that are no mirror images move alone
            continue
        if len(leaders) < len(robot.legs):
            ways.append({"label": label, "joints": joints})
    return ways


def _tree(model: Any, robot: Robot) -> list[dict[str, Any]]:
    places = {body: place for place, body in enumerate(moving_bodies(model))}
    names = {int(model.joint(name).id): i for i, name in enumerate(robot.joint_names)}
    tree = []
    for body in range(1, model.nbody):
        first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        hinges = [
            {
                "joint": names[joint],
                "anchor": model.jnt_pos[joint].tolist(),
                "axis": model.jnt_axis[joint].tolist(),
                "zero": float(model.qpos0[model.jnt_qposadr[joint]]),
            }
            for joint in range(first, first + count)
            if joint in names
        ]
        tree.append(
            {
                "name": model.body(body).name,
                "parent": int(model.body_parentid[body]) - 1,
                "place": places.get(body, -1),
                "trunk": model.body(body).name == robot.trunk,
                "pos": model.body_pos[body].tolist(),
                "quat": np.roll(model.body_quat[body], -1).tolist(),
                "hinges": hinges,
            }
        )
    return tree


def _feet(model: Any, robot: Robot) -> list[dict[str, Any]]:
    """Describe each foot where the robot stands.

    Returns:
        For each foot: its leg and name, the place of its body, its centre in it [m], and how far it reaches down from
        there [m].
    """
    places = {body: place for place, body in enumerate(moving_bodies(model))}
    neutral = robot.postures["neutral"]
    down = robot.foot_depths(neutral) + robot.foot_positions(neutral)[:, 2]
    feet = []
    for number, leg in enumerate(robot.standing):
        geom = model.geom(leg.foot)
        feet.append(
            {
                "leg": leg.name,
                "name": leg.foot,
                "body": places[int(geom.bodyid[0])],
                "centre": geom.pos.tolist(),
                "down": float(down[number]),
            }
        )
    return feet


def _ghost(
    objective: Objective, model: Any, goal: Mapping[str, Any] | None, qpos: Array
) -> tuple[dict[str, Any], str] | None:
    """Return the robot in its goal, or only its trunk if the goal leaves the joints free, and a name for it."""
    task, robot = objective.task, objective.robot
    at = objective.engine.layout
    position, quaternion = qpos[at.trunk_position], qpos[at.trunk_quaternion]
    if goal is not None:
        quaternion = np.roll(goal["quaternion"], 1)
        position = np.array(goal["centre"]) - rotate(quaternion, robot.trunk_com_offset)
    now = qpos[at.joint_qpos]
    required = [cost.term.position for cost in task.costs.values() if isinstance(cost.term, Posture)]
    angles = None
    if required:
        angles = np.array([free if wanted is None else wanted for wanted, free in zip(required[0], now, strict=True)])
    elif task.policy.initial == "interpolate":
        angles = goal_posture(task.policy, robot)
    if angles is None and goal is None:
        return None
    whole = angles is not None
    wanted = _configuration(model, robot, position, quaternion, now if angles is None else angles)
    poses, turned = body_poses(model, wanted[None])
    bodies, trunk = moving_bodies(model), model.body(robot.trunk).id
    shown = [place for place, body in enumerate(bodies) if whole or model.body_weldid[body] == model.body_weldid[trunk]]
    ghost = {"bodies": shown, "position": pack(poses[:, shown]), "quaternion": pack_unit(turned[:, shown])}
    return ghost, "goal posture" if whole else "trunk at the goal"


def _goal_row(criterion: Mapping[str, Any]) -> dict[str, Any]:
    bounds = {key: criterion[key] for key in ("target", "tolerance", "minimum", "maximum")}
    return {
        **bounds,
        "quantity": criterion["quantity"],
        "unit": unit_of(criterion["quantity"]),
        "when": WHEN[criterion["at"]],
    }


def _task_facts(objective: Objective) -> list[list[str]]:
    task, robot = objective.task, objective.robot
    start = "settled on its feet" if task.start.settled else "as given" if task.start.state else "as a fall left it"
    groups = _GROUPS.get(str(task.policy.groups), "groups of legs")
    scene = ", ".join(
        [
            *([f"slope {math.degrees(task.scene.slope):.3g}°"] if task.scene.slope else []),
            *([f"friction {task.scene.friction:.3g}"] if task.scene.friction else []),
            *([f"{len(task.scene.boxes)} box{'es' * (len(task.scene.boxes) > 1)}"] if task.scene.boxes else []),
        ]
    )
    horizon = f"{task.horizon:g} s" if isinstance(task.horizon, float) else f"{task.horizon}, found by the search"
    return [
        ["Robot", robot.name + (f", {robot.variant}" if robot.variant else "")],
        ["Horizon", horizon + (f", then {task.hold:g} s of hold" if task.hold else "")],
        ["Start", start],
        ["Scene", scene or "level ground"],
        ["Policy", f"{objective.policy.size} weights: {task.policy.kernels} kernels a joint, {groups}"],
        ["Search", f"{task.search.optimizer}, up to {task.search.trials} trials"],
    ]
