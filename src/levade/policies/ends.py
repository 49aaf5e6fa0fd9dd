"""Fix the start and the end of a reference, independently of the weights.

    q(t) = (r(t) - s(t)) f(t) + (1 - r(t)) start + s(t) goal,        f: eq. 3

r rises from 0 to 1 in the first part of the horizon, s in the last: the reference departs from the last commanded posture,
without a jump, and settles in another one. A search then has to find only the motion between them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError


@dataclass(frozen=True, eq=False)
class Ends:
    """The two ends of a reference.

    Attributes:
        start: Posture that the reference leaves [rad], shape (joints,).
        goal: Posture that the reference reaches at the horizon [rad], shape (joints,).
        depart: Share of the horizon in which the reference leaves ``start``; 0 leaves the start to the weights.
        settle: Share of the horizon in which the reference moves to ``goal``; 0 leaves the end to the weights.

    Raises:
        LevadeError: If a share is negative or not finite, or the two overlap.
    """

    start: Array
    goal: Array
    depart: float = 0.0
    settle: float = 0.0

    def __post_init__(self) -> None:
        for name, share in (("depart", self.depart), ("settle", self.settle)):
            if not (math.isfinite(share) and share >= 0):
                raise LevadeError(f"{name}: {share} should be a share of the horizon, 0 to 1")
        if self.depart + self.settle > 1:
            raise LevadeError(
                f"settle: {self.settle} and depart: {self.depart} are together more than the horizon; give 1 at most"
            )

    def settling(self, share: Array) -> tuple[Array, Array]:
        """Evaluate s, the factor of the goal.

        Args:
            share: Times as shares of the horizon, shape (rows,).

        Returns:
            s [-] and its derivative by the share, shape (rows, 1) each.
        """
        if self.settle == 0:
            return np.zeros((len(share), 1)), np.zeros((len(share), 1))
        return _step(share, 1.0 - self.settle, 1.0)

    def blend(self, share: Array) -> tuple[Array, Array, Array, Array]:
        """Evaluate the factor of the kernels' reference, r - s, and the posture added to it.

        Args:
            share: Times as shares of the horizon, shape (rows,).

        Returns:
            The factor [-], shape (rows, 1); the addition [rad], shape (rows, joints); and their derivatives by the share.
        """
        rise, rise_rate = _step(share, 0.0, self.depart)
        fall, fall_rate = self.settling(share)
        added = (1.0 - rise) * self.start + fall * self.goal
        return rise - fall, added, rise_rate - fall_rate, fall_rate * self.goal - rise_rate * self.start


def _step(share: Array, begin: float, end: float) -> tuple[Array, Array]:
    """Rise from 0 to 1 between begin and end with the least jerk (10 u^3 - 15 u^4 + 6 u^5); also the derivative; (rows, 1)."""
    if end <= begin:
        return np.ones((len(share), 1)), np.zeros((len(share), 1))
    u = np.clip((share - begin) / (end - begin), 0.0, 1.0)[:, None]
    rise = np.where(u == 1.0, 1.0, u**3 * (10.0 - 15.0 * u + 6.0 * u**2))
    return rise, 30.0 * u**2 * (1.0 - u) ** 2 / (end - begin)
