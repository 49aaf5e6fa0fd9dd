"""Export ``unitree``: position, velocity, feed-forward torque, kp and kd of each motor, as in Unitree's low-level commands.

The order is that of ``LowCmd.motor_cmd`` in Unitree's SDKs (``LegID`` in unitree_sdk2_python's unitree_legged_const.py): FR_0
to FR_2, FL, RR, RL, each hip, thigh, calf. The field names q, dq, tau, kp, kd and the 500 Hz are also Unitree's.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.exports import as_csv
from levade.exports.content import Content
from levade.motions import Motion

RATE = 500.0
"""Rows per second [Hz]."""

LEGS = {"FR": ("front", "right"), "FL": ("front", "left"), "RR": ("hind", "right"), "RL": ("hind", "left")}
AXES = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
"""Axes of hip, thigh and calf in the trunk frame at angle zero: on all legs Unitree's joints turn about x, y, y."""


def motors(motion: Motion) -> dict[str, str]:
    """Map each motor to a joint, in Unitree's order.

    Args:
        motion: The motion.

    Returns:
        Motor -> joint.

    Raises:
        LevadeError: If the robot does not have four legs of three joints.
    """
    order: dict[str, str] = {}
    for leg in motion.legs:
        if len(leg.joints) != 3:
            raise LevadeError(
                f"unitree: leg {leg.name} of {motion.robot} has {len(leg.joints)} joints; Unitree's legs have"
                " three (hip, thigh, calf); take csv or json",
                field="to",
            )
    for place, (end, side) in LEGS.items():
        fitting = [leg for leg in motion.legs if (leg.end, leg.side) == (end, side)]
        if len(fitting) != 1:
            raise LevadeError(
                f"unitree: {motion.robot} has {len(fitting)} {end} {side} legs; Unitree's robots have one;"
                " take csv or json",
                field="to",
            )
        order |= {f"{place}_{i}": joint for i, joint in enumerate(fitting[0].joints)}
    return order


def write(content: Content, directory: Path) -> list[str]:
    """Write unitree.csv, and motion.csv with meta.json and player.py, all in Unitree's order and under its names."""
    order = motors(content.motion)
    names = content.samples.joints.names
    index = [names.index(joint) for joint in order.values()]
    samples = content.samples.reordered(index, list(order))
    feedback = None if content.feedback is None else content.feedback.reordered(index)
    table: dict[str, Array] = {"time": samples.time}
    for i, motor in enumerate(order):
        table[f"{motor}/q"] = samples.command_position[:, i]
        table[f"{motor}/dq"] = samples.command_velocity[:, i]
        table[f"{motor}/tau"] = samples.command_torque[:, i]
        table[f"{motor}/kp"] = np.full(len(samples.time), samples.joints.kp[i])
        table[f"{motor}/kd"] = np.full(len(samples.time), samples.joints.kd[i])
    as_csv.write_table(directory / "unitree.csv", table)
    provenance = content.provenance | {"motors": order}
    as_csv.write(
        replace(content, samples=samples, playing=samples, provenance=provenance, feedback=feedback), directory
    )
    return _notes(content.model, order, content.motion)


def _notes(model: mujoco.MjModel, order: Mapping[str, str], motion: Motion) -> list[str]:
    data = mujoco.MjData(model)
    data.qpos[:] = 0.0
    data.qpos[motion.addresses(model).root_qpos + 3] = 1.0
    mujoco.mj_kinematics(model, data)
    other = [joint for k, joint in enumerate(order.values()) if data.joint(joint).xaxis @ AXES[k % 3] < 0.999]
    what = [f"{', '.join(other)} do not turn about the axes of Unitree's joints"] if other else []
    knees = [joint for k, joint in enumerate(order.values()) if k % 3 == 2]
    angle = dict(zip(motion.joint_names, motion["joint_position"].max(axis=0), strict=True))
    bent = [joint for joint in knees if angle[joint] > 0]
    what += [f"{', '.join(bent)} bend to positive angles, which Unitree's calves have not"] if bent else []
    if not what:
        return []
    return [
        f"of {motion.robot}, {' and '.join(what)}: the numbers are in its order, but the angles are this robot's, and"
        " would be another motion on a Unitree robot"
    ]
