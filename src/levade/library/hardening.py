"""Make motions robust: search on from a motion that works on the model, and judge candidates on perturbed models.

    better = harden(objectives, weights, seeds)

A motion that was found on the model alone works from its own fall on between half and all of the perturbed models. It works
from a similar share of the falls nearby. This search looks less for a better motion than for one that is far from failure.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from levade.arrays import Array
from levade.search import Generation, InitialGuess, Objective, Solution, Stopped, solve_many
from levade.tasks import Stage, Task
from levade.tasks.robust import Racing, Robust

_STEP = 0.3
"""Factor on the initial step size, which is small because the search begins at a motion that works."""

_TRIALS, _LEAST = 3000, 250
"""Most roll-outs for one motion; and the fewest, in the task's own search, that are worth one: they make two generations."""

_HOLD = 0.5
"""Simulated part of the hold [s]. A motion that is about to fall shows it by then."""

_ROBUST = Robust(
    samples=16, measure="mean-log", redraw="generation", validation=48, required=1.0, racing=Racing(first=2, keep=0.25)
)
"""Two samples decide which quarter of the candidates runs all sixteen. The best has to work on 48 fixed samples."""

_SAMPLES = 3
"""Fixed samples, one after another, on all of which a motion has to work: one alone it passes by chance, if it fails on 5 %."""


def harden(
    objectives: Sequence[Objective],
    weights: Sequence[Array],
    *,
    seeds: Sequence[int],
    observe: Callable[[int, Generation], Stopped | None],
) -> list[Solution | None]:
    """Search on from motions that work on the model, until they work on nearly every perturbed model.

    Args:
        objectives: Objective of each motion.
        weights: Weights of the motions, shape (1, d) each.
        seeds: Seed of each search.
        observe: Observer, as in `levade.search.solve_many`.

    Returns:
        One solution per motion. Its best motion works on most of the perturbed models; it may be the given one. The solution
        counts as a success if the motion meets the criteria on the model. None if the task's budget is too small.
    """
    if not objectives or not affords(objectives[0].task):
        return [None] * len(objectives)
    found: dict[int, Solution] = {}
    left, around, budget = list(range(len(objectives))), list(weights), [_trials(one.task) for one in objectives]
    for number in range(_SAMPLES):
        again = solve_many(
            [objectives[i].with_task(_hard(objectives[i].task, budget[i])) for i in left],
            seeds=[seeds[i] + number for i in left],
            initial=[InitialGuess(around[i], step=_STEP) for i in left],
            observe=_named(observe, left),
        )
        for i, one in zip(left, again, strict=True):
            found[i], around[i], budget[i] = one, one.best.weights[None], budget[i] - one.trials
        left = [i for i in left if found[i].stopped == Stopped.SUCCESS and budget[i] >= _LEAST]
        if not left:
            break
    return [
        replace(one, best=replace(one.best, success=one.best.met), trials=_trials(objectives[i].task) - budget[i])
        for i, one in sorted(found.items())
    ]


def affords(task: Task) -> bool:
    """Return whether a task's budget is large enough to harden its motions.

    Args:
        task: The task.
    """
    return _trials(task) >= _LEAST


def _named(
    observe: Callable[[int, Generation], Stopped | None], numbers: Sequence[int]
) -> Callable[[int, Generation], Stopped | None]:
    """Observe searches of some of the objectives by the objectives' own numbers."""
    own = tuple(numbers)
    return lambda number, generation: observe(own[number], generation)


def _trials(task: Task) -> int:
    return min(_TRIALS, task.search.trials)


def _hard(task: Task, trials: int) -> Task:
    search = replace(task.search, trials=trials, restart=None, patience=None, polish=0)
    robust = replace(_ROBUST, success=task.on_others)  # so that success on the model is reported separately
    return replace(task, robust=robust, stages=(Stage(hold=_HOLD),), search=search)
