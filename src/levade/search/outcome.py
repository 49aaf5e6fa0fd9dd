"""Results of a search: trials, the state after each generation, and the solution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from levade.arrays import Array
from levade.search.evaluation import Evaluation, Gains
from levade.tasks import Change


class Stopped(StrEnum):
    """The reason why a search ended."""

    SUCCESS = "success"
    """A motion succeeded and was polished for as long as the task says."""
    BUDGET = "budget"
    """The search used up the task's trials."""
    INTERRUPTED = "interrupted"
    """An observer, Ctrl-C or an error ended it."""
    RUNNING = "running"
    """It has not ended: the solution is an interim one."""


@dataclass(frozen=True, eq=False)
class Trial:
    """One trial and its results.

    Attributes:
        weights: Policy weights [rad], shape (d,).
        cost: Cost by the task's own cost weights, with the changes so far.
        terms: Cost -> unweighted term.
        errors: Criterion -> error [SI].
        success: Whether it meets every criterion. For a robust task also on enough of the perturbed models.
        share: Share of the perturbed models on which it succeeds. None if it was not tried on any.
        gains: Gains of its feedback. None if it had no feedback.
        met: Whether it meets every criterion of the nominal model. This matters where the criteria of perturbed models ask
            for less.
    """

    weights: Array
    cost: float
    terms: Mapping[str, float]
    errors: Mapping[str, float]
    success: bool
    share: float | None = None
    gains: Gains | None = None
    met: bool = True

    @classmethod
    def of(cls, weights: Array, cost: float, evaluation: Evaluation, i: int, gains: Gains | None = None) -> Trial:
        """Make a trial of one row of an evaluation.

        Args:
            weights: Policy weights [rad], shape (d,).
            cost: Its cost.
            evaluation: The evaluation.
            i: Row of the evaluation.
            gains: Gains of its feedback.
        """
        return cls(
            weights=weights.copy(),
            cost=cost,
            terms={name: float(values[i]) for name, values in evaluation.terms.items()},
            errors={name: float(values[i]) for name, values in evaluation.errors.items()},
            success=bool(evaluation.success[i]),
            share=None if evaluation.samples is None else float(evaluation.samples.share[i]),
            gains=None if evaluation.samples is None else gains,
            met=evaluation.met is None or bool(evaluation.met[i]),
        )

    @property
    def rank(self) -> tuple[bool, bool, float, float]:
        """The rank, lower is better: success, then success on the nominal model, share of perturbed models, and cost."""
        return not self.success, not self.met, -(self.share or 0.0), self.cost


def better(one: Trial | None, other: Trial) -> Trial:
    """Return the better of two trials; the other one if they rank the same.

    Args:
        one: A trial, or None.
        other: Another trial.
    """
    return other if one is None or other.rank <= one.rank else one


@dataclass(frozen=True, eq=False)
class Generation:
    """The state of a search after a generation.

    Attributes:
        generation: Number of the generation, from 1.
        stage: Number of its stage, from 0.
        stage_name: Name of its stage.
        trials: Trials spent so far.
        cost: Costs of its candidates by the stage's cost weights, shape (candidates,).
        step: Step size of the optimizer after the generation.
        diverged: Number of its candidates whose simulation broke down.
        best: Best trial of all generations and stages.
        trials_to_success: Trials spent when one first met every criterion. None while there is none.
        cost_weights: Cost -> weight in ``best.cost``.
        changes: Changes of the cost weights, both past and still to come.
        starts: For each motion found to start the robust stages from, the share of the models that stay the same on which it
            succeeds. Motions from which these stages already failed are left out.
        evaluation: Results of its candidates.
        validated: Results of its contender on the models that stay the same. The contender is the candidate, or the mean, that
            may become the best of a robust search, or a motion to start one from. It is tried on no further models once it
            cannot become the best. None without a contender.
        total_diverged: Number of trials of the whole search so far whose simulation broke down.
        initial: Number of motions or weights that the search began around.
        replayed: Whether records answered the whole generation, so that nothing was simulated.
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
        """Return the solution so far."""
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
    """The outcome of a search: the best trial, and what it took to find it.

    Attributes:
        best: The best trial.
        trials: Number of trials spent.
        generations: Number of completed generations.
        trials_to_success: Trials spent when one first met every criterion. None if none did.
        diverged: Number of trials whose simulation broke down.
        stopped: Why the search ended.
        cost_weights: Cost -> weight in ``best.cost``.
        changes: Changes of the cost weights on the way. A task with these changes gives the same solution again.
        initial: Number of motions or weights that the search began around (0: none).
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
