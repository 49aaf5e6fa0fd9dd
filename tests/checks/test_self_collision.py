"""A motion that keeps its parts apart passes the check that the same task's plain motion fails."""

from __future__ import annotations

import pytest

from levade.checks import Demands, Margin, margins
from levade.motions import RecordedSimulation
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

APART = [
    "costs.apart={term: margins, weight: 0.02, self_distance: 1 cm}",
    "success.apart={quantity: self_distance, minimum: 0, at: min}",
]


def touching(changes: list[str]) -> Margin:
    objective = make_objective(load_task("rearing", changes=[*changes, "search.polish=0"]), threads=1)
    solution = solve(objective, seed=101)
    assert solution.best.success
    motion = record(objective, solution, seed=101)
    return margins(RecordedSimulation(motion, threads=1), Demands())["self_collision"]


@pytest.mark.slow
def test_a_rearing_whose_legs_stay_apart_passes() -> None:
    plain, apart = touching([]), touching(APART)
    assert plain.passed is False
    assert plain.value is not None
    assert plain.value > 0.005
    assert apart.passed is True
    assert not apart.values
