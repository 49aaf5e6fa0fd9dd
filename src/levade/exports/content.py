"""Content of an export before it has a format: samples, the model, and the provenance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco

from levade.exports.samples import Samples
from levade.feedback import Feedback, names
from levade.motions import Motion
from levade.motions.file import finite
from levade.tasks import task_to_dict

UNITS = {
    "time": "s",
    "position": "rad",
    "velocity": "rad/s",
    "torque": "Nm",
    "kp": "Nm/rad",
    "kd": "Nm s/rad",
    "trunk/position": "m",
    "trunk/com_position": "m",
    "trunk/quaternion": "trunk frame to world, w x y z",
    "trunk/linear_velocity": "m/s, of the trunk frame's origin, world axes",
    "trunk/angular_velocity": "rad/s, world axes",
    "contact_force": "N, on the foot, world axes, mean until the next row",
    "simulation/gravity": "m/s2, world axes",
    "simulation/joints/armature": "kg m2",
    "simulation/joints/damping": "Nm s/rad",
    "simulation/joints/friction": "Nm, dry",
    "simulation/joints/spring": "Nm/rad, rad",
    "simulation/joints/drive": "kp Nm/rad, kd Nm s/rad, torques Nm, no_load_speed rad/s, time_constant s",
    "simulation/shapes/friction": "coefficient of sliding friction",
    "simulation/start_depth": "m",
    "simulation/success": "m, rad, m/s, rad/s",
}


@dataclass(frozen=True, eq=False)
class Content:
    """Holds what an export writes.

    Attributes:
        motion: The motion.
        model: Its compiled model.
        samples: The motion at the required rate.
        playing: The motion at a rate that a robot can follow; mostly the same.
        provenance: Task, robot, scene, seed, versions, command.
        simulation: See `levade.exports.simulation`.
        feedback: The stabiliser. None if the rows have none.
    """

    motion: Motion
    model: mujoco.MjModel
    samples: Samples
    playing: Samples
    provenance: dict[str, Any]
    simulation: dict[str, Any]
    feedback: Feedback | None = None


def provenance(motion: Motion, command: str | None) -> dict[str, Any]:
    """Describe where a motion comes from, what it meets, and how well it does, as JSON.

    Args:
        motion: The motion.
        command: The command line that exports it. None if there is none.

    Returns:
        JSON. The scene is without the heights of a terrain, which are in the motion.
    """
    from levade.version import __version__

    scene = task_to_dict(motion.task, code=True)["scene"]
    if scene["terrain"]:  # its heights are in the motion
        scene["terrain"] = {name: value for name, value in scene["terrain"].items() if name != "heights"}
    return {
        "levade": __version__,
        "command": command,
        "task": motion.task_name,
        "robot": motion.robot,
        "seed": motion.provenance.seed,
        "success": motion.result.success,
        "errors": dict(motion.result.errors),
        "engine": motion.provenance.engine,
        "made_with": dict(motion.provenance.versions),
        "timestep": motion.timestep,
        "horizon": motion.horizon,
        "scene": scene,
    }


def surroundings(motion: Motion) -> str:
    """Describe what the motion meets besides flat ground, in words. Empty for nothing.

    Args:
        motion: The motion.

    Returns:
        Words such as "2 boxes and terrain", or an empty text.
    """
    scene = motion.task.scene
    count = lambda what, plural, items: [f"{len(items)} {what if len(items) == 1 else plural}"] * bool(items)  # noqa: E731
    parts = count("box", "boxes", scene.boxes) + count("gap", "gaps", scene.gaps)
    parts += ["terrain"] * (scene.terrain is not None)
    parts += [f"a slope of {scene.slope:g} rad"] * bool(scene.slope)
    return " and ".join(parts)


def held(motion: Motion) -> dict[str, float]:
    """Return joints that the simulation holds without a command -> their positions [rad], for slides [m].

    Args:
        motion: The motion.

    Returns:
        Name of the joint -> its position. Empty in files of early versions.
    """
    return dict(motion.held)


def describe(content: Content, samples: Samples) -> dict[str, Any]:
    """Describe a table of samples beyond its rows.

    Args:
        content: What is exported.
        samples: The rows: those of the content, or of its ``playing``.

    Returns:
        JSON. A limit is null if there is none.
    """
    feedback = content.feedback
    joints = samples.joints
    return {
        "provenance": content.provenance,
        "rate": samples.rate,
        "rows": len(samples.time),
        "duration": float(samples.time[-1]),
        "reference": samples.reference,
        "between_steps": "policy" if samples.analytic else "cubic",
        "joints": list(joints.names),
        "kp": joints.kp.tolist(),
        "kd": joints.kd.tolist(),
        "limits": {name: finite(getattr(joints, name)) for name in ("lower", "upper", "velocity", "torque")},
        "start": {"position": joints.start_position.tolist(), "torque": joints.start_torque.tolist()},
        "held": held(content.motion),
        "simulation": content.simulation,
        "units": UNITS,
        "feedback": None if feedback is None else _describe(feedback, joints.names),
    }


def _describe(feedback: Feedback, joints: tuple[str, ...]) -> dict[str, Any]:
    """Describe a stabiliser without its arrays, as JSON."""
    return {
        "rate": 1.0 / feedback.period,
        "latency": feedback.period,
        "bound": feedback.bound,
        "sensed": names(joints),
        "columns": [*names(joints), *(f"{joint}/correction" for joint in joints)],
    }
