"""Findings: what levade noticed about a robot's file, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Finding:
    """One thing worth knowing about a robot.

    kind: "note", of what levade chose or left out, or "warning", of what may spoil the motion. where: joint, body, geom or
    file. what: one line. remedy: what to change, and where; empty for notes that ask for nothing.
    """

    kind: Literal["note", "warning"]
    where: str
    what: str
    remedy: str = ""

    def __str__(self) -> str:
        return f"{self.where}: {self.what}" + (f"; {self.remedy}" if self.remedy else "")


def note(where: str, what: str, remedy: str = "") -> Finding:
    """A `Finding` of what levade chose."""
    return Finding("note", where, what, remedy)


def warning(where: str, what: str, remedy: str) -> Finding:
    """A `Finding` of what may spoil the motion."""
    return Finding("warning", where, what, remedy)


def some(names: Sequence[str], most: int = 4) -> str:
    """The names, or the first few and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def named(kind: str, names: Sequence[str]) -> str:
    """Where a finding is that several joints, links or bodies share, such as "joints a, b, c, d and 8 more"."""
    plural = kind if len(names) == 1 else {"body": "bodies", "foot": "feet"}.get(kind, f"{kind}s")
    return f"{plural} {some(names)}"


def counted(number: int, noun: str) -> str:
    """The number and the noun in its plural, such as "1 geom" and "2 geoms"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
