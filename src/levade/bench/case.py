"""Run one case of a bench."""

from __future__ import annotations

import functools
import time

from levade.bench.plan import Case
from levade.bench.results import Result
from levade.errors import LevadeError
from levade.motions import versions
from levade.search import Generation, Objective, Stopped, make_objective, solve
from levade.tasks import Task


def run_case(case: Case) -> Result:
    """Solve one case on one thread.

    Args:
        case: The case.

    Returns:
        Its result.

    Raises:
        LevadeError: If parts of the task do not fit together.
    """
    objective = _objective(case)
    engine = objective.engine
    at_success: tuple[int, float, float] | None = None
    exhausted = False

    def watch(generation: Generation) -> Stopped | None:
        nonlocal at_success, exhausted
        if at_success is None and generation.trials_to_success is not None:
            at_success = engine.steps - before, time.process_time() - began, generation.best.cost
        if case.budget_steps is not None and engine.steps - before >= case.budget_steps:
            exhausted = True
            return Stopped.INTERRUPTED
        return None

    before, began = engine.steps, time.process_time()
    solution = solve(objective, seed=case.seed, observe=watch)
    spent, core_seconds = engine.steps - before, time.process_time() - began
    steps_to_success, core_seconds_to_success, cost_to_success = at_success or (None, None, None)
    return Result(
        task=case.task.name,
        robot=case.robot,
        optimizer=case.optimizer,
        seed=case.seed,
        until=case.until,
        budget_trials=case.task.search.trials,
        budget_steps=case.budget_steps,
        success=solution.trials_to_success is not None,
        trials=solution.trials,
        trials_to_success=solution.trials_to_success,
        steps=spent,
        steps_to_success=steps_to_success,
        core_seconds=round(core_seconds, 4),
        core_seconds_to_success=None if core_seconds_to_success is None else round(core_seconds_to_success, 4),
        cost=solution.best.cost,
        cost_to_success=cost_to_success,
        diverged=solution.diverged,
        stopped="steps" if exhausted else str(solution.stopped),
        checksum=case.checksum,
        versions=made_with(),
    )


@functools.cache
def made_with() -> str:
    """Return the versions that decide the results, in words."""
    return ", ".join(f"{name} {version}" for name, version in versions().items())


_latest: tuple[Task, Objective] | None = None


def _objective(case: Case) -> Objective:
    """Return the objective of a case. The latest one is used again if only the seed has changed."""
    global _latest
    if case.task.hardware is not None:
        raise LevadeError(
            f"hardware: the task {case.task.name} asks for a certificate, which a bench of searches does not look for"
        )
    if _latest is None or _latest[0] != case.task:
        _latest = case.task, make_objective(case.task, threads=1)
    return _latest[1]
