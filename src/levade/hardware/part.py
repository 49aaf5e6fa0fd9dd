"""Results of a pursuit: its parts, one for each search, and the outcome of all of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from levade.checks import Certificate
from levade.motions import Motion
from levade.tasks.plan import Plan

NEARLY = 0.05
"""How far the share of perturbed robots may be below the demanded one for a search around the motion in small steps."""

_MOST = 1000
"""Number of failed demands for a motion without a certificate: more than exist."""

Rank = tuple[bool, int, float, int, float]
"""The rank of a certificate, lower is better. An incomplete one comes last. In this order count the limits that fail, the share
of perturbed runs up to the demanded one, all demands that fail, and the share."""


def rank(certificate: Mapping[str, Any]) -> Rank:
    """Rank a certificate.

    Contact is computed in a few other ways, each of which is one run more. So a motion that fails in two of them, and succeeds
    on 84 % of perturbed robots, is nearer to passing than one that fails in one of them and succeeds on 43 %.

    Args:
        certificate: `levade.checks.Certificate.to_json`.

    Raises:
        LookupError: If something is missing. TypeError and ValueError mean that something is of another kind.
    """
    failed, demanded = certificate["failed"], certificate["demands"]["share"]
    beyond = sum(margin["passed"] is False for margin in certificate["margins"].values())
    share = float(certificate["perturbed"]["share"])
    enough = 0.0 if demanded is None else min(share, demanded)
    return bool(certificate["interrupted"]), beyond, -enough, len(failed), -share


@dataclass(frozen=True, eq=False)
class Part:
    """One search of a pursuit and its result.

    Attributes:
        name: Name of its directory.
        motion: The motion that it found.
        trials: Number of its roll-outs.
        seconds: Duration of the search and of the check [s].
        certificate: Certificate of the motion. None if the motion is not within the limits and other searches go on, or if the
            search ended early because others were better.
    """

    name: str
    motion: Motion
    trials: int
    seconds: float
    certificate: Certificate | None

    @property
    def met(self) -> bool:
        """Whether the nominal model reaches the goal within the limits."""
        return self.motion.met

    @property
    def rank(self) -> Rank:
        """The rank of its certificate, last of all without one."""
        found = self.certificate
        return (True, _MOST, 0.0, _MOST, 0.0) if found is None else rank(found.to_json())

    @property
    def share(self) -> float:
        """The share of the perturbed robots on which it succeeds; 0 without a certificate."""
        return 0.0 if self.certificate is None else self.certificate.perturbed.share

    @property
    def sure(self) -> bool:
        """Whether its certificate passes, and would also pass with other perturbed runs.

        It would if the lower end of the share's interval is high enough, or if every run succeeds.
        """
        found = self.certificate
        if found is None or not found.passed:
            return False
        share, runs = found.demands.share, found.perturbed
        return share is None or runs.low >= share or runs.successes == runs.runs

    @property
    def near(self) -> bool:
        """Whether it keeps every limit, and its share of perturbed runs is at most `NEARLY` below the demanded share.

        Such a motion may still fail because of how contact is computed. Motions close to it fail with other contact settings,
        or with none.
        """
        found = self.certificate
        if found is None or any(margin.passed is False for margin in found.margins.values()):
            return False
        return found.demands.share is None or found.perturbed.share >= found.demands.share - NEARLY


@dataclass(frozen=True, eq=False)
class Pursued:
    """The outcome of a pursuit.

    Attributes:
        plan: The plan of its searches.
        parts: The searches, in order.
        best: The part with the best certificate.
        directory: Directory that holds everything.
        seed: Seed of the pursuit.
        stopped: Why it ended early: "interrupted", "time" or "trials". "" if it did not.
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
        """The best certificate."""
        assert self.best.certificate is not None
        return self.best.certificate

    @property
    def passed(self) -> bool:
        """Whether the certificate passes."""
        return self.certificate.passed

    @property
    def trials(self) -> int:
        """The number of roll-outs of all searches."""
        return sum(part.trials for part in self.parts)
