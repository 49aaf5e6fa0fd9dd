"""Steps per second of the whole objective, as a ratio to the bare engine, and of two threads to one.

    python benchmarks/throughput.py [--task rearing] [--repeats 9]

The bare engine is a `mujoco.batch` roll-out of the same model, start and controls, with nothing read back but what any cost
would need (qpos, qvel, actuator_force). The objective is policy, engine and costs as `levade solve` calls them. Runs of both
are interleaved and the medians compared, because the machine is shared: read the ratios, not the rates.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import mujoco
import numpy as np
from mujoco.batch import Batch

from levade.search import Trials, make_objective
from levade.search.optimizing import make_attempt
from levade.tasks import load_task


def timed(call: Callable[[], object]) -> float:
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--task", default="rearing")
    parser.add_argument("--repeats", type=int, default=9)
    arguments = parser.parse_args()

    task = load_task(arguments.task)
    objectives = {threads: make_objective(task, threads=threads) for threads in (1, 2)}
    one = objectives[1]
    optimizer = make_attempt(one.task, one.space, seed=0)
    weights = optimizer.ask()
    n, steps = len(weights), task.horizon_steps
    generations = max(1, round(4e4 / (n * steps)))  # about a second for each timing

    state = mujoco.MjData(one.engine.model)
    state.qpos[:], state.qvel[:], state.act[:] = one.state.qpos[0], one.state.qvel[0], one.state.act[0]
    whole = mujoco.mjtState.mjSTATE_INTEGRATION
    row = np.empty(mujoco.mj_stateSize(one.engine.model, whole))
    mujoco.mj_getState(one.engine.model, state, row, whole)
    ctrl = one.engine.ctrl(one.policy.reference(weights, hold_steps=0)).copy()
    batches = {threads: Batch(one.engine.model, n, threads) for threads in (1, 2)}
    for batch in batches.values():  # the sensors of the model are for reports; a search does without, so does this
        batch.model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_SENSOR)

    def bare(threads: int) -> None:
        for _ in range(generations):
            batches[threads].state[:] = row
            batches[threads].rollout(steps, ctrl, record=("qpos", "qvel", "actuator_force"))

    def objective(threads: int) -> None:
        for _ in range(generations):
            evaluation = objectives[threads].evaluate(Trials(weights, hold_steps=0))
            evaluation.cost({name: cost.weight for name, cost in task.costs.items()})

    times: dict[tuple[str, int], list[float]] = {(kind, t): [] for kind in ("bare", "objective") for t in (1, 2)}
    for _ in range(arguments.repeats):
        for threads in (1, 2):
            times["bare", threads].append(timed(lambda t=threads: bare(t)))
            times["objective", threads].append(timed(lambda t=threads: objective(t)))

    rate = {key: generations * n * steps / statistics.median(values) for key, values in times.items()}
    print(f"{arguments.task}: {n} trials of {steps} steps, {arguments.repeats} interleaved runs, medians")
    for threads in (1, 2):
        share = statistics.median(
            b / o for b, o in zip(times["bare", threads], times["objective", threads], strict=True)
        )
        print(
            f"{threads} thread{'s' if threads > 1 else ' '}: bare engine {rate['bare', threads]:8.0f} steps/s,"
            f" objective {rate['objective', threads]:8.0f} steps/s, ratio {share:.3f}"
        )
    print(f"2 threads to 1, objective: {rate['objective', 2] / rate['objective', 1]:.2f}")


if __name__ == "__main__":
    main()
