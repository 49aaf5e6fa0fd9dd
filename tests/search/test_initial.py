"""A search that begins around earlier motions: which it takes, what it counts, and that it resumes to the same bytes."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from levade.costs import Criterion, Position
from levade.errors import LevadeError
from levade.optimizers import SearchSpace
from levade.search import (
    Evaluation,
    Generation,
    InitialGuess,
    Search,
    Stopped,
    Trials,
    make_objective,
    solve,
)
from levade.search.optimizing import make_attempt
from levade.search.run import read_run, resume, run
from levade.tasks import Cost, Task, load_task
from levade.tasks import Search as Settings

SPACE = SearchSpace(np.zeros(6), step=0.5, population=8)
FAR, NEAR, NEARER = np.full(6, 3.0), np.full(6, 0.2), np.full(6, -0.1)


def make_task(tolerance: float = 0.0, **search: Any) -> Task:
    return Task(
        name="made up",
        horizon=0.1,
        costs={"position": Cost(Position(z=0.5), 2.0)},
        success={"height": Criterion("height", target=0.5, tolerance=tolerance)},
        search=Settings(**{"optimizer": "cma", "trials": 64, "polish": None, **search}),
    )


def answer(task: Task, trials: Trials) -> Evaluation:
    """Cheapest at zero; a success is a first weight near 3."""
    terms, off = {"position": (trials.weights**2).sum(axis=1)}, trials.weights[:, 0] - 3.0
    within = np.abs(off) <= (task.success["height"].tolerance or 0.0) - 1e-9
    return Evaluation(terms, {"height": off}, within, np.zeros(trials.n, dtype=bool))


def begun(search: Search) -> tuple[Trials, Generation | None, Trials | None]:
    """What is asked for first, whether that is a generation, and what is asked for next."""
    first = search.ask()
    assert first is not None
    return first, search.tell(answer(search.task, first)), search.ask()


def test_the_best_of_several_is_begun_around() -> None:
    """All are tried, the optimizer begins around the cheapest, and the cheapest is the best so far."""
    task, candidates = make_task(), np.stack([FAR, NEARER, NEAR])
    search = Search(task, SPACE, seed=5, initial=InitialGuess(candidates))
    first, generation, second = begun(search)
    np.testing.assert_array_equal(first.weights, candidates)
    assert (generation, first.closing, first.draw) == (None, False, None)
    np.testing.assert_array_equal(search.solution.best.weights, NEARER)
    assert (search.solution.trials, search.solution.generations) == (3, 0)
    assert second is not None
    around = make_attempt(task, replace(SPACE, mean=NEARER), seed=5).ask()
    np.testing.assert_array_equal(second.weights, around)


def test_a_success_is_begun_around_though_another_is_cheaper() -> None:
    task = make_task(tolerance=0.1)
    search = Search(task, SPACE, seed=5, initial=InitialGuess(np.stack([NEARER, FAR])))
    _, _, second = begun(search)
    assert second is not None
    np.testing.assert_array_equal(second.weights, make_attempt(task, replace(SPACE, mean=FAR), seed=5).ask())
    assert search.solution.success
    np.testing.assert_array_equal(search.solution.best.weights, FAR)


def test_step_and_factor_of_a_guess_are_those_of_the_optimizer() -> None:
    factor = np.eye(6)[:, :2]  # only two of six directions
    search = Search(make_task(), SPACE, initial=InitialGuess(NEAR[None], step=1e-3, factor=factor))
    _, _, second = begun(search)
    assert second is not None
    off = second.weights - NEAR
    np.testing.assert_array_equal(off[:, 2:], 0.0)
    assert 0 < np.abs(off[:, :2]).max() < 0.5 * 1e-3 * 5
    expected = make_attempt(make_task(), replace(SPACE, mean=NEAR, factor=factor, step=0.5 * 1e-3), seed=0).ask()
    np.testing.assert_array_equal(second.weights, expected)


def test_a_success_at_once_ends_the_search_if_it_is_not_polished() -> None:
    search = Search(make_task(tolerance=0.1, polish=0), SPACE, initial=InitialGuess(np.stack([NEARER, FAR])))
    _, generation, second = begun(search)
    assert (generation, second) == (None, None)
    solution = search.solution
    assert (solution.stopped, solution.trials, solution.trials_to_success, solution.generations) == ("success", 2, 2, 0)
    np.testing.assert_array_equal(solution.best.weights, FAR)


@pytest.mark.parametrize(("polish", "generations"), [(1, 1), (8, 1), (9, 2), (None, 7)])
def test_a_success_at_once_is_polished_as_long_as_the_task_says(polish: int | None, generations: int) -> None:
    """Within 64 trials, of which the guess has been two."""
    search = Search(make_task(tolerance=0.1, polish=polish), SPACE, initial=InitialGuess(np.stack([NEARER, FAR])))
    while (trials := search.ask()) is not None:
        search.tell(answer(search.task, trials))
    assert search.solution.generations == generations
    assert search.solution.trials == 2 + 8 * generations
    assert search.solution.trials_to_success == 2


def test_stopped_before_the_guess_is_told_it_ends_with_the_mean() -> None:
    search = Search(make_task(), SPACE, initial=InitialGuess(NEAR[None]))
    search.stop()
    asked = search.ask()
    assert asked is not None
    assert asked.closing
    search.tell(answer(search.task, asked))
    np.testing.assert_array_equal(search.solution.best.weights, SPACE.mean)


@pytest.mark.parametrize(
    ("candidates", "step", "message"),
    [
        (np.zeros(6), 1.0, r"finite numbers of shape \(motions, d\), got shape \(6,\)"),
        (np.zeros((0, 6)), 1.0, r"got shape \(0, 6\)"),
        (np.full((2, 6), np.nan), 1.0, r"finite numbers"),
        (np.zeros((1, 6)), 0.0, r"the factor on the step is 0.0; give a positive number"),
        (np.zeros((1, 6)), np.inf, r"the factor on the step is inf"),
    ],
)
def test_guesses_that_are_wrong(candidates: np.ndarray, step: float, message: str) -> None:
    with pytest.raises(LevadeError, match=message):
        InitialGuess(candidates, step)


def test_a_guess_of_another_size_is_refused_at_once() -> None:
    with pytest.raises(LevadeError, match=r"initial: weights have shape \(2, 5\), should be \(k, 6\)"):
        Search(make_task(), SPACE, initial=InitialGuess(np.zeros((2, 5))))


@pytest.mark.parametrize("factor", [None, np.random.default_rng(1).normal(size=(6, 3))])
def test_a_guess_survives_json_to_the_bit(factor: np.ndarray | None) -> None:
    guess = InitialGuess(np.random.default_rng(0).normal(size=(2, 6)) * 1e-7, 1 / 3, factor)
    again = InitialGuess.from_json(json.loads(json.dumps(guess.to_json(), allow_nan=False)))
    assert again.candidates.tobytes() == guess.candidates.tobytes()
    assert again.step == guess.step
    assert (again.factor is None) == (factor is None)
    if factor is not None and again.factor is not None:
        np.testing.assert_array_equal(again.factor, factor)


SMALL = [
    *(
        "search.optimizer=cma",
        "search.population=6",
        "search.trials=40",
        "horizon=0.06",
        "hold=0.02",
        "search.polish=null",
    ),
    "success={pitch: {target: 0, tolerance: 0}, height: {target: 0.57, tolerance: 5 cm, at: end}}",
]
STAGED = "stages=[{name: first, trials: 12, hold: false}, {name: full, step: 0.5}]"
ROBUST = (
    "robust={samples: 3, measure: mean, redraw: generation, required: 0.5}",
    "stages=[{name: nominal, robust: false, trials: 12, hold: false}, {name: robust, hold: 0.01}]",
    "search.trials=120",
)


@pytest.mark.slow
@pytest.mark.parametrize("more", [(STAGED,), ROBUST])
def test_a_run_that_began_around_motions_resumes_to_the_same_bytes(
    more: tuple[str, ...], tmp_path: Path, assert_same_files: Callable[[Path, Path], None]
) -> None:
    """Interrupted while the guess is tried, right after it, and later."""
    made = make_objective(load_task("rearing", changes=[*SMALL, *more]), threads=1)
    rng = np.random.default_rng(3)
    guess = InitialGuess(made.space.mean + 0.05 * rng.normal(size=(3, made.policy.size)), 0.4)
    whole = run(made, seed=2, directory=tmp_path / "whole", initial=guess)
    plain = solve(made, seed=2)
    assert not np.array_equal(plain.best.weights, whole.solution.best.weights)
    assert whole.solution.generations >= 3
    for place in (0, 1, 2, 4):
        part, calls = made.with_task(made.task), 0

        def stops(trials: Trials, *, place: int = place) -> Evaluation:
            nonlocal calls
            calls += 1
            if calls == place + 1:
                raise KeyboardInterrupt
            return made.evaluate(trials)

        part.evaluate = stops  # type: ignore[method-assign, assignment]
        directory = tmp_path / str(place)
        outcome = run(part, seed=2, directory=directory, initial=guess)
        assert outcome.solution.stopped is Stopped.INTERRUPTED
        assert len(read_run(directory)[1].records) == place
        resume(directory, threads=2)
        assert_same_files(directory, tmp_path / "whole")
