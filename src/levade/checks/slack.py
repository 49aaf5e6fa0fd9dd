"""Slack: the margin to one kind of limit, from a bound on what is left or on what is measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from levade.arrays import Array

_ROUNDING = 1e-6
"""Tolerance of a limit: a torque that the engine clamps at its limit is at it, not beyond."""


@dataclass(frozen=True)
class Margin:
    """Slack to one kind of limit.

    Attributes:
        unit: Unit of the numbers.
        values: Joint, foot or pair of bodies -> slack, or the measured value if this kind has no limit of its own. None if the
            robot gives no limit.
        least: Name with the least slack, or with the largest measured value.
        value: Its number.
        required: Demanded number; None if nothing is demanded.
        failed: Names that do not meet the demand.
        unknown: Names whose limit is not known, or only assumed; they never fail.
        passed: Whether the demand is met; None if nothing is demanded, or if nothing fails but something is unknown.
        reason: Why the margin is not judged or not available.
        said: The least slack in words, in the unit of the limit itself.
        more: Further numbers.
    """

    unit: str
    values: Mapping[str, float | None] = field(default_factory=dict)
    least: str = ""
    value: float | None = None
    required: float | None = None
    failed: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    passed: bool | None = None
    reason: str = ""
    said: str = ""
    more: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Write the margin as plain tables.

        Returns:
            Tables that JSON can hold.
        """
        content = asdict(self)
        more = content.pop("more")
        return {**content, "failed": list(self.failed), "unknown": list(self.unknown), **more}


def share_left(most: Array, limit: Array) -> Array:
    """Compute the slack as a share of the limit.

    Args:
        most: Largest measured values, shape (joints,).
        limit: Limits, shape (joints,); not finite for a joint without one.

    Returns:
        Share of the limit that is left, shape (joints,); NaN for a joint without a limit.
    """
    return np.where(np.isfinite(limit), 1 - most / limit, np.nan)


def least_margin(
    unit: str,
    names: tuple[str, ...],
    left: Array,
    required: float | None,
    *,
    assumed: Sequence[int] = (),
    reason: str = "",
    more: Mapping[str, Any] | None = None,
) -> Margin:
    """Make a margin with a lower bound on the slack.

    Args:
        unit: Unit of the slack.
        names: Joints, or other things with a limit.
        left: Slack of each, shape (names,); not finite without a limit.
        required: Demanded slack. None if nothing is demanded.
        assumed: Indices of the names whose limit no file gives.
        reason: Why there is no limit.
        more: Further numbers.
    """
    there = np.isfinite(left)
    values = {name: float(value) if finite else None for name, value, finite in zip(names, left, there, strict=True)}
    least = int(np.argmin(np.where(there, left, np.inf))) if there.any() else None
    made_up = [names[i] for i in assumed if there[i]]
    none = [name for name, finite in zip(names, there, strict=True) if not finite]
    beyond = [] if required is None else [n for n, v in values.items() if v is not None and v < required - _ROUNDING]
    failed = tuple(name for name in beyond if name not in made_up)
    unknown = () if required is None else tuple(name for name in names if name in {*made_up, *none})
    said = [
        reason or f"the robot gives no limit{_of(none, names)}" if none else "",
        f"the limit is assumed{_of(made_up, names)}" if made_up else "",
        f"beyond what is assumed: {', '.join(name for name in beyond if name in made_up)}",
    ]
    return Margin(
        unit,
        values,
        "" if least is None else names[least],
        None if least is None else float(left[least]),
        required,
        failed,
        unknown,
        passed=None if required is None or (unknown and not failed) else not failed,
        reason="; ".join(text for text in said if text and not text.endswith(": ")),
        more=more or {},
    )


def _of(some: Sequence[str], names: Sequence[str]) -> str:
    """List the names, unless they are all of them."""
    return "" if len(some) == len(names) else f" of {', '.join(some)}"


def most_margin(
    unit: str,
    values: Mapping[str, float],
    allowed: float | None,
    *,
    reason: str = "",
    more: Mapping[str, Any] | None = None,
) -> Margin:
    """Make a margin with an upper bound on what is measured.

    Args:
        unit: Unit of the values.
        values: Name -> measured value.
        allowed: Largest allowed value. None if nothing is demanded.
        reason: Why the margin is not judged.
        more: Further numbers.
    """
    if not values:
        return Margin(unit, required=allowed, passed=None if allowed is None else True, more=more or {})
    most = max(values, key=lambda name: values[name])
    failed: tuple[str, ...] = ()
    if allowed is not None:
        failed = tuple(name for name, value in values.items() if value > allowed + _ROUNDING)
    passed = None if allowed is None else not failed
    reason = reason or ("" if allowed is not None else "no limit is known, and none demanded")
    return Margin(
        unit, dict(values), most, values[most], allowed, failed, passed=passed, reason=reason, more=more or {}
    )
