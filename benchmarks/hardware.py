"""What `levade solve --hardware` reaches, and what the nominal and the robust tasks reach by the same certificate.

    python benchmarks/hardware.py run --tasks rearing squat-jump --robots hyq2max --seeds 0 --arms nominal hardware
    python benchmarks/hardware.py table
    python benchmarks/hardware.py write         # docs/hardware-results.md, from benchmarks/hardware.md.in and the results

A row is written as soon as it is there, to results/hardware.jsonl, and one that is there is not run again. The certificate's
perturbed runs have a seed that no search has, and all arms are judged by what `--hardware` calls good enough.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from levade.checks import Certificate, check
from levade.errors import LevadeError
from levade.hardware import Plan, binding, obstacles, pursue
from levade.motions import Motion
from levade.robots import load_robot
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "hardware.jsonl"
TEMPLATE = HERE / "hardware.md.in"
PAGE = HERE.parent / "docs" / "hardware-results.md"
TASKS = (
    *(
        "rearing",
        "rearing-slow",
        "posture-recovery",
        "posture-recovery-slow",
        "sit-to-stand",
        "squat-jump",
        "handstand",
    ),
    *("mount", "leap", "side-recovery", "self-righting", "rear-and-land"),
)
ROBUST = ("rearing", "posture-recovery", "squat-jump", "self-righting")
CHECK_SEED = 100
ARMS = ("nominal", "robust", "hardware")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    running = commands.add_parser("run")
    running.add_argument("--tasks", nargs="+", default=TASKS)
    running.add_argument("--robots", nargs="+", default=["hyq2max"])
    running.add_argument("--seeds", nargs="+", type=int, default=[0])
    running.add_argument("--arms", nargs="+", choices=ARMS, default=ARMS)
    running.add_argument("--minutes", type=float, default=5.0)
    running.add_argument("--threads", type=int, default=0)
    running.add_argument("--out", type=Path, default=RESULTS)
    table = commands.add_parser("table")
    table.add_argument("results", nargs="*", type=Path, default=[RESULTS])
    commands.add_parser("write")
    options = parser.parse_args()
    if options.command == "write":
        PAGE.write_text(page(), encoding="utf-8")
        return
    if options.command == "table":
        print(as_table(rows_in(options.results)))
        return
    there = {(row["arm"], row["task"], row["robot"], row["seed"]) for row in rows_in([options.out])}
    for robot in options.robots:
        for task in options.tasks:
            for seed in options.seeds:
                for arm in options.arms:
                    known = arm != "robust" or task in ROBUST
                    if known and (arm, task, robot, seed) not in there:
                        row = row_of(arm, task, robot, seed, options)
                        with options.out.open("a") as file:
                            file.write(json.dumps(row) + "\n")


def row_of(arm: str, task: str, robot: str, seed: int, options: argparse.Namespace) -> dict[str, Any]:
    """One search, or pursuit, and its certificate."""
    row: dict[str, Any] = {"arm": arm, "task": task, "robot": robot, "seed": seed, "threads": options.threads}
    began, cpu = time.perf_counter(), time.process_time()
    try:
        made = load_task(f"{task}-robust" if arm == "robust" else task, robot=robot)
        if arm == "hardware":
            with tempfile.TemporaryDirectory() as folder:
                place = Path(folder) / "run"
                found = pursue(made, seed=seed, threads=options.threads, directory=place, minutes=options.minutes)
            motion, trials = found.motion, found.trials
            row |= {"minutes": options.minutes, "stopped": found.stopped, "obstacles": obstacles(found)}
            row["searches"] = [
                [part.name, part.trials, one and one.perturbed.share, one and list(one.failed)]
                for part in found.parts
                for one in [part.certificate]
            ]
        else:
            objective = make_objective(made, threads=options.threads)
            solution = solve(objective, seed=seed)
            motion, trials = record(objective, solution, seed=seed), solution.trials
    except LevadeError as error:
        return {**row, "refused": str(error)}
    # all arms by the same criteria, those that are good enough on perturbed robots
    goal = Plan.of(load_task(task, robot=robot), load_robot(robot)).on_others
    judged = replace(motion.task, success=goal, robust=None, feedback=None)
    row |= {"seconds": time.perf_counter() - began, "cpu": time.process_time() - cpu, "trials": trials}
    certificate = check(motion, seed=CHECK_SEED, criteria=judged, threads=options.threads)
    return {**row, **facts(motion, certificate)}


def facts(motion: Motion, certificate: Certificate) -> dict[str, Any]:
    """What a row says of a motion."""
    content = certificate.to_json()
    return {
        "solved": motion.result.success,
        "horizon": motion.horizon,
        "feedback": motion.stabiliser is not None,
        "passed": certificate.passed,
        "failed": content["failed"],
        "unknown": content["unknown"],
        "share": certificate.perturbed.share,
        "binding": binding(certificate),
        "margins": {name: one.value for name, one in certificate.margins.items()},
    }


def rows_in(files: list[Path]) -> list[dict[str, Any]]:
    """The rows of all files that are there."""
    return [json.loads(line) for file in files if file.exists() for line in file.read_text().splitlines()]


def page() -> str:
    """The text of docs/hardware-results.md."""
    rows = rows_in([RESULTS])
    minutes = {row["minutes"] for row in rows if "minutes" in row}
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, value in {
        "minutes": " or ".join(f"{one:g}" for one in sorted(minutes)),
        "table": as_table(rows),
        "summary": summary(rows),
        "refusals": refusals(rows),
    }.items():
        text = text.replace(f"{{{name}}}", value)
    return text


def summary(rows: list[dict[str, Any]]) -> str:
    """How many certificates pass, arm by arm, and what those of the hardware arm fail."""
    said = []
    for arm in ARMS:
        made = [row for row in rows if row["arm"] == arm and "refused" not in row]
        if made:
            passed = sum(row["passed"] for row in made)
            enough = sum(row["share"] >= 0.95 for row in made)
            said.append(f"{arm}: {passed} of {len(made)} certificates pass, {enough} hold on 95 % of robots or more")
    return "; ".join(said) + "."


def as_table(rows: list[dict[str, Any]]) -> str:
    """Markdown: a line for each certificate; tasks that a robot refuses are in `refusals`."""
    lines = [
        "| task | robot | seed | arm | certificate | holds on | T [s] | trials | time [s] | CPU [s] | nearest limit | fails |",
        "|---|---|--:|---|---|--:|--:|--:|--:|--:|---|---|",
    ]
    for row in sorted(rows, key=lambda row: (row["robot"], row["task"], row["seed"], ARMS.index(row["arm"]))):
        lead = f"| {row['task']} | {row['robot'].split(':')[-1]} | {row['seed']} | {row['arm']} |"
        if "refused" in row:
            continue
        verdict = f"{'**passes**' if row['passed'] else 'fails'}{' (feedback)' * row['feedback']}"
        numbers = (
            f"{row['share']:.1%} | {row['horizon']:.2f} | {row['trials']} | {row['seconds']:.0f} | {row['cpu']:.0f}"
        )
        lines.append(f"{lead} {verdict} | {numbers} | {nearest(row['binding'])} | {', '.join(row['failed'])} |")
    return "\n".join(lines)


def nearest(binding: str) -> str:
    """Shorten what `levade.hardware.binding` says, for a narrow column."""
    return re.sub(r"^(\S+) comes nearest to a limit: (\S+) of its (.*) left$", r"\1, \3: \2", binding)


def refusals(rows: list[dict[str, Any]]) -> str:
    """Markdown: a line for each reason why a task was refused, with the tasks."""
    found: dict[tuple[str, str], list[str]] = {}
    for row in sorted(rows, key=lambda row: (row["robot"], row["task"])):
        if "refused" in row:
            reason = row["refused"].split(":", 1)[-1].strip()
            tasks = found.setdefault((row["robot"].split(":")[-1], reason), [])
            tasks.extend({row["task"]} - set(tasks))
    return "\n".join(
        f"- {', '.join(f'`{task}`' for task in tasks)} on `{robot}`: {reason}"
        for (robot, reason), tasks in found.items()
    )


if __name__ == "__main__":
    main()
