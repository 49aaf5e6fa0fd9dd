"""A search as an object: `Search.ask` says what to simulate, `Search.tell` takes the results.

    search = Search(task, space, seed=0)
    while (trials := search.ask()) is not None:
        generation = search.tell(objective.evaluate(trials))    # a Generation if one is complete, else None
    search.solution.best.weights

A search knows no engine and no robot: optimizer, schedule and judge meet here and nowhere else. The same task, space, seed and
answers give the same questions to the bit.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from dataclasses import replace

import numpy as np

from levade.arrays import Array
from levade.costs import DIVERGED
from levade.errors import LevadeError
from levade.optimizers import Optimizer, SearchSpace, uses_errors
from levade.search.evaluation import Evaluation, Gains, Trials
from levade.search.initial import AROUND, InitialGuess
from levade.search.optimizing import make_attempt
from levade.search.outcome import Generation, Solution, Stopped, Trial, better
from levade.search.repair import Repair
from levade.search.robust import Judge
from levade.search.schedule import Level, Move, Report, Schedule, first_to_end, full_level, level_of, promoted
from levade.search.weighing import cost_weights, missed, stage_weights
from levade.tasks import Change, Task, looks_at_hold

Steer = Callable[[int], "Mapping[str, float] | Stopped | None"]
"""Called before each generation with its number. It may return cost -> factor on its weight, which holds from this generation
on. `Stopped.INTERRUPTED` ends the search."""

_SKETCHES = 1_936_419_188
"""Separates the random numbers of sketches from those of the optimizers."""

POLISH = 0.5
"""Factor on the step once a trial has succeeded, if the search refines from there on."""

_AT_ONCE = 48
"""Largest number of motions to begin around that are tried in one batch. Ctrl-C is heard between batches."""

_Asking = Generator["Trials | Generation", Evaluation, None]


class _Halt(Exception):
    """Ends the loop from outside, whatever it is asking for."""

    def __init__(self, reason: Stopped) -> None:
        super().__init__(reason)
        self.reason = reason


class Search:
    """One search for a motion.

    Args:
        task: The task: what to achieve, and how to search for it.
        space: Where the optimizer begins.
        seed: Seed of all random numbers.
        initial: Motions or weights to begin around, instead of the space's mean.
        steer: Changes cost weights, see `Steer`.

    Raises:
        LevadeError: If the optimizer's settings are wrong, or the initial guess has another number of weights.
    """

    def __init__(
        self,
        task: Task,
        space: SearchSpace,
        *,
        seed: int = 0,
        initial: InitialGuess | None = None,
        steer: Steer | None = None,
    ) -> None:
        if initial is not None and initial.candidates.shape[1] != space.size:
            raise LevadeError(f"initial: weights have shape {initial.candidates.shape}, should be (k, {space.size})")
        self._task, self._space, self._seed, self._initial, self._steer = task, space, seed, initial, steer
        self._schedule = Schedule(task)
        self._judge = Judge(task, seed)
        self._optimizer: Optimizer = make_attempt(task, space, seed=seed)
        self._repair = Repair(space.factor, np.array([one.target is None for one in task.success.values()], dtype=bool))
        self._weights = cost_weights(task, 0)
        self._best: Trial | None = None
        self._kept: Trial | None = None  # the best of earlier rounds
        self._starts: list[Trial] = []  # motions of the nominal model to start robust stages from
        self._trials = self._generations = self._diverged = 0
        self._trials_to_success: int | None = None
        self._regulated: int | None = None  # generation in these robust stages that last made gains
        self._stopped = Stopped.RUNNING
        self._asking: _Asking = self._run()
        self._event: Trials | Generation | None = None
        self._begun = False

    @property
    def task(self) -> Task:
        """The task, with the changes of cost weights so far."""
        return self._task

    @property
    def solution(self) -> Solution:
        """The solution; an interim one while the search goes on.

        Raises:
            LevadeError: If no trial has been told yet.
        """
        if self._best is None:
            raise LevadeError("search: no trial has been told yet; ask and tell first")
        return Solution(
            best=better(self._kept, self._best),
            trials=self._trials,
            generations=self._generations,
            trials_to_success=self._trials_to_success,
            diverged=self._diverged,
            stopped=self._stopped,
            cost_weights=self._weights,
            changes=self._task.search.changes,
            initial=self._begun_around,
        )

    @property
    def _begun_around(self) -> int:
        return 0 if self._initial is None else len(self._initial.candidates)

    def ask(self) -> Trials | None:
        """Return the trials to simulate next.

        Returns:
            The trials, the same again until their results are told. None once the search has ended.
        """
        if not self._begun or isinstance(self._event, Generation):
            self._advance(lambda: next(self._asking))
        assert not isinstance(self._event, Generation)
        return self._event

    def tell(self, evaluation: Evaluation) -> Generation | None:
        """Take the results of the trials just asked for.

        Args:
            evaluation: Results of the trials, in their order.

        Returns:
            The state of the search if this completes a generation, else None.

        Raises:
            RuntimeError: If nothing was asked for.
            ValueError: If the evaluation has another number of trials.
        """
        asked = self._event
        if not isinstance(asked, Trials):
            raise RuntimeError("tell: no trials were asked for; ask first")
        if len(evaluation.success) != asked.n:
            raise ValueError(f"tell: {asked.n} trials were asked for, the evaluation has {len(evaluation.success)}")
        self._advance(lambda: self._asking.send(evaluation))
        return self._event if isinstance(self._event, Generation) else None

    def stop(self, reason: Stopped = Stopped.INTERRUPTED) -> None:
        """End the search. It may still ask for trials, to judge its best motion as the task does.

        Args:
            reason: Why it ends.
        """
        if not self._begun:
            self.ask()
        if self._stopped is Stopped.RUNNING:
            self._advance(lambda: self._asking.throw(_Halt(reason)))

    def _advance(self, step: Callable[[], Trials | Generation]) -> None:
        self._begun = True
        try:
            self._event = step()
        except StopIteration:
            self._event = None
        except BaseException:  # the generator has ended with it
            self._event, self._stopped = None, Stopped.INTERRUPTED
            raise

    def _run(self) -> _Asking:
        try:
            yield from self._begin()
            while self._affordable():
                yield from self._reweigh()
                yield from self._regulate()
                report = yield from self._generation()
                before = self._schedule.level
                yield from self._follow(self._schedule.after(report), before)
            self._stopped = Stopped.BUDGET
        except _Halt as halt:
            self._stopped = halt.reason
        except KeyboardInterrupt:
            self._stopped = Stopped.INTERRUPTED
        yield from self._close()

    def _begin(self) -> _Asking:
        """Enter the first stage, around the initial guess or the best sketch if there are any."""
        if self._initial is not None:
            yield from self._try_initial(self._initial)
        elif self._task.search.sketches:  # without any, the first optimizer is already there
            yield from self._begin_attempt()
        self._scale_step()

    def _begin_attempt(self) -> _Asking:
        """Let the optimizer begin where the task's search does: around the best of its sketches, if it has any."""
        attempt, search = self._schedule.attempt, self._task.search
        if not search.sketches:
            self._optimizer = make_attempt(self._task, self._space, seed=self._seed, attempt=attempt)
            return
        generator = np.random.default_rng((self._seed, attempt, _SKETCHES))
        n = max(1, min(search.sketches, (search.trials - self._trials) // 2))  # the rest is for the optimizer
        yield from self._try_initial(InitialGuess(self._space.sketches(n, generator), step=AROUND))

    def _try_initial(self, initial: InitialGuess) -> _Asking:
        """Try the motions to begin around, and let the optimizer begin at the best of them."""
        candidates, ranks = initial.candidates, []
        weights = {**self._weights, **stage_weights(self._task, self._schedule.stage, 0)}
        for first in range(0, len(candidates), _AT_ONCE):
            part = candidates[first : first + _AT_ONCE]
            evaluation = yield from self._judge.evaluate(part, self._schedule.level)
            self._trials += evaluation.trials
            self._diverged += int(evaluation.diverged.sum())
            if self._trials_to_success is None and evaluation.success.any():
                self._trials_to_success = self._trials
            self._keep_best(part, evaluation)
            ranks += zip(~evaluation.success, evaluation.cost(weights, self._task.robust), strict=True)
            if self._trials_to_success is not None and self._task.search.polish == 0:
                raise _Halt(Stopped.SUCCESS)
        best = min(range(len(candidates)), key=ranks.__getitem__)
        space = initial.space(self._space, candidates[best])
        self._optimizer = make_attempt(self._task, space, seed=self._seed, attempt=self._schedule.attempt)

    def _affordable(self) -> bool:
        """Whether the budget lasts for the largest possible generation. It always does for the first one."""
        most = self._judge.most(self._optimizer.population, self._schedule.level)
        return self._trials + most <= max(self._task.search.trials, most)

    def _reweigh(self) -> _Asking:
        """Before a generation, take in changed cost weights, from the task or from ``steer``."""
        number = self._generations + 1
        factors = None if self._steer is None else self._steer(number)
        if isinstance(factors, Stopped):
            raise _Halt(factors)
        if factors:
            self._task = self._task.changed(Change(number, dict(factors)))
        before, self._weights = self._weights, cost_weights(self._task, number)
        if self._weights != before:
            yield from self._weigh_best_again()
            self._forget_costs()

    def _regulate(self) -> _Asking:
        """Make the gains of the task's feedback along the best motion, if they are due.

        New gains stay only if the motion ranks no lower than with the earlier ones. The first gains are those of the design
        with which it ranks highest, and are compared with no feedback.
        """
        feedback, level, best = self._task.feedback, self._schedule.level, self._best
        if feedback is None or not level.robust or best is None:
            return
        since = feedback.every if self._regulated is None else self._generations - self._regulated
        earlier = self._judge.gains
        if since < feedback.every or (earlier is not None and np.array_equal(earlier.along, best.weights)):
            return
        self._regulated = self._generations
        for design in range(len(feedback.designs)) if earlier is None else (earlier.design,):
            assert self._best is not None
            judge = replace(self._judge, gains=Gains(best.weights, design))
            evaluation = yield from judge.evaluate(best.weights[None], level, best=self._best)
            self._trials += evaluation.trials
            cost = float(evaluation.cost(self._weights, self._task.robust)[0])
            again = Trial.of(best.weights, cost, evaluation, 0, judge.gains)
            if self._best.share is None or again.rank <= self._best.rank:
                self._judge, self._best = judge, again
                if self._trials_to_success is None and again.success:
                    self._trials_to_success = self._trials
        if self._judge.gains is not earlier:
            self._forget_costs()

    def _generation(self) -> Generator[Trials | Generation, Evaluation, Report]:
        """Ask for the candidates of a generation, tell the optimizer, keep the best, and report."""
        task, schedule, optimizer = self._task, self._schedule, self._optimizer
        number, stage, level = self._generations + 1, schedule.stage, schedule.level
        candidates = optimizer.ask()
        weights = {**self._weights, **stage_weights(task, schedule.stage, number)}
        mean = optimizer.mean if task.robust is not None and task.robust.contender == "mean" else None
        evaluation = yield from self._judge.evaluate(candidates, level, generation=number, racing=weights)
        cost = evaluation.cost(weights, task.robust)
        ends = bool(promoted(stage, evaluation).any())
        validated, contenders, start = None, candidates, None
        if level.robust and task.robust is not None and task.robust.redraw == "generation":
            if mean is not None:
                self._repair.tell(candidates, missed(task, evaluation))
            contenders = (candidates[np.argmin(cost)] if mean is None else self._repair.repaired(mean))[None]
            validated = yield from self._judge.evaluate(contenders, level, best=self._best)
        elif schedule.finds_start(promoted=ends, spent=evaluation.trials):
            first = first_to_end(stage, cost, evaluation)
            found = candidates[first : first + 1]
            validated = yield from self._judge.evaluate(found, full_level(task))
            start = Trial.of(found[0], float(validated.cost(self._weights, task.robust)[0]), validated, 0)
            contenders = found if start.success else candidates
        _tell(optimizer, task, cost, evaluation)

        spent = evaluation.trials + (0 if validated is None else validated.trials)
        self._generations += 1
        self._trials += spent
        self._diverged += int(evaluation.diverged.sum())
        judged = validated if validated is not None and (start is None or start.success) else evaluation
        if self._trials_to_success is None and judged.success.any():
            self._trials_to_success = self._trials
            if self._refines:
                optimizer.scale_step(POLISH)
        self._starts += [start] if start is not None else []
        self._keep_best(contenders, judged, self._judge.gains)
        yield self._state(cost, evaluation, validated)
        return Report(
            spent,
            self._trials,
            self._trials_to_success,
            promoted=ends,
            found_start=start is not None,
            cost=float(cost.min()),
        )

    @property
    def _refines(self) -> bool:
        """Whether the search goes on around its first success, in steps that are still long for that.

        It does not on perturbed models, before the last stage, or with one generation left. A stage's own factor has already
        shortened the steps. Steps that have grown say that the search is still on its way.
        """
        task, schedule, optimizer = self._task, self._schedule, self._optimizer
        if task.robust is not None or schedule.number + 1 < len(task.stages) or schedule.stage.step != 1.0:
            return False
        polish = task.search.polish
        return optimizer.step <= self._space.step and (polish is None or polish > optimizer.population)

    def _state(self, cost: Array, evaluation: Evaluation, validated: Evaluation | None) -> Generation:
        assert self._best is not None
        return Generation(
            generation=self._generations,
            stage=self._schedule.number,
            stage_name=self._schedule.stage.name,
            trials=self._trials,
            cost=cost,
            step=self._optimizer.step,
            diverged=int(evaluation.diverged.sum()),
            best=better(self._kept, self._best),
            trials_to_success=self._trials_to_success,
            cost_weights=self._weights,
            changes=self._task.search.changes,
            starts=tuple(start.share or 0.0 for start in self._starts),
            evaluation=evaluation,
            validated=validated,
            total_diverged=self._diverged,
            initial=self._begun_around,
        )

    def _follow(self, move: Move, before: Level) -> _Asking:
        """Carry out a move of the schedule. The schedule has already entered its stage; ``before`` is the level it left."""
        if move is Move.STOP:
            raise _Halt(Stopped.SUCCESS)
        if move is Move.GO_ON:
            return
        if move is Move.FROM_BEST_START:
            self._best = min(self._starts, key=_rank)
            space = replace(self._space, mean=self._best.weights)
            self._optimizer = make_attempt(
                self._task, space, seed=self._seed, attempt=self._schedule.attempt + 1, around=True
            )
        elif move in (Move.RESTART, Move.NEW_ROUND):
            if move is Move.NEW_ROUND:
                assert self._best is not None
                self._kept = better(self._kept, self._best)
                self._starts = sorted(self._starts, key=_rank)[1:]
            yield from self._begin_attempt()
        self._scale_step()
        level = self._schedule.level
        if not level.robust:
            self._judge, self._regulated = replace(self._judge, gains=None), None
        self._forget_costs(hold=level.hold_steps != before.hold_steps)
        if level != before:
            self._trials += yield from self._judge_best_again(self._judge, level)
        yield from self._regulate()
        if level.robust:
            assert self._best is not None
            self._best = better(self._kept, self._best)

    def _close(self) -> _Asking:
        """Judge the best motion as the task does, whatever the last stage simulated."""
        judge = replace(self._judge, closing=True, gains=None if self._best is None else self._best.gains)
        level, full = self._schedule.level, full_level(self._task)
        if self._best is None:
            candidate = self._space.mean[None]
            self._keep_best(candidate, (yield from judge.evaluate(candidate, level)))
        elif self._starts and not level.robust and not self._best.success:
            self._best = min(self._starts, key=_rank)
        if level != full:
            self._trials += yield from self._judge_best_again(judge, full)
        assert self._best is not None
        if self._trials_to_success is None and self._best.success:  # as it turns out at the end
            self._trials_to_success = self._trials

    def _judge_best_again(self, judge: Judge, level: Level) -> Generator[Trials | Generation, Evaluation, int]:
        """Judge the best trial at the level of the trials that it will be compared with.

        Returns the roll-outs to count. Without perturbed models there are none, since the candidate was a trial already.
        """
        assert self._best is not None
        candidate = self._best.weights[None]
        evaluation = yield from judge.evaluate(candidate, level)
        self._best = None
        self._keep_best(candidate, evaluation, judge.gains)
        return 0 if evaluation.samples is None else evaluation.trials

    def _weigh_best_again(self) -> _Asking:
        """Compute the cost of the best trials again with the new weights, so that later comparisons are fair."""
        task, level, full = self._task, self._schedule.level, full_level(self._task)
        current = level if level.robust else full
        if self._best is not None:
            self._best = yield from self._weighed(self._best, current)
        if self._kept is not None:
            self._kept = yield from self._weighed(self._kept, level_of(task, task.stages[-1]))
        starts = []
        for start in self._starts:
            starts.append((yield from self._weighed(start, full)))
        self._starts = starts

    def _weighed(self, trial: Trial, level: Level) -> Generator[Trials | Generation, Evaluation, Trial]:
        """Return a trial with its cost by the current weights. One tried on many models has to be simulated again."""
        if trial.share is not None:
            on_models = Level(level.hold_steps, robust=True)
            judge = replace(self._judge, gains=trial.gains)
            evaluation = yield from judge.evaluate(trial.weights[None], on_models)
        else:
            terms = {name: np.array([value]) for name, value in trial.terms.items()}
            diverged = np.array([any(value >= DIVERGED for value in trial.terms.values())])
            evaluation = Evaluation(terms, {}, np.array([trial.success]), diverged)
        return replace(trial, cost=float(evaluation.cost(self._weights, self._task.robust)[0]))

    def _keep_best(self, candidates: Array, evaluation: Evaluation, gains: Gains | None = None) -> None:
        """Keep the best trial of all, by its rank. For ``gains`` see `Judge`."""
        cost = evaluation.cost(self._weights, self._task.robust)
        share = np.zeros(len(cost)) if evaluation.samples is None else evaluation.samples.share
        unmet = np.zeros(len(cost), dtype=bool) if evaluation.met is None else ~evaluation.met
        first = int(np.lexsort((cost, -share, unmet, ~evaluation.success))[0])
        trial = Trial.of(candidates[first], float(cost[first]), evaluation, first, gains)
        if self._best is None or trial.rank < self._best.rank:
            self._best = trial

    def _scale_step(self) -> None:
        """Scale the optimizer's step as the new stage says."""
        if self._schedule.stage.step != 1.0:
            self._optimizer.scale_step(self._schedule.stage.step)

    def _forget_costs(self, *, hold: bool = False) -> None:
        """Tell the optimizer that costs mean something else from now on.

        Args:
            hold: Whether the simulated part of the hold changes, too, and with it the errors that depend on the hold.
        """
        if hold:
            self._repair.forget()
        if uses_errors(self._optimizer):
            criteria = self._task.success.values()
            self._optimizer.forget_costs(np.array([hold and looks_at_hold(criterion) for criterion in criteria]))


def _rank(trial: Trial) -> tuple[bool, bool, float, float]:
    return trial.rank


def _tell(optimizer: Optimizer, task: Task, cost: Array, evaluation: Evaluation) -> None:
    if uses_errors(optimizer):
        optimizer.tell(cost, missed(task, evaluation))
    else:
        optimizer.tell(cost)
