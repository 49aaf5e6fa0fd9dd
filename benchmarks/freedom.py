"""What it is worth to leave duration or final posture to the search. Prints two tables.

    python benchmarks/freedom.py duration [--tasks rearing ...] [--robots hyq2max ...] [--seeds 100 110]
    python benchmarks/freedom.py duration --grid         # and eight fixed durations between the bounds
    python benchmarks/freedom.py posture [--tasks sit-to-stand ...]

*Duration*: each task as it is, and with ``horizon: {minimum: T/2, maximum: 3 T, initial: T}``. *Posture*: each task as it is,
and with ``policy.goal: free``, both with an effort that counts the hold as well, and 600 trials after the first success. The
torque of standing is that of the last tenth of a second of the hold, as a share of each joint's limit, root mean square over
joints. Else a search ends with its first success, or after 6000 trials. Every run is kept in results/freedom.jsonl, and is not
made again.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import zlib
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results" / "freedom.jsonl"
BUDGET = 6000
TASKS = {
    "duration": ("rearing", "posture-recovery", "self-righting", "squat-jump"),
    "posture": ("sit-to-stand", "posture-recovery"),
}
SETTLE = 0.4
"""Share of the horizon in which references settle, for tasks that leave their ends to the weights."""
Case = tuple[str, str, str, int]
"""Task, robot, kind and seed."""


def task_of(case: Case) -> Any:
    """The task of a case: "fixed", "free", "x1.5" for another fixed horizon; or "neutral" and "posture", where it ends."""
    from levade.tasks import load_task

    name, robot, kind, _ = case
    base = load_task(name, robot=robot)
    changes = [f"search.trials={BUDGET}", "search.polish=0"]
    if kind == "free":
        t = base.horizon
        changes.append(f"horizon={{minimum: {t / 2}, maximum: {3 * t}, initial: {t}}}")
    elif kind in ("neutral", "posture"):
        changes += ["costs.effort.over=all", "stages=[{}]", "search.polish=600"]
        if base.policy.settle == 0:
            changes.append(f"policy.settle={SETTLE}")
        if kind == "posture":
            changes.append("policy.goal=free")
    elif kind.startswith("x"):
        changes.append(f"horizon={base.horizon * float(kind[1:])}")
    return load_task(name, robot=robot, changes=changes)


def checksum(case: Case) -> int:
    """What decides a run: its task with every default, and its seed."""
    from levade.tasks import task_to_yaml

    return zlib.crc32(f"{task_to_yaml(task_of(case))} {case[3]}".encode())


def run(case: Case) -> dict[str, Any]:
    """One search."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    import numpy as np

    from levade.search import make_objective, solve
    from levade.search.recording import record

    objective = make_objective(task_of(case), threads=1)
    motion = record(objective, solve(objective, seed=case[3]), seed=case[3])
    share = motion["joint_torque"][-50:] / objective.robot.limits.torque
    return {
        "case": list(case),
        "checksum": checksum(case),
        "success": motion.result.success,
        "trials": motion.result.trials_to_success,
        "horizon": motion.horizon,
        "cost": motion.result.cost,
        "torque": float(np.sqrt(np.square(share).mean())),
        "steps": objective.engine.steps,
    }


def runs(cases: list[Case]) -> dict[Case, dict[str, Any]]:
    """The result of each case, from the file or new."""
    kept = [json.loads(line) for line in RESULTS.read_text().splitlines()] if RESULTS.exists() else []
    done = {(tuple(one["case"]), one["checksum"]): one for one in kept}
    found = {case: done[case, checksum(case)] for case in cases if (case, checksum(case)) in done}
    missing = [case for case in cases if case not in found]
    with ProcessPoolExecutor(min(2, os.cpu_count() or 1)) as pool, RESULTS.open("a") as file:
        for future in as_completed([pool.submit(run, case) for case in missing]):
            one = future.result()
            found[tuple(one["case"])] = one
            file.write(json.dumps(one) + "\n")
            file.flush()
    return found


def row(results: list[dict[str, Any]]) -> tuple[str, str, str, str]:
    """Successes, trials to success, horizon and cost of several seeds."""
    won = [one for one in results if one["success"]]
    if not won:
        return f"0 of {len(results)}", "", "", ""

    def middle(name: str, digits: int) -> str:
        values = [one[name] for one in won]
        return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"

    return f"{len(won)} of {len(results)}", middle("trials", 0), middle("horizon", 2), middle("cost", 3)


def pairs(arguments: argparse.Namespace) -> Iterator[tuple[str, str]]:
    """Tasks and robots that were asked for."""
    for task in arguments.tasks or TASKS[arguments.what]:
        for robot in arguments.robots:
            yield task, robot


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=sorted(TASKS))
    parser.add_argument("--tasks", nargs="+")
    parser.add_argument("--robots", nargs="+", default=["hyq2max"])
    parser.add_argument("--seeds", nargs=2, type=int, default=(100, 110))
    parser.add_argument("--grid", action="store_true")
    arguments = parser.parse_args()
    kinds = ["fixed", "free"] if arguments.what == "duration" else ["neutral", "posture"]
    if arguments.grid:
        kinds += [f"x{0.5 * 6 ** (k / 7):.2f}" for k in range(8)]
    cases = [
        (task, robot, kind, seed)
        for task, robot in pairs(arguments)
        for kind in kinds
        for seed in range(*arguments.seeds)
    ]
    found = runs(cases)
    last = "torque of standing" if arguments.what == "posture" else "cost"
    print(f"| task | robot | kind | success | trials to success | T [s] | {last} |\n|---|---|---|---|---|---|---|")
    for task, robot in pairs(arguments):
        for kind in kinds:
            results = [found[task, robot, kind, seed] for seed in range(*arguments.seeds)]
            success, trials, horizon, cost = row(results)
            if arguments.what == "posture":
                shares = [one["torque"] for one in results if one["success"]]
                cost = f"{statistics.median(shares):.3f}" if shares else ""
            print(f"| `{task}` | {robot} | {kind} | {success} | {trials} | {horizon} | {cost} |")


if __name__ == "__main__":
    main()
