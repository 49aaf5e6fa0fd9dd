"""Let a program say that a computation takes longer than a person waits without a word.

    with on_long_wait(print):
        load_robot("biped.urdf")  # prints a line if it searches a posture for more than 2 s

Nothing is said outside of such a context, and in threads and processes that it does not reach.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

PATIENCE = 2.0
"""Time after which a computation says that it takes long [s]."""

_SAY: ContextVar[Callable[[str], None] | None] = ContextVar("say", default=None)


@contextmanager
def on_long_wait(say: Callable[[str], None]) -> Iterator[None]:
    """Hear of computations that take long within the context.

    Args:
        say: Called with one line for each of them: what takes long, and what would spare it.
    """
    token = _SAY.set(say)
    try:
        yield
    finally:
        _SAY.reset(token)


class Patience:
    """The clock of one computation, which runs from here on.

    Args:
        message: What takes long, and what would spare it, in one line.
    """

    def __init__(self, message: str) -> None:
        self._message, self._until, self._said = message, time.monotonic() + PATIENCE, False

    def check(self) -> None:
        """Say the message if the time is over, once. It costs less than a microsecond, so call it often."""
        if self._said or time.monotonic() < self._until:
            return
        self._said = True
        if (say := _SAY.get()) is not None:
            say(self._message)
