"""Distances between the robot's parts, for terms and criteria that measure them.

Such terms and criteria have a property ``clearance`` [m], the distance from which parts are far enough apart. An engine
measures up to the largest clearance of a task, and not at all if none needs it.
"""

from __future__ import annotations

from collections.abc import Iterable

from levade.arrays import Array
from levade.errors import LevadeError
from levade.trajectory import Trajectories


def clearance_of(looking: Iterable[object]) -> float | None:
    """Return the largest clearance of terms and criteria.

    Args:
        looking: Terms and criteria. Those without a ``clearance`` measure no distances.

    Returns:
        The largest clearance [m]. None if none of them measures distances.
    """
    asked = [getattr(one, "clearance", None) for one in looking]
    return max((clearance for clearance in asked if clearance is not None), default=None)


def self_distance(trajectories: Trajectories, rows: slice) -> Array:
    """Return the least distance between two parts of the robot.

    Args:
        trajectories: The n trials.
        rows: Rows to return.

    Returns:
        Distances [m], shape (n, rows), negative where parts overlap.

    Raises:
        LevadeError: If it was not recorded.
    """
    if trajectories.self_distance is None:
        raise LevadeError("self_distance: distances between the robot's parts were not recorded")
    return trajectories.self_distance[:, rows]
