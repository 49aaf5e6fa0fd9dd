"""Falls of one family. Each has its own objective, and all share one simulation, so that roll-outs share batches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

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
"""What a robot lies on if up is mostly along x, -x, y, -y, z, -z of its trunk. "belly" includes standing on the feet."""

_TAG = 1_818_845_550
"""Part of a seed, so that perturbed models differ from those of searches and of checks of motions."""


class Falls:
    """Poses a task from each fall of a family.

    Attributes:
        task: The task, from the first fall of the family.
        simulation: The simulation that all falls share.
        fold: Joint angles to which the robot folds up first [rad], shape (joints,). None if it does not fold up.
        mirror: Mirror of the robot. None unless robot, scene and policy are all symmetric.
    """

    def __init__(self, task: Task, *, robot: Robot | None = None, seed: int = 0, threads: int = 0) -> None:
        """Build the simulation.

        Args:
            task: The task. Its start gives the family of falls. Without one, the robot falls from its own height and then
                draws its legs in.
            robot: The robot. Defaults to the one that the task names.
            seed: Seed of the family.
            threads: Number of engine threads (0: one per core).

        Raises:
            LevadeError: If the task is not consistent.
        """
        if task.robust is not None or task.hardware is not None:
            raise LevadeError(
                "library: a library is built on the nominal model; remove robust and hardware from the task"
            )
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
        """Return the task from one of the falls.

        Args:
            index: Index of the fall in its family.
        """
        start = StartChoice(fallen=replace(self._fallen, index=index))
        engine, robot = self.simulation.engine, self.simulation.robot
        state = start_state(engine, robot, self.task.scene, start.choice)
        return Objective(self.simulation.starting(state), replace(self.task, start=start))

    def folded(self, state: State) -> State:
        """Simulate folding up, which the robot does first after a fall or a failure.

        Args:
            state: State after the fall.

        Returns:
            State after folding up; unchanged if the robot does not fold up.
        """
        if self.fold is None or self._fallen.fold is None:
            return state
        return folded(self.simulation.engine, state, self.fold, self._fallen.fold)

    def from_state(self, state: State) -> Objective:
        """Return the task from a state that is not one of the falls.

        Args:
            state: The state.
        """
        return Objective(self.simulation.starting(state), self.task)

    def sensed(self, state: State) -> tuple[Array, Array]:
        """Return what a robot at rest senses.

        Args:
            state: State of the robot.

        Returns:
            Upward direction in trunk axes, shape (3,), and joint angles [rad], shape (joints,).
        """
        quaternion = state.qpos[0, self.simulation.engine.layout.trunk_quaternion]
        return up_in_trunk(quaternion), state.joint_position[0].copy()


def _usual(task: Task, robot: Robot) -> Fallen:
    """Return the default family: falls from the robot's own height, after which it draws its legs in if it can."""
    fallen = Fallen(dimensions(robot).height)
    if task.physics.engine != "mujoco":
        return fallen
    try:
        fold_posture(robot, fold := Fold())
    except LevadeError:
        fold = Fold("neutral")
    return replace(fallen, fold=fold)


def lying_on(up: Array) -> NDArray[np.intp]:
    """Find what a robot lies on.

    Args:
        up: Upward directions in trunk axes, shape (..., 3).

    Returns:
        Indices into `FACES`, shape (...).
    """
    axis = np.argmax(np.abs(up), axis=-1)
    return 2 * axis + (np.take_along_axis(up, axis[..., None], axis=-1)[..., 0] < 0)


def face(up: Array) -> str:
    """Name what a robot lies on.

    Args:
        up: Upward direction in trunk axes, shape (3,).

    Returns:
        One of `FACES`.
    """
    return FACES[int(lying_on(up))]


@dataclass(frozen=True, eq=False)
class Play:
    """Holds a motion to play, or its mirror image.

    Attributes:
        motion: The motion.
        mirror: The mirror in which its image is played. None to play the motion itself.
    """

    motion: Motion
    mirror: Mirror | None = None

    def decisions(self, policy: JointPolicy) -> Array:
        """Convert the motion to weights of a policy that differs from the motion's own only in its start.

        Args:
            policy: The policy.

        Returns:
            Weights, shape (1, d).
        """
        motion = self.motion
        weights = motion["weights"][None]
        if isinstance(policy, FreePolicy):
            own = motion.policy
            goal = None if policy.goal is None or own is None or own.ends is None else own.ends.goal
            weights = policy.decision(weights, steps=motion.horizon_steps, goal=goal)
        if self.mirror is None:
            return weights
        image = self.mirror.decisions(policy, weights)
        assert image is not None  # otherwise the library would have no mirror
        return image


class Playable(Protocol):
    """Can be played from a fall: a motion, or weights."""

    def decisions(self, policy: JointPolicy) -> Array:
        """Return the weights for a policy.

        Args:
            policy: The policy.

        Returns:
            Weights, shape (1, d).
        """
        ...


class Plays:
    """Maps numbers of motions (`levade.library.records`) to motions to play; reads each file once."""

    def __init__(self, directory: Path, mirror: Mirror | None) -> None:
        self._directory, self._mirror = directory, mirror
        self._motions: dict[int, Motion] = {}

    def learn(self, motions: Mapping[int, Motion]) -> None:
        """Take note of motions, instead of reading them.

        Args:
            motions: Number of a fall -> its motion.
        """
        self._motions.update(motions)

    def __getitem__(self, number: int) -> Play:
        fall = fall_of(number)
        if fall not in self._motions:
            self._motions[fall] = Motion.load(motion_path(self._directory, fall))
        return Play(self._motions[fall], None if number == fall else self._mirror)


def tried_on_others(
    objective: Objective, plays: Mapping[int, Playable], perturbation: Perturbation, *, seed: tuple[int, ...]
) -> Mask:
    """Play motions from one fall, each on another perturbed model.

    Args:
        objective: The task from that fall.
        plays: Number of a perturbed model -> what to play. A model depends on its own number only.
        perturbation: How far the models differ from the nominal one.
        seed: Seed of the perturbed models.

    Returns:
        Whether each one works, shape (plays,).
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
        # until the first reference arrives, the joints keep their last command
        reference = replace(policy.reference(weights, hold_steps=hold), before=objective.state.joint_reference[0])
        trajectories = engine.rollout(starts, reference, models=models, record=objective.recorded)
        works[rows] = objective.judge(trajectories, hold, perturbed=True).success
    return works


def tried(objectives: Sequence[Objective], plays: Sequence[Sequence[Playable]]) -> list[Evaluation]:
    """Play motions from falls in shared batches, on the nominal model.

    Args:
        objectives: The task from each fall.
        plays: What to play from each fall.

    Returns:
        One evaluation per fall.
    """
    asked = []
    for objective, own in zip(objectives, plays, strict=True):
        weights = np.concatenate([play.decisions(objective.policy) for play in own])
        asked.append((objective, Trials(weights, objective.task.hold_steps)))
    return evaluate_many(asked)
