"""Numerical settings of the physics."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from levade.errors import LevadeError


@dataclass(frozen=True)
class Physics:
    """How time and contact are resolved.

    timestep: [s]. integrator, cone, impratio: as in MuJoCo's ``option``. The elliptic cone with a friction constraint
    that is stiffer than the normal one (impratio > 1) keeps feet from creeping: with MuJoCo's own defaults HyQ2Max,
    standing still, sinks by 1 cm in 5 s as its feet slide apart.
    """

    timestep: float = 0.002
    integrator: Literal["implicitfast", "implicit", "Euler", "RK4"] = "implicitfast"
    cone: Literal["elliptic", "pyramidal"] = "elliptic"
    impratio: float = 10.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.timestep) and 0 < self.timestep <= 0.02):
            raise LevadeError(
                f"physics.timestep: {self.timestep} s is out of range; 0.001 to 0.004 is usual, at most 0.02"
            )
        if not (math.isfinite(self.impratio) and self.impratio > 0):
            raise LevadeError(f"physics.impratio: {self.impratio} should be a positive number; 10 is usual")
