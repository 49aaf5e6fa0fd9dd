"""Weigh costs and errors: weights of a generation, and errors as shares of the tolerances."""

from __future__ import annotations

import numpy as np

from levade.arrays import Array
from levade.search.evaluation import Evaluation
from levade.tasks import Stage, Task

INSIDE_BOUND = 0.015
"""Distance inside a bound that counts like the middle of a tolerance [SI: m, rad, ...]."""


def cost_weights(task: Task, generation: int) -> dict[str, float]:
    """Return cost -> weight in a generation, by the task's own weights.

    Args:
        task: The task, with its changes of weights.
        generation: Number of the generation.
    """
    factors = task.search.factors(generation)
    return {name: cost.weight * factors.get(name, 1.0) for name, cost in task.costs.items()}


def stage_weights(task: Task, stage: Stage, generation: int) -> dict[str, float]:
    """Return cost -> weight in a generation, for the costs that a stage weighs itself.

    Args:
        task: The task, with its changes of weights.
        stage: The stage.
        generation: Number of the generation.
    """
    factors = task.search.factors(generation)
    return {name: weight * factors.get(name, 1.0) for name, weight in stage.weights.items()}


def missed(task: Task, evaluation: Evaluation) -> Array:
    """Return errors as shares of the tolerances.

    For a criterion with bounds, 1 is the bound, and values farther inside are smaller.

    Args:
        task: The task.
        evaluation: Results of n trials.

    Returns:
        The shares, shape (n, criteria). NaN where unknown, and in every column for a trial that diverged.
    """
    shares = [
        1.0 - evaluation.slack[name] / INSIDE_BOUND
        if name in evaluation.slack
        else off / (task.success[name].tolerance or 1.0)
        for name, off in evaluation.errors.items()
    ]
    missed = np.stack(shares, axis=1) if shares else np.empty((len(evaluation.success), 0))
    return np.where(evaluation.diverged[:, None], np.nan, missed)
