"""What is good enough on hardware, and the cost of missing it."""

from __future__ import annotations

from dataclasses import replace

from levade.costs import Criterion, Measure, Miss, unit_of
from levade.robots import Dimensions


def tolerance(unit: str, size: Dimensions) -> float:
    """Return the tolerance that is good enough on hardware [SI].

    Args:
        unit: Unit of the criterion's target.
        size: Dimensions of the robot.

    Returns:
        0.1 rad for angles, a twelfth of the robot's height for lengths, and 0 for other units.
    """
    return {"rad": 0.1, "m": size.height / 12}.get(unit, 0.0)


def good_enough(criterion: Criterion, size: Dimensions) -> Criterion:
    """Widen the tolerance of a criterion to what is good enough on hardware.

    Args:
        criterion: The criterion.
        size: Dimensions of the robot.
    """
    if criterion.tolerance is None:
        return criterion
    return replace(criterion, tolerance=max(criterion.tolerance, tolerance(unit_of(criterion.quantity), size)))


class MissOfCode(Miss):
    """A miss of a measure that is Python code. It counts as code itself: files hold its name only."""


def miss_of(criterion: Criterion, size: Dimensions) -> Miss:
    """Turn a criterion into a cost: 1 for a miss of half the tolerance, or at a bound, and 0 some way inside the bound.

    Args:
        criterion: The criterion.
        size: Dimensions of the robot.
    """
    kind = MissOfCode if isinstance(criterion.quantity, Measure) else Miss
    same = {"quantity": criterion.quantity, "at": criterion.at, "legs": criterion.legs}
    if criterion.target is not None:
        return kind(target=criterion.target, scale=max(criterion.tolerance or 0.0, 1e-9) / 2, **same)  # type: ignore[arg-type]
    low, high = criterion.minimum, criterion.maximum
    fall = size.fall
    unit = unit_of(criterion.quantity)
    scale = tolerance(unit, size) / 2 or {"m/s": 0.05 * size.height / fall, "rad/s": 0.1 / fall}.get(unit, 0.05)
    if low is not None and high is not None:
        scale = min(scale, (high - low) / 4)
    elif high is not None and high > 0:
        scale = min(scale, high / 2)
    scale = max(scale, 1e-9)
    return kind(
        minimum=None if low is None else low + scale,
        maximum=None if high is None else high - scale,
        scale=scale,
        **same,  # type: ignore[arg-type]
    )
