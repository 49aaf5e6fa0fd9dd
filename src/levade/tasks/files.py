"""Files of tasks: the built-in ones, and what a task file names: a task to extend, a terrain, or what to end like.

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
from levade.errors import LevadeError, did_you_mean, located
from levade.scenes import read_heights

_BUILT_IN = Path(__file__).parent / "data"

EXTENDS = "extends"
"""Key of a task file that names another task, which has what this one leaves out."""

MERGED = ("scene", "physics", "policy", "costs", "success", "search", "robust", "feedback")
"""Tables of a task file of which one that extends another names only what it changes."""


def builtin_tasks() -> dict[str, Path]:
    """Name -> file of every built-in task, by name."""
    return {path.stem: path for path in sorted(_BUILT_IN.glob("*.yaml"), key=lambda path: path.stem)}


def find(name_or_path: str) -> Path:
    """The file of a built-in task, or of the path. Raises LevadeError if there is none."""
    tasks = builtin_tasks()
    if name_or_path in tasks:
        return tasks[name_or_path]
    path = Path(name_or_path)
    if path.is_file():
        return path
    if _is_path(name_or_path):
        raise LevadeError(f"{path}: no such file; give a built-in task or the path of a YAML file")
    raise LevadeError(f"no task {name_or_path!r}; {did_you_mean(name_or_path, tasks)} (or the path of a YAML file)")


def asks_for_hardware(name_or_path: str, changes: Sequence[str]) -> bool:
    """Whether a task, with changes such as ``hardware=true``, asks for searches until a certificate passes.

    Raises:
        LevadeError: If its file cannot be read.
    """
    asked = None if name_or_path in builtin_tasks() else read_task(find(name_or_path)).get("hardware")
    for change in changes:
        name, _, text = change.partition("=")
        if name == "hardware":
            asked = parse_yaml(text, where=name)
    return asked not in (None, False)


def read_task(path: Path, *, seen: tuple[Path, ...] = ()) -> dict[str, Any]:
    """Read the tables of a task file, filled up from those of the task that it extends.

    A table changes the keys that it names, and a key that is null in ``costs`` or ``success`` is taken out of them. All else, a
    whole cost, criterion or start among them, replaces what the other task has.

    Args:
        path: The file. Paths in it are relative to it; those in the result are seen from here.
        seen: The files that extend it, for a clear message where they go in a circle.

    Raises:
        LevadeError: If a file cannot be read, or the task extends itself.
    """
    content = _with_folder(read_yaml(path), path.parent)
    if EXTENDS not in content:
        return content
    named = content.pop(EXTENDS)
    with located(f"{path}: {EXTENDS}: "):
        if not isinstance(named, str):
            raise LevadeError(f"should be the name or the file of a task, is {kind_of(named)}")
        other = find(str(path.parent / named) if _is_beside(path.parent, named) else named)
    seen = (*seen, path.resolve())
    if other.resolve() in seen:
        names = " extends ".join(one.name for one in (*seen, other))
        raise LevadeError(f"{path}: {EXTENDS}: {names}, in a circle; begin from a task of its own")
    if not isinstance(content.get("name"), str):
        raise LevadeError(f"{path}: name: is missing; a task that extends {named} has a name of its own")
    return extended(read_task(other, seen=seen), content)


def extended(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """The tables of a task with the changes of one that extends it."""
    content = {**base, **changes}
    for name in MERGED:
        ours, theirs = changes.get(name), base.get(name)
        if not (isinstance(ours, Mapping) and isinstance(theirs, Mapping)):
            continue
        table = {**{key: value for key, value in theirs.items() if key not in ours}, **ours}
        if name == "search" and "optimizer" in ours and "settings" not in ours:
            table.pop("settings", None)  # they are the other optimizer's
        if name in ("costs", "success"):
            table = {key: value for key, value in table.items() if value is not None}
        content[name] = table
    return content


def _is_path(text: str) -> bool:
    """Whether a text is the path of a file, there or not, and no name of a built-in task."""
    return Path(text).suffix in (".yaml", ".yml", ".npz") or "/" in text or "\\" in text


def _with_folder(content: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The tables of a task file in a folder, the paths in them as seen from here."""
    content = dict(content)
    for part, key, name in (("scene", "terrain", "file"), ("policy", "goal", "like")):
        table = content.get(part)
        inner = table.get(key) if isinstance(table, Mapping) else None
        if not (isinstance(table, Mapping) and isinstance(inner, Mapping) and isinstance(inner.get(name), str)):
            continue
        if name == "file" or _is_beside(folder, inner[name]):
            content[part] = {**table, key: {**inner, name: str(folder / inner[name])}}
    return content


def _is_beside(folder: Path, like: str) -> bool:
    """Whether a text means a file as seen from a folder, and no built-in task."""
    return like not in builtin_tasks() and (_is_path(like) or (folder / like).is_file())


def with_goal(policy: Any, where: str) -> Any:
    """The policy with the posture in which another task or a motion starts, where its goal is ``{like: TASK}``.

    Raises:
        LevadeError: If there is no such task or motion, or it does not start standing in a posture.
    """
    goal = policy.get("goal") if isinstance(policy, Mapping) else None
    if not (isinstance(goal, Mapping) and "like" in goal):
        return policy
    if len(goal) > 1:
        raise LevadeError(f"{where}: like stands alone; leave out {', '.join(map(str, goal.keys() - {'like'}))}")
    like = str(goal["like"])
    with located(f"{where}.like: "):
        motion = Path(like).suffix == ".npz"
        posture = _start_of_motion(Path(like)) if motion else _start_of_task(like)
    if posture is None:
        kind = "motion" if motion else "task"
        raise LevadeError(f"{where}.like: {like} does not start standing in a posture; name a {kind} that does")
    return {**policy, "goal": posture}


def _start_of_task(name_or_path: str) -> Any:
    """The posture in which a task starts; None if it does not start standing."""
    start = read_task(find(name_or_path)).get("start", {"settled": {}})
    settled = start.get("settled", {}) if isinstance(start, Mapping) and len(start) < 2 else None
    if not isinstance(settled, Mapping) or (start and "settled" not in start):
        return None
    return settled.get("posture", "neutral")


def _start_of_motion(path: Path) -> dict[str, float] | None:
    """What the joints were commanded before a motion started [rad], by joint; None if it started from a fall.

    A motion is a room above tasks, so that a few of its arrays are read here. `levade.motions.file` checks all of them.
    """
    arrays = unpack(path)
    names, first = arrays.get("joint_names"), arrays.get("joint_position_reference0")
    if names is None or first is None:
        raise LevadeError(
            f"{path}: does not say what its joints were commanded before the start; make the motion again"
        )
    try:
        start = json.loads(str(arrays["meta"]))["task"]["start"]
        posture = {str(name): float(angle) for name, angle in zip(names, first, strict=True)}
        if not np.isfinite(list(posture.values())).all() or any(map(hides, posture)):
            raise ValueError
    except (ValueError, TypeError, LookupError, RecursionError):
        raise LevadeError(f"{path}: its start cannot be read; damaged, or not a motion.npz of levade solve") from None
    fell = not isinstance(start, Mapping) or any(start.get(name) is not None for name in ("fall", "fallen"))
    return None if fell else posture


def with_heights(scene: Any, where: str) -> Any:
    """The scene with its terrain's heights instead of the file that they are in."""
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
        raise LevadeError(f"{where}.height: should be a positive height, that of white, is {kind_of(height)}")
    try:
        return {**scene, "terrain": {**terrain, "heights": read_heights(Path(file), height)}}
    except LevadeError as error:
        raise LevadeError(f"{where}.file: {error}") from None
