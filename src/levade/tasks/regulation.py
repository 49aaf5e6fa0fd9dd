"""Feedback in the search: what a task may ask for so that the closed loop is optimised, not the motion alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

from levade.errors import LevadeError


@dataclass(frozen=True)
class Regulation:
    """A regulator that is on while candidates run on perturbed models: in the search as in the check.

    It senses attitude, angular velocity and joints, with errors, and corrects the joint references one period later; see
    docs/feedback.md. On the nominal model it does nothing: each candidate is held to what it does there.

    rate: measurements a second [Hz]; the nearest that steps allow.
    motion, hold: correction that costs 1 up to the horizon, and after it [rad]: more lets it do more. A hold of None is without
        feedback: its last corrections fade. That is for postures that stand by themselves, on several contacts.
    bound: bound on each correction [rad].
    every: generations after which the gains are made again, along the best motion. Gains stay only if that motion holds no less
        with them than before; the first ones, than without.
    runs: perturbed runs from which is learned what is to be expected of what is not sensed.
    """

    rate: float = 250.0
    motion: float = 0.6
    hold: float | None = 0.1
    bound: float = 0.3
    every: int = 10
    runs: int = 32

    def __post_init__(self) -> None:
        for name, least, most, unit in (
            ("rate", 1.0, 10_000.0, "Hz; 250 is usual"),
            ("motion", 0.001, 100.0, "rad; 0.1 to 1 is usual"),
            ("hold", 0.001, 100.0, "rad; 0.03 to 0.3 is usual"),
            ("bound", 0.001, 2.0, "rad; 0.3 is usual"),
        ):
            value: float | None = getattr(self, name)
            if value is None:  # a hold without feedback
                continue
            if not (math.isfinite(value) and least <= value <= most):
                raise LevadeError(f"feedback.{name}: {value} should be {least:g} to {most:g} {unit}")
        if self.every < 1:
            raise LevadeError(f"feedback.every: {self.every} should be 1 or more generations; 10 is usual")
        if not 8 <= self.runs <= 1000:
            raise LevadeError(f"feedback.runs: {self.runs} should be 8 to 1000; 32 is usual")
