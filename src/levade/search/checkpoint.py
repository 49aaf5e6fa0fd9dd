"""Checkpoint of a run: a header, then a line for each evaluation, so that an interrupted run loses none.

    {"task": "rearing", "seed": 0, "versions": {...}, "task_checksum": 123, "format": 3, "running": 789}
    {"checksum": 456, "terms": {...}, "errors": {...}, "success": [...], ..., "running": 790}
    ...
    {"finished": true, "running": 791}

A resumed run answers its search from these lines without simulating, up to exactly the state where it stopped. A last line that
was cut off does not count as damage: its trials are simulated again. ``running`` is the CRC-32 of everything before it in the
file, without the earlier checksums. It reveals a line that was changed, moved or lost, and every line after it.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from levade.errors import LevadeError
from levade.search.evaluation import Record
from levade.search.initial import InitialGuess
from levade.writing import write_text

CHECKPOINT = "checkpoint.jsonl"

FORMAT = 3
"""Version of the layout. It increases when a reader of the old layout would be wrong.

2: without ``running``. It can be read; a resumed run writes the file again in layout 3.
3: with ``running``.
"""

_END, _FINISHED = {"finished": True}, '{"finished": true'
"""Last line of a finished run, and how it begins."""

_RUNNING = ', "running": '

_UNREADABLE = (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError)
"""Exceptions that a damaged line causes."""


class LayoutError(LevadeError):
    """Says that another version of levade wrote the checkpoint.

    Attributes:
        finished: Whether the run finished.
    """

    def __init__(self, message: str, *, finished: bool = False) -> None:
        super().__init__(message)
        self.finished = finished


@dataclass(frozen=True)
class Header:
    """The first line of a checkpoint.

    Attributes:
        task: Name of the task.
        seed: Seed of the run.
        versions: Versions of the libraries that decide its bits.
        task_checksum: Checksum of the task without the changes that a run makes to it on the way.
        initial: The initial guess, as `InitialGuess.to_json` returns it. None if the search began without one.
    """

    task: str
    seed: int
    versions: Mapping[str, str]
    task_checksum: int
    initial: Mapping[str, Any] | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the header as it stands in the file."""
        return {**vars(self), "format": FORMAT}


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """The content of a checkpoint.

    Attributes:
        header: Its first line.
        records: The evaluations up to the first line that cannot be read.
        finished: Whether the run finished.
        damage: A message that says what cannot be read. None if everything can.
    """

    header: Header
    records: list[Record]
    finished: bool
    damage: str | None


class Writer:
    """Appends lines to an open checkpoint.

    Args:
        file: The file, positioned at its end.
        running: CRC-32 of the file's content, without the checksums themselves.
    """

    def __init__(self, file: IO[str], running: int) -> None:
        self._file, self._running = file, running

    def add(self, content: Mapping[str, Any]) -> None:
        """Write a line.

        Args:
            content: What the line says, without its checksum.

        Raises:
            OSError: If the file cannot be written.
        """
        line, self._running = _line(content, self._running)
        self._file.write(line)
        self._file.flush()

    def close(self) -> None:
        """Close the file.

        Raises:
            OSError: If the file cannot be written.
        """
        self._file.close()


def read(directory: Path) -> Checkpoint:
    """Read the checkpoint in a directory.

    Args:
        directory: Directory of the run.

    Raises:
        LevadeError: If its header cannot be read.
        LayoutError: If another version of levade wrote it.
    """
    path = directory / CHECKPOINT
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise LevadeError(f"{path}: cannot be read ({error.strerror})") from None
    lines = text.split("\n")
    layout = _layout(lines[0])
    finished = len(lines) > 2 and lines[-2].startswith(_FINISHED)
    if layout is not None and layout not in (2, FORMAT):
        raise LayoutError(
            f"{path}: has layout {layout}, but this levade reads layout {FORMAT}; start again, or use the levade that wrote it",
            finished=finished,
        )
    if finished:
        lines = [*lines[:-2], ""]
    try:
        first, *rest = _contents(lines, checked=layout == FORMAT)
        header = _header(first)
    except (*_UNREADABLE, LevadeError):
        raise LevadeError(f"{path}: is damaged, its first line is no header; start again") from None
    records = list(_records(rest))
    whole = len(lines) - 2  # without the header, and what is after the last line end
    damage = None
    if len(records) < whole:
        at = f"line {len(records) + 2} of {whole + 1}"
        damage = f"{path}: {at} is damaged; what was recorded from there on is simulated again"
    return Checkpoint(header, records, finished, damage)


def begin(directory: Path, header: Header, records: list[Record] | None = None) -> Writer:
    """Write a checkpoint's header and the records to keep, and open it for more.

    Args:
        directory: Directory of the run.
        header: The first line.
        records: Records that the checkpoint keeps. None for a new run.

    Raises:
        OSError: If the file cannot be written.
    """
    lines, running = [], 0
    for content in (header.to_json(), *(record.to_json() for record in records or ())):
        line, running = _line(content, running)
        lines.append(line)
    write_text(directory / CHECKPOINT, "".join(lines))
    return Writer((directory / CHECKPOINT).open("a", encoding="utf-8"), running)


def add(file: Writer, record: Record) -> None:
    """Add a record.

    Args:
        file: The open checkpoint.
        record: The record to append.

    Raises:
        OSError: If the file cannot be written.
    """
    file.add(record.to_json())


def finish(file: Writer) -> None:
    """Record that the run finished.

    Args:
        file: The open checkpoint.

    Raises:
        OSError: If the file cannot be written.
    """
    file.add(_END)


def _line(content: Mapping[str, Any], running: int) -> tuple[str, int]:
    """Return a line with the running checksum, and that checksum. ``running`` is the checksum of the lines before."""
    text = json.dumps(content)
    running = zlib.crc32(text.encode(), running)
    return f"{text[:-1]}{_RUNNING}{running}}}\n", running


def _contents(lines: list[str], *, checked: bool) -> Iterator[dict[str, Any]]:
    """Yield what the lines hold, up to the first damaged one. ``checked`` says whether they have running checksums."""
    running = 0
    for line in lines:
        head, _, told = line.rpartition(_RUNNING) if checked else (line[:-1], "", "")
        text = head + "}"
        running = zlib.crc32(text.encode(), running)
        if not (told == f"{running}}}" if checked else text == line):
            return
        try:
            content = json.loads(text)
        except _UNREADABLE:
            return
        if not isinstance(content, dict):
            return
        yield content


def _layout(line: str) -> int | None:
    """Return the layout that a header names, whatever else it contains; None if it is no header of any layout."""
    try:
        content = json.loads(line)
        layout, seed, versions = content.get("format", 1), content["seed"], content["versions"]
    except _UNREADABLE:
        return None
    return layout if type(layout) is int and type(seed) is int and isinstance(versions, dict) else None


def _header(content: dict[str, Any]) -> Header:
    """Return the header that a line holds. Raises TypeError and the like if it holds none."""
    header = Header(**{key: value for key, value in content.items() if key != "format"})
    versions = header.versions
    texts = [header.task, *versions, *versions.values()]
    numbers = [header.seed, header.task_checksum]
    if not (isinstance(versions, dict) and all(isinstance(text, str) and text.isprintable() for text in texts)):
        raise TypeError
    if not all(type(number) is int and number >= 0 for number in numbers):
        raise TypeError
    if header.initial is not None:
        InitialGuess.from_json(header.initial)
    return header


def _records(contents: list[dict[str, Any]]) -> Iterator[Record]:
    """Yield the records up to the first damaged one."""
    for content in contents:
        try:
            yield Record.from_json(content)
        except _UNREADABLE:
            return
