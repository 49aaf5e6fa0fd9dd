"""Files that are written whole or not at all."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from levade.errors import LevadeError
from levade.writing import check_replaceable, replacing


@contextmanager
def writing(path: Path, *, instead: str = "give a file that can") -> Iterator[Path]:
    """A place next to a file to write it at; put in the file's place at the end, removed if something goes wrong.

    The file's directory is made if need be.  instead: what the reader of the error can do.

    Raises:
        LevadeError: If it cannot be written, before any work is done.
    """
    try:
        check_replaceable(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as partial:
            yield partial
    except OSError as error:
        raise LevadeError(f"{path}: cannot be written ({error.strerror or error}); {instead}") from None
