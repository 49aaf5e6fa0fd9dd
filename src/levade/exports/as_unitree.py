"""Export ``unitree``: position, velocity, feed-forward torque, kp and kd of each motor, as in Unitree's low-level commands.

The order is that of ``LowCmd.motor_cmd`` in Unitree's SDKs. For quadrupeds (``LegID`` in unitree_sdk2_python's
unitree_legged_const.py) it is FR_0 to FR_2, FL, RR, RL, each hip, thigh, calf. For G1 with 29 joints (``G1JointIndex`` in its
example/g1/low_level/g1_low_level_example.py) it is left leg, right leg, waist, left arm, right arm. The field names q, dq,
tau, kp, kd and the 500 Hz are also Unitree's.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.exports import as_csv
from levade.exports.content import Content, held
from levade.motions import Motion

RATE = 500.0
"""Rows per second [Hz]."""

LEGS = {"FR": ("front", "right"), "FL": ("front", "left"), "RR": ("hind", "right"), "RL": ("hind", "left")}
AXES = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
"""Axes of hip, thigh and calf in the trunk frame at angle zero: on all legs Unitree's joints turn about x, y, y."""
_LEG = ("HipPitch", "HipRoll", "HipYaw", "Knee", "AnklePitch", "AnkleRoll")
_WAIST = ("WaistYaw", "WaistRoll", "WaistPitch")
_ARM = ("ShoulderPitch", "ShoulderRoll", "ShoulderYaw", "Elbow", "WristRoll", "WristPitch", "WristYaw")
G1 = (
    *(side + part for side in ("Left", "Right") for part in _LEG),
    *_WAIST,
    *(side + part for side in ("Left", "Right") for part in _ARM),
)
"""Motors of G1 with 29 joints, in the order of their indices."""
HELD_KP, HELD_KD = {"WaistYaw": 60.0}, 1.0
"""Stiffness of held motors [Nm/rad], 40 for the others, and damping [Nm s/rad], as in Unitree's own example."""


def motors(motion: Motion) -> dict[str, str]:
    """Map each motor to a joint, in Unitree's order.

    Args:
        motion: The motion.

    Returns:
        Motor -> joint.

    Raises:
        LevadeError: If the robot has neither four legs of three joints nor the joints of G1.
    """
    if len([leg for leg in motion.legs if leg.stands]) == 2:
        return _of_g1(motion)
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


def _of_g1(motion: Motion) -> dict[str, str]:
    """Map each motor of G1 to a joint, including joints that are held."""
    order = {motor: re.sub(r"(?<=.)(?=[A-Z])", "_", motor).lower() + "_joint" for motor in G1}
    there = {*motion.joint_names, *held(motion)}
    missing = [joint for joint in order.values() if joint not in there]
    if missing:
        raise LevadeError(
            f"unitree: {motion.robot} has no {missing[0]}; of robots on two legs, this format is for G1 with 29 joints; take"
            " csv or json",
            field="to",
        )
    return order


def write(content: Content, directory: Path) -> list[str]:
    """Write unitree.csv, and motion.csv with meta.json and player.py, all in Unitree's order and under its names.

    Held joints have no columns in motion.csv, as in other formats; unitree.csv has all motors.

    Args:
        content: What is exported.
        directory: Directory to write into; it exists.

    Returns:
        Notes for the user, such as where the robot differs from Unitree's.

    Raises:
        LevadeError: If the robot's joints do not fit Unitree's motors: see `motors`.
    """
    order = motors(content.motion)
    names, still = content.samples.joints.names, held(content.motion)
    moved = [motor for motor, joint in order.items() if joint in names]
    index = [names.index(order[motor]) for motor in moved]
    samples = content.samples.reordered(index, moved)
    feedback = None if content.feedback is None else content.feedback.reordered(index)
    table: dict[str, Array] = {"time": samples.time}
    for motor, joint in order.items():
        if motor not in moved:
            fixed = {"q": still[joint], "dq": 0.0, "tau": 0.0, "kp": HELD_KP.get(motor, 40.0), "kd": HELD_KD}
            table |= {f"{motor}/{name}": np.full(len(samples.time), value) for name, value in fixed.items()}
            continue
        i = moved.index(motor)
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
    if list(order) == list(G1):
        return _notes_on_g1(content.motion, [motor for motor in order if motor not in moved])
    return _notes(content.model, order, content.motion)


def _notes_on_g1(motion: Motion, fixed: list[str]) -> list[str]:
    """Say what a program for G1 has to do that one for Unitree's quadrupeds need not."""
    notes = [
        "G1 takes messages of unitree_hg: copy mode_machine from its LowState, set mode_pr 0 (ankles by pitch and roll), mode 1"
        " of each motor, and the CRC"
    ]
    if fixed:
        notes.append(f"{', '.join(fixed)} stay where {motion.robot} holds them, with the gains of Unitree's example")
    return notes


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
