"""Tasks as tables and YAML with every default filled in, and their checksums."""

from __future__ import annotations

import dataclasses
import zlib
from collections.abc import Mapping
from typing import Any

from levade.costs import Criterion
from levade.errors import LevadeError
from levade.optimizers import ALIASES
from levade.tasks.code import KEY, code_name, measure_to_dict
from levade.tasks.parts import Search
from levade.tasks.task import Task
from levade.tasks.terms import TERMS

_ORDER = (
    *("name", "description", "robot", "scene", "physics", "start", "horizon", "hold"),
    *("policy", "costs", "stages", "success", "good_enough", "search", "robust", "feedback", "hardware"),
)
_LATER = (
    *(("hardware",), ("policy", "room"), ("policy", "slew"), ("policy", "through"), ("search", "patience")),
    *(("search", "sketches"), ("good_enough",), ("robust", "free")),
    *(("robust", "perturb", "softness"), ("robust", "perturb", "cone"), ("start", "fallen", "fold")),
)
"""Keys that were added after the first runs with a checksum, and are null, zero or empty by default."""
_LATER_OF_TERMS = {"margins": ("linkage",)}
"""The same for keys of a term."""

_SEQUENCE = "tag:yaml.org,2002:seq"


def task_to_dict(task: Task, *, code: bool = False) -> dict[str, Any]:
    """Write the whole task as plain tables in SI, with every default filled in, as in ``task.yaml`` of a run.

    Args:
        task: The task.
        code: Whether to write a cost that is Python code as ``{python: module.name, weight: ...}``, which only names it.
            `task_from_dict` reads it again only with ``code=True``.

    Returns:
        The tables.

    Raises:
        LevadeError: If a cost, measure or optimizer is Python code and ``code`` is false.
    """
    optimizer, own = task.search.optimizer, task.search.settings
    if not isinstance(optimizer, str):
        if not code:
            raise LevadeError("search.optimizer: a Python object cannot be written to a task file")
        plain = dataclasses.replace(task.search, optimizer=Search().optimizer, settings={})
        task = dataclasses.replace(task, search=plain)
    content = _plain(dataclasses.asdict(task))
    if not isinstance(optimizer, str):
        content["search"] |= {"optimizer": {KEY: code_name(optimizer)}, "settings": dict(own)}
    _name_measures(content["success"], task.success, code, "success")
    _name_measures(content["good_enough"], task.good_enough, code, "good_enough")
    if task.robust is not None and task.robust.success is not None:
        _name_measures(content["robust"]["success"], task.robust.success, code, "robust.success")
    content["start"] = {key: value for key, value in content["start"].items() if value is not None}
    content["costs"] = {}
    names = {kind: name for name, kind in TERMS.items()}
    for name, cost in task.costs.items():
        if type(cost.term) not in names:
            if not code:
                raise LevadeError(f"costs.{name}: a Python function cannot be written to a task file")
            content["costs"][name] = {KEY: code_name(cost.term), "weight": cost.weight}
            continue
        term: Any = cost.term
        content["costs"][name] = {
            "term": names[type(cost.term)],
            "weight": cost.weight,
            **_plain(dataclasses.asdict(term)),
        }
    return {key: content[key] for key in _ORDER}


def _name_measures(content: dict[str, Any], criteria: Mapping[str, Criterion], code: bool, where: str) -> None:
    """Write the quantities of criteria into their tables; raise LevadeError for Python code, unless ``code`` is true."""
    for name, criterion in criteria.items():
        if (of := measure_to_dict(criterion.quantity)) and not code:
            raise LevadeError(f"{where}.{name}: a Python function cannot be written to a task file")
        content[name] |= {**of, "quantity": str(criterion.quantity)}


def holds_code(task: Task) -> bool:
    """Find out whether a task has a cost, a measure or an optimizer that is Python code.

    Args:
        task: The task.

    Returns:
        Whether it has one, so that a file cannot contain the whole task.
    """
    content = task_to_dict(task, code=True)
    tables = [*content["costs"].values(), *content["success"].values(), content["search"]["optimizer"]]
    return any(isinstance(table, Mapping) and KEY in table for table in tables)


def task_to_yaml(task: Task, *, code: bool = False) -> str:
    """Write the text of a task file with every default filled in.

    Args:
        task: The task.
        code: As in `task_to_dict`.

    Returns:
        The text, in YAML.

    Raises:
        LevadeError: As `task_to_dict` does.
    """
    return _yaml(task_to_dict(task, code=code))


def task_checksum(task: Task, *more: object) -> int:
    """Compute a checksum of the task, and of everything else that decides a result.

    Costs that are Python code count by their names. So that runs and benches of earlier versions can go on, an optimizer
    counts by its first name, which may be an alias now, and a newer key counts only if it is set.

    Args:
        task: The task.
        more: Other objects that decide the result; their texts count.

    Returns:
        The checksum, CRC-32.
    """
    content = task_to_dict(task, code=True)
    for *tables, name in _LATER:
        table: Any = content
        for key in tables:
            table = table.get(key) if isinstance(table, dict) else None
        if isinstance(table, dict) and name in table and table[name] in (None, [], {}, 0):
            del table[name]
    for cost in content["costs"].values():
        for name in _LATER_OF_TERMS.get(cost.get("term"), ()):
            if cost[name] is None:
                del cost[name]
    first = {name: alias for alias, name in ALIASES.items()}
    name = content["search"]["optimizer"]
    content["search"]["optimizer"] = first.get(name, name) if isinstance(name, str) else name
    return zlib.crc32("".join([_yaml(content), *map(str, more)]).encode())


def _yaml(content: dict[str, Any]) -> str:
    import yaml

    class Dumper(yaml.SafeDumper):
        pass

    Dumper.add_representer(_Row, lambda dumper, row: dumper.represent_sequence(_SEQUENCE, row, flow_style=True))
    if content["scene"]["terrain"] is not None:  # one line a row, not one line a number
        content["scene"]["terrain"]["heights"] = [_Row(row) for row in content["scene"]["terrain"]["heights"]]
    return yaml.dump(content, Dumper=Dumper, sort_keys=False, width=120, allow_unicode=True)


class _Row(list[float]):
    """A list that YAML writes on one line."""


def _plain(value: Any) -> Any:
    """Turn tuples into lists and mappings into dicts, which YAML writes without tags."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value
