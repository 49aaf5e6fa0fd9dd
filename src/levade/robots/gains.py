"""Derive servo gains, torque and speed limits from mass and size, for robots whose files give none."""

from __future__ import annotations

import math

GRAVITY = 9.81
GIVE = 0.1
"""Deflection of a joint when a leg carries its share of the weight with a lever of one link [rad]."""
GIVE_STANDING, GIVE_FREE = 0.08, 0.3
"""Smallest deflection at the torque limit of a leg's and of an arm's joint [rad], if each joint has its own gains."""
ARM_RESERVE = 5.0
"""Assumed torque limit of an arm's joint, as a multiple of the torque that holds the arm out.

It gives 26 Nm at the shoulders of G1, whose data sheet has 25 Nm.
"""
GIVE_UNDER_LOAD = 0.03
"""Largest deflection under the load of the neutral posture [rad], for joints with their own gains."""
DAMPING_RATIO = 0.7
ROTOR_INERTIA = 1.5e-4
"""Reflected rotor inertia of a geared drive over its torque limit [kg m2 / Nm].

The four drives of G1 have 1.2e-4 to 1.8e-4 (armature and effort limits in mjlab's constants of the robot).
"""
ARM_EVEN = 0.5
"""Smallest assumed torque limit in an arm as a share of the largest: its joints tend to have the same drives."""


def stiffness(mass: float, leg_length: float) -> float:
    """Derive kp = m g l / (4 give), with l half the leg's length, so that robots of any size sag by the same share of it.

    Args:
        mass: Mass of the robot [kg].
        leg_length: Length of the leg [m].

    Returns:
        Stiffness kp [Nm/rad].
    """
    return mass * GRAVITY * 0.5 * leg_length / (4 * GIVE)


def damping(kp: float, inertia: float) -> float:
    """Derive kd = 2 zeta sqrt(kp I) for a damping ratio of 0.7.

    Args:
        kp: Stiffness [Nm/rad].
        inertia: Inertia of the whole leg about its hip, the largest that a joint swings [kg m2].

    Returns:
        Damping kd [Nm s/rad].
    """
    return 2 * DAMPING_RATIO * math.sqrt(kp * inertia)


def rotor_inertia(torque: float) -> float:
    """Assume the reflected rotor inertia of a drive.

    Args:
        torque: Torque limit [Nm].

    Returns:
        Armature [kg m2].
    """
    return ROTOR_INERTIA * torque


def assumed_torque(mass: float, leg_length: float) -> float:
    """Assume a torque limit with which two legs can carry the robot on a lever of half a leg's length.

    It is 294 Nm for HyQ2Max (data sheet: 120 to 250 Nm), 27 Nm for Go1 (23.7 to 35.6 Nm).

    Args:
        mass: Mass of the robot [kg].
        leg_length: Length of the leg [m].

    Returns:
        Torque limit [Nm].
    """
    return mass * GRAVITY * 0.5 * leg_length


def assumed_speed(leg_length: float) -> float:
    """Assume a speed limit at which half a leg, swung about a joint, takes off for a jump of two legs' lengths.

    w l / 2 = sqrt(2 g 2 l), so w = 4 sqrt(g / l). It is 14.6 rad/s for HyQ2Max (data sheet: 12), 19.2 rad/s for Go1 (20 to
    30), 16.7 rad/s for ANYmal B (15), and too much for ANYmal C (7.5).

    Args:
        leg_length: Length of the leg [m].

    Returns:
        Speed limit [rad/s].
    """
    return 4 * math.sqrt(GRAVITY / leg_length)


def speed_line(torque: float, velocity: float) -> tuple[float, float]:
    """Derive the torque-speed line of a servo: full torque up to three quarters of the speed limit, none at the limit.

    Args:
        torque: Torque limit [Nm].
        velocity: Speed limit [rad/s].

    Returns:
        Stall torque [Nm] and no-load speed [rad/s].
    """
    return 4 * torque, velocity
