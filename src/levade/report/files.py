"""Write files completely or not at all."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from levade.errors import LevadeError
from levade.writing import check_replaceable, replacing


@contextmanager
def writing(path: Path, *, instead: str = "give a file that can") -> Iterator[Path]:
    """Give a place next to a file to write it. At the end it replaces the file; after an error it is removed.

    The file's directory is created if it does not exist.

    Args:
        path: The file.
        instead: What the reader of an error can do.

    Yields:
        The file to write.

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
