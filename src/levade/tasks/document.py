"""Tasks from YAML: reading, and changing single values by their path. `levade.tasks.writing` writes them."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from levade.costs.quantities import QUANTITIES
from levade.document import CONTROL, build, check_keys, kind_of, parse_yaml, read_text
from levade.errors import LevadeError, did_you_mean
from levade.optimizers import canonical
from levade.robots import Dimensions, Robot, dimensions, load_robot
from levade.tasks import stances
from levade.tasks.code import (
    KEY,
    MissingCode,
    criterion_of_missing,
    missing_code,
)
from levade.tasks.families import with_family
from levade.tasks.files import VARIANT, builtin_variants, extended, find, read, with_goal, with_heights
from levade.tasks.parts import Cost, RobotChoice
from levade.tasks.task import Task
from levade.tasks.terms import TERMS
from levade.tasks.units import is_number, measure_of, to_si
from levade.tasks.variants import OF_SEARCH, check_variants, described, planned, variant_changes, variant_text
from levade.tasks.writing import task_to_dict


def task_text(name_or_path: str | Path) -> str:
    """Read the text of a task file, comments included.

    Args:
        name_or_path: Name of a built-in task or of a variant of one, or path of a YAML file.

    Returns:
        The text. For a variant, that of a file that extends its task.

    Raises:
        LevadeError: If there is no such file, or it is not a text.
    """
    path = find(str(name_or_path))
    text = read_text(path)
    if CONTROL.search(text):
        raise LevadeError(f"{path}: is not a text file, as it contains control characters; give a YAML file")
    if (variant := builtin_variants().get(str(name_or_path))) is not None:
        return variant_text(str(name_or_path), *variant, text)
    return text


def load_task(name_or_path: str | Path, *, robot: str | Robot | None = None, changes: Sequence[str] = ()) -> Task:
    """Load a built-in task or a variant of one by name, or any task by the path of its YAML file.

    Args:
        name_or_path: Name of a built-in task or of a variant of one, such as "rearing-robust", or path of a YAML file.
        robot: A robot to use instead of the task's: its name, its file, or a `levade.robots.Robot`.
        changes: Changes of single values, "path=value" each, such as "costs.effort.weight=0.5". The path has to exist in the
            task with all its defaults, except for settings of the optimizer and whole costs and criteria, such as
            "success.apart={quantity: self_distance, minimum: 0, at: min}". A change of ``search.optimizer`` drops the
            settings of the task's own optimizer.

    Returns:
        The task.

    Raises:
        LevadeError: If the task cannot be read, or a value is wrong.
    """
    made, name = (robot, robot.name) if isinstance(robot, Robot) else (None, robot)
    path, content = find(str(name_or_path)), read(str(name_or_path))
    own = build(RobotChoice, content.get("robot") or {}, where=f"{path}.robot").name
    with_robot = [change for change in changes if change.partition("=")[0].startswith("robot.")]
    if name is not None or with_robot:  # first, because numbers may be in units of this robot
        content["robot"] = _other_robot(content.get("robot"), name, with_robot, where=str(path))
    task = written = task_from_dict(content, where=str(path), robot=made)
    rest = [change for change in changes if change not in with_robot]
    if rest:
        content = task_to_dict(task)
        for change in sorted(rest, key=lambda change: not change.startswith("search.optimizer=")):
            _apply(content, change)
            if (
                change.startswith("search.optimizer=")
                and canonical(content["search"]["optimizer"]) != task.search.optimizer
            ):
                content["search"]["settings"] = {}
        paths = [change.partition("=")[0].split(".") for change in rest]
        if isinstance(content["good_enough"], dict):  # as in a file that extends the task
            again = {path[1] for path in paths if path[0] == "success" and len(path) > 1}
            again |= set(content["good_enough"]) if ["success"] in paths else set()
            for key in again - {path[1] for path in paths if path[0] == "good_enough" and len(path) > 1}:
                content["good_enough"].pop(key, None)
        task = _changed(content, made)
    if task.robot.name != own:
        stances.check_postures(task, written, own, made)
    return task


def _other_robot(content: Any, name: str | None, changes: Sequence[str], *, where: str) -> dict[str, Any]:
    """Write the table of the robot with another robot's name, and with the changes made."""
    choice = build(RobotChoice, content or {}, where=f"{where}.robot")
    if name is not None:
        choice = dataclasses.replace(choice, name=name, actuation=None, variant=None, linkage=False)
    table: dict[str, Any] = {"robot": dataclasses.asdict(choice)}
    for change in changes:
        _apply(table, change)
    with _changing():
        return dataclasses.asdict(build(RobotChoice, table["robot"], where=f"{_CHANGES}.robot"))


def _changed(content: Mapping[str, Any], robot: Robot | None = None) -> Task:
    with _changing():
        return task_from_dict(content, where=_CHANGES, robot=robot)


_CHANGES = "changes"


@contextmanager
def _changing() -> Iterator[None]:
    """Attribute errors about values from a change to the field ``changes``."""
    try:
        yield
    except LevadeError as error:
        raise LevadeError(str(error).removeprefix(_CHANGES).lstrip(".: "), field=_CHANGES) from None


def task_from_dict(content: Mapping[str, Any], *, where: str, code: bool = False, robot: Robot | None = None) -> Task:
    """Make a task from the tables of its YAML file.

    It loads the robot if a number is in units of the robot, such as ``1.5 heights``.

    Args:
        content: The tables.
        where: Place of the tables, with which messages begin.
        code: Whether to accept costs that were Python code, as `task_to_dict` writes them for a motion file. Their terms
            become `levade.tasks.code.MissingCode`.
        robot: The task's robot, if it is already loaded. Defaults to the one that the task names.

    Returns:
        The task.

    Raises:
        LevadeError: If a key or value is missing, unknown or wrong.
    """
    content = dict(content)

    @functools.cache
    def chosen() -> Robot:
        if robot is not None:
            return robot
        choice = build(RobotChoice, content.get("robot", {}), where=f"{where}.robot")
        return load_robot(choice.name, variant=choice.variant)

    measures = functools.cache(lambda: dimensions(chosen()))
    checked = check_variants(content, where)
    if VARIANT in content:
        return _variant(content, chosen, where=where, robot=robot)
    content = with_family(stances.on_robot(checked, chosen, where), where)
    if isinstance(content.get("success"), Mapping):
        content["success"] = _with_quantities(content["success"], where)
        content |= _completed(content, where)
    costs = content.get("costs")
    if isinstance(costs, Mapping):
        content["costs"] = {
            name: {"term": name, **value} if isinstance(value, Mapping) else value for name, value in costs.items()
        }

    if isinstance(content.get("stages"), list) and isinstance(content.get("success"), Mapping):
        content["stages"] = [
            _tolerances(stage, content["success"], f"{where}.stages.{i}", measures)
            for i, stage in enumerate(content["stages"])
        ]
    content["hardware"] = _demands(content.get("hardware"))
    if not code:  # the task of a motion is complete, and names no files
        content["policy"] = with_goal(content.get("policy", {}), f"{where}.policy.goal")
        _check_keys(content, where)
    content = dict(to_si(content, where=where, robot=measures))
    _check_horizon(content.get("horizon", 0.0), where)
    if not code:
        content["scene"] = with_heights(content.get("scene", {}), f"{where}.scene.terrain")
    if isinstance(costs, Mapping):
        content["costs"] = {
            name: _cost(str(name), value, where=f"{where}.costs.{name}", code=code)
            for name, value in content["costs"].items()
        }
    optimizer = None
    if code:
        optimizer = _missing_optimizer(content)
        _without_code_in_criteria(content, where)
    task = build(Task, content, where=where)
    if optimizer is not None:
        missing, own = optimizer
        task = dataclasses.replace(task, search=dataclasses.replace(task.search, optimizer=missing, settings=own))
    return task


def _variant(content: dict[str, Any], chosen: Callable[[], Robot], *, where: str, robot: Robot | None) -> Task:
    """Make the variant that tables name: its task, with another goal if it has one, then the plan, then its own words."""
    variant, changes = content[VARIANT], variant_changes(content, chosen(), where)
    base = stances.on_robot(check_variants(content, where), chosen, where)
    for key in OF_SEARCH[1:]:  # the plan makes its own; it looks at the budget
        base.pop(key, None)
    task = task_from_dict(extended(base, changes.goal), where=where, robot=robot)
    made = task_to_dict(planned(task, variant, task.robot.load() if robot is None else robot, keep=changes.keep))
    made["description"] = described(task.description, variant)
    return task_from_dict(extended(made, changes.own), where=where, robot=robot)


def _check_keys(content: Mapping[str, Any], where: str) -> None:
    """Refuse unknown keys before units, because whether a value takes a unit depends on its key."""
    known = {key: value for key, value in content.items() if key not in ("costs", "horizon", "scene")}
    if isinstance(content.get("horizon"), Mapping):
        known["horizon"] = content["horizon"]
    scene = content.get("scene")
    if isinstance(scene, Mapping) and isinstance(terrain := scene.get("terrain"), Mapping) and "file" in terrain:
        scene = {key: value for key, value in scene.items() if key != "terrain"}  # `with_heights` checks it
    check_keys(Task, known if scene is None else {**known, "scene": scene}, where)
    costs = content.get("costs")
    for name, cost in costs.items() if isinstance(costs, Mapping) else ():
        if isinstance(cost, Mapping) and isinstance(cost["term"], str) and cost["term"] in TERMS:
            _check_cost_keys(cost, f"{where}.costs.{name}")


def _with_quantities(success: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Give each criterion its quantity, which defaults to its name."""
    named = {
        name: {"quantity": name, **value} if isinstance(value, Mapping) and name in QUANTITIES else value
        for name, value in success.items()
    }
    for name, value in named.items():
        if isinstance(value, Mapping) and "quantity" not in value:
            raise LevadeError(
                f"{where}.success.{name}: {name!r} is not a quantity; add the key quantity;"
                f" {did_you_mean(str(name), QUANTITIES)}"
            )
    return named


def _completed(content: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Complete criteria for perturbed models from the task's, so that ``{pitch: {tolerance: 0.1}}`` is enough."""
    success = content["success"]

    def filled(criteria: Mapping[str, Any], place: str) -> dict[str, Any]:
        for name in criteria:
            if name not in success:
                hint = did_you_mean(str(name), success) if success else "the task has none"
                raise LevadeError(f"{where}.{place}.{name}: is not a criterion of the task; {hint}")
        return {
            name: {**success[name], **value}
            if isinstance(value, Mapping) and isinstance(success[name], Mapping)
            else value
            for name, value in criteria.items()
        }

    found: dict[str, Any] = {}
    if isinstance(enough := content.get("good_enough"), Mapping):
        found["good_enough"] = filled(enough, "good_enough")
    robust = content.get("robust")
    if isinstance(robust, Mapping) and isinstance(enough := robust.get("success"), Mapping):
        found["robust"] = {**robust, "success": filled(enough, "robust.success")}
    return found


def _without_code(criteria: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Read criteria whose measures were Python code; leave the others."""
    return {
        name: criterion_of_missing(value, where=f"{where}.{name}")
        if isinstance(value, Mapping) and KEY in value
        else value
        for name, value in criteria.items()
    }


def _without_code_in_criteria(content: dict[str, Any], where: str) -> None:
    for key in ("success", "good_enough"):
        if isinstance(content.get(key), Mapping):
            content[key] = _without_code(content[key], f"{where}.{key}")
    robust = content.get("robust")
    if isinstance(robust, Mapping) and isinstance(robust.get("success"), Mapping):
        content["robust"] = {**robust, "success": _without_code(robust["success"], f"{where}.robust.success")}


def _demands(hardware: Any) -> Any:
    """Read the key hardware: true stands for the usual demands, false for no certificate."""
    if isinstance(hardware, bool):
        return {} if hardware else None
    return hardware


def _check_horizon(horizon: Any, where: str) -> None:
    """Raise LevadeError, naming both forms, for a horizon that is neither a number nor a table."""
    if isinstance(horizon, Mapping) or (isinstance(horizon, int | float) and not isinstance(horizon, bool)):
        return
    if isinstance(horizon, str) and is_number(horizon):
        return
    raise LevadeError(
        f"{where}.horizon: should be a number of seconds, or bounds for the search such as"
        f" {{minimum: 0.3 s, maximum: 1.5 s}}, is {kind_of(horizon)}"
    )


def _missing_optimizer(content: dict[str, Any]) -> tuple[MissingCode, Any] | None:
    """Remove an optimizer that was Python code from a task's tables, with its settings, and return both."""
    search = content.get("search")
    if not (isinstance(search, Mapping) and isinstance(search.get("optimizer"), Mapping)):
        return None
    name = search["optimizer"].get(KEY)
    content["search"] = {key: value for key, value in search.items() if key not in ("optimizer", "settings")}
    return MissingCode(str(name)), search.get("settings", {})


def _tolerances(stage: Any, success: Mapping[str, Any], where: str, robot: Callable[[], Dimensions]) -> Any:
    """Turn a stage's tolerances for promotion, each in the unit of its criterion, into SI."""
    if not (isinstance(stage, Mapping) and isinstance(stage.get("promote"), Mapping)):
        return stage
    promote = {
        name: to_si(value, where=f"{where}.promote.{name}", measures=measure_of(success.get(name)), robot=robot)
        for name, value in stage["promote"].items()
    }
    return {**stage, "promote": promote}


def _cost(name: str, content: Any, *, where: str, code: bool) -> Cost:
    if not isinstance(content, Mapping):
        raise LevadeError(f"{where}: should be a table such as {{weight: 1}}, is {kind_of(content)}")
    content = dict(content)
    if KEY in content:
        if not code:
            raise LevadeError(
                f"{where}: was Python code ({content[KEY]}), which is not in the file; give the task its function in Python"
            )
        missing, weight = missing_code(content, where=where)
        return Cost(missing, _weight(weight, where))
    term, weight = content.pop("term"), _weight(content.pop("weight", None), where)
    if not isinstance(term, str) or term not in TERMS:
        raise LevadeError(f"{where}: no term {term!r}; {did_you_mean(str(term), TERMS)}")
    _check_cost_keys({"term": term, **content}, where)
    return Cost(build(TERMS[term], content, where=where), weight)


def _check_cost_keys(content: Mapping[str, Any], where: str) -> None:
    valid = [*(field.name for field in dataclasses.fields(TERMS[content["term"]])), "term", "weight"]
    for key in content:
        if key not in valid and key != KEY:
            raise LevadeError(f"{where}: unknown key {key!r}; {did_you_mean(str(key), valid)}")


def _weight(weight: Any, where: str) -> float:
    if isinstance(weight, bool) or not isinstance(weight, (int, float)):
        raise LevadeError(f"{where}.weight: should be a number, is {'missing' if weight is None else kind_of(weight)}")
    return float(weight)


def _apply(content: dict[str, Any], change: str) -> None:
    """Change the value at a path of nested tables and lists."""
    path, equals, text = change.partition("=")
    if not equals:
        raise LevadeError(f"{change}: should be path=value, such as horizon=0.4", field=_CHANGES)
    with _changing():
        value = parse_yaml(text, where=f"{_CHANGES}.{path}")
    *parents, last = path.split(".")
    at: Any = content
    for i, key in enumerate([*parents, last]):
        keys = list(at) if isinstance(at, dict) else [str(n) for n in range(len(at))] if isinstance(at, list) else []
        new = i == len(parents) and _may_add(".".join(parents), value)
        if key not in keys and not new:
            place = ".".join(parents[:i]) or "the task"
            if not keys:
                what = "empty" if isinstance(at, (dict, list)) else f"a single value, {kind_of(at)}"
                raise LevadeError(f"{path}: {place} is {what}; set it as a whole", field=_CHANGES)
            raise LevadeError(f"{path}: no {key!r} in {place}; {did_you_mean(key, keys)}", field=_CHANGES)
        index: Any = int(key) if isinstance(at, list) else key
        if i == len(parents):
            at[index] = value
        else:
            at = at[index]


def _may_add(table: str, value: Any) -> bool:
    """Find out whether a change may add to a table, where the task itself reports a wrong name."""
    return table in ("search.settings", "start.fall") or (
        table in ("costs", "success", "good_enough") and isinstance(value, Mapping)
    )
