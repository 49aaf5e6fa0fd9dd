"""What a pursuit's directory says of it: what was asked for, which search is gone on from; and how it is forgotten."""

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
LIMITS, ROBUST, CLOSED = ("limits-1", "limits-2", "limits-3"), "robust", "feedback"
FINER = ("finer-1", "finer-2", "finer-3")
MORE = ("limits-4", "limits-5", "limits-6", "limits-7", "limits-8")
"""Searches within limits that may follow those in `LIMITS`, each with other random numbers."""

AGAIN = "again"
"""Begin of the names of directories in which the searches are made again, with another seed: ``again-1``, ..."""


@dataclass
class State:
    """What hardware.json says: what was asked for, and which search within limits was chosen to go on from, by these demands.

    A later call goes on from the same one, so that nothing that began around it is made again.
    """

    directory: Path
    task: Task
    seed: int
    demands: Demands
    chosen: str | None = None

    @classmethod
    def of(cls, directory: Path, task: Task, seed: int, demands: Demands) -> State:
        """The state of a pursuit, which may have begun in an earlier call."""
        state = cls(directory, task, seed, demands)
        if is_pursuit(directory):
            content = read_yaml(directory / ASKED)
            if content.get("demands") == asdict(demands) and content.get("chosen") in (*LIMITS, *MORE):
                state.chosen = content["chosen"]
        return state

    def write(self) -> None:
        content = {
            "task": task_to_dict(self.task, code=True),
            "seed": self.seed,
            "demands": asdict(self.demands),
            "chosen": self.chosen,
        }
        with storing(self.directory / ASKED, then=Remedy("give another directory")):
            write_text(self.directory / ASKED, json.dumps(content, ensure_ascii=False, indent=1) + "\n")


def read_pursuit(directory: Path) -> tuple[Task, int, Demands | None]:
    """What a pursuit in a directory was asked for: task, seed and demands; None for the usual ones.

    Raises:
        LevadeError: If there is none.
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
        raise LevadeError(f"{where}: is not what a pursuit wrote; start again") from None


def is_pursuit(directory: Path) -> bool:
    """Whether a directory holds a pursuit."""
    return (directory / ASKED).is_file()


def again(directory: Path, number: int) -> Path:
    """Where the searches of a pursuit are made again for the first, second, ... time."""
    return directory / f"{AGAIN}-{number}"


def discard(directory: Path) -> None:
    """Forget the run or the searches that a directory holds, so that a new pursuit, or run, begins from nothing.

    Raises:
        LevadeError: If one of them goes on.
    """
    searches = [directory, *(directory / name for name in (*LIMITS, *MORE, ROBUST, CLOSED, *FINER))]
    for search in searches:
        check_unlocked(search)
    number = 1
    while is_pursuit(again(directory, number)):
        discard(again(directory, number))
        number += 1
    with storing(directory, then=Remedy("give another directory")):
        for search in searches:
            (search / CHECKPOINT).unlink(missing_ok=True)
        if (directory / CERTIFICATE).exists():  # and the motion that it is of
            (directory / MOTION).unlink(missing_ok=True)
        for name in (CERTIFICATE, PAGE, ASKED):
            (directory / name).unlink(missing_ok=True)


def check_same(directory: Path, task: Task, seed: int) -> None:
    """Raise LevadeError if a directory holds another pursuit, a run, or files of neither."""
    remedies = (Remedy("write elsewhere", "elsewhere"), Remedy("replace it", "replace"))
    if is_pursuit(directory):
        known, began, _ = read_pursuit(directory)
        if (task_to_dict(known, code=True), began) != (task_to_dict(task, code=True), seed):
            raise LevadeError(f"{directory}: holds the pursuit of another task, robot or seed", remedies=remedies)
    elif (directory / CHECKPOINT).exists():
        raise LevadeError(f"{directory}: holds a run that is no pursuit for hardware", remedies=remedies)
    else:
        check_replaceable(directory)
