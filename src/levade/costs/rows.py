"""Rows of the trajectories for terms, and the checks that all terms share."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError
from levade.trajectory import Trajectories

At = Literal["horizon", "end", "hold"]
"""When a terminal term counts: at the horizon T, in the last row (the end of the hold), or over the whole hold."""

Over = Literal["horizon", "all"]
"""What a running term integrates over: up to the horizon, [0, T], or including the hold."""


def rows_at(trajectories: Trajectories, at: At) -> slice:
    """Return the rows of a terminal term, one for "horizon" and "end".

    Args:
        trajectories: The trials.
        at: When the term counts, see `At`.

    Returns:
        The rows.

    Raises:
        LevadeError: If ``at`` is unknown, or is "hold" and the motion ends at its horizon.
    """
    if at == "horizon":
        return slice(trajectories.horizon_steps - 1, trajectories.horizon_steps)
    if at == "end":
        return slice(trajectories.steps - 1, trajectories.steps)
    if at != "hold":
        raise LevadeError(f"at: {at!r} is unknown; horizon, end or hold")
    if trajectories.steps == trajectories.horizon_steps:
        raise LevadeError("at: hold, but the motion ends at its horizon; give the task a hold, or say at: horizon")
    return slice(trajectories.horizon_steps, trajectories.steps)


def rows_over(trajectories: Trajectories, over: Over) -> slice:
    """Return the rows of a running term.

    Args:
        trajectories: The trials.
        over: What the term integrates over, see `Over`.

    Returns:
        The rows, from the first on.

    Raises:
        LevadeError: If ``over`` is unknown.
    """
    if over not in ("horizon", "all"):
        raise LevadeError(f"over: {over!r} is unknown; horizon or all")
    return slice(0, trajectories.horizon_steps if over == "horizon" else trajectories.steps)


def integral(rate: Array, trajectories: Trajectories, rows: slice) -> Array:
    """Integrate over time, and sum over all dimensions except the trials.

    Each trial's sum is over its own contiguous row, so its bits do not depend on the batch.

    Args:
        rate: Values at the rows, shape (n, rows, ...).
        trajectories: The n trials.
        rows: Their rows.

    Returns:
        Integrals in the unit of the rate times s, shape (n,).
    """
    counted = trajectories.counted(rows)
    if counted is not None:
        rate = np.where(counted.reshape(*counted.shape, *[1] * (rate.ndim - 2)), rate, 0.0)
    return np.ascontiguousarray(rate).reshape(len(rate), -1).sum(axis=1) * trajectories.timestep


def mean_in(values: Array, trajectories: Trajectories, rows: slice) -> Array:
    """Average values over the rows that belong to each trial.

    Args:
        values: Values at the rows, shape (n, rows).
        trajectories: The n trials.
        rows: Their rows.

    Returns:
        Means in the unit of the values, shape (n,).
    """
    counted = trajectories.counted(rows)
    if counted is None:
        return mean_over_rows(values)
    return np.ascontiguousarray(np.where(counted, values, 0.0)).sum(axis=1) / counted.sum(axis=1)


def squared_distance(values: Array, target: tuple[float | None, ...], tolerance: float = 0.0) -> Array:
    """Average over the rows the squared distance to the target, beyond the tolerance, in the components that have one.

    Args:
        values: Values, shape (n, rows, components).
        target: Required value of each component; None if it is free.
        tolerance: Distance that costs nothing.

    Returns:
        Means, shape (n,).
    """
    # one by one: numpy's own sum takes another order for a single trial, and would change its last bit
    squares = np.zeros(values.shape[:-1])
    for i, required in enumerate(target):
        if required is not None:
            squares += (values[..., i] - required) ** 2
    return mean_over_rows(beyond(squares, tolerance))


def beyond(squared: Array, tolerance: float) -> Array:
    """Turn squared distances into squares of the excess over a tolerance.

    Args:
        squared: Squared distances, any shape.
        tolerance: Distance that costs nothing, in the unit of the distances.

    Returns:
        Squared excesses, same shape; 0 within the tolerance.
    """
    if tolerance == 0:
        return squared
    return np.maximum(0.0, np.sqrt(squared) - tolerance) ** 2


def mean_over_rows(values: Array) -> Array:
    """Average over rows.

    Args:
        values: Values, shape (n, rows).

    Returns:
        Means in the unit of the values, shape (n,).
    """
    return np.ascontiguousarray(values).mean(axis=1)


def check_target(term: str, **target: float | None) -> None:
    """Check that at least one target is given, and that all given targets are finite.

    Args:
        term: Name of the term, for the message.
        **target: Required values by the names of their keys; None for one that is free.

    Raises:
        LevadeError: If no target is given, or one is not finite.
    """
    if all(value is None for value in target.values()):
        raise LevadeError(f"{term}: no target; give at least one of {', '.join(target)}")
    for name, value in target.items():
        if value is not None and not math.isfinite(value):
            raise LevadeError(f"{term}.{name}: {value} is not finite; leave it out where it is free")


def check_tolerance(term: str, tolerance: float) -> None:
    """Check that a tolerance is finite and not negative.

    Args:
        term: Name of the term, for the message.
        tolerance: Tolerance, in the unit of the term's distances.

    Raises:
        LevadeError: If the tolerance is negative or not finite.
    """
    if not (math.isfinite(tolerance) and tolerance >= 0):
        raise LevadeError(f"{term}.tolerance: {tolerance} should be 0 or more")
