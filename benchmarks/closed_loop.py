"""What feedback in the search is worth: robust tasks open loop, stabilised afterwards, and with feedback in the search.

    python benchmarks/closed_loop.py run rearing-robust posture-recovery-robust --seeds 0 1 2 --out results/closed_loop.jsonl
    python benchmarks/closed_loop.py table results/closed_loop.jsonl

Both searches of a row have the same budget. Each motion is then checked on 500 perturbed runs with sensor errors, which no
search and no stabiliser saw. A row is written as soon as it is there, and one that is there is not run again.
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from levade.checks import perturbed
from levade.engines import Perturbation
from levade.motions import Motion, RecordedSimulation
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.stabilisers import stabilise
from levade.tasks import Regulation, load_task

CHECK_SEED = 100
"""Of the runs that judge; searches have seeds below."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    running = commands.add_parser("run")
    running.add_argument("tasks", nargs="+")
    running.add_argument("--robot")
    running.add_argument("--seeds", nargs="+", type=int, default=[0, 1, 2])
    running.add_argument("--trials", type=int, default=4000)
    running.add_argument("--runs", type=int, default=500)
    running.add_argument("--threads", type=int, default=0)
    running.add_argument("--out", type=Path, required=True)
    table = commands.add_parser("table")
    table.add_argument("results", type=Path)
    options = parser.parse_args()
    if options.command == "table":
        print(as_table([json.loads(line) for line in options.results.read_text().splitlines()]))
        return
    done = [json.loads(line) for line in options.out.read_text().splitlines()] if options.out.exists() else []
    there = {(row["task"], row["robot"], row["seed"], row["trials"]) for row in done}
    for seed in options.seeds:
        for name in options.tasks:
            task = load_task(name, robot=options.robot, changes=[f"search.trials={options.trials}"])
            if (name, task.robot.name, seed, options.trials) in there:
                continue
            row = {"task": name, "robot": task.robot.name, "seed": seed, "trials": options.trials, "runs": options.runs}
            row |= arms(task, seed, options)
            with options.out.open("a") as file:
                file.write(json.dumps(row) + "\n")


def arms(task: Any, seed: int, options: argparse.Namespace) -> dict[str, Any]:
    """The three columns of a row."""
    found: dict[str, Any] = {}
    motions: dict[str, Motion] = {}
    for arm in ("open", "feedback"):
        one = replace(task, feedback=Regulation()) if arm == "feedback" else task
        objective = make_objective(one, threads=options.threads)
        began, cpu = time.perf_counter(), time.process_time()
        solution = solve(objective, seed=seed)
        motions[arm] = record(objective, solution, seed=seed)
        found[arm] = {
            "on_fixed": solution.best.share,
            "trials_to_success": solution.trials_to_success,
            "seconds": time.perf_counter() - began,
            "cpu": time.process_time() - cpu,
            "steps": objective.engine.steps,
        }
    stabilised = stabilise(motions["open"], seed=seed, threads=options.threads)
    motions["stabilised"] = stabilised.motion
    found["stabilised"] = {"better": stabilised.design is not None}
    for arm, motion in motions.items():
        checked = perturbed(
            RecordedSimulation(motion, threads=options.threads),
            Perturbation(),
            runs=options.runs,
            seed=CHECK_SEED,
            feedback=motion.feedback,
        )
        found[arm] |= {"share": checked.share, "low": checked.low, "high": checked.high}
    return found


def as_table(rows: list[dict[str, Any]]) -> str:
    """One line a task and robot: shares of its seeds, in order, and what they cost."""
    lines = [
        "| task, robot | seeds | open loop | stabilised afterwards | feedback in the search | CPU time per step |",
        "|---|---|---|---|---|---|",
    ]
    for key in dict.fromkeys((row["task"], row["robot"]) for row in rows):
        mine = [row for row in rows if (row["task"], row["robot"]) == key]
        shares = (", ".join(f"{row[arm]['share']:.1%}" for row in mine) for arm in ("open", "stabilised", "feedback"))
        ratio = np.median(
            [
                (row["feedback"]["cpu"] / row["feedback"]["steps"]) / (row["open"]["cpu"] / row["open"]["steps"])
                for row in mine
            ]
        )
        seeds = ", ".join(str(row["seed"]) for row in mine)
        lines.append(f"| {Path(key[0]).stem}, {key[1]} | {seeds} | {' | '.join(shares)} | {ratio:.2f} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
