"""Judge whether trials meet their requirements, in SI units, independent of their costs."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs.clearance import self_distance
from levade.costs.evaluate import DIVERGED, within
from levade.costs.orientation import angle_between, pitch_past_vertical, world_up, wrap
from levade.costs.rows import rows_at
from levade.embodiment import LegGeometry
from levade.errors import LevadeError, did_you_mean
from levade.rotations import roll_pitch_yaw
from levade.trajectory import Trajectories

Quantity = Literal[
    "roll", "pitch", "yaw", "tilt", "x", "y", "height", "travel", "speed", "vertical_speed", "angular_speed",
    "lowest_foot", "highest_foot", "trunk_clearance", "angle_margin", "speed_margin", "torque_speed_margin",
    "linkage_margin", "self_distance", "duration",
]  # fmt: skip

QUANTITIES: dict[str, str] = {
    "roll": "rad",
    "pitch": "rad",
    "yaw": "rad",
    "tilt": "rad",
    "x": "m",
    "y": "m",
    "height": "m",
    "travel": "m",
    "speed": "m/s",
    "vertical_speed": "m/s",
    "angular_speed": "rad/s",
    "lowest_foot": "m",
    "highest_foot": "m",
    "trunk_clearance": "m",
    "angle_margin": "rad",
    "speed_margin": "of limit",
    "torque_speed_margin": "of limit",
    "linkage_margin": "of limit",
    "self_distance": "m",
    "duration": "s",
}
"""Quantity -> unit."""


class Measure(str):
    """A quantity in Python: a name, a unit and a function.

            knee = Measure("knee", "rad", lambda t, rows: t.joint_position[:, rows, 2])
            Criterion(knee, target=-1.6, tolerance=0.1)

    Attributes:
        unit: SI unit, for texts. A unit that ends in "/s" marks a speed, which decays while a robot comes to rest.
        function: Function of trajectories and a slice of rows that returns values, shape (n, rows).
    """

    unit: str
    function: Callable[[Trajectories, slice], Array]

    def __new__(cls, name: str, unit: str, function: Callable[[Trajectories, slice], Array]) -> Measure:  # noqa: D102
        if not name or name in QUANTITIES:
            raise LevadeError(f"success: {name!r} cannot name a measure; give it a name that is no quantity's")
        made = super().__new__(cls, name)
        made.unit, made.function = unit, function
        return made

    def __deepcopy__(self, memo: object) -> Measure:
        return self

    def __repr__(self) -> str:
        return f"Measure({str(self)!r}, {self.unit!r})"


if TYPE_CHECKING:
    AnyQuantity = Quantity | Measure
else:
    AnyQuantity = Quantity  # what a task file may hold


def unit_of(quantity: str) -> str:
    """Return the unit of a quantity.

    Args:
        quantity: A built-in quantity or a `Measure`.

    Returns:
        Its unit, such as "rad".
    """
    return quantity.unit if isinstance(quantity, Measure) else QUANTITIES[quantity]


CIRCULAR = ("roll", "pitch", "yaw")
OF_FEET = ("lowest_foot", "highest_foot")
MARGINS = ("angle_margin", "speed_margin", "torque_speed_margin", "linkage_margin", "self_distance")

Legs = str | tuple[str, ...]
"""Some of the legs: "all", "front", "middle", "hind", "left", "right", the name of a leg or an arm, or several of these."""


@dataclass(frozen=True)
class Criterion:
    """A requirement on a motion: a target within a tolerance, or a minimum and/or a maximum.

    Quantities of the trunk and the robot:

    - ``roll``, ``yaw`` [rad]: z-y-x angles. They are not unique at pitch = +-pi/2, so use tilt for motions that end near there.
    - ``pitch`` [rad]: z-y-x, nose up negative. It is counted past the vertical if the trunk's top looks down, so a robot on its
      back never counts as one on its feet (`levade.costs.orientation.pitch_past_vertical`).
    - ``tilt`` [rad]: angle between the trunk's up and the world's, 0 to pi.
    - ``x``, ``y``, ``height`` [m]: the trunk's centre of mass, world axes.
    - ``travel`` [m]: horizontal distance of the trunk's centre of mass from where the motion began.
    - ``speed``, ``vertical_speed`` [m/s]: norm, and upward component, of the velocity of the trunk's centre of mass.
    - ``angular_speed`` [rad/s]: norm of the trunk's angular velocity.
    - ``angle_margin`` [rad], ``speed_margin``, ``torque_speed_margin`` [share of the limit]: slack of the tightest joint to its
      range, its speed limit, its actuator's line (`levade.trajectory.JointLimits`).
    - ``linkage_margin`` [share of the limit]: the same to the torque that its linkage transmits, for robots loaded with one.
    - ``self_distance`` [m]: least distance between two parts of the robot that may touch, negative if they overlap. Parts that
      are farther apart than the clearance count as that far.
    - ``duration`` [s]: the horizon T, if the search chooses it.
    - ``lowest_foot``, ``highest_foot`` [m]: height over z = 0 of the lowest, or highest, sole of the ``legs``.
    - ``trunk_clearance`` [m]: height over z = 0 of the lowest point of the trunk, including parts fixed to it.

    Attributes:
        quantity: One of these, or a `Measure`.
        target: Required value. Angles wrap.
        tolerance: Largest distance from the target.
        minimum: Required lower bound, instead of a target.
        maximum: Required upper bound, instead of a target.
        at: "horizon": at the horizon T. "end": at the end. "max" or "min": the largest or smallest value of the whole trial,
            including the hold. "hold": at every row of the hold; the error is that of the worst row.
        legs: Legs of a quantity of the feet: see `Legs`.
    """

    quantity: AnyQuantity
    target: float | None = None
    tolerance: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    at: Literal["horizon", "end", "max", "min", "hold"] = "horizon"
    legs: Legs = "all"

    def __post_init__(self) -> None:
        if not isinstance(self.quantity, Measure) and self.quantity not in QUANTITIES:
            raise LevadeError(f"success: {self.quantity} is not a quantity; {did_you_mean(self.quantity, QUANTITIES)}")
        where = f"success.{self.quantity}"
        if self.at not in ("horizon", "end", "max", "min", "hold"):
            raise LevadeError(f"{where}.at: {self.at!r} is unknown; horizon, end, max, min or hold")
        for name in ("target", "tolerance", "minimum", "maximum"):
            value = getattr(self, name)
            if value is not None and not math.isfinite(value):
                raise LevadeError(f"{where}.{name}: {value} is not finite; leave it out where there is none")
        if self.legs != "all" and self.quantity not in OF_FEET:
            raise LevadeError(f"{where}.legs: {self.quantity} is no quantity of the legs; {' and '.join(OF_FEET)} are")
        bounded = self.minimum is not None or self.maximum is not None
        if bounded == (self.target is not None):
            raise LevadeError(f"{where}: give either a target and a tolerance, or a minimum and/or a maximum")
        if (self.tolerance is None) != (self.target is None):
            raise LevadeError(f"{where}: a target goes with a tolerance, and only a target does")
        if self.tolerance is not None and self.tolerance < 0:
            raise LevadeError(f"{where}.tolerance: {self.tolerance} is negative; 0 or more")
        if self.minimum is not None and self.maximum is not None and self.minimum > self.maximum:
            raise LevadeError(f"{where}: the minimum {self.minimum} is above the maximum {self.maximum}")

    @property
    def clearance(self) -> float | None:
        """See `levade.costs.clearance`; None for another quantity."""
        if self.quantity != "self_distance":
            return None
        target = [] if self.target is None else [self.target + (self.tolerance or 0.0)]
        bounds = [bound for bound in (self.minimum, self.maximum) if bound is not None]
        return max(0.0, *target, *bounds)

    @property
    def is_speed(self) -> bool:
        """Whether the quantity decays while a robot comes to rest."""
        return unit_of(self.quantity).endswith("/s")

    def error(self, trajectories: Trajectories) -> Array:
        """Compute signed errors.

        An error is value - target, wrapped for angles. For bounds it is the excess beyond the bound, and 0 inside. It
        is always finite: `levade.costs.DIVERGED` for trials that diverged.

        Args:
            trajectories: The n trials.

        Returns:
            Errors in the quantity's SI unit, shape (n,).
        """
        return self.judge(trajectories)[0]

    def judge(self, trajectories: Trajectories) -> tuple[Array, Array]:
        """Compute `error`, and the slack of each trial to the nearer bound at its worst instant.

        The slack is negative beyond a bound, and NaN for a broken trial or a target.

        Args:
            trajectories: The n trials.

        Returns:
            Errors and slacks in the quantity's SI unit, shape (n,) each.
        """
        with np.errstate(all="ignore"):  # of broken trials, see below
            value = self._values(trajectories)
            error, room = _worst(self._deviation(value)), np.full(len(value), np.nan)
            if self.target is None:
                low = np.inf if self.minimum is None else value - self.minimum
                high = np.inf if self.maximum is None else self.maximum - value
                room = np.minimum(low, high).min(axis=1)
            bad = trajectories.diverged | ~np.isfinite(error)
            return np.where(bad, DIVERGED, within(error, DIVERGED)), np.where(bad, np.nan, room)

    def holds(self, trajectories: Trajectories) -> NDArray[np.bool_]:
        """Tell whether each trial meets the criterion. A trial that diverged does not.

        Args:
            trajectories: The n trials.

        Returns:
            True for each trial that meets it, shape (n,).
        """
        return self.met(self.error(trajectories))

    def met(self, error: Array) -> NDArray[np.bool_]:
        """Tell whether errors are within the tolerance. Beyond a bound no error is allowed.

        Args:
            error: Errors as `error` returns them, in the quantity's SI unit, any shape.

        Returns:
            True for each error within the tolerance, same shape.
        """
        return np.abs(error) <= (self.tolerance or 0.0)

    def deviations(self, trajectories: Trajectories, rows: slice | None = None) -> Array:
        """Compute signed errors at the criterion's instants, or at given rows instead.

        Args:
            trajectories: The n trials.
            rows: Rows to compute at. None for the criterion's instants.

        Returns:
            Errors in the quantity's SI unit, shape (n, rows).
        """
        return self._deviation(self._values(trajectories, rows))

    def _deviation(self, value: Array) -> Array:
        if self.target is not None:
            return wrap(value - self.target) if self.quantity in CIRCULAR else value - self.target
        low = -np.inf if self.minimum is None else self.minimum
        high = np.inf if self.maximum is None else self.maximum
        return value - np.clip(value, low, high)

    def _values(self, trajectories: Trajectories, rows: slice | None = None) -> Array:
        """Compute the quantity at the criterion's instants, or at given rows instead, shape (n, rows)."""
        if rows is not None:
            return quantity_values(self.quantity, trajectories, rows, self.legs)
        if self.at in ("max", "min"):
            value = quantity_values(self.quantity, trajectories, slice(None), self.legs)
            return (value.max if self.at == "max" else value.min)(axis=1, keepdims=True)
        return quantity_values(self.quantity, trajectories, rows_at(trajectories, self.at), self.legs)


def _worst(deviation: Array) -> Array:
    """Return the largest value of each row with its sign, shape (n,), from (n, rows)."""
    if deviation.shape[1] == 1:
        return deviation[:, 0]
    worst = np.argmax(np.abs(deviation), axis=1)[:, None]
    return np.take_along_axis(deviation, worst, axis=1)[:, 0]


def quantity_values(quantity: AnyQuantity, trajectories: Trajectories, rows: slice, legs: Legs = "all") -> Array:
    """Compute a quantity in its SI unit, as `Criterion` describes.

    Args:
        quantity: A built-in quantity or a `Measure`.
        trajectories: The n trials.
        rows: Rows to compute at.
        legs: Legs of a quantity of the feet, see `Legs`. Other quantities ignore them.

    Returns:
        Values in the quantity's SI unit, shape (n, rows).

    Raises:
        LevadeError: If the trunk's shape or the distances between parts are needed and not known, a leg is unknown, or
            a measure returns another shape.
    """
    if isinstance(quantity, Measure):
        return _measured(quantity, trajectories, rows)
    if quantity in OF_FEET:
        soles = [trajectories.sole_height(leg, rows) for leg in chosen_legs(trajectories, legs)]
        return functools.reduce(np.minimum if quantity == "lowest_foot" else np.maximum, soles)
    if quantity == "trunk_clearance":
        if not len(trajectories.embodiment.trunk_balls):
            raise LevadeError("trunk_clearance: nothing of the trunk can touch, or its shape is not known; use height")
        return trajectories.trunk_clearance(rows)
    if quantity in ("x", "y", "height"):
        return trajectories.trunk_com_position(rows)[..., ("x", "y", "height").index(quantity)]
    if quantity == "travel":
        moved = trajectories.trunk_com_position(rows) - trajectories.trunk_com_position(slice(0, 1))
        return np.hypot(moved[..., 0], moved[..., 1])
    if quantity in MARGINS:
        return _margin(quantity, trajectories, rows)
    if quantity == "duration":
        return np.repeat(trajectories.horizon[:, None], len(range(*rows.indices(trajectories.steps))), axis=1)
    if quantity in ("speed", "vertical_speed", "angular_speed"):
        return _speed(quantity, trajectories, rows)
    return _angle(quantity, trajectories, rows)


def _speed(quantity: str, trajectories: Trajectories, rows: slice) -> Array:
    """Compute a speed of the trunk's centre of mass, or of its rotation, shape (n, rows)."""
    if quantity == "vertical_speed":
        return trajectories.trunk_com_velocity(rows)[..., 2]
    if quantity == "speed":
        return np.linalg.norm(trajectories.trunk_com_velocity(rows), axis=-1)
    return np.linalg.norm(trajectories.trunk_angular_velocity[:, rows], axis=-1)


def _angle(quantity: str, trajectories: Trajectories, rows: slice) -> Array:
    """Compute an angle of the trunk's attitude, shape (n, rows)."""
    quaternion = trajectories.trunk_quaternion[:, rows]
    if quantity == "pitch":
        return pitch_past_vertical(quaternion)
    if quantity == "tilt":
        return angle_between(world_up(quaternion), np.array([0.0, 0.0, 1.0]))
    return roll_pitch_yaw(quaternion)[..., 0 if quantity == "roll" else 2]


def _measured(measure: Measure, trajectories: Trajectories, rows: slice) -> Array:
    """Compute a `Measure`, shape (n, rows). Raises LevadeError if it returns another shape."""
    values = np.asarray(measure.function(trajectories, rows), dtype=np.float64)
    expected = (trajectories.n, len(range(*rows.indices(trajectories.steps))))
    if values.shape != expected:
        raise LevadeError(f"success.{measure}: the measure returned {values.shape}; (n, rows), here {expected}")
    return values


def _margin(quantity: str, trajectories: Trajectories, rows: slice) -> Array:
    """Compute the slack of the tightest joint, or of the nearest parts, shape (n, rows)."""
    if quantity == "self_distance":
        return self_distance(trajectories, rows)
    limits = trajectories.limits
    if quantity == "angle_margin":
        left = np.minimum(limits.angle_left(trajectories.joint_position[:, rows]), np.pi)  # a joint without a range
    elif quantity == "speed_margin":
        left = limits.speed_left(trajectories.joint_velocity[:, rows])
    elif quantity == "linkage_margin":
        left = limits.linkage_left(trajectories.joint_position[:, rows], trajectories.joint_torque[:, rows])
    else:
        left = limits.torque_speed_left(trajectories.joint_torque[:, rows], trajectories.joint_velocity[:, rows])
    return left.min(axis=-1)


def chosen_legs(trajectories: Trajectories, legs: Legs) -> list[LegGeometry]:
    """Return the legs that a criterion or a term names.

    Args:
        trajectories: Trials of the robot.
        legs: The names, see `Legs`.

    Returns:
        The legs' geometry, in the robot's leg order.

    Raises:
        LevadeError: If a name is unknown, or there are no names.
    """
    names = (legs,) if isinstance(legs, str) else legs
    standing = [leg for leg in trajectories.legs if leg.stands]
    valid = {name for leg in standing for name in ("all", leg.end, leg.side)} | {leg.name for leg in trajectories.legs}
    for name in names:
        if name not in valid:
            raise LevadeError(f"legs: no {name!r}; {did_you_mean(name, valid) if valid else 'the robot has no legs'}")
    chosen = [
        leg
        for leg in trajectories.legs
        if not ({"all", leg.end, leg.side, leg.name} if leg.stands else {leg.name}).isdisjoint(names)
    ]
    if not chosen:
        raise LevadeError("legs: an empty list; name some, or leave the key out for all")
    return chosen


def errors(criteria: Mapping[str, Criterion], trajectories: Trajectories) -> dict[str, Array]:
    """Compute the error of each criterion. See `Criterion.error`.

    Args:
        criteria: Name -> criterion.
        trajectories: The n trials.

    Returns:
        Name -> errors in the SI unit of the criterion's quantity, shape (n,).
    """
    return {name: criterion.error(trajectories) for name, criterion in criteria.items()}


def success(criteria: Mapping[str, Criterion], trajectories: Trajectories) -> NDArray[np.bool_]:
    """Tell whether each trial meets every criterion. Without criteria, every trial does that did not diverge.

    Args:
        criteria: Name -> criterion.
        trajectories: The n trials.

    Returns:
        True for each successful trial, shape (n,).
    """
    met = ~trajectories.diverged
    for criterion in criteria.values():
        met = met & criterion.holds(trajectories)
    return met
