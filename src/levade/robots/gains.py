"""Servo gains, torque and speed limits for robots whose files give none, from their mass and size."""

from __future__ import annotations

import math

GRAVITY = 9.81
GIVE = 0.1
"""[rad], by which a joint gives way when a leg bears its share of the weight at the length of one link."""
GIVE_STANDING, GIVE_FREE = 0.08, 0.3
"""[rad], by which a joint of a leg, or of an arm, is off at its torque limit at least, where each has gains of its own."""
ARM_RESERVE = 5.0
"""Times the torque that holds an arm out, assumed of its joints whose file gives no limit: 26 Nm at G1's shoulders (25 Nm)."""
GIVE_UNDER_LOAD = 0.03
"""[rad], by which a joint that has gains of its own gives way to what it carries in the neutral posture, at most."""
DAMPING_RATIO = 0.7


def stiffness(mass: float, leg_length: float) -> float:
    """kp [Nm/rad]: m g l / (4 give), l half the leg's length, so that robots of every size sag by the same share of it.

    mass: [kg], of the robot. leg_length: [m].
    """
    return mass * GRAVITY * 0.5 * leg_length / (4 * GIVE)


def damping(kp: float, inertia: float) -> float:
    """kd [Nm s/rad] for a damping ratio of 0.7: 2 zeta sqrt(kp I).

    inertia: [kg m2], of the whole leg about its hip, the largest that a joint swings.
    """
    return 2 * DAMPING_RATIO * math.sqrt(kp * inertia)


def assumed_torque(mass: float, leg_length: float) -> float:
    """[Nm], of a joint whose file gives no limit: two legs bear the robot on half a leg's length as a lever, once.

    It is 294 Nm for HyQ2Max (data sheet: 120 to 250 Nm), 27 Nm for Go1 (23.7 to 35.6 Nm).
    """
    return mass * GRAVITY * 0.5 * leg_length


def assumed_speed(leg_length: float) -> float:
    """[rad/s], of a joint whose file gives no limit: half a leg, swung, takes off for a jump of two legs' lengths.

    w l / 2 = sqrt(2 g 2 l), so w = 4 sqrt(g / l). It is 14.6 rad/s for HyQ2Max (data sheet: 12), 19.2 rad/s for Go1 (20 to
    30), 16.7 rad/s for ANYmal B (15), and too much for ANYmal C (7.5).
    """
    return 4 * math.sqrt(GRAVITY / leg_length)


def speed_line(torque: float, velocity: float) -> tuple[float, float]:
    """(stall torque [Nm], no-load speed [rad/s]) of a servo that is given by a torque and a speed limit: full torque up to
    three quarters of the speed, none at all of it."""
    return 4 * torque, velocity
