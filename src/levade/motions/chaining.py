"""Chain motions: start one where another ends, and play several as one.

    task = after(load_task("squat-jump"), righting)             # its start is the end of another motion
    start, reference = chain([righting, jump])                  # for one roll-out of both

The end of a motion is moved to the world's origin, heading along x. So the next task's goals keep their meaning.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from levade.costs.orientation import wrap
from levade.engines import GivenState, MujocoEngine, State
from levade.errors import LevadeError
from levade.motions.motion import Motion
from levade.motions.simulation import RecordedSimulation
from levade.rotations import multiply, roll_pitch_yaw, rotate
from levade.tasks import StartChoice, Task
from levade.trajectory import JointReference

_APART = {"a joint": (0.05, "rad"), "height": (0.02, "m"), "attitude": (0.05, "rad")}
"""Largest differences between the last row of a motion and the first row of the next: more than any joint or trunk moves in
one time step."""


def end_of(motion: Motion) -> GivenState:
    """Simulate a motion to its end, including the hold, and move the robot to the origin, heading along x.

    Args:
        motion: The motion.

    Returns:
        The state at the end.

    Raises:
        LevadeError: If another engine than MuJoCo made it, it breaks down, or its model or task is damaged.
    """
    if motion.provenance.engine != MujocoEngine.name:
        raise LevadeError(
            f"the motion was made by the engine {motion.provenance.engine}; only those of mujoco can be gone on from"
        )
    simulation = RecordedSimulation(motion)
    engine, layout = simulation.engine, simulation.layout
    assert isinstance(engine, MujocoEngine)
    out, diverged = engine.states(simulation.start, simulation.reference, ["qpos", "qvel", "act"])
    if diverged[0]:
        raise LevadeError("the motion breaks down before its end; nothing can begin there")
    qpos, qvel, act = (out[name][0, -1].copy() for name in ("qpos", "qvel", "act"))
    root, rate = layout.root_qpos, layout.root_qvel
    yaw = float(roll_pitch_yaw(qpos[root + 3 : root + 7])[2])
    back = np.array([np.cos(yaw / 2), 0.0, 0.0, -np.sin(yaw / 2)])
    qpos[root : root + 2] = 0.0
    qpos[root + 3 : root + 7] = multiply(back, qpos[root + 3 : root + 7])
    qvel[rate : rate + 3] = rotate(back, qvel[rate : rate + 3])
    commanded = simulation.reference.position[0, -1]
    return GivenState(*(tuple(map(float, values)) for values in (qpos, qvel, act, commanded)))


def after(task: Task, motion: Motion) -> Task:
    """Return the task with the end of a motion as its start.

    Args:
        task: The task.
        motion: The motion after which it begins.

    Returns:
        The task with its new start.

    Raises:
        LevadeError: If the motion is of another robot, or has no such end: see `end_of`.
    """
    before, name = motion.task.robot.name, task.robot.name
    if Path(before).name != Path(name).name:  # the same file may have several paths
        raise LevadeError(f"the motion is of {before} and the task of {name}; should be the same robot")
    return replace(task, start=StartChoice(state=end_of(motion)))


def chain(motions: Sequence[Motion]) -> tuple[State, JointReference]:
    """Chain several motions of one robot. Their stabilisers are left out.

    Args:
        motions: The motions, in order.

    Returns:
        The start of the first, and the references of all as one.

    Raises:
        LevadeError: If there are none, their joints or time steps differ, or one does not begin where the last one ends.
    """
    if not motions:
        raise LevadeError("chain: there are no motions")
    first = motions[0]
    for number, (last, motion) in enumerate(pairwise(motions), start=2):
        if (motion.joint_names, motion.timestep) != (first.joint_names, first.timestep):
            raise LevadeError(
                f"chain: a motion of {motion.robot} at {motion.timestep} s goes with one of {first.robot} at"
                f" {first.timestep} s; all should be of one robot and time step"
            )
        _check_follows(last, motion, number)
    position = np.concatenate([motion.reference.position for motion in motions], axis=1)
    velocity = np.concatenate([motion.reference.velocity for motion in motions], axis=1)
    reference = JointReference(position, velocity, first.timestep, position.shape[1], first.reference.before)
    return RecordedSimulation(first).start, reference


def _check_follows(last: Motion, motion: Motion, number: int) -> None:
    """Check that a motion begins where the last one ends, up to the way of one time step."""
    ends, begins = (
        {"a joint": one["joint_position"][row], "height": one["trunk_position"][row, 2:], "attitude": leaning}
        for one, row in ((last, -1), (motion, 0))
        for leaning in [roll_pitch_yaw(one["trunk_quaternion"][row])[:2]]
    )
    for name, (most, unit) in _APART.items():
        apart = float(np.abs(wrap(begins[name] - ends[name])).max())
        if apart > most:
            raise LevadeError(
                f"chain: motion {number}, {motion.task_name}, does not begin where {last.task_name} ends: {name} is"
                f" {apart:.2g} {unit} away; search for it after that motion"
            )
