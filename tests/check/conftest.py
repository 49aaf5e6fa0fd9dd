"""A robot that stands: what is perturbed in it has effects that one can work out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task

STANDING = [
    "success={height: {target: 0.5743, tolerance: 1 cm}, pitch: {target: 0, tolerance: 0.05}}",
    "search.population=4",
    "search.trials=4",
    "search.step=1e-9",
]


@pytest.fixture(scope="session")
def standing() -> Motion:
    objective = make_objective(load_task("rearing", changes=STANDING), threads=1)
    motion = record(objective, solve(objective, seed=0), seed=0)
    assert motion.meta["success"], motion.meta["errors"]
    return motion


@pytest.fixture(scope="session")
def changed() -> Callable[..., Motion]:
    """The motion with some of its arrays, or keys of its meta, replaced."""

    def change(motion: Motion, meta: dict | None = None, **arrays: np.ndarray) -> Motion:
        return replace(motion, meta={**motion.meta, **(meta or {})}, arrays={**motion.arrays, **arrays})

    return change
