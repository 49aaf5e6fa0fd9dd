"""The motion that is checked: what its file says, put together to be simulated again."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import cached_property

import mujoco
import numpy as np

from levade.arrays import Array
from levade.costs import Criterion
from levade.engines import MujocoEngine, State
from levade.errors import LevadeError
from levade.motion import Motion
from levade.replay import embodiment
from levade.robots import Robot, load_robot
from levade.tasks import Task, task_from_dict
from levade.tasks.policy import make_policy
from levade.trajectory import JointReference


class Subject:
    """A motion, by its file alone; only references at other time steps, and a linkage, come from the robot's description,
    where it can still be found.

    criteria: what success means; those of the motion's own task if None. threads: 0 for one per core.
    """

    def __init__(self, motion: Motion, *, criteria: Mapping[str, Criterion] | None = None, threads: int = 0) -> None:
        self.motion, self.threads = motion, threads
        self.task: Task = task_from_dict(motion.meta["task"], where="the motion's task")
        self.criteria = dict(self.task.success if criteria is None else criteria)
        self.model = motion.compiled()
        self.embodiment = embodiment(motion, self.model)
        self.timestep = float(motion.meta["timestep"])
        self.layout = self.engine.layout

    @property
    def joints(self) -> int:
        return self.embodiment.joints

    @cached_property
    def engine(self) -> MujocoEngine:
        """MuJoCo with the motion's model, whichever engine made the motion."""
        motion, physics = self.motion, replace(self.task.physics, engine="mujoco", timestep=self.timestep)
        return MujocoEngine(
            motion.model_xml, motion.assets, self.embodiment, physics, threads=self.threads, model=self.model
        )

    @cached_property
    def start(self) -> State:
        """Where the motion starts, one row."""
        motion = self.motion
        told = motion.arrays.get("joint_position_reference0")
        return self.layout.state(motion["qpos0"], motion["qvel0"], motion["act0"], joint_reference=told)

    def model_copy(self) -> mujoco.MjModel:
        """The motion's model, to be changed."""
        return copy.deepcopy(self.model)

    @cached_property
    def reference(self) -> JointReference:
        """What the motion asks of the joints, of one trial."""
        motion = self.motion
        return JointReference(
            motion["joint_position_reference"][None],
            motion["joint_velocity_reference"][None],
            self.timestep,
            motion.horizon_steps,
            motion.arrays.get("joint_position_reference0"),
        )

    @cached_property
    def robot(self) -> Robot | None:
        """The robot's description, if it is there and its joints are those of the motion."""
        choice = asdict(self.task.robot)
        try:
            robot = load_robot(choice.pop("name"), **choice)
        except LevadeError:
            return None
        return robot if robot.joint_names == self.embodiment.joint_names else None

    def reference_at(self, parts: int) -> tuple[JointReference, str]:
        """The reference at steps shorter by a whole factor, and where it comes from: "policy", or "interpolation".

        The policy is evaluated anew at the shorter steps. Where it is not at hand, or is not what made the motion, its file's
        rows are joined by cubics that have the references' own velocities.
        """
        if parts == 1:
            return self.reference, "policy"
        # whole steps of the file: a horizon that is rounded to other steps would be another one
        rows = self.motion.horizon_steps
        task = replace(
            self.task,
            physics=replace(self.task.physics, timestep=self.timestep / parts),
            horizon=rows * self.timestep,
            hold=(self.reference.steps - rows) * self.timestep,
        )
        if self.robot is not None:
            before, weights = self.reference.before, self.motion["weights"][None]
            coarse = make_policy(self.task, self.robot, start=before).reference(weights)
            if np.array_equal(coarse.position, self.reference.position):
                fine = make_policy(task, self.robot, start=before).reference(weights)
                return replace(fine, before=before), "policy"
        return interpolated(self.reference, parts), "interpolation"


def interpolated(reference: JointReference, parts: int) -> JointReference:
    """The reference at steps shorter by a whole factor: cubic Hermite polynomials through its rows and their velocities.

    The first row is at the end of the first step; before it, the first polynomial goes on backwards. The hold is held.
    """
    rows, step = reference.horizon_steps, reference.timestep
    position, velocity = reference.position[:, :rows], reference.velocity[:, :rows]
    time = np.arange(1, rows * parts + 1) / parts - 1.0  # in old steps, 0 at the first row
    left = np.clip(np.floor(time - 1e-9).astype(int), 0, max(rows - 2, 0))
    right = np.minimum(left + 1, rows - 1)
    t = (time - left)[None, :, None]
    p0, p1 = position[:, left], position[:, right]
    m0, m1 = velocity[:, left] * step, velocity[:, right] * step
    at = (2 * t**3 - 3 * t**2 + 1) * p0 + (t**3 - 2 * t**2 + t) * m0 + (-2 * t**3 + 3 * t**2) * p1 + (t**3 - t**2) * m1
    rate = (6 * t**2 - 6 * t) * (p0 - p1) + (3 * t**2 - 4 * t + 1) * m0 + (3 * t**2 - 2 * t) * m1
    hold: tuple[Array, ...] = tuple(
        np.repeat(a[:, rows:], parts, axis=1) for a in (reference.position, reference.velocity)
    )
    return JointReference(
        np.concatenate([at, hold[0]], axis=1),
        np.concatenate([rate / step, hold[1]], axis=1),
        step / parts,
        rows * parts,
        reference.before,
    )
