"""What is good enough on perturbed models: another tolerance than on the model, and fewer criteria."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.search import Objective, make_objective
from levade.search.evaluation import Trials
from levade.tasks import Task, load_task, task_from_dict, task_to_dict

PERTURBED = "robust={samples: 6, success: {pitch: {tolerance: 10}}}"


@pytest.fixture(scope="module")
def task() -> Task:
    return load_task("rearing", changes=[PERTURBED])


@pytest.fixture(scope="module")
def objective(task: Task) -> Objective:
    return make_objective(task, threads=1)


def test_a_tolerance_is_enough_the_rest_is_the_task_s(task: Task) -> None:
    assert set(task.good_enough) == {"pitch"}
    assert task.good_enough["pitch"] == replace(task.success["pitch"], tolerance=10)


def test_without_it_the_task_s_criteria_count() -> None:
    assert load_task("rearing-robust").good_enough == load_task("rearing-robust").success
    assert load_task("rearing").good_enough == load_task("rearing").success


def test_perturbed_models_are_judged_by_it_and_the_model_by_the_task(objective: Objective) -> None:
    """A robot that only stands has no pitch of -60 degrees, but is within 10 rad of it, at whatever height."""
    weights = objective.space.mean[None]
    on_model = objective.evaluate(Trials(weights, 0))
    assert not on_model.success.any()
    pairs = (np.zeros(6, dtype=int), np.arange(6))
    perturbed = objective.evaluate(Trials(weights, 0, seed=0, draw=0, pairs=pairs))
    assert perturbed.success.all()
    assert np.isnan(perturbed.errors["height"]).all()
    assert np.isfinite(perturbed.errors["pitch"]).all()


def test_it_survives_a_file(task: Task) -> None:
    assert task_from_dict(task_to_dict(task), where="file") == task


@pytest.mark.parametrize(
    ("robust", "message"),
    [
        ("{success: {pich: {target: 0, tolerance: 1}}}", "robust.success.pich: .*did you mean pitch"),
        ("{success: {pitch: {tolerance: -1}}}", "tolerance: -1.* is negative"),
        ("{success: {pitch: {at: hold}}}", "robust.success.pitch.at: hold, but the task has no hold"),
        ("{success: 3}", "robust.success: should be a table"),
    ],
)
def test_mistakes_are_told(robust: str, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        load_task("rearing", changes=[f"robust={robust}"])
