"""The paper's two experiments with the paper's own method, and docs/paper.md with what came of them.

    python benchmarks/paper.py            # ten seeds, both tasks, both horizons: 54 core-minutes
    python benchmarks/paper.py --write    # only write docs/paper.md anew, from benchmarks/results

What it says of both engines is from the results of engines.py and robust.py.

Plain CMA-ES: default population (17 and 19), one stage with the paper's weights, weights sampled independently (no smooth
initial covariance), cumulative step-size adaptation, initial step 0.05 rad (the first author's code has 0.01 to 0.05), the
paper's budget of 3009 and 3002 trials. A seed counts as having met the paper's accuracy when one trial did.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import statistics
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "paper.json"
PAGE = HERE.parent / "docs" / "paper.md"

PLAIN = [
    "search.optimizer=cma",
    "search.population=null",
    "search.smoothness=0",
    "search.modes=null",
    "search.step=0.05",
    "search.step_adaptation=csa",
    "search.polish=null",
    "stages=[{name: full, hold: false}]",
]
ACCURACY = {  # what the paper reports
    "rearing": "success={pitch: {target: -1.0472, tolerance: 0.006}, height: {target: 0.9, tolerance: 0.1}}",
    "posture-recovery": "success={roll: {target: 0, tolerance: 0.001}, pitch: {target: 0, tolerance: 0.001},"
    " yaw: {target: 0, tolerance: 0.001}, height: {target: 0.61, tolerance: 0.02}}",
}
BUDGET = {"rearing": 3009, "posture-recovery": 3002}
CASES = [(task, horizon) for task in ACCURACY for horizon in ("0.3 s", "3 s")]


def experiment(case: tuple[str, str, int]) -> dict[str, Any]:
    """One seed of one case."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    from levade.search import make_objective, solve
    from levade.tasks import load_task

    name, horizon, seed = case
    changes = [*PLAIN, ACCURACY[name], f"search.trials={BUDGET[name]}"]
    if horizon == "3 s":
        changes += ["horizon=3.0", "policy.time=seconds"]
    if name == "posture-recovery":
        changes += ["policy.goal=neutral", "costs.hold_orientation.weight=0", "costs.hold_position.weight=0"]
    objective = make_objective(load_task(name, changes=changes), threads=1)
    solution = solve(objective, seed=seed)
    result: dict[str, Any] = {
        "task": name,
        "horizon": horizon,
        "seed": seed,
        "trials": solution.trials,
        "trials_to_paper": solution.trials_to_success,
        "errors": solution.best.errors,
        "cost": solution.best.cost,
        "diverged": solution.diverged,
    }
    ours = load_task(name).success
    off = objective.rollout(solution.best.weights[None])
    result["ours"] = bool(all(criterion.holds(off)[0] for criterion in ours.values()))
    if objective.task.hold_steps:
        result["stays"] = bool(all(c.holds(off)[0] for c in ours.values() if c.at == "end"))
    return result


def run(seeds: int) -> None:
    from levade.motions import versions

    cases = [(task, horizon, seed) for task, horizon in CASES for seed in range(seeds)]
    RESULTS.parent.mkdir(exist_ok=True)
    results: list[dict[str, Any]] = []
    with ProcessPoolExecutor(2) as pool:
        for result in pool.map(experiment, cases):
            results.append(result)
            print(
                result["task"],
                result["horizon"],
                result["seed"],
                result["trials_to_paper"],
                result["errors"],
                flush=True,
            )
    machine = f"{platform.machine()}, {platform.system()}, Python {platform.python_version()}"
    content = {"seeds": seeds, "versions": versions(), "machine": machine, "results": results}
    RESULTS.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def page() -> str:
    content = json.loads(RESULTS.read_text(encoding="utf-8"))
    rows = []
    for task, horizon in CASES:
        mine = [r for r in content["results"] if (r["task"], r["horizon"]) == (task, horizon)]
        angles = [name for name in ("roll", "pitch", "yaw") if name in mine[0]["errors"]]
        angle = [max(abs(r["errors"][name]) for name in angles) for r in mine]
        height = [100 * abs(r["errors"]["height"]) for r in mine]
        met = [r["trials_to_paper"] for r in mine if r["trials_to_paper"] is not None]
        rows.append(
            "| {} | {} | {} | {} | {} of {} | {} | {} | {} |".format(
                task,
                horizon,
                f"{statistics.median(angle):.4f} ({min(angle):.4f} to {max(angle):.4f})",
                f"{statistics.median(height):.1f} ({min(height):.1f} to {max(height):.1f})",
                len(met),
                len(mine),
                f"{statistics.median(met):.0f} ({min(met)} to {max(met)})" if met else "none",
                f"{sum(r['ours'] for r in mine)} of {len(mine)}",
                f"{sum(r['stays'] for r in mine)} of {len(mine)}" if "stays" in mine[0] else "",
            )
        )
    template = (HERE / "paper.md.in").read_text(encoding="utf-8")
    solved, crossed, perturbed = both_engines()
    made = ", ".join(f"{name} {version}" for name, version in content["versions"].items())
    return (
        template.replace("@ROWS@", "\n".join(rows))
        .replace("@SEEDS@", str(content["seeds"]))
        .replace("@MADE@", f"{made}; {content['machine']}")
        .replace("@SOLVED@", solved)
        .replace("@CROSSED@", crossed)
        .replace("@PERTURBED@", perturbed)
    )


def both_engines() -> tuple[str, str, str]:
    """Tables of the tasks in both engines, and of motions of one in the other, from the other benchmarks' results."""
    import robust

    import engines

    results = json.loads(engines.RESULTS.read_text(encoding="utf-8"))["results"]
    rows = []
    for task in engines.TASKS:
        won = {
            e: [r for r in results if (r["task"], r["engine"]) == (task, e) and r["success"]] for e in engines.ENGINES
        }
        there = {e: [r["replays"][other] for r in won[e]] for e, other in (("mujoco", "ode"), ("ode", "mujoco"))}
        for which, judged in (("success", "its own"), ("close", "within 0.1 rad and 5 cm")):
            shares = [f"{sum(one[which] for one in there[e])} of {len(there[e])}" for e in engines.ENGINES]
            rows.append((task, judged, *shares))
    rows += [(task, "its own", *shares) for task, *shares in robust.crossed(robust.kept())]
    crossed = "\n".join(f"| `{task}` | {' | '.join(rest)} |" for task, *rest in rows)
    return engines.solved(results), crossed, robust.found_in_ode(robust.kept())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    if not arguments.write:
        run(arguments.seeds)
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
