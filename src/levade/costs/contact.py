"""Unwanted contact with the ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from levade.arrays import Array
from levade.costs.rows import Over, integral, rows_over
from levade.errors import LevadeError, did_you_mean
from levade.trajectory import Trajectories

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
    measure: Literal["time", "impulse", "peak"] = "time"
    over: Over = "horizon"

    def __post_init__(self) -> None:
        if not self.bodies:
            raise LevadeError("ground_contact.bodies: no bodies; name those that should stay off the ground")
        if self.measure not in ("time", "impulse", "peak"):
            raise LevadeError(f"ground_contact.measure: {self.measure!r} is unknown; time, impulse or peak")

    def __call__(self, trajectories: Trajectories) -> Array:
        """Compute the cost [s], [Ns] or [N], shape (n,)."""
        rows = rows_over(trajectories, self.over)
        total = np.zeros(trajectories.n)
        for body in self.bodies:
            recorded = trajectories.body_contact_force
            if body not in recorded:
                hint = did_you_mean(body, recorded) if recorded else "no body's contact force was recorded"
                raise LevadeError(f"ground_contact.bodies: the contact force of {body} was not recorded; {hint}")
            force = recorded[body][:, rows]
            if self.measure == "peak":
                counted = trajectories.counted(rows)
                total = np.maximum(total, (force if counted is None else np.where(counted, force, 0.0)).max(axis=1))
                continue
            if self.measure == "time":
                # a force that is not a number must not pass for no contact
                force = np.where(np.isfinite(force), force > CONTACT_FORCE, np.nan)
            total += integral(force, trajectories, rows)
        return total
