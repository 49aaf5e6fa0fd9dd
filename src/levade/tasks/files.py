"""Files of tasks: the built-in ones, and those that a task file names: a task to extend, a terrain, or a goal.

A path in a task file is relative to the task file. A run's ``task.yaml`` is complete: it has heights and angles, and no paths.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from levade.archive import unpack
from levade.document import hides, kind_of, parse_yaml, read_yaml
from levade.errors import LevadeError, did_you_mean, located, nearest
from levade.scenes import read_heights

_BUILT_IN = Path(__file__).parent / "data"

EXTENDS = "extends"
"""Key of a task file that names another task, from which it takes everything that it leaves out."""

BY_STANCE = "stances"
"""Key of a task file with what differs by how a robot stands: see `levade.tasks.stances`."""

VARIANT, BY_VARIANT = "variant", "variants"
"""Keys of a task file: which variant of the task that it extends it is, and what a task's variants change: see
`levade.tasks.variants`."""

VARIANTS = ("robust", "within-limits")
"""Variants of every task. Each built-in one has a name, such as rearing-robust."""

MERGED = ("scene", "physics", "policy", "costs", "success", "good_enough", "search", "robust", "feedback")
"""Tables of which a task that extends another one names only the keys that it changes."""


def builtin_tasks() -> dict[str, Path]:
    """List the built-in tasks, without their variants.

    Returns:
        Name -> file, sorted by name.
    """
    return {path.stem: path for path in sorted(_BUILT_IN.glob("*.yaml"), key=lambda path: path.stem)}


def builtin_variants() -> dict[str, tuple[str, str]]:
    """List the variants of the built-in tasks.

    Returns:
        Name -> task and variant, such as "rearing-robust" -> ("rearing", "robust").
    """
    return {f"{task}-{variant}": (task, variant) for task in builtin_tasks() for variant in VARIANTS}


def is_builtin(name: str) -> bool:
    """Find out whether a name is that of a built-in task or of a variant of one.

    Args:
        name: The name.

    Returns:
        Whether it is.
    """
    return name in builtin_tasks() or name in builtin_variants()


def find(name_or_path: str) -> Path:
    """Find the file of a task.

    Args:
        name_or_path: Name of a built-in task or of a variant of one, or path of a YAML file.

    Returns:
        The file; for a variant, that of its task.

    Raises:
        LevadeError: If there is none.
    """
    tasks, variants = builtin_tasks(), builtin_variants()
    if name_or_path in tasks:
        return tasks[name_or_path]
    if name_or_path in variants:
        return tasks[variants[name_or_path][0]]
    path = Path(name_or_path)
    if path.is_file():
        return path
    if _is_path(name_or_path):
        raise LevadeError(f"{path}: no such file; give a built-in task or the path of a YAML file")
    near = nearest(name_or_path, [*tasks, *variants])
    raise LevadeError(
        f"no task {name_or_path!r}; {did_you_mean(name_or_path, near or tasks)} (or the path of a YAML file)"
    )


def read(name_or_path: str) -> dict[str, Any]:
    """Read the tables of a task, completed from those of the tasks that it extends.

    Args:
        name_or_path: Name of a built-in task or of a variant of one, or path of a YAML file.

    Returns:
        The tables; those of a variant name it with the key ``variant``.

    Raises:
        LevadeError: As `find` and `read_task` do.
    """
    return _read(name_or_path, ())


def _read(name_or_path: str, seen: tuple[Path, ...]) -> dict[str, Any]:
    content = read_task(find(name_or_path), seen=seen)
    if name_or_path in (variants := builtin_variants()):
        return _as_variant(content, variants[name_or_path][1], {"name": name_or_path}, where=name_or_path)
    return content


def _as_variant(content: Mapping[str, Any], variant: Any, own: dict[str, Any], *, where: str) -> dict[str, Any]:
    """Make the tables of a task those of a variant of it, whose own words win over what the task changes in the variant."""
    if variant not in VARIANTS:
        raise LevadeError(f"{where}: {VARIANT}: no variant {variant!r}; {did_you_mean(str(variant), VARIANTS)}")
    if BY_VARIANT in own:
        raise LevadeError(f"{where}: {BY_VARIANT}: a variant has none of its own; name what it changes without it")
    table = content.get(BY_VARIANT, {})
    if not (isinstance(table, Mapping) and isinstance(table.get(variant, {}), Mapping)):
        return {**content, VARIANT: variant}  # `levade.tasks.variants` reports it
    at_once = {key: own[key] for key in ("name", "robot") if key in own}
    changes = extended(
        dict(table.get(variant, {})), {key: value for key, value in own.items() if key != "robot"}, nulls=True
    )
    return {
        **content,
        **at_once,
        "hardware": changes.get("hardware"),
        VARIANT: variant,
        BY_VARIANT: {**table, variant: changes},
    }


def asks_for_hardware(name_or_path: str, changes: Sequence[str]) -> bool:
    """Find out whether a task asks for searches until a certificate passes.

    Args:
        name_or_path: Name of a built-in task, or path of a YAML file.
        changes: Changes of single values, such as "hardware=true".

    Returns:
        Whether the task asks for it, with the changes made.

    Raises:
        LevadeError: If its file cannot be read.
    """
    asked = None if is_builtin(name_or_path) else read(name_or_path).get("hardware")
    for change in changes:
        name, _, text = change.partition("=")
        if name == "hardware":
            asked = parse_yaml(text, where=name)
    return asked not in (None, False)


def read_task(path: Path, *, seen: tuple[Path, ...] = ()) -> dict[str, Any]:
    """Read the tables of a task file, completed from those of the task that it extends.

    A table changes the keys that it names, and a key that is null in ``costs`` or ``success`` is removed. Everything else, such
    as a whole cost, criterion or start, replaces that of the other task. The same holds for what the other task changes in its
    ``stances``, and for a variant of the other task.

    Args:
        path: The file. Paths in it are relative to it; those in the result, to the working directory.
        seen: The files that extend it, to detect a circle.

    Returns:
        The tables.

    Raises:
        LevadeError: If a file cannot be read, or the task extends itself.
    """
    content = _with_folder(read_yaml(path), path.parent)
    variant = content.pop(VARIANT, None)
    if EXTENDS not in content:
        if variant is not None:
            raise LevadeError(f"{path}: {VARIANT}: is that of another task; name the task with {EXTENDS}")
        return content
    named = content.pop(EXTENDS)
    with located(f"{path}: {EXTENDS}: "):
        if not isinstance(named, str):
            raise LevadeError(f"should be the name or the file of a task, is {kind_of(named)}")
        named = str(path.parent / named) if _is_beside(path.parent, named) else named
        other = find(named)
    seen = (*seen, path.resolve())
    if other.resolve() in seen:
        names = " extends ".join(one.name for one in (*seen, other))
        raise LevadeError(f"{path}: {EXTENDS}: {names}, in a circle; extend a task that does not extend this one")
    if not isinstance(content.get("name"), str):
        raise LevadeError(f"{path}: name: is missing; give the task that extends {named} a name of its own")
    theirs = _read(named, seen)
    if variant is not None or VARIANT in theirs:
        if variant is not None and VARIANT in theirs:
            raise LevadeError(f"{path}: {VARIANT}: {named} is a variant already; extend its task instead")
        return _as_variant(theirs, theirs.get(VARIANT, variant), content, where=str(path))
    merged = extended(theirs, content)
    if isinstance(theirs.get(BY_STANCE), Mapping):
        merged[BY_STANCE] = _extended_stances(theirs[BY_STANCE], content)
    return merged


def _extended_stances(theirs: Mapping[str, Any], content: dict[str, Any]) -> Any:
    """Merge the stances of a task with one that extends it, so that what the latter says itself holds for every stance."""
    own = content.get(BY_STANCE, {})
    if not isinstance(own, Mapping):
        return own  # `levade.tasks.stances` reports it
    plain = {key: value for key, value in content.items() if key != BY_STANCE}
    merged = dict(own)
    for name, changes in theirs.items():
        mine = own.get(name, {})
        if isinstance(changes, Mapping) and isinstance(mine, Mapping):
            both = extended(dict(changes), plain, nulls=True)
            merged[name] = extended(both, dict(mine), nulls=True)
        elif name not in own:
            merged[name] = changes
    return merged


def extended(base: dict[str, Any], changes: dict[str, Any], *, nulls: bool = False) -> dict[str, Any]:
    """Merge the tables of a task with those of one that extends it.

    Args:
        base: Tables of the task.
        changes: Tables of the task that extends it.
        nulls: Whether to keep costs and criteria that are null, because the result is itself a table of changes.

    Returns:
        The merged tables.
    """
    again, enough = changes.get("success"), base.get("good_enough")
    if isinstance(again, Mapping) and isinstance(enough, Mapping):  # what is stated anew holds on perturbed models, too
        base = {**base, "good_enough": {key: value for key, value in enough.items() if key not in again}}
    content = {**base, **changes}
    for name in MERGED:
        ours, theirs = changes.get(name), base.get(name)
        if not (isinstance(ours, Mapping) and isinstance(theirs, Mapping)):
            continue
        table = {**{key: value for key, value in theirs.items() if key not in ours}, **ours}
        if name == "search" and "optimizer" in ours and "settings" not in ours:
            table.pop("settings", None)  # they belong to the other optimizer
        if name in ("costs", "success", "good_enough") and not nulls:
            table = {key: value for key, value in table.items() if value is not None}
        content[name] = table
    return content


def _is_path(text: str) -> bool:
    """Find out whether a text is the path of a file, which may not exist, and not the name of a built-in task."""
    return Path(text).suffix in (".yaml", ".yml", ".npz") or "/" in text or "\\" in text


def _with_folder(content: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Make the paths in a task file, which are relative to its folder, relative to the working directory."""
    content = dict(content)
    for part, key, name in (("scene", "terrain", "file"), ("policy", "goal", "like")):
        table = content.get(part)
        inner = table.get(key) if isinstance(table, Mapping) else None
        if not (isinstance(table, Mapping) and isinstance(inner, Mapping) and isinstance(inner.get(name), str)):
            continue
        if name == "file" or _is_beside(folder, inner[name]):
            content[part] = {**table, key: {**inner, name: str(folder / inner[name])}}
    for key in (BY_STANCE, BY_VARIANT):
        if isinstance(content.get(key), Mapping):
            content[key] = {
                name: _with_folder(changes, folder) if isinstance(changes, Mapping) else changes
                for name, changes in content[key].items()
            }
    return content


def _is_beside(folder: Path, like: str) -> bool:
    """Find out whether a text names a file relative to a folder, and not a built-in task."""
    return not is_builtin(like) and (_is_path(like) or (folder / like).is_file())


def with_goal(policy: Any, where: str) -> Any:
    """Resolve the policy's goal ``{like: TASK}`` to the posture in which that task or motion starts.

    Args:
        policy: Table of the policy.
        where: Place of the goal, for messages.

    Returns:
        The table with the posture; other tables as they are.

    Raises:
        LevadeError: If there is no such task or motion, or it does not start standing in a posture.
    """
    goal = policy.get("goal") if isinstance(policy, Mapping) else None
    if not (isinstance(goal, Mapping) and "like" in goal):
        return policy
    if len(goal) > 1:
        raise LevadeError(f"{where}: like takes no other keys; leave out {', '.join(map(str, goal.keys() - {'like'}))}")
    like = str(goal["like"])
    with located(f"{where}.like: "):
        motion = Path(like).suffix == ".npz"
        posture = _start_of_motion(Path(like)) if motion else _start_of_task(like)
    if posture is None:
        kind = "motion" if motion else "task"
        raise LevadeError(f"{where}.like: {like} does not start standing in a posture; name a {kind} that does")
    return {**policy, "goal": posture}


def _start_of_task(name_or_path: str) -> Any:
    """Find the posture in which a task starts; None if it does not start standing."""
    start = read(name_or_path).get("start", {"settled": {}})
    settled = start.get("settled", {}) if isinstance(start, Mapping) and len(start) < 2 else None
    if not isinstance(settled, Mapping) or (start and "settled" not in start):
        return None
    return settled.get("posture", "neutral")


def _start_of_motion(path: Path) -> dict[str, float] | None:
    """Read the commanded posture before a motion started [rad], by joint; None if it started from a fall.

    ``tasks`` may not import ``motions``, so this reads a few arrays itself. `levade.motions.file` checks all of them.
    """
    arrays = unpack(path)
    names, first = arrays.get("joint_names"), arrays.get("joint_position_reference0")
    if names is None or first is None:
        raise LevadeError(f"{path}: the joints' commanded posture before the start is missing; make the motion again")
    try:
        start = json.loads(str(arrays["meta"]))["task"]["start"]
        posture = {str(name): float(angle) for name, angle in zip(names, first, strict=True)}
        if not np.isfinite(list(posture.values())).all() or any(map(hides, posture)):
            raise ValueError
    except (ValueError, TypeError, LookupError, RecursionError):
        raise LevadeError(
            f"{path}: its start cannot be read; the file is damaged, or not a motion.npz of levade solve"
        ) from None
    fell = not isinstance(start, Mapping) or any(start.get(name) is not None for name in ("fall", "fallen"))
    return None if fell else posture


def with_heights(scene: Any, where: str) -> Any:
    """Read the heights of a scene's terrain, if the scene names a file of them.

    Args:
        scene: Table of the scene.
        where: Place of the terrain, for messages.

    Returns:
        The table with heights instead of the file; other tables as they are.

    Raises:
        LevadeError: If the file cannot be read, or a value of the terrain is wrong.
    """
    terrain = scene.get("terrain") if isinstance(scene, Mapping) else None
    if not isinstance(terrain, Mapping) or "file" not in terrain:
        return scene
    terrain = dict(terrain)
    file, height = terrain.pop("file"), terrain.pop("height", None)
    if "heights" in terrain:
        raise LevadeError(f"{where}: give heights or a file of them, not both")
    if not isinstance(file, str):
        raise LevadeError(f"{where}.file: should be the path of a file, is {kind_of(file)}")
    if height is not None and (isinstance(height, bool) or not isinstance(height, (int, float)) or not height > 0):
        raise LevadeError(f"{where}.height: should be the height of white in m, above 0, is {kind_of(height)}")
    try:
        return {**scene, "terrain": {**terrain, "heights": read_heights(Path(file), height)}}
    except LevadeError as error:
        raise LevadeError(f"{where}.file: {error}") from None
