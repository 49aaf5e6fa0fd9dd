"""Solve falls, one round at a time: by the known motions, by a search around the best of them, or by a search from nothing.

    solver = Solver(falls, directory, seed=0)
    solver.solve([4, 5, 6], after=[0, 1, 2, 3])     # writes records and motions
    success, perturbed = solver.rows(known, [0, 1])

When a search finds a motion, it goes on with perturbed models until the motion works on nearly all of them. So it does for a
known motion that works on the model but seldom on perturbed models, unless the fall is a rare one, or a motion was found from a
nearby fall.

With demands of hardware, a known motion solves a fall only if its certificate passes, and if from this fall it keeps every
limit on the model and reaches the goal on nearly every perturbed model. Otherwise `levade.library.pursuing` searches.

The result for a fall depends only on the falls ``after`` which it is solved, not on the others of its round.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from levade.arrays import Array
from levade.checks import Certificate
from levade.engines import Perturbation
from levade.errors import Remedy
from levade.library.falls import Falls
from levade.library.hardening import affords, harden
from levade.library.knowledge import Knowledge
from levade.library.plays import Play, Plays, posed, simulated, tried, tried_on_others
from levade.library.pursuing import PURSUITS, Hardware, pursue_fall, write_certificate
from levade.library.rarity import RARE, Lying, further
from levade.library.records import Method, Record, fall_of, motion_path, record_path
from levade.motions import Motion
from levade.search import Generation, InitialGuess, Objective, Solution, Stopped, solve_many
from levade.search.initial import AROUND
from levade.search.recording import record as record_motion
from levade.search.storage import storing
from levade.tasks import Task

_TRIED = 24
"""Number of motions that are tried from a fall, the likeliest first."""

_NEAR_TRIALS = 240
"""Number of trials of a search around the best of them."""

_ROBOTS, _SURE, _TOLD = 6, 0.8, 2
"""Number of perturbed models; the share at which a motion is reliable; how many of the working motions are tried on them."""

_EARLY, _EARLY_ROBOTS, _EARLY_SURE = 16, 12, 1.0
"""Number of falls that are the first, and what they have instead: their motions serve all later falls."""

_MANY = 20
"""Number of perturbed models within the limits of hardware. They have to tell the demanded share from a smaller one."""

_ELSEWHERE = 0.1
"""Distance from a fall with its own motion [rad], beyond which another motion may be worth finding."""

_APART, _FAR_APART = 1000, 1_000_000
"""Differences between the seeds of searches, and of pursuits for hardware, from consecutive falls."""


class Solver:
    """Solves falls of a library, and writes the results into its directory.

    Attributes:
        records: Number of a fall -> its record, for all falls that are done.
    """

    def __init__(
        self,
        falls: Falls,
        directory: Path,
        seed: int,
        *,
        hardware: Hardware | None = None,
        stopping: Callable[[], bool] = lambda: False,
        observe: Callable[[], object] = lambda: None,
    ) -> None:
        """Continue a library.

        Args:
            falls: The family of falls.
            directory: Directory of the library.
            seed: Seed of the library.
            hardware: Demands of the hardware on each motion, the same as those of the falls. None for none.
            stopping: Function that is called between generations. When it returns True, unfinished falls are abandoned.
            observe: Function that is called after each part.
        """
        self._falls, self._directory, self._seed = falls, directory, seed
        self._hardware, self._stopping, self._observe = hardware, stopping, observe
        self.records: dict[int, Record] = {}
        self._plays = Plays(directory, falls.mirror)

    def load(self, numbers: Sequence[int]) -> None:
        """Read the records of falls, as far as they exist.

        Args:
            numbers: Numbers of the falls.
        """
        for i in numbers:
            if i not in self.records and (path := record_path(self._directory, i)).is_file():
                self.records[i] = Record.load(path)

    def learn(self, records: Sequence[Record], motions: Mapping[int, Motion]) -> None:
        """Take note of falls, instead of reading them.

        Args:
            records: Records of the falls.
            motions: Number of a fall -> its motion. It needs meta and weights only.
        """
        self.records.update({record.fall: record for record in records})
        self._plays.learn(motions)

    def solve(self, pending: Sequence[int], *, after: Sequence[int]) -> None:
        """Solve falls, each with the motions that were known ``after`` other falls.

        Args:
            pending: Numbers of the falls to solve.
            after: Numbers of the falls whose motions may be used.
        """
        if not pending or self._stopping():
            return
        knowledge = Knowledge.of([self.records[i] for i in after], self._falls.mirror)
        objectives = {i: self._falls.objective(i) for i in pending}
        begun = self._try_known(knowledge, objectives, self._dropped(pending))
        if self._hardware is not None:
            for i in [i for i in begun if i not in self.records]:
                self._pursue(i, begun[i], objectives[i], self._hardware)
            return
        self._harden_known(
            [i for i in begun if i not in self.records and begun[i].works is not None], begun, objectives
        )
        for method in (Method.NEAR, Method.COLD):
            left = [i for i, one in begun.items() if i not in self.records and one.works is None]
            if method == Method.NEAR:
                left = [i for i in left if begun[i].nearest is not None]
            self._search(left, begun, objectives, method)

    def _dropped(self, pending: Sequence[int]) -> dict[int, tuple[Lying, ...]]:
        """Drop further falls with each fall, among which the build looks for rare ones.

        There are none if the robot does not fold up, because then all falls end differently; and none within the limits of
        hardware, where solving a fall takes minutes.
        """
        if self._falls.folding is None or self._hardware is not None:
            return {}
        lies = {one.fall: one for one in self._falls.lying([number for i in pending for number in further(i)])}
        return {i: tuple(lies[number] for number in further(i)) for i in pending}

    def _try_known(
        self, knowledge: Knowledge, objectives: Mapping[int, Objective], dropped: Mapping[int, tuple[Lying, ...]]
    ) -> dict[int, _Begun]:
        """Try the known motions. Finish the falls from which one works reliably; return where to search from the others."""
        sensed = {i: self._falls.sensed(objective.state) for i, objective in objectives.items()}
        likely = {i: [motion for motion, _ in knowledge.ranked(*sensed[i])[:_TRIED]] for i in objectives}
        begun = {
            i: _Begun(sensed[i], tuple(likely[i]), (), None, len(likely[i]), dropped.get(i, ())) for i in objectives
        }
        if not len(knowledge.motions):
            return begun
        own = [[self._plays[motion] for motion in likely[i]] for i in objectives]
        for (i, objective), plays, found in zip(
            objectives.items(), own, tried(list(objectives.values()), own), strict=True
        ):
            worked = tuple(motion for motion, works in zip(likely[i], found.success, strict=True) if works)
            cost = found.cost({name: one.weight for name, one in objective.task.costs.items()})
            if worked and self._hardware is not None:  # costs of the goal may outweigh a limit
                cost = np.where(found.success, cost, np.inf)
            nearest = plays[int(np.argmin(cost))]
            begun[i] = replace(begun[i], worked=worked, nearest=nearest)
            if self._hardware is not None:
                self._keep_if_known(i, begun, objective, self._hardware)
            elif worked:
                robots, enough = (_EARLY_ROBOTS, _EARLY_SURE) if i < _EARLY else (_ROBOTS, _SURE)
                begun[i] = self._asked(begun[i], i, objective, worked[:_TOLD], robots, enough)
                if begun[i].sure or i >= RARE or knowledge.apart(*sensed[i]) < _ELSEWHERE:
                    self._keep(i, begun[i], Method.KNOWN, begun[i].works)
        self._observe()
        return begun

    def _keep_if_known(self, i: int, begun: dict[int, _Begun], objective: Objective, hardware: Hardware) -> None:
        """Finish a fall if a motion with a certificate also keeps the limits from here and works on enough perturbed models.

        Otherwise the search begins around that motion.
        """
        worked = begun[i].worked
        certified = [motion for motion in worked if self.records[fall_of(motion)].failed == ()][:_TOLD]
        if not certified:
            return
        begun[i] = self._asked(begun[i], i, objective, certified, _MANY, hardware.demands.share or 0.0)
        if begun[i].sure:
            self._keep(i, begun[i], Method.KNOWN, begun[i].works)
        else:
            begun[i] = replace(begun[i], nearest=self._plays[_given(begun[i].works)])

    def _asked(
        self, begun: _Begun, fall: int, objective: Objective, told: Sequence[int], robots: int, enough: float
    ) -> _Begun:
        """Find which of the motions works on most perturbed models, and whether it works on a large enough share of them."""
        plays = {len(told) * robot + k: self._plays[told[k]] for robot in range(robots) for k in range(len(told))}
        (works,) = tried_on_others([objective], [plays], Perturbation(), seeds=[(self._seed, fall, robots)])
        worked = works.reshape(robots, len(told)).sum(axis=0)
        best = int(np.argmax(worked))
        return replace(
            begun,
            works=told[best],
            sure=bool(worked[best] / robots >= enough),
            trials=begun.trials + len(plays),
            perturbed={motion: (robots, int(n)) for motion, n in zip(told, worked, strict=True)},
        )

    def _pursue(self, i: int, begun: _Begun, objective: Objective, hardware: Hardware) -> None:
        """Search within the limits of hardware, and keep the motion with the best certificate, whether or not it passes."""
        if self._stopping():
            return
        place = self._directory / PURSUITS / f"{i:06}"
        with storing(self._directory, then=Remedy("make room, then build again")):
            found = pursue_fall(
                self._falls,
                i,
                around=None if begun.nearest is None else simulated(objective, begun.nearest),
                hardware=hardware,
                seed=self._seed + _FAR_APART * i,
                directory=place,
                stopping=self._stopping,
            )
        if found is None:
            return
        begun = replace(begun, trials=begun.trials + found.trials)
        works = i if found.motion.met else None
        self._keep(i, begun, found.method, works, found.motion, found.certificate)
        shutil.rmtree(place, ignore_errors=True)
        self._observe()

    def _harden_known(self, left: Sequence[int], begun: dict[int, _Begun], objectives: Mapping[int, Objective]) -> None:
        """Search on from motions that work, but seldom on perturbed models. The results become motions of the library."""
        if not left or self._stopping():
            return
        asked = [objectives[i] for i in left]
        weights = [self._plays[_given(begun[i].works)].decisions(objectives[i].policy) for i in left]
        seeds = [self._seed + _APART * i for i in left]
        better = harden([self._wide(one) for one in asked], weights, seeds=seeds, observe=self._interrupted)
        for i, one, seed, found in zip(left, asked, seeds, better, strict=True):
            begun[i] = replace(begun[i], trials=begun[i].trials + (found.trials if found else 0))
            if found is not None and found.stopped == Stopped.INTERRUPTED:
                continue
            if found is not None and found.success:
                found = replace(found, trials=begun[i].trials)
                self._keep(i, begun[i], Method.NEAR, i, record_motion(one, found, seed=seed))
            else:
                self._keep(i, begun[i], Method.KNOWN, begun[i].works)
        self._observe()

    def _wide(self, objective: Objective) -> Objective:
        """Let perturbed models also start from falls nearby, if motions are hardened at all: these falls take time."""
        return self._falls.widened(objective) if affords(objective.task) else objective

    def _interrupted(self, number: int, generation: Generation) -> Stopped | None:
        return Stopped.INTERRUPTED if self._stopping() else None

    def _search(
        self, left: Sequence[int], begun: dict[int, _Begun], objectives: Mapping[int, Objective], method: Method
    ) -> None:
        """Search for a motion from each of these falls, in lockstep. Harden and keep the motions that are found."""
        if not left or self._stopping():
            return
        asked = [objectives[i] for i in left]
        guesses: list[InitialGuess | None] = [None] * len(asked)
        if method == Method.NEAR:
            asked = [one.with_task(_near(one.task)) for one in asked]
            guesses = [_around(one, begun[i]) for i, one in zip(left, asked, strict=True)]
        seeds = [self._seed + _APART * i for i in left]
        solutions = solve_many(asked, seeds=seeds, initial=guesses, observe=self._interrupted)
        solutions = self._hardened([objectives[i] for i in left], solutions, seeds)  # with the task's own budget
        for i, objective, seed, solution in zip(left, asked, seeds, solutions, strict=True):
            begun[i] = one = replace(begun[i], trials=begun[i].trials + solution.trials)
            if solution.stopped == Stopped.INTERRUPTED:
                continue  # interrupted: a later build repeats this search to its end
            if solution.success:
                self._keep(i, one, method, i, record_motion(objective, solution, seed=seed))
            elif method == Method.COLD:
                self._keep(i, one, Method.NONE, None)
        self._observe()

    def _hardened(
        self, asked: Sequence[Objective], solutions: Sequence[Solution], seeds: Sequence[int]
    ) -> list[Solution]:
        """Harden the successful solutions on perturbed models; return all solutions."""
        found = [j for j, one in enumerate(solutions) if one.success and one.stopped != Stopped.INTERRUPTED]
        better = harden(
            [self._wide(asked[j]) for j in found],
            [solutions[j].best.weights[None] for j in found],
            seeds=[seeds[j] for j in found],
            observe=self._interrupted,
        )
        after = list(solutions)
        for j, then in zip(found, better, strict=True):
            if then is not None:
                first = solutions[j]
                best = then.best if then.success else first.best
                after[j] = replace(first, best=best, trials=first.trials + then.trials, stopped=then.stopped)
        return after

    def _keep(
        self,
        i: int,
        begun: _Begun,
        method: Method,
        motion: int | None,
        found: Motion | None = None,
        certificate: Certificate | None = None,
    ) -> None:
        """Write a finished fall: first the motion and its certificate, if a search found one, then the record."""
        failed = None if certificate is None else certificate.failed
        known = (begun.trials, begun.tried, begun.worked)
        record = Record(i, *begun.sensed, method, motion, *known, failed, begun.perturbed, begun.further)
        with storing(
            self._directory, then=Remedy("make room, then build again"), kept="all falls that are done are kept"
        ):
            if found is not None:
                found.save(motion_path(self._directory, i))
            if certificate is not None:
                write_certificate(self._directory, i, certificate)
            record.write(self._directory)
        self.records[i] = record

    def rows(self, known: Knowledge, rows: Sequence[int]) -> tuple[Array, Array]:
        """Try every motion from some falls, on the model and on perturbed models, where that was not done before.

        Args:
            known: Known outcomes.
            rows: Rows of the falls in ``known``.

        Returns:
            `Knowledge.success` and `Knowledge.perturbed` of these rows, shape (rows, m) each, without NaN.
        """
        success, perturbed = known.success[rows], known.perturbed[rows]
        objectives = [self._falls.objective(int(known.falls[row])) for row in rows]
        untried = {k: np.isnan(success[k]) for k in range(len(rows)) if np.isnan(success[k]).any()}
        own = [[self._plays[int(motion)] for motion in known.motions[which]] for which in untried.values()]
        asked = [objectives[k] for k in untried]
        for (k, which), found in zip(untried.items(), tried(asked, own), strict=True):
            success[k, which] = found.success
        # perturbed models are numbered by motions, in an order in which later ones come last
        columns = [np.flatnonzero(np.isnan(one)) for one in perturbed]
        plays = [{_robot(int(one)): self._plays[int(one)] for one in known.motions[which]} for which in columns]
        seeds = [(self._seed, int(known.falls[row])) for row in rows]
        on_others = tried_on_others(objectives, plays, Perturbation(), seeds=seeds)
        for k, (which, works) in enumerate(zip(columns, on_others, strict=True)):
            perturbed[k, which] = works
        return success, perturbed


@dataclass(frozen=True, eq=False)
class _Begun:
    """Holds an unfinished fall: what is sensed, the motions that were tried and worked, what a search begins around.

    Attributes:
        further: How the robot lies after further falls, which were dropped with this one.
        works: The working motion that works on most perturbed models. None if no motion works.
        sure: Whether it works on enough of them.
        perturbed: Motion that was tried on perturbed models -> the number of models, and on how many it worked.
    """

    sensed: tuple[Array, Array]
    tried: tuple[int, ...]
    worked: tuple[int, ...]
    nearest: Play | None
    trials: int
    further: tuple[Lying, ...] = ()
    works: int | None = None
    sure: bool = False
    perturbed: Mapping[int, tuple[int, int]] = field(default_factory=dict[int, tuple[int, int]])


def _around(objective: Objective, begun: _Begun) -> InitialGuess:
    assert begun.nearest is not None
    return InitialGuess(posed(objective, begun.nearest)[1], step=AROUND)


def _given(motion: int | None) -> int:
    assert motion is not None
    return motion


def _robot(motion: int) -> int:
    """Return the number of the perturbed model on which a motion is tried."""
    return 2 * fall_of(motion) + (motion < 0)


def _near(task: Task) -> Task:
    """Return the task with a short search: around a motion that nearly works, a search succeeds soon or not at all."""
    trials = min(_NEAR_TRIALS, task.search.trials)
    return replace(task, search=replace(task.search, trials=trials, restart=None, patience=None))
