"""Results to make tables and figures of."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from levade.bench import Result

Make = Callable[..., Result]


@pytest.fixture
def make() -> Make:
    """A result: of a run that succeeded after so many trials of 150 steps, or not at all within 1000."""

    def result(trials_to_success: int | None = 200, *, seed: int = 0, optimizer: str = "cma", **changes: Any) -> Result:
        won = trials_to_success is not None
        content: dict[str, Any] = {
            "task": "rearing",
            "robot": "hyq2max",
            "optimizer": optimizer,
            "seed": seed,
            "until": "success",
            "budget_trials": 1000,
            "budget_steps": None,
            "success": won,
            "trials": trials_to_success + 50 if won else 1000,
            "trials_to_success": trials_to_success,
            "steps": 150 * (trials_to_success + 50 if won else 1000),
            "steps_to_success": 150 * trials_to_success if won else None,
            "core_seconds": 3.5,
            "core_seconds_to_success": 1.5 if won else None,
            "cost": 0.1 + 0.01 * seed + (0 if won else 5.0),
            "cost_to_success": 0.3 if won else None,
            "diverged": 0,
            "stopped": "success" if won else "budget",
            "checksum": 7,
            "versions": "levade 0, mujoco 4",
        }
        return Result(**content | changes)

    return result
