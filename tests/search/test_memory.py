"""Trials that do not fit into the memory at once are simulated in parts, with the same bits; one that never fits is refused."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.search import Objective, Trials, make_objective, memory
from levade.search.objective import evaluate_many
from levade.tasks import load_task

SMALL = ["horizon=0.06", "hold=0.02", "robust={samples: 3}"]


@pytest.fixture(scope="module")
def objective() -> Objective:
    return make_objective(load_task("rearing", changes=SMALL), threads=1)


@pytest.fixture
def asked(objective: Objective) -> list[tuple[Objective, Trials]]:
    """Trials of all kinds: of the nominal model, with and without the hold, and some candidates on some models."""
    generator = np.random.default_rng(0)
    weights = objective.space.mean + 0.2 * generator.standard_normal((9, objective.space.size))
    pairs = (np.array([3, 0, 0, 4, 4, 1]), np.array([0, 1, 2, 2, 0, 1]))
    trials = [Trials(weights, 0), Trials(weights[:5], objective.task.hold_steps)]
    trials.append(Trials(weights, objective.task.hold_steps, draw=1, pairs=pairs))
    return [(objective, one) for one in trials]


@pytest.mark.parametrize("fit", [1, 2, 4])
def test_parts_that_fit_give_the_same_bits(
    objective: Objective, asked: list[tuple[Objective, Trials]], fit: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = evaluate_many(asked)
    one = memory.needed(objective.engine, objective.task.horizon_steps + objective.task.hold_steps).trial
    monkeypatch.setattr(memory, "free_memory", lambda: int(2 * fit * one))
    rolled: list[int] = []
    rollout = objective.engine.rollout

    def counted(starts, reference, **options):
        rolled.append(len(reference.position))
        return rollout(starts, reference, **options)

    monkeypatch.setattr(objective.engine, "rollout", counted)
    parts = evaluate_many(asked)
    assert sum(rolled) == sum(trials.n for _, trials in asked)
    assert max(rolled) < 9
    for one_whole, one_part in zip(whole, parts, strict=True):
        assert one_whole.success.tobytes() == one_part.success.tobytes()
        for name, values in one_whole.terms.items():
            assert values.tobytes() == one_part.terms[name].tobytes()
        for name, values in one_whole.errors.items():
            assert values.tobytes() == one_part.errors[name].tobytes()


def test_what_a_trial_is_said_to_need_is_what_it_needs(objective: Objective) -> None:
    task = objective.task
    n, steps = 64, task.horizon_steps + task.hold_steps
    trials = Trials(np.repeat(objective.space.mean[None], n, axis=0), task.hold_steps)
    objective.evaluate(trials)
    tracemalloc.start()
    try:
        objective.evaluate(trials)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert 0.2 < peak / (n * memory.needed(objective.engine, steps).trial) < 1.0


def test_a_trial_that_never_fits_is_refused_before_it_is_simulated(
    objective: Objective, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(memory, "free_memory", lambda: 100_000)
    with pytest.raises(LevadeError, match=r"horizon: a trial of 40 steps needs 0?.* MB, but only half of the 0\.1 MB"):
        objective.with_task(objective.task)


def test_the_free_memory_is_that_of_the_machine_or_less() -> None:
    free = memory.free_memory()
    if free is None:
        pytest.skip("this system does not say")
    assert 0 < free < 2**50
