"""Feedback in the search: with it, a task optimises the closed loop instead of the motion alone."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from levade.errors import LevadeError
from levade.feedback import SensorErrors

_LEAST, _MOST = 0.001, 100.0
"""Range of corrections that cost 1 [rad]."""

_OTHERS = (0.25, 2.0)
"""Factors on the correction that costs 1 up to the horizon, for the other designs."""


@dataclass(frozen=True)
class Regulation:
    """A regulator that is on while candidates run on perturbed models, in the search and in the check.

    It measures attitude, angular velocity and joints, with errors, and corrects the joint references one period later: see
    docs/feedback.md. It keeps each candidate to its motion on the nominal model, so there it does nothing.

    Attributes:
        rate: Measurements per second [Hz]; the nearest rate that whole time steps allow.
        motion: Correction that costs 1 up to the horizon [rad]: the larger, the more the regulator corrects.
        hold: Correction that costs 1 in the hold [rad]. None switches feedback off in the hold, where the last corrections
            fade; that suits postures that stand by themselves, on several contacts.
        bound: Bound on each correction [rad].
        every: Generations after which the gains are computed again, along the best motion. New gains are kept only if that
            motion ranks no worse with them than with the earlier ones. The first gains are the best of all `designs`, if it
            ranks no worse with them than without feedback.
        runs: Perturbed runs from which the regulator learns to predict what it cannot measure.
        sensors: Errors of the sensors, in the search and in the check.

    Raises:
        LevadeError: If a value is out of range.
    """

    rate: float = 250.0
    motion: float = 0.6
    hold: float | None = 0.1
    bound: float = 0.3
    every: int = 10
    runs: int = 32
    sensors: SensorErrors = SensorErrors()

    @property
    def designs(self) -> tuple[Regulation, ...]:
        """These settings, and others to try before the first gains: larger and smaller corrections, and none in the hold."""
        others = [replace(self, motion=min(max(factor * self.motion, _LEAST), _MOST)) for factor in _OTHERS]
        return tuple(dict.fromkeys((self, *others, replace(self, hold=None))))

    def __post_init__(self) -> None:
        for name, least, most, unit in (
            ("rate", 1.0, 10_000.0, "Hz; 250 is usual"),
            ("motion", _LEAST, _MOST, "rad; 0.1 to 1 is usual"),
            ("hold", _LEAST, _MOST, "rad; 0.03 to 0.3 is usual"),
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
