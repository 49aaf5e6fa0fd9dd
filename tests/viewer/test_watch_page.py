"""The page of a solve, in a real browser, beside a real solve on the command line."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.motions import ARRAYS, Motion
from levade.search.run import run
from levade.tasks import load_task

# small, and never done: a solve that goes on until someone stops it
CHANGES = [
    "search.optimizer=cma",
    "search.population=8",
    "search.trials=200000",
    "horizon=0.1",
    "success.height.tolerance=0",
]


class Solving:
    """``levade solve --watch`` in a process."""

    def __init__(self, directory: Path, *more: str, changes: list[str] = CHANGES) -> None:
        self.directory = directory
        command = [sys.executable, "-m", "levade", "solve", "rearing", "--seed=3", f"--out={directory}", "--watch"]
        self.process = subprocess.Popen(
            [*command, *more, *(f"--set={change}" for change in changes)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
        )
        assert self.process.stdout is not None
        self.first = self.process.stdout.readline()
        found = re.fullmatch(r"Watch it at (http://127\.0\.0\.1:\d+/)\n", self.first)
        assert found, (self.first, self.process.stderr and self.process.stderr.read())
        self.url = found[1]

    def end(self) -> tuple[int, str]:
        out, err = self.process.communicate(timeout=60)
        assert err == ""
        return self.process.returncode, self.first + out


@pytest.fixture
def solving(tmp_path: Path) -> Iterator[Solving]:
    solving = Solving(tmp_path / "out")
    yield solving
    solving.process.kill()
    solving.process.communicate()


def trials(tab: Any) -> int:
    return int(tab.locator("#trials").inner_text())


def wait_for_trials(tab: Any, more_than: int) -> None:
    tab.wait_for_function("least => Number(document.querySelector('#trials')?.textContent) > least", arg=more_than)


def wait_for_word(tab: Any, word: str) -> None:
    tab.wait_for_function("word => document.querySelector('.word strong')?.textContent === word", arg=word)


@pytest.mark.slow
def test_a_solve_is_watched_slid_paused_and_stopped(solving: Solving, tab: Any) -> None:
    tab.goto(solving.url)
    wait_for_word(tab, "Searching")
    wait_for_trials(tab, 16)
    tab.wait_for_selector(".stage canvas")
    seen = trials(tab)
    wait_for_trials(tab, seen)

    tab.locator("#pause").click()  # what is paused leaves the processor to the page, and few trials to simulate again
    wait_for_word(tab, "Paused")
    tab.wait_for_timeout(500)
    seen = trials(tab)
    tab.wait_for_timeout(700)
    assert trials(tab) == seen

    # the best motion moves in a loop
    tab.get_by_role("button", name="Pause").first.wait_for()
    now = tab.locator("output.now").inner_text()
    tab.wait_for_function("before => document.querySelector('output.now').textContent !== before", arg=now)
    tab.locator("button.play").click()

    # a weight, from the next generation on
    slider = tab.get_by_role("slider", name="Weight of position")
    slider.press("End")
    tab.wait_for_selector(".weights li.moved")
    assert trials(tab) == seen
    tab.locator("#pause").click()
    wait_for_trials(tab, seen)
    tab.wait_for_function("() => document.querySelector('.weights li.moved:not(.pending)')")
    assert tab.locator(".weights li.moved").inner_text().split()[:4] == ["position", "10000", "×10", "↺"]

    tab.locator("#stop").click()
    wait_for_word(tab, "Stopped")
    status, out = solving.end()
    assert status == 1
    spent = trials(tab)
    assert f"Interrupted after {spent} trials" in out

    # what is on the page is what was written; the server is gone, and the page is still of use
    motion = Motion.load(solving.directory / "motion.npz")
    assert (motion.meta["stopped"], motion.meta["trials"]) == ("interrupted", spent)
    shown = tab.locator(".status").inner_text()
    assert str(solving.directory / "motion.npz") in shown
    error = f"{motion.meta['errors']['pitch']:+.4f}".replace("-", "\N{MINUS SIGN}")
    assert error in shown
    assert tab.locator("#stop").count() == 0
    assert slider.is_disabled()
    tab.get_by_role("slider", name="Time").press("Home")
    before = tab.locator(".stage canvas").screenshot()
    tab.get_by_role("slider", name="Time").press("End")
    assert tab.locator(".stage canvas").screenshot() != before
    tab.wait_for_timeout(4000)  # long enough for a browser to call again
    assert tab.complaints == []

    # and what the slider did is in the task, which gives the motion again
    task = load_task(solving.directory / "task.yaml")
    (change,) = task.search.changes
    assert change.factors == {"position": 10.0}

    def stop(generation: Any) -> None:
        if generation.trials == spent:
            raise KeyboardInterrupt

    again = run(task, seed=3, directory=solving.directory.parent / "again", observe=stop).motion
    for name in ARRAYS:
        np.testing.assert_array_equal(again[name], motion[name], err_msg=name)


@pytest.mark.slow
def test_closing_the_page_does_not_stop_the_solve(tmp_path: Path, tab: Any) -> None:
    solving = Solving(tmp_path / "out", changes=[*CHANGES, "search.trials=800"])
    tab.goto(solving.url)
    wait_for_trials(tab, 0)
    tab.close()
    status, out = solving.end()
    assert status == 1
    assert "No success within 800 trials" in out


@pytest.mark.slow
def test_the_page_of_a_solve_that_has_ended_stays_if_asked(tmp_path: Path, tab: Any) -> None:
    solving = Solving(tmp_path / "out", "--keep-open", changes=[*CHANGES, "search.trials=16"])
    assert solving.process.stdout is not None
    while "until Ctrl-C" not in (line := solving.process.stdout.readline()):
        assert line, "it ended"
    tab.goto(solving.url)
    wait_for_word(tab, "No success")
    assert trials(tab) == 16
    tab.locator(".stage canvas").wait_for()
    solving.process.send_signal(signal.SIGINT)
    assert solving.end()[0] == 1
    assert tab.complaints == []


@pytest.mark.slow
def test_nothing_overflows(solving: Solving, tab: Any) -> None:
    def fits(width: int) -> bool:
        tab.set_viewport_size({"width": width, "height": 800})
        return tab.evaluate("() => document.documentElement.scrollWidth") <= width

    for width in (1280, 390):
        tab.set_viewport_size({"width": width, "height": 800})
        tab.goto(solving.url)
        wait_for_trials(tab, 8)
        tab.locator(".stage canvas").wait_for()
        assert fits(width), width
    solving.process.send_signal(signal.SIGINT)
    wait_for_word(tab, "Stopped")
    for width in (390, 1280):
        assert fits(width), width
    solving.end()
