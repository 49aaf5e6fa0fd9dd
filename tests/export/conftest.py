"""Two motions to export: one that meets its goal, and one with a hold that need not."""

from __future__ import annotations

from pathlib import Path

import mujoco
import pytest

from levade.motions import Motion
from levade.search import Objective, make_objective, solve
from levade.search.recording import record
from levade.tasks import load_task


@pytest.fixture(scope="session")
def objective() -> Objective:
    # motions of independent weights: the player's limit on tracking errors is set for these
    changes = ["search.optimizer=cma", "search.population=null", "search.modes=null", "search.smoothness=0.15"]
    return make_objective(load_task("rearing", changes=changes))


@pytest.fixture(scope="session")
def rearing(objective: Objective) -> Motion:
    """A motion of 0.3 s that rears, 150 steps of 2 ms, joints driven with a lag."""
    return record(objective, solve(objective, seed=0), seed=0)


@pytest.fixture(scope="session")
def rearing_model(rearing: Motion) -> mujoco.MjModel:
    return rearing.compiled()


@pytest.fixture(scope="session")
def held() -> Motion:
    """16 trials of the recovery with 0.1 s of hold, every leg on its own, joints driven without a lag."""
    changes = ["search.population=8", "search.trials=16", "hold=0.1", "robot.actuation=ideal"]
    small = make_objective(load_task("posture-recovery", changes=changes))
    return record(small, solve(small, seed=0), seed=0)


@pytest.fixture(scope="session")
def motion_file(rearing: Motion, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rearing") / "motion.npz"
    rearing.save(path)
    return path
