"""A motion that rears, and with a stabiliser: found once."""

from __future__ import annotations

import pytest

from levade.engines import Perturbation
from levade.motions import Motion
from levade.search import make_objective, solve
from levade.search.recording import record
from levade.stabilisers import Stabilised, stabilise
from levade.tasks import load_task

RELAXED = ["success.pitch.tolerance=0.04", "success.height.tolerance=0.05", "search.settings={finish: 0}"]
PUSHED = Perturbation(start_rate=(-0.6, 0.6), start_velocity=(-0.2, 0.2))
"""Three to ten times as much as a check's."""


@pytest.fixture(scope="session")
def rearing() -> Motion:
    objective = make_objective(load_task("rearing", changes=RELAXED), threads=1)
    motion = record(objective, solve(objective, seed=2), seed=2)
    assert motion.meta["success"], motion.meta["errors"]
    return motion


@pytest.fixture(scope="session")
def found(rearing: Motion) -> Stabilised:
    return stabilise(rearing, runs=32, seed=0, perturbation=PUSHED, threads=1)
