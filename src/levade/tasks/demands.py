"""What a motion has to show to pass: thresholds, as data."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from levade.errors import LevadeError


@dataclass(frozen=True)
class Demands:
    """Thresholds; None for what is measured but not judged.

    share: of the perturbed runs, that has to succeed. numerics, engines: whether the motion has to succeed in every numerical
    variant, and in every other engine that is there.
    position: [rad], the least distance from the end of a joint's range. speed, torque, torque_speed, linkage: the least that
    is left of each limit, as a share of it.
    torque_rms: the least that is left of each torque limit by the root mean square over the motion, which is what heats.
    power: [W], the most of one joint. robot_power: [W], the most of all joints that drive, at once. flow: [l/min], the most of
    a hydraulic joint. pump_flow: [l/min], the most of all at once.
    foot_force: the most on one foot, in weights of the robot. impact_speed: [m/s], the most with which a foot meets the scene.
    part_force: the most that the scene puts on any one part, feet and trunk among them, in weights of the robot.
    trunk_acceleration: the most of the trunk, in g. self_collision: [m], how deep parts of the robot may enter each other.

    Robots' descriptions say nothing of what heats, of power, flow, forces and impacts, so nothing is demanded of them unless
    asked for.
    """

    share: float | None = 0.95
    numerics: bool | None = True
    engines: bool | None = True
    position: float | None = 0.0
    speed: float | None = 0.0
    torque: float | None = 0.0
    torque_speed: float | None = 0.0
    linkage: float | None = 0.0
    torque_rms: float | None = None
    power: float | None = None
    robot_power: float | None = None
    flow: float | None = None
    pump_flow: float | None = None
    foot_force: float | None = None
    impact_speed: float | None = None
    part_force: float | None = None
    trunk_acceleration: float | None = None
    self_collision: float | None = 0.0

    @classmethod
    def robust(cls) -> Demands:
        """What says nothing of limits: robots that differ from the model, numerics and engines alone."""
        return cls(position=None, speed=None, torque=None, torque_speed=None, linkage=None, self_collision=None)

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            if value is not None and not math.isfinite(value):
                raise LevadeError(f"demand.{one.name}: {value} is not a number; null measures without judging")
        if self.share is not None and not 0 <= self.share <= 1:
            raise LevadeError(f"demand.share: {self.share} should be a share, 0 to 1; 0.95 is usual")
