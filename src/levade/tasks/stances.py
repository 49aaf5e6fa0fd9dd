"""Stances: what of a task differs with how a robot stands, and how a robot lies on its back, front or side.

A task file is written once for all robots. Its table ``stances`` says what is different on two legs (``upright``) or on limbs
that point outward (``sprawled``), or in one line why the task means nothing there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from levade.document import kind_of
from levade.errors import LevadeError, did_you_mean
from levade.robots import Robot
from levade.tasks.files import extended

STANCES = ("level", "upright", "sprawled")
"""See `levade.robots.Robot.stance`."""
KEY, LYING = "stances", "lying"

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
"""Stance -> side that a robot lies on -> roll and pitch of its trunk. What is up on four legs is ahead on two."""


def on_robot(content: Mapping[str, Any], robot: Callable[[], Robot], where: str) -> dict[str, Any]:
    """The tables of a task without ``stances`` and ``lying``; the robot is asked for where there are such.

    Raises:
        LevadeError: As `for_stance` and `as_attitude`.
    """
    content = dict(content)
    if KEY in content:
        content = for_stance(content, robot(), where)
    start = content.get("start")
    fall = start.get("fall") if isinstance(start, Mapping) else None
    if isinstance(start, Mapping) and isinstance(fall, Mapping) and LYING in fall:
        content["start"] = {**start, "fall": as_attitude(fall, robot(), f"{where}.start.fall")}
    return content


def for_stance(content: Mapping[str, Any], robot: Robot, where: str) -> dict[str, Any]:
    """The tables of a task for a robot: what its stance changes is in place, and ``stances`` is gone.

    Raises:
        LevadeError: If a stance does not exist, or the task means nothing on such a robot.
    """
    content = dict(content)
    stances = content.pop(KEY)
    if not isinstance(stances, Mapping):
        raise LevadeError(f"{where}.{KEY}: should be a table such as {{upright: {{...}}}}, is {kind_of(stances)}")
    for name, changes in stances.items():
        if name not in STANCES:
            raise LevadeError(f"{where}.{KEY}: no stance {name!r}; {did_you_mean(str(name), STANCES)}")
        if not isinstance(changes, (str, Mapping)):
            raise LevadeError(
                f"{where}.{KEY}.{name}: should be a table of changes, or a text that says why the task means nothing, is"
                f" {kind_of(changes)}"
            )
    changes = stances.get(robot.stance, {})
    if isinstance(changes, str):
        raise LevadeError(f"{content.get('name', where)}: means nothing on {robot.name}: {changes}")
    return extended(content, dict(changes))


def as_attitude(fall: Mapping[str, Any], robot: Robot, where: str) -> dict[str, Any]:
    """A fall with the roll and pitch at which a robot comes to lie on the side that ``lying`` names.

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
