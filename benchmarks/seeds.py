"""How often, and after how many trials, `levade solve` succeeds: each task as it is, over seeds. Prints a table.

    python benchmarks/seeds.py rearing posture-recovery [--seeds 10] [--first 0]

Trials are those spent when one first met every criterion; errors are those of the motion that the run ends with. Trial counts
do not depend on the machine's load or number of cores.
"""

from __future__ import annotations

import argparse
import os
import statistics
from concurrent.futures import ProcessPoolExecutor


def one(case: tuple[str, int]) -> tuple[str, bool, int | None, dict[str, float]]:
    """Task, success, trials to success, errors of one seed."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    from levade.search import make_objective, solve
    from levade.tasks import load_task

    name, seed = case
    solution = solve(make_objective(load_task(name), threads=1), seed=seed)
    return name, solution.success, solution.trials_to_success, dict(solution.best.errors)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="+")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--first", type=int, default=0, help="the first of the seeds")
    arguments = parser.parse_args()
    with ProcessPoolExecutor(2) as pool:
        seeds = range(arguments.first, arguments.first + arguments.seeds)
        results = list(pool.map(one, [(task, seed) for task in arguments.tasks for seed in seeds]))
    print("| task | success | trials to success, median (range) | final errors, largest of the successes |")
    print("|---|---|---|---|")
    for task in arguments.tasks:
        mine = [result for result in results if result[0] == task]
        won = [result for result in mine if result[1]]
        trials = [result[2] for result in won if result[2] is not None]
        spent = f"{statistics.median(trials):.0f} ({min(trials)} to {max(trials)})" if trials else "none"
        worst = {name: max((abs(r[3][name]) for r in won), default=float("nan")) for name in mine[0][3]}
        errors = ", ".join(f"{name} {value:.4f}" for name, value in worst.items())
        print(f"| `{task}` | {len(won)} of {len(mine)} | {spent} | {errors} |")


if __name__ == "__main__":
    main()
