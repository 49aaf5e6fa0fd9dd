"""What is good enough on perturbed models: another tolerance than on the model, and fewer criteria."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.search import Objective, make_objective
from levade.search.evaluation import Trials
from levade.search.outcome import Trial
from levade.search.robust import Judge
from levade.search.schedule import full_level
from levade.tasks import Task, load_task, task_from_dict, task_to_dict

PERTURBED = "robust={samples: 6, success: {pitch: {tolerance: 10}}}"


@pytest.fixture(scope="module")
def task() -> Task:
    return load_task("rearing", changes=[PERTURBED])


@pytest.fixture(scope="module")
def objective(task: Task) -> Objective:
    return make_objective(task, threads=1)


def test_a_tolerance_is_enough_the_rest_is_the_task_s(task: Task) -> None:
    assert set(task.on_others) == {"pitch"}
    assert task.on_others["pitch"] == replace(task.success["pitch"], tolerance=10)


def test_without_it_the_task_s_criteria_count() -> None:
    assert load_task("rearing-robust").on_others == load_task("rearing-robust").success
    assert load_task("rearing").on_others == load_task("rearing").success


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


def test_a_task_on_the_nominal_model_may_say_it_too() -> None:
    """Then all other criteria hold on perturbed models as they are."""
    task = load_task("squat-jump", changes=["good_enough={apex: {minimum: 0.8}}"])
    assert task.robust is None
    apex = task.success["apex"]
    assert task.on_others == {**task.success, "apex": replace(apex, minimum=0.8)}
    assert task_from_dict(task_to_dict(task), where="file") == task
    robust = load_task("squat-jump", changes=["good_enough={apex: {minimum: 0.8}}", "robust={success: {apex: {}}}"])
    assert robust.on_others == {"apex": apex}


@pytest.mark.parametrize(
    ("enough", "message"),
    [
        ("{apx: {minimum: 1}}", "good_enough.apx: .*did you mean apex"),
        ("{apex: {minimum: 1, maximm: 2}}", "good_enough.apex: .*did you mean maximum"),
        ("3", "good_enough: should be a table"),
    ],
)
def test_mistakes_there_are_told(enough: str, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        load_task("squat-jump", changes=[f"good_enough={enough}"])


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


def test_who_does_all_on_the_model_ranks_before_who_holds_on_more_robots() -> None:
    def trial(*, met: bool, share: float) -> Trial:
        return Trial(np.zeros(2), 1.0, {}, {}, success=False, share=share, met=met)

    assert trial(met=True, share=0.5).rank < trial(met=False, share=0.9).rank
    assert trial(met=True, share=0.9).rank < trial(met=True, share=0.5).rank


def test_a_judgement_says_who_does_all_on_the_model(task: Task, objective: Objective) -> None:
    judging = Judge(task, 0).evaluate(objective.space.mean[None], full_level(task))
    trials = next(judging)
    evaluation = None
    while evaluation is None:
        try:
            trials = judging.send(objective.evaluate(trials))
        except StopIteration as end:
            evaluation = end.value
    assert evaluation.samples.share.tolist() == [1.0]
    assert evaluation.met.tolist() == [False]
    assert evaluation.success.tolist() == [False]
