"""Make the optimizer of each attempt of a search."""

from __future__ import annotations

from typing import Any

from levade.errors import located
from levade.optimizers import Optimizer, SearchSpace, make_optimizer, settings
from levade.tasks import Task

_AROUND = 1
"""Separates the numbers drawn around a motion to start from, from those of the next attempt."""


def make_attempt(task: Task, space: SearchSpace, *, seed: int, attempt: int = 0, around: bool = False) -> Optimizer:
    """Make the optimizer of an attempt.

    Args:
        task: The task, which names the optimizer and its settings.
        space: Where the optimizer begins.
        seed: Seed of the search.
        attempt: Number of the attempt. Each attempt draws other random numbers.
        around: Whether the attempt begins the robust stages around a motion. It then draws yet other random numbers.

    Raises:
        LevadeError: If the optimizer does not take the settings.
    """
    search = task.search
    own: dict[str, Any] = dict(search.settings)
    if isinstance(search.optimizer, str) and "step_adaptation" in settings(search.optimizer):
        own = {"step_adaptation": search.step_adaptation, **own}
    with located("search.settings." if isinstance(search.optimizer, str) else "search."):
        return make_optimizer(
            search.optimizer,
            space,
            seed=seed if not attempt else (seed, attempt, _AROUND) if around else (seed, attempt),
            settings=own,
            again=attempt > 0,
        )
