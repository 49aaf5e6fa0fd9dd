"""Ctrl-C and SIGTERM while something is being searched for."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def stop_between(parts: str = "") -> Iterator[Callable[[], bool]]:
    """End the search after the part that is being simulated, so that nothing is half done: whether to stop.

    parts: what the search goes through, as in "generation": whoever asks twice is told what is waited for, if it is named.
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
