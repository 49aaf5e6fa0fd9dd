"""Merge the shards of a library. Each shard was built on its own machine and covers every n-th fall.

    merge([Path("shard-0"), Path("shard-1")], Path("falls"))

A shard does not see the motions of the others, so its motions differ from those of a library that was built as a whole.
Building the merged library tries every motion from every fall.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from levade.errors import LevadeError, Remedy
from levade.library.records import FALLS, MOTIONS, Record, certificate_path, motion_path, record_path
from levade.library.storing import WHOLE, begin, read_falls, read_hardware, read_library, read_shard, read_starts
from levade.locking import locked
from levade.robots import Robot
from levade.search.storage import storing
from levade.tasks import task_to_dict
from levade.writing import replacing


@dataclass(frozen=True)
class Merged:
    """Reports the result of a merge.

    Attributes:
        falls: Number of falls in the merged library.
        starts: Number of falls that the complete library will have.
        motions: Number of motions in the merged library.
    """

    falls: int
    starts: int
    motions: int


def merge(shards: Sequence[Path], directory: Path, *, robot: Robot | None = None) -> Merged:
    """Merge shards into one directory. An interrupted merge can be repeated.

    Args:
        shards: Directories of some or all shards of one library.
        directory: Directory to write to: a new one, or that of an earlier merge.
        robot: The robot. Defaults to the one that the task names.

    Returns:
        Numbers of falls and motions.

    Raises:
        LevadeError: If the shards differ in task, robot, seed or number of shards, or the directory holds something else.
    """
    if not shards:
        raise LevadeError("there are no shards to merge; give their directories")
    (task, seed), hardware = read_library(shards[0]), read_hardware(shards[0])
    n = read_shard(shards[0]).shards
    seen: dict[int, Path] = {}
    for place in shards:
        other, of = read_library(place), read_shard(place)
        if (task_to_dict(other[0]), other[1]) != (task_to_dict(task), seed):
            raise LevadeError(f"{place}: has another task, robot or seed than {shards[0]}; merge shards of one library")
        if read_hardware(place) != hardware:
            raise LevadeError(f"{place}: makes other demands of hardware than {shards[0]}; merge shards of one library")
        if of == WHOLE:
            raise LevadeError(f"{place}: is a whole library, not a shard; give directories of shards")
        if of.shards != n:
            raise LevadeError(f"{place}: is shard {of}, but {shards[0]} is one of {n}; merge shards of one library")
        if of.number in seen:
            raise LevadeError(f"{place}: is shard {of}, and so is {seen[of.number]}; give each shard once")
        seen[of.number] = place
    starts = max(read_starts(place) for place in shards)
    with storing(directory, then=Remedy("give another directory", "elsewhere")):
        for name in (FALLS, MOTIONS):
            (directory / name).mkdir(parents=True, exist_ok=True)
    falls, _ = read_falls(shards[0], robot=robot)
    with locked(directory, "library"):
        begin(directory, falls, seed, starts, hardware=hardware)
        with storing(directory, then=Remedy("make room, then merge again")):
            for place in shards:
                _copy(place, directory)
    done = [Record.load(path) for path in sorted((directory / FALLS).glob("[0-9]*.json"))]
    return Merged(len(done), starts, sum(record.motion == record.fall for record in done))


def _copy(shard: Path, directory: Path) -> None:
    """Copy the finished falls of a shard that are not there yet: first a fall's motion and certificate, then its record."""
    for path in sorted((shard / FALLS).glob("[0-9]*.json")):
        record = Record.load(path)
        if record_path(directory, record.fall).exists():  # what has been tried of its motion is there, too
            continue
        own = [] if record.motion != record.fall and record.failed is None else [motion_path]
        own += [] if record.failed is None else [certificate_path]
        for place_of in (*own, record_path):
            place_of(directory, record.fall).parent.mkdir(exist_ok=True)
            with replacing(place_of(directory, record.fall)) as partial:
                shutil.copyfile(place_of(shard, record.fall), partial)
