"""Keep to the time and the roll-outs of a pursuit.

budget = Budget(end=time.monotonic() + 300.0, trials=None, runs=500)
budget.begin()                      # a search
budget.over(generation)             # whether it has to end
budget.late(0.6, generation.trials) # whether 60 % are over
budget.certified(seconds, runs)     # how long certificates take; the last one has to fit
"""

from __future__ import annotations

import time

from levade.search import Generation

FEW = 100
"""Least number of perturbed runs of a certificate. It ends after them if the demanded share is out of reach."""

_LIKELY = 0.9
"""Share of perturbed models above which a motion's certificate is likely to need all its runs."""

_VARIANTS = 40
"""Duration of the rest of a certificate, in perturbed runs: finer time steps, other contacts and another engine."""

_RESERVED = 0.25
"""Largest share of the time that is kept for the last certificate."""


class Budget:
    """The time and the roll-outs of a pursuit.

    Attributes:
        end: When the time is over, of `time.monotonic` [s]. None for no limit.
        trials: Most roll-outs of all searches. None for no limit.
        runs: Most perturbed runs of a certificate.
    """

    def __init__(self, end: float | None, trials: int | None, runs: int) -> None:
        self.end, self.trials, self.runs = end, trials, runs
        self._began = self._searching = time.monotonic()
        self._made = 0
        self._each: float | None = None

    def begin(self) -> float:
        """Take note that a search begins.

        Returns:
            The time [s].
        """
        self._searching = time.monotonic()
        return self._searching

    def made(self, trials: int) -> None:
        """Take note of the roll-outs of a finished search.

        Args:
            trials: Number of roll-outs.
        """
        self._made += trials

    def certified(self, seconds: float, runs: int) -> None:
        """Take note of how long a certificate took.

        Args:
            seconds: Its duration [s].
            runs: Number of its perturbed runs.
        """
        self._each = seconds / (runs + _VARIANTS)

    def spent(self, share: float, trials: int = 0) -> bool:
        """Return whether a share of the roll-outs is spent. This does not depend on the computer's speed.

        Args:
            share: The share.
            trials: Roll-outs of the search that goes on.
        """
        return self.trials is not None and self._made + trials >= share * self.trials

    def late(self, share: float, trials: int = 0) -> bool:
        """Return whether a share of the time is over, or of the roll-outs.

        Args:
            share: The share.
            trials: Roll-outs of the search that goes on.
        """
        if self.spent(share, trials):
            return True
        return self.end is not None and time.monotonic() > self._began + share * (self.end - self._began)

    def over(self, generation: Generation) -> bool:
        """Return whether the time is over, except for what the certificate of the motion so far will take.

        Args:
            generation: State of the search.
        """
        if self.end is None:
            return False
        now, best, each = time.monotonic(), generation.best, self._each
        if each is None:  # about as long as two roll-outs of the search, which end early in the hold
            each = 2.0 * (now - self._searching) / generation.trials
        runs = self.runs if (best.share or 0.0) >= _LIKELY else min(self.runs, FEW)
        return now > self.end - min(each * (runs + _VARIANTS), _RESERVED * (self.end - self._began))
