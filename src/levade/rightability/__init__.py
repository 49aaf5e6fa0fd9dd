"""Self-rightability: from which ways to lie a robot gets up, by joints alone and by motions that a library found.

    found = rightability(load_robot("go1"), slopes=[0.0, np.radians(20.0)])
    found[0].shares()["back"].leads           # share of falls onto its back that lead to upright, without dynamics
    found_motions(Library.load("falls"))["back"].share

The quasi-static part follows C. C. Kessens and others, "A framework for autonomous self-righting of a generic robot on sloped
planar surfaces", and C. C. Kessens, C. T. Lennon and J. Collins, "A metric for self-rightability and understanding its
relationship to simple morphologies" (IROS 2014). What is theirs and what is ours: docs/rightability.md.
"""

from __future__ import annotations

from collections.abc import Sequence

from levade.rightability.dynamic import Found, found_motions
from levade.rightability.postures import ANGLES, Postures
from levade.rightability.righting import Graph, Pose, Share, graphs, require_upright
from levade.robots import Robot


def rightability(robot: Robot, *, slopes: Sequence[float] = (0.0,), angles: int = ANGLES) -> list[Graph]:
    """Find from which resting poses a robot rights itself by moving its joints, without dynamics.

    Args:
        robot: The robot.
        slopes: Slopes of the ground [rad].
        angles: Largest number of combinations of angles that each leg takes.

    Returns:
        One graph for each slope.

    Raises:
        LevadeError: If scipy is missing, the legs are not mirror images, or no posture stands on its feet.
    """
    found = graphs(Postures.of(robot, angles=angles), slopes)
    for graph in found:
        require_upright(graph, robot.name)
    return found


__all__ = [
    "ANGLES",
    "Found",
    "Graph",
    "Pose",
    "Postures",
    "Share",
    "found_motions",
    "graphs",
    "rightability",
]
