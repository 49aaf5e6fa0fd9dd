"""Turn the fields and actions that library errors name into options and commands."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from typing import Any

from levade.errors import LevadeError, Remedy

ACTIONS = {
    "resume": "levade solve --resume {at}",
    "solve again": "levade solve {at} --force",
    "replace": "--force",
    "elsewhere": "--out DIR",
    "hardware": "--hardware",
    "name tasks": "--tasks rearing",
    "give a plan": "levade bench FILE",
}
"""`levade.errors.Remedy.action` -> what to type. ``{at}`` is the file or directory that the action applies to."""


def in_flags(error: LevadeError, command: Any, arguments: Sequence[str]) -> str:
    """Write an error in the words of the command line.

    Args:
        error: The error. Its field becomes the option whose parameter has the same name. Other fields stay as they are.
        command: The command line, a click group.
        arguments: Arguments of the command line, which name the command.

    Returns:
        The message.
    """
    *most, last = [_typed(remedy) for remedy in error.remedies] or [""]
    what = f"{', '.join(most)}, or {last}" if most else last
    return f"{_begin(error.field, command, arguments)}{error.message}{what and f'; {what}'}"


def _begin(field: str | None, command: Any, arguments: Sequence[str]) -> str:
    if field is None:
        return ""
    for parameter in _command(command, arguments).params:
        option = max(parameter.opts, key=len, default="")
        if parameter.name == field and option.startswith("--"):
            # after a repeatable option comes the value that is wrong: --set horizon
            return f"{option} " if getattr(parameter, "multiple", False) else f"{option}: "
    return f"{field}: "


def _command(command: Any, arguments: Sequence[str]) -> Any:
    """Return the command that the arguments name, such as ``tasks show``."""
    for word in arguments:
        if word not in getattr(command, "commands", {}):
            break
        command = command.commands[word]
    return command


def _typed(remedy: Remedy) -> str:
    if remedy.action is None:
        return remedy.words
    return f"{remedy.words}: {ACTIONS[remedy.action].format(at=shlex.quote(str(remedy.at)))}"
