"""The functions of ``import levade``. They take names, files or objects, and return objects.

    import levade

    result = levade.solve("rearing", seed=0)
    result.success, result.motion.horizon
    result.motion.save("rearing.npz")
    levade.check(result.motion).passed

Anything that a task file chooses by name can be an object: robot, cost, criterion, policy, optimizer, engine.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mujoco

from levade.arrays import Array
from levade.engines import ENGINES, EngineKind
from levade.errors import LevadeError
from levade.motions import Motion
from levade.motions.chaining import after as start_after
from levade.optimizers import can_restart
from levade.robots import Robot, robot_of_spec
from levade.robots import load_robot as load_robot_file
from levade.search import InitialGuess, Objective, Solution, make_objective
from levade.search import solve as search_one
from levade.search import solve_many as search_many
from levade.search.initial import initial_guess
from levade.search.loop import Observe
from levade.search.recording import record
from levade.search.run import run
from levade.tasks import Demands, Task, load_task

if TYPE_CHECKING:
    from levade.checks import Certificate
    from levade.exports import Exported
    from levade.hardware import Pursued
    from levade.optimizers import Choice
    from levade.policies import JointPolicy
    from levade.stabilisers import Stabilised

RobotLike = str | Path | Robot | mujoco.MjSpec
"""A robot's name or file, a `levade.Robot`, or a `mujoco.MjSpec`."""

Initial = Motion | Array | InitialGuess | Sequence[Motion | Array]
"""Where a search may begin: around motions, policy weights [rad], or a distribution."""


@dataclass(frozen=True, eq=False)
class Result:
    """The result of `solve`.

    Attributes:
        motion: The best motion, with all its records.
        solution: The result of the search, and what it took.
        objective: The objective of the search. `levade.search.Objective.evaluate` tries other weights.
    """

    motion: Motion
    solution: Solution
    objective: Objective

    @property
    def success(self) -> bool:
        """Whether the motion meets its task's criteria."""
        return self.motion.result.success

    @property
    def trials(self) -> int:
        """Roll-outs that the search made."""
        return self.solution.trials

    def __repr__(self) -> str:
        found = f"at trial {self.solution.trials_to_success}" if self.success else f"after {self.trials} trials"
        return f"Result({'success' if self.success else 'no success'} {found}, {self.motion!r})"


def load_robot(robot: RobotLike, *, like: str | Path | Robot | None = None, **options: Any) -> Robot:
    """Load a robot.

    Args:
        robot: Name of a built-in robot, ``package:robot``, the path of an MJCF, URDF or robot.yaml, or a `mujoco.MjSpec`. A
            `Robot` is returned unchanged.
        like: For a `mujoco.MjSpec` that is a changed `levade.Robot.spec`: the original robot, whose legs, limits, gains and
            postures are kept. Another spec is read like a file.
        **options: As in `levade.robots.load_robot` for a name or a path: actuation, variant, linkage, kp, kd. For a
            `mujoco.MjSpec`: name.

    Returns:
        The robot.

    Raises:
        LevadeError: If it does not exist, or levade cannot use it.
    """
    if isinstance(robot, Robot):
        return robot
    if isinstance(robot, mujoco.MjSpec):
        return robot_of_spec(robot, like=None if like is None else load_robot(like), **options)
    if like is not None:
        raise LevadeError("robot: like goes with a mujoco.MjSpec; leave it out for a name or a file")
    return load_robot_file(robot, **options)


def solve(
    task: str | Path | Task,
    *,
    seed: int = 0,
    robot: RobotLike | None = None,
    optimizer: Choice | None = None,
    policy: JointPolicy | Callable[[Task, Robot], JointPolicy] | None = None,
    engine: str | EngineKind | None = None,
    trials: int | None = None,
    initial: Initial | None = None,
    after: Motion | None = None,
    out: str | Path | None = None,
    threads: int = 0,
    observe: Observe | None = None,
) -> Result:
    """Search for a motion that does a task.

    Args:
        task: Name of a built-in task, path of a task file, or a `Task`.
        seed: Seed of all random numbers. The same task, seed and versions give the same motion.
        robot: A robot instead of the task's.
        optimizer: An optimizer instead of the task's: a name, a class or function ``(space, *, seed)``, or an object with
            ``ask`` and ``tell``. With an object the search makes only one attempt. See `levade.optimizers.protocol`.
        policy: A policy, or a function that makes one: see `levade.policies.JointPolicy`.
        engine: An engine instead of the task's: a name, or a row for the table `levade.engines.ENGINES`.
        trials: A budget instead of the task's.
        initial: Motions, weights or a distribution around which the search begins.
        after: A motion at whose end this one starts, instead of the task's start.
        out: Directory that keeps the motion, the complete task, the progress and a checkpoint, as in ``levade solve``. None
            keeps nothing.
        threads: Number of engine threads (0: one per core). The result does not depend on it.
        observe: Called after each generation with a `levade.search.Generation`. It may return
            `levade.search.Stopped.INTERRUPTED` to end the search. Ctrl-C also ends it, with the best motion so far.

    Returns:
        The best motion, and the search that found it.

    Raises:
        LevadeError: If parts do not fit together, or ``out`` cannot be written.
    """
    objective = _objective(task, robot, optimizer, policy, engine, trials, threads, after)
    guess = None if initial is None else initial_guess(objective.policy, initial)
    if out is not None:
        kept = run(objective, seed=seed, directory=Path(out), initial=guess, observe=observe)
        return Result(kept.motion, kept.solution, objective)
    solution = search_one(objective, seed=seed, initial=guess, observe=observe)
    return Result(record(objective, solution, seed=seed), solution, objective)


def solve_many(
    tasks: Sequence[str | Path | Task | Objective],
    *,
    seeds: Sequence[int] | None = None,
    robot: RobotLike | None = None,
    trials: int | None = None,
    initial: Sequence[Initial | None] | None = None,
    threads: int = 0,
) -> list[Result]:
    """Run several searches in lockstep, with roll-outs in common batches.

    Args:
        tasks: The tasks. Equal tasks share batches. So do objectives of one `levade.search.Simulation`, also from different
            starts.
        seeds: Seed of each search. Defaults to 0, 1, 2, ...
        robot: A robot instead of the tasks'.
        trials: A budget instead of the tasks'. Objectives keep theirs.
        initial: Where each search begins, or None.
        threads: Number of engine threads (0: one per core).

    Returns:
        A result for each, with the same bits as `solve` gives for it alone.

    Raises:
        LevadeError: If parts do not fit together.
    """
    known: dict[int, Objective] = {}
    objectives = []
    for task in tasks:
        if not isinstance(task, Objective):
            task = known.get(id(task)) or known.setdefault(
                id(task), _objective(task, robot, trials=trials, threads=threads)
            )
        objectives.append(task)
    numbers = list(range(len(objectives))) if seeds is None else list(seeds)
    guesses = [
        None if one is None else initial_guess(objective.policy, one)
        for objective, one in zip(objectives, initial or [None] * len(objectives), strict=True)
    ]
    solutions = search_many(objectives, seeds=numbers, initial=guesses)
    return [
        Result(record(objective, solution, seed=seed), solution, objective)
        for objective, solution, seed in zip(objectives, solutions, numbers, strict=True)
    ]


def pursue(
    task: str | Path | Task,
    *,
    seed: int = 0,
    robot: RobotLike | None = None,
    out: str | Path | None = None,
    minutes: float | None = None,
    demands: Demands | None = None,
    threads: int = 0,
) -> Pursued:
    """Search for a motion for hardware, until a certificate passes: ``levade solve --hardware``.

    Args:
        task: Name of a built-in task, path of a task file, or a `Task`.
        seed: Seed of all random numbers.
        robot: A robot instead of the task's.
        out: Directory that keeps the searches, the motion and its certificate. Searches that it holds are continued. None keeps
            nothing.
        minutes: Time for all searches. None lets them use all their trials.
        demands: Demands of the certificate. Defaults to the task's, or to `levade.tasks.Demands`.
        threads: Number of engine threads (0: one per core).

    Returns:
        The motion with the best certificate, that certificate, and whether it passes: ``motion``, ``certificate``, ``passed``.

    Raises:
        LevadeError: If parts do not fit together, or ``out`` cannot be written.
    """
    from levade.hardware import pursue as pursued

    made = None if robot is None else load_robot(robot)
    task = _task(task, made)
    with tempfile.TemporaryDirectory(prefix="levade-") as folder:
        return pursued(
            task,
            robot=made,
            seed=seed,
            threads=threads,
            directory=Path(folder) / "pursuit" if out is None else Path(out),
            minutes=minutes,
            demands=demands,
        )


def check(motion: Motion | str | Path, **options: Any) -> Certificate:
    """Check a motion: on perturbed robots, with other numerics and engines, and against hardware limits.

    Args:
        motion: A motion, or its file.
        **options: As in `levade.checks.check`, such as ``runs=100``.

    Returns:
        The certificate.

    Raises:
        LevadeError: If the motion has no criteria.
    """
    from levade.checks import check as checked

    return checked(_motion(motion), **options)


def stabilise(motion: Motion | str | Path, **options: Any) -> Stabilised:
    """Find a stabiliser for a motion: gains from sensor readings to corrections of the references.

    Args:
        motion: A motion, or its file.
        **options: As in `levade.stabilisers.stabilise`, such as ``seed=0``.

    Returns:
        The motion with its stabiliser, and how often it succeeds with and without.

    Raises:
        LevadeError: If the motion cannot be stabilised.
    """
    from levade.stabilisers import stabilise as stabilised

    return stabilised(_motion(motion), **options)


def export(motion: Motion | str | Path, to: str, directory: str | Path, **options: Any) -> Exported:
    """Write a motion in another tool's format.

    Args:
        motion: A motion, or its file.
        to: Name of the format: csv, json, ros2, mjlab, unitree, urdf or mjcf.
        directory: Directory to write.
        **options: As in `levade.exports.export`, such as ``rate=500``.

    Returns:
        The files that were written, and notes.

    Raises:
        LevadeError: If the format does not exist, or the motion does not fit it.
    """
    from levade.exports import export as exported

    return exported(_motion(motion), to, Path(directory), **options)


def show(motion: Motion | str | Path, path: str | Path | None = None, *, browse: bool = True) -> Path:
    """Write a motion's page, with a 3D view and plots, and open it in the browser.

    Args:
        motion: A motion, or its file.
        path: File to write. Defaults to a temporary file.
        browse: Whether to open the page.

    Returns:
        The file.

    Raises:
        LevadeError: If the page cannot be written.
    """
    from levade.report.page import write_page

    if path is None:
        path = Path(tempfile.mkdtemp(prefix="levade-")) / "report.html"
    written = write_page(_motion(motion), path)
    if browse:
        import webbrowser

        webbrowser.open(written.resolve().as_uri())
    return written


def _objective(
    task: str | Path | Task,
    robot: RobotLike | None,
    optimizer: Choice | None = None,
    policy: Any = None,
    engine: str | EngineKind | None = None,
    trials: int | None = None,
    threads: int = 0,
    after: Motion | None = None,
) -> Objective:
    """Make the objective of a task, with the given parts instead of its own."""
    made = None if robot is None else load_robot(robot)
    task = _task(task, made)
    if task.hardware is not None:
        raise LevadeError(
            f"hardware: the task {task.name} asks for searches until a certificate passes; levade.pursue makes them"
        )
    changes: dict[str, Any] = {} if trials is None else {"trials": trials}
    if optimizer is not None:
        changes |= {"optimizer": optimizer, "settings": {}}
        if not can_restart(optimizer):
            changes["restart"] = changes["patience"] = None
    if changes:
        task = replace(task, search=replace(task.search, **changes))
    if after is not None:
        task = start_after(task, after)
    if engine is not None:
        task = replace(task, physics=replace(task.physics, engine=_engine_name(engine)))
    return make_objective(task, robot=made, policy=policy, threads=threads)


def _task(task: str | Path | Task, robot: Robot | None) -> Task:
    """Return the task, with another robot if one is given."""
    if not isinstance(task, Task):
        task = load_task(task, robot=robot)
    if robot is None:
        return task
    source = robot.source or robot.name
    return replace(task, robot=replace(task.robot, name=source, actuation=None, variant=robot.variant))


def _engine_name(engine: str | EngineKind) -> str:
    """Return the name of an engine. A new engine is added to the table."""
    if isinstance(engine, str):
        return engine
    known = ENGINES.setdefault(engine.name, engine)
    if known != engine:
        raise LevadeError(f"engine: another engine is called {engine.name} already; give it another name")
    return engine.name


def _motion(motion: Motion | str | Path) -> Motion:
    return motion if isinstance(motion, Motion) else Motion.load(motion)


__all__: Iterable[str] = (
    "Initial",
    "Result",
    "RobotLike",
    "check",
    "export",
    "load_robot",
    "pursue",
    "show",
    "solve",
    "solve_many",
    "stabilise",
)
