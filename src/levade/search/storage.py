"""Writing a run's files: whole or not at all, and what is said when that fails."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Protocol

from levade.errors import LevadeError, Remedy


class StorageError(LevadeError):
    """The directory can no longer be written; what was there before still is."""


class Closable(Protocol):
    """What can be closed."""

    def close(self) -> object: ...


@contextmanager
def closing(file: Closable) -> Iterator[None]:
    """Close a file whose every line has been flushed: what a full disk refused is not tried, and reported, again."""
    try:
        yield
    finally:
        with suppress(OSError):
            file.close()


@contextmanager
def storing(path: Path, *, then: Remedy, kept: str = "") -> Iterator[None]:
    """Turn an OSError into a `StorageError` that names the path and says what to do.

    Args:
        path: What is written.
        then: What to do about it.
        kept: What is not lost, for the message, such as "90 trials are kept".
    """
    try:
        yield
    except OSError as error:
        what = f"{path}: cannot be written ({error.strerror}){kept and f'; {kept}'}"
        raise StorageError(what, remedies=(then,)) from None
