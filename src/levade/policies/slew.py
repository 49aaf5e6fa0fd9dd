"""A bound on how fast references move: no drive follows one that is faster than its joint can be.

    slew = Slew(speed=(12.0,), start=(0.3,))
    slew.limit(position, velocity, timestep=0.002)      # in place

Of all curves that are never faster than L, (above + below) / 2 is nearest to a curve x(t), by its largest distance, with

    above(t) = max over s of x(s) - L |t - s|,      below(t) = min over s of x(s) + L |t - s|,

the least such curve above x and the largest below it. It begins early what x does too suddenly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from levade.arrays import Array

_ROUNDING = 1e-9
"""[rad]: curves that differ by less are the same."""


@dataclass(frozen=True)
class Slew:
    """The fastest that references may be.

    Attributes:
        speed: Of each joint [rad/s]; infinite for no bound.
        start: What each joint was told last [rad]: where references come from.
    """

    speed: tuple[float, ...]
    start: tuple[float, ...]

    def limit(self, position: Array, velocity: Array, timestep: float) -> None:
        """Put the nearest references that keep to the speed in the place of those that do not.

        They begin where the joints were told to be last, and end where those that they replace do, if the speed lets them.

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
    """The least curve above x, shape (k, rows), that is never faster than the ramp."""
    falling = np.maximum.accumulate(x + ramp, axis=1) - ramp
    rising = np.maximum.accumulate((x - ramp)[:, ::-1], axis=1)[:, ::-1] + ramp
    return np.maximum(falling, rising)
