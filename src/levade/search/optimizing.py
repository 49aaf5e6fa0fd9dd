"""The optimizer of each attempt of a search."""

from __future__ import annotations

from typing import Any

from levade.errors import located
from levade.optimizers import Optimizer, SearchSpace, make_optimizer, settings
from levade.tasks import Task

_AROUND = 1
"""Keeps the numbers drawn around a motion to start from apart from those of the next attempt."""


def make_attempt(task: Task, space: SearchSpace, *, seed: int, attempt: int = 0, around: bool = False) -> Optimizer:
    """Make the optimizer of an attempt.

    Args:
        task: Names the optimizer and its settings.
        space: Where it begins.
        seed: Seed of the search.
        attempt: Number of the attempt; each draws other numbers.
        around: Whether it begins around a motion to start robust stages from, for which it draws others again.
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
