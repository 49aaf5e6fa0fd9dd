"""A motion of six trials, and how to change what its file says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


@pytest.fixture(scope="session")
def moving() -> Motion:
    changes = ["search.population=6", "search.trials=6", "search.step=0.2", "hold=0.05"]
    objective = make_objective(load_task("rearing", changes=changes), threads=1)
    return record(objective, solve(objective, seed=3), seed=3)


@pytest.fixture(scope="session")
def changed() -> Callable[..., Motion]:
    """The motion with some of its arrays, or keys of its meta, replaced; a key that is None is left out."""

    def change(motion: Motion, meta: dict | None = None, **arrays: np.ndarray) -> Motion:
        content = {key: value for key, value in {**motion.meta, **(meta or {})}.items() if value is not None}
        return replace(motion, meta=content, arrays={**motion.arrays, **arrays})

    return change
