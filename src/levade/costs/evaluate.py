"""Compute the cost of each trial: the weighted sum of the terms (eq. 5), which is always finite."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories

Term = Callable[[Trajectories], Array]
"""A function from Trajectories to unweighted values, shape (n,): a dataclass of this package, or any other. Where trials have
different horizons, another function gets them one by one, each without rows that are not its own."""

DIVERGED = 1e12
"""Cost, and value of every term, of a trial that diverged. It is above that of any other trial, so the trial ranks last."""

HIGHEST = 1e11
"""Largest cost, and largest value of a term, of a trial that did not diverge."""


_OWN = "levade.costs."
"""Where terms are defined that leave out rows before a trial begins (`Trajectories.begin`) themselves."""


def within(values: Array, bound: float) -> Array:
    """Clip values to +-bound; NaN stays.

    `numpy.clip` takes several times as long for the few values of a generation.

    Args:
        values: Values, any shape.
        bound: Largest magnitude of the result, in the unit of the values.

    Returns:
        Clipped values, same shape.
    """
    return np.minimum(np.maximum(values, -bound), bound)


def evaluate(terms: Mapping[str, Term], trajectories: Trajectories) -> dict[str, Array]:
    """Evaluate each term of each trial, unweighted.

    Trials that diverged have `DIVERGED` in every term, and so has a term that is not finite. Other values are within
    +-`HIGHEST`.

    Args:
        terms: Name -> term.
        trajectories: The trials.

    Returns:
        Name -> values, always finite, shape (n,).

    Raises:
        LevadeError: If a term does not return one number per trial.
    """
    values: dict[str, Array] = {}
    with np.errstate(all="ignore"):  # broken trials overflow; they are dealt with below
        for name, term in terms.items():
            if trajectories.begin is None or type(term).__module__.startswith(_OWN):
                value = _values(name, term, trajectories)
            else:
                value = np.concatenate([_values(name, term, trajectories.alone(i)) for i in range(trajectories.n)])
            bad = trajectories.diverged | ~np.isfinite(value)
            values[name] = np.where(bad, DIVERGED, within(value, HIGHEST))
    return values


def _values(name: str, term: Term, trajectories: Trajectories) -> Array:
    """Evaluate one term, and check that it returns one number per trial."""
    value = np.asarray(term(trajectories), dtype=np.float64)
    if value.shape != (trajectories.n,):
        raise LevadeError(f"{name}: the term returned {value.shape}; one number per trial, ({trajectories.n},)")
    return value


def total(values: Mapping[str, Array], weights: Mapping[str, float]) -> Array:
    """Compute the cost of each trial: ``sum weight * term`` (eq. 5).

    Args:
        values: As `evaluate` returns them.
        weights: The paper's Q_i, one per term. A trial with a term at `DIVERGED` costs `DIVERGED` for any weight, any other
            trial at most `HIGHEST`.

    Returns:
        Costs, always finite, shape (n,).
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
