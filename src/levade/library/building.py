"""Building a library: fall by fall, first the motions that are there, then a search around the best of them, then a cold one.

    library = build(load_task("self-righting"), starts=100, directory=Path("falls"))

DIR/task.yaml            the task, with every default filled in, from the first fall of the family
DIR/library.yaml         seed and number of falls
DIR/falls/000012.json    how the robot lies, and what came of it: written when the fall is done
DIR/motions/000012.npz   the motion that was found for this fall
DIR/success.npz          which motion works from which fall, on the model and on a robot that differs from it

Falls go in rounds, and a fall sees the library as it was when its round began. So the result depends neither on threads nor on
where an earlier build was stopped. The searches of a round are driven in lockstep.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from levade.arrays import Array
from levade.document import read_yaml
from levade.engines import Perturbation
from levade.errors import LevadeError, Remedy
from levade.library.asking import LIBRARY, SUCCESS, Library, read_success
from levade.library.falls import Falls, Plays, tried, tried_on_others
from levade.library.knowledge import Knowledge
from levade.library.records import FALLS, MOTIONS, Method, Record, fall_of, motion_path, record_path
from levade.locking import locked
from levade.motions import Motion
from levade.robots import Robot
from levade.search import Generation, InitialGuess, Objective, Stopped, solve_many
from levade.search.initial import AROUND
from levade.search.recording import record as record_motion
from levade.search.storage import storing
from levade.tasks import Task, task_from_dict, task_to_dict, task_to_yaml
from levade.writing import replacing, write_text

TASK = "task.yaml"

_ROUND = 32
"""Falls of a round, once there are as many: enough to share batches, and few enough that the next ones profit."""

_TRIED = 24
"""Motions that are tried from a fall, the likeliest first."""

_NEAR = 240
"""Trials of a search around the best of them."""

_APART = 1000
"""Between the seeds of searches from different falls."""


@dataclass(frozen=True)
class Progress:
    """How far a build is.

    Attributes:
        done: Falls that are done.
        starts: Falls in all.
        motions: Motions that were found.
        methods: How many falls were solved in which way.
        trials: Roll-outs so far.
    """

    done: int
    starts: int
    motions: int
    methods: Mapping[Method, int]
    trials: int


def build(
    task: Task,
    *,
    robot: Robot | None = None,
    starts: int,
    seed: int = 0,
    threads: int = 0,
    directory: Path,
    observe: Callable[[Progress], object] | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> Library:
    """Build a library, or go on with one: falls that are done already are not done again, and there may be more of them.

    Args:
        task: What each motion is to do. Its family of falls is that of its start, or else falls from the robot's own height.
        robot: The robot, instead of the one that the task names.
        starts: Falls in all.
        seed: Seed of the falls and of the searches.
        threads: Engine threads; 0 for one per core. The result does not depend on it.
        directory: Where to write.
        observe: Called after each part of a round.
        stopping: Asked between generations; once it says so, the build ends, with all falls kept that are done.

    Raises:
        LevadeError: If the task does not fit together, or the directory holds something else or cannot be written.
    """
    if starts < 1:
        raise LevadeError(f"{starts} falls are none; 100 are usual", field="starts")
    falls = Falls(task, robot=robot, seed=seed, threads=threads)
    with storing(directory, then=Remedy("give another directory")):
        for name in (FALLS, MOTIONS):
            (directory / name).mkdir(parents=True, exist_ok=True)
    with locked(directory, "library"):
        _begin(directory, falls, seed, starts)
        builder = _Builder(falls, directory, seed, starts, observe, stopping)
        for first, last in rounds(starts):
            builder.round(first, last)
            if stopping():
                break
        else:
            builder.complete()
    return Library.load(directory)


def rounds(starts: int) -> Iterator[tuple[int, int]]:
    """First fall of each round, and the first beyond it, up to a number of falls: 1, 1, 2, 4, ... and then `_ROUND`."""
    first, size = 0, 1
    while first < starts:
        yield first, min(first + size, starts)
        first, size = first + size, min(max(first + size, 1), _ROUND)


def _begin(directory: Path, falls: Falls, seed: int, starts: int) -> None:
    """Write what the library is of. Raises LevadeError if the directory holds another one."""
    place = directory / LIBRARY
    if place.is_file():
        known, began = read_library(directory)
        if (task_to_dict(known), began) != (task_to_dict(falls.task), seed):
            raise LevadeError(
                f"{directory}: holds the library of another task, robot or seed",
                remedies=(Remedy("write elsewhere", "elsewhere"),),
            )
    with storing(place, then=Remedy("give another directory")):
        write_text(directory / TASK, task_to_yaml(falls.task))
        mirror = None if falls.mirror is None else falls.mirror.to_json()
        write_text(place, f"seed: {seed}\nstarts: {starts}\nmirror: {json.dumps(mirror)}\n")


def read_library(directory: Path) -> tuple[Task, int]:
    """Task and seed of the library in a directory. Raises LevadeError if there is none."""
    place = directory / LIBRARY
    if not place.is_file():
        raise LevadeError(f"{directory}: holds no motion library; build one, or give its directory")
    content = read_yaml(place, like="seed and starts")
    if not isinstance(content.get("seed"), int):
        raise LevadeError(f"{place}: seed: should be a whole number; the file is damaged")
    return task_from_dict(read_yaml(directory / TASK), where=str(directory / TASK)), content["seed"]


class _Builder:
    def __init__(
        self,
        falls: Falls,
        directory: Path,
        seed: int,
        starts: int,
        observe: Callable[[Progress], object] | None,
        stopping: Callable[[], bool],
    ) -> None:
        self._falls, self._directory, self._seed, self._starts = falls, directory, seed, starts
        self._observe, self._stopping = observe, stopping
        there = (record_path(directory, i) for i in range(starts))
        self._records = {record.fall: record for path in there if path.is_file() for record in [Record.load(path)]}
        self._plays = Plays(directory, falls.mirror)

    def round(self, first: int, last: int) -> None:
        """Do the falls of a round that are not done yet."""
        pending = [i for i in range(first, last) if i not in self._records]
        if not pending or self._stopping():
            return
        knowledge = Knowledge.of([record for i, record in self._records.items() if i < first], self._falls.mirror)
        objectives = {i: self._falls.objective(i) for i in pending}
        begun = self._try_known(knowledge, objectives)
        for method in (Method.NEAR, Method.COLD):
            left = [i for i, one in begun.items() if i not in self._records]
            if method == Method.NEAR:
                left = [i for i in left if begun[i].guess is not None]
            self._search(left, begun, objectives, method)

    def _try_known(self, knowledge: Knowledge, objectives: Mapping[int, Objective]) -> dict[int, _Begun]:
        """Try the motions that are there. Falls that one works from are done; of the others, where searches begin."""
        sensed = {i: self._falls.sensed(objective.state) for i, objective in objectives.items()}
        likely = {i: [motion for motion, _ in knowledge.ranked(*sensed[i])[:_TRIED]] for i in objectives}
        begun = {i: _Begun(sensed[i], tuple(likely[i]), (), None, len(likely[i])) for i in objectives}
        if not len(knowledge.motions):
            return begun
        own = [[self._plays[motion] for motion in likely[i]] for i in objectives]
        for (i, objective), plays, found in zip(
            objectives.items(), own, tried(list(objectives.values()), own), strict=True
        ):
            worked = tuple(motion for motion, works in zip(likely[i], found.success, strict=True) if works)
            cost = found.cost({name: one.weight for name, one in objective.task.costs.items()})
            nearest = plays[int(np.argmin(cost))].decisions(objective.policy)
            begun[i] = replace(begun[i], worked=worked, guess=InitialGuess(nearest, step=AROUND))
            if worked:
                self._keep(i, begun[i], Method.KNOWN, worked[0])
        self._tell()
        return begun

    def _search(
        self, left: Sequence[int], begun: dict[int, _Begun], objectives: Mapping[int, Objective], method: Method
    ) -> None:
        """Search for a motion from each of these falls, in lockstep; those that are found are kept, and done."""
        if not left or self._stopping():
            return
        asked = [objectives[i] for i in left]
        guesses: list[InitialGuess | None] = [None] * len(asked)
        if method == Method.NEAR:
            asked = [one.with_task(_near(one.task)) for one in asked]
            guesses = [begun[i].guess for i in left]
        seeds = [self._seed + _APART * i for i in left]

        def observe(number: int, generation: Generation) -> Stopped | None:
            return Stopped.INTERRUPTED if self._stopping() else None

        solutions = solve_many(asked, seeds=seeds, initial=guesses, observe=observe)
        for i, objective, seed, solution in zip(left, asked, seeds, solutions, strict=True):
            begun[i] = one = replace(begun[i], trials=begun[i].trials + solution.trials)
            if solution.stopped == Stopped.INTERRUPTED:
                continue  # it would have gone on: a later build does it again, to its end
            if solution.success:
                self._keep(i, one, method, i, record_motion(objective, solution, seed=seed))
            elif method == Method.COLD:
                self._keep(i, one, Method.NONE, None)
        self._tell()

    def _keep(self, i: int, begun: _Begun, method: Method, motion: int | None, found: Motion | None = None) -> None:
        """Write a fall that is done: first the motion, if one was searched for, then the record."""
        likely, worked = begun.tried, begun.worked
        record = Record(i, *begun.sensed, method, motion, begun.trials, likely, worked)
        with storing(self._directory, then=Remedy("make room, then build again"), kept="all falls that are done"):
            if found is not None:
                found.save(motion_path(self._directory, i))
            record.write(self._directory)
        self._records[i] = record

    def complete(self) -> None:
        """Try every motion from every fall, on the model and on a robot that differs, and write which works."""
        known = Knowledge.of(list(self._records.values()), self._falls.mirror)
        known = known.merged(read_success(self._directory, known))
        success, perturbed = known.success.copy(), known.perturbed.copy()
        rows = np.flatnonzero(np.isnan(success + perturbed).any(axis=1))
        for first in range(0, len(rows), _ROUND):
            if self._stopping():
                return
            part = rows[first : first + _ROUND]
            objectives = [self._falls.objective(int(known.falls[row])) for row in part]
            untried = {row: np.isnan(success[row]) for row in part if np.isnan(success[row]).any()}
            own = [[self._plays[int(motion)] for motion in known.motions[which]] for which in untried.values()]
            asked = [objective for row, objective in zip(part, objectives, strict=True) if row in untried]
            for (row, which), found in zip(untried.items(), tried(asked, own), strict=True):
                success[row, which] = found.success
            for row, objective in zip(part, objectives, strict=True):
                # robots are numbered by motions, in an order in which later ones come last
                numbers = {int(j): _robot(int(known.motions[j])) for j in np.flatnonzero(np.isnan(perturbed[row]))}
                plays = {number: self._plays[int(known.motions[j])] for j, number in numbers.items()}
                if plays:
                    seed = (self._seed, int(known.falls[row]))
                    perturbed[row, list(numbers)] = tried_on_others(objective, plays, Perturbation(), seed=seed)
        place = self._directory / SUCCESS
        with storing(place, then=Remedy("make room, then build again")), replacing(place) as partial:
            tables = {"success": success == 1.0, "perturbed": perturbed == 1.0}
            np.savez(partial, falls=known.falls, motions=known.motions, **tables)

    def _tell(self) -> None:
        if self._observe is None:
            return
        records = self._records.values()
        methods = Counter(record.method for record in records)
        motions = sum(record.motion == record.fall for record in records)
        trials = sum(record.trials for record in records)
        self._observe(Progress(len(records), self._starts, motions, methods, trials))


@dataclass(frozen=True, eq=False)
class _Begun:
    """A fall that is not done yet: what is sensed, the motions that were tried and worked, where a search begins."""

    sensed: tuple[Array, Array]
    tried: tuple[int, ...]
    worked: tuple[int, ...]
    guess: InitialGuess | None
    trials: int


def _robot(motion: int) -> int:
    """Number of the robot that a motion is tried on."""
    return 2 * fall_of(motion) + (motion < 0)


def _near(task: Task) -> Task:
    """The task with a short search: around a motion that nearly works, it is found soon or not at all."""
    trials = min(_NEAR, task.search.trials)
    return replace(task, search=replace(task.search, trials=trials, restart=None, patience=None))
