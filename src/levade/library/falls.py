"""Falls of one family. Each has its own objective, and all share one simulation, so that roll-outs share batches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines import Fallen, Fold, Models, Perturbation, State, perturbed_models, start_state
from levade.engines.folding import Folding
from levade.errors import LevadeError
from levade.exports.asker import distances
from levade.feedback import up_in_trunk
from levade.hardware import Plan
from levade.library.mirror import Mirror
from levade.library.records import fall_of, motion_path
from levade.motions import Motion
from levade.policies import FreePolicy, JointPolicy
from levade.robots import Robot, dimensions
from levade.search.evaluation import Evaluation, Mask, Trials, joined
from levade.search.objective import AT_ONCE, Objective, Simulation, evaluate_many
from levade.search.outcome import Solution, Stopped, Trial
from levade.search.recording import record
from levade.tasks import Demands, PolicyChoice, StartChoice, Task

FACES = ("tail", "nose", "right", "left", "belly", "back")
"""What a robot lies on if up is mostly along x, -x, y, -y, z, -z of its trunk. "belly" includes standing on the feet."""

_TAG = 1_818_845_550
"""Part of a seed, so that perturbed models differ from those of searches and of checks of motions."""


_NEIGHBOURS, _NEAR = 47, 0.6
"""Number of other falls from which a robust motion of a fall has to work, too, and how far they may be from it [rad]."""

_DRAWN, _BEYOND = 128, 1_000_000_000
"""Most falls that are drawn to find them, and the number of the first."""


class Falls:
    """Poses a task from each fall of a family.

    Attributes:
        task: The task, from the first fall of the family.
        plan: The plan of searches for hardware. None for motions of the nominal model without regard to limits.
        judged: The task by which motions are judged. With a plan, its criteria include limits, and its duration is free.
        threads: Number of engine threads (0: one per core).
        simulation: The simulation that all falls share.
        folding: How the robot folds up first. None if it does not.
        mirror: Mirror of the robot. None unless robot, scene and policy are all symmetric.
    """

    def __init__(
        self,
        task: Task,
        *,
        robot: Robot | None = None,
        seed: int = 0,
        threads: int = 0,
        demands: Demands | None = None,
    ) -> None:
        """Build the simulation.

        Args:
            task: The task. Its start gives the family of falls. Without one, the robot falls from its own height and then
                draws its legs in.
            robot: The robot. Defaults to the one that the task names.
            seed: Seed of the family.
            threads: Number of engine threads (0: one per core).
            demands: Demands of the hardware on each motion. None for none.

        Raises:
            LevadeError: If the task is not consistent.
        """
        if task.robust is not None or task.hardware is not None:
            raise LevadeError(
                "library: remove robust and hardware from the task; a build for hardware keeps limits and perturbs by itself"
            )
        robot = robot or task.robot.load()
        fallen = task.start.fallen or _usual(task, robot)
        self.threads = threads
        self._fallen = replace(fallen, seed=seed, index=0)
        self.task = replace(task, start=StartChoice(fallen=self._fallen))
        self.plan = None if demands is None else Plan.of(self.task, robot, demands, feedback=False)
        if self.plan is not None and not self.plan.goal:
            raise LevadeError(f"hardware: the task {task.name} has no success criteria to certify; add some")
        self.judged = self.task if self.plan is None else self.plan.certifiable(self.plan.within_limits())
        self.simulation = Simulation.of(self.judged, robot=robot, threads=threads)
        self.folding = None if fallen.fold is None else Folding.of(robot, fallen.fold)
        self._others: list[State] = []
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
        start = self.task_from(index).start
        engine, robot = self.simulation.engine, self.simulation.robot
        state = start_state(engine, robot, self.task.scene, start.choice)
        return Objective(self.simulation.starting(state), replace(self.judged, start=start))

    def task_from(self, index: int) -> Task:
        """Return the task, as the user gave it, from one of the falls.

        Args:
            index: Index of the fall in its family.
        """
        return replace(self.task, start=StartChoice(fallen=replace(self._fallen, index=index)))

    def folded(self, state: State, models: Models | None = None) -> State:
        """Simulate folding up, which the robot does first after a fall or a failure.

        Args:
            state: State after the fall.
            models: Perturbed models, as many rows. None for the nominal one.

        Returns:
            State after folding up; unchanged if the robot does not fold up.
        """
        return state if self.folding is None else self.folding.folded(self.simulation.engine, state, models)

    @property
    def fold(self) -> Array | None:
        """Joint angles to which the robot folds up first [rad], shape (joints,). None if it does not fold up."""
        return None if self.folding is None else self.folding.posture

    def widened(self, objective: Objective) -> Objective:
        """Let perturbed models also start as the robot lies after other falls of the family nearby.

        These falls are numbered far beyond those of a library. If the robot does not fold up, there are none: each fall
        leaves the joints with other commands.

        Args:
            objective: The task from one fall.

        Returns:
            The task from that fall; a motion that is robust in this sense also works nearby.
        """
        state, near = objective.state, list[State]()
        if self.folding is not None:
            (up, joint_position), drawn = self.sensed(state), 0
            while len(near) < _NEIGHBOURS and drawn < _DRAWN:
                other = self._other(drawn)
                own = distances(*(part[None] for part in self.sensed(other)), up, joint_position)[0]
                if own < _NEAR and np.allclose(other.joint_reference, state.joint_reference):
                    near.append(other)
                drawn += 1
        return Objective(objective.simulation.starting(state, *near), objective.task)

    def _other(self, number: int) -> State:
        """Return how the robot lies after another fall, which no library has; simulate it once."""
        while len(self._others) <= number:
            self._others.append(self.objective(_BEYOND + len(self._others)).state)
        return self._others[number]

    def from_state(self, state: State) -> Objective:
        """Return the task from a state that is not one of the falls.

        Args:
            state: The state.
        """
        return Objective(self.simulation.starting(state), self.judged)

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
        Folding.of(robot, fold := Fold())
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

    @property
    def policy(self) -> PolicyChoice:
        """The motion's policy. Searches for hardware have several."""
        return self.motion.task.policy

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

    @property
    def policy(self) -> PolicyChoice | None:
        """Policy that the weights belong to. None if it is that of the objective."""
        ...

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


def posed(objective: Objective, play: Playable) -> tuple[Objective, Array]:
    """Pose what is to be played from a fall.

    Args:
        objective: The task from that fall.
        play: What to play.

    Returns:
        The objective, with the policy of what is played, and the weights, shape (1, d).
    """
    own = _policy(objective, play)
    if own != objective.task.policy:
        objective = objective.with_task(replace(objective.task, policy=own))
    return objective, play.decisions(objective.policy)


def simulated(objective: Objective, play: Play) -> Motion:
    """Simulate a motion from a fall, as if a search had found it there.

    Args:
        objective: The task from that fall.
        play: The motion, or its mirror image.

    Returns:
        The motion from there.
    """
    own, weights = posed(objective, play)
    found = own.evaluate(Trials(weights, own.task.hold_steps))
    cost_weights = {name: one.weight for name, one in own.task.costs.items()}
    solution = Solution(
        best=Trial.of(weights[0], float(found.cost(cost_weights)[0]), found, 0),
        trials=0,
        generations=0,
        trials_to_success=None,
        diverged=0,
        stopped=Stopped.SUCCESS,
        cost_weights=cost_weights,
        changes=(),
    )
    return record(own, solution, seed=play.motion.provenance.seed)


def _policy(objective: Objective, play: Playable) -> PolicyChoice:
    """Return the policy of what is played. Only tasks that are judged on perturbed models, for hardware, have several."""
    own = None if objective.task.robust is None else play.policy
    return own or objective.task.policy


def _by_policy(objective: Objective, plays: Sequence[Playable]) -> list[tuple[Objective, list[int]]]:
    """Group what is played by its policy: objectives with that policy, and the indices of what it plays."""
    groups: list[tuple[Objective, list[int]]] = []
    for k, play in enumerate(plays):
        policy = _policy(objective, play)
        members = next((members for one, members in groups if one.task.policy == policy), None)
        if members is None:
            groups.append((posed(objective, play)[0], members := []))
        members.append(k)
    return groups


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
    numbers = np.array(list(plays), dtype=int)
    starts, models = others(objective, perturbation, numbers.tolist(), seed=seed)
    works = np.zeros(len(plays), dtype=bool)
    for one, members in _by_policy(objective, list(plays.values())):
        for first in range(0, len(members), AT_ONCE):
            rows = members[first : first + AT_ONCE]
            weights = np.concatenate([plays[int(number)].decisions(one.policy) for number in numbers[rows]])
            works[rows] = judged_on_others(one, weights, starts[rows], models[rows])
    return works


def others(
    objective: Objective, perturbation: Perturbation, numbers: Sequence[int], *, seed: tuple[int, ...]
) -> tuple[State, Models]:
    """Make perturbed models. Each depends on its own number only.

    Args:
        objective: The task from one fall.
        perturbation: How far the models differ from the nominal one.
        numbers: Numbers of the models.
        seed: Seed of the models.

    Returns:
        The start of each, and the models.
    """
    engine = objective.engine
    drawn = perturbation.draw(engine.model, engine.embodiment.joints, n=max(numbers) + 1, seed=(*seed, _TAG))
    return perturbed_models(engine.model, engine.layout, drawn[numbers], objective.state)


def judged_on_others(objective: Objective, weights: Array, starts: State, models: Models) -> Mask:
    """Play motions on perturbed models.

    Args:
        objective: The task.
        weights: Weights of the motions, shape (n, d).
        starts: Start of each.
        models: Model of each.

    Returns:
        Whether each one works, shape (n,).
    """
    hold = objective.task.hold_steps
    # until the first reference arrives, the joints keep their last command
    reference = replace(objective.policy.reference(weights, hold_steps=hold), before=objective.state.joint_reference[0])
    trajectories = objective.engine.rollout(starts, reference, models=models, record=objective.recorded)
    return objective.judge(trajectories, hold, perturbed=True).success


def tried(objectives: Sequence[Objective], plays: Sequence[Sequence[Playable]]) -> list[Evaluation]:
    """Play motions from falls in shared batches, on the nominal model.

    Args:
        objectives: The task from each fall.
        plays: What to play from each fall.

    Returns:
        One evaluation per fall.
    """
    asked, groups = [], []
    for objective, own in zip(objectives, plays, strict=True):
        groups.append(_by_policy(objective, own))
        for one, members in groups[-1]:
            weights = np.concatenate([own[k].decisions(one.policy) for k in members])
            asked.append((one, Trials(weights, one.task.hold_steps)))
    found = iter(evaluate_many(asked))
    return [_in_order([(next(found), members) for _, members in group]) for group in groups]


def _in_order(parts: Sequence[tuple[Evaluation, list[int]]]) -> Evaluation:
    """Join evaluations, each with the indices of its rows."""
    if len(parts) == 1:
        return parts[0][0]
    return joined([part for part, _ in parts], np.argsort(np.concatenate([members for _, members in parts])))
