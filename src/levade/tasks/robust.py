"""Robust optimisation: with it, a task searches for a motion that succeeds on robots that differ from the model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import Criterion
from levade.costs.risk import MEASURES, Measure
from levade.engines import Perturbation
from levade.errors import LevadeError


@dataclass(frozen=True)
class Racing:
    """A race: all candidates run the nominal model and a few samples, and only the best of them run the rest.

    Attributes:
        first: Samples that all candidates run.
        keep: Share of the candidates that run the other samples.

    Raises:
        LevadeError: If a value is out of range.
    """

    first: int = 2
    keep: float = 0.5

    def __post_init__(self) -> None:
        if self.first < 0:
            raise LevadeError(f"robust.racing.first: {self.first} should be 0 or more samples")
        if not (math.isfinite(self.keep) and 0 < self.keep <= 1):
            raise LevadeError(f"robust.racing.keep: {self.keep} should be a share above 0 and up to 1; 0.5 is usual")


@dataclass(frozen=True)
class Robust:
    """How candidates run on perturbed models.

    The samples of one generation cover every range evenly (`levade.engines.Perturbation.spread`). They follow from the seed of
    the search and the number of the generation.

    Attributes:
        samples: Perturbed models for each candidate, in addition to the nominal one. Every roll-out counts as a trial.
        measure: Risk measure over the costs of a candidate's complete roll-outs, including the nominal one: see
            `levade.costs.risk`.
        tail: Share of the most expensive roll-outs that "cvar" averages over.
        redraw: "never" runs all candidates on the same models. "generation" draws new models for each generation, shared by
            its candidates, and compares the best of each generation with the best so far on a fixed validation sample.
        validation: Models of the validation sample. Defaults to ``samples``.
        contender: Which candidate of each generation runs on the validation sample: its "best", or the "mean" of the search
            distribution. Near convergence the best candidate mostly owes its rank to chance.
        required: Share of the samples that a candidate has to succeed on, in addition to the nominal model, to count as a
            success. With new models in each generation, the validation sample counts.
        starts: Motions of the nominal model, each from a search of its own. The one that succeeds on most models of the
            fixed sample goes on to the robust stages. Motions that look alike on one model differ widely on others.
        success: Criteria for a perturbed model: some of the task's, by name, with their own tolerances or bounds. The
            others apply to the nominal model alone. Defaults to the task's criteria.
        free: Costs of the nominal model alone, from which perturbed models are free.
        racing: Race that spares poor candidates most samples. None runs every candidate on every sample.
        perturb: Ranges of the perturbed parameters.

    Raises:
        LevadeError: If a value is out of range, or two do not go together.
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
    free: tuple[str, ...] = ()
    racing: Racing | None = None
    perturb: Perturbation = Perturbation()

    def __post_init__(self) -> None:
        if not 1 <= self.samples <= 1000:
            raise LevadeError(f"robust.samples: {self.samples} should be 1 to 1000; 8 is usual")
        if self.measure not in MEASURES:
            raise LevadeError(
                f"robust.measure: {self.measure!r} is unknown; give {', '.join(MEASURES[:-1])} or {MEASURES[-1]}"
            )
        if self.redraw not in ("never", "generation"):
            raise LevadeError(f"robust.redraw: {self.redraw!r} is unknown; give never or generation")
        if self.contender not in ("best", "mean"):
            raise LevadeError(f"robust.contender: {self.contender!r} is unknown; give best or mean")
        if self.contender == "mean" and self.redraw == "never":
            raise LevadeError("robust.contender: only works with redraw: generation; leave it out")
        if self.validation is not None and self.redraw == "never":
            raise LevadeError("robust.validation: only works with redraw: generation; leave it out")
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
                f"robust.racing.first: {self.racing.first} should be less than samples, {self.samples}, which all would run"
            )

    @property
    def fixed(self) -> int:
        """Number of models of the fixed sample."""
        return self.samples if self.validation is None else self.validation

    def rollouts(self, candidates: int) -> int:
        """Count the roll-outs of a generation, including those of the nominal model.

        Args:
            candidates: Number of candidates.

        Returns:
            Number of roll-outs.
        """
        if self.racing is None:
            return candidates * (1 + self.samples)
        return candidates * (1 + self.racing.first) + self.kept(candidates) * (self.samples - self.racing.first)

    def kept(self, candidates: int) -> int:
        """Count the candidates that run all samples.

        Args:
            candidates: Number of candidates.

        Returns:
            Number of candidates that are kept.
        """
        return candidates if self.racing is None else max(1, math.ceil(self.racing.keep * candidates - 1e-9))

    def enough(self, share: Array) -> NDArray[np.bool_]:
        """Decide whether shares of successful samples are enough.

        Args:
            share: Share of the samples that each candidate succeeds on, shape (n,).

        Returns:
            Whether each reaches ``required``, shape (n,).
        """
        return share >= self.required - 1e-9
