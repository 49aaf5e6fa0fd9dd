"""The plan of a build on many nodes."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

import pytest

Script = Callable[[str], ModuleType]


def test_a_round_takes_its_falls_or_its_longest_fall(script: Script) -> None:
    makespan = script("library_scaling").makespan
    times = [3.0, 1.0, 2.0, 2.0]
    assert makespan(times, 1) == sum(times)
    assert makespan(times, 4) == max(times)
    assert makespan(times, 2) == 5.0  # 3 + 2 next to 1 + 2


def test_equal_falls_take_as_many_turns_as_rounds_need(script: Script) -> None:
    """Nothing is sent and nothing else takes time: falls of a second each."""
    module = script("library_scaling")
    sent = {"once": 0, "news": 0, "delivery": 0}
    found = {"fall_cpu": [1.0] * 12, "sent": sent, "begin_cpu": 0.0, "motions_per_fall": 0.0, "rollout_cpu": 0.0}
    for nodes, turns in ((1, 300), (16, 6 + 16 + 1), (100, 6 + 8 + 1)):
        assert module.plan(found, 300, nodes, "32")["seconds"] == pytest.approx(turns), nodes
    assert module.plan(found, 300, 100, "eighth")["seconds"] == pytest.approx(15)
    assert module.plan(found, 300, 100, "none")["seconds"] == pytest.approx(3)
