"""Build a library. For each fall, try the known motions, then search around the best of them, then search from nothing.

    library = build(load_task("self-righting"), starts=100, directory=Path("falls"))

DIR/task.yaml            the task, with every default filled in, from the first fall of the family
DIR/library.yaml         seed and number of falls
DIR/falls/000012.json    how the robot lies, and the result: written when the fall is done
DIR/motions/000012.npz   the motion that was found for this fall
DIR/certificates/000012.json  the motion's certificate, in a library for hardware
DIR/success.npz          which motion works from which fall, on the model and on a perturbed model

Falls are solved in rounds, and each fall sees the library as it was when its round began. So the result depends neither on
threads and processes nor on where an earlier build was stopped. In one process, the searches of a round run in lockstep.

After each round, the library also solves rare falls (`levade.library.rarity`), and later rounds know them, too.
"""

from __future__ import annotations

import shutil
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
from levade.library.pursuing import PURSUITS, Hardware
from levade.library.rarity import RARE, rare
from levade.library.records import FALLS, MOTIONS, Method
from levade.library.solving import Solver
from levade.library.spreading import Spread
from levade.library.storing import WHOLE, Shard, begin, read_library
from levade.locking import locked
from levade.robots import Robot
from levade.search.storage import storing
from levade.tasks import Task
from levade.writing import replacing

_ROUND, _GROWTH = 32, 8
"""Number of falls in a round: this many, or this part of the falls before it if that is more. Large enough to share batches and
to keep many nodes busy, and small enough that later falls profit from the motions."""


@dataclass(frozen=True)
class Progress:
    """Reports how far a build has come.

    Attributes:
        done: Number of falls that are done, without the rare ones that the build added.
        starts: Total number of falls, without these.
        motions: Number of motions that were found.
        methods: Method -> number of falls that it solved.
        trials: Number of roll-outs so far.
        rare: Number of rare falls that are done.
        cpus: Number of CPUs of the Ray cluster. None without one.
    """

    done: int
    starts: int
    motions: int
    methods: Mapping[Method, int]
    trials: int
    rare: int = 0
    cpus: int | None = None


def build(
    task: Task,
    *,
    robot: Robot | None = None,
    starts: int,
    seed: int = 0,
    threads: int = 0,
    processes: int = 1,
    ray: str | None = None,
    shard: Shard = WHOLE,
    hardware: Hardware | None = None,
    directory: Path,
    observe: Callable[[Progress], object] | None = None,
    stopping: Callable[[], bool] = lambda: False,
) -> Library:
    """Build a library, or continue one. Finished falls are not solved again, and ``starts`` may be larger than before.

    Args:
        task: What each motion has to do. Its start gives the family of falls; otherwise the default family is used (`Falls`).
        robot: The robot. Defaults to the one that the task names.
        starts: Total number of falls.
        seed: Seed of the falls and of the searches.
        threads: Number of engine threads (0: one per core). The result does not depend on it.
        processes: Number of processes that solve the falls of a round in parallel, with one thread each. The result does
            not depend on it.
        ray: Address of a Ray cluster whose nodes solve the falls of a round in parallel (`levade.bench.cluster`). None
            for this computer alone. The result does not depend on it.
        shard: The share of the falls that this library covers. `merge` joins shards.
        hardware: Demands of the hardware on each motion, and the budget of a fall. None for motions without regard to limits.
        directory: Directory to write to.
        observe: Function that is called after each part of a round.
        stopping: Function that is called between generations. When it returns True, the build ends and keeps all falls that
            are done.

    Returns:
        The library.

    Raises:
        LevadeError: If the task is not consistent, the directory holds something else or cannot be written, a process
            dies, or there is no such cluster.
    """
    if starts < 1:
        raise LevadeError(f"{starts} falls are too few; give 1 or more, such as 100", field="starts")
    if starts > RARE:
        raise LevadeError(f"{starts} falls are too many; give at most {RARE}", field="starts")
    if processes < 1:
        raise LevadeError(f"{processes} processes are too few; give 1 or more", field="jobs")
    if processes > 1 and ray is not None:
        raise LevadeError(
            f"{processes} processes are for this computer; a Ray cluster uses all of its CPUs", field="jobs"
        )
    if not shard.of(starts):
        raise LevadeError(f"{starts} falls have no shard {shard}; give as many falls as shards", field="starts")
    if task.start.fallen is None and (directory / LIBRARY).is_file():  # keep its falls, even if the default has changed
        task = replace(task, start=read_library(directory)[0].start)
    demands = None if hardware is None else hardware.demands
    falls = Falls(task, robot=robot, seed=seed, threads=threads, demands=demands)
    with _workers(directory, robot, processes, ray) as workers:
        with storing(directory, then=Remedy("give another directory", "elsewhere")):
            for name in (FALLS, MOTIONS):
                (directory / name).mkdir(parents=True, exist_ok=True)
        with locked(directory, "library"):
            begin(directory, falls, seed, starts, shard, hardware)
            if isinstance(workers, Spread):
                workers.begin(falls.simulation.robot)
            _Builder(falls, directory, seed, shard.of(starts), hardware, observe, stopping).go(workers)
    return Library.load(directory)


def rounds(starts: int) -> Iterator[tuple[int, int]]:
    """Divide falls into rounds of 1, 1, 2, 4, ..., then `_ROUND` falls, then a part `_GROWTH` of the falls before.

    Args:
        starts: Total number of falls.

    Yields:
        Index of the first fall of a round, and the index after its last.
    """
    first = 0
    while first < starts:
        size = max(min(first, _ROUND), first // _GROWTH, 1)
        yield first, min(first + size, starts)
        first += size


_Workers = Pool[Fall | Row, tuple[Array, Array] | None] | Spread


def _workers(
    directory: Path, robot: Robot | None, processes: int, ray: str | None
) -> AbstractContextManager[_Workers | None]:
    """Make what works on a library besides this process. None if nothing does."""
    if ray is not None:
        return Spread(directory, address=ray)
    return Pool(Workshop(directory, robot), processes) if processes > 1 else nullcontext()


class _Ended(Exception):
    """Ends the build."""


class _Builder:
    """Runs the rounds of a build, in this process or in others."""

    def __init__(
        self,
        falls: Falls,
        directory: Path,
        seed: int,
        own: tuple[int, ...],
        hardware: Hardware | None,
        observe: Callable[[Progress], object] | None,
        stopping: Callable[[], bool],
    ) -> None:
        self._falls, self._directory, self._own = falls, directory, own
        self._observe, self._stopping = observe, stopping
        self._spread: Spread | None = None
        self._solver = Solver(falls, directory, seed, hardware=hardware, stopping=stopping, observe=self._tell)
        self._solver.load([int(path.stem) for path in (directory / FALLS).glob("[0-9]*.json") if path.stem.isdecimal()])

    def go(self, workers: _Workers | None) -> None:
        """Run all rounds, then try every pair of fall and motion, until done or stopped."""
        self._spread = workers if isinstance(workers, Spread) else None
        if self._spread:
            self._tell()  # how many CPUs there are
        with suppress(_Ended):
            known: tuple[int, ...] = ()
            for first, last in rounds(len(self._own)):
                falls = self._own[first:last]
                self._solve(workers, falls, known)
                known += falls
                added = self._rare(falls, known)
                self._solve(workers, added, known)
                known += added
            self._complete(workers)

    def _rare(self, falls: tuple[int, ...], known: tuple[int, ...]) -> tuple[int, ...]:
        """Choose rare ones of the further falls that were dropped with some falls."""
        records = self._solver.records
        dropped = [one for i in falls for one in records[i].further]
        return rare(dropped, [records[i].lying for i in known], self._falls.mirror)

    def _solve(self, workers: _Workers | None, falls: tuple[int, ...], after: tuple[int, ...]) -> None:
        """Solve the falls of a round that are not done yet."""
        pending = [i for i in falls if i not in self._solver.records]
        if workers is None:
            self._solver.solve(pending, after=after)
        else:
            self._round(workers, pending, after)
        self._check()

    def _round(self, workers: _Workers, pending: Sequence[int], after: tuple[int, ...]) -> None:
        for fall, _ in workers.each([Fall(i, after) for i in pending], waiting=self._check):
            self._solver.load([fall.number])
            self._tell()
            self._check()

    def _check(self) -> None:
        """Abandon the round and its unfinished falls when the build has to end."""
        if self._stopping():
            raise _Ended

    def _complete(self, workers: _Workers | None) -> None:
        """Try every motion from every fall, on the model and on a perturbed model, and write which ones work."""
        records = self._solver.records
        falls = tuple(sorted(records))  # in a library that was merged, also the rare falls of its shards
        known = Knowledge.of([records[i] for i in falls], self._falls.mirror)
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
            for row, found in workers.each([Row(i, falls) for i in index], waiting=self._check):
                assert found is not None
                success[index[row.number]], perturbed[index[row.number]] = found
                self._check()
        place = self._directory / SUCCESS
        with storing(place, then=Remedy("make room, then build again")), replacing(place) as partial:
            tables = {"success": success == 1.0, "perturbed": perturbed == 1.0}
            np.savez(partial, falls=known.falls, motions=known.motions, **tables)
        shutil.rmtree(self._directory / PURSUITS, ignore_errors=True)  # left by a build that was killed

    def _tell(self) -> None:
        if self._observe is None:
            return
        own = set(self._own)
        records = [record for record in self._solver.records.values() if record.rare or record.fall in own]
        methods = Counter(record.method for record in records)
        motions = sum(record.motion == record.fall for record in records)
        trials = sum(record.trials for record in records)
        cpus = None if self._spread is None else self._spread.cpus
        added = sum(record.rare for record in records)
        self._observe(Progress(len(records) - added, len(self._own), motions, methods, trials, added, cpus))
