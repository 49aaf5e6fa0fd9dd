"""Compute the cost of each trial: the weighted sum of the terms (eq. 5), which is always finite."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories

Term = Callable[[Trajectories], Array]
"""Trajectories to (n,), unweighted: the dataclasses of this package, or any function."""

DIVERGED = 1e12
"""Cost, and value of every term, of a trial that diverged: above that of any other trial, so it ranks last."""

HIGHEST = 1e11
"""Largest cost, and largest value of a term, of a trial that did not diverge."""


def within(values: Array, bound: float) -> Array:
    """Values clipped to +-bound; nan stays. `numpy.clip` takes several times as long for the few that a generation has."""
    return np.minimum(np.maximum(values, -bound), bound)


def evaluate(terms: Mapping[str, Term], trajectories: Trajectories) -> dict[str, Array]:
    """Each term of each trial, unweighted: name -> (n,), always finite.

    Trials that diverged have `DIVERGED` in every term; so has a term that is not finite. Others are within +-`HIGHEST`.

    Raises:
        LevadeError: If a term does not return one number per trial.
    """
    values: dict[str, Array] = {}
    with np.errstate(all="ignore"):  # broken trials overflow; they are dealt with below
        for name, term in terms.items():
            value = np.asarray(term(trajectories), dtype=np.float64)
            if value.shape != (trajectories.n,):
                raise LevadeError(f"{name}: the term returned {value.shape}; one number per trial, ({trajectories.n},)")
            bad = trajectories.diverged | ~np.isfinite(value)
            values[name] = np.where(bad, DIVERGED, within(value, HIGHEST))
    return values


def total(values: Mapping[str, Array], weights: Mapping[str, float]) -> Array:
    """The cost (n,) of each trial: ``sum weight * term`` (eq. 5), always finite.

    Args:
        values: As `evaluate` returns them.
        weights: The paper's Q_i, one per term, no more and no fewer. A trial with a term at `DIVERGED` costs
            `DIVERGED`, whatever the weight; any other at most `HIGHEST`.
    """
    if not values:
        raise LevadeError("costs: no terms; a task needs at least one")
    for name in weights:
        if name not in values:
            raise LevadeError(f"weights: {name} is not a term; {did_you_mean(name, values)}")
    for name in values:
        if name not in weights:
            raise LevadeError(f"weights: the term {name} has none; give it a number, 0 to leave it out")
        if not np.isfinite(weights[name]):
            raise LevadeError(f"weights: that of {name} is {weights[name]}; give a finite number")
    with np.errstate(all="ignore"):
        cost = np.zeros_like(next(iter(values.values())))
        for name, value in values.items():  # one by one: the same bits for one trial as for a batch
            cost += weights[name] * value
        cost = within(cost, HIGHEST)
        cost[np.isnan(cost)] = HIGHEST  # weights so large that inf - inf
    diverged = np.logical_or.reduce([value >= DIVERGED for value in values.values()])
    return np.where(diverged, DIVERGED, cost)
