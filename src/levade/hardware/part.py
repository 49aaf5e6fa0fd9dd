"""What a pursuit makes: its parts, one for each search, and what all of them come to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from levade.checks import Certificate
from levade.hardware.plan import Plan
from levade.motions import Motion

_MOST = 1000
"""Demands that a motion without a certificate counts as failing: more than there are."""


@dataclass(frozen=True, eq=False)
class Part:
    """One search of a pursuit and what came of it.

    Attributes:
        name: Its directory.
        motion: What it found.
        trials: Roll-outs that it made.
        seconds: Duration of the search and of the check.
        certificate: Of its motion; None of one that is not within the limits, where other searches go on.
    """

    name: str
    motion: Motion
    trials: int
    seconds: float
    certificate: Certificate | None

    @property
    def met(self) -> bool:
        """Whether the model does what was searched for: the goal, within the limits."""
        return self.motion.met

    @property
    def rank(self) -> tuple[bool, int, float]:
        """Less is better: a whole certificate first, then what it fails, then the share of perturbed runs that fail."""
        certificate = self.certificate
        if certificate is None:
            return True, _MOST, 0.0
        return certificate.interrupted, len(certificate.failed), -certificate.perturbed.share

    @property
    def share(self) -> float:
        """Share of the perturbed robots on which it holds; 0 without a certificate."""
        return 0.0 if self.certificate is None else self.certificate.perturbed.share

    @property
    def sure(self) -> bool:
        """Whether its certificate passes, and would with other runs: by the lower end of the share's interval, or all do."""
        found = self.certificate
        if found is None or not found.passed:
            return False
        share, runs = found.demands.share, found.perturbed
        return share is None or runs.low >= share or runs.successes == runs.runs

    @property
    def near(self) -> bool:
        """Whether it is within every limit, and the share of perturbed runs is enough, or may yet be, by its interval.

        What may be in its way besides is how contact is computed: other motions near it fail with other numbers, or with none.
        """
        found = self.certificate
        if found is None or any(margin.passed is False for margin in found.margins.values()):
            return False
        return found.demands.share is None or found.perturbed.high >= found.demands.share


@dataclass(frozen=True, eq=False)
class Pursued:
    """What a pursuit came to.

    Attributes:
        plan: What was searched for.
        parts: The searches, in order.
        best: The part with the best certificate.
        directory: Where everything is.
        seed: Seed of the pursuit.
        stopped: Why it ended before its end: "interrupted", "time", or "" if it did not.
    """

    plan: Plan
    parts: tuple[Part, ...]
    best: Part
    directory: Path
    seed: int
    stopped: str

    @property
    def motion(self) -> Motion:
        """The motion with the best certificate."""
        return self.best.motion

    @property
    def certificate(self) -> Certificate:
        """Its certificate."""
        assert self.best.certificate is not None
        return self.best.certificate

    @property
    def passed(self) -> bool:
        """Whether the certificate passes."""
        return self.certificate.passed

    @property
    def trials(self) -> int:
        """Roll-outs of all searches."""
        return sum(part.trials for part in self.parts)
