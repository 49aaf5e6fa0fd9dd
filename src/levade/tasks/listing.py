"""What the built-in tasks say of themselves, without loading their robots: a package that holds a robot's files may be missing.

list(available_tasks())                     # those that can be loaded here
missing_package(overview("kneel").robot)    # None, or "robot mjlab:unitree_g1: mjlab is not installed; pip install ..."
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from levade.errors import MissingPackage
from levade.robots import missing_package
from levade.tasks.document import load_task
from levade.tasks.files import BY_VARIANT, VARIANT, VARIANTS, builtin_tasks, is_builtin, read
from levade.tasks.parts import RobotChoice
from levade.tasks.task import Task
from levade.tasks.variants import described


@dataclass(frozen=True)
class Overview:
    """What a task file says of itself.

    Attributes:
        name: Name of the task.
        description: One line for listings.
        robot: Name of its robot.
    """

    name: str
    description: str
    robot: str


def overview(name_or_path: str) -> Overview:
    """Read what a task file says of itself.

    Args:
        name_or_path: Name of a built-in task, or path of a YAML file.

    Returns:
        Its name, description and robot.

    Raises:
        LevadeError: If there is no such file, or it cannot be read.
    """
    content = read(name_or_path)
    robot = content.get("robot")
    chosen = robot.get("name") if isinstance(robot, dict) else None
    about = str(content.get("description", ""))
    if (variant := content.get(VARIANT)) is not None:
        for table in (content.get(BY_VARIANT, {}).get(name, {}) for name in (VARIANTS[0], variant)):
            about = str(table.get("description", about))
        about = described(about, variant)
    return Overview(str(content.get("name", name_or_path)), about, str(chosen or RobotChoice().name))


def available_tasks() -> dict[str, Path]:
    """List the built-in tasks that can be loaded: those whose robot's files are installed.

    Returns:
        Name -> file, sorted by name.
    """
    robots = {name: overview(name).robot for name in builtin_tasks()}
    there = {robot for robot in set(robots.values()) if missing_package(robot) is None}
    return {name: path for name, path in builtin_tasks().items() if robots[name] in there}


def is_unchanged(task: Task) -> bool:
    """Tell whether a task is the built-in one of its name, unchanged.

    Args:
        task: The task.

    Returns:
        Whether it is. False if the built-in one cannot be loaded, because the package of its robot is not installed.
    """
    if not is_builtin(task.name):
        return False
    try:
        return load_task(task.name) == task
    except MissingPackage:
        return False
