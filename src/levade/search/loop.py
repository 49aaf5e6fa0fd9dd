"""Drive searches to their end: `solve` one, `solve_many` several in lockstep.

    solution = solve(load_task("rearing"), seed=0)
    solution.success, solution.trials_to_success, solution.best.errors

Everything is deterministic. The same task, seed and versions give the same solution to the bit, for any number of threads and
in lockstep with any other searches. A caller may change weights on the way (``steer``). The solution lists these changes as
`levade.tasks.Change`, and a task with these changes gives the same solution again. Given the records of an interrupted solve,
the loop first answers the search from these, and then goes on to the same end.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from levade.errors import LevadeError
from levade.optimizers.blas import single_threaded
from levade.search.evaluation import Evaluation, Record, Trials
from levade.search.initial import InitialGuess
from levade.search.objective import Objective, evaluate_many, make_objective
from levade.search.outcome import Generation, Solution, Stopped
from levade.search.search import Search, Steer
from levade.tasks import Task

Observe = Callable[[Generation], "Stopped | None"]
"""Called after each generation. `Stopped.INTERRUPTED` ends the search with the best motion so far."""


@single_threaded()
def solve(
    task: Task | Objective,
    *,
    seed: int = 0,
    threads: int = 0,
    initial: InitialGuess | None = None,
    observe: Observe | None = None,
    steer: Steer | None = None,
    records: Iterable[Record] = (),
    keep: Callable[[Record], object] | None = None,
) -> Solution:
    """Search for a motion that does the task.

    Args:
        task: The task, or an objective made from one.
        seed: Seed of all random numbers.
        threads: Number of engine threads (0: one per core). Results do not depend on it.
        initial: Weights to begin around.
        observe: Called after each generation, see `Observe`. Ctrl-C ends the search in the same way.
        steer: Changes cost weights, see `levade.search.search.Steer`. It is not called for generations that records answer.
        records: Records of an earlier solve of the same task and seed, in order. The search goes on after them.
        keep: Called with each new record.

    Returns:
        The best trial, and what it took to find it.

    Raises:
        LevadeError: If the parts of the task do not fit together, the records belong to another search, or ``steer`` names a
            cost that the task does not have.
    """
    objective = task if isinstance(task, Objective) else make_objective(task, threads=threads)
    answers = _Answers(objective, records, keep)
    live = None if steer is None else lambda number: None if answers.left else steer(number)
    search = Search(objective.task, objective.space, seed=seed, initial=initial, steer=live)
    while (trials := search.ask()) is not None:
        try:
            evaluation = answers.recorded(trials) or answers.kept(trials, objective.evaluate(trials))
        except KeyboardInterrupt:
            if trials.closing:
                raise
            search.stop()
            continue
        _observed(search, search.tell(evaluation), answers, observe)
    return search.solution


@single_threaded()
def solve_many(
    objectives: Sequence[Objective],
    *,
    seeds: Sequence[int] | None = None,
    initial: Sequence[InitialGuess | None] | None = None,
    observe: Callable[[int, Generation], Stopped | None] | None = None,
) -> list[Solution]:
    """Drive several searches in lockstep and simulate their trials in common batches.

    Args:
        objectives: What to search for. Objectives of one engine share batches, even from different starts.
        seeds: Seed of each search. Defaults to 0 for all.
        initial: Weights that each search begins around, if any.
        observe: Called with the number of a search and each of its generations. Like `Observe`, it may end that search.
            Ctrl-C ends all of them.

    Returns:
        A solution for each objective, with the same bits as `solve` gives for it alone.

    Raises:
        LevadeError: If the numbers of objectives, seeds and initial guesses differ.
    """
    n = len(objectives)
    seeds, initial = seeds or [0] * n, initial or [None] * n
    if not n == len(seeds) == len(initial):
        raise LevadeError(f"solve_many: {n} objectives, {len(seeds)} seeds, {len(initial)} initial; give one of each")
    searches = [
        Search(one.task, one.space, seed=seed, initial=guess)
        for one, seed, guess in zip(objectives, seeds, initial, strict=True)
    ]
    while asked := {i: trials for i, search in enumerate(searches) if (trials := search.ask()) is not None}:
        try:
            evaluations = evaluate_many([(objectives[i], trials) for i, trials in asked.items()])
        except KeyboardInterrupt:
            if all(trials.closing for trials in asked.values()):
                raise
            for i in asked:
                searches[i].stop()
            continue
        interrupted = False
        for i, evaluation in zip(asked, evaluations, strict=True):
            generation = searches[i].tell(evaluation)
            if generation is None or observe is None:
                continue
            try:
                wish = observe(i, generation)
            except KeyboardInterrupt:  # meant for all of them
                interrupted, wish = True, Stopped.INTERRUPTED
            if wish is not None:
                searches[i].stop(wish)
        if interrupted:
            for i in asked:
                searches[i].stop()
    return [search.solution for search in searches]


def _observed(search: Search, generation: Generation | None, answers: _Answers, observe: Observe | None) -> None:
    """Show a generation to the observer, if one is complete, and stop the search if the observer says so."""
    if generation is None:
        return
    generation, answers.fresh = replace(generation, replayed=not answers.fresh), False
    if observe is None:
        return
    try:
        wish = observe(generation)
    except KeyboardInterrupt:
        wish = Stopped.INTERRUPTED
    if wish is not None:
        search.stop(wish)


class _Answers:
    """Answers from records, in order, while any are left. Hands new records to ``keep``."""

    def __init__(
        self, objective: Objective, records: Iterable[Record], keep: Callable[[Record], object] | None
    ) -> None:
        self._terms, self._criteria = objective.terms.keys(), objective.task.success
        self.left = deque(records)
        self.fresh = False
        self._keep, self._count = keep, 0

    def recorded(self, trials: Trials) -> Evaluation | None:
        """Return the record that answers trials, if any is left."""
        if trials.closing or not self.left:
            return None
        record = self.left.popleft()
        self._count += 1
        if record.checksum != trials.checksum or not self._fits(record.evaluation, trials):
            raise LevadeError(
                f"record {self._count} belongs to another search: the task, the seed or a library has changed since;"
                " start again in an empty directory"
            )
        return record.evaluation

    def _fits(self, evaluation: Evaluation, trials: Trials) -> bool:
        """Whether an evaluation has the task's costs and criteria, and a row for each trial."""
        bounded = {name for name, criterion in self._criteria.items() if criterion.target is None}
        names = (evaluation.terms.keys(), evaluation.errors.keys(), evaluation.slack.keys())
        return len(evaluation.success) == trials.n and names == (self._terms, self._criteria.keys(), bounded)

    def kept(self, trials: Trials, evaluation: Evaluation) -> Evaluation:
        """Record a new evaluation and return it."""
        self.fresh = True
        if self._keep is not None and not trials.closing:
            self._keep(Record(trials.checksum, evaluation))
        return evaluation
