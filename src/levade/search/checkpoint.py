"""The checkpoint of a run: a header, then a line for each evaluation, so that an interrupted run loses none.

    {"task": "rearing", "seed": 0, "versions": {...}, "task_checksum": 123, "format": 2}
    {"checksum": 456, "terms": {...}, "errors": {...}, "success": [...], ...}
    ...
    {"finished": true}

A resumed run answers its search from these lines without simulating, to exactly the state where it stopped. A last line that
was cut off is no damage: its trials are simulated again.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from levade.errors import LevadeError
from levade.search.evaluation import Record
from levade.search.storage import write_text

CHECKPOINT = "checkpoint.jsonl"

FORMAT = 2
"""Version of the layout; raised when a reader of the old one would be wrong."""

_END = '{"finished": true}\n'
"""Last line of a run that came to its end."""


class LayoutError(LevadeError):
    """Another version of levade wrote the checkpoint.

    Attributes:
        finished: Whether the run came to its end.
    """

    def __init__(self, message: str, *, finished: bool) -> None:
        super().__init__(message)
        self.finished = finished


@dataclass(frozen=True)
class Header:
    """The first line of a checkpoint.

    Attributes:
        task: Name of the task.
        seed: Seed of the run.
        versions: Versions that decide its bits.
        task_checksum: Checksum of the task without the changes that a run makes on the way.
        initial: What the search began around, as `InitialGuess.to_json` has it. None for nothing.
    """

    task: str
    seed: int
    versions: Mapping[str, str]
    task_checksum: int
    initial: Mapping[str, Any] | None = None

    def to_json(self) -> dict[str, Any]:
        """As in the file."""
        return {**vars(self), "format": FORMAT}


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """What a checkpoint says.

    Attributes:
        header: Its first line.
        records: The evaluations up to the first line that cannot be read.
        finished: Whether the run came to its end.
        damage: What cannot be read, in words. None if nothing.
    """

    header: Header
    records: list[Record]
    finished: bool
    damage: str | None


def read(directory: Path) -> Checkpoint:
    """Read the checkpoint in a directory.

    Raises:
        LevadeError: If its header cannot be read.
        LayoutError: If another version of levade wrote it.
    """
    path = directory / CHECKPOINT
    text = path.read_text(encoding="utf-8", errors="replace")
    finished = text.endswith(_END)
    text = text.removesuffix(_END)
    lines = text.splitlines()
    try:
        content = json.loads(lines[0])
        layout = content.pop("format", 1)
        if not (isinstance(content["seed"], int) and isinstance(content["versions"], dict)):
            raise TypeError
        header = Header(**content) if layout == FORMAT else None
    except (ValueError, LookupError, TypeError, AttributeError):
        raise LevadeError(f"{path}: damaged, its first line is no header; start again") from None
    if header is None:
        raise LayoutError(
            f"{path}: layout {layout}, but this levade reads layout {FORMAT}; start again, or use the levade that wrote it",
            finished=finished,
        )
    records = list(_records(lines[1:]))
    whole = text[: text.rfind("\n") + 1].splitlines()[1:]
    damage = None
    if len(records) < len(whole):
        damage = (
            f"{path}: line {len(records) + 2} of {len(whole) + 1} is damaged; what was recorded from there on is simulated"
            " again"
        )
    return Checkpoint(header, records, finished, damage)


def begin(directory: Path, header: Header, records: list[Record] | None = None) -> IO[str]:
    """Write a checkpoint's header, and records that are kept, and open it for more. Raises OSError."""
    kept = [json.dumps(header.to_json()), *(json.dumps(record.to_json()) for record in records or ())]
    write_text(directory / CHECKPOINT, "".join(line + "\n" for line in kept))
    return (directory / CHECKPOINT).open("a", encoding="utf-8")


def add(file: IO[str], record: Record) -> None:
    """Add a record. Raises OSError."""
    file.write(json.dumps(record.to_json()) + "\n")
    file.flush()


def finish(file: IO[str]) -> None:
    """Say that the run came to its end. Raises OSError."""
    file.write(_END)
    file.flush()


def _records(lines: list[str]) -> Iterator[Record]:
    """The records up to the first line that is not whole."""
    for line in lines:
        try:
            yield Record.from_json(json.loads(line))
        except (ValueError, LookupError, TypeError, AttributeError):
            return
