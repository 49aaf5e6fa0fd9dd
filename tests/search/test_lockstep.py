"""Several searches at once: each has the same bits as alone, whatever it shares a batch with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from levade.engines import MujocoEngine, Settled, start_state
from levade.errors import LevadeError
from levade.search import (
    Evaluation,
    Generation,
    InitialGuess,
    Objective,
    Search,
    Simulation,
    Solution,
    Stopped,
    Trials,
    solve,
    solve_many,
)
from levade.search.objective import evaluate_many
from levade.tasks import Task, load_task

SMALL = [
    *("search.optimizer=cma", "search.population=6", "horizon=0.06", "hold=0.02", "search.polish=null"),
    *(
        "search.trials=60",
        "success={pitch: {target: 0, tolerance: 0.2}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
    ),
]
STAGED = "stages=[{name: first, trials: 12, hold: false}, {name: full, step: 0.5}]"
FIXED = "robust={samples: 4, measure: cvar, racing: {first: 1, keep: 0.5}}"
REDRAWN = "robust={samples: 3, measure: mean, redraw: generation, required: 0.5}"
NOMINAL_FIRST = "stages=[{name: nominal, robust: false, trials: 12, hold: false}, {name: robust, hold: 0.01}]"


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    return Simulation.of(load_task("rearing", changes=SMALL), threads=1)


@pytest.fixture(scope="module")
def starts(simulation: Simulation) -> list[Simulation]:
    """The task's own start; another place; and the first, a little lower and with one knee bent more."""
    engine, robot, task, own = (
        simulation.engine,
        simulation.robot,
        load_task("rearing", changes=SMALL),
        simulation.start,
    )
    elsewhere = start_state(engine, robot, task.scene, Settled("neutral", x=0.3, y=-0.1, time=0.5))
    qpos = own.qpos[0].copy()
    qpos[2] -= 0.002
    qpos[7 + 2] += 0.01
    bent = engine.layout.state(qpos, own.qvel[0], own.act[0], joint_reference=own.joint_reference[0])
    assert not np.array_equal(bent.joint_position, own.joint_position)
    return [simulation, simulation.starting(elsewhere), simulation.starting(bent)]


def tasks() -> dict[str, Task]:
    return {
        "nominal": load_task("rearing", changes=SMALL),
        "short": load_task("rearing", changes=[*SMALL, "search.trials=12"]),
        "staged": load_task("rearing", changes=[*SMALL, STAGED]),
        "aimed": load_task("rearing", changes=[*SMALL, "search.optimizer=levade"]),
        "fixed": load_task("rearing", changes=[*SMALL, FIXED, NOMINAL_FIRST, "search.trials=110"]),
        "redrawn": load_task("rearing", changes=[*SMALL, REDRAWN, NOMINAL_FIRST, "search.trials=110"]),
    }


CASES = [  # task, start, seed
    *(("nominal", 0, 0), ("nominal", 1, 1), ("nominal", 2, 0), ("short", 0, 2), ("staged", 1, 3), ("aimed", 2, 4)),
    *(("fixed", 1, 5), ("redrawn", 2, 5), ("redrawn", 0, 6)),
]


@pytest.fixture(scope="module")
def objectives(starts: list[Simulation]) -> list[Objective]:
    named = tasks()
    return [Objective(starts[start], named[name]) for name, start, _ in CASES]


@pytest.fixture
def batches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Roll-outs of each batch that an engine simulates."""
    made: list[int] = []
    rollout = MujocoEngine.rollout

    def count(self: MujocoEngine, *arguments, **options):
        out = rollout(self, *arguments, **options)
        made.append(out.n)
        return out

    monkeypatch.setattr(MujocoEngine, "rollout", count)
    return made


def assert_same(one: Solution, other: Solution) -> None:
    np.testing.assert_array_equal(one.best.weights, other.best.weights)
    assert {**vars(one.best), "weights": None} == {**vars(other.best), "weights": None}
    assert {**vars(one), "best": None} == {**vars(other), "best": None}


@pytest.mark.slow
def test_each_has_the_same_bits_as_alone_and_batches_are_shared(
    objectives: list[Objective], batches: list[int]
) -> None:
    seeds = [seed for *_, seed in CASES]
    seen: list[list[Generation]] = [[] for _ in CASES]
    together = solve_many(objectives, seeds=seeds, observe=lambda i, g: seen[i].append(g))
    shared, rollouts = len(batches), sum(batches)
    batches.clear()
    for i, (objective, seed) in enumerate(zip(objectives, seeds, strict=True)):
        generations: list[Generation] = []
        alone = solve(Objective(objective.simulation, objective.task), seed=seed, observe=generations.append)
        assert_same(together[i], alone)
        assert [g.cost.tolist() for g in seen[i]] == [g.cost.tolist() for g in generations], CASES[i]
        assert [g.trials for g in seen[i]] == [g.trials for g in generations]
    assert sum(batches) == rollouts
    assert 2 * shared < len(batches)
    assert len({(solution.best.weights.tobytes(), solution.best.cost) for solution in together}) == len(CASES)
    assert {solution.stopped for solution in together} == {Stopped.BUDGET}
    assert together[3].trials == 12 < min(together[i].trials for i in range(3))


@pytest.mark.slow
def test_one_that_an_observer_ends_leaves_the_others_as_they_are(objectives: list[Objective]) -> None:
    three = objectives[:3]
    stopped = solve_many(
        three, seeds=[0, 1, 2], observe=lambda i, g: Stopped.INTERRUPTED if (i, g.generation) == (1, 2) else None
    )
    assert [solution.stopped for solution in stopped] == ["budget", "interrupted", "budget"]
    assert [solution.generations for solution in stopped] == [10, 2, 10]
    assert_same(stopped[2], solve(three[2], seed=2))


def test_ctrl_c_ends_all_with_the_best_so_far(objectives: list[Objective], monkeypatch: pytest.MonkeyPatch) -> None:
    calls = 0

    def third_fails(asked: list[tuple[Objective, Trials]]) -> list[Evaluation]:
        nonlocal calls
        calls += 1
        if calls == 3:
            raise KeyboardInterrupt
        return evaluate_many(asked)

    monkeypatch.setattr("levade.search.loop.evaluate_many", third_fails)
    solutions = solve_many([objectives[0], objectives[3], objectives[7]])
    # the second had ended by itself; the third asks for its best on the perturbed models
    assert [solution.stopped for solution in solutions] == ["interrupted", "budget", "interrupted"]
    assert [solution.generations for solution in solutions] == [2, 2, 2]
    assert solutions[2].best.share is not None


@pytest.mark.slow
def test_each_may_begin_around_its_own_motion(objectives: list[Objective]) -> None:
    rng, two = np.random.default_rng(0), objectives[:2]
    guess = InitialGuess(two[1].space.mean + 0.05 * rng.normal(size=(2, two[1].space.mean.size)), step=0.5)
    together = solve_many(two, seeds=[0, 1], initial=[None, guess])
    assert_same(together[0], solve(two[0], seed=0))
    assert_same(together[1], solve(two[1], seed=1, initial=guess))


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(1, "nominal"), (3, "nominal"), (200, "nominal"), (2, "fixed")])
def test_trials_of_several_have_the_bits_that_they_have_alone(
    objectives: list[Objective], shape: tuple[int, str]
) -> None:
    """Also where there are more roll-outs than go into one batch."""
    n, kind = shape
    chosen = objectives[:3] if kind == "nominal" else objectives[6:]
    rng = np.random.default_rng(n)
    asked = []
    for seed, objective in enumerate(chosen):
        trials = Trials(objective.space.mean + 0.1 * rng.normal(size=(n, objective.policy.size)), 5, seed=seed)
        if kind == "fixed":
            pairs = (np.repeat(np.arange(n), 3), np.tile(np.arange(3), n))
            trials = replace(trials, draw=0, pairs=pairs)
        asked.append((objective, trials))
    for found, (objective, trials) in zip(evaluate_many(asked), asked, strict=True):
        alone = objective.evaluate(trials)
        assert len(found.success) == trials.n
        for table in ("terms", "errors", "slack"):
            for name, values in getattr(found, table).items():
                np.testing.assert_array_equal(values, getattr(alone, table)[name], err_msg=name)
        np.testing.assert_array_equal(found.success, alone.success)


@pytest.mark.parametrize("given", [{"seeds": [0]}, {"initial": [None]}, {"seeds": [0, 1, 2]}])
def test_one_seed_and_one_guess_for_each(objectives: list[Objective], given: dict[str, list]) -> None:
    with pytest.raises(LevadeError, match=r"solve_many: 2 objectives, \d seeds, \d initial; give one of each"):
        solve_many(objectives[:2], **given)


def test_none_at_all_is_none_found() -> None:
    assert solve_many([]) == []


@pytest.mark.slow
def test_ctrl_c_in_an_observer_ends_all_with_the_best_so_far(simulation: Simulation) -> None:
    objectives = [Objective(simulation, task) for task in (tasks()["nominal"], tasks()["short"])]

    def observe(number: int, generation: Generation) -> None:
        if number == 0 and generation.generation == 2:
            raise KeyboardInterrupt

    found = solve_many(objectives, seeds=[0, 1], observe=observe)
    assert [one.stopped for one in found] == [Stopped.INTERRUPTED] * 2
    assert [one.generations for one in found] == [2, 2]


@pytest.mark.slow
def test_a_search_that_dies_is_not_said_to_be_running(simulation: Simulation) -> None:
    objective = Objective(simulation, tasks()["nominal"])

    class Boom(Exception):
        pass

    def steer(number: int) -> None:
        if number == 2:
            raise Boom

    search = Search(objective.task, objective.space, seed=0, steer=steer)
    with pytest.raises(Boom):  # noqa: PT012
        while (trials := search.ask()) is not None:
            search.tell(objective.evaluate(trials))
    assert search.solution.stopped is Stopped.INTERRUPTED
    assert search.solution.generations == 1
    assert search.ask() is None
