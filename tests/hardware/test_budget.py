"""The time of a pursuit includes the certificate of its last motion."""

from __future__ import annotations

import numpy as np
import pytest

from levade.hardware.budget import Budget
from levade.search import Generation, Trial


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr("levade.hardware.budget.time.monotonic", clock)
    return clock


def generation(share: float | None, trials: int = 100) -> Generation:
    best = Trial(np.zeros(1), 0.0, {}, {}, success=False, share=share)
    return Generation(1, 0, "", trials, np.zeros(1), 0.1, 0, best, None, {}, ())


@pytest.mark.parametrize(
    ("share", "seconds", "end"),
    [
        (0.95, 8.0, 78.4),  # 160 runs and the rest took as long as 200 runs: 40 ms for each of 540
        (0.5, 8.0, 94.4),  # of which 140 are made where few robots succeed
        (None, 8.0, 94.4),
        (0.95, 100.0, 75.0),  # most of the time is for searches
    ],
)
def test_a_search_ends_so_early_that_its_certificate_fits(
    share: float | None, seconds: float, end: float, clock: Clock
) -> None:
    budget = Budget(100.0, None, 500)
    budget.certified(seconds, 160)
    over = []
    for clock.now in (end - 0.5, end + 0.5):
        over.append(budget.over(generation(share)))
    assert over == [False, True]


def test_before_the_first_certificate_roll_outs_of_the_search_tell(clock: Clock) -> None:
    """100 roll-outs in 2 s: 140 longer ones take 5.6 s."""
    budget = Budget(100.0, None, 500)
    clock.now = 92.0
    budget.begin()
    clock.now = 94.0
    assert not budget.over(generation(None))
    clock.now = 95.0
    assert budget.over(generation(None, trials=150))


def test_roll_outs_of_finished_searches_count(clock: Clock) -> None:
    budget = Budget(None, 1000, 500)
    budget.made(400)
    assert not budget.spent(0.5, 99)
    assert budget.spent(0.5, 100)
    assert budget.late(1.0, 600)
    clock.now = 1e9  # without a limit of time
    assert not budget.late(0.5, 99)
    assert not budget.over(generation(None))
