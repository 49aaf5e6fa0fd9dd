"""The slack to the hardware's limits at the tightest instant, as `levade check` measures it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from levade.arrays import Array
from levade.costs.clearance import self_distance
from levade.costs.rows import Over, rows_over
from levade.errors import LevadeError
from levade.trajectory import Trajectories

_WANTED = ("angle", "speed", "torque_speed", "linkage", "midplane", "self_distance")


@dataclass(frozen=True)
class Margins:
    """Squared shortfall of required margins, each as a multiple of itself, over joints and kinds of limit [-].

    A joint that just reaches a limit costs 1; one that keeps the margin costs nothing. The extreme over time counts, not its
    duration, because an integral that competes with other costs never quite vanishes. None leaves a margin out, and joints
    without a limit always keep it.

    Attributes:
        angle: Margin to the ends of the range [rad].
        speed: Margin to the speed limit, as a share of it.
        torque_speed: Margin to the actuator's line |torque| / stall_torque + |speed| / no_load_speed = 1 while driving, as a
            share. A drive can be beyond it, because its torque lags behind its speed.
        linkage: Margin to the torque that a linkage transmits at its angle, as a share of it. Joints have one if the robot is
            loaded with it.
        midplane: How far each foot stays on its own side of the trunk's middle plane [m]. Legs that do not cross do not
            collide.
        self_distance: Distance between parts of the robot [m].
        over: "horizon", up to the horizon, or "all", which includes the hold.
    """

    unit: ClassVar[str] = "-"

    angle: float | None = None
    speed: float | None = None
    torque_speed: float | None = None
    linkage: float | None = None
    midplane: float | None = None
    self_distance: float | None = None
    over: Over = "all"

    def __post_init__(self) -> None:
        wanted = {name: getattr(self, name) for name in _WANTED}
        if all(value is None for value in wanted.values()):
            raise LevadeError(f"margins: none is wanted; give at least one of {', '.join(wanted)}")
        for name, value in wanted.items():
            if value is not None and not (math.isfinite(value) and value > 0):
                raise LevadeError(
                    f"margins.{name}: {value} should be a positive margin; leave it out if none is wanted"
                )

    @property
    def clearance(self) -> float | None:
        """See `levade.costs.clearance`."""
        return self.self_distance

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [-], shape (n,)."""
        rows, limits = rows_over(trajectories, self.over), trajectories.limits
        missed = []
        if self.angle is not None:
            left = limits.angle_left(trajectories.joint_position[:, rows])
            missed.append(_shortfall(left.min(axis=1), self.angle))
        if self.speed is not None:
            left = limits.speed_left(trajectories.joint_velocity[:, rows])
            missed.append(_shortfall(left.min(axis=1), self.speed))
        if self.torque_speed is not None:
            left = limits.torque_speed_left(trajectories.joint_torque[:, rows], trajectories.joint_velocity[:, rows])
            missed.append(_shortfall(left.min(axis=1), self.torque_speed))
        if self.linkage is not None:
            left = limits.linkage_left(trajectories.joint_position[:, rows], trajectories.joint_torque[:, rows])
            missed.append(_shortfall(left.min(axis=1), self.linkage))
        if self.midplane is not None:
            outward = [
                leg.foot_position(trajectories.joint_position[:, rows])[..., 1] * (1.0 if leg.side == "left" else -1.0)
                for leg in trajectories.legs
                if leg.stands and leg.side in ("left", "right")
            ]
            missed += [_shortfall(side.min(axis=1, keepdims=True), self.midplane) for side in outward]
        if self.self_distance is not None:
            nearest = self_distance(trajectories, rows).min(axis=1, keepdims=True)
            missed.append(_shortfall(nearest, self.self_distance))
        return np.ascontiguousarray(np.concatenate(missed, axis=1)).sum(axis=1)


def _shortfall(left: Array, wanted: float) -> Array:
    """Compute squared shortfalls, shape (n, joints)."""
    return np.square(np.maximum(wanted - left, 0.0) / wanted)
