"""What cheaper physics would save a search, and how far off it would be: docs/fidelity.md.

    python benchmarks/fidelity.py [--motions 20] [--seeds 3] [--repeats 5]
    python benchmarks/fidelity.py --write            # only write the page, from results/fidelity.json

For each task the same references are simulated with each setting, from the same start, up to the horizon: those of random
candidates, as the task's search draws them first, and of motions that it found. The trunk's pose at the horizon is
compared with that of a fine reference: the task's own physics in steps of 0.25 ms, solved to 1e-12. CPU times are of one
thread, all settings interleaved, medians of ratios to the default.
"""

from __future__ import annotations

import argparse
import copy
import dataclasses
import json
import os
import platform
import statistics
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from levade.costs import errors
from levade.costs.orientation import geodesic
from levade.engines.batches import RESET_OFF, SENSORS_OFF, STATE, simulate
from levade.motions import versions
from levade.search import Objective, make_objective, solve
from levade.search.optimizing import make_attempt
from levade.tasks import load_task, looks_at_hold
from levade.trajectory import Trajectories

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "fidelity.json"
PAGE = HERE.parent / "docs" / "fidelity.md"
TASKS = ("rearing", "posture-recovery", "squat-jump")

DEFAULT = "default: 2 ms, elliptic, impratio 10, implicitfast, Newton to 1e-8"
CHEAP = "4 ms, pyramidal cone, impratio 1"
SETTINGS: dict[str, dict[str, Any]] = {
    DEFAULT: {},
    "1 ms": {"timestep": 0.001},
    "4 ms": {"timestep": 0.004},
    "pyramidal cone": {"cone": mujoco.mjtCone.mjCONE_PYRAMIDAL},
    "pyramidal cone, impratio 1": {"cone": mujoco.mjtCone.mjCONE_PYRAMIDAL, "impratio": 1.0},
    "impratio 1": {"impratio": 1.0},
    "impratio 100": {"impratio": 100.0},
    "at most 20 iterations": {"iterations": 20},
    "at most 8 iterations": {"iterations": 8},
    "at most 3 iterations": {"iterations": 3},
    "tolerance 1e-4": {"tolerance": 1e-4},
    "conjugate gradients": {"solver": mujoco.mjtSolver.mjSOL_CG},
    "Euler": {"integrator": mujoco.mjtIntegrator.mjINT_EULER},
    "contacts of the feet alone": {"feet": True},
    CHEAP: {"timestep": 0.004, "cone": mujoco.mjtCone.mjCONE_PYRAMIDAL, "impratio": 1.0},
}
FINE = {"timestep": 0.00025, "tolerance": 1e-12, "iterations": 200}


class Physics:
    """One setting for one task: simulate references up to the horizon."""

    def __init__(self, objective: Objective, setting: Mapping[str, Any], n: int) -> None:
        self.objective, options = objective, dict(setting)
        engine, robot = objective.engine, objective.robot
        model = copy.deepcopy(engine.model)
        if options.pop("feet", False):
            feet = {model.geom(name).id for name in robot.feet}
            others = [g for g in range(model.ngeom) if model.geom_bodyid[g] != 0 and g not in feet]
            model.geom_contype[others] = model.geom_conaffinity[others] = 0
        for name, value in options.items():
            setattr(model.opt, name, value)
        model.opt.disableflags |= RESET_OFF | SENSORS_OFF
        self.policy = dataclasses.replace(objective.policy, timestep=float(model.opt.timestep), hold_steps=0)
        self.batch = Batch(model, n, 1)
        data, state = mujoco.MjData(model), objective.state
        data.qpos[:], data.qvel[:], data.act[:] = state.qpos[0], state.qvel[0], state.act[0]
        self.row = np.empty(mujoco.mj_stateSize(model, STATE))
        mujoco.mj_getState(model, data, self.row, STATE)

    def rollout(self, weights: np.ndarray) -> Trajectories:
        reference, layout = self.policy.reference(weights), self.objective.engine.layout
        ctrl = np.zeros((*reference.position.shape[:2], self.batch.model.nu))
        ctrl[..., layout.ctrl_position], ctrl[..., layout.ctrl_velocity] = reference.position, reference.velocity
        began = time.process_time()
        out, diverged = simulate(self.batch, self.row, ctrl, ("qpos", "qvel", "actuator_force"))
        self.seconds = time.process_time() - began
        return layout.trajectories(out, reference, diverged=diverged)


def apart(one: Trajectories, other: Trajectories) -> tuple[np.ndarray, np.ndarray]:
    """How far the trunks' centres of mass (n,) [m] and attitudes (n,) [rad] are apart in the last row."""
    last = slice(-1, None)
    distance = np.linalg.norm(one.trunk_com_position(last) - other.trunk_com_position(last), axis=-1)[:, 0]
    return distance, geodesic(one.trunk_quaternion[:, -1], other.trunk_quaternion[:, -1])


def collect(motions: int, seeds: int, repeats: int) -> None:
    content: dict[str, Any] = {
        "versions": versions(),
        "machine": f"{platform.machine()}, {platform.system()}, Python {platform.python_version()}",
        "tasks": {},
    }
    for name in TASKS:
        task = load_task(name, changes=["search.polish=0"])
        objective = make_objective(task, threads=1)
        drawn, seed = [], 0
        while sum(map(len, drawn)) < motions:
            drawn.append(make_attempt(objective.task, objective.space, seed=seed).ask())
            seed += 1
        found = []
        for seed in range(seeds):
            solution = solve(objective, seed=seed)
            print(name, "seed", seed, solution.success, solution.trials_to_success, flush=True)
            if solution.success:
                found.append(solution.best.weights)
        weights = np.concatenate([*drawn, np.array(found).reshape(-1, objective.policy.size)])
        weights = np.delete(weights, np.s_[motions : sum(map(len, drawn))], axis=0)
        fine = Physics(objective, FINE, len(weights)).rollout(weights)
        physics = {setting: Physics(objective, options, len(weights)) for setting, options in SETTINGS.items()}
        seconds: dict[str, list[float]] = {setting: [] for setting in SETTINGS}
        done: dict[str, Trajectories] = {}
        for _ in range(repeats):
            for setting, one in physics.items():
                done[setting] = one.rollout(weights)
                seconds[setting].append(one.seconds)
        criteria = {key: criterion for key, criterion in task.success.items() if not looks_at_hold(criterion)}
        table = {}
        for setting, trajectories in done.items():
            distance, angle = apart(trajectories, fine)
            off = errors(criteria, trajectories)
            met = np.all([criteria[key].met(off[key]) for key in criteria], axis=0) & ~trajectories.diverged
            pairs = zip(seconds[DEFAULT], seconds[setting], strict=True)
            table[setting] = {
                "speed": statistics.median(default / this for default, this in pairs),
                "random": {"distance": distance[:motions].tolist(), "angle": angle[:motions].tolist()},
                "found": {"distance": distance[motions:].tolist(), "angle": angle[motions:].tolist()},
                "met": met[motions:].tolist(),
                "diverged": int(trajectories.diverged.sum()),
            }
        content["tasks"][name] = {"motions": motions, "found": len(found), "settings": table}
        RESULTS.write_text(json.dumps(_rounded(content), indent=None) + "\n", encoding="utf-8")


def _rounded(value: Any) -> Any:
    """Four digits."""
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value


def page() -> str:
    content = json.loads(RESULTS.read_text(encoding="utf-8"))
    parts = []
    for name, task in content["tasks"].items():
        parts.append(
            f"## {name}\n\n{task['motions']} random candidates, {task['found']} found motions.\n\n"
            "| physics | speed | random: median apart | found: median apart | found: criteria met |\n|---|---|---|---|---|"
        )
        for setting, row in task["settings"].items():
            met = f"{sum(row['met'])} of {len(row['met'])}"
            cells = f"{row['speed']:.2f} | {spread(row['random'])} | {spread(row['found'])} | {met}"
            parts[-1] += f"\n| {setting} | {cells} |"
    text = (HERE / "fidelity.md.in").read_text(encoding="utf-8")
    fast = [task["settings"][CHEAP]["speed"] for task in content["tasks"].values()]
    text = text.replace("@CHEAP@", CHEAP).replace("@FAST@", f"{min(fast):.1f} to {max(fast):.1f}")
    made = ", ".join(f"{name} {version}" for name, version in content["versions"].items())
    return text.replace("@TABLES@", "\n\n".join(parts)).replace("@MADE@", f"{made}; {content['machine']}")


def spread(values: Mapping[str, list[float]]) -> str:
    if not values["distance"]:
        return ""
    return f"{100 * statistics.median(values['distance']):.2f} cm, {statistics.median(values['angle']):.4f} rad"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motions", type=int, default=20, help="random candidates of each task")
    parser.add_argument("--seeds", type=int, default=3, help="searches for motions to compare")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--write", action="store_true", help="only write the page")
    arguments = parser.parse_args()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if not arguments.write:
        collect(arguments.motions, arguments.seeds, arguments.repeats)
    PAGE.write_text(page(), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
