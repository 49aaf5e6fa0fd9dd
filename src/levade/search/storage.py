"""Write a run's files, and say what to do when that fails."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Protocol

from levade.errors import LevadeError, Remedy


class StorageError(LevadeError):
    """Says that the directory can no longer be written. What was there before is still there."""


class Closable(Protocol):
    """An object that can be closed."""

    def close(self) -> object:
        """Close it."""
        ...


@contextmanager
def closing(file: Closable) -> Iterator[None]:
    """Close a file in the end and ignore errors: every line was flushed before, and an error was reported then.

    Args:
        file: The file to close.
    """
    try:
        yield
    finally:
        with suppress(OSError):
            file.close()


@contextmanager
def storing(path: Path, *, then: Remedy, kept: str = "") -> Iterator[None]:
    """Turn an OSError into a `StorageError` that names the path and says what to do.

    Args:
        path: File or directory that is written.
        then: What to do about a failure.
        kept: What is not lost, for the message, such as "90 trials are kept".

    Raises:
        StorageError: If the path cannot be written.
    """
    try:
        yield
    except OSError as error:
        what = f"{path}: cannot be written ({error.strerror}){kept and f'; {kept}'}"
        raise StorageError(what, remedies=(then,)) from None
