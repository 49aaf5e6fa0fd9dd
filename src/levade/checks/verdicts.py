"""Pass, fail or unknown."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Verdict:
    """One criterion.

    passed: None if it is not judged, and then reason says why. unknown: whether it would be judged if the robot's limit were
    known, and not just assumed. value, required: with their unit.
    """

    name: str
    passed: bool | None
    value: str
    required: str = ""
    reason: str = ""
    unknown: bool = False
