"""Summarise results: success, expected running time, and final cost.

The expected running time (ERT) is that of COCO (Hansen et al., COCO: a platform for comparing continuous optimizers in a
black-box setting, 2021). It is what all runs of a case spent until their first success or their end, divided by the number of
successes. It is the expected effort until a success, if each failed run is followed by another.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.bench.results import Result
from levade.optimizers import canonical

BUDGETS = {"trials": "trials", "steps": "physics steps", "core_seconds": "core-seconds"}
"""Kinds of effort -> their names."""

LEVEL = 0.95
RESAMPLES = 4000


@dataclass(frozen=True)
class Interval:
    """Holds a number and its bootstrap interval over the runs, at level `LEVEL`. It is infinite without a success."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Summary:
    """Summarises the runs of one task, robot and optimizer.

    Attributes:
        median: Median of the trials to success over all runs. A run without success counts as infinite.
        least: Least trials to success.
        most: Most trials to success.
        ert: Kind of effort (a key of `BUDGETS`) -> expected running time.
        cost: Quartiles of the final cost, shape (3,).
        until: When the runs end: "success", "budget" or "mixed".
    """

    task: str
    robot: str
    optimizer: str
    runs: int
    successes: int
    median: float
    least: float
    most: float
    ert: dict[str, Interval]
    cost: tuple[float, float, float]
    until: str


def spent(results: Sequence[Result], what: str) -> tuple[Array, NDArray[np.bool_]]:
    """Count what runs spent until success or their end.

    Args:
        results: Results of n runs.
        what: A key of `BUDGETS`.

    Returns:
        The effort and whether there was a success, shape (n,) each.
    """
    to_success = [getattr(result, f"{what}_to_success") for result in results]
    whole = [getattr(result, what) for result in results]
    success = np.array([result.success for result in results], dtype=bool)
    pairs = zip(to_success, whole, strict=True)
    return np.array([end if first is None else first for first, end in pairs], dtype=float), success


def expected_running_time(amount: Array, success: NDArray[np.bool_]) -> Interval:
    """Compute the ERT of n runs, and its bootstrap interval.

    The interval has percentiles of the ERT of n runs that are drawn from these with replacement, from a fixed seed.

    Args:
        amount: Effort until success or the end, shape (n,).
        success: Whether there was a success, shape (n,).

    Returns:
        The ERT with its interval.
    """
    generator = np.random.default_rng(0)
    drawn = generator.integers(len(amount), size=(RESAMPLES, len(amount)))
    with np.errstate(divide="ignore"):
        value = amount.sum() / success.sum()
        again = np.sort(amount[drawn].sum(axis=1) / success[drawn].sum(axis=1))
    tail = (1 - LEVEL) / 2
    # percentiles that are among the numbers themselves: between two, one of which is infinite, there is none
    low, high = again[math.floor(tail * RESAMPLES)], again[math.ceil((1 - tail) * RESAMPLES) - 1]
    return Interval(float(value), float(low), float(high))


def success_curve(results: Sequence[Result], what: str) -> tuple[Array, Array]:
    """Compute the share of runs that have succeeded after a given effort (ECDF).

    Args:
        results: Results of runs.
        what: A key of `BUDGETS`.

    Returns:
        Increasing efforts, and the share after each, shape (k,) each.
    """
    amount, success = spent(results, what)
    amounts = np.sort(amount[success])
    return amounts, np.arange(1, amounts.size + 1) / len(results)


def grouped(results: Iterable[Result]) -> dict[tuple[str, str], dict[str, list[Result]]]:
    """Group results as task and robot -> optimizer -> runs, all in the order in which they come.

    Runs of an optimizer and of its alias form one group, under the name that comes first.

    Args:
        results: Results of runs.

    Returns:
        Task and robot -> name of the optimizer -> its results.
    """
    names: dict[str, str] = {}
    groups: dict[tuple[str, str], dict[str, list[Result]]] = {}
    for result in results:
        name = names.setdefault(canonical(result.optimizer), result.optimizer)
        groups.setdefault((result.task, result.robot), {}).setdefault(name, []).append(result)
    return groups


def summarise(results: Iterable[Result]) -> list[Summary]:
    """Summarise results: one summary for each task, robot and optimizer.

    Args:
        results: Results of runs.

    Returns:
        The summaries, in the order in which their first results come.
    """
    summaries = []
    for (task, robot), optimizers in grouped(results).items():
        for optimizer, runs in optimizers.items():
            trials = [math.inf if run.trials_to_success is None else float(run.trials_to_success) for run in runs]
            ends = {run.until for run in runs}
            summaries.append(
                Summary(
                    task=task,
                    robot=robot,
                    optimizer=optimizer,
                    runs=len(runs),
                    successes=sum(run.success for run in runs),
                    median=_median(trials),
                    least=min(trials),
                    most=max(trials),
                    ert={what: expected_running_time(*spent(runs, what)) for what in BUDGETS},
                    cost=tuple(np.quantile([run.cost for run in runs], (0.25, 0.5, 0.75)).tolist()),
                    until=ends.pop() if len(ends) == 1 else "mixed",
                )
            )
    return summaries


def _median(values: Sequence[float]) -> float:
    """Compute the median of numbers that may be infinite."""
    ordered = sorted(values)
    middle = (len(ordered) - 1) // 2
    low, high = ordered[middle], ordered[-1 - middle]
    return low if low == high else (low + high) / 2
