"""Read, write and discard the state of a pursuit: its arguments, and the search that later ones begin around."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from levade.checks.record import CERTIFICATE, CERTIFICATE_PAGE
from levade.document import build, read_yaml
from levade.errors import LevadeError, Remedy
from levade.search.checkpoint import CHECKPOINT
from levade.search.run import MOTION, PURSUIT, check_replaceable, check_unlocked
from levade.search.storage import storing
from levade.tasks import Demands, Task, task_from_dict, task_to_dict
from levade.writing import write_text

ASKED, PAGE = PURSUIT, CERTIFICATE_PAGE
LIMITS = ("limits-1", "limits-2", "limits-3")
FINER = ("finer-1", "finer-2", "finer-3")
MORE = ("limits-4", "limits-5", "limits-6", "limits-7", "limits-8")
"""Searches within limits that may follow those in `LIMITS`. Each has other random numbers."""

NEAR = "near"
"""The search around a given motion, which takes the place of those in `LIMITS`."""

_WITHIN = (*LIMITS, *MORE, NEAR)

ROBUST = {name: name.replace("limits", "robust") for name in _WITHIN} | {NEAR: "robust"}
CLOSED = {name: name.replace("limits", "feedback") for name in _WITHIN} | {NEAR: "feedback"}
"""Search within limits -> the search on perturbed models around its motion: `ROBUST` without feedback, `CLOSED` with it."""

AGAIN = "again"
"""Prefix of the directories for searches that are repeated with another seed: ``again-1``, ..."""


@dataclass
class State:
    """The content of hardware.json: the arguments of a pursuit, and the search within limits that later ones begin around.

    A later call with the same demands keeps this search, so that no search around its motion is repeated.

    Attributes:
        directory: Directory of the pursuit.
        task: What the motion is to do.
        seed: Seed of the pursuit.
        demands: Demands of the certificate.
        chosen: Name of the search within limits that later ones begin around. None while there is none.
    """

    directory: Path
    task: Task
    seed: int
    demands: Demands
    chosen: str | None = None

    @classmethod
    def of(cls, directory: Path, task: Task, seed: int, demands: Demands) -> State:
        """Return the state of a pursuit, which may have begun in an earlier call.

        Args:
            directory: Directory of the pursuit.
            task: What the motion is to do.
            seed: Seed of the pursuit.
            demands: Demands of the certificate.
        """
        state = cls(directory, task, seed, demands)
        if is_pursuit(directory):
            content = read_yaml(directory / ASKED)
            if content.get("demands") == asdict(demands) and content.get("chosen") in (*LIMITS, *MORE):
                state.chosen = content["chosen"]
        return state

    def write(self) -> None:
        """Write hardware.json.

        Raises:
            LevadeError: If the file cannot be written.
        """
        content = {
            "task": task_to_dict(self.task, code=True),
            "seed": self.seed,
            "demands": asdict(self.demands),
            "chosen": self.chosen,
        }
        with storing(self.directory / ASKED, then=Remedy("give another directory", "elsewhere")):
            write_text(self.directory / ASKED, json.dumps(content, ensure_ascii=False, indent=1) + "\n")


def read_pursuit(directory: Path) -> tuple[Task, int, Demands | None]:
    """Read the arguments of the pursuit in a directory.

    Args:
        directory: Directory of the pursuit.

    Returns:
        Task, seed and demands. The demands are None for the usual ones.

    Raises:
        LevadeError: If the directory holds no pursuit.
    """
    content, where = read_yaml(directory / ASKED), str(directory / ASKED)
    try:
        demands = content.get("demands")
        return (
            task_from_dict(content["task"], where=where, code=True),
            int(content["seed"]),
            None if demands is None else build(Demands, demands, where=f"{where}.demands"),
        )
    except (KeyError, TypeError, ValueError):
        raise LevadeError(f"{where}: was not written by a pursuit; start again") from None


def is_pursuit(directory: Path) -> bool:
    """Tell whether a directory holds a pursuit.

    Args:
        directory: The directory.
    """
    return (directory / ASKED).is_file()


def again(directory: Path, number: int) -> Path:
    """Return the directory in which the searches of a pursuit are repeated.

    Args:
        directory: Directory of the pursuit.
        number: Number of the repetition, from 1.
    """
    return directory / f"{AGAIN}-{number}"


def discard(directory: Path) -> None:
    """Discard the run or the searches that a directory holds, so that a new run or pursuit begins from nothing.

    Args:
        directory: Directory of the run or the pursuit.

    Raises:
        LevadeError: If one of them is still running.
    """
    searches = [directory, *(directory / name for name in (*_WITHIN, *ROBUST.values(), *CLOSED.values(), *FINER))]
    for search in searches:
        check_unlocked(search)
    number = 1
    while is_pursuit(again(directory, number)):
        discard(again(directory, number))
        number += 1
    with storing(directory, then=Remedy("give another directory", "elsewhere")):
        for search in searches:
            (search / CHECKPOINT).unlink(missing_ok=True)
        if (directory / CERTIFICATE).exists():  # and the motion that it certifies
            (directory / MOTION).unlink(missing_ok=True)
        for name in (CERTIFICATE, PAGE, ASKED):
            (directory / name).unlink(missing_ok=True)


def check_same(directory: Path, task: Task, seed: int) -> None:
    """Check that a directory is free for a pursuit or holds the same one.

    Args:
        directory: The directory.
        task: What the motion is to do.
        seed: Seed of the pursuit.

    Raises:
        LevadeError: If it holds another pursuit, a run, or other files that would be overwritten.
    """
    remedies = (Remedy("write elsewhere", "elsewhere"), Remedy("replace it", "replace"))
    if is_pursuit(directory):
        known, began, _ = read_pursuit(directory)
        if (task_to_dict(known, code=True), began) != (task_to_dict(task, code=True), seed):
            raise LevadeError(f"{directory}: holds the pursuit of another task, robot or seed", remedies=remedies)
    elif (directory / CHECKPOINT).exists():
        raise LevadeError(f"{directory}: holds a run that is no pursuit for hardware", remedies=remedies)
    else:
        check_replaceable(directory)
