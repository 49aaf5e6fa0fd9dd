"""Unwanted contact with the ground, and of the robot with itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from levade.arrays import Array
from levade.costs.rows import Over, integral, rows_over
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories

ContactMeasure = Literal["time", "impulse", "peak"]
"""What a term of contact measures."""

# Below this [N] a contact exists in the solver's rounding only.
CONTACT_FORCE = 1e-9


@dataclass(frozen=True)
class GroundContact:
    """Contact of the named bodies with the ground and the obstacles.

    Attributes:
        bodies: Names of the bodies.
        measure: "time" of contact, summed over the bodies [s]; "impulse" of the contact forces, summed over the bodies [Ns],
            which distinguishes a touch from a blow; or "peak", the largest force on any of the bodies [N].
        over: "horizon", up to the horizon, or "all", which includes the hold.

    Raises:
        LevadeError: If the contact force of a body was not recorded.
    """

    unit: ClassVar[str] = "s, Ns for the impulse, N for the peak"

    bodies: tuple[str, ...]
    measure: ContactMeasure = "time"
    over: Over = "horizon"

    def __post_init__(self) -> None:
        if not self.bodies:
            raise LevadeError("ground_contact.bodies: no bodies; name those that should stay off the ground")
        _check_measure("ground_contact", self.measure)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], [Ns] or [N], shape (n,)."""
        rows = rows_over(trajectories, self.over)
        total = np.zeros(trajectories.n)
        for body in self.bodies:
            recorded = trajectories.body_contact_force
            if body not in recorded:
                hint = did_you_mean(body, recorded) if recorded else "no body's contact force was recorded"
                raise LevadeError(f"ground_contact.bodies: the contact force of {body} was not recorded; {hint}")
            value = _measured(self.measure, recorded[body][:, rows], trajectories, rows)
            total = np.maximum(total, value) if self.measure == "peak" else total + value
        return total


@dataclass(frozen=True)
class SelfContact:
    """Contact of the robot's parts with each other. Parts that adjoin or overlap by construction do not count.

    Attributes:
        measure: "time" in which any two parts touch [s]; "impulse" of the strongest contact at each instant [Ns]; or "peak",
            the largest force of a contact [N].
        over: "horizon", up to the horizon, or "all", which includes the hold.

    Raises:
        LevadeError: If the forces between parts were not recorded.
    """

    unit: ClassVar[str] = "s, Ns for the impulse, N for the peak"
    self_force: ClassVar[bool] = True

    measure: ContactMeasure = "time"
    over: Over = "horizon"

    def __post_init__(self) -> None:
        _check_measure("self_contact", self.measure)

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], [Ns] or [N], shape (n,)."""
        if trajectories.self_force is None:
            raise LevadeError("self_contact: forces between the robot's parts were not recorded")
        rows = rows_over(trajectories, self.over)
        return _measured(self.measure, trajectories.self_force[:, rows], trajectories, rows)


def _check_measure(term: str, measure: str) -> None:
    if measure not in ("time", "impulse", "peak"):
        raise LevadeError(f"{term}.measure: {measure!r} is unknown; time, impulse or peak")


def _measured(measure: ContactMeasure, force: Array, trajectories: Trajectories, rows: slice) -> Array:
    """Measure a contact by the magnitudes of its force [N], shape (n, rows), in s, Ns or N, shape (n,)."""
    if measure == "peak":
        counted = trajectories.counted(rows)
        return (force if counted is None else np.where(counted, force, 0.0)).max(axis=1)
    if measure == "time":
        # a force that is not a number must not pass for no contact
        force = np.where(np.isfinite(force), force > CONTACT_FORCE, np.nan)
    return integral(force, trajectories, rows)
