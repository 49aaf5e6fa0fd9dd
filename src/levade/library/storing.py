"""Store what a library is built from: task, seed, number of falls, and which share of them.

begin(directory, falls, seed=0, starts=100)
task, seed = read_library(directory)
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.document import build, read_yaml
from levade.errors import LevadeError, Remedy
from levade.library.asking import LIBRARY, fold_of
from levade.library.falls import Falls
from levade.library.pursuing import Hardware
from levade.robots import Robot
from levade.search.storage import storing
from levade.tasks import Demands, Task, task_from_dict, task_to_dict, task_to_yaml
from levade.writing import write_text

TASK = "task.yaml"


@dataclass(frozen=True)
class Shard:
    """Selects every n-th fall: the share of one of n machines.

    Attributes:
        number: Index of the shard, from 0.
        shards: Number of shards, n.
    """

    number: int
    shards: int

    def __post_init__(self) -> None:
        if not 0 <= self.number < self.shards:
            raise LevadeError(
                f"{self.number}/{self.shards} is not a shard; give 0/{self.shards} to {self.shards - 1}/{self.shards}"
                if self.shards > 0
                else f"{self.number}/{self.shards} is not a shard; 0/4, 1/4, 2/4 and 3/4 divide falls into four shards",
                field="shard",
            )

    def of(self, starts: int) -> tuple[int, ...]:
        """Select the shard's falls.

        Args:
            starts: Total number of falls.

        Returns:
            Numbers of the falls.
        """
        return tuple(range(self.number, starts, self.shards))

    def __str__(self) -> str:
        return f"{self.number}/{self.shards}"


WHOLE = Shard(0, 1)


def begin(
    directory: Path,
    falls: Falls,
    seed: int,
    starts: int,
    shard: Shard = WHOLE,
    hardware: Hardware | None = None,
) -> None:
    """Write what the library is built from.

    Args:
        directory: Directory of the library.
        falls: The family of falls.
        seed: Seed of the library.
        starts: Total number of falls.
        shard: The share of the falls that the library covers.
        hardware: Demands of the hardware on each motion. None for none.

    Raises:
        LevadeError: If the directory holds another library, or cannot be written.
    """
    place = directory / LIBRARY
    if place.is_file():
        _check_same(directory, hardware)
        known, began = read_library(directory)
        if (task_to_dict(known), began) != (task_to_dict(falls.task), seed):
            raise LevadeError(
                f"{directory}: holds the library of another task, robot or seed",
                remedies=(Remedy("write elsewhere", "elsewhere"),),
            )
        if read_shard(directory) != shard:
            raise LevadeError(f"{directory}: holds shard {read_shard(directory)} of a library; merge shards first")
        _check_fold(directory, falls)
    with storing(place, then=Remedy("give another directory", "elsewhere")):
        write_text(directory / TASK, task_to_yaml(falls.task))
        mirror = None if falls.mirror is None else falls.mirror.to_json()
        postures = {"fold": falls.fold, "freeing": None if falls.folding is None else falls.folding.freeing}
        fold = "".join(f"{name}: {json.dumps(one.tolist())}\n" for name, one in postures.items() if one is not None)
        part = "" if shard == WHOLE else f"shard: [{shard.number}, {shard.shards}]\n"
        kept = "" if hardware is None else f"hardware: {json.dumps(asdict(hardware))}\n"
        write_text(place, f"seed: {seed}\nstarts: {starts}\nmirror: {json.dumps(mirror)}\n{fold}{part}{kept}")


def _check_same(directory: Path, hardware: Hardware | None) -> None:
    """Raise LevadeError unless the library in a directory makes the same demands of hardware."""
    known, elsewhere = read_hardware(directory), Remedy("write elsewhere", "elsewhere")
    if known == hardware:
        return
    if hardware is None:
        remedies = (Remedy("keep to them", "hardware"), elsewhere)
        raise LevadeError(f"{directory}: holds a library within the limits of hardware", remedies=remedies)
    if known is None:
        remedies = (Remedy("build without limits"), elsewhere)
        raise LevadeError(f"{directory}: holds a library without the limits of hardware", remedies=remedies)
    own, other = ({"trials": one.trials, "runs": one.runs, **asdict(one.demands)} for one in (known, hardware))
    what = ", ".join(f"{name} {own[name]}, not {other[name]}" for name in own if own[name] != other[name])
    raise LevadeError(f"{directory}: holds a library with other demands: {what}", remedies=(elsewhere,))


def _check_fold(directory: Path, falls: Falls) -> None:
    """Raise LevadeError unless the robot still folds up as it did before a library's motions."""
    content, where = _content(directory), str(directory / LIBRARY)
    freeing = None if falls.folding is None else falls.folding.freeing
    for name, own in (("fold", falls.fold), ("freeing", freeing)):
        known = fold_of(content.get(name), where=f"{where}: {name}")
        if _alike(known, own):
            continue
        raise LevadeError(
            f"{directory}: its robot folded up in another way, as an earlier version or file of the robot had it",
            remedies=(Remedy("build it again elsewhere", "elsewhere"),),
        )


def _alike(one: Array | None, other: Array | None) -> bool:
    """Return whether two postures are the same, or both missing."""
    if one is None or other is None:
        return one is other
    return one.shape == other.shape and np.allclose(one, other)


def read_hardware(directory: Path) -> Hardware | None:
    """Read what the library in a directory demands of hardware.

    Args:
        directory: Directory of the library.

    Returns:
        Demands and budget. None if it demands nothing.

    Raises:
        LevadeError: If the directory holds no library, or the library is damaged.
    """
    content, where = _content(directory).get("hardware"), f"{directory / LIBRARY}: hardware"
    if content is None:
        return None
    if not isinstance(content, dict) or not isinstance(content.get("demands"), dict):
        raise LevadeError(f"{where}: should have trials and demands; the file is damaged")
    trials, runs = (_whole(content.get(name), directory, f"hardware.{name}") for name in ("trials", "runs"))
    return Hardware(build(Demands, content["demands"], where=f"{where}.demands"), trials, runs)


def read_falls(
    directory: Path, *, robot: Robot | None = None, seed: int | None = None, threads: int = 1
) -> tuple[Falls, int]:
    """Build the falls of the library in a directory.

    Args:
        directory: Directory of the library.
        robot: The library's robot. Defaults to the one that the task names.
        seed: Seed of the falls. Defaults to the library's own.
        threads: Number of engine threads (0: one per core).

    Returns:
        The falls, and the library's own seed.

    Raises:
        LevadeError: If the directory holds no library, the library is damaged, or its robot cannot be loaded.
    """
    task, own = read_library(directory)
    hardware = read_hardware(directory)
    demands = None if hardware is None else hardware.demands
    falls = Falls(task, robot=robot, seed=own if seed is None else seed, threads=threads, demands=demands)
    _check_fold(directory, falls)
    return falls, own


def read_library(directory: Path) -> tuple[Task, int]:
    """Read task and seed of the library in a directory.

    Args:
        directory: Directory of the library.

    Returns:
        The task, and the seed of its falls.

    Raises:
        LevadeError: If the directory holds no library, or the library is damaged.
    """
    content = _content(directory)
    task = task_from_dict(read_yaml(directory / TASK), where=str(directory / TASK))
    return task, _whole(content.get("seed"), directory, "seed")


def read_starts(directory: Path) -> int:
    """Read the number of falls of the latest build.

    Args:
        directory: Directory of the library.

    Raises:
        LevadeError: If the directory holds no library, or the library is damaged.
    """
    return _whole(_content(directory).get("starts"), directory, "starts")


def read_shard(directory: Path) -> Shard:
    """Read which share of its falls a library covers.

    Args:
        directory: Directory of the library.

    Raises:
        LevadeError: If the directory holds no library, or the library is damaged.
    """
    shard = _content(directory).get("shard", [0, 1])
    if not (isinstance(shard, list) and len(shard) == 2):
        raise LevadeError(f"{directory / LIBRARY}: shard: should be two whole numbers; the file is damaged")
    number, shards = (_whole(one, directory, "shard") for one in shard)
    return Shard(number, shards)


def _content(directory: Path) -> Any:
    place = directory / LIBRARY
    if not place.is_file():
        raise LevadeError(f"{directory}: holds no motion library; build one, or give the directory of one")
    return read_yaml(place, like="seed and starts")


def _whole(value: Any, directory: Path, name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise LevadeError(f"{directory / LIBRARY}: {name}: should be a whole number; the file is damaged")
    return value
