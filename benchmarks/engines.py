"""The paper's two tasks in MuJoCo and in ODE, and every motion found in one replayed in the other; writes docs/engines.md.

    python benchmarks/engines.py [--seeds 10]     # an hour or two on two cores; goes on where it was interrupted
    python benchmarks/engines.py --write          # only the page, from benchmarks/results/engines.json

The built-in tasks as they are, solved by `levade solve` with each engine, over seeds. A replay starts in the state that is in
the motion's file and follows the same references in the other engine: nothing is adapted to it.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import platform
import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results" / "engines.json"
PAGE = HERE.parent / "docs" / "engines.md"
ENGINES = ("mujoco", "ode")
NAMES = {"mujoco": "MuJoCo", "ode": "ODE"}
TASKS = ("rearing", "posture-recovery")
VARIANTS = {  # how much of the difference is numerical: the same engine with other settings
    "MuJoCo, integrator Euler": "mujoco",
    "ODE, exact solver": "ode",
    "ODE, 500 iterations": "ode",
}


def experiment(case: tuple[str, str, int]) -> dict[str, Any]:
    """One seed of a task in an engine: solved, and replayed in every engine."""
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    from levade.engines import Ode
    from levade.motions import replay_in
    from levade.search import make_objective
    from levade.search.run import run
    from levade.tasks import load_task

    name, engine, seed = case
    began = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        objective = make_objective(load_task(name, changes=[f"physics.engine={engine}"]), threads=1)
        outcome = run(objective, seed=seed, directory=Path(folder))
    solution, motion = outcome.solution, outcome.motion
    own = replay_in(engine, motion)
    replays = {}
    for label, kind in {**{name: name for name in ENGINES}, **VARIANTS}.items():
        settings = Ode(solver="exact") if "exact" in label else Ode(iterations=500) if "500" in label else None
        xml = motion.model_xml
        if "Euler" in label:
            xml = xml.replace('integrator="implicitfast"', "")
            assert xml != motion.model_xml  # Euler is what is left: MJCF's own default
        there = replay_in(kind, dataclasses.replace(motion, model_xml=xml), ode=settings)
        apart = there.trajectories.trunk_position[0] - own.trajectories.trunk_position[0]
        replays[label] = {
            "success": there.success,
            "close": close(there.errors),
            "errors": dict(there.errors),
            "apart_at_horizon": float((apart[motion.horizon_steps - 1] ** 2).sum() ** 0.5),
        }
    return {
        "task": name,
        "engine": engine,
        "seed": seed,
        "success": solution.success,
        "trials": solution.trials,
        "trials_to_success": solution.trials_to_success,
        "errors": dict(solution.best.errors),
        "diverged": solution.diverged,
        "cpu_s": round(time.process_time() - began, 1),
        "replays": replays,
    }


def close(errors: dict[str, float]) -> bool:
    """Within 0.1 rad and 5 cm of the goal at the horizon, and of standing at the end of the hold if there is one."""
    return all(abs(error) <= (0.05 if "height" in name else 0.1) for name, error in errors.items())


def rate(engine: str) -> float:
    """Steps per second of CPU time, one process, rearing's first generation."""
    from levade.search import make_objective
    from levade.search.optimizing import make_attempt
    from levade.tasks import load_task

    objective = make_objective(load_task("rearing", changes=[f"physics.engine={engine}"]), threads=1)
    weights = make_attempt(objective.task, objective.space, seed=0).ask()
    objective.rollout(weights)
    rates = []
    for _ in range(7):
        began = time.process_time()
        out = objective.rollout(weights)
        rates.append(out.n * out.steps / (time.process_time() - began))
    return statistics.median(rates)


def collect(seeds: int) -> None:
    from levade.motions import versions

    made = versions("ode")
    content: dict[str, Any] = {"results": []}
    if RESULTS.exists():
        content = json.loads(RESULTS.read_text(encoding="utf-8"))
        if content["versions"] != made:
            content["results"] = []
    machine = (
        f"{platform.machine()}, {platform.system()}, Python {platform.python_version()}, {os.cpu_count()} shared cores"
    )
    content |= {"versions": made, "machine": machine}
    done = {(r["task"], r["engine"], r["seed"]) for r in content["results"]}
    cases = [(t, e, s) for s in range(seeds) for t in TASKS for e in ENGINES if (t, e, s) not in done]
    content["steps_per_second"] = {engine: rate(engine) for engine in ENGINES}
    with ProcessPoolExecutor(2) as pool:
        for future in as_completed([pool.submit(experiment, case) for case in cases]):
            result = future.result()
            content["results"].append(result)
            content["results"].sort(key=lambda r: (r["task"], r["engine"], r["seed"]))
            RESULTS.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
            print(
                *(result[key] for key in ("task", "engine", "seed", "success", "trials_to_success", "cpu_s")),
                flush=True,
            )
    RESULTS.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def solved(results: list[dict[str, Any]]) -> str:
    rows = []
    for task in TASKS:
        for engine in ENGINES:
            mine = [r for r in results if (r["task"], r["engine"]) == (task, engine)]
            won = [r for r in mine if r["success"]]
            trials = [r["trials_to_success"] for r in won]
            angles = [max(abs(v) for k, v in r["errors"].items() if k in ("roll", "pitch", "yaw")) for r in mine]
            heights = [100 * abs(r["errors"]["height"]) for r in mine]
            rows.append(
                f"| `{task}` | {NAMES[engine]} | {len(won)} of {len(mine)} | {spread(trials, '.0f')} |"
                f" {spread(angles, '.4f')} | {spread(heights, '.2f')} | {sum(r['diverged'] for r in mine)} |"
            )
    return "\n".join(rows)


def crossed(results: list[dict[str, Any]]) -> str:
    rows = []
    for task in TASKS:
        for engine in ENGINES:
            won = [r for r in results if (r["task"], r["engine"]) == (task, engine) and r["success"]]
            for other in (*ENGINES, *VARIANTS):
                if other == engine or not won or (other in VARIANTS and VARIANTS[other] != engine):
                    continue
                there = [r["replays"][other] for r in won]
                angle = [max(abs(v) for k, v in t["errors"].items() if k in ("roll", "pitch", "yaw")) for t in there]
                height = [100 * abs(t["errors"]["height"]) for t in there]
                apart = [100 * t["apart_at_horizon"] for t in there]
                rows.append(
                    f"| `{task}` | {NAMES[engine]} | {NAMES.get(other, other)} |"
                    f" {sum(t['success'] for t in there)} of {len(there)} | {sum(t['close'] for t in there)} of {len(there)} |"
                    f" {spread(angle, '.3f')} | {spread(height, '.1f')} | {spread(apart, '.1f')} |"
                )
    return "\n".join(rows)


def spread(values: list[float], form: str) -> str:
    if not values:
        return "none"
    return f"{statistics.median(values):{form}} ({min(values):{form}} to {max(values):{form}})"


def page() -> str:
    content = json.loads(RESULTS.read_text(encoding="utf-8"))
    results, rates = content["results"], content["steps_per_second"]
    seeds = len({r["seed"] for r in results})
    made = ", ".join(f"{name} {version}" for name, version in content["versions"].items())
    replace = {
        "@SOLVED@": solved(results),
        "@CROSSED@": crossed(results),
        "@SEEDS@": str(seeds),
        "@MADE@": f"{made}; {content['machine']}",
        "@ODE_RATE@": f"{rates['ode'] / 1000:.1f}",
        "@RATIO@": f"{rates['mujoco'] / rates['ode']:.1f}",
    }
    text = (HERE / "engines.md.in").read_text(encoding="utf-8")
    for key, value in replace.items():
        text = text.replace(key, value)
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    if not arguments.write:
        collect(arguments.seeds)
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
