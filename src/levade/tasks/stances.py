"""Stances: how a task differs with the way a robot stands, and how a robot lies on its back, front or side.

A task file is written once for all robots. Its table ``stances`` gives changes for robots on two legs (``upright``) or on limbs
that point outward (``sprawled``), or says in one line why the task does not apply to them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any

from levade.document import kind_of
from levade.errors import LevadeError, did_you_mean
from levade.robots import Robot
from levade.robots.naming import require_joints
from levade.tasks.files import BY_STANCE, extended

if TYPE_CHECKING:
    from levade.tasks.task import Task

STANCES = ("level", "upright", "sprawled")
"""See `levade.robots.Robot.stance`."""
LYING = "lying"

ATTITUDES: dict[str, dict[str, tuple[str, str]]] = {
    "level": {
        "back": ("180 deg", "0 deg"),
        "front": ("0 deg", "0 deg"),
        "left": ("-90 deg", "0 deg"),
        "right": ("90 deg", "0 deg"),
    },
    "upright": {
        "back": ("0 deg", "-90 deg"),
        "front": ("0 deg", "90 deg"),
        "left": ("-90 deg", "0 deg"),
        "right": ("90 deg", "0 deg"),
    },
}
ATTITUDES["sprawled"] = ATTITUDES["level"]
"""Stance -> side that a robot lies on -> roll and pitch of its trunk. Up on four legs is ahead on two."""


def on_robot(content: Mapping[str, Any], robot: Callable[[], Robot], where: str) -> dict[str, Any]:
    """Resolve ``stances`` and ``lying`` in the tables of a task.

    Args:
        content: The tables.
        robot: Loads the robot; called only if one of the keys is there.
        where: Place of the tables, for messages.

    Returns:
        The tables without these keys.

    Raises:
        LevadeError: As `for_stance` and `as_attitude` do.
    """
    content = dict(content)
    if BY_STANCE in content:
        content = for_stance(content, robot(), where)
    start = content.get("start")
    fall = start.get("fall") if isinstance(start, Mapping) else None
    if isinstance(start, Mapping) and isinstance(fall, Mapping) and LYING in fall:
        content["start"] = {**start, "fall": as_attitude(fall, robot(), f"{where}.start.fall")}
    return content


def for_stance(content: Mapping[str, Any], robot: Robot, where: str, *, nulls: bool = False) -> dict[str, Any]:
    """Apply the changes that a task makes for a robot's stance.

    Args:
        content: The tables of the task, with ``stances``.
        robot: The robot.
        where: Place of the tables, for messages.
        nulls: Whether to keep costs and criteria that are null, because the result is itself a table of changes.

    Returns:
        The tables for this robot, without ``stances``.

    Raises:
        LevadeError: If a stance does not exist, or the task does not apply to such a robot.
    """
    content = dict(content)
    stances = content.pop(BY_STANCE)
    if not isinstance(stances, Mapping):
        raise LevadeError(f"{where}.{BY_STANCE}: should be a table such as {{upright: {{...}}}}, is {kind_of(stances)}")
    for name, changes in stances.items():
        if name not in STANCES:
            raise LevadeError(f"{where}.{BY_STANCE}: no stance {name!r}; {did_you_mean(str(name), STANCES)}")
        if not isinstance(changes, (str, Mapping)):
            raise LevadeError(
                f"{where}.{BY_STANCE}.{name}: should be a table of changes, or a text that says why the task does not apply, is"
                f" {kind_of(changes)}"
            )
    changes = stances.get(robot.stance, {})
    if isinstance(changes, str):
        raise LevadeError(f"{content.get('name', where)}: does not apply to {robot.name}: {changes}")
    return extended(content, dict(changes), nulls=nulls)


def as_attitude(fall: Mapping[str, Any], robot: Robot, where: str) -> dict[str, Any]:
    """Turn the side that ``lying`` names into the roll and pitch of a fall.

    Args:
        fall: Table of the fall, with ``lying``.
        robot: The robot.
        where: Place of the table, for messages.

    Returns:
        The table with roll and pitch, without ``lying``.

    Raises:
        LevadeError: If there is no such side.
    """
    table = dict(fall)
    side = table.pop(LYING)
    attitudes = ATTITUDES[robot.stance]
    if not isinstance(side, str) or side not in attitudes:
        raise LevadeError(f"{where}.{LYING}: no side {side!r}; {did_you_mean(str(side), attitudes)}")
    table["roll"], table["pitch"] = attitudes[side]
    if robot.ahead < 0 and side in ("back", "front"):
        table["pitch"] = attitudes["front" if side == "back" else "back"][1]
    return table


def check_postures(task: Task, written: Task, own: str, robot: Robot | None) -> None:
    """Check that the postures of a task file, which may be angles of its own robot's joints, mean something on another one.

    Args:
        task: The task, with the other robot.
        written: The task before changes of single values, which are for the other robot.
        own: Name of the robot that the task file names.
        robot: The other robot, if it is already loaded.

    Raises:
        LevadeError: If a posture names a joint that the other robot lacks.
    """
    before = list(_postures(written))
    postures = [posture for posture in _postures(task) if posture in before]
    if not postures:
        return
    robot = robot or task.robot.load()
    for where, posture in postures:
        for key in posture:
            named = require_joints(robot, key, f"{task.name}: does not apply to {robot.name}: {where}")
            if not named and not any(fnmatchcase(joint, key) for joint in robot.joint_names):
                raise LevadeError(
                    f"{task.name}: does not apply to {robot.name}: its postures are angles of {own}'s joints ({where}: {key});"
                    f" give it postures of {robot.name} in a task that extends it"
                )


def _postures(task: Task) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the place and the table of every posture of a task that is not just a name."""
    start = task.start
    named = [("start.settled.posture", start.settled and start.settled.posture)]
    named += [("start.fall.posture", start.fall and start.fall.posture), ("policy.goal", task.policy.goal)]
    named += [("policy.through", posture) for posture in task.policy.through]
    yield from ((where, posture) for where, posture in named if isinstance(posture, Mapping))
