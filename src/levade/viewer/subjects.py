"""Find what ``levade view`` shows: a motion, a robot or a task, from the user's text.

found = find("rearing")             # a Task, a Robot or the path of a motion
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from levade.document import read_yaml
from levade.errors import LevadeError, did_you_mean
from levade.robots import Robot, builtin_robots, find_package_robot, load_robot
from levade.search.run import MOTION, TASK
from levade.tasks import Task, builtin_tasks, builtin_variants, load_task

_KINDS = {"task": ("costs", "success", "horizon", "policy", "extends"), "robot": ("legs", "model", "trunk", "postures")}
"""Kind -> keys that occur only in its YAML."""


@dataclass(frozen=True)
class Found:
    """Exactly one attribute is not None.

    Attributes:
        motion: File of a motion.
    """

    task: Task | None = None
    robot: Robot | None = None
    motion: Path | None = None


def find(name: str) -> Found:
    """Find a built-in robot or task by name, or a file: a motion.npz, a robot.yaml, a task, or the directory of one.

    Names come first; ``./name`` is the directory.

    Args:
        name: The user's text.

    Returns:
        What it names.

    Raises:
        LevadeError: If it names nothing, or two things.
    """
    robots, tasks = [robot for robot, _ in builtin_robots()], [*builtin_tasks(), *builtin_variants()]
    if name in robots and name in tasks:
        raise LevadeError(f"view: {name} is a built-in robot and a built-in task; give the file of the one you mean")
    if name in robots:
        return Found(robot=load_robot(name))
    if name in tasks:
        return Found(task=load_task(name))
    path = Path(name)
    if ":" in name and not path.exists() and find_package_robot(name) is not None:
        return Found(robot=load_robot(name))
    if path.is_dir():
        path = _in_directory(path)
    if not path.is_file():
        if path.suffix or "/" in name or "\\" in name:
            raise LevadeError(f"{path}: no such file; give a motion.npz, a robot.yaml or a task's YAML file")
        raise LevadeError(f"view: no robot, task or file {name!r}; {did_you_mean(name, [*robots, *tasks])}")
    if path.suffix in (".yaml", ".yml"):
        return _from_yaml(path)
    if path.suffix in (".xml", ".urdf", ".mjcf"):
        return Found(robot=load_robot(path))
    return Found(motion=path)


def _in_directory(directory: Path) -> Path:
    """Return the one file of a directory that can be shown; for a run, the motion."""
    robot, motion, task = (directory / name for name in ("robot.yaml", MOTION, TASK))
    if robot.is_file() and motion.is_file():
        raise LevadeError(f"{directory}: holds a robot and a motion; say {robot} or {motion}")
    for path in (robot, motion, task):
        if path.is_file():
            return path
    raise LevadeError(f"{directory}: holds no robot.yaml, {MOTION} or {TASK}; give a file")


def _from_yaml(path: Path) -> Found:
    keys = read_yaml(path).keys()
    kinds = [kind for kind, own in _KINDS.items() if keys & set(own)]
    if len(kinds) != 1:
        what = "both of a task and of a robot" if kinds else "neither of a task nor of a robot"
        raise LevadeError(f"{path}: has keys {what}; a task has costs and success, a robot legs and a model")
    return Found(task=load_task(path)) if kinds == ["task"] else Found(robot=load_robot(path))
