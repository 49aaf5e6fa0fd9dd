"""Describe a motion for the page's 3D player, as one JSON object that is small enough for the page.

    scene = scene_data(motion)
    json.dumps(scene)                       # about 0.1 MB for a motion of 0.3 s
    scene["layers"]                         # [{"name": "path", "label": ..., "shown": True}, ...]

``model``: shapes (`levade.report.shapes`). ``motion``: poses of the bodies at ``time``, and overlays. ``palette``: colours of
both themes. Arrays are those of `levade.report.packing`, units SI, quaternions x-y-z-w. Poses are recorded rows, never
interpolated. The first is the start, and the horizon's and the last are always included.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import Criterion
from levade.motions import Motion, configurations
from levade.report.packing import pack, pack_unit
from levade.report.rendering import FIELD_OF_VIEW, Camera
from levade.report.shapes import moving_bodies, shapes_of
from levade.report.style import DARK, LIGHT, Theme, leg_colours
from levade.robots import Leg
from levade.rotations import roll_pitch_yaw

Rows = NDArray[np.int64]

RATE = 250.0
"""Largest number of poses per second [Hz]. The page interpolates between them."""

FRAMES = 3000
"""Largest number of poses."""

_ARROW = 0.22
"""Length of an arrow for the robot's weight, relative to the reach of its legs."""

_LONGEST = 0.8
"""Largest length of an arrow, relative to that reach. Larger forces, as in impacts of a step or two, get a second tip."""


def scene_data(
    motion: Motion, *, like: Mapping[str, Any] | None = None, model: Any = None, rate: float = RATE
) -> dict[str, Any]:
    """Describe a motion for the page.

    Args:
        motion: A motion.
        like: Description of another motion of the same model, whose shapes and colours are reused.
        model: The motion's compiled model, if it exists already.
        rate: Largest number of poses per second [Hz].

    Returns:
        The scene, as JSON.

    Raises:
        LevadeError: If the motion's model is damaged.
    """
    model = motion.compiled() if model is None else model
    rows = frame_rows(motion.steps, motion.horizon_steps, motion.timestep, rate)
    qpos = configurations(motion, model)[rows]
    position, quaternion = body_poses(model, qpos)
    shapes = shapes_of(model) if like is None else like["model"]
    moving: dict[str, Any] = {
        "time": pack(np.concatenate([[0.0], motion["time"]])[rows]),
        "horizon": motion.horizon,
        "position": pack(position),
        "quaternion": pack_unit(quaternion),
        "reference": _reference(motion, model, rows, qpos),
        "path": pack(_recorded(motion["trunk_com_position"], rows)),
        "forces": _forces(motion, model, rows),
        "goal": _goal(motion, model),
    }
    layers = _layers(shapes, moving)
    if like is not None:
        return {**like, "motion": moving, "layers": layers}
    return put_together(motion.robot, motion.legs, shapes, moving, layers)


def put_together(
    robot: str,
    legs: Iterable[Leg],
    shapes: Mapping[str, Any],
    moving: Mapping[str, Any],
    layers: list[dict[str, Any]],
) -> dict[str, Any]:
    """Assemble a scene from its parts.

    Args:
        robot: Name of the robot.
        legs: Legs of the robot, for the colours.
        shapes: The shapes, from `levade.report.shapes.shapes_of`.
        moving: What moves: poses of the bodies over time and what is drawn with them.
        layers: What can be shown and hidden.

    Returns:
        The scene, as JSON.
    """
    camera = Camera()
    return {
        "version": 1,
        "robot": robot,
        "model": shapes,
        "motion": moving,
        "layers": layers,
        "camera": {"azimuth": camera.azimuth, "elevation": camera.elevation, "fov": FIELD_OF_VIEW},
        "palette": {"light": _palette(legs, LIGHT), "dark": _palette(legs, DARK)},
    }


def frame_rows(steps: int, horizon_steps: int, timestep: float, rate: float = RATE) -> Rows:
    """Choose rows to show: evenly spaced, with horizon and end. Row 0 is the start.

    Args:
        steps: Number of time steps. There is one row more.
        horizon_steps: Number of time steps to the horizon.
        timestep: Time step [s].
        rate: Largest number of rows per second [Hz], apart from horizon and end.

    Returns:
        Increasing numbers of rows, shape (frames,).
    """
    stride = max(1, math.ceil(1.0 / (rate * timestep) - 1e-9), math.ceil(steps / FRAMES))
    return np.unique(np.concatenate([np.arange(0, steps + 1, stride), [min(horizon_steps, steps), steps]]))


def body_poses(model: Any, qpos: Array) -> tuple[Array, Array]:
    """Compute poses of moving bodies from qpos, shape (rows, nq).

    Args:
        model: The model.
        qpos: Configurations, shape (rows, nq).

    Returns:
        Positions [m], shape (rows, bodies, 3), and continuous quaternions x-y-z-w, shape (rows, bodies, 4).
    """
    bodies = moving_bodies(model)
    data = mujoco.MjData(model)
    position, quaternion = np.empty((len(qpos), len(bodies), 3)), np.empty((len(qpos), len(bodies), 4))
    for row, configuration in enumerate(qpos):
        data.qpos[:] = configuration
        mujoco.mj_kinematics(model, data)
        position[row], quaternion[row] = data.xpos[bodies], data.xquat[bodies]
    quaternion = np.roll(quaternion, -1, axis=-1)
    turned = np.sum(quaternion[1:] * quaternion[:-1], axis=-1) < 0.0
    quaternion[1:][np.logical_xor.accumulate(turned, axis=0)] *= -1.0
    return position, quaternion


def _recorded(values: Array, rows: Rows) -> Array:
    """Return rows of a quantity that is recorded at the end of each step. The start is like the first step. Never NaN."""
    return np.nan_to_num(values[np.maximum(rows - 1, 0)], posinf=0.0, neginf=0.0)


def _reference(motion: Motion, model: Any, rows: Rows, qpos: Array) -> dict[str, Any]:
    """Compute poses of the legs at the reference angles on the measured trunk: bodies (places), position, quaternion."""
    wanted = qpos.copy()
    wanted[:, motion.addresses(model).joint_qpos] = _recorded(motion["joint_position_reference"], rows)
    bodies, trunk = moving_bodies(model), model.body(motion.trunk).id
    legs = [place for place, body in enumerate(bodies) if model.body_weldid[body] != model.body_weldid[trunk]]
    position, quaternion = body_poses(model, wanted)
    return {"bodies": legs, "position": pack(position[:, legs]), "quaternion": pack_unit(quaternion[:, legs])}


def _forces(motion: Motion, model: Any, rows: Rows) -> dict[str, Any]:
    """Return the contact force on each foot [N], and its place: the foot's body, centre in it and radius [m], and leg."""
    places = {body: place for place, body in enumerate(moving_bodies(model))}
    feet = []
    for leg in motion.legs:
        geom = model.geom(leg.foot)
        radius = float(np.min(geom.size[geom.size > 0], initial=geom.rbound[0])) if len(geom.size) else 0.0
        feet.append(
            {
                "leg": leg.name,
                "body": places[int(geom.bodyid[0])],
                "centre": np.round(geom.pos, 6).tolist(),
                "radius": round(radius, 6),
            }
        )
    force = _recorded(motion["foot_contact_force"], rows)
    reach = _reach(model, motion)
    weight = 9.81 * float(model.body_mass.sum())
    scale, longest = force_scale(weight, _ARROW * reach), round(_LONGEST * reach, 3)
    beyond = bool(np.linalg.norm(force, axis=-1).max(initial=0.0) > scale * longest)
    return {"feet": feet, "force": pack(force), "scale": scale, "longest": longest, "beyond": beyond}


def force_scale(force: float, length: float) -> float:
    """Return the scale of arrows: a round number, with which a force is no longer than a length.

    Args:
        force: The force [N]. It counts as at least 1 N.
        length: Largest length of its arrow [m].

    Returns:
        The scale [N/m].
    """
    least = max(force, 1.0) / length
    decade = 10.0 ** math.floor(math.log10(least))
    return next(step * decade for step in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0) if step * decade >= least * (1 - 1e-9))


def _reach(model: Any, motion: Motion) -> float:
    """Return the distance from the trunk along its longest leg [m]."""
    trunk, reaches = model.body(motion.trunk).id, [0.1]
    for leg in motion.legs:
        geom = model.geom(leg.foot)
        body, reach = int(geom.bodyid[0]), float(np.linalg.norm(geom.pos))
        while body not in (0, trunk):
            reach += float(np.linalg.norm(model.body_pos[body]))
            body = int(model.body_parentid[body])
        reaches.append(reach)
    return max(reaches)


def _goal(motion: Motion, model: Any) -> dict[str, Any] | None:
    """Describe the trunk's goal at the horizon."""
    row = min(motion.horizon_steps, motion.steps) - 1
    return goal_box(
        model,
        motion.trunk,
        motion.embodiment.trunk_com_offset,
        motion.task.success,
        motion["trunk_com_position"][row],
        motion["trunk_quaternion"][row],
    )


def goal_box(
    model: Any, trunk: str, com_offset: Array, criteria: Mapping[str, Criterion], centre: Array, attitude: Array
) -> dict[str, Any] | None:
    """Return a box around the trunk where criteria require it at the horizon. None if they do not.

    Args:
        model: The model.
        trunk: Name of the trunk's body.
        com_offset: The trunk's centre of mass in its frame [m], shape (3,).
        criteria: Success criteria.
        centre: Centre of mass for free coordinates [m], shape (3,).
        attitude: Attitude of the trunk for free angles, w-x-y-z, shape (4,).

    Returns:
        The box, as JSON.
    """
    wanted = {}
    for criterion in criteria.values():
        if criterion.at == "horizon" and criterion.target is not None:
            wanted[criterion.quantity] = float(criterion.target)
    if not wanted.keys() & {"roll", "pitch", "yaw", "x", "y", "height"}:
        return None
    if not (np.isfinite(centre).all() and np.isfinite(attitude).all()):
        return None
    reached = roll_pitch_yaw(attitude)
    angles = [wanted.get(name, float(reached[axis])) for axis, name in enumerate(("roll", "pitch", "yaw"))]
    place = [wanted.get(name, float(centre[axis])) for axis, name in enumerate(("x", "y", "height"))]
    quaternion, frame = np.empty(4), np.empty(9)
    mujoco.mju_euler2Quat(quaternion, np.array(angles[::-1]), "zyx")
    mujoco.mju_quat2Mat(frame, quaternion)
    low, high = _trunk_box(model, trunk)
    offset = (low + high) / 2 - com_offset
    return {
        "centre": np.round(place, 6).tolist(),  # of mass
        "box": np.round(np.asarray(place) + frame.reshape(3, 3) @ offset, 6).tolist(),
        "half": np.round((high - low) / 2, 6).tolist(),
        "quaternion": np.round(np.roll(quaternion, -1), 7).tolist(),
        "quantities": wanted,
    }


def _trunk_box(model: Any, trunk: str) -> tuple[Array, Array]:
    """Return two corners, in the trunk's frame [m], of a box around the trunk's geoms."""
    geoms = np.flatnonzero(model.geom_bodyid == model.body(trunk).id)
    if not len(geoms):
        return np.full(3, -0.1), np.full(3, 0.1)
    frames = np.empty((len(geoms), 9))
    for frame, geom in zip(frames, geoms, strict=True):
        mujoco.mju_quat2Mat(frame, model.geom_quat[geom])
    frames = frames.reshape(-1, 3, 3)
    centre = model.geom_pos[geoms] + np.einsum("gij,gj->gi", frames, model.geom_aabb[geoms, :3])
    half = np.einsum("gij,gj->gi", np.abs(frames), model.geom_aabb[geoms, 3:])
    return (centre - half).min(axis=0), (centre + half).max(axis=0)


def _layers(shapes: Mapping[str, Any], moving: Mapping[str, Any]) -> list[dict[str, Any]]:
    """List what a reader can show or hide: name, label, and whether it is shown at first."""
    layers = [
        ("robot", "robot", True),
        ("reference", "reference", False),
        ("path", "path of the trunk", True),
        ("forces", _forces_text(moving["forces"]), True),
    ]
    if moving["goal"]:
        layers.append(("goal", f"goal ({goal_text(moving['goal']['quantities'])})", True))
    if any(geom["layer"] == "collision" for geom in shapes["geoms"]):
        layers.append(("collision", "collision shapes", False))
    return [{"name": name, "label": label, "shown": shown} for name, label, shown in layers]


def _forces_text(forces: Mapping[str, Any]) -> str:
    double = f"; double tip: over {forces['scale'] * forces['longest'] / 1000:.1f} kN" if forces["beyond"] else ""
    return f"contact forces (1 m = {forces['scale']:g} N{double})"


def goal_text(wanted: Mapping[str, float]) -> str:
    """Return a text such as "pitch -60°, height 0.9 m".

    Args:
        wanted: Quantity -> wanted value, in [rad] or [m]. Other quantities than angles, x, y and height are left out.

    Returns:
        The text. It is empty if nothing is left.
    """
    texts = []
    for name, value in wanted.items():
        angle = name in ("roll", "pitch", "yaw", "tilt")
        number = f"{math.degrees(value):.3g}" if angle else f"{value:.3g}"
        if angle or name in ("x", "y", "height"):
            texts.append(f"{name} {number.replace('-', chr(0x2212))}{'°' if angle else ' m'}")
    return ", ".join(texts)


def _palette(legs: Iterable[Leg], theme: Theme) -> dict[str, Any]:
    names = ("sky", "ground", "ground_line", "ghost", "goal", "limit", "accent", "muted")
    colours: dict[str, Any] = {name: getattr(theme, name) for name in names}
    return colours | {"legs": list(leg_colours(legs, theme).values())}
