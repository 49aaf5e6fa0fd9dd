"""Falls of one family. Each has its own objective, and all share one simulation, so that roll-outs share batches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines import Fallen, Fold, Models, Start, State, start_state
from levade.engines.folding import Folding
from levade.errors import LevadeError
from levade.exports.asker import distances
from levade.feedback import up_in_trunk
from levade.hardware import Plan
from levade.library.mirror import Mirror
from levade.library.rarity import Lying
from levade.robots import Robot, dimensions
from levade.search.objective import Objective, Simulation
from levade.tasks import Demands, StartChoice, Task

FACES = ("tail", "nose", "right", "left", "belly", "back")
"""What a robot lies on if up is mostly along x, -x, y, -y, z, -z of its trunk. "belly" includes standing on the feet."""

_NEIGHBOURS, _NEARBY = 47, 0.6
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
        return Objective(self.simulation.starting(self._state(start.choice)), replace(self.judged, start=start))

    def _state(self, start: Start) -> State:
        return start_state(self.simulation.engine, self.simulation.robot, self.task.scene, start)

    def lying(self, indices: Sequence[int]) -> list[Lying]:
        """Drop the robot, and return how it lies after each fall. Robots fold up in one batch.

        Args:
            indices: Indices of the falls in their family.
        """
        if not indices:
            return []
        fallen = [self._state(replace(self._fallen, index=index, fold=None)) for index in indices]
        states = self.folded(State.stacked(fallen))
        return [Lying(index, *self.sensed(states[[k]])) for k, index in enumerate(indices)]

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
        up, joint_position = self.sensed(state)
        for number in range(_DRAWN if self.folding is not None else 0):
            its_up, its_joints = self.sensed(other := self._other(number))
            if distances(its_up[None], its_joints[None], up, joint_position)[0] < _NEARBY:
                near.append(other)
            if len(near) == _NEIGHBOURS:
                break
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
