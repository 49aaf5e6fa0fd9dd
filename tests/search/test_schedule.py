"""The order of a search as a table: reports in, moves out; no robot, no optimizer, no simulation."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from levade.costs import Criterion, Position
from levade.search import Evaluation, Move, Report, Schedule
from levade.search.schedule import Level, first_to_end, full_level, level_of, promoted
from levade.tasks import Cost, Robust, Search, Stage, Task

GO_ON, NEXT, RESTART = Move.GO_ON, Move.NEXT_STAGE, Move.RESTART
FROM_BEST, ROUND, STOP = Move.FROM_BEST_START, Move.NEW_ROUND, Move.STOP

NOMINAL = Stage("nominal", robust=False, hold=False, promote={"height": 0.1})


def make_task(*stages: Stage, starts: int | None = None, **search: Any) -> Task:
    return Task(
        name="table",
        horizon=0.1,
        hold=0.04,
        costs={"position": Cost(Position(z=0.5), 1.0)},
        success={"height": Criterion("height", target=0.5, tolerance=0.01)},
        stages=stages or (Stage(),),
        search=dataclasses.replace(Search(polish=None), **search),
        robust=None if starts is None else Robust(samples=2, starts=starts),
    )


def played(task: Task, *generations: tuple[int, str] | int) -> list[tuple[Move, int, int]]:
    """Move, stage and attempt after each generation: what it spent, and a word on what came of it."""
    schedule, trials, success, moves = Schedule(task), 0, None, []
    for one in generations:
        spent, word = one if isinstance(one, tuple) else (one, "")
        assert word in ("", "success", "promoted", "start")
        trials += spent
        success = trials if word == "success" and success is None else success
        report = Report(spent, trials, success, promoted=word == "promoted", found_start=word == "start")
        move = schedule.after(report)
        moves.append((move, schedule.number, schedule.attempt))
        assert schedule.stage == task.stages[schedule.number]
        assert schedule.level == level_of(task, schedule.stage)
    return moves


def test_a_stage_ends_when_its_own_trials_are_spent_and_the_last_goes_on() -> None:
    task = make_task(Stage("first", trials=24), Stage("second", trials=20), Stage("third"))
    assert played(task, 8, 8, 8, 8, 8, 8, 8, 80) == [
        (GO_ON, 0, 0),
        (GO_ON, 0, 0),
        (NEXT, 1, 0),
        (GO_ON, 1, 0),
        (GO_ON, 1, 0),
        (NEXT, 2, 0),  # 24 of 20: whole generations
        (GO_ON, 2, 0),
        (GO_ON, 2, 0),
    ]


def test_a_stage_ends_when_a_trial_is_promoted() -> None:
    task = make_task(Stage("first", promote={"height": 0.1}), Stage("second", promote={"height": 0.05}))
    assert played(task, 8, (8, "promoted"), 8, (8, "promoted"), (8, "success")) == [
        (GO_ON, 0, 0),
        (NEXT, 1, 0),
        (GO_ON, 1, 0),
        (GO_ON, 1, 0),  # there is none after it
        (GO_ON, 1, 0),
    ]


def test_without_success_it_restarts_from_the_first_stage() -> None:
    task = make_task(Stage("first", trials=16), Stage("second"), restart=32)
    assert played(task, 8, 8, 8, 8, 8, 8, 8, (8, "success"), 80) == [
        (GO_ON, 0, 0),
        (NEXT, 1, 0),
        (GO_ON, 1, 0),
        (RESTART, 0, 1),  # the trials of both stages count
        (GO_ON, 0, 1),
        (NEXT, 1, 1),
        (GO_ON, 1, 1),
        (GO_ON, 1, 1),  # a success, in time
        (GO_ON, 1, 1),
    ]
    assert played(make_task(restart=None), *[1000] * 3) == [(GO_ON, 0, 0)] * 3


def moves_of(task: Task, *generations: tuple[int, float]) -> list[Move]:
    """The moves after generations of some trials and a lowest cost each."""
    schedule, trials, moves = Schedule(task), 0, []
    for spent, cost in generations:
        trials += spent
        moves.append(schedule.after(Report(spent, trials, cost=cost)))
    return moves


def test_an_attempt_that_improves_goes_on() -> None:
    task = make_task(restart=24, patience=16)
    falling = [(8, 10.0), (8, 8.0), (8, 6.0), (8, 5.8), (8, 5.5), (8, 99.0)]
    assert moves_of(task, *falling) == [GO_ON, GO_ON, GO_ON, GO_ON, RESTART, GO_ON]  # 5.5 is 8 % below 6.0
    assert moves_of(task, *[(8, 5.0)] * 3) == [GO_ON, GO_ON, RESTART]
    assert moves_of(make_task(restart=24), *falling[:3]) == [GO_ON, GO_ON, RESTART]
    assert moves_of(task, *[(8, 0.0)] * 3) == moves_of(task, *[(8, -5.0)] * 3) == [GO_ON, GO_ON, RESTART]
    assert moves_of(task, (8, -5.0), (8, -6.0), (8, -7.0)) == [GO_ON] * 3
    assert moves_of(make_task(restart=8, patience=16), (8, 5.0), (8, 5.0), (8, 5.0)) == [GO_ON, GO_ON, RESTART]


def test_patience_is_of_a_stage_whose_costs_are_alike() -> None:
    """What was cheap by the weights of the stage before does not count."""
    task = make_task(Stage("first", trials=16), Stage("second"), restart=24, patience=8)
    assert moves_of(task, (8, 0.1), (8, 0.1), (8, 50.0), (8, 40.0), (8, 39.0)) == [GO_ON, NEXT, GO_ON, GO_ON, RESTART]


def test_a_search_on_perturbed_models_does_not_restart() -> None:
    task = make_task(NOMINAL, Stage("robust"), starts=1, restart=16)
    assert played(task, (8, "promoted"), 8, 8, 80) == [(NEXT, 1, 0)] + [(GO_ON, 1, 0)] * 3
    assert played(task, 8, 8, (8, "promoted")) == [(GO_ON, 0, 0), (RESTART, 0, 1), (NEXT, 1, 1)]


@pytest.mark.parametrize(
    ("polish", "moves"),
    [
        (0, [GO_ON, STOP]),
        (1, [GO_ON, GO_ON, STOP]),
        (8, [GO_ON, GO_ON, STOP]),
        (9, [GO_ON, GO_ON, GO_ON, STOP]),
        (None, [GO_ON, GO_ON, GO_ON, GO_ON]),
    ],
)
def test_a_success_is_polished_for_as_long_as_the_task_says(polish: int | None, moves: list[Move]) -> None:
    generations = [8, (8, "success"), 8, (8, "success")][: len(moves)]
    assert [move for move, _, _ in played(make_task(polish=polish), *generations)] == moves  # type: ignore[arg-type]


def test_a_success_stops_it_in_any_stage_before_the_stage_ends() -> None:
    task = make_task(Stage("first", trials=8), Stage("second"), polish=0)
    assert played(task, (8, "success")) == [(STOP, 0, 0)]


def test_robust_stages_begin_from_the_best_of_several_motions() -> None:
    task = make_task(NOMINAL, Stage("robust"), starts=3)
    assert played(task, 8, (11, "start"), (11, "start"), 8, 8, (11, "start"), 20, 20) == [
        (GO_ON, 0, 0),
        (RESTART, 0, 1),
        (RESTART, 0, 2),
        (GO_ON, 0, 2),
        (GO_ON, 0, 2),
        (FROM_BEST, 1, 2),
        (GO_ON, 1, 2),
        (GO_ON, 1, 2),
    ]


def test_every_attempt_counts_as_a_start_if_one_at_least_found_a_motion() -> None:
    task = make_task(NOMINAL, Stage("robust"), starts=3, restart=16)
    # the second is given up
    assert played(task, (11, "start"), 8, 8, (11, "start")) == [
        (RESTART, 0, 1),
        (GO_ON, 0, 1),
        (RESTART, 0, 2),
        (FROM_BEST, 1, 2),
    ]
    # the last is given up
    assert played(task, (11, "start"), (11, "start"), 16, 8) == [
        (RESTART, 0, 1),
        (RESTART, 0, 2),
        (FROM_BEST, 1, 2),
        (GO_ON, 1, 2),
    ]
    # all three are given up, and so is a fourth: the first motion is enough then
    assert played(task, 16, 16, 16, 16, (11, "start")) == [
        (RESTART, 0, 1),
        (RESTART, 0, 2),
        (RESTART, 0, 3),
        (RESTART, 0, 4),
        (FROM_BEST, 1, 4),
    ]


ROUNDS = (NOMINAL, Stage("robust", trials=30))


def test_rounds_in_vain_repeat_while_the_budget_lasts_for_another() -> None:
    task = make_task(*ROUNDS, starts=2, trials=150)
    once = [(10, "start"), (10, "start"), 15, 15]
    assert played(task, *once, *once, *once, 50) == [  # type: ignore[arg-type]
        (RESTART, 0, 1),
        (FROM_BEST, 1, 1),
        (GO_ON, 1, 1),
        (ROUND, 0, 2),  # 100 of 150 left, 50 a round
        (RESTART, 0, 3),
        (FROM_BEST, 1, 3),
        (GO_ON, 1, 3),
        (ROUND, 0, 4),  # 50 of 150 left
        (RESTART, 0, 5),
        (FROM_BEST, 1, 5),
        (GO_ON, 1, 5),
        (GO_ON, 1, 5),  # nothing left
        (GO_ON, 1, 5),
    ]


def test_rounds_end_with_a_success_or_with_too_little_left() -> None:
    once = [(10, "start"), (10, "start"), 30]
    for trials, last in ((100, (ROUND, 0, 2)), (99, (GO_ON, 1, 1))):
        assert played(make_task(*ROUNDS, starts=2, trials=trials), *once)[-1] == last  # type: ignore[arg-type]
    succeeds = [(10, "start"), (10, "start"), (30, "success"), 30]
    assert played(make_task(*ROUNDS, starts=2, trials=1000), *succeeds)[-2:] == [(GO_ON, 1, 1)] * 2  # type: ignore[arg-type]
    # a stage without trials of its own, and a single start, go on to the end of the budget
    endless = make_task(NOMINAL, Stage("robust"), starts=2, trials=1000)
    assert played(endless, *once)[-1] == (GO_ON, 1, 1)  # type: ignore[arg-type]
    single = make_task(*ROUNDS, starts=1, trials=1000)
    assert played(single, (10, "promoted"), 30, 30)[-1] == (GO_ON, 1, 0)


def test_a_motion_left_over_from_a_round_in_vain_is_enough_for_the_next() -> None:
    """Two were found and one was started from: the next round may find none."""
    task = make_task(*ROUNDS, starts=2, trials=1000, restart=16)
    assert played(task, (10, "start"), (10, "start"), 30, 16, 16) == [
        (RESTART, 0, 1),
        (FROM_BEST, 1, 1),
        (ROUND, 0, 2),
        (RESTART, 0, 3),
        (FROM_BEST, 1, 3),
    ]


def test_only_the_end_of_the_nominal_stages_finds_a_motion_to_start_from() -> None:
    stages = (Stage("early", robust=False, trials=8), Stage("nominal", robust=False, trials=8), Stage("robust"))
    schedule = Schedule(make_task(*stages, starts=2))
    assert not schedule.finds_start(promoted=True, spent=8)  # another nominal stage follows
    assert schedule.after(Report(8, 8)) is NEXT
    assert not schedule.finds_start(promoted=False, spent=7)
    assert schedule.finds_start(promoted=False, spent=8)
    assert schedule.finds_start(promoted=True, spent=1)
    single = Schedule(make_task(*stages[1:], starts=1))
    assert not single.finds_start(promoted=True, spent=8)


@pytest.mark.parametrize(
    ("stage", "starts", "level"),
    [
        (Stage(hold=True), None, Level(20, robust=False)),
        (Stage(hold=False), None, Level(0, robust=False)),
        (Stage(hold=0.02), None, Level(10, robust=False)),
        (Stage(hold=0.9), None, Level(20, robust=False)),
        (Stage(hold=0.02), 1, Level(10, robust=True)),
        (Stage(hold=True, robust=False), 1, Level(20, robust=False)),
    ],
)
def test_how_a_stage_simulates(stage: Stage, starts: int | None, level: Level) -> None:
    """A hold of 0.04 s in steps of 2 ms."""
    task = make_task(stage, starts=starts)
    assert level_of(task, stage) == level
    assert full_level(task) == Level(20, robust=starts is not None)


def test_which_trials_end_a_stage() -> None:
    """Those within every tolerance; never one that broke down, or whose error is not known."""
    height = np.array([0.05, -0.1, 0.2, 0.0, np.nan, -0.04])
    pitch = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.5])
    diverged = np.array([False, False, False, True, False, False])
    cost = np.array([3.0, 2.0, 1.0, 0.0, 0.5, 0.7])
    evaluation = Evaluation({"z": cost.copy()}, {"height": height, "pitch": pitch}, np.zeros(6, dtype=bool), diverged)
    one = Stage(promote={"height": 0.1})
    assert promoted(one, evaluation).tolist() == [True, True, False, False, False, True]
    assert first_to_end(one, cost, evaluation) == 5
    both = Stage(promote={"height": 0.1, "pitch": 0.1})
    assert promoted(both, evaluation).tolist() == [True, True, False, False, False, False]
    assert first_to_end(both, cost, evaluation) == 1
    none = Stage(trials=8)
    assert not promoted(none, evaluation).any()
    assert first_to_end(none, cost, evaluation) == 3  # ended by its trials: the cheapest of all
