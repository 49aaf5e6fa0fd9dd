"""The terms of costs, by their names in task files."""

from __future__ import annotations

from levade.costs import (
    AngularVelocity,
    Duration,
    Effort,
    GroundContact,
    JointLimitExcess,
    JointVelocity,
    LinearVelocity,
    Margins,
    Miss,
    Orientation,
    Position,
    Posture,
    ReferenceLimitExcess,
    SelfContact,
    SpeedLimitExcess,
    TorqueLimitExcess,
)

TERMS = {
    "orientation": Orientation,
    "position": Position,
    "miss": Miss,
    "linear_velocity": LinearVelocity,
    "angular_velocity": AngularVelocity,
    "joint_velocity": JointVelocity,
    "posture": Posture,
    "effort": Effort,
    "duration": Duration,
    "joint_limits": JointLimitExcess,
    "reference_limits": ReferenceLimitExcess,
    "torque_limits": TorqueLimitExcess,
    "speed_limits": SpeedLimitExcess,
    "margins": Margins,
    "ground_contact": GroundContact,
    "self_contact": SelfContact,
}
"""Name in a task file -> class of the term."""
