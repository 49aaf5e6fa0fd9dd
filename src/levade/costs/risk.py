"""Reduce a candidate's costs on many robots to one: their mean, the mean of their logarithms or of the worst, or the worst."""

from __future__ import annotations

import math
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array

Measure = Literal["mean", "mean-log", "cvar", "worst"]
MEASURES: tuple[Measure, ...] = get_args(Measure)


def risk(cost: Array, known: NDArray[np.bool_], *, measure: Measure, tail: float = 0.5) -> Array:
    """Reduce the costs of each candidate's roll-outs to one number.

    Args:
        cost: Costs of whole roll-outs, shape (n, m).
        known: Which of them are known, shape (n, m); at least one per candidate.
        measure: "mean"; "mean-log", the mean of log(1 + cost), in which it counts more how many robots fail than how badly;
            "worst"; or "cvar", the mean of the worst share ``tail`` (at least one) of them: the conditional value
            at risk of Rockafellar and Uryasev, Journal of Risk 2 (2000), of the sample.
        tail: Share of the roll-outs for "cvar".

    Returns:
        Costs, shape (n,).
    """
    if measure == "mean-log":  # negative costs stay as they are, with the same slope at 0
        cost = np.where(cost > 0, np.log1p(np.maximum(cost, 0.0)), cost)
    descending = np.sort(np.where(known, -cost, np.inf), axis=1)  # the worst first, what is not known last
    count = known.sum(axis=1)
    if measure == "worst":
        return -descending[:, 0]
    taken = count if measure in ("mean", "mean-log") else np.maximum(1, np.ceil(tail * count - 1e-9)).astype(int)
    # summed one by one: the same bits whatever the batch
    total = np.zeros(len(cost))
    for column in range(cost.shape[1]):
        total += np.where(
            column < taken, -np.where(np.isfinite(descending[:, column]), descending[:, column], 0.0), 0.0
        )
    return total / taken


def ranked_behind(cost: Array, kept: NDArray[np.bool_]) -> Array:
    """Raise the costs of candidates that were eliminated early, so that they rank behind all others, in the same order.

    In a race, the few roll-outs of an eliminated candidate do not compare with those of one that ran them all.

    Args:
        cost: Costs, shape (n,).
        kept: Which candidates completed every roll-out, shape (n,).

    Returns:
        Costs, shape (n,).
    """
    if kept.all() or not kept.any():
        return cost
    lift = float(cost[kept].max() - cost[~kept].min())
    if lift < 0:
        return cost
    behind = cost[~kept] + lift
    raised = cost.copy()
    raised[~kept] = np.maximum(behind, np.nextafter(cost[kept].max(), math.inf))
    return raised
