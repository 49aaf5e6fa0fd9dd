"""Motions made to work on robots that differ: a search from one that works on the model, judged on perturbed models.

    better = harden(objectives, weights, seeds)

A motion that was found on the model alone works from its own fall on half to all of the robots that differ, and from as many
falls nearby. What is searched for here is less a better motion than one that is far from where it fails.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from levade.arrays import Array
from levade.search import Generation, InitialGuess, Objective, Solution, Stopped, solve_many
from levade.tasks import Stage, Task
from levade.tasks.robust import Racing, Robust

_STEP = 0.3
"""Of the initial step size: it begins at a motion that works."""

_TRIALS, _SHARE = 1000, 0.4
"""Roll-outs for one motion at most, also as a share of those of the task's own search."""

_LEAST = 100
"""Roll-outs that are worth it: fewer are not one generation on perturbed models."""

_ROBUST = Robust(
    samples=16, measure="mean", redraw="generation", validation=48, required=1.0, racing=Racing(first=2, keep=0.25)
)
"""Two samples tell which quarter of the candidates runs all sixteen; the best has to work on the 48 that stay the same."""


def harden(
    objectives: Sequence[Objective],
    weights: Sequence[Array],
    *,
    seeds: Sequence[int],
    observe: Callable[[int, Generation], Stopped | None],
) -> list[Solution | None]:
    """Search on from motions that work, until they do on nearly every perturbed model.

    Args:
        objectives: What each motion does.
        weights: The motions, shape (1, d) each.
        seeds: Seed of each search.
        observe: As in `levade.search.solve_many`.

    Returns:
        For each a solution, whose best motion works on most of the perturbed models, maybe the one that was given. It succeeds
        if it does on the model what is asked there. None where the task is too small for it.
    """
    if not objectives or _trials(objectives[0].task) < _LEAST:
        return [None] * len(objectives)
    asked = [one.with_task(_hard(one.task)) for one in objectives]
    guesses = [InitialGuess(one, step=_STEP) for one in weights]
    found = solve_many(asked, seeds=seeds, initial=guesses, observe=observe)
    return [replace(one, best=replace(one.best, success=one.best.met)) for one in found]


def _trials(task: Task) -> int:
    return min(_TRIALS, int(_SHARE * task.search.trials))


def _hard(task: Task) -> Task:
    search = replace(task.search, trials=_trials(task), restart=None, patience=None, polish=0)
    robust = replace(_ROBUST, success=task.success)  # so that what is asked on the model is said apart
    return replace(task, robust=robust, stages=(Stage(),), search=search)
