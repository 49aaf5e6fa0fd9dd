"""Progress says how much time is left, from how fast the work went and from the time that the command may take."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from levade.cli import pace
from levade.cli.pace import Deadline, Pace, duration


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The time [s], which stands still until a test changes it."""
    now = [100.0]
    monkeypatch.setattr(pace.time, "perf_counter", lambda: now[0])
    return now


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.0, "0 s"),
        (0.1, "1 s"),
        (59.5, "1 min 00 s"),
        (61.0, "1 min 01 s"),
        (3600.0, "1 h 00 min"),
        (7259.0, "2 h 01 min"),
    ],
)
def test_a_duration_is_rounded_up(seconds: float, text: str) -> None:
    assert duration(seconds) == text


def test_what_is_left_follows_from_the_recent_pace(clock: list[float]) -> None:
    work = Pace()
    assert work.left(10) is None
    work.add(7)  # of an earlier run
    assert work.left(10) is None
    for count in range(8, 100):
        clock[0] += 3.0 if count < 50 else 0.5
        work.add(count)
    assert (work.rate, work.left(100), work.left(0), work.left(-3)) == (2.0, "50 s", "0 s", "0 s")


def test_a_deadline_comes_nearer_and_stays_at_zero(clock: list[float]) -> None:
    end = Deadline(2.0)
    assert end.left == "2 min 00 s left in all"
    clock[0] += 90
    assert end.left == "30 s left in all"
    clock[0] += 90
    assert end.left == "0 s left in all"
    assert Deadline(None).left == ""


@pytest.mark.slow
def test_a_library_says_how_long_it_takes(levade, tmp_path: Path) -> None:
    small = ["hold=0.1", "horizon=0.3", "search.polish=0", "search.population=4", "search.trials=4"]
    changes = [word for change in small for word in ("--set", change)]
    fallen = ["--set", "start={fallen: {height: 0.5, time: 0.4}}"]
    _, out, _ = levade("library", "build", "self-righting", "--starts", 3, "--threads", 1, *changes, *fallen)
    lines = [line for line in out.splitlines() if " falls: " in line]
    assert [bool(re.search(r" s, about \d+ s left", line)) for line in lines] == [False, True, False]


@pytest.mark.slow
def test_a_pursuit_says_how_much_of_its_minutes_is_left(levade, monkeypatch: pytest.MonkeyPatch) -> None:
    from levade.cli import display

    monkeypatch.setattr(display, "_PLAIN_EVERY", 0.0)
    words = ["--hardware", "--minutes", 0.1, "--threads", 1, "--set", "search.population=8"]
    _, out, _ = levade("solve", "rearing", *words)
    lines = [line for line in out.splitlines() if line.startswith("trial ")]
    assert lines
    assert all(re.search(r"; [0-6] s left in all$", line) for line in lines)
    assert any(re.search(r"; at most .* s left; \d s left in all$", line) for line in lines)
