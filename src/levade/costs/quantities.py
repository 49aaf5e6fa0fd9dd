"""Quantities of a motion that criteria and costs look at, in SI units."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import numpy as np

from levade.arrays import Array
from levade.costs.clearance import self_distance
from levade.costs.orientation import angle_between, pitch_past_vertical, world_up
from levade.costs.velocity import from_world
from levade.embodiment import LegGeometry
from levade.errors import LevadeError, did_you_mean
from levade.rotations import roll_pitch_yaw
from levade.trajectory import Trajectories

Quantity = Literal[
    "roll", "pitch", "yaw", "tilt", "x", "y", "height", "travel",
    "speed", "vertical_speed", "forward_speed", "sideways_speed", "angular_speed", "roll_rate", "pitch_rate", "yaw_rate",
    "joint_speed", "lowest_foot", "highest_foot", "trunk_clearance", "angle_margin", "speed_margin", "torque_speed_margin",
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
    "forward_speed": "m/s",
    "sideways_speed": "m/s",
    "roll_rate": "rad/s",
    "pitch_rate": "rad/s",
    "yaw_rate": "rad/s",
    "joint_speed": "rad/s",
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
RATES = ("roll_rate", "pitch_rate", "yaw_rate")
SPEEDS = ("speed", "vertical_speed", "forward_speed", "sideways_speed", "angular_speed", "joint_speed")
MARGINS = ("angle_margin", "speed_margin", "torque_speed_margin", "linkage_margin", "self_distance")

Legs = str | tuple[str, ...]
"""Some of the legs: "all", "front", "middle", "hind", "left", "right", the name of a leg or an arm, or several of these."""


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
    if quantity in RATES:
        return trajectories.trunk_angular_velocity[:, rows, RATES.index(quantity)]
    if quantity in SPEEDS:
        return _speed(quantity, trajectories, rows)
    return _angle(quantity, trajectories, rows)


def _speed(quantity: str, trajectories: Trajectories, rows: slice) -> Array:
    """Compute a speed of the trunk's centre of mass, of its rotation, or of the joints, shape (n, rows)."""
    if quantity == "joint_speed":
        return np.abs(trajectories.joint_velocity[:, rows]).max(axis=-1)
    if quantity == "angular_speed":
        return np.linalg.norm(trajectories.trunk_angular_velocity[:, rows], axis=-1)
    velocity = trajectories.trunk_com_velocity(rows)
    if quantity == "speed":
        return np.linalg.norm(velocity, axis=-1)
    along = from_world(velocity, trajectories.trunk_quaternion[:, rows], "heading")
    return along[..., ("forward_speed", "sideways_speed", "vertical_speed").index(quantity)]


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
    if trajectories.begin is not None:  # each trial alone: a function may sum over rows, or look at the first one
        values = np.empty((trajectories.n, trajectories.steps))
        for i, first in enumerate(trajectories.begin.tolist()):
            values[i, first:] = _measured(measure, trajectories.alone(i), slice(None))[0]
            values[i, :first] = values[i, first]
        return values[:, rows]
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
