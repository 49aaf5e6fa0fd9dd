"""What a search asks for, and what came of it: `Trials` go to an objective, an `Evaluation` comes back.

    trials = search.ask()                       # Trials: candidates, each on the nominal model or on perturbed ones
    evaluation = objective.evaluate(trials)     # Evaluation: one row a roll-out
    search.tell(evaluation)

Both are immutable; an evaluation's arrays are read-only. An evaluation of a whole generation also has `Samples`: what its
candidates did on perturbed models.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs import DIVERGED, total
from levade.costs.risk import ranked_behind, risk
from levade.tasks import Robust

Index = NDArray[np.intp]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Trials:
    """Roll-outs that a search asks for.

    Attributes:
        weights: Candidates: policy weights [rad], shape (k, d).
        hold_steps: How many steps of the hold to simulate.
        seed: Seed of the search, from which perturbed models follow.
        draw: Which perturbed models: None for the nominal model alone, 0 for the models that stay the same, g for those
            drawn for generation g.
        pairs: With a draw, the candidate and the model of each roll-out, both of shape (n,). Without, each candidate is
            one roll-out.
        along: With a draw, the weights of the motion along which the gains of the task's feedback are made, shape (d,). None
            is without feedback.
        closing: Whether this is asked for at the end of the search. What comes of it is not recorded, since a resumed
            search goes on instead.
    """

    weights: Array
    hold_steps: int
    seed: int = 0
    draw: int | None = None
    pairs: tuple[Index, Index] | None = None
    along: Array | None = None
    closing: bool = False

    def __getitem__(self, rows: slice) -> Trials:
        """Some of the roll-outs."""
        if self.pairs is None:
            return replace(self, weights=self.weights[rows])
        candidates, models = self.pairs
        used, again = np.unique(candidates[rows], return_inverse=True)
        return replace(self, weights=self.weights[used], pairs=(again.astype(np.intp), models[rows]))

    @property
    def n(self) -> int:
        """Number of roll-outs."""
        return len(self.weights) if self.pairs is None else len(self.pairs[0])

    @property
    def checksum(self) -> int:
        """Identifies what is asked for."""
        of = zlib.crc32(np.ascontiguousarray(self.weights).tobytes())
        for part in self.pairs or ():
            of = zlib.crc32(np.ascontiguousarray(part, dtype=np.int64).tobytes(), of)
        if self.along is not None:
            of = zlib.crc32(np.ascontiguousarray(self.along).tobytes(), of)
        return zlib.crc32(repr((self.hold_steps, self.draw)).encode(), of)


@dataclass(frozen=True, eq=False)
class Samples:
    """What n candidates did on m perturbed models; meaningless where ``known`` is false.

    Attributes:
        terms: Cost -> unweighted terms, shape (n, m).
        success: Shape (n, m).
        diverged: Shape (n, m).
        known: Which pairs were simulated, shape (n, m).
    """

    terms: Mapping[str, Array]
    success: Mask
    diverged: Mask
    known: Mask

    @classmethod
    def none(cls, terms: Mapping[str, Any], candidates: int, models: int) -> Samples:
        """Samples of which nothing is known yet."""
        shape = (candidates, models)
        return cls({name: np.full(shape, np.nan) for name in terms}, *np.zeros((3, *shape), dtype=bool))

    def updated(self, pairs: tuple[Index, Index], evaluation: Evaluation) -> Samples:
        """The same samples with the roll-outs of some pairs filled in."""

        def filled(whole: NDArray[Any], part: NDArray[Any] | bool) -> NDArray[Any]:
            whole = whole.copy()
            whole[pairs] = part
            return whole

        terms = {name: filled(values, evaluation.terms[name]) for name, values in self.terms.items()}
        success, diverged = filled(self.success, evaluation.success), filled(self.diverged, evaluation.diverged)
        return Samples(terms, success, diverged, filled(self.known, True))

    @property
    def complete(self) -> Mask:
        """Whether each candidate was tried on all models, shape (n,)."""
        return np.asarray(self.known.all(axis=1))

    @property
    def share(self) -> Array:
        """Successes as a share of all m models, shape (n,); what was not simulated counts as a failure."""
        return (self.success & self.known).mean(axis=1)

    @property
    def attainable(self) -> Array:
        """The share if everything that was not simulated succeeds, shape (n,)."""
        return (self.success | ~self.known).mean(axis=1)


@dataclass(frozen=True, eq=False)
class Evaluation:
    """What n trials achieved. Values are NaN where they look at a hold that was not simulated.

    Attributes:
        terms: Cost -> unweighted terms, shape (n,).
        errors: Criterion -> errors [SI], shape (n,).
        success: Which trials meet every criterion, shape (n,). With samples, also on enough of the perturbed models.
        diverged: Which simulations broke down, shape (n,).
        slack: Criterion with bounds -> what is left to the nearer one [SI], negative beyond it, shape (n,).
        samples: What the trials did on perturbed models, if they were tried on any.
        verified: With samples, roll-outs beyond these that it took to tell which trials succeed.
        met: With samples, where less is asked of perturbed models: which trials do on the nominal one all that is asked there.
    """

    terms: Mapping[str, Array]
    errors: Mapping[str, Array]
    success: Mask
    diverged: Mask
    slack: Mapping[str, Array] = field(default_factory=dict)
    samples: Samples | None = None
    verified: int = 0
    met: Mask | None = None

    def __post_init__(self) -> None:
        for table in (self.terms, self.errors, self.slack):
            for values in table.values():
                values.flags.writeable = False
        self.success.flags.writeable = self.diverged.flags.writeable = False

    @property
    def trials(self) -> int:
        """Number of roll-outs that were made."""
        return len(self.success) + (0 if self.samples is None else int(self.samples.known.sum()) + self.verified)

    def with_success(self, success: Mask) -> Evaluation:
        """The same evaluation with other successes, shape (n,)."""
        return replace(self, success=success.copy())

    def cost(self, weights: Mapping[str, float], robust: Robust | None = None) -> Array:
        """The cost of each trial, shape (n,): the weighted sum of its terms (eq. 5).

        Terms that look at the hold are left out if it was not simulated. For trials that were tried on perturbed models,
        the cost is the measure that ``robust`` names of all their roll-outs.
        """
        terms = {name: values for name, values in self.terms.items() if not np.isnan(values).any()}
        cost = total(terms, {name: weights[name] for name in terms})
        cost = np.where(self.diverged, DIVERGED, cost)
        samples = self.samples
        if samples is None or robust is None:
            return cost
        on_models = total({name: samples.terms[name] for name in terms}, {name: weights[name] for name in terms})
        costs = np.column_stack([cost, np.where(samples.diverged, DIVERGED, on_models)])
        known = np.column_stack([np.ones(len(cost), dtype=bool), samples.known])
        measured = risk(costs, known, measure=robust.measure, tail=robust.tail)
        return ranked_behind(measured, samples.complete)


@dataclass(frozen=True, eq=False)
class Record:
    """An evaluation with the checksum of the trials that it answers: a line of a checkpoint."""

    checksum: int
    evaluation: Evaluation

    def to_json(self) -> dict[str, Any]:
        """Plain lists; floats survive JSON to the bit."""
        of = self.evaluation
        tables = {
            key: {name: [None if np.isnan(v) else v for v in values.tolist()] for name, values in table.items()}
            for key, table in (("terms", of.terms), ("errors", of.errors), ("slack", of.slack))
        }
        flags = {"success": of.success.tolist(), "diverged": of.diverged.tolist()}
        return {"checksum": self.checksum, **tables, **flags}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> Record:
        """The record that `to_json` wrote.

        Raises:
            ValueError: If something is missing, of another kind, or of another number of trials than the rest. LookupError,
                TypeError, AttributeError and OverflowError, too.
        """
        success, diverged = (_flags(content[key]) for key in ("success", "diverged"))
        n = len(success)
        terms, errors, slack = (
            {str(name): _numbers(values, n) for name, values in content[key].items()}
            for key in ("terms", "errors", "slack")
        )
        if not n or len(diverged) != n or type(content["checksum"]) is not int:
            raise ValueError
        return cls(content["checksum"], Evaluation(terms, errors, success, diverged, slack))


def _flags(values: list[bool]) -> Mask:
    """An array of a list. Raises ValueError if it holds anything but true and false."""
    if not isinstance(values, list) or not all(isinstance(value, bool) for value in values):
        raise ValueError
    return np.array(values, dtype=bool)


def _numbers(values: list[float | None], n: int) -> Array:
    """An array of a list, NaN for None. Raises ValueError if it is not of n numbers."""
    if not isinstance(values, list) or any(type(value) not in (float, int, type(None)) for value in values):
        raise ValueError
    array = np.array(values, dtype=float)
    if array.shape != (n,):
        raise ValueError
    return array
