"""What the tests of a search share: solves that are recorded, judges that are answered, and runs that are compared."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from levade.motions import ARRAYS, Motion
from levade.search import Evaluation, Generation, Objective, Record, Solution, solve
from levade.search.checkpoint import CHECKPOINT
from levade.search.progress import PROGRESS
from levade.search.robust import Judging
from levade.search.run import MOTION, TASK

Recorded = tuple[Solution, list[Generation], list[list[Record]]]


@pytest.fixture(scope="session")
def recorded() -> Callable[..., Recorded]:
    """A solve, its generations, and the records that it has kept by the end of each, once through JSON."""

    def recorded(objective: Objective, **options: object) -> Recorded:
        generations: list[Generation] = []
        records: list[Record] = []
        kept: list[list[Record]] = []

        def observe(generation: Generation) -> None:
            generations.append(generation)
            kept.append(list(records))

        def keep(record: Record) -> None:
            records.append(Record.from_json(json.loads(json.dumps(record.to_json(), allow_nan=False))))

        solution = solve(objective, observe=observe, keep=keep, **options)  # type: ignore[arg-type]
        return solution, generations, kept

    return recorded


@pytest.fixture(scope="session")
def cost_weights() -> Callable[[Objective], dict[str, float]]:
    """Cost -> weight, as the task has it."""
    return lambda objective: {name: cost.weight for name, cost in objective.task.costs.items()}


@pytest.fixture(scope="session")
def answered() -> Callable[[Judging, Objective], Evaluation]:
    """What a judge comes to, its questions answered by simulation."""

    def answered(judging: Judging, objective: Objective) -> Evaluation:
        try:
            trials = next(judging)
            while True:
                trials = judging.send(objective.evaluate(trials))
        except StopIteration as end:
            return end.value

    return answered


@pytest.fixture(scope="session")
def assert_same_files() -> Callable[[Path, Path], None]:
    """Fails unless two runs left the same, to the bit."""

    def assert_same_files(one: Path, other: Path) -> None:
        first, second = Motion.load(one / MOTION), Motion.load(other / MOTION)
        for name in ARRAYS:
            assert first[name].tobytes() == second[name].tobytes(), name
        assert first.meta == second.meta
        for name in (TASK, PROGRESS, CHECKPOINT):
            assert (one / name).read_bytes() == (other / name).read_bytes(), name

    return assert_same_files
