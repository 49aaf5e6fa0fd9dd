"""Tasks as YAML: reading, writing, and changing single values by their path."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from levade.costs import (
    AngularVelocity,
    Effort,
    GroundContact,
    JointLimitExcess,
    JointVelocity,
    LinearVelocity,
    Orientation,
    Position,
    Posture,
    ReferenceLimitExcess,
    SpeedLimitExcess,
    TorqueLimitExcess,
)
from levade.costs.success import QUANTITIES
from levade.document import build, kind_of, parse_yaml, read_yaml
from levade.errors import LevadeError, did_you_mean
from levade.tasks.task import Cost, Task
from levade.tasks.units import to_si

TERMS = {
    "orientation": Orientation,
    "position": Position,
    "linear_velocity": LinearVelocity,
    "angular_velocity": AngularVelocity,
    "joint_velocity": JointVelocity,
    "posture": Posture,
    "effort": Effort,
    "joint_limits": JointLimitExcess,
    "reference_limits": ReferenceLimitExcess,
    "torque_limits": TorqueLimitExcess,
    "speed_limits": SpeedLimitExcess,
    "ground_contact": GroundContact,
}
"""Name in a task file -> term."""

_ORDER = (
    *("name", "description", "robot", "scene", "physics", "start", "horizon", "hold"),
    *("policy", "costs", "stages", "success", "search", "robust"),
)
_BUILT_IN = Path(__file__).parent / "data"


def builtin_tasks() -> dict[str, Path]:
    """Name -> file of every built-in task, by name."""
    return {path.stem: path for path in sorted(_BUILT_IN.glob("*.yaml"), key=lambda path: path.stem)}


def load_task(name_or_path: str | Path, *, robot: str | None = None, changes: Sequence[str] = ()) -> Task:
    """A built-in task by name, or any task by the path of its YAML file.

    robot: name or file of a robot, instead of the task's. changes: "path=value" each, such as
    "costs.effort.weight=0.5"; the path has to exist in the task with all its defaults. Raises LevadeError.
    """
    path = _find(str(name_or_path))
    task = task_from_dict(read_yaml(path), where=str(path))
    if robot is not None:
        task = dataclasses.replace(
            task, robot=dataclasses.replace(task.robot, name=robot, actuation=None, variant=None)
        )
    if changes:
        content = task_to_dict(task)
        for change in changes:
            _apply(content, change)
        try:
            task = task_from_dict(content, where="--set")
        except LevadeError as error:
            raise LevadeError(f"--set {str(error).removeprefix('--set').lstrip('.: ')}") from None
    return task


def task_from_dict(content: Mapping[str, Any], *, where: str) -> Task:
    """A task from the tables of its YAML file; LevadeErrors start with ``where``."""
    content = dict(content)
    success = content.get("success")
    if isinstance(success, Mapping):  # a criterion's name is its quantity unless it says otherwise
        content["success"] = {
            name: {"quantity": name, **value} if isinstance(value, Mapping) and name in QUANTITIES else value
            for name, value in success.items()
        }
        for name, value in content["success"].items():
            if isinstance(value, Mapping) and "quantity" not in value:
                raise LevadeError(
                    f"{where}.success.{name}: {name!r} is no quantity, so say which: quantity: ...;"
                    f" {did_you_mean(str(name), QUANTITIES)}"
                )
    costs = content.get("costs")
    if isinstance(costs, Mapping):
        content["costs"] = {
            name: {"term": name, **value} if isinstance(value, Mapping) else value for name, value in costs.items()
        }
    content = dict(to_si(content, where=where))
    if isinstance(costs, Mapping):
        content["costs"] = {
            name: _cost(str(name), value, where=f"{where}.costs.{name}") for name, value in content["costs"].items()
        }
    return build(Task, content, where=where)


def task_to_dict(task: Task) -> dict[str, Any]:
    """The whole task as plain tables, with every default filled in, in SI: what ``task.yaml`` of a run holds.

    Raises LevadeError for a cost that is a plain Python function: a file cannot hold it.
    """
    content = _plain(dataclasses.asdict(task))
    content["start"] = {key: value for key, value in content["start"].items() if value is not None}
    content["costs"] = {}
    names = {kind: name for name, kind in TERMS.items()}
    for name, cost in task.costs.items():
        if type(cost.term) not in names:
            raise LevadeError(f"costs.{name}: a Python function cannot be written to a task file")
        term: Any = cost.term
        content["costs"][name] = {
            "term": names[type(cost.term)],
            "weight": cost.weight,
            **_plain(dataclasses.asdict(term)),
        }
    return {key: content[key] for key in _ORDER}


def task_to_yaml(task: Task) -> str:
    """The text of a task file with every default filled in."""
    import yaml

    return yaml.safe_dump(task_to_dict(task), sort_keys=False, width=120, allow_unicode=True)


def _cost(name: str, content: Any, *, where: str) -> Cost:
    if not isinstance(content, Mapping):
        raise LevadeError(f"{where}: should be a table such as {{weight: 1}}, is {kind_of(content)}")
    content = dict(content)
    term, weight = content.pop("term"), content.pop("weight", None)
    if not isinstance(term, str) or term not in TERMS:
        raise LevadeError(f"{where}: no term {term!r}; {did_you_mean(str(term), TERMS)}")
    if isinstance(weight, bool) or not isinstance(weight, (int, float)):
        raise LevadeError(f"{where}.weight: should be a number, is {'missing' if weight is None else kind_of(weight)}")
    valid = [field.name for field in dataclasses.fields(TERMS[term])]
    for key in content:
        if key not in valid:
            raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), [*valid, 'term', 'weight'])}")
    return Cost(build(TERMS[term], content, where=where), float(weight))


def _find(name_or_path: str) -> Path:
    tasks = builtin_tasks()
    if name_or_path in tasks:
        return tasks[name_or_path]
    path = Path(name_or_path)
    if path.is_file():
        return path
    if path.suffix in (".yaml", ".yml") or "/" in name_or_path or "\\" in name_or_path:
        raise LevadeError(f"{path}: no such file; give a built-in task or the path of a YAML file")
    raise LevadeError(f"no task {name_or_path!r}; {did_you_mean(name_or_path, tasks)} (or the path of a YAML file)")


def _apply(content: dict[str, Any], change: str) -> None:
    """Change the value at a path of nested tables and lists."""
    path, equals, text = change.partition("=")
    if not equals:
        raise LevadeError(f"--set {change}: should be path=value, such as horizon=0.4")
    value = parse_yaml(text, where=f"--set {path}")
    *parents, last = path.split(".")
    at: Any = content
    for i, key in enumerate([*parents, last]):
        keys = list(at) if isinstance(at, dict) else [str(n) for n in range(len(at))] if isinstance(at, list) else []
        if key not in keys:
            place = ".".join(parents[:i]) or "the task"
            if not keys:
                raise LevadeError(f"--set {path}: {place} is a single value, {kind_of(at)}; set it as a whole")
            raise LevadeError(f"--set {path}: no {key!r} in {place}; {did_you_mean(key, keys)}")
        index: Any = int(key) if isinstance(at, list) else key
        if i == len(parents):
            at[index] = value
        else:
            at = at[index]


def _plain(value: Any) -> Any:
    """Tuples to lists, mappings to dicts: what YAML writes without tags."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value
