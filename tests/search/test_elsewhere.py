"""Perturbed models that also start from other states: which one starts where."""

from __future__ import annotations

import numpy as np
import pytest
from tests.search.test_robust import SMALL, TAG

from levade.engines import Settled, State, perturbed_models, start_state
from levade.search import Objective, Simulation, Trials
from levade.tasks import load_task

N = 7
TASK = load_task(
    "rearing", changes=[*SMALL, f"robust={{samples: {N}, measure: mean, redraw: generation}}", "search.trials=60"]
)


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    return Simulation.of(TASK, threads=1)


@pytest.fixture(scope="module")
def starts(simulation: Simulation) -> list[State]:
    """The task's own start, and the same posture in two other places."""
    engine, robot, scene = simulation.engine, simulation.robot, TASK.scene
    places = [start_state(engine, robot, scene, Settled("neutral", x=x, time=0.5)) for x in (1.0, 2.0)]
    return [simulation.start, *places]


def started(simulation: Simulation, starts: list[State], draw: int) -> np.ndarray:
    """Where the models of a draw start, shape (N, nq)."""
    objective = Objective(simulation.starting(starts[0], *starts[1:]), TASK)
    weights = objective.space.mean[None]
    pairs = (np.zeros(N, dtype=np.intp), np.arange(N))
    return objective.rollouts(Trials(weights, 0, seed=3, draw=draw, pairs=pairs)).starts.qpos


def test_models_that_stay_the_same_start_in_turn_from_each_state(simulation: Simulation, starts: list[State]) -> None:
    """Each as the same model does that starts there alone."""
    engine = simulation.engine
    sample = TASK.robust.perturb.spread(engine.model, engine.embodiment.joints, n=N, seed=(3, 0, TAG))
    alone = [perturbed_models(engine.model, engine.layout, sample, start)[0].qpos for start in starts]
    expected = np.array([alone[k % 3][k] for k in range(N)])
    np.testing.assert_array_equal(started(simulation, starts, draw=0), expected)


@pytest.mark.slow
def test_each_generation_shares_the_states_out_anew(simulation: Simulation, starts: list[State]) -> None:
    """So that which model starts where is left to chance, and each state starts as many of them, or one fewer."""
    orders = []
    for draw in range(1, 9):
        place = np.rint(started(simulation, starts, draw)[:, 0]).astype(int)
        assert sorted(np.bincount(place, minlength=3)) == [2, 2, 3]
        orders.append(tuple(place))
    assert len(set(orders)) > 4


def test_without_other_states_all_start_from_the_tasks_own(simulation: Simulation, starts: list[State]) -> None:
    engine = simulation.engine
    sample = TASK.robust.perturb.spread(engine.model, engine.embodiment.joints, n=N, seed=(3, 5, TAG))
    alone = perturbed_models(engine.model, engine.layout, sample, starts[0])[0].qpos
    np.testing.assert_array_equal(started(simulation, starts[:1], draw=5), alone)
