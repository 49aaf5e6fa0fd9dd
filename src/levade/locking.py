"""Lock directories for one writing process at a time. A lock ends with its process.

    with locked(directory, "run"):
        ...

The lock is the system's (`flock`) on the file ``.levade-lock``. A process leaves no lock when it dies. The file says which
process holds it. Systems without `flock` have no lock.
"""

from __future__ import annotations

import errno
import json
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path

from levade.errors import LevadeError, Remedy

try:
    import fcntl
except ImportError:  # not a POSIX system
    fcntl = None

LOCK = ".levade-lock"

_TAKEN = (errno.EWOULDBLOCK, errno.EACCES)


class TakenError(LevadeError):
    """Says that another process writes the directory."""


@contextmanager
def locked(directory: Path, what: str) -> Iterator[None]:
    """Hold the lock of a directory.

    Args:
        directory: The directory, which exists.
        what: Kind of the writer, such as "run", for the message to a second process.

    Raises:
        TakenError: If another process has the lock, or another part of this one.
        OSError: If the lock's file cannot be opened.
    """
    if fcntl is None:
        yield
        return
    path = directory / LOCK
    descriptor = _taken(path, what)
    try:
        yield
    finally:
        with suppress(OSError):
            path.unlink()  # while it is held: a process that opened it meanwhile finds another file, and tries again
        os.close(descriptor)


def check_unlocked(directory: Path, what: str) -> None:
    """Check that no process holds the lock of a directory.

    Args:
        directory: The directory. Without a lock file it is unlocked.
        what: Kind of the writer, such as "run", for the message.

    Raises:
        TakenError: If a process holds the lock.
    """
    path = directory / LOCK
    if fcntl is None:
        return
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in _TAKEN:
            raise _error(descriptor, directory, what) from None
    finally:
        os.close(descriptor)


def _taken(path: Path, what: str) -> int:
    """Open the lock's file and lock it. Returns its descriptor."""
    assert fcntl is not None
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            try:
                if error.errno in _TAKEN:
                    raise _error(descriptor, path.parent, what) from None
                return descriptor  # a file system that knows no locks
            finally:
                if error.errno in _TAKEN:
                    os.close(descriptor)
        with suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), path.lstat()):
                os.ftruncate(descriptor, 0)
                os.write(descriptor, json.dumps(_holder()).encode())
                return descriptor
        os.close(descriptor)  # its last holder has just removed it


def _holder() -> dict[str, object]:
    since = datetime.now(UTC).astimezone().isoformat(sep=" ", timespec="seconds")
    return {"pid": os.getpid(), "host": socket.gethostname(), "since": since}


def _error(descriptor: int, directory: Path, what: str) -> TakenError:
    try:
        content = json.loads(os.pread(descriptor, 1000, 0))
        who = f" by process {content['pid']} on {content['host']}, since {content['since']}"
    except (OSError, ValueError, LookupError, TypeError):
        who = ""  # it has just begun
    return TakenError(
        f"{directory}: this {what} is being written{who}",
        remedies=(Remedy("wait for it or stop it"), Remedy("write elsewhere", "elsewhere")),
    )
