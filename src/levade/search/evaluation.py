"""Questions and answers of a search: `Trials` go to an objective, an `Evaluation` comes back.

    trials = search.ask()                       # Trials: candidates, each on the nominal model or on perturbed ones
    evaluation = objective.evaluate(trials)     # Evaluation: one row per roll-out
    search.tell(evaluation)

Both are immutable; an evaluation's arrays are read-only. For a robust task, the evaluation of a generation also has `Samples`:
the results of its candidates on perturbed models.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
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
class Gains:
    """What determines the gains of a task's feedback.

    Attributes:
        along: Weights of the motion along which they are made, shape (d,).
        design: Number of their design in `levade.tasks.Regulation.designs`.
    """

    along: Array
    design: int = 0


@dataclass(frozen=True, eq=False)
class Trials:
    """The roll-outs that a search asks for.

    Attributes:
        weights: Policy weights of the candidates [rad], shape (k, d).
        hold_steps: Number of steps of the hold to simulate.
        seed: Seed of the search, which determines the perturbed models.
        draw: Which perturbed models to use: None for the nominal model alone, 0 for the models that stay the same, g for the
            models drawn for generation g.
        pairs: With a draw, the candidate and the model of each roll-out, both of shape (n,). Without a draw, each candidate
            is one roll-out.
        gains: With a draw, the gains of the task's feedback. None simulates without feedback.
        closing: Whether the search asks for this at its end. The answer is not recorded, since a resumed search goes on
            instead.
    """

    weights: Array
    hold_steps: int
    seed: int = 0
    draw: int | None = None
    pairs: tuple[Index, Index] | None = None
    gains: Gains | None = None
    closing: bool = False

    def __getitem__(self, rows: slice) -> Trials:
        """Return some of the roll-outs."""
        if self.pairs is None:
            return replace(self, weights=self.weights[rows])
        candidates, models = self.pairs
        used, again = np.unique(candidates[rows], return_inverse=True)
        return replace(self, weights=self.weights[used], pairs=(again.astype(np.intp), models[rows]))

    @property
    def n(self) -> int:
        """The number of roll-outs."""
        return len(self.weights) if self.pairs is None else len(self.pairs[0])

    @property
    def checksum(self) -> int:
        """The checksum that identifies what is asked for."""
        of = zlib.crc32(np.ascontiguousarray(self.weights).tobytes())
        for part in self.pairs or ():
            of = zlib.crc32(np.ascontiguousarray(part, dtype=np.int64).tobytes(), of)
        if self.gains is not None:
            of = zlib.crc32(np.ascontiguousarray(self.gains.along).tobytes(), of + self.gains.design)
        return zlib.crc32(repr((self.hold_steps, self.draw)).encode(), of)


@dataclass(frozen=True, eq=False)
class Samples:
    """The results of n candidates on m perturbed models. They mean nothing where ``known`` is false.

    Attributes:
        terms: Cost -> unweighted terms, shape (n, m).
        success: Which roll-outs succeeded, shape (n, m).
        diverged: Which simulations broke down, shape (n, m).
        known: Which pairs were simulated, shape (n, m).
    """

    terms: Mapping[str, Array]
    success: Mask
    diverged: Mask
    known: Mask

    @classmethod
    def none(cls, terms: Mapping[str, Any], candidates: int, models: int) -> Samples:
        """Make samples of which nothing is known yet.

        Args:
            terms: Names of the costs.
            candidates: Number of candidates.
            models: Number of perturbed models.
        """
        shape = (candidates, models)
        return cls({name: np.full(shape, np.nan) for name in terms}, *np.zeros((3, *shape), dtype=bool))

    def updated(self, pairs: tuple[Index, Index], evaluation: Evaluation) -> Samples:
        """Return the same samples with the roll-outs of some pairs filled in.

        Args:
            pairs: The candidate and the model of each roll-out, both of shape (k,).
            evaluation: Their results, k rows.
        """

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
        """The successes as a share of all m models, shape (n,); pairs that were not simulated count as failures."""
        return (self.success & self.known).mean(axis=1)

    @property
    def attainable(self) -> Array:
        """The share if every pair that was not simulated succeeds, shape (n,)."""
        return (self.success | ~self.known).mean(axis=1)


@dataclass(frozen=True, eq=False)
class Evaluation:
    """The results of n trials. Values that depend on a hold are NaN where that was not simulated.

    Attributes:
        terms: Cost -> unweighted terms, shape (n,).
        errors: Criterion -> errors [SI], shape (n,).
        success: Which trials meet every criterion, shape (n,). With samples, also on enough of the perturbed models.
        diverged: Which simulations broke down, shape (n,).
        slack: Criterion with bounds -> slack to the nearer bound [SI], negative beyond it, shape (n,).
        samples: Results of the trials on perturbed models, if they were tried on any.
        verified: With samples, the number of further roll-outs that it took to find out which trials succeed.
        met: With samples, which trials meet every criterion of the nominal model, shape (n,). None if the criteria of
            perturbed models are the same.
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
        """The number of roll-outs made."""
        return len(self.success) + (0 if self.samples is None else int(self.samples.known.sum()) + self.verified)

    def with_success(self, success: Mask) -> Evaluation:
        """Return the same evaluation with other successes.

        Args:
            success: Which trials succeed, shape (n,).
        """
        return replace(self, success=success.copy())

    def cost(self, weights: Mapping[str, float], robust: Robust | None = None) -> Array:
        """Return the cost of each trial, shape (n,): the weighted sum of its terms (eq. 5).

        Terms that depend on the hold are left out if it was not simulated.

        Args:
            weights: Cost -> weight.
            robust: Names the measure that combines all roll-outs of a trial that was tried on perturbed models. None ignores
                these roll-outs.
        """
        terms = {name: values for name, values in self.terms.items() if not np.isnan(values).any()}
        cost = total(terms, {name: weights[name] for name in terms})
        cost = np.where(self.diverged, DIVERGED, cost)
        samples = self.samples
        if samples is None or robust is None:
            return cost
        there = [name for name in terms if name not in robust.free]
        on_models = total({name: samples.terms[name] for name in there}, {name: weights[name] for name in there})
        costs = np.column_stack([cost, np.where(samples.diverged, DIVERGED, on_models)])
        known = np.column_stack([np.ones(len(cost), dtype=bool), samples.known])
        measured = risk(costs, known, measure=robust.measure, tail=robust.tail)
        return ranked_behind(measured, samples.complete)


def joined(parts: Sequence[Evaluation], order: Index | None = None) -> Evaluation:
    """Join evaluations without samples.

    Args:
        parts: Evaluations by the same costs and criteria.
        order: Which of all rows, one part after another, each row of the result is. None keeps their order.

    Returns:
        The evaluation of all trials.
    """
    if len(parts) == 1 and order is None:
        return parts[0]

    def whole(values: list[NDArray[Any]]) -> NDArray[Any]:
        rows = np.concatenate(values)
        return rows if order is None else rows[order]

    def tables(name: str) -> Mapping[str, Array]:
        return {key: whole([getattr(part, name)[key] for part in parts]) for key in getattr(parts[0], name)}

    success, diverged = (whole([getattr(part, name) for part in parts]) for name in ("success", "diverged"))
    return Evaluation(tables("terms"), tables("errors"), success, diverged, tables("slack"))


@dataclass(frozen=True, eq=False)
class Record:
    """An evaluation with the checksum of the trials that it answers: a line of a checkpoint.

    Attributes:
        checksum: `Trials.checksum` of the trials.
        evaluation: Their results, without samples.
    """

    checksum: int
    evaluation: Evaluation

    def to_json(self) -> dict[str, Any]:
        """Return plain lists; floats survive JSON to the bit."""
        of = self.evaluation
        tables = {
            key: {name: [None if np.isnan(v) else v for v in values.tolist()] for name, values in table.items()}
            for key, table in (("terms", of.terms), ("errors", of.errors), ("slack", of.slack))
        }
        flags = {"success": of.success.tolist(), "diverged": of.diverged.tolist()}
        return {"checksum": self.checksum, **tables, **flags}

    @classmethod
    def from_json(cls, content: Mapping[str, Any]) -> Record:
        """Read the record that `to_json` wrote.

        Args:
            content: What a line of a checkpoint holds.

        Raises:
            ValueError: If something is missing, of another kind, or of another number of trials than the rest. LookupError,
                TypeError, AttributeError and OverflowError mean the same.
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
    """Make an array of a list. Raises ValueError if it holds anything except true and false."""
    if not isinstance(values, list) or not all(isinstance(value, bool) for value in values):
        raise ValueError
    return np.array(values, dtype=bool)


def _numbers(values: list[float | None], n: int) -> Array:
    """Make an array of a list, NaN for None. Raises ValueError if it does not hold n numbers."""
    if not isinstance(values, list) or any(type(value) not in (float, int, type(None)) for value in values):
        raise ValueError
    array = np.array(values, dtype=float)
    if array.shape != (n,):
        raise ValueError
    return array
