"""Weights that change in the middle of a search: what they do, that they are recorded, and that nothing else changes."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest

from levade.errors import LevadeError
from levade.motions import Motion
from levade.search import Evaluation, Generation, Objective, Solution, Stopped, Trials, make_objective, solve
from levade.search.run import MOTION, TASK, Outcome, read_run, resume, run
from levade.tasks import Change, Task, load_task, task_from_dict, task_to_dict

# three stages that weigh by themselves, look at the hold differently, and a goal that is not met
STEERED = """
name: steered
horizon: 0.1
hold: 0.04
policy: {groups: pairs}
costs:
  orientation: {weight: 1000, pitch: -0.3}
  position: {weight: 100, z: 0.6}
  effort: {weight: 0.1}
  after: {term: orientation, weight: 50, pitch: -0.3, at: end}
stages:
  - {name: first, hold: false, trials: 24, weights: {effort: 0, position: 400}}
  - {name: second, hold: 0.02, trials: 24, step: 0.5}
  - {name: third}
success:
  pitch: {target: -0.3, tolerance: 0}
search: {optimizer: cma, trials: 96, population: 8, step: 0.2, smoothness: 0.2, polish: null}
"""
SLIDERS = {2: {"position": 3.0}, 5: {"orientation": 0.2, "effort": 40.0}, 6: {"position": 1.0}, 9: {"after": 10.0}}


SameFiles = Callable[[Path, Path], None]


def slide(numbers: list[int] | None = None) -> Callable[[int], Mapping[str, float] | None]:
    def steer(generation: int) -> Mapping[str, float] | None:
        if numbers is not None:
            numbers.append(generation)
        return SLIDERS.get(generation)

    return steer


@pytest.fixture(scope="module")
def task(tmp_path_factory: pytest.TempPathFactory) -> Task:
    path = tmp_path_factory.mktemp("task") / "steered.yaml"
    path.write_text(STEERED)
    return load_task(path)


@pytest.fixture(scope="module")
def objective(task: Task) -> Objective:
    return make_objective(task, threads=1)


@pytest.fixture(scope="module")
def steered(objective: Objective, tmp_path_factory: pytest.TempPathFactory) -> Outcome:
    """A whole run with the sliders moved."""
    return run(objective, seed=1, directory=tmp_path_factory.mktemp("runs") / "steered", steer=slide())


def assert_same(one: Solution, other: Solution) -> None:
    np.testing.assert_array_equal(one.best.weights, other.best.weights)
    assert {**vars(one.best), "weights": None} == {**vars(other.best), "weights": None}
    for field in dataclasses.fields(Solution):
        if field.name != "best":
            assert getattr(one, field.name) == getattr(other, field.name), field.name


@pytest.mark.slow
def test_a_hand_that_is_not_moved_changes_no_bit(objective: Objective) -> None:
    """Asked before every generation, also when the answer is that everything stays as it is."""
    plain = solve(objective, seed=1)
    numbers: list[int] = []
    assert_same(solve(objective, seed=1, steer=numbers.append), plain)
    assert numbers == list(range(1, 13))
    ones = solve(objective, seed=1, steer=lambda _: {"position": 1.0})
    np.testing.assert_array_equal(ones.best.weights, plain.best.weights)
    assert ones.best.cost == plain.best.cost


@pytest.mark.slow
def test_the_optimizer_is_told_what_the_changed_weights_give(objective: Objective, task: Task) -> None:
    """By hand: the stage's own weight or the task's, times the latest factor."""
    generations: list[Generation] = []
    solve(objective, seed=1, steer=slide(), observe=generations.append)
    factors: dict[str, float] = {}
    for g in generations:
        factors |= SLIDERS.get(g.generation, {})
        own = {name: cost.weight * factors.get(name, 1.0) for name, cost in task.costs.items()}
        told = own | {name: w * factors.get(name, 1.0) for name, w in task.stages[g.stage].weights.items()}
        terms = {name: values for name, values in g.evaluation.terms.items() if not np.isnan(values).any()}
        np.testing.assert_allclose(g.cost, sum(told[name] * values for name, values in terms.items()), rtol=1e-12)
        assert g.cost_weights == own
        known = {name: value for name, value in g.best.terms.items() if not np.isnan(value)}
        assert g.best.cost == pytest.approx(sum(own[name] * value for name, value in known.items()), rel=1e-12)
    assert {g.stage for g in generations} == {0, 1, 2}


@pytest.mark.slow
def test_changed_weights_change_the_motion(objective: Objective, steered: Outcome) -> None:
    plain = solve(objective, seed=1)
    assert not np.array_equal(plain.best.weights, steered.solution.best.weights)
    assert steered.solution.changes == tuple(Change(number, factors) for number, factors in SLIDERS.items())


@pytest.mark.slow
@pytest.mark.parametrize("threads", [1, 2])
def test_the_task_that_is_left_gives_the_steered_run_again(
    steered: Outcome, tmp_path: Path, threads: int, assert_same_files: SameFiles
) -> None:
    task = load_task(steered.directory / TASK)
    assert task.search.changes == steered.solution.changes
    run(task, seed=1, threads=threads, directory=tmp_path / "again")
    assert_same_files(tmp_path / "again", steered.directory)


@pytest.mark.slow
def test_the_motion_says_by_which_weights_it_costs(steered: Outcome, task: Task) -> None:
    meta = steered.motion.meta
    last = {"orientation": 200.0, "position": 100.0, "effort": 4.0, "after": 500.0}
    assert dict(steered.motion.result.cost_weights) == pytest.approx(last)
    assert meta["cost"] == pytest.approx(sum(last[name] * value for name, value in meta["cost_terms"].items()))
    assert meta["task"] == task_to_dict(load_task(steered.directory / TASK))
    before = {
        key: value for key, value in meta.items() if key != "cost_weights"
    }  # a file from before there were changes
    assert dataclasses.replace(steered.motion, meta=before).result.cost_weights == {
        name: cost.weight for name, cost in task.costs.items()
    }


@pytest.mark.slow
@pytest.mark.parametrize("generations", [1, 2, 4, 5, 8, 12])
def test_a_steered_run_that_is_interrupted_goes_on_to_the_same_end(
    objective: Objective, steered: Outcome, tmp_path: Path, generations: int, assert_same_files: SameFiles
) -> None:
    """Before, at and after changes; the hand goes on moving as if nothing had been, and is not asked about what is known."""

    def stop(g: Generation) -> None:
        if g.generation == generations:
            raise KeyboardInterrupt

    run(objective, seed=1, directory=tmp_path, observe=stop, steer=slide())
    # each generation, and the best tried again where another part of the hold is simulated
    again = (generations > 3) + (generations > 6)
    assert len(read_run(tmp_path)[1].records) == generations + again
    numbers: list[int] = []
    resume(tmp_path, threads=2, steer=slide(numbers))
    assert numbers == list(range(generations + 1, 13))
    assert_same_files(tmp_path, steered.directory)


@pytest.mark.slow
@pytest.mark.parametrize("how", ["returns", "raises"])
def test_stopping_by_hand_keeps_the_best_and_goes_on_later(
    objective: Objective, steered: Outcome, tmp_path: Path, how: str, assert_same_files: SameFiles
) -> None:
    """The hand stops before generation 6, which it would have changed the weights of."""

    def stop(generation: int) -> Mapping[str, float] | Stopped | None:
        if generation == 6 and how == "raises":
            raise KeyboardInterrupt
        return Stopped.INTERRUPTED if generation == 6 else SLIDERS.get(generation)

    part = run(objective, seed=1, directory=tmp_path, steer=stop)
    assert (part.solution.stopped, part.solution.generations) == ("interrupted", 5)
    assert Motion.load(tmp_path / MOTION).meta["stopped"] == "interrupted"
    assert [change.generation for change in part.solution.changes] == [2, 5]
    resume(tmp_path, steer=slide())
    assert_same_files(tmp_path, steered.directory)


@pytest.mark.slow
def test_a_change_is_on_disk_before_it_is_simulated(
    objective: Objective, steered: Outcome, tmp_path: Path, assert_same_files: SameFiles
) -> None:
    """Whatever happens in the generation that is the first with new weights, the run can go on."""
    other = objective.with_task(objective.task)
    calls, evaluate = 0, objective.evaluate

    def breaks(trials: Trials) -> Evaluation:
        nonlocal calls
        calls += trials.n == 8
        if calls == 5:
            raise SystemExit  # the process ends
        return evaluate(trials)

    other.evaluate = breaks  # type: ignore[method-assign]
    with pytest.raises(SystemExit):
        run(other, seed=1, directory=tmp_path, steer=slide())
    assert [change.generation for change in load_task(tmp_path / TASK).search.changes] == [2, 5]
    resume(tmp_path, steer=lambda generation: SLIDERS.get(generation) if generation > 5 else None)
    assert_same_files(tmp_path, steered.directory)


def test_a_later_change_joins_those_of_the_task(task: Task) -> None:
    once = task.changed(Change(5, {"effort": 2.0})).changed(Change(3, {"effort": 4.0, "position": 2.0}))
    again = once.changed(Change(5, {"effort": 3.0, "after": 0.0}))
    assert again.search.changes == (
        Change(3, {"effort": 4.0, "position": 2.0}),
        Change(5, {"effort": 3.0, "after": 0.0}),
    )
    assert [again.search.factors(g) for g in (2, 3, 5)] == [
        {},
        {"effort": 4.0, "position": 2.0},
        {"effort": 3.0, "position": 2.0, "after": 0.0},
    ]
    assert task_from_dict(task_to_dict(again), where="task") == again


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ([{"generation": 0, "factors": {}}], r"search.changes.0.generation: 0 should be 1 or more"),
        ([{"generation": 1, "factors": {"efort": 2}}], r"search.changes.0.factors: no 'efort' .*did you mean effort"),
        ([{"generation": 1, "factors": {"effort": -2}}], r"changes.0.factors.effort: -2.0 should be a factor"),
        ([{"generation": 1, "factors": {"effort": float("inf")}}], r"changes.0.factors.effort: inf should be"),
        ([{"generation": 1}], r"search.changes.0.factors: missing"),
        ([{"generation": 1, "weights": {}}], r"search.changes.0: unknown key 'weights'"),
    ],
)
def test_changes_that_are_wrong(task: Task, changes: list[dict[str, object]], message: str) -> None:
    content = task_to_dict(task)
    content["search"]["changes"] = changes
    with pytest.raises(LevadeError, match=message):
        task_from_dict(content, where="task")


def test_a_hand_on_a_cost_that_is_not_there(objective: Objective) -> None:
    with pytest.raises(LevadeError, match="no 'efort' in this task; did you mean effort"):
        solve(objective, seed=1, steer=lambda _: {"efort": 2.0})
