"""benchmarks/duration.py measures what `levade check` measures, and benchmarks/freedom.py changes what it says."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest

from levade.checks import Demands
from levade.checks.margins import margins
from levade.motions import RecordedSimulation
from levade.robots import Robot, dimensions
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import HorizonRange, load_task

Script = Callable[[str], ModuleType]


@pytest.mark.slow
def test_shares_are_what_the_margins_of_the_check_leave(script: Script) -> None:
    duration = script("duration")
    objective = make_objective(load_task("rearing", changes=["search.trials=24"]), threads=1)
    motion = record(objective, solve(objective, seed=0), seed=0)
    found = duration.shares(objective.rollout(motion["weights"][None]))[0]
    left = margins(RecordedSimulation(motion), Demands())
    wanted = [left[name.replace("-", "_")].value for name in duration.SHARES]
    np.testing.assert_allclose(1 - found, wanted, atol=1e-12)
    assert found.max() > 0.3


@pytest.mark.parametrize("task", ["rearing", "posture-recovery"])
def test_the_goal_is_that_of_the_paper_with_every_angle_in_range(script: Script, task: str) -> None:
    made, own = script("duration").task_of(task, 0.7), load_task(task)
    assert made.horizon == 0.7
    assert made.start == own.start
    assert made.success["height"].target == own.success["height"].target
    assert made.success["pitch"].target == own.success["pitch"].target
    assert (made.success["pitch"].tolerance, made.success["height"].tolerance) == (0.05, 0.05)
    assert made.success["angles"].minimum == 0.0
    assert {"effort", "load"} <= set(made.costs)


def test_a_longer_duration_may_do_what_a_shorter_one_does_and_stand(script: Script) -> None:
    def row(T: float, effort: float, speed: float) -> dict:
        motion = {"effort": effort, "standing": 0.1, "shares": {"speed": speed, "torque": 1.0, "torque-speed": 0.5}}
        return {"task": "rearing", "T": T, "seed": 0, "effort": motion, "load": motion}

    duration = script("duration")
    line = duration.front([row(0.3, 2.0, 1.4), row(0.5, 1.0, 0.9), row(1.0, 3.0, 1.2)], "rearing")
    assert [T for T, _, _ in line] == [T for T in duration.DURATIONS if T >= 0.3]
    efforts, speeds = {T: effort for T, effort, _ in line}, {T: shares["speed"] for T, _, shares in line}
    assert (efforts[0.3], efforts[0.5]) == (2.0, 1.0)
    assert efforts[1.0] == pytest.approx(1.05)
    assert (speeds[0.4], speeds[0.5], speeds[3.0]) == (1.4, 0.9, 0.9)


@pytest.mark.slow
def test_the_cases_of_a_free_duration_and_posture_are_what_the_page_says(script: Script) -> None:
    freedom = script("freedom")
    for kind, polish in (("free", 0), ("best", 600)):
        task = freedom.task_of(("rearing", "hyq2max", kind, 0))
        assert isinstance(task.horizon, HorizonRange)
        assert (task.horizon.minimum, task.horizon.maximum, task.horizon.initial) == pytest.approx((0.15, 0.9, 0.3))
        assert (task.search.polish, task.search.trials) == (polish, 6000)
    assert freedom.task_of(("rearing", "hyq2max", "fixed", 0)).horizon == 0.3
    assert [freedom.task_of(("rearing", "hyq2max", kind, 0)).horizon for kind in freedom.GRID[::7]] == pytest.approx(
        [0.15, 0.9]
    )
    task = freedom.task_of(("sit-to-stand", "hyq2max", "posture", 0))
    assert task.policy.goal == "free"
    assert task.costs["effort"].term.over == "all"


def test_the_interval_of_a_ratio_of_medians_holds_it_and_grows_with_the_spread(script: Script) -> None:
    interval = script("freedom").interval
    assert interval([60.0] * 10, [90.0] * 10) == (1.5, 1.5)
    narrow = interval([90, 100, 110] * 4, [140, 150, 160] * 4)
    wide = interval([20, 100, 500] * 4, [30, 150, 750] * 4)
    assert wide[0] < narrow[0] < 1.5 < narrow[1] < wide[1]


@pytest.mark.slow
def test_the_rearing_is_as_large_against_go1_as_against_hyq2max(
    script: Script, packaged: Callable[[str], Robot]
) -> None:
    freedom = script("freedom")
    height = {robot: dimensions(packaged(robot)).height for robot in ("hyq2max", freedom.GO1)}
    large, small = (freedom.task_of(("rearing", robot, "fixed", 0)) for robot in height)
    scale = height[freedom.GO1] / height["hyq2max"]
    assert small.horizon == pytest.approx(large.horizon * scale**0.5, rel=0.01)
    for part in ("target", "tolerance"):
        lengths = [getattr(task.success["height"], part) for task in (large, small)]
        assert lengths[1] == pytest.approx(lengths[0] * scale, rel=0.02)
    assert small.success["pitch"] == large.success["pitch"]
