"""Ways to keep a search within the robot's limits: trials until a motion of the nominal model does the task within all of them.

    python benchmarks/constraints.py --tasks rearing rear-and-land --seeds 10 11 12
    python benchmarks/constraints.py --table

Arms: the cost of margins that `levade solve --hardware` has, with several weights; the augmented Lagrangian of the library cma
(Atamna, Auger, Hansen, FOGA 2017), a multiplier for each kind of limit; and ranking (Deb, 2000): who is within the limits comes
first, then who is beyond them by less. The last two have no cost of margins, and no aimed candidates.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from cma.constraints_handler import AugmentedLagrangian

from levade.arrays import Array
from levade.hardware import Plan
from levade.optimizers import CMAES, SearchSpace
from levade.search import make_objective, solve
from levade.tasks import Task, load_task

RESULTS = Path(__file__).resolve().parent / "results" / "constraints.jsonl"
WEIGHTS = {"margins 0.02": 0.02, "margins 0.1": 0.1, "margins 0.5": 0.5, "margins 2": 2.0, "margins 5": 5.0}
ARMS = (*WEIGHTS, "augmented Lagrangian", "ranking")
UNKNOWN = 1e3
"""Violation of a trial that broke down."""


class _WithLimits(CMAES):
    """CMA-ES that is told of limits beside the cost; the last columns of the errors are theirs, 1 at the limit."""

    SETTINGS = ("limits",)

    def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...], limits: int) -> None:
        super().__init__(space, seed=seed)
        self._limits = int(limits)

    def forget_costs(self, changed: object) -> None:
        """Nothing is remembered."""

    def tell(self, cost: Array, errors: Array) -> None:
        beyond = np.nan_to_num(errors[:, -self._limits :], nan=UNKNOWN) - 1.0  # at most 0 within the limit
        super().tell(self.with_limits(cost, beyond))

    def with_limits(self, cost: Array, beyond: Array) -> Array:
        raise NotImplementedError


class Ranked(_WithLimits):
    """Deb's rule."""

    def with_limits(self, cost: Array, beyond: Array) -> Array:
        total = np.maximum(beyond, 0.0).sum(axis=1)
        return np.where(total > 0, cost.max() + total, cost)


class Lagrangian(_WithLimits):
    """The library's multipliers, updated along the best candidate of each generation."""

    def __init__(self, space: SearchSpace, *, seed: int | tuple[int, ...], limits: int) -> None:
        super().__init__(space, seed=seed, limits=limits)
        self._multipliers = AugmentedLagrangian(space.dimensions)
        self._multipliers.logging = 0

    def with_limits(self, cost: Array, beyond: Array) -> Array:
        self._multipliers.set_coefficients(cost.tolist(), beyond.tolist())
        penalised = np.array([f + sum(self._multipliers(g)) for f, g in zip(cost, beyond, strict=True)])
        best = int(np.argmin(penalised))
        self._multipliers.update(cost[best], beyond[best])
        return penalised


def task_of(name: str, robot: str, arm: str, trials: int) -> Task:
    """The plan's search within limits, with an arm's way to keep to them."""
    task = load_task(name, robot=robot)
    plan = Plan.of(task, task.robot.load())
    within = plan.within_limits()
    search = replace(within.search, trials=trials, polish=0)
    costs = dict(within.costs)
    if arm in WEIGHTS:
        costs["margins"] = replace(costs["margins"], weight=WEIGHTS[arm])
    else:
        del costs["margins"]
        search = replace(
            search, optimizer=Ranked if arm == "ranking" else Lagrangian, settings={"limits": len(plan.limits)}
        )
    return replace(within, costs=costs, search=search)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=["rearing", "rear-and-land"])
    parser.add_argument("--robot", default="hyq2max")
    parser.add_argument("--seeds", nargs="+", type=int, default=[10, 11, 12])
    parser.add_argument("--arms", nargs="+", choices=ARMS, default=ARMS)
    parser.add_argument("--trials", type=int, default=3000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--out", type=Path, default=RESULTS)
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    if options.table:
        print(
            table([json.loads(line) for line in options.out.read_text().splitlines()] if options.out.exists() else [])
        )
        return
    for name in options.tasks:
        for seed in options.seeds:
            for arm in options.arms:
                task = task_of(name, options.robot, arm, options.trials)
                began = time.process_time()
                found = solve(make_objective(task, threads=options.threads), seed=seed)
                row = {"task": name, "robot": options.robot, "arm": arm, "seed": seed, "trials": options.trials}
                row |= {"met": found.trials_to_success, "seconds": round(time.process_time() - began, 1)}
                with options.out.open("a") as file:
                    file.write(json.dumps(row) + "\n")


def table(rows: list[dict]) -> str:
    """Trials of each seed, and their median; one that meets them in no trial counts as the budget."""
    tasks = list(dict.fromkeys(row["task"] for row in rows))
    lines = [
        "| way | " + " | ".join(f"{task}: trials of each seed, median" for task in tasks) + " |",
        "|---|" + "---|" * len(tasks),
    ]
    for arm in (arm for arm in ARMS if any(row["arm"] == arm for row in rows)):
        cells = []
        for task in tasks:
            mine = sorted(
                (row for row in rows if (row["arm"], row["task"]) == (arm, task)), key=lambda row: row["seed"]
            )
            if not mine:
                cells.append("")
                continue
            trials = [row["met"] or row["trials"] for row in mine]
            shown = ", ".join(str(row["met"] or f"> {row['trials']}") for row in mine)
            cells.append(f"{shown}; **{statistics.median(trials):g}**")
        lines.append(f"| {arm} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
