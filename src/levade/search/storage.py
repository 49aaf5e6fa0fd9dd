"""Writing a run's files: whole or not at all, and what is said when that fails."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from levade.errors import LevadeError


class StorageError(LevadeError):
    """The directory can no longer be written; what was there before still is."""


def write_text(path: Path, text: str) -> None:
    """Write a file, or leave the one that is there. Raises OSError."""
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


@contextmanager
def closing(file: IO[str]) -> Iterator[None]:
    """Close a file whose every line has been flushed: what a full disk refused is not tried, and reported, again."""
    try:
        yield
    finally:
        with suppress(OSError):
            file.close()


@contextmanager
def storing(path: Path, *, then: str) -> Iterator[None]:
    """Turn an OSError into a `StorageError` that names the path and says what to do.

    Args:
        path: What is written.
        then: What to do about it, such as "make room, then resume".
    """
    try:
        yield
    except OSError as error:
        raise StorageError(f"{path}: cannot be written ({error.strerror}); {then}") from None
