"""How fast a long command comes along, and how much time is left."""

from __future__ import annotations

import math
import time
from collections import deque

_RECENT = 50


class Pace:
    """Measures how fast a count grows, over its last 50 reports."""

    def __init__(self) -> None:
        self._reports: deque[tuple[float, int]] = deque(maxlen=_RECENT)

    def add(self, count: int) -> None:
        """Take in how far the work has come.

        Args:
            count: Number of trials, or of other parts, that are done by now.
        """
        self._reports.append((time.perf_counter(), count))

    @property
    def rate(self) -> float:
        """Parts per second; 0 as long as no two reports tell."""
        if len(self._reports) < 2:
            return 0.0
        (t0, n0), (t1, n1) = self._reports[0], self._reports[-1]
        return (n1 - n0) / max(t1 - t0, 1e-9)

    def left(self, parts: int) -> str | None:
        """Estimate how long the remaining parts take.

        Args:
            parts: Number of parts that are not done.

        Returns:
            The time, as `duration` writes it. None if the rate is not known.
        """
        return duration(max(parts, 0) / self.rate) if self.rate > 0 else None


class Deadline:
    """The end of a command that may take some minutes.

    Args:
        minutes: Time from here on [min]. None for no limit.
    """

    def __init__(self, minutes: float | None) -> None:
        self._end = None if minutes is None else time.perf_counter() + 60 * minutes

    @property
    def left(self) -> str:
        """What is left of the time, as a sentence's end; empty without a limit."""
        return "" if self._end is None else f"{duration(max(self._end - time.perf_counter(), 0.0))} left in all"


def duration(seconds: float) -> str:
    """Write a time for people, in hours and minutes, or in minutes and seconds.

    Args:
        seconds: Time [s].

    Returns:
        The time, rounded up to a second, or from an hour on to a minute.
    """
    minutes, rest = divmod(math.ceil(seconds), 60)
    if minutes >= 60:
        hours, minutes = divmod(math.ceil(seconds / 60), 60)
        return f"{hours} h {minutes:02d} min"
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"
