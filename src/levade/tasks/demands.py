"""Demands: the thresholds that a motion has to meet to pass a check."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from levade.errors import LevadeError


@dataclass(frozen=True)
class Demands:
    """Thresholds of a check; None measures without judging.

    Descriptions of robots give no limits for power, flow, forces and impacts, so by default nothing is demanded there.

    Attributes:
        share: Least share of the perturbed runs that succeed.
        numerics: Whether the motion has to succeed in every numerical variant.
        engines: Whether the motion has to succeed in every other engine that is installed.
        position: Least distance from the ends of a joint's range [rad].
        speed: Least slack to each joint's speed limit, as a share of it.
        torque: Least slack to each joint's torque limit, as a share of it.
        torque_speed: Least slack to each actuator's torque-speed line, as a share of the stall torque.
        linkage: Least slack to the torque that each linkage transmits at its angle, as a share of it.
        torque_rms: Least slack of the root mean square torque over the motion, which heats the drive, to each torque limit,
            as a share of it.
        current: Least slack to each winding's current limit, as a share of it. Judged if the robot's description has windings.
        winding_temperature: Least slack to the highest temperature of each winding, as a share of the rise from the ambient
            temperature, at which the motion begins. Judged as ``current`` is.
        power: Largest power of one joint [W].
        robot_power: Largest power of all driving joints together, at any time [W].
        flow: Largest flow of a hydraulic joint [l/min].
        pump_flow: Largest flow of all hydraulic joints together, at any time [l/min].
        foot_force: Largest force on one foot [robot weights].
        impact_speed: Largest speed with which a foot meets the scene [m/s].
        part_force: Largest force of the scene on any one part, feet and trunk included [robot weights].
        part_impact_speed: Largest speed with which any part meets the scene [m/s].
        self_force: Largest force of two parts of the robot on each other [robot weights].
        self_impact_speed: Largest speed with which two parts of the robot meet [m/s].
        trunk_acceleration: Largest acceleration of the trunk [g].
        self_collision: Largest depth to which two parts of the robot may enter each other [m].

    Raises:
        LevadeError: If a threshold is not finite, or the share is not between 0 and 1.
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
    current: float | None = 0.0
    winding_temperature: float | None = 0.0
    power: float | None = None
    robot_power: float | None = None
    flow: float | None = None
    pump_flow: float | None = None
    foot_force: float | None = None
    impact_speed: float | None = None
    part_force: float | None = None
    part_impact_speed: float | None = None
    self_force: float | None = None
    self_impact_speed: float | None = None
    trunk_acceleration: float | None = None
    self_collision: float | None = 0.0

    @classmethod
    def robust(cls) -> Demands:
        """Make demands on perturbed runs, numerics and engines alone, without the robot's limits.

        Returns:
            The demands.
        """
        return cls(
            position=None,
            speed=None,
            torque=None,
            torque_speed=None,
            linkage=None,
            current=None,
            winding_temperature=None,
            self_collision=None,
        )

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            if value is not None and not math.isfinite(value):
                raise LevadeError(f"demand.{one.name}: {value} is not a number; null measures without judging")
        if self.share is not None and not 0 <= self.share <= 1:
            raise LevadeError(f"demand.share: {self.share} should be a share, 0 to 1; 0.95 is usual")
