"""Pursue a motion for hardware: make one search after another, each around the last, until a certificate passes.

    pursued = pursue(load_task("rearing"), seed=0, directory=Path("rearing"))
    pursued.passed, pursued.certificate.verdicts
    pursued.motion.save("rearing.npz")

DIR/motion.npz          the motion with the best certificate so far
DIR/certificate.json    its certificate
DIR/certificate.html    the certificate as a page, with the poorest runs to play
DIR/task.yaml           its task, with every default filled in
DIR/hardware.json       the arguments, and the search that later ones begin around: a later call goes on from here
DIR/limits-1, ...       the searches, each a run of its own (`levade.search.run`)
DIR/feedback-1          the one on perturbed models, around the motion of limits-1, or feedback-2 and so on
DIR/again-1, ...        the same once more with another seed, if no certificate passed and time was left

The first searches look for motions of the nominal model within its limits. There are several, since motions that look alike
there differ widely on other robots. The second search begins around the best of many rough motions. The third one begins around
the nearest motion, if none keeps the limits. While the best motion succeeds on few robots, the search that found it is repeated
with other random numbers.

A search on perturbed models follows around the motion that succeeds on most robots, with feedback if the motion may have any.
Fine searches then begin around a motion if it succeeds on nearly enough robots, if its lead is so small that other robots could
change the verdict, or if it fails because of how contact is computed. Searches that are no longer needed are left out.

A pursuit around a given motion has one search within limits, ``near``, which begins around it.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from levade.checks import check
from levade.checks.statistics import wilson
from levade.errors import LevadeError, Remedy
from levade.hardware.budget import FEW, Budget
from levade.hardware.keeping import keep
from levade.hardware.part import Part, Pursued
from levade.hardware.starts import rough_start
from levade.hardware.state import (
    ASKED,
    CLOSED,
    FINER,
    LIMITS,
    MORE,
    NEAR,
    PAGE,
    ROBUST,
    State,
    again,
    check_same,
    discard,
    is_pursuit,
)
from levade.locking import locked
from levade.motions import Motion
from levade.report.page import check_page
from levade.robots import Robot
from levade.search import Generation, Stopped, make_objective
from levade.search.checkpoint import CHECKPOINT
from levade.search.initial import initial_guess
from levade.search.run import Outcome, read_run, resume, run
from levade.search.storage import storing
from levade.tasks import Demands, Task, task_to_dict
from levade.tasks.plan import RUN_UP, Plan

_ON_LIMITS = (0.25, 0.6, 1.0)
"""Shares of the time after which searches within limits, in order, end if they have no success."""

_ON_NEAR = 0.6
"""The same share for a search around a given motion."""

_ENOUGH = 0.4
"""The same share once another search has succeeded. No further search within limits begins after it."""

_GOOD = 0.7
"""Share of perturbed robots that makes a motion good enough to begin the robust searches around."""

_TIMES = 3
"""Once a search within limits has succeeded, later ones end without success after this multiple of its trials."""

_APART = 1000
"""Distance between the seeds of searches that differ in nothing else."""

_AGAIN = 0.2
"""Share of the time that has to be left to repeat all searches with another seed."""

_FAR_APART = 100_000
"""Distance between the seeds of these repetitions."""

Begin = Callable[[str, Task], object]
"""Called before each search with its name and its task."""

Observe = Callable[[str, Generation], "Stopped | None"]
"""Called after each generation with the search's name."""

Tell = Callable[[Part], object]
"""Called with each part once it is certified."""


def pursue(
    task: Task,
    *,
    robot: Robot | None = None,
    seed: int = 0,
    threads: int = 0,
    directory: Path,
    minutes: float | None = None,
    trials: int | None = None,
    around: Motion | None = None,
    feedback: bool = True,
    demands: Demands | None = None,
    runs: int = 500,
    replace: bool = False,
    begin: Begin | None = None,
    observe: Observe | None = None,
    tell: Tell | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> Pursued:
    """Search for a motion that hardware can do, and certify it.

    Args:
        task: What the motion is to do. The plan replaces its stages, search settings and costs of the goal.
        robot: A robot to use instead of the task's.
        seed: Seed of all random numbers.
        threads: Number of engine threads (0: one per core).
        directory: Where to write. Finished searches of the same task and seed in this directory are used again, and
            unfinished ones go on.
        minutes: Time for all searches and checks together [min]. They end with the best motion so far, and a later call goes
            on. None sets no limit except the searches' numbers of trials.
        trials: Most roll-outs of all searches together, to the nearest generation. Unlike ``minutes`` the result then depends
            on no computer's speed, and a call that goes on after an interruption gives the same one. Those of certificates
            do not count. None sets no limit.
        around: A motion that nearly keeps the limits, to search around instead of from nothing.
        feedback: Whether the motion may have feedback.
        demands: Demands of the certificate. Defaults to the task's, or else to `levade.tasks.Demands`.
        runs: Most perturbed runs of each certificate. After 100 runs, it ends once the demanded share is out of reach.
        replace: Whether to replace the content of the directory and begin from nothing.
        begin: Called before each search, see `Begin`.
        observe: Called after each generation, see `Observe`.
        tell: Called with each finished part, see `Tell`.
        stopping: Called on the way. Once it returns true, searches and checks end with the results so far.

    Returns:
        All searches, and the motion with the best certificate.

    Raises:
        LevadeError: If the task has no criteria or its parts do not fit together, or if the directory cannot be written or
            holds something else.
    """
    if minutes is not None and not minutes > 0:
        raise LevadeError(f"{minutes:g} should be a positive number of minutes; 5 is usual", field="minutes")
    if trials is not None and trials < 1:
        raise LevadeError(f"{trials} trials are too few; give 1 or more, such as 6000", field="trials")
    if robot is None:
        robot = task.robot.load()
    demands = demands or task.hardware or Demands()
    plan = Plan.of(task, robot, demands, feedback=feedback)
    if not plan.goal:
        raise LevadeError(f"hardware: the task {task.name} has no success criteria to certify; add some to the task")
    check_page(directory / PAGE, instead="give another directory")
    with storing(directory / ASKED, then=Remedy("give another directory", "elsewhere")):
        directory.mkdir(parents=True, exist_ok=True)
    if replace:
        discard(directory)
    else:
        check_same(directory, task, seed)
    with locked(directory, "pursuit"):
        state = State.of(directory, task, seed, demands)
        if trials is not None:  # all searches are made again, to the same result
            state.chosen = None
        state.write()
        began = time.monotonic()
        end = None if minutes is None else began + 60 * minutes
        how = (demands, begin, observe, tell, stopping)
        first = _Pursuit(plan, seed, threads, state, Budget(end, trials, runs), *how, around=around)
        found, number = first.go(), 1
        while not found.passed and not found.stopped and around is None:
            place = again(directory, number)
            more = None if trials is None else trials - found.trials
            left = end is not None and end - time.monotonic() > _AGAIN * (end - began)
            left = left or (trials is not None and trials - found.trials > _AGAIN * trials)
            if not (left or (trials is None and is_pursuit(place))):
                break
            found = first.joined(found, _again(first, place, number, more))
            number += 1
        return found


def _again(first: _Pursuit, directory: Path, number: int, trials: int | None) -> Pursued:
    """Repeat the searches with another seed."""
    known = first.state
    with storing(directory, then=Remedy("make room, then go on", "resume", known.directory)):
        directory.mkdir(exist_ok=True)
    state = State.of(directory, known.task, known.seed + _FAR_APART * number, known.demands)
    if trials is not None:
        state.chosen = None
    state.write()
    return first.like(state, f"{directory.name}/", trials).go()


class _Pursuit:
    def __init__(
        self,
        plan: Plan,
        seed: int,
        threads: int,
        state: State,
        budget: Budget,
        demands: Demands,
        begin: Begin | None,
        observe: Observe | None,
        tell: Tell | None,
        stopping: Callable[[], bool],
        prefix: str = "",
        around: Motion | None = None,
    ) -> None:
        self._plan, self._seed, self._threads, self._state = plan, seed, threads, state
        self._directory, self._prefix = state.directory, prefix
        self._budget, self._demands = budget, demands
        self._begin, self._observe, self._tell, self._stopping = begin, observe, tell, stopping
        self._around = around
        self._parts: list[Part] = []
        self._kinds: dict[str, int] = {}  # which of the plan's searches within limits each is
        self._share = 1.0  # share of the time for a search without success
        self._stopped = ""

    @property
    def state(self) -> State:
        """The arguments of the pursuit, and its directory."""
        return self._state

    def like(self, state: State, prefix: str, trials: int | None) -> _Pursuit:
        """Make the same pursuit with another seed in another directory.

        Args:
            state: Its arguments, and its directory.
            prefix: Prefix of its searches' names in reports.
            trials: Most roll-outs of its searches. None sets no limit.
        """
        how = (self._demands, self._begin, self._observe, self._tell, self._stopping)
        budget = Budget(self._budget.end, trials, self._budget.runs)
        return _Pursuit(self._plan, state.seed, self._threads, state, budget, *how, prefix)

    def joined(self, found: Pursued, other: Pursued) -> Pursued:
        """Join the result so far with that of another pursuit, and keep the better motion in this directory.

        Args:
            found: Result so far.
            other: Result of the other pursuit.
        """
        best = min(found.best, other.best, key=lambda part: part.rank)
        if best is other.best and best.certificate is not None:
            keep(best, best.certificate, self._directory)
        return replace(found, parts=(*found.parts, *other.parts), best=best, stopped=other.stopped)

    def go(self) -> Pursued:
        """Make the searches that are needed, in order, and return their result."""
        self._keep_to_limits()
        self._share = 1.0
        if any(part.met for part in self._parts) and not self._stopped:
            self._hold_on_others()
            self._refine()
        if self._best.certificate is None:
            self._certify_best()
        best = self._parts.index(self._best)
        parts = tuple(replace(part, name=self._prefix + part.name) for part in self._parts)
        return Pursued(self._plan, parts, parts[best], self._directory, self._seed, self._stopped)

    def _keep_to_limits(self) -> None:
        """Look for motions of the nominal model within its limits."""
        if self._around is not None:
            near = self._around
            number = self._kinds[NEAR] = self._plan.number_of(near.task.policy)
            self._share = _ON_NEAR
            task = self._plan.nearer(number, near.horizon, whole_hold=near.falls_late)
            self._search(NEAR, task, near, seed=self._seed)
            return
        for number, name in enumerate((*LIMITS, *MORE)):
            if self._state.chosen not in (None, name):
                continue
            found = any(part.met for part in self._parts)
            if name in MORE and self._state.chosen is None and not (found and self._wants_another):
                break
            time_for_it = _ON_LIMITS[min(number, len(LIMITS) - 1)]
            self._share = min(time_for_it, _ENOUGH) if found else time_for_it
            task, near = self._within_limits(name, number)
            part = self._search(name, task, near, seed=self._seed + _APART * number)
            met = any(part.met for part in self._parts)
            if self._stopped or part.sure or (met and self._budget.late(_ENOUGH)):
                break

    def _hold_on_others(self) -> None:
        """Search around the motion that succeeds on most perturbed robots, with feedback if it may have any."""
        plan = self._plan
        start = max((part for part in self._parts if part.met), key=lambda part: (part.sure, part.share))
        self._choose(start)
        if not start.sure:
            near = start.motion
            names, make = (CLOSED, plan.closed_loop) if plan.can_close_the_loop else (ROBUST, plan.robust)
            self._search(names[start.name], make(near.horizon, near.task.policy), near, seed=self._seed)

    def _refine(self) -> None:
        """Search around the best motion in small steps, if it nearly passes."""
        for number, name in enumerate(FINER, start=1):
            best = self._best
            if self._stopped or best.sure or not best.near:
                break
            near = best.motion
            task = self._plan.finer(near.horizon, near.task.policy, feedback=near.stabiliser is not None)
            self._search(name, task, near, seed=self._seed + _APART * number)

    @property
    def _wants_another(self) -> bool:
        """Whether to look for another motion to begin the robust searches around: the best one is not good enough yet."""
        return max(part.share for part in self._parts if part.met) < _GOOD

    def _within_limits(self, name: str, number: int) -> tuple[Task, Motion | None]:
        """Return a search within limits and the motion to begin around. A search of this plan that exists already goes on."""
        plan, last = self._plan, len(LIMITS) - 1
        directory, met = self._directory / name, [part for part in self._parts if part.met]
        if number < last:
            self._kinds[name] = number
            return plan.within_limits(number), None
        if (directory / CHECKPOINT).is_file():
            known, _ = read_run(directory)
            content = task_to_dict(known, code=True)
            for kind in range(len(LIMITS)):
                horizon = known.usual_horizon
                nearer = (plan.nearer(kind, horizon, whole_hold=whole) for whole in (False, True))
                for task in (plan.within_limits(kind), *nearer):
                    if task_to_dict(task, code=True) == content:
                        self._kinds[name] = kind
                        return task, None
        if number == last and self._parts and not met:  # the nearest motion is the best place to begin
            near = self._parts[self._nearest]
            kind = self._kinds[name] = self._kinds[near.name]
            late = near.motion.falls_late
            return plan.nearer(kind, near.motion.horizon, whole_hold=late), near.motion
        # repeat the best search with other random numbers
        self._kinds[name] = self._kinds[max(met, key=lambda part: part.share).name] if number > last and met else last
        return plan.within_limits(self._kinds[name]), None

    def _choose(self, part: Part) -> None:
        if self._state.chosen is None:
            self._state.chosen = part.name
            self._state.write()

    @property
    def _best(self) -> Part:
        return min(self._parts, key=lambda part: part.rank)

    def _search(self, name: str, task: Task, around: Motion | None, *, seed: int) -> Part:
        """Make one search, go on with it, or take its earlier result; then certify its motion."""
        began = self._budget.begin()
        outcome = self._run(name, task, around, seed)
        motion = outcome.motion.with_task(self._plan.certifiable(outcome.motion.task))
        part = Part(name, motion, outcome.solution.trials, time.monotonic() - began, None)
        # a motion beyond the limits would only fail; if there is no other, the nearest one is certified in the end
        hopeless = name in self._kinds and not motion.met
        if not hopeless:
            part = self._certified(part)
        self._parts.append(part)
        self._budget.made(part.trials)
        self._tell_of(part)
        return part

    def _tell_of(self, part: Part) -> None:
        if self._tell is not None:
            self._tell(replace(part, name=self._prefix + part.name))

    @property
    def _nearest(self) -> int:
        """The index of the part that came nearest to the goal within the limits, by the costs of the first search."""
        weights = {name: cost.weight for name, cost in self._plan.within_limits().costs.items()}

        def cost(i: int) -> float:
            terms = self._parts[i].motion.result.cost_terms
            return sum(weight * terms.get(name, 0.0) for name, weight in weights.items())

        return min(range(len(self._parts)), key=cost)

    def _certify_best(self) -> None:
        """Certify the nearest motion, if no motion keeps the limits."""
        nearest = self._nearest
        self._parts[nearest] = self._certified(self._parts[nearest])
        self._tell_of(self._parts[nearest])

    def _certified(self, part: Part) -> Part:
        """Add a certificate to a part, and write both if they are the best so far."""
        began = time.monotonic()
        certificate = check(
            part.motion,
            runs=self._budget.runs,
            seed=self._seed,
            perturbation=self._plan.perturb,
            demands=self._demands,
            asked=self._plan.task.success,
            threads=self._threads,
            hopeless=self._hopeless,
            stopping=self._stopping,
        )
        if certificate.interrupted:
            self._stopped = "interrupted"
        took = time.monotonic() - began
        self._budget.certified(took, certificate.perturbed.runs)
        part = replace(part, certificate=certificate, seconds=part.seconds + took)
        if part.rank <= min((one.rank for one in self._parts), default=part.rank):
            keep(part, certificate, self._directory)
        return part

    def _hopeless(self, successes: int, runs: int) -> bool:
        """Whether further perturbed runs cannot reach the demanded share any more."""
        share = self._demands.share
        return share is not None and runs >= FEW and wilson(successes, runs)[1] < share

    def _run(self, name: str, task: Task, around: Motion | None, seed: int) -> Outcome:
        directory = self._directory / name
        objective = make_objective(task, robot=self._plan.robot, threads=self._threads)
        if (directory / CHECKPOINT).is_file():
            known, checkpoint = read_run(directory)
            if task_to_dict(known, code=True) == task_to_dict(task, code=True) and checkpoint.header.seed == seed:
                self._told(name, task)
                return resume(directory, objective=objective, observe=lambda one: self._watch(name, one))
        guess = None if around is None else initial_guess(objective.policy, around)
        if guess is None and self._kinds.get(name) == RUN_UP:
            guess = rough_start(objective, seed=seed)
        self._told(name, task)
        return run(
            objective,
            seed=seed,
            directory=directory,
            initial=guess,
            observe=lambda one: self._watch(name, one),
        )

    def _told(self, name: str, task: Task) -> None:
        if self._begin is not None:
            self._begin(self._prefix + name, task)

    def _watch(self, name: str, generation: Generation) -> Stopped | None:
        wish = None if self._observe is None else self._observe(self._prefix + name, generation)
        wish = wish or (Stopped.INTERRUPTED if self._stopping() else None)
        if wish is not None:
            self._stopped = "interrupted"
        elif not generation.replayed and self._budget.over(generation):
            self._stopped, wish = "time", Stopped.INTERRUPTED
        elif self._budget.spent(1.0, generation.trials):  # also when it is replayed: a later call stops there, too
            self._stopped, wish = "trials", Stopped.INTERRUPTED
        elif self._gives_up(name, generation):
            wish = Stopped.INTERRUPTED
        return wish

    def _gives_up(self, name: str, generation: Generation) -> bool:
        """Whether a search ends without success, because it has had its share."""
        if generation.trials_to_success is not None:
            return False
        if self._budget.spent(self._share, generation.trials) or self._outdone(name, generation):
            return True
        return not generation.replayed and self._budget.late(self._share)

    def _outdone(self, name: str, generation: Generation) -> bool:
        """Whether a search within limits takes much longer than one that has succeeded."""
        if name not in self._kinds:
            return False
        least = min((part.trials for part in self._parts if part.met), default=None)
        return least is not None and generation.trials >= _TIMES * least
