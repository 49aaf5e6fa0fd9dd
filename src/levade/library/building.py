"""Building a library: fall by fall, first the motions that are there, then a search around the best of them, then a cold one.

    library = build(load_task("self-righting"), starts=100, directory=Path("falls"))

DIR/task.yaml            the task, with every default filled in, from the first fall of the family
DIR/library.yaml         seed and number of falls
DIR/falls/000012.json    how the robot lies, and what came of it: written when the fall is done
DIR/motions/000012.npz   the motion that was found for this fall
DIR/success.npz          which motion works from which fall, on the model and on a robot that differs from it

Falls go in rounds, and a fall sees the library as it was when its round began. So the result depends neither on threads and
processes nor on where an earlier build was stopped. In one process, the searches of a round are driven in lockstep.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from levade.arrays import Array
from levade.bench.pool import Pool
from levade.errors import LevadeError, Remedy
from levade.library.asking import LIBRARY, SUCCESS, Library, read_success
from levade.library.falls import Falls
from levade.library.knowledge import Knowledge
from levade.library.pieces import Fall, Row, Workshop
from levade.library.records import FALLS, MOTIONS, Method
from levade.library.solving import Solver
from levade.library.storing import WHOLE, Shard, begin, read_library
from levade.locking import locked
from levade.robots import Robot
from levade.search.storage import storing
from levade.tasks import Task
from levade.writing import replacing

_ROUND = 32
"""Falls of a round, once there are as many: enough to share batches, and few enough that the next ones profit."""


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
    processes: int = 1,
    shard: Shard = WHOLE,
    directory: Path,
    observe: Callable[[Progress], object] | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> Library:
    """Build a library, or go on with one: falls that are done already are not done again, and there may be more of them.

    Args:
        task: What each motion is to do. Its family of falls is that of its start, or else the usual one (`Falls`).
        robot: The robot, instead of the one that the task names.
        starts: Falls in all.
        seed: Seed of the falls and of the searches.
        threads: Engine threads; 0 for one per core. The result does not depend on it.
        processes: Processes that do the falls of a round side by side, with one thread each. Nor does it depend on this.
        shard: Which of the falls this library is of; `merge` joins shards.
        directory: Where to write.
        observe: Called after each part of a round.
        stopping: Asked between generations; once it says so, the build ends, with all falls kept that are done.

    Raises:
        LevadeError: If the task does not fit together, the directory holds something else or cannot be written, or a process
            dies.
    """
    if starts < 1:
        raise LevadeError(f"{starts} falls are none; 100 are usual", field="starts")
    if processes < 1:
        raise LevadeError(f"{processes} processes do nothing; give 1 or more", field="jobs")
    if not shard.of(starts):
        raise LevadeError(f"{starts} falls have no shard {shard}; give as many falls as shards", field="starts")
    if task.start.fallen is None and (directory / LIBRARY).is_file():  # go on with its falls, whatever is usual by now
        task = replace(task, start=read_library(directory)[0].start)
    falls = Falls(task, robot=robot, seed=seed, threads=threads)
    with storing(directory, then=Remedy("give another directory")):
        for name in (FALLS, MOTIONS):
            (directory / name).mkdir(parents=True, exist_ok=True)
    with locked(directory, "library"):
        begin(directory, falls, seed, starts, shard)
        pool = Pool(Workshop(directory, robot), processes) if processes > 1 else nullcontext()
        _Builder(falls, directory, seed, shard.of(starts), observe, stopping).go(pool)
    return Library.load(directory)


def rounds(starts: int) -> Iterator[tuple[int, int]]:
    """First fall of each round, and the first beyond it, up to a number of falls: 1, 1, 2, 4, ... and then `_ROUND`."""
    first, size = 0, 1
    while first < starts:
        yield first, min(first + size, starts)
        first, size = first + size, min(max(first + size, 1), _ROUND)


_Workers = Pool[Fall | Row, tuple[Array, Array] | None]


class _Ended(Exception):
    """The build is to end."""


class _Builder:
    """Does a build's rounds, in this process or in others."""

    def __init__(
        self,
        falls: Falls,
        directory: Path,
        seed: int,
        own: tuple[int, ...],
        observe: Callable[[Progress], object] | None,
        stopping: Callable[[], bool],
    ) -> None:
        self._falls, self._directory, self._own = falls, directory, own
        self._observe, self._stopping = observe, stopping
        self._solver = Solver(falls, directory, seed, stopping=stopping, observe=self._tell)
        self._solver.load(own)

    def go(self, pool: AbstractContextManager[_Workers | None]) -> None:
        """All rounds and every pair, or as far as it gets until it is stopped."""
        with suppress(_Ended), pool as workers:
            for first, last in rounds(len(self._own)):
                pending = [i for i in self._own[first:last] if i not in self._solver.records]
                if workers is None:
                    self._solver.solve(pending, after=self._own[:first])
                else:
                    self._round(workers, pending, self._own[:first])
                if self._stopping():
                    return
            self._complete(workers)

    def _round(self, workers: _Workers, pending: Sequence[int], after: tuple[int, ...]) -> None:
        for fall, _ in workers.each([Fall(i, after) for i in pending], waiting=self._check):
            self._solver.load([fall.number])
            self._tell()
            self._check()

    def _check(self) -> None:
        """Leave the round, and with it the falls in work, once the build is to end."""
        if self._stopping():
            raise _Ended

    def _complete(self, workers: _Workers | None) -> None:
        """Try every motion from every fall, on the model and on a robot that differs, and write which works."""
        records = self._solver.records
        known = Knowledge.of([records[i] for i in self._own], self._falls.mirror)
        known = known.merged(read_success(self._directory, known))
        success, perturbed = known.success.copy(), known.perturbed.copy()
        left = np.flatnonzero(np.isnan(success + perturbed).any(axis=1))
        if workers is None:
            for first in range(0, len(left), _ROUND):
                if self._stopping():
                    return
                rows = left[first : first + _ROUND]
                success[rows], perturbed[rows] = self._solver.rows(known, rows.tolist())
        else:
            index = {int(known.falls[row]): row for row in left}
            for row, found in workers.each([Row(i, self._own) for i in index], waiting=self._check):
                assert found is not None
                success[index[row.number]], perturbed[index[row.number]] = found
                self._check()
        place = self._directory / SUCCESS
        with storing(place, then=Remedy("make room, then build again")), replacing(place) as partial:
            tables = {"success": success == 1.0, "perturbed": perturbed == 1.0}
            np.savez(partial, falls=known.falls, motions=known.motions, **tables)

    def _tell(self) -> None:
        if self._observe is None:
            return
        records = self._solver.records.values()
        methods = Counter(record.method for record in records)
        motions = sum(record.motion == record.fall for record in records)
        trials = sum(record.trials for record in records)
        self._observe(Progress(len(records), len(self._own), motions, methods, trials))
