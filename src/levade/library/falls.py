"""The falls of a family, each with an objective, on one simulation: their roll-outs share batches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np

from levade.arrays import Array
from levade.engines import Fallen, Fold, Perturbation, State, perturbed_models, start_state
from levade.engines.folding import fold_posture, folded
from levade.errors import LevadeError
from levade.feedback import up_in_trunk
from levade.library.mirror import Mirror
from levade.library.records import fall_of, motion_path
from levade.motions import Motion
from levade.policies import FreePolicy, JointPolicy
from levade.robots import Robot, dimensions
from levade.search.evaluation import Evaluation, Mask, Trials
from levade.search.objective import AT_ONCE, Objective, Simulation, evaluate_many
from levade.tasks import StartChoice, Task

FACES = ("tail", "nose", "right", "left", "belly", "back")
"""What a robot lies on where up is most along x, -x, y, -y, z, -z of its trunk; on its belly, or on its feet."""

_TAG = 1_818_845_550
"""Keeps perturbed models apart from those of searches and checks of motions."""


class Falls:
    """A task from each fall of a family.

    Attributes:
        task: The task, from the first fall of the family.
        simulation: What all of them are simulated in.
        fold: Where its joints go first, before anything is asked [rad], shape (joints,); None if nowhere.
        mirror: Of the robot, if its sides are alike, and so are the scene's and the policy's.
    """

    def __init__(self, task: Task, *, robot: Robot | None = None, seed: int = 0, threads: int = 0) -> None:
        """Build the simulation.

        Args:
            task: The task. Its family of falls is that of its start, if it has one; else falls from the robot's own height,
                after which it draws its legs in.
            robot: The robot, instead of the one that the task names.
            seed: Which family.
            threads: Engine threads; 0 for one per core.

        Raises:
            LevadeError: If the task does not fit together.
        """
        if task.robust is not None or task.hardware is not None:
            raise LevadeError("library: it is built on the nominal model; leave robust and hardware out of the task")
        robot = robot or task.robot.load()
        fallen = task.start.fallen or _usual(task, robot)
        self._fallen = replace(fallen, seed=seed, index=0)
        self.task = replace(task, start=StartChoice(fallen=self._fallen))
        self.simulation = Simulation.of(self.task, robot=robot, threads=threads)
        self.fold = None if fallen.fold is None else fold_posture(robot, fallen.fold)
        self.mirror = None if task.scene.boxes or task.scene.terrain else self._mirror()

    def _mirror(self) -> Mirror | None:
        mirror, policy = Mirror.of(self.simulation.robot), self.from_state(self.simulation.start).policy
        anything = np.random.default_rng(0).standard_normal((1, policy.size))
        return None if mirror is None or mirror.decisions(policy, anything) is None else mirror

    def objective(self, index: int) -> Objective:
        """The task from one of the falls."""
        start = StartChoice(fallen=replace(self._fallen, index=index))
        engine, robot = self.simulation.engine, self.simulation.robot
        state = start_state(engine, robot, self.task.scene, start.choice)
        return Objective(self.simulation.starting(state), replace(self.task, start=start))

    def folded(self, state: State) -> State:
        """How a robot lies once it has done what it does first, after a fall or a failure."""
        if self.fold is None or self._fallen.fold is None:
            return state
        return folded(self.simulation.engine, state, self.fold, self._fallen.fold)

    def from_state(self, state: State) -> Objective:
        """The task from a state that is none of the falls."""
        return Objective(self.simulation.starting(state), self.task)

    def sensed(self, state: State) -> tuple[Array, Array]:
        """What a robot at rest senses: which way is up in trunk axes, shape (3,), and its joint angles [rad]."""
        quaternion = state.qpos[0, self.simulation.engine.layout.trunk_quaternion]
        return up_in_trunk(quaternion), state.joint_position[0].copy()


def _usual(task: Task, robot: Robot) -> Fallen:
    """Falls from the robot's own height, after which it draws its legs in, if they are such legs."""
    fallen = Fallen(dimensions(robot).height)
    if task.physics.engine != "mujoco":
        return fallen
    try:
        fold_posture(robot, fold := Fold())
    except LevadeError:
        fold = Fold("neutral")
    return replace(fallen, fold=fold)


def face(up: Array) -> str:
    """What a robot lies on, one of `FACES`.

    Args:
        up: Which way is up, in trunk axes, shape (3,).
    """
    axis = int(np.argmax(np.abs(up)))
    return FACES[2 * axis + int(up[axis] < 0)]


@dataclass(frozen=True, eq=False)
class Play:
    """A motion to play, or its image in a mirror."""

    motion: Motion
    mirror: Mirror | None = None

    def decisions(self, policy: JointPolicy) -> Array:
        """Its weights for a policy that differs from the motion's own in nothing but where it starts, shape (1, d)."""
        motion = self.motion
        weights = motion["weights"][None]
        if isinstance(policy, FreePolicy):
            own = motion.policy
            goal = None if policy.goal is None or own is None or own.ends is None else own.ends.goal
            weights = policy.decision(weights, steps=motion.horizon_steps, goal=goal)
        if self.mirror is None:
            return weights
        image = self.mirror.decisions(policy, weights)
        assert image is not None  # else the library would be without a mirror
        return image


class Playable(Protocol):
    """What can be played from a fall: a motion, or weights."""

    def decisions(self, policy: JointPolicy) -> Array:
        """Its weights for a policy, shape (1, d)."""
        ...


class Plays:
    """What there is to play in a library, by number (`levade.library.records`); each motion is read once."""

    def __init__(self, directory: Path, mirror: Mirror | None) -> None:
        self._directory, self._mirror = directory, mirror
        self._motions: dict[int, Motion] = {}

    def __getitem__(self, number: int) -> Play:
        fall = fall_of(number)
        if fall not in self._motions:
            self._motions[fall] = Motion.load(motion_path(self._directory, fall))
        return Play(self._motions[fall], None if number == fall else self._mirror)


def tried_on_others(
    objective: Objective, plays: Mapping[int, Playable], perturbation: Perturbation, *, seed: tuple[int, ...]
) -> Mask:
    """Play motions from one fall, each on another robot that differs from the model.

    Args:
        objective: The task from that fall.
        plays: Number of a robot -> what to play. What a number's robot is does not depend on the others.
        perturbation: How far robots differ.
        seed: Seed of how they do.

    Returns:
        Which work, shape (plays,).
    """
    engine, policy, hold = objective.engine, objective.policy, objective.task.hold_steps
    numbers = np.array(list(plays), dtype=int)
    drawn = perturbation.draw(engine.model, engine.embodiment.joints, n=int(numbers.max()) + 1, seed=(*seed, _TAG))
    works = np.zeros(len(plays), dtype=bool)
    for first in range(0, len(plays), AT_ONCE):
        rows = slice(first, first + AT_ONCE)
        sample = drawn[numbers[rows].tolist()]
        starts, models = perturbed_models(engine.model, engine.layout, sample, objective.state)
        weights = np.concatenate([plays[int(number)].decisions(policy) for number in numbers[rows]])
        # until the first reference arrives, the joints have what they were commanded last
        reference = replace(policy.reference(weights, hold_steps=hold), before=objective.state.joint_reference[0])
        trajectories = engine.rollout(starts, reference, models=models, record=objective.recorded)
        works[rows] = objective.judge(trajectories, hold, perturbed=True).success
    return works


def tried(objectives: Sequence[Objective], plays: Sequence[Sequence[Playable]]) -> list[Evaluation]:
    """Play motions from falls, in common batches: for each objective its own, on the nominal model."""
    asked = []
    for objective, own in zip(objectives, plays, strict=True):
        weights = np.concatenate([play.decisions(objective.policy) for play in own])
        asked.append((objective, Trials(weights, objective.task.hold_steps)))
    return evaluate_many(asked)
