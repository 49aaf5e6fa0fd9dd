"""Handle Ctrl-C and SIGTERM during a search or a check."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def stop_between(parts: str = "") -> Iterator[Callable[[], bool]]:
    """Let the work stop after its current part, so that nothing is left half done.

    Args:
        parts: Name of a part, such as "generation". A second Ctrl-C then prints what the program waits for.

    Yields:
        A function that says whether to stop.
    """
    asked = False

    def ask(number: int, frame: FrameType | None) -> None:
        nonlocal asked
        if asked and parts and number == signal.SIGINT:
            print(f"levade: stopping after this {parts}", file=sys.stderr)
        asked = True

    before = {number: signal.signal(number, ask) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
