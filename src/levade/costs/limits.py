"""Excess beyond the robot's limits (eq. 6, second part, and the same for torque and speed).

All are zero within the limits and grow with the square of the excess. Joints without a limit never exceed it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.costs.rows import Over, integral, rows_over
from levade.embodiment import JointLimits
from levade.errors import LevadeError
from levade.trajectory import Trajectories

# A linkage may transmit nothing at the end of its range. An excess is then counted against this share of its best.
LEAST_TORQUE_SHARE = 0.01


@dataclass(frozen=True)
class JointLimitExcess:
    """Squared excess of the measured joint angles beyond their range, over joints and time [rad^2 s] (eq. 6).

    Attributes:
        over: "horizon", up to the horizon, or "all", which includes the hold.
    """

    unit: ClassVar[str] = "rad^2 s"

    over: Over = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2 s], shape (n,)."""
        rows = rows_over(trajectories, self.over)
        angle = trajectories.joint_position[:, rows]
        return integral(_range_excess(angle, trajectories.limits), trajectories, rows)


@dataclass(frozen=True)
class ReferenceLimitExcess:
    """The same for the desired joint angles [rad^2 s], which a simulated stop hides from `JointLimitExcess`."""

    unit: ClassVar[str] = "rad^2 s"

    over: Over = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [rad^2 s], shape (n,)."""
        rows = rows_over(trajectories, self.over)
        angle = trajectories.reference.position[:, rows]
        return integral(_range_excess(angle, trajectories.limits), trajectories, rows)


@dataclass(frozen=True)
class TorqueLimitExcess:
    """Squared excess of the torque over its limit at the joint's angle, as a share of that limit [s].

    The limit is `JointLimits.torque_at`: the constant limit lowered by the linkage curve, and at least 1 % of the joint's best.

    Attributes:
        over: "horizon", up to the horizon, or "all", which includes the hold.

    Raises:
        LevadeError: If a joint has a torque limit of zero.
    """

    unit: ClassVar[str] = "s"

    over: Over = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], shape (n,)."""
        rows = rows_over(trajectories, self.over)
        limits = trajectories.limits
        best = np.array(limits.torque, dtype=np.float64)
        for joint, curve in limits.torque_curves.items():
            best[joint] = min(best[joint], curve.peak)
        _check_positive("torque", best)
        limit: Array = best
        if limits.torque_curves:
            limit = np.maximum(limits.torque_at(trajectories.joint_position[:, rows]), LEAST_TORQUE_SHARE * best)
        share = np.abs(trajectories.joint_torque[:, rows]) / limit
        return integral(np.square(np.maximum(share - 1.0, 0.0)), trajectories, rows)


@dataclass(frozen=True)
class SpeedLimitExcess:
    """Squared excess of the joint speed over its limit, as a share of that limit [s].

    Attributes:
        over: "horizon", up to the horizon, or "all", which includes the hold.

    Raises:
        LevadeError: If a joint has a speed limit of zero.
    """

    unit: ClassVar[str] = "s"

    over: Over = "horizon"

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], shape (n,)."""
        _check_positive("speed", trajectories.limits.velocity)
        rows = rows_over(trajectories, self.over)
        share = np.abs(trajectories.joint_velocity[:, rows]) / trajectories.limits.velocity
        return integral(np.square(np.maximum(share - 1.0, 0.0)), trajectories, rows)


def _range_excess(angle: Array, limits: JointLimits) -> Array:
    excess = np.minimum(np.maximum(angle, limits.lower), limits.upper)
    np.subtract(angle, excess, out=excess)
    return np.square(excess, out=excess)


def _check_positive(what: str, limit: Array) -> None:
    bad = np.flatnonzero(~(limit > 0)).tolist()
    if bad:
        raise LevadeError(f"limits: joints {bad} have no positive {what} limit; give one, or inf for none")
