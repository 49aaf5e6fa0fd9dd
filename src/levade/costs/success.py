"""Judge whether trials meet their requirements, in SI units, independent of their costs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.costs.evaluate import DIVERGED, within
from levade.costs.orientation import wrap
from levade.costs.quantities import (
    CIRCULAR,
    OF_FEET,
    QUANTITIES,
    AnyQuantity,
    Legs,
    Measure,
    quantity_values,
    unit_of,
)
from levade.costs.rows import rows_at
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories


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
    - ``forward_speed``, ``sideways_speed`` [m/s]: its components along the trunk's heading (yaw), and to the left of it.
    - ``angular_speed`` [rad/s]: norm of the trunk's angular velocity.
    - ``roll_rate``, ``pitch_rate``, ``yaw_rate`` [rad/s]: its components in trunk axes, as a gyroscope measures them.
    - ``joint_speed`` [rad/s]: speed of the fastest joint.
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
                room = self._slack(value).min(axis=1)
            bad = trajectories.diverged | ~np.isfinite(error)
            return np.where(bad, DIVERGED, within(error, DIVERGED)), np.where(bad, np.nan, room)

    @property
    def wording(self) -> str:
        """What it asks for, in the quantity's SI unit, such as "-1.05 ± 0.1 rad" or "at least 0.88 m"."""
        unit = f" {unit_of(self.quantity)}".rstrip()
        if self.target is not None:
            return f"{self.target:.3g} ± {self.tolerance:.3g}{unit}"
        if self.minimum is not None and self.maximum is not None:
            return f"{self.minimum:.3g} to {self.maximum:.3g}{unit}"
        if self.minimum is not None:
            return f"at least {self.minimum:.3g}{unit}"
        return f"at most {self.maximum:.3g}{unit}"

    def value(self, trajectories: Trajectories) -> Array:
        """Compute the quantity at the instant of the error: where it is farthest from the target, or has the least slack.

        Args:
            trajectories: The n trials.

        Returns:
            Values in the quantity's SI unit, shape (n,). They are not finite where a trial broke down.
        """
        with np.errstate(all="ignore"):
            value = self._values(trajectories)
            off = -self._slack(value) if self.target is None else np.abs(self._deviation(value))
        return _where_largest(off, value)

    def value_of(self, error: float) -> float | None:
        """Compute the value that an error means, as far as it tells.

        Args:
            error: Error as `error` returns it, in the quantity's SI unit.

        Returns:
            The value in the same unit. None within bounds.
        """
        if self.target is not None:
            return self.target + error
        bound = self.minimum if error < 0 else self.maximum
        return None if error == 0 or bound is None else bound + error

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

    def _slack(self, value: Array) -> Array:
        """Compute the distance to the nearer bound, negative beyond it."""
        low = np.inf if self.minimum is None else value - self.minimum
        high = np.inf if self.maximum is None else self.maximum - value
        return np.minimum(low, high)

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
    return deviation[:, 0] if deviation.shape[1] == 1 else _where_largest(np.abs(deviation), deviation)


def _where_largest(off: Array, values: Array) -> Array:
    """Return the value of each row where ``off`` is largest, shape (n,), from (n, rows) each."""
    return np.take_along_axis(values, np.argmax(off, axis=1)[:, None], axis=1)[:, 0]


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
