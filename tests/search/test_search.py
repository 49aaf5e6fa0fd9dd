"""A search as an object: driven by made-up evaluations, without any engine."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from levade.costs import Criterion, Position
from levade.errors import LevadeError
from levade.optimizers import SearchSpace
from levade.search import Evaluation, Generation, Search, Stopped, Trials
from levade.tasks import Change, Cost, Regulation, Robust, Stage, Task
from levade.tasks import Search as Settings

POPULATION = 8
SPACE = SearchSpace(np.zeros(6), step=0.5, population=POPULATION)
REDRAWN = Robust(samples=3, measure="mean", redraw="generation", validation=5)
NOMINAL_THEN_ROBUST = (Stage("nominal", robust=False, trials=16), Stage("robust"))


def make_task(*stages: Stage, robust: Robust | None = None, tolerance: float = 0.0, **search: Any) -> Task:
    """With a hold of 20 steps, and a success that needs the first weight to be near 1."""
    settings = {"optimizer": "cma", "trials": 64, "polish": None, **search}
    return Task(
        name="made up",
        horizon=0.1,
        hold=0.04,
        costs={"position": Cost(Position(z=0.5), 2.0)},
        success={"height": Criterion("height", target=0.5, tolerance=tolerance)},
        stages=stages or (Stage(),),
        search=Settings(**settings),
        robust=robust,
    )


def answer(task: Task, trials: Trials) -> Evaluation:
    """A parabola around a first weight of 1; a little farther off on every perturbed model."""
    weights, models = trials.weights, np.zeros(trials.n)
    if trials.pairs is not None:
        weights, models = weights[trials.pairs[0]], trials.pairs[1] + 1.0
    off = weights[:, 0] - 1.0 + 0.01 * models
    terms = {"position": off**2 + 0.1 * (weights[:, 1:] ** 2).sum(axis=1)}
    tolerance = task.success["height"].tolerance or 0.0
    return Evaluation(terms, {"height": off}, np.abs(off) <= tolerance, np.zeros(trials.n, dtype=bool))


def driven(
    search: Search, observe: Callable[[Generation], None] = lambda _: None
) -> tuple[list[Trials], list[Generation]]:
    """All that a search asks for, and its generations, from where it is to its end."""
    asked: list[Trials] = []
    seen: list[Generation] = []
    while (trials := search.ask()) is not None:
        asked.append(trials)
        generation = search.tell(answer(search.task, trials))
        if generation is not None:
            seen.append(generation)
            observe(generation)
    return asked, seen


def test_it_asks_for_the_same_until_it_is_told() -> None:
    search = Search(make_task(), SPACE)
    first = search.ask()
    assert first is not None
    assert search.ask() is first
    assert (first.n, first.hold_steps, first.draw, first.closing) == (POPULATION, 20, None, False)
    generation = search.tell(answer(search.task, first))
    assert generation is not None
    assert (generation.generation, generation.trials) == (1, POPULATION)
    second = search.ask()
    assert second is not None
    assert second is not first
    assert not np.array_equal(second.weights, first.weights)


def test_tell_before_ask_is_refused() -> None:
    search = Search(make_task(), SPACE)
    evaluation = answer(search.task, Trials(np.zeros((POPULATION, 6)), 20))
    with pytest.raises(RuntimeError, match="no trials were asked for; ask first"):
        search.tell(evaluation)
    search.ask()
    search.tell(evaluation)
    with pytest.raises(RuntimeError, match="ask first"):
        search.tell(evaluation)
    driven(search)
    with pytest.raises(RuntimeError, match="ask first"):
        search.tell(evaluation)


@pytest.mark.parametrize("count", [POPULATION - 1, POPULATION + 1, 1])
def test_an_evaluation_of_another_number_of_trials_is_refused_and_nothing_lost(count: int) -> None:
    search, other = Search(make_task(), SPACE), Search(make_task(), SPACE)
    asked = search.ask()
    with pytest.raises(ValueError, match=f"tell: 8 trials were asked for, the evaluation has {count}"):
        search.tell(answer(search.task, Trials(np.zeros((count, 6)), 20)))
    assert search.ask() is asked
    assert [one.checksum for one in driven(search)[0]] == [one.checksum for one in driven(other)[0]]


def test_there_is_no_solution_before_a_trial() -> None:
    search = Search(make_task(), SPACE)
    for _ in range(2):
        with pytest.raises(LevadeError, match="no trial has been told yet; ask and tell first"):
            _ = search.solution
        asked = search.ask()
    assert asked is not None
    search.tell(answer(search.task, asked))
    solution = search.solution
    assert (solution.stopped, solution.trials, solution.generations) == (Stopped.RUNNING, POPULATION, 1)


def test_an_interim_solution_is_that_of_the_generation() -> None:
    search = Search(make_task(), SPACE)

    def compare(generation: Generation) -> None:
        one, other = search.solution, generation.solution()
        assert one.best is other.best
        assert {**vars(one), "best": None} == {**vars(other), "best": None}

    driven(search, compare)
    assert search.solution.stopped is Stopped.BUDGET


@pytest.mark.parametrize(("budget", "spent"), [(64, 64), (71, 64), (72, 72), (3, 8)])
def test_as_many_whole_generations_as_the_budget_lasts_for(budget: int, spent: int) -> None:
    search = Search(make_task(trials=budget), SPACE)
    asked, seen = driven(search)
    assert search.ask() is None
    assert sum(one.n for one in asked) == spent == search.solution.trials
    assert [g.trials for g in seen] == list(range(8, spent + 1, 8))
    assert (search.solution.stopped, search.solution.success) == (Stopped.BUDGET, False)


def test_the_best_is_the_cheapest_of_all_that_were_told() -> None:
    search = Search(make_task(), SPACE, seed=4)
    asked, seen = driven(search)
    costs = [2.0 * answer(search.task, one).terms["position"] for one in asked]
    assert search.solution.best.cost == min(cost.min() for cost in costs)
    for generation, cost in zip(seen, costs, strict=True):
        np.testing.assert_array_equal(generation.cost, cost)
    first = np.argmin([cost.min() for cost in costs])
    np.testing.assert_array_equal(search.solution.best.weights, asked[first].weights[np.argmin(costs[first])])


@pytest.mark.parametrize(("polish", "more"), [(0, 0), (8, 1), (12, 2), (None, None)])
def test_it_stops_after_a_success_as_the_task_says(polish: int | None, more: int | None) -> None:
    search = Search(make_task(tolerance=0.1, trials=400, polish=polish), SPACE)
    _, seen = driven(search)
    first = next(i for i, g in enumerate(seen) if g.best.success)
    assert first > 0
    assert search.solution.trials_to_success == seen[first].trials
    assert len(seen) == (50 if more is None else first + 1 + more)
    assert search.solution.stopped is (Stopped.BUDGET if more is None else Stopped.SUCCESS)


def test_the_same_answers_give_the_same_questions() -> None:
    task = make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=400)
    one, again, other = (driven(Search(task, SPACE, seed=seed))[0] for seed in (3, 3, 4))
    assert [trials.checksum for trials in one] == [trials.checksum for trials in again]
    assert one[0].checksum != other[0].checksum


def test_what_a_robust_generation_asks_for_in_turn() -> None:
    """All on the nominal model, all on models of its own; then its best on both again, on the models that stay the same."""
    search = Search(make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=400), SPACE, seed=7)
    asked: list[Trials] = []
    for _ in range(3):  # two generations of the nominal stage
        generation = None
        while generation is None:
            trials = search.ask()
            assert trials is not None
            asked.append(trials)
            generation = search.tell(answer(search.task, trials))
    shapes = [(one.draw, len(one.weights), one.n) for one in asked]
    best = [(None, 1, 1), (0, 1, 5)]
    assert shapes == [(None, 8, 8), (None, 8, 8), *best, (None, 8, 8), (3, 8, 24), *best]
    assert all(one.seed == 7 and not one.closing for one in asked)
    drawn = asked[5].pairs
    assert drawn is not None
    assert sorted(zip(*map(np.ndarray.tolist, drawn), strict=True)) == [(i, j) for i in range(8) for j in range(3)]
    assert generation is not None
    cheapest = asked[4].weights[np.argmin(generation.cost)]
    np.testing.assert_array_equal(asked[6].weights[0], cheapest)
    assert generation.trials == 16 + 6 + 8 + 24 + 6  # the best of the nominal stage is tried on the models, too


@pytest.mark.parametrize("told", [0, 1, 2, 3])
def test_stop_in_the_middle_of_a_generation_judges_the_best_and_ends(told: int) -> None:
    """What the unfinished generation was told is not a part of the solution."""
    search = Search(make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=400), SPACE)
    while (generation := search.tell(answer(search.task, _wanted(search)))) is None or generation.generation < 3:
        pass
    before = search.solution
    for _ in range(told):
        assert search.tell(answer(search.task, _wanted(search))) is None
    search.stop()
    assert search.ask() is None  # the best has been judged in full already
    solution = search.solution
    assert solution.stopped is Stopped.INTERRUPTED
    assert solution.best is before.best
    assert (solution.trials, solution.generations) == (before.trials, 3)


@pytest.mark.parametrize("reason", [Stopped.INTERRUPTED, Stopped.SUCCESS])
def test_closing_trials_judge_the_best_as_the_task_does(reason: Stopped) -> None:
    """Stopped in the nominal stage, of which nothing holds yet."""
    search = Search(make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, tolerance=10.0, trials=400), SPACE)
    search.tell(answer(search.task, _wanted(search)))
    assert not search.solution.success
    best = search.solution.best.weights
    _wanted(search)
    search.stop(reason)
    asked, seen = driven(search)
    assert [(one.draw, one.n, one.closing) for one in asked] == [(None, 1, True), (0, 5, True)]
    assert all(np.array_equal(one.weights, best[None]) for one in asked)
    assert seen == []
    solution = search.solution
    assert (solution.stopped, solution.success, solution.best.share) == (reason, True, 1.0)
    assert solution.trials == solution.trials_to_success == POPULATION + 6


def test_stop_before_anything_was_asked_for_leaves_the_mean() -> None:
    search = Search(make_task(), SearchSpace(np.full(6, 0.25), step=0.5, population=POPULATION))
    search.stop()
    asked, seen = driven(search)
    assert (len(asked), seen) == (1, [])
    assert asked[0].closing
    np.testing.assert_array_equal(asked[0].weights, np.full((1, 6), 0.25))
    np.testing.assert_array_equal(search.solution.best.weights, np.full(6, 0.25))
    assert (search.solution.trials, search.solution.generations) == (0, 0)


def test_stop_after_the_end_changes_nothing() -> None:
    search = Search(make_task(), SPACE)
    driven(search)
    before = search.solution
    search.stop()
    assert search.ask() is None
    assert search.solution.stopped is before.stopped is Stopped.BUDGET
    assert search.solution.best is before.best


@pytest.mark.parametrize("raises", [True, False])
def test_who_steers_may_end_it(raises: bool) -> None:
    def steer(generation: int) -> Mapping[str, float] | Stopped | None:
        if generation < 3:
            return None
        if raises:
            raise KeyboardInterrupt
        return Stopped.INTERRUPTED

    search = Search(make_task(), SPACE, steer=steer)
    _, seen = driven(search)
    assert (len(seen), search.solution.stopped) == (2, Stopped.INTERRUPTED)


def test_changed_weights_hold_from_their_generation_on_and_are_part_of_the_task() -> None:
    search = Search(make_task(), SPACE, steer=lambda generation: {"position": 3.0} if generation == 4 else None)
    asked, seen = driven(search)
    for number, (trials, generation) in enumerate(zip(asked, seen, strict=True), 1):
        weight = 2.0 if number < 4 else 6.0
        np.testing.assert_array_equal(generation.cost, weight * answer(search.task, trials).terms["position"])
        assert generation.best.cost == pytest.approx(weight * generation.best.terms["position"])
    assert search.solution.changes == search.task.search.changes == (Change(4, {"position": 3.0}),)
    plain = Search(search.task, SPACE)
    assert [one.checksum for one in driven(plain)[0]] == [one.checksum for one in asked]


def test_a_stage_with_a_part_of_the_hold_tries_what_looks_good_through_all_of_it() -> None:
    task = dataclasses.replace(
        make_task(Stage(hold=False)), success={"height": Criterion("height", target=0.5, tolerance=9)}
    )
    search = Search(task, SPACE)
    first = _wanted(search)
    assert first.hold_steps == 0
    evaluation = answer(task, first)
    assert search.tell(evaluation.with_success(np.arange(POPULATION) % 4 == 1)) is None
    through = _wanted(search)
    assert (through.hold_steps, through.n) == (20, 2)
    np.testing.assert_array_equal(through.weights, first.weights[[1, 5]])
    generation = search.tell(answer(task, through).with_success(np.array([False, True])))
    assert generation is not None
    assert generation.evaluation is not None
    assert generation.evaluation.success.tolist() == [i == 5 for i in range(POPULATION)]
    assert generation.trials == POPULATION  # the same trials, simulated further


def _wanted(search: Search) -> Trials:
    trials = search.ask()
    assert trials is not None
    return trials


@pytest.mark.parametrize(("stage", "robust", "factor"), [(1.0, None, 0.5), (0.5, None, 1.0), (1.0, REDRAWN, 1.0)])
def test_the_step_is_halved_after_the_first_success(
    stage: float, robust: Robust | None, factor: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once, and not where the stage has a factor of its own or models are perturbed."""
    task = make_task(Stage(step=stage, robust=robust is not None), tolerance=0.3, robust=robust, trials=400)
    _, halved = driven(Search(task, SPACE, seed=0))
    monkeypatch.setattr("levade.search.search.POLISH", 1.0)
    _, left = driven(Search(task, SPACE, seed=0))
    first = next(i for i, one in enumerate(left) if one.trials_to_success is not None)
    assert [one.step for one in halved[:first]] == [one.step for one in left[:first]]
    assert halved[first].step == pytest.approx(factor * left[first].step)
    again = [a.step / b.step for a, b in zip(halved[first + 1 :], left[first + 1 :], strict=False)]
    assert len(again) > 2
    assert (np.array(again) == 1.0).all() if factor == 1.0 else again[0] > 0.25


@pytest.mark.parametrize("better", [True, False])
def test_gains_that_hold_the_best_motion_less_well_are_not_taken(better: bool) -> None:
    """Feedback whose gains are made again each generation: with later gains every roll-out costs less, or more."""
    task = dataclasses.replace(
        make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=500), feedback=Regulation(every=1)
    )
    search, asked, seen = Search(task, SPACE, seed=0), [], []
    while (trials := search.ask()) is not None:
        evaluation = answer(task, trials)
        if trials.gains is not None:
            asked += [trials.gains.along.tobytes()] if trials.gains.along.tobytes() not in asked else []
            change = (0.5 if better else 2.0) ** asked.index(trials.gains.along.tobytes())
            terms = {"position": evaluation.terms["position"] * change}
            evaluation = dataclasses.replace(evaluation, terms=terms)
        generation = search.tell(evaluation)
        if generation is not None and generation.stage_name == "robust" and generation.best.gains is not None:
            seen.append(generation.best.gains.along.tobytes())
    assert len(asked) > 3
    assert len(set(seen)) > 3 if better else set(seen) == {asked[0]}


def test_the_first_gains_are_of_the_best_design_and_later_ones_keep_it() -> None:
    """Each design has its own cost, and the third the lowest."""
    task = dataclasses.replace(
        make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=500), feedback=Regulation(every=1)
    )
    search, asked = Search(task, SPACE, seed=0), []
    while (trials := search.ask()) is not None:
        evaluation = answer(task, trials)
        if trials.gains is not None:
            asked.append(trials.gains.design)
            terms = {"position": evaluation.terms["position"] * (0.9, 0.8, 0.5, 0.7)[trials.gains.design]}
            evaluation = dataclasses.replace(evaluation, terms=terms)
        search.tell(evaluation)
    assert list(dict.fromkeys(asked)) == [0, 1, 2, 3]
    last = asked.index(3)
    assert len(asked) > last + 3
    assert set(asked[last + 1 :]) == {2}
    assert search.solution.best.gains is not None
    assert search.solution.best.gains.design == 2


def test_feedback_that_holds_less_than_none_is_not_taken() -> None:
    """It is tried again later, along a better motion; all others are tried without."""
    task = dataclasses.replace(
        make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN, trials=500), feedback=Regulation(every=3)
    )
    search, seen, asked = Search(task, SPACE, seed=0), [], []
    while (trials := search.ask()) is not None:
        evaluation = answer(task, trials)
        if trials.gains is not None:
            asked.append(trials)
            terms = {"position": evaluation.terms["position"] + 1.0}
            evaluation = dataclasses.replace(evaluation, terms=terms, success=np.zeros(trials.n, dtype=bool))
        generation = search.tell(evaluation)
        if generation is not None:
            seen.append(generation)
    assert len(asked) > 1
    assert all(len(trials.weights) == 1 for trials in asked)
    assert all(generation.best.gains is None for generation in seen)
    assert search.solution.best.gains is None


def test_feedback_is_asked_for_on_perturbed_models_only() -> None:
    """And not before there is a motion to make gains along."""
    task = dataclasses.replace(make_task(*NOMINAL_THEN_ROBUST, robust=REDRAWN), feedback=Regulation())
    asked, _ = driven(Search(task, SPACE, seed=0))
    assert all(trials.gains is None for trials in asked if trials.draw is None)
    gains = [trials.gains for trials in asked if trials.draw is not None]
    first = next(i for i, one in enumerate(gains) if one is not None)
    assert first <= 1  # the motion to make them along is judged before
    assert all(one is not None for one in gains[first:])


def test_an_attempt_begins_around_the_best_of_its_sketches() -> None:
    space = dataclasses.replace(SPACE, span=np.tile([-3.0, 3.0], (6, 1)))
    task = make_task(sketches=20, trials=160, restart=32)
    asked, _ = driven(Search(task, space, seed=5))
    sketches = [trials.weights for trials in asked if trials.n == 20]
    assert len(sketches) == 3  # each attempt takes 32 trials after its sketches
    assert np.array_equal(sketches[0], asked[0].weights)
    drawn = np.concatenate(sketches)
    assert len(np.unique(drawn, axis=0)) == 60
    assert drawn.min() < -2.5
    assert drawn.max() > 2.5
    for attempt, weights in enumerate(sketches):
        best = weights[np.argmin(answer(task, Trials(weights, 0)).terms["position"])]
        around = asked[5 * attempt + 1].weights
        assert np.linalg.norm(around.mean(axis=0) - best) < 0.5
    again, _ = driven(Search(task, space, seed=5))
    assert all(np.array_equal(one.weights, other.weights) for one, other in zip(asked, again, strict=True))


def test_a_sketch_that_succeeds_ends_the_search() -> None:
    space = dataclasses.replace(SPACE, span=np.tile([-3.0, 3.0], (6, 1)))
    search = Search(make_task(sketches=40, polish=0, tolerance=0.5), space)
    asked, seen = driven(search)
    assert asked[0].n == 32  # at most half of what is left
    assert not seen
    assert search.solution.stopped is Stopped.SUCCESS
    assert search.solution.trials_to_success == 32


def test_many_sketches_are_tried_in_parts() -> None:
    """So that Ctrl-C is heard, and keeps the best one; all of them are there before the optimizer begins."""
    space = dataclasses.replace(SPACE, span=np.tile([-3.0, 3.0], (6, 1)))
    task = make_task(sketches=100, trials=400)
    asked, _ = driven(Search(task, space, seed=5))
    assert [trials.n for trials in asked[:4]] == [48, 48, 4, 8]
    drawn = np.concatenate([trials.weights for trials in asked[:3]])
    best = drawn[np.argmin(answer(task, Trials(drawn, 0)).terms["position"])]
    assert np.linalg.norm(asked[3].weights.mean(axis=0) - best) < 0.5
    search = Search(task, space, seed=5)
    first = search.ask()
    assert first is not None
    evaluation = answer(task, first)
    search.tell(evaluation)
    search.stop()
    assert np.array_equal(search.solution.best.weights, first.weights[np.argmin(evaluation.terms["position"])])


def test_sketches_need_ranges() -> None:
    with pytest.raises(LevadeError, match="sketches: the policy has no ranges"):
        Search(make_task(sketches=4), SPACE).ask()
