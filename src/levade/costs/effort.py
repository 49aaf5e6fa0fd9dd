"""The effort of the actuators (eq. 6, first part)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.costs.rows import Over, integral, rows_over
from levade.errors import LevadeError
from levade.trajectory import Trajectories


@dataclass(frozen=True)
class Effort:
    """Squared joint torque, summed over the joints and integrated over the motion.

    Attributes:
        normalised: Whether torques count as a share of each joint's constant limit. The cost is then in s, and n joints that
            are always at their limits cost n * T. Otherwise it is in Nm^2 s. The paper does not say which it uses.
        over: "horizon", up to the horizon, or "all", which includes the hold.

    Raises:
        LevadeError: If normalised and a joint has no torque limit.
    """

    unit: ClassVar[str] = "s, or Nm^2 s where not normalised"

    normalised: bool = True
    over: Over = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], or [Nm^2 s] if not normalised, shape (n,)."""
        rows = rows_over(trajectories, self.over)
        torque = trajectories.joint_torque[:, rows]
        if self.normalised:
            limit = trajectories.limits.torque
            unlimited = np.flatnonzero(~(np.isfinite(limit) & (limit > 0))).tolist()
            if unlimited:
                raise LevadeError(
                    f"effort: joints {unlimited} have no finite, positive torque limit to normalise by;"
                    " give the robot torque limits, or say normalised: false"
                )
            torque = torque / limit
            return integral(np.square(torque, out=torque), trajectories, rows)
        return integral(np.square(torque), trajectories, rows)
