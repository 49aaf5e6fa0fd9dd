"""Describe what another simulator needs besides URDF and motion: passive joints, drives, friction, contact pairs, the goal.

    facts = simulation(motion, motion.compiled())
    facts["joints"]["lf_haa"]["armature"], facts["shapes"][0]["friction"]["ground"]

All of it is JSON, with the robot's names. docs/export.md has the units.
"""

from __future__ import annotations

import itertools
from typing import Any

import mujoco
import numpy as np

from levade.engines.touching import friction_between, may_touch
from levade.exports.links import links_of
from levade.exports.model import drive_of
from levade.exports.urdf import shape_name
from levade.motions import Motion
from levade.motions.file import finite
from levade.tasks import task_to_dict


def simulation(motion: Motion, model: mujoco.MjModel) -> dict[str, Any]:
    """Describe the simulation of a motion.

    Args:
        motion: The motion.
        model: Its compiled model.

    Returns:
        JSON, with null for infinity.
    """
    return {
        "gravity": model.opt.gravity.tolist(),
        "joints": {joint: _joint(model, joint) for joint in motion.joint_names},
        "shapes": _shapes(motion, model),
        "never_touch": never_touch(model),
        "start_depth": start_depth(motion, model),
        "success": task_to_dict(motion.task, code=True)["success"],
    }


def _joint(model: mujoco.MjModel, name: str) -> dict[str, Any]:
    joint = model.joint(name)
    dof = int(joint.dofadr[0])
    drive = drive_of(model, name)
    spring = float(np.ravel(joint.stiffness)[0])
    return {
        "armature": float(model.dof_armature[dof]),
        "damping": float(model.dof_damping[dof]),
        "friction": float(model.dof_frictionloss[dof]),
        "spring": {"stiffness": spring, "position": float(model.qpos_spring[joint.qposadr[0]])} if spring else None,
        "drive": None
        if drive is None
        else {
            "kind": drive.kind,
            "kp": drive.kp,
            "kd": drive.kd,
            "torque": _or_null(drive.torque),
            "stall_torque": _or_null(drive.stall_torque),
            "no_load_speed": _or_null(drive.no_load_speed),
            "time_constant": drive.time_constant,
        },
    }


def _or_null(value: float) -> float | None:
    return finite(np.array([value]))[0]


def _colliding(model: mujoco.MjModel) -> list[int]:
    """List the shapes of robot and scene that collide with anything."""
    paired = {int(geom) for geom in (*model.pair_geom1, *model.pair_geom2)}
    masks = model.geom_contype | model.geom_conaffinity
    return [geom for geom in range(model.ngeom) if masks[geom] or geom in paired]


def _pairs(model: mujoco.MjModel) -> dict[frozenset[int], float]:
    """Map explicit pairs of geoms to their coefficient of sliding friction."""
    return {
        frozenset((int(model.pair_geom1[i]), int(model.pair_geom2[i]))): float(model.pair_friction[i, 0])
        if model.pair_dim[i] > 1
        else 0.0
        for i in range(model.npair)
    }


def _shapes(motion: Motion, model: mujoco.MjModel) -> list[dict[str, Any]]:
    """Describe each colliding shape of the robot: its own friction, and that with each part of the scene it may touch."""
    geoms, pairs = _colliding(model), _pairs(model)
    scene = [geom for geom in geoms if model.geom_bodyid[geom] == 0]
    links = {link.body: link.name for link in links_of(model) if link.body is not None}
    shapes = []
    for geom in geoms:
        if model.geom_bodyid[geom] == 0:
            continue
        friction = {
            model.geom(part).name: pairs.get(frozenset((geom, part)), friction_between(model, geom, part))
            for part in scene
            if may_touch(model, geom, part) or frozenset((geom, part)) in pairs
        }
        shapes.append(
            {
                "name": shape_name(model, geom),
                "link": links[int(model.geom_bodyid[geom])],
                "foot": model.geom(geom).name in motion.embodiment.feet,
                "friction": friction,
                "own_friction": float(model.geom_friction[geom, 0]) if model.geom_condim[geom] > 1 else 0.0,
                "priority": int(model.geom_priority[geom]),
                "solref": model.geom_solref[geom].tolist(),
                "solimp": model.geom_solimp[geom].tolist(),
            }
        )
    return shapes


def never_touch(model: mujoco.MjModel) -> list[list[str]]:
    """List pairs of links that have colliding shapes and pass through each other, by name, in the order of the links.

    They include links that are fixed to each other.

    Args:
        model: Robot and scene.

    Returns:
        Pairs of link names.
    """
    pairs = _pairs(model)
    shapes: dict[int, list[int]] = {}
    for geom in _colliding(model):
        if model.geom_bodyid[geom] != 0:
            shapes.setdefault(int(model.geom_bodyid[geom]), []).append(geom)
    names = {link.body: link.name for link in links_of(model)}
    return [
        [names[one], names[other]]
        for one, other in itertools.combinations(sorted(shapes), 2)
        if not any(
            may_touch(model, a, b) or frozenset((a, b)) in pairs
            for a, b in itertools.product(shapes[one], shapes[other])
        )
    ]


def start_depth(motion: Motion, model: mujoco.MjModel) -> dict[str, float]:
    """Map each foot to its depth in the scene at the start, 0 without contact. Soft contact lets feet sink in.

    Args:
        motion: The motion.
        model: Its compiled model.

    Returns:
        Name of the foot's geom -> depth [m].
    """
    data = mujoco.MjData(model)
    data.qpos[:] = motion["qpos0"]
    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)
    depth = dict.fromkeys(motion.embodiment.feet, 0.0)
    for contact in data.contact:
        on_scene = 0 in model.geom_bodyid[contact.geom]
        for geom in contact.geom:
            if on_scene and (name := model.geom(int(geom)).name) in depth:
                depth[name] = max(depth[name], -float(contact.dist))
    return depth
