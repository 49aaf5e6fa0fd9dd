"""Findings about a robot's file, and what to do about them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Finding:
    """Describes one thing worth knowing about a robot.

    Attributes:
        kind: "note" for something that levade chose or left out, "warning" for something that may spoil the motion.
        where: Joint, body, geom or file.
        what: One line.
        remedy: What to change, and where. Empty for notes that need no action.
    """

    kind: Literal["note", "warning"]
    where: str
    what: str
    remedy: str = ""

    def __str__(self) -> str:
        return f"{self.where}: {self.what}" + (f"; {self.remedy}" if self.remedy else "")


def note(where: str, what: str, remedy: str = "") -> Finding:
    """Make a `Finding` about something that levade chose.

    Args:
        where: Joint, body, geom or file.
        what: One line.
        remedy: What to change, and where. Empty if there is nothing to do.

    Returns:
        The finding.
    """
    return Finding("note", where, what, remedy)


def warning(where: str, what: str, remedy: str) -> Finding:
    """Make a `Finding` about something that may spoil the motion.

    Args:
        where: Joint, body, geom or file.
        what: One line.
        remedy: What to change, and where.

    Returns:
        The finding.
    """
    return Finding("warning", where, what, remedy)


def some(names: Sequence[str], most: int = 4) -> str:
    """Join names; of many, give the first few and the number of the others.

    Args:
        names: The names.
        most: Largest number of names to give.

    Returns:
        The names, separated by commas.
    """
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def named(kind: str, names: Sequence[str]) -> str:
    """Name the joints, links or bodies that share a finding, such as "joints a, b, c, d and 8 more".

    Args:
        kind: What they are, in the singular, such as "joint" or "body".
        names: Their names.

    Returns:
        The kind, in the plural if there are several, and the names.
    """
    plural = kind if len(names) == 1 else {"body": "bodies", "foot": "feet"}.get(kind, f"{kind}s")
    return f"{plural} {some(names)}"


def named_joints(names: Sequence[str], of: int) -> str:
    """Name the joints that share a finding, such as "joints a and b", or "all joints".

    Args:
        names: Their names.
        of: Number of joints that the robot has.

    Returns:
        The text.
    """
    return "all joints" if len(names) == of else named("joint", names)


def counted(number: int, noun: str) -> str:
    """Combine a number with a noun in singular or plural, such as "1 geom" and "2 geoms".

    Args:
        number: The number.
        noun: The noun in the singular. Its plural ends in "s".

    Returns:
        The text.
    """
    return f"{number} {noun}{'' if number == 1 else 's'}"
