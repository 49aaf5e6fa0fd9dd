"""A bound on the speed of references: no drive follows a reference that is faster than its joint.

    slew = Slew(speed=(12.0,), start=(0.3,))
    slew.limit(position, velocity, timestep=0.002)      # in place

The curve (above + below) / 2 is nearest to a curve x(t), by its largest distance, among all curves that are never faster
than L. Here

    above(t) = max over s of x(s) - L |t - s|,      below(t) = min over s of x(s) + L |t - s|

are the least such curve above x and the largest one below it. Where x is too sudden, the curve begins earlier.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from levade.arrays import Array

_ROUNDING = 1e-9
"""[rad]: curves that differ by less count as the same."""


@dataclass(frozen=True)
class Slew:
    """Bounds on the speed of references.

    Attributes:
        speed: Largest speed of each joint [rad/s]; infinite for no bound.
        start: Last commanded angle of each joint [rad], from which references start.
    """

    speed: tuple[float, ...]
    start: tuple[float, ...]

    def limit(self, position: Array, velocity: Array, timestep: float) -> None:
        """Replace references that are too fast by the nearest ones that keep to the speed.

        The new references start at the last commanded angles, and end where the old ones do, if the speed allows it.

        Args:
            position: References at the end of each step up to the horizon [rad], shape (n, rows, joints); written to.
            velocity: Their rates [rad/s], of the same shape; written to.
            timestep: Time step [s].
        """
        start, step = np.array(self.start), np.array(self.speed) * timestep
        furthest = np.abs(np.diff(position, axis=1, prepend=np.broadcast_to(start, position[:, :1].shape))).max(axis=1)
        trials, joints = np.nonzero(furthest > step + _ROUNDING)
        if not len(trials):
            return
        asked = position[trials, :, joints]
        first, ramp = start[joints, None], step[joints, None] * np.arange(1, position.shape[1] + 1)
        limited = (_above(asked, ramp) - _above(-asked, ramp)) / 2
        left = ramp[:, -1:] - ramp
        limited = np.clip(limited, asked[:, -1:] - left, asked[:, -1:] + left)
        limited = np.clip(limited, first - ramp, first + ramp)
        rate = np.diff(limited, axis=1, prepend=first) / timestep
        same, fastest = np.abs(limited - asked) <= _ROUNDING, np.array(self.speed)[joints, None]
        position[trials, :, joints] = np.where(same, asked, limited)
        velocity[trials, :, joints] = np.clip(np.where(same, velocity[trials, :, joints], rate), -fastest, fastest)


def _above(x: Array, ramp: Array) -> Array:
    """Find the least curve above x, shape (k, rows), that is never faster than the ramp."""
    falling = np.maximum.accumulate(x + ramp, axis=1) - ramp
    rising = np.maximum.accumulate((x - ramp)[:, ::-1], axis=1)[:, ::-1] + ramp
    return np.maximum(falling, rising)
