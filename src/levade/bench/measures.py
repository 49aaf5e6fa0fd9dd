"""What results say: success, expected running time, and what was left of the cost.

The expected running time (ERT) is that of COCO (Hansen et al., COCO: a platform for comparing continuous optimizers in a
black-box setting, 2021): of all runs of a case, what was spent until a first success or the end of the run, over the number
of successes. It is what one expects to spend until a success when starting again after each run that fails.
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
"""What is spent -> in words."""

LEVEL = 0.95
RESAMPLES = 4000


@dataclass(frozen=True)
class Interval:
    """A number and where it may lie: bootstrap over the runs, level `LEVEL`. Infinite where there is no success."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Summary:
    """What the runs of one task, robot and optimizer say.

    Attributes:
        median: Trials to success over all runs; infinite for runs without.
        least: Trials to success over all runs; infinite for runs without.
        most: Trials to success over all runs; infinite for runs without.
        ert: What is spent (a key of `BUDGETS`) -> expected running time.
        cost: Quartiles of the final cost, (3,).
        until: What the runs went on to, all alike or "mixed".
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
    """(n,) spent until success or else the end, and (n,) whether there was success.

    Args:
        results: Results of runs.
        what: A key of `BUDGETS`.
    """
    to_success = [getattr(result, f"{what}_to_success") for result in results]
    whole = [getattr(result, what) for result in results]
    success = np.array([result.success for result in results], dtype=bool)
    pairs = zip(to_success, whole, strict=True)
    return np.array([end if first is None else first for first, end in pairs], dtype=float), success


def expected_running_time(amount: Array, success: NDArray[np.bool_]) -> Interval:
    """ERT of runs that spent (n,) until success or else the end.

    The interval is the bootstrap's: percentiles of the ERT of n runs drawn from these with replacement, always the same.
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
    """The share of runs that had succeeded (ECDF) once so much was spent: (k,) rising amounts, (k,) shares after each."""
    amount, success = spent(results, what)
    amounts = np.sort(amount[success])
    return amounts, np.arange(1, amounts.size + 1) / len(results)


def grouped(results: Iterable[Result]) -> dict[tuple[str, str], dict[str, list[Result]]]:
    """Task and robot -> optimizer -> its runs, all in the order in which they come.

    Runs of an optimizer and of its alias are in one group, by the name that comes first.
    """
    names: dict[str, str] = {}
    groups: dict[tuple[str, str], dict[str, list[Result]]] = {}
    for result in results:
        name = names.setdefault(canonical(result.optimizer), result.optimizer)
        groups.setdefault((result.task, result.robot), {}).setdefault(name, []).append(result)
    return groups


def summarise(results: Iterable[Result]) -> list[Summary]:
    """One for each task, robot and optimizer."""
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
    """Of numbers some of which may be infinite."""
    ordered = sorted(values)
    middle = (len(ordered) - 1) // 2
    low, high = ordered[middle], ordered[-1 - middle]
    return low if low == high else (low + high) / 2
