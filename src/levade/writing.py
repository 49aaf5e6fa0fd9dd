"""Write files safely: completely or not at all, and only in place of regular files.

    with replacing(path) as partial:
        partial.write_text("...", encoding="utf-8")

A file is first written next to its place, under a name that nobody can guess, so no planted link is followed. A device, a pipe
or a link in its place stays as it is. Links to directories on the way are followed, as usual.
"""

from __future__ import annotations

import errno
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_BINARY = getattr(os, "O_BINARY", 0)

_KINDS = (
    (stat.S_ISDIR, errno.EISDIR, "Is a directory"),
    (stat.S_ISLNK, errno.ELOOP, "Is a symbolic link, which is not followed or replaced"),
    (stat.S_ISCHR, errno.EINVAL, "Is a device, not a file"),
    (stat.S_ISBLK, errno.EINVAL, "Is a device, not a file"),
    (stat.S_ISFIFO, errno.EINVAL, "Is a pipe, not a file"),
    (stat.S_ISSOCK, errno.EINVAL, "Is a socket, not a file"),
)


def check_replaceable(path: Path) -> None:
    """Check that a path is free or a regular file.

    Args:
        path: The path. A link in its place is not followed.

    Raises:
        OSError: If it is anything else; the text says what.
    """
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return
    for is_kind, number, words in _KINDS:
        if is_kind(mode):
            raise OSError(number, words, str(path))


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Make an empty file next to a path, and put it in the path's place at the end of the context.

    Args:
        path: A free path, or a regular file, which stays if anything goes wrong.

    Yields:
        The file to write, with the suffix of the path.

    Raises:
        OSError: If the path is no regular file, or cannot be written.
    """
    check_replaceable(path)
    descriptor, partial = _new_beside(path)
    try:
        yield partial
        os.fsync(descriptor)
        check_replaceable(path)
        partial.replace(path)
    finally:
        os.close(descriptor)
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text as UTF-8 with line ends as they are, or leave the file that is there.

    Args:
        path: A free path, or a regular file to replace.
        text: The whole text of the file.

    Raises:
        OSError: As `replacing`.
    """
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="")


def growing(path: Path) -> IO[str]:
    """Put an empty file at a path and open it, to be written line by line.

    Args:
        path: A free path, or a regular file to replace.

    Returns:
        The open file, for text in UTF-8 with line ends as they are.

    Raises:
        OSError: As `replacing`.
    """
    with replacing(path) as partial:
        file = partial.open("w", encoding="utf-8", newline="")
    return file


def append(path: Path, content: bytes) -> None:
    """Append to a regular file in one write. It is created if it does not exist.

    Args:
        path: A free path, or a regular file.
        content: Bytes to append.

    Raises:
        OSError: If the path is no regular file, or cannot be written.
    """
    check_replaceable(path)  # opening a pipe would wait for its reader
    descriptor = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT | _NO_LINK | _BINARY, 0o666)
    try:
        left = memoryview(content)
        while left:
            left = left[os.write(descriptor, left) :]
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _new_beside(path: Path) -> tuple[int, Path]:
    """Create a file in the directory of a path. Returns its descriptor and its path."""
    while True:
        partial = path.with_name(
            f".levade-{secrets.token_hex(8)}.partial{path.suffix if len(path.suffix) < 20 else ''}"
        )
        try:
            flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | _NO_LINK | _BINARY
            return os.open(partial, flags, 0o666), partial
        except FileExistsError:
            continue
