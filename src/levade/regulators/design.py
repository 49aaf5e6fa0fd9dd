"""The choices of a regulator."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Design:
    """What distinguishes one regulator of a motion from another.

    Attributes:
        motion: Correction that costs 1 up to the horizon [rad].
        hold: Correction that costs 1 after it [rad]. None for a hold without feedback, in which the last corrections fade.
        bound: Bound on each correction [rad].
    """

    motion: float = 0.3
    hold: float | None = 0.1
    bound: float = 0.3
