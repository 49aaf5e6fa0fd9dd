"""What costs and errors count: weights of a generation, and errors as shares of what is allowed."""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.search.evaluation import Evaluation
from levade.tasks import Stage, Task

INSIDE_BOUND = 0.015
"""[SI: m, rad, ...], as far inside a bound as the middle of a tolerance is inside the tolerance."""


def cost_weights(task: Task, generation: int) -> dict[str, float]:
    """Cost -> weight in a generation, by the task's own weights."""
    factors = task.search.factors(generation)
    return {name: cost.weight * factors.get(name, 1.0) for name, cost in task.costs.items()}


def stage_weights(task: Task, stage: Stage, generation: int) -> dict[str, float]:
    """Cost -> weight in a generation, for those costs that a stage weighs itself."""
    factors = task.search.factors(generation)
    return {name: weight * factors.get(name, 1.0) for name, weight in stage.weights.items()}


def missed(task: Task, evaluation: Evaluation) -> Array:
    """Errors as a share of what is allowed, shape (n, criteria); NaN where unknown, all of a trial that diverged.

    For a criterion with bounds, 1 is the bound, and what is farther inside is less.
    """
    shares = [
        1.0 - evaluation.slack[name] / INSIDE_BOUND
        if name in evaluation.slack
        else off / (task.success[name].tolerance or 1.0)
        for name, off in evaluation.errors.items()
    ]
    missed = np.stack(shares, axis=1) if shares else np.empty((len(evaluation.success), 0))
    return np.where(evaluation.diverged[:, None], np.nan, missed)
