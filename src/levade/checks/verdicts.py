"""Verdicts of a check: pass, fail or unknown."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Verdict:
    """Verdict on one demand.

    Attributes:
        name: Name of the demand.
        passed: Whether it is met; None if it is not judged.
        value: Measured value, with its unit.
        required: Demanded value, with its unit.
        reason: Why it is not judged.
        unknown: Whether it is not judged because the robot's limit is not known, or only assumed.
    """

    name: str
    passed: bool | None
    value: str
    required: str = ""
    reason: str = ""
    unknown: bool = False
