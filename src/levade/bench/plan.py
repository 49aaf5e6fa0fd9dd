"""Say what to run: tasks x robots x optimizers x seeds, in a YAML file or in Python.

tasks: [rearing, posture-recovery]      # names or files
robots: [hyq2max]                       # names or files; by default each task's own
optimizers:                             # a list of names, or your own names with what they change in the task
  cma: {}
  plain: {search.optimizer: cma, search.smoothness: 0}
seeds: 20                               # 0 to 19, or a list
trials: 3000                            # budget; by default each task's own
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

from levade.document import build, read_yaml
from levade.errors import LevadeError, did_you_mean
from levade.optimizers import OPTIMIZERS, canonical
from levade.search import make_objective
from levade.tasks import Task, load_task, task_checksum

Until = Literal["success", "budget"]

_MOST_SEEDS = 1_000_000


@dataclass(frozen=True)
class Plan:
    """Says what a bench runs.

    Attributes:
        tasks: Names or files.
        robots: Names or files. Each task's own if there are none.
        optimizers: Names, or your own names -> path in the task -> value. Each task's own if there are none.
        seeds: Number of seeds, from 0, or a list of them.
        trials: Budget of each run in trials. None for the task's own.
        steps: Budget of each run in physics steps. None for no limit.
        until: "success" ends a run after its first success and the trials that polish it. "budget" spends the whole budget.
        changes: Path in every task -> value.
    """

    tasks: tuple[str, ...]
    robots: tuple[str, ...] = ()
    optimizers: Mapping[str, Mapping[str, Any] | None] | tuple[str, ...] = ()
    seeds: int | tuple[int, ...] = 5
    trials: int | None = None
    steps: float | None = None
    until: Until = "success"
    changes: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.tasks:
            raise LevadeError("tasks: there are none; name at least one, such as tasks: [rearing]")
        for name, values in (("tasks", self.tasks), ("robots", self.robots), ("optimizers", tuple(self.optimizers))):
            known = [canonical(value) if name == "optimizers" else value for value in values]
            twice = {value for value in known if known.count(value) > 1}
            if twice:
                raise LevadeError(f"{name}: {min(twice)} is there twice")
        if isinstance(self.seeds, int) and self.seeds > _MOST_SEEDS:
            raise LevadeError(f"seeds: {self.seeds} are too many; at most {_MOST_SEEDS}")
        if not self.seed_list or min(self.seed_list) < 0 or len(set(self.seed_list)) < len(self.seed_list):
            raise LevadeError(f"seeds: {self.seeds} should be a number from 1, or a list of different ones from 0")
        if self.until not in get_args(Until):
            raise LevadeError(f"until: {self.until!r} should be success or budget")
        for name, value in (("trials", self.trials), ("steps", self.steps)):
            if value is not None and not value >= 1:
                raise LevadeError(f"{name}: {value} should be at least 1")

    @property
    def seed_list(self) -> tuple[int, ...]:
        """The seeds, one by one."""
        return tuple(range(self.seeds)) if isinstance(self.seeds, int) else self.seeds


@dataclass(frozen=True)
class Case:
    """Describes one run of a bench.

    Attributes:
        task: The task with every change applied.
        budget_steps: Budget in physics steps. None for no limit.
    """

    task: Task
    robot: str
    optimizer: str
    seed: int
    until: Until
    budget_steps: int | None

    @property
    def key(self) -> tuple[str, str, str, int]:
        """Identify a result by the names of task, robot and optimizer (not an alias of it), and the seed."""
        return self.task.name, self.robot, canonical(self.optimizer), self.seed

    @property
    def checksum(self) -> int:
        """Compute a checksum of everything that decides the result, except the seed and the versions."""
        return task_checksum(self.task, self.budget_steps)

    def __str__(self) -> str:
        return f"{self.task.name} on {self.robot}, {self.optimizer}, seed {self.seed}"


def read_plan(path: Path) -> Plan:
    """Read a plan from its YAML file.

    Args:
        path: The file.

    Returns:
        The plan.

    Raises:
        LevadeError: If the file cannot be read, or a key or value is wrong.
    """
    return build(Plan, read_yaml(path, like="tasks and optimizers"), where=str(path))


def plan_to_yaml(plan: Plan) -> str:
    """Return the text of a plan's file.

    Args:
        plan: The plan.

    Returns:
        YAML text with every field of the plan.
    """
    import yaml

    content = json.loads(json.dumps(dataclasses.asdict(plan)))
    return yaml.safe_dump(content, sort_keys=False, width=120, allow_unicode=True)


def cases(plan: Plan) -> list[Case]:
    """List every case of a plan, in its order.

    Args:
        plan: The plan.

    Returns:
        The cases.

    Raises:
        LevadeError: If a task, robot and optimizer do not fit together.
    """
    found: list[Case] = []
    named: dict[tuple[str, str], tuple[str, str | None]] = {}
    for task in plan.tasks:
        for robot in plan.robots or (None,):
            variants = list(_variants(plan, task, robot))
            name = _fits(variants[0][1])
            given = named.setdefault((variants[0][1].name, name), (task, robot))
            if given != (task, robot):
                same = f"{given[0]} and {task}" if given[0] != task else f"{given[1]} and {robot}"
                raise LevadeError(f"{same}: have one name, {variants[0][1].name} on {name}; give them different ones")
            budget = None if plan.steps is None else int(plan.steps)
            found += [
                Case(variant, name, optimizer, seed, plan.until, budget)
                for optimizer, variant in variants
                for seed in plan.seed_list
            ]
    return found


def _variants(plan: Plan, task: str, robot: str | None) -> Iterator[tuple[str, Task]]:
    """Yield the name of each optimizer, and the task with it."""
    common = _changes(plan.changes)
    if plan.trials is not None:
        common.append(f"search.trials={plan.trials}")
    if plan.until == "budget":
        common.append("search.polish=null")
    if not plan.optimizers:
        yield str(load_task(task, robot=robot).search.optimizer), _load(task, robot, common, "changes")
    for name in plan.optimizers:
        changes = plan.optimizers[name] if isinstance(plan.optimizers, Mapping) else None
        if changes:
            yield name, _load(task, robot, [*_changes(changes), *common], f"optimizers.{name}")
        elif canonical(name) in OPTIMIZERS:
            yield name, _load(task, robot, [f"search.optimizer={name}", *common], f"optimizers.{name}")
        else:
            raise LevadeError(f"optimizers: no optimizer {name!r}; {did_you_mean(name, OPTIMIZERS)}")


def _load(task: str, robot: str | None, changes: Sequence[str], where: str) -> Task:
    try:
        return load_task(task, robot=robot, changes=changes)
    except LevadeError as error:
        said = error.message if error.field == "changes" else str(error)  # a plan may have them in other places
        raise LevadeError(f"{where}: {said}") from None


def _changes(changes: Mapping[str, Any]) -> list[str]:
    """Write changes as `levade.tasks.load_task` takes them. JSON is YAML."""
    return [f"{path}={json.dumps(value)}" for path, value in changes.items()]


def _fits(task: Task) -> str:
    """Load the task's robot, and return its name."""
    try:
        return make_objective(task, threads=1).robot.name
    except LevadeError as error:
        raise LevadeError(f"{task.name} on {task.robot.name}: {error}") from None
