"""Robust optimisation: what a task may ask for so that its motion holds on robots that differ from the model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import Criterion
from levade.costs.risk import Measure
from levade.engines import Perturbation
from levade.errors import LevadeError


@dataclass(frozen=True)
class Racing:
    """All candidates run the nominal model and ``first`` samples; only the best share ``keep`` of them the rest."""

    first: int = 2
    keep: float = 0.5

    def __post_init__(self) -> None:
        if self.first < 0:
            raise LevadeError(f"robust.racing.first: {self.first} should be 0 or more samples")
        if not (math.isfinite(self.keep) and 0 < self.keep <= 1):
            raise LevadeError(f"robust.racing.keep: {self.keep} should be a share above 0 and up to 1; 0.5 is usual")


@dataclass(frozen=True)
class Robust:
    """How candidates are tried on perturbed models.

    samples: perturbed models for each candidate, beside the nominal one. Every roll-out counts as a trial.
    measure, tail: of the costs of a candidate's whole roll-outs, the nominal one among them: see `levade.costs.risk`.
    redraw: "never" tries all candidates on the same models; "generation" draws new ones for each generation (the candidates of
        one share them), and compares the best of each with the best so far on one sample that stays the same.
    validation: models of that sample; as many as ``samples`` if None.
    contender: who of a generation is compared on it: its "best", by the models of the generation, or the "mean" of the
        distribution that its candidates are drawn from: near the end, luck on a few models is most of what sets the best apart.
    required: share of the samples (of that which stays the same, if others are drawn for each generation) that a candidate has
        to succeed on, beside the nominal model, to count as a success.
    starts: motions of the nominal model, each from a search of its own, of which that one goes on to the robust stages which
        succeeds on most of the models that stay the same. Motions that look alike on one model differ widely on others.
    success: what is good enough on a perturbed model: criteria of the task's, by their names, with tolerances or bounds of
        their own; what it does not name is asked of the nominal model alone. None asks for the task's criteria.
    racing: None runs every candidate on every sample. perturb: ranges.

    The samples of one generation cover every range evenly (`levade.engines.Perturbation.spread`); they follow from the seed of
    the solve and the number of the generation.
    """

    samples: int = 8
    measure: Measure = "cvar"
    tail: float = 0.5
    redraw: Literal["never", "generation"] = "never"
    validation: int | None = None
    contender: Literal["best", "mean"] = "best"
    required: float = 1.0
    starts: int = 1
    success: Mapping[str, Criterion] | None = None
    racing: Racing | None = None
    perturb: Perturbation = Perturbation()

    def __post_init__(self) -> None:
        if not 1 <= self.samples <= 1000:
            raise LevadeError(f"robust.samples: {self.samples} should be 1 to 1000; 8 is usual")
        if self.measure not in ("mean", "cvar", "worst"):
            raise LevadeError(f"robust.measure: {self.measure!r} is unknown; mean, cvar or worst")
        if self.redraw not in ("never", "generation"):
            raise LevadeError(f"robust.redraw: {self.redraw!r} is unknown; never or generation")
        if self.contender not in ("best", "mean"):
            raise LevadeError(f"robust.contender: {self.contender!r} is unknown; best or mean")
        if self.contender == "mean" and self.redraw == "never":
            raise LevadeError("robust.contender: with redraw: never every candidate is compared; leave it out")
        if self.validation is not None and self.redraw == "never":
            raise LevadeError("robust.validation: with redraw: never all candidates run the same models; leave it out")
        if self.validation is not None and not 1 <= self.validation <= 1000:
            raise LevadeError(f"robust.validation: {self.validation} should be 1 to 1000; 20 is usual")
        for name in ("tail", "required"):
            value = getattr(self, name)
            if not (math.isfinite(value) and 0 <= value <= 1) or (name == "tail" and value == 0):
                least = "more than 0" if name == "tail" else "0"
                raise LevadeError(f"robust.{name}: {value} should be a share, {least} to 1")
        if not 1 <= self.starts <= 1000:
            raise LevadeError(f"robust.starts: {self.starts} should be 1 to 1000; 8 is usual")
        if self.racing is not None and self.racing.first >= self.samples:
            raise LevadeError(
                f"robust.racing.first: {self.racing.first} of {self.samples} samples leaves nothing to race for; fewer"
            )

    @property
    def fixed(self) -> int:
        """Models of the sample that stays the same."""
        return self.samples if self.validation is None else self.validation

    def rollouts(self, candidates: int) -> int:
        """Of so many candidates, the nominal ones among them."""
        if self.racing is None:
            return candidates * (1 + self.samples)
        return candidates * (1 + self.racing.first) + self.kept(candidates) * (self.samples - self.racing.first)

    def kept(self, candidates: int) -> int:
        """How many of them run all samples."""
        return candidates if self.racing is None else max(1, math.ceil(self.racing.keep * candidates - 1e-9))

    def enough(self, share: Array) -> NDArray[np.bool_]:
        """Whether shares (n,) of the samples are what is required."""
        return share >= self.required - 1e-9
