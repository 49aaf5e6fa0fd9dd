"""What driving many searches in lockstep is worth: the same searches one after another, and in common batches.

    python benchmarks/lockstep.py [--searches 16] [--task self-righting] [--robot NAME] [--trials 60] [--repeat 3]

Each search begins from a start of its own: the joints of the task's start are turned by up to 0.05 rad, and the robot settles
from there for 0.2 s. Both ways give the same motions to the bit, which is checked. Prints seconds of both, alternating, and
their ratio.
"""

from __future__ import annotations

import argparse
import statistics
import time

import mujoco
import numpy as np

from levade.engines import State
from levade.search import Objective, Simulation, solve, solve_many
from levade.tasks import load_task


def starts(simulation: Simulation, n: int, *, spread: float = 0.05, settle: float = 0.2) -> list[State]:
    """Starts near a simulation's own."""
    engine, start = simulation.engine, simulation.start
    random, found = np.random.default_rng(0), []
    for _ in range(n):
        data = mujoco.MjData(engine.model)
        data.qpos[:] = start.qpos[0]
        data.qpos[engine.layout.joint_qpos] += random.uniform(-spread, spread, engine.embodiment.joints)
        mujoco.mj_forward(engine.model, data)
        found.append(engine.hold(engine.model, data, start.joint_reference[0], settle))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--searches", type=int, default=16)
    parser.add_argument("--task", default="self-righting")
    parser.add_argument("--robot")
    parser.add_argument("--trials", type=int, default=60)
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    changes = [f"search.trials={given.trials}", "search.polish=null"]
    task = load_task(given.task, robot=given.robot, changes=changes)
    simulation = Simulation.of(task)
    objectives = [Objective(simulation.starting(one), task) for one in starts(simulation, given.searches)]
    seeds = list(range(given.searches))
    ratios = []
    for _ in range(given.repeat):
        began = time.perf_counter()
        alone = [solve(one, seed=seed) for one, seed in zip(objectives, seeds, strict=True)]
        middle = time.perf_counter()
        together = solve_many(objectives, seeds=seeds)
        ended = time.perf_counter()
        for one, other in zip(alone, together, strict=True):
            assert np.array_equal(one.best.weights, other.best.weights)
            assert (one.trials, one.best.cost) == (other.trials, other.best.cost)
        ratios.append((middle - began) / (ended - middle))
        trials = sum(one.trials for one in alone)
        print(
            f"{given.searches} searches of {given.task} on {simulation.robot.name}, {trials} trials:"
            f" one by one {middle - began:.2f} s, in lockstep {ended - middle:.2f} s, ratio {ratios[-1]:.2f}"
        )
    print(f"median ratio {statistics.median(ratios):.2f}; the same bits")


if __name__ == "__main__":
    main()
