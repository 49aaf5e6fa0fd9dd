"""Let a command do its work even if standard output or error is closed, full, or not read."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, TextIO

_UNREAD = (errno.EPIPE, errno.ESHUTDOWN)


class Output:
    """A stream that accepts every text. After the system refuses one, it drops this text and all later ones.

    Attributes:
        refused: What the system said first, or None. That nobody reads any more is not counted.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._gone = stream, False
        self.refused: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text, or drop it.

        Args:
            text: The text.

        Returns:
            Number of characters of the text, including dropped ones.
        """
        if not self._gone:
            try:
                self._stream.write(text)
            except OSError as error:
                self._drop(error)
            except UnicodeEncodeError:  # characters that the stream's encoding lacks
                encoding = getattr(self._stream, "encoding", None) or "ascii"
                return self.write(text.encode(encoding, "backslashreplace").decode(encoding))
        return len(text)

    def flush(self) -> None:
        """Write the buffered text, or drop it."""
        if not self._gone:
            try:
                self._stream.flush()
            except OSError as error:
                self._drop(error)

    def _drop(self, error: OSError) -> None:
        self._gone = True
        if error.errno not in _UNREAD:
            self.refused = error
        with suppress(OSError, ValueError):
            # at its end Python tries again to write the buffered text, and would complain
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)
            self._stream.flush()


@contextmanager
def lasting_output() -> Iterator[Output]:
    """Let commands print within the context, whatever happens to the streams. Yields standard output."""
    before = sys.stdout, sys.stderr
    _open_closed()
    out, err = (Output(stream or open(os.devnull, "w", encoding="utf-8")) for stream in before)  # noqa: SIM115
    sys.stdout, sys.stderr = out, err  # type: ignore[assignment]
    try:
        yield out
    finally:
        out.flush()
        err.flush()
        sys.stdout, sys.stderr = before


def _open_closed() -> None:
    """Replace a closed standard stream by a sink. Otherwise a file of levade's would get its number and the printed text."""
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            with suppress(OSError):
                os.open(os.devnull, os.O_RDWR)  # takes the lowest free number
