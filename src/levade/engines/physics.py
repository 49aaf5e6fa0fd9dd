"""Numerical settings of the physics."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal

from levade.engines.table import engine_kind
from levade.errors import LevadeError, located


@dataclass(frozen=True)
class Ode:
    """Settings of the engine ode. The defaults are Gazebo's.

    Attributes:
        solver: "quick" is ``dWorldQuickStep``: ``iterations`` sweeps of successive over-relaxation by the factor
            ``relaxation``. "exact" is ``dWorldStep``, which solves all constraints at once, but bounds friction by the normal
            forces without friction.
        iterations: Sweeps of the solver "quick" in a step.
        relaxation: Factor of over-relaxation of the solver "quick".
        erp: Share of a constraint's error that is corrected in a step.
        cfm: Softness of a constraint [1/(N s/m)].
        surface_layer: Depth up to which contacts may sink in [m].
        max_correcting_velocity: Largest speed at which contacts are pushed apart [m/s].
    """

    solver: Literal["quick", "exact"] = "quick"
    iterations: int = 50
    relaxation: float = 1.3
    erp: float = 0.2
    cfm: float = 1e-10
    surface_layer: float = 0.001
    max_correcting_velocity: float = 100.0

    def __post_init__(self) -> None:
        if not 1 <= self.iterations <= 100_000:
            raise LevadeError(f"physics.ode.iterations: {self.iterations} should be 1 or more; Gazebo has 50")
        if not 0 < self.relaxation < 2:
            raise LevadeError(f"physics.ode.relaxation: {self.relaxation} should be between 0 and 2; Gazebo has 1.3")
        if not 0 <= self.erp <= 1:
            raise LevadeError(f"physics.ode.erp: {self.erp} should be between 0 and 1; Gazebo has 0.2")
        for field in fields(self)[4:]:
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value >= 0):
                raise LevadeError(f"physics.ode.{field.name}: {value} should be 0 or more; Gazebo has {field.default}")


@dataclass(frozen=True)
class Physics:
    """The engine, and its resolution of time and contact.

    The elliptic cone with a friction constraint that is stiffer than the normal one (impratio > 1) keeps feet from creeping.
    With MuJoCo's own defaults a standing HyQ2Max sinks by 1 cm in 5 s, because its feet slide apart.

    Attributes:
        engine: Name of the engine; docs/engines.md says what each needs.
        timestep: Time step [s].
        integrator: Integrator of MuJoCo. ODE ignores it.
        cone: Friction cone of MuJoCo, "elliptic" or "pyramidal". ODE ignores it.
        impratio: Ratio of frictional to normal impedance in MuJoCo. ODE ignores it.
        ode: See `Ode`.
    """

    engine: str = "mujoco"
    timestep: float = 0.002
    integrator: Literal["implicitfast", "implicit", "Euler", "RK4"] = "implicitfast"
    cone: Literal["elliptic", "pyramidal"] = "elliptic"
    impratio: float = 10.0
    ode: Ode = Ode()

    def __post_init__(self) -> None:
        with located("physics.engine: "):
            engine_kind(self.engine)
        if not (math.isfinite(self.timestep) and 0 < self.timestep <= 0.02):
            raise LevadeError(
                f"physics.timestep: {self.timestep} s is out of range; 0.001 to 0.004 is usual, at most 0.02"
            )
        if not (math.isfinite(self.impratio) and self.impratio > 0):
            raise LevadeError(f"physics.impratio: {self.impratio} should be a positive number; 10 is usual")
