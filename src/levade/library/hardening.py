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
    if not objectives or _trials(objectives[0].task) < _LEAST:
        return [None] * len(objectives)
    asked = [one.with_task(_hard(one.task)) for one in objectives]
    guesses = [InitialGuess(one, step=_STEP) for one in weights]
    found = solve_many(asked, seeds=seeds, initial=guesses, observe=observe)
    return [replace(one, best=replace(one.best, success=one.best.met)) for one in found]


def _trials(task: Task) -> int:
    return min(_TRIALS, task.search.trials)


def _hard(task: Task) -> Task:
    search = replace(task.search, trials=_trials(task), restart=None, patience=None, polish=0)
    robust = replace(_ROBUST, success=task.good_enough)  # so that success on the model is reported separately
    return replace(task, robust=robust, stages=(Stage(hold=_HOLD),), search=search)
