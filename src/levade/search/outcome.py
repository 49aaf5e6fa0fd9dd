"""What a search has found: trials, the state after each generation, and the solution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from levade.arrays import Array
from levade.search.evaluation import Evaluation
from levade.tasks import Change


class Stopped(StrEnum):
    """Why a search ended."""

    SUCCESS = "success"
    """A motion succeeded and was polished for as long as the task says."""
    BUDGET = "budget"
    """The task's trials were spent."""
    INTERRUPTED = "interrupted"
    """An observer, Ctrl-C or an error ended it."""
    RUNNING = "running"
    """It has not ended: an interim solution."""


@dataclass(frozen=True, eq=False)
class Trial:
    """One trial and what it achieved.

    Attributes:
        weights: The policy's weights [rad], shape (d,).
        cost: By the task's own cost weights, as changed so far.
        terms: Cost -> unweighted term.
        errors: Criterion -> error [SI].
        success: Whether it meets every criterion, for a robust task also on enough of the perturbed models.
        share: Share of the perturbed models that it succeeds on. None if it was not tried on any.
        along: Weights of the motion along which the gains were made of the feedback that it had there, shape (d,). None if it
            had none.
        met: Whether it does on the nominal model all that is asked there, where less is asked of perturbed ones.
    """

    weights: Array
    cost: float
    terms: Mapping[str, float]
    errors: Mapping[str, float]
    success: bool
    share: float | None = None
    along: Array | None = None
    met: bool = True

    @classmethod
    def of(cls, weights: Array, cost: float, evaluation: Evaluation, i: int, along: Array | None = None) -> Trial:
        """Row ``i`` of an evaluation. weights, along: shape (d,)."""
        return cls(
            weights=weights.copy(),
            cost=cost,
            terms={name: float(values[i]) for name, values in evaluation.terms.items()},
            errors={name: float(values[i]) for name, values in evaluation.errors.items()},
            success=bool(evaluation.success[i]),
            share=None if evaluation.samples is None else float(evaluation.samples.share[i]),
            along=None if evaluation.samples is None else along,
            met=evaluation.met is None or bool(evaluation.met[i]),
        )

    @property
    def rank(self) -> tuple[bool, bool, float, float]:
        """Less is better: success first, then what the model does, then the share of perturbed models, then cost."""
        return not self.success, not self.met, -(self.share or 0.0), self.cost


def better(one: Trial | None, other: Trial) -> Trial:
    """The better of two trials; the other one if they rank the same."""
    return other if one is None or other.rank <= one.rank else one


@dataclass(frozen=True, eq=False)
class Generation:
    """The state of a search after a generation.

    Attributes:
        generation: Its number, from 1.
        stage: Number of its stage, from 0.
        stage_name: The stage's name.
        trials: Trials spent so far.
        cost: Costs of its candidates by the stage's cost weights, shape (candidates,).
        step: The optimizer's step size after it.
        diverged: How many of its candidates broke down.
        best: Best trial of all generations and stages.
        trials_to_success: Trials spent when one first met every criterion. None while there is none.
        cost_weights: Cost -> weight in ``best.cost``.
        changes: Changes of the cost weights that hold or are still to come.
        starts: Shares of the models that stay the same on which the motions to start from succeed, of those that were
            found and not yet started from in vain.
        evaluation: What its candidates achieved.
        validated: What its contender achieved on the models that stay the same: the candidate, or the mean, that may become
            the best of a robust search, or a motion to start one from. None where there is none.
        total_diverged: How many trials of the whole search broke down so far.
        initial: How many motions or weights the search began around.
        replayed: Whether all of it came from records, nothing from simulation.
    """

    generation: int
    stage: int
    stage_name: str
    trials: int
    cost: Array
    step: float
    diverged: int
    best: Trial
    trials_to_success: int | None
    cost_weights: Mapping[str, float]
    changes: tuple[Change, ...]
    starts: tuple[float, ...] = ()
    evaluation: Evaluation | None = None
    validated: Evaluation | None = None
    total_diverged: int = 0
    initial: int = 0
    replayed: bool = False

    def solution(self) -> Solution:
        """The solution so far."""
        return Solution(
            best=self.best,
            trials=self.trials,
            generations=self.generation,
            trials_to_success=self.trials_to_success,
            diverged=self.total_diverged,
            stopped=Stopped.RUNNING,
            cost_weights=self.cost_weights,
            changes=self.changes,
            initial=self.initial,
        )


@dataclass(frozen=True, eq=False)
class Solution:
    """The outcome of a search: the best trial, and what it took.

    Attributes:
        best: The best trial.
        trials: Trials spent.
        generations: Generations told.
        trials_to_success: Trials spent when one first met every criterion. None if none did.
        diverged: How many trials broke down.
        stopped: Why the search ended.
        cost_weights: Cost -> weight in ``best.cost``.
        changes: Changes of the cost weights on the way; a task with these gives the same solution again.
        initial: How many motions or weights the search began around; 0 if it began from nothing.
    """

    best: Trial
    trials: int
    generations: int
    trials_to_success: int | None
    diverged: int
    stopped: Stopped
    cost_weights: Mapping[str, float]
    changes: tuple[Change, ...]
    initial: int = 0

    @property
    def success(self) -> bool:
        """Whether the best trial succeeds."""
        return self.best.success
