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
    """Make a `Finding` about something that levade chose."""
    return Finding("note", where, what, remedy)


def warning(where: str, what: str, remedy: str) -> Finding:
    """Make a `Finding` about something that may spoil the motion."""
    return Finding("warning", where, what, remedy)


def some(names: Sequence[str], most: int = 4) -> str:
    """Join names; of many, give the first few and the number of the others."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def named(kind: str, names: Sequence[str]) -> str:
    """Name the joints, links or bodies that share a finding, such as "joints a, b, c, d and 8 more"."""
    plural = kind if len(names) == 1 else {"body": "bodies", "foot": "feet"}.get(kind, f"{kind}s")
    return f"{plural} {some(names)}"


def counted(number: int, noun: str) -> str:
    """Combine a number with a noun in singular or plural, such as "1 geom" and "2 geoms"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
