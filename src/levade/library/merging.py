"""Shards of one library become the library: each was built on a machine of its own, of every n-th fall.

    merge([Path("shard-0"), Path("shard-1")], Path("falls"))

A shard knows nothing of the others, so that its motions differ from those of a library that was built whole. Building the
merged library tries every motion from every fall.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from levade.errors import LevadeError, Remedy
from levade.library.falls import Falls
from levade.library.records import FALLS, MOTIONS, Record, motion_path, record_path
from levade.library.storing import WHOLE, begin, read_library, read_shard, read_starts
from levade.locking import locked
from levade.robots import Robot
from levade.search.storage import storing
from levade.tasks import task_to_dict
from levade.writing import replacing


@dataclass(frozen=True)
class Merged:
    """What a merge gave.

    Attributes:
        falls: Falls that are there now.
        starts: Falls that there are to be.
        motions: Motions that are there now.
    """

    falls: int
    starts: int
    motions: int


def merge(shards: Sequence[Path], directory: Path, *, robot: Robot | None = None) -> Merged:
    """Join shards in a directory. A merge that was interrupted can be made again.

    Args:
        shards: Directories of shards of one library; of some of them, or all.
        directory: Where to write the library: a new one, or that of an earlier merge.
        robot: The robot, if the task's name does not say it.

    Raises:
        LevadeError: If they are not of one task, robot, seed and number of shards, or the directory holds something else.
    """
    if not shards:
        raise LevadeError("no shards to merge; give their directories")
    task, seed = read_library(shards[0])
    n = read_shard(shards[0]).shards
    seen: dict[int, Path] = {}
    for place in shards:
        other, of = read_library(place), read_shard(place)
        if (task_to_dict(other[0]), other[1]) != (task_to_dict(task), seed):
            raise LevadeError(
                f"{place}: is of another task, robot or seed than {shards[0]}; merge shards of one library"
            )
        if of == WHOLE:
            raise LevadeError(f"{place}: is a whole library, no shard; merge shards")
        if of.shards != n:
            raise LevadeError(f"{place}: is shard {of}, and {shards[0]} one of {n}; merge shards of one library")
        if of.number in seen:
            raise LevadeError(f"{place}: is shard {of}, as {seen[of.number]} is; give each shard once")
        seen[of.number] = place
    starts = max(read_starts(place) for place in shards)
    with storing(directory, then=Remedy("give another directory")):
        for name in (FALLS, MOTIONS):
            (directory / name).mkdir(parents=True, exist_ok=True)
    falls = Falls(task, robot=robot, seed=seed, threads=1)
    with locked(directory, "library"):
        begin(directory, falls, seed, starts)
        with storing(directory, then=Remedy("make room, then merge again")):
            for place in shards:
                _copy(place, directory)
    done = [Record.load(path) for path in sorted((directory / FALLS).glob("[0-9]*.json"))]
    return Merged(len(done), starts, sum(record.motion == record.fall for record in done))


def _copy(shard: Path, directory: Path) -> None:
    """The falls of a shard that are done and not there yet: first a fall's motion, then its record."""
    for path in sorted((shard / FALLS).glob("[0-9]*.json")):
        record = Record.load(path)
        if record_path(directory, record.fall).exists():  # what has been tried of its motion is there, too
            continue
        if record.motion == record.fall:
            with replacing(motion_path(directory, record.fall)) as partial:
                shutil.copyfile(motion_path(shard, record.fall), partial)
        with replacing(record_path(directory, record.fall)) as partial:
            shutil.copyfile(path, partial)
